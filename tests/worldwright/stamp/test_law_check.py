"""Whether a stranger's program has to be asked is not for the stranger's facts to say."""

from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.stamp import law_check

PLAIN = "program.main(build, "
CONTROL = "def control(model, data):\n    pass\n\n\n"


def test_a_program_that_says_it_has_no_control_is_not_asked(accepted: Path) -> None:
    assert not law_check.concerns(accepted / "accepted")


@pytest.mark.parametrize(
    "call",
    [
        "program.main(build, control, ",
        "program.main(build, **{'control': control}, ",
        "program.main(*(build, control), ",
        "main = getattr(program, 'main')\n    main(build, control, ",
    ],
)
def test_one_whose_text_does_not_say_so_is_asked_whatever_its_facts_say(
    accepted: Path, copy: Callable[[Path], Path], call: str
) -> None:
    folder = copy(accepted) / "accepted"
    program = folder / "simulation.py"
    text = program.read_text(encoding="utf-8")
    assert PLAIN in text
    program.write_text(text.replace(PLAIN, call).replace("if __name__", CONTROL + "if __name__"), encoding="utf-8")
    assert law_check.concerns(folder)
