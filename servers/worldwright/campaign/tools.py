"""Campaigns for an agent: tools that are lent to `stage`, since they run worlds, and stand here, since a world's walk is `stamp`'s.

A campaign is driven by a process of its own, which no call waits for: each answers within 45 s, and whoever ends (server,
harness, call) takes nothing along. The plans of its worlds are approved in auto mode; a person's word is given on the shell.
"""

import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Annotated

from pydantic import Field

from ..expose import Positional, reads
from ..model.frozen import Frozen
from ..model.progress import Progress, silent
from .conducting import Count, Standing, standing
from .world_row import Row

Name = Annotated[str, Field(description="The campaign's folder, or its name under runs/.")]
LOG = "driver.log"
BEGINS_S, LOOK_S, MOST_ROWS = 20.0, 0.5, 2000


class Result(Frozen):
    """What came of one world; the table has all of its row."""

    number: int
    world: str
    outcome: str
    cause: str = ""
    margin: float | None = None
    values: dict[str, float] = {}
    folder: str = ""

    def text(self) -> str:
        """One line."""
        values = ", ".join(f"{name.rsplit('.', 1)[-1]} {value:g}" for name, value in self.values.items())
        margin = f", margin {self.margin:.3g}" if self.margin is not None else ""
        why = f" ({self.cause})" if self.cause else ""
        return f"{self.number} {self.outcome}{why}{margin}{f': {values}' if values else ''}"


class Results(Frozen):
    """What came of a campaign."""

    standing: Standing
    said: dict[str, str] = {}
    """Of each kind of cause, what one world says."""
    results: tuple[Result, ...] = ()
    """Of the worlds that were asked for, the first 2000 by number."""
    files: tuple[str, ...] = ()
    """The table (Parquet, CSV) and the page, as they are now."""

    def text(self) -> str:
        """The standing, each cause once, one line a world, the files."""
        lines = [self.standing.text()]
        lines += [f"{kind}: {said}" for kind, said in self.said.items()]
        return "\n".join([*lines, *(one.text() for one in self.results), *self.files])


def campaign_start(
    file: Annotated[str, Field(description="A campaign's YAML (skill `campaign`), or a campaign to go on with.")],
    folder: Annotated[Path | None, Field(description="Where; else runs/ and its name."), Positional()] = None,
    workers: Annotated[int | None, Field(description="Worlds at work at once.", ge=1)] = None,
) -> Standing:
    """Start a campaign, many worlds at once, or go on with one, and return at once; follow it with `campaign_wait`.

    The file is checked as a whole first. What has its row is not done again.
    """
    from . import setting_out
    from .campaign_store import ABOUT, Store

    given = Path(file)
    if (given / ABOUT).is_file() or (not given.exists() and (Path("runs") / given / ABOUT).is_file()):
        store = setting_out.changed(Store.find(given), workers, None, None)
    else:
        campaign = setting_out.limited(setting_out.checked(given), workers, None, None)
        store = setting_out.begun(campaign, given, folder, approved=False)
    if store.driven:
        return standing(store)
    with (store.folder / LOG).open("ab") as log:
        driver = subprocess.Popen(
            [sys.executable, "-P", "-m", "worldwright.cli", "campaign", "resume", str(store.folder)],
            stdin=subprocess.DEVNULL,
            stdout=log,
            stderr=log,
            start_new_session=True,
            env={**os.environ, "PYDANTIC_DISABLE_PLUGINS": "__all__"},
        )
    ends = time.monotonic() + BEGINS_S
    while not store.driven and driver.poll() is None and time.monotonic() < ends:
        time.sleep(0.05)
    return standing(store)


@reads
def campaign_wait(
    campaign: Name,
    timeout_s: Annotated[float, Field(description="Return after so long at the latest.", gt=0, le=40)] = 40,
    progress: Progress = silent,
) -> Standing:
    """Wait until a campaign has ended, or `timeout_s` is over: how far it is, what failed by cause; call again."""
    from .campaign_store import Store

    store = Store.find(campaign)
    total, ends = store.begun.campaign.size, time.monotonic() + timeout_s
    while store.driven and time.monotonic() < ends:
        progress(sum(1 for _ in (store.folder / "rows").glob("*/*.json")), total, "worlds")
        time.sleep(LOOK_S)
    return standing(store)


@reads
def campaign_status(campaign: Name) -> Standing:
    """How far a campaign is: worlds done, outcomes, causes by their number, whether it is at work, the next move."""
    from .campaign_store import Store

    return standing(Store.find(campaign))


def campaign_cancel(campaign: Name) -> Standing:
    """Stop a campaign; what is done stays, and `campaign_start` with its name goes on."""
    from . import setting_out
    from .campaign_store import Store

    store = Store.find(campaign)
    setting_out.cancelled(store)
    return standing(store)


def campaign_results(
    campaign: Name,
    outcome: Annotated[str, Field(description="Only worlds that ended so; empty: all.")] = "",
    cause: Annotated[str, Field(description="Only worlds with this kind of cause.")] = "",
) -> Results:
    """What came of each world so far, and what each kind of failure says; writes table.parquet, table.csv and the page."""
    from . import wall
    from .campaign_store import Store

    store, said, count = Store.find(campaign), dict[str, str](), Count()
    found: list[Result] = []

    def see(row: Row) -> None:
        count.add(row)
        kind = row.cause.kind if row.cause else ""
        if row.cause is not None:
            said.setdefault(kind, f"{row.cause.said.splitlines()[0]} (world {row.number})")
        if outcome in ("", row.outcome) and cause in ("", kind) and len(found) < MOST_ROWS:
            found.append(
                Result(
                    number=row.number,
                    world=row.world,
                    outcome=row.outcome,
                    cause=kind,
                    margin=row.margin,
                    values=row.values,
                    folder=row.folder,
                )
            )

    files = tuple(str(path) for path in wall.write(store, see))
    return Results(standing=standing(store, count), said=said, results=tuple(found), files=files)


TOOLS = (campaign_start, campaign_wait, campaign_status, campaign_cancel, campaign_results)
