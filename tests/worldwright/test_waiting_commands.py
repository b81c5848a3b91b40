"""The command line waits until all is done, as a client of MCP could not, and says how far it is."""

import math
from typing import Annotated

from click.testing import CliRunner
from pydantic import BaseModel, Field

from worldwright import cli, expose
from worldwright.model.progress import Progress, silent
from worldwright.scan import tools as scan


class Said(BaseModel):
    """What a call was given."""

    timeout_s: float

    def text(self) -> str:
        return f"within {self.timeout_s}"


@expose.waits("timeout_s")
def look(
    timeout_s: Annotated[float, Field(description="Return after so many seconds.", le=42)] = 40,
    progress: Progress = silent,
) -> Said:
    """Repeat, and look."""
    for done in (0, 0, 1, 2):
        progress(done, 2, f"{done} of 2 repetitions")
    return Said(timeout_s=timeout_s)


def test_it_waits_and_tells_each_step_once() -> None:
    said = CliRunner().invoke(cli.verb(look), [])
    assert said.exit_code == 0 and said.stdout == f"within {math.inf}\n"
    assert said.stderr.splitlines() == ["0 of 2 repetitions", "1 of 2 repetitions", "2 of 2 repetitions"]
    assert "40" not in CliRunner().invoke(cli.verb(look), ["--help"]).output


def test_it_returns_after_the_time_that_is_given() -> None:
    assert CliRunner().invoke(cli.verb(look), ["--timeout-s", "0"]).stdout == "within 0.0\n"
    assert look().timeout_s == 40, "a client of MCP is answered as before"


def test_the_audits_of_a_scan_are_waited_for() -> None:
    assert scan.scan.waits == "timeout_s"  # type: ignore[attr-defined]
