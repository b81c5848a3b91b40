"""Whether a stranger's program has to be asked is not for the stranger's facts to say."""

from collections.abc import Callable
from pathlib import Path

import pytest

from worldengine.recording import stored
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


@pytest.mark.parametrize(
    "before",
    [
        "getattr(program, 'm' + 'ain')(build, control, duration=1.0)\n",
        "run = program\n\nrun.main(build, control, duration=1.0)\n",
        "from worldkit.program import *\n\nmain(build, control, duration=1.0)\n",
        "program.__dict__['main'](build, control, duration=1.0)\n",
        "import sys\n\nsys.modules['worldkit.program'].main(build, control, duration=1.0)\n",
    ],
)
def test_a_call_beside_which_another_may_be_hidden_says_nothing(
    accepted: Path, copy: Callable[[Path], Path], before: str
) -> None:
    folder = copy(accepted) / "accepted"
    program = folder / "simulation.py"
    text = program.read_text(encoding="utf-8")
    program.write_text(text.replace("if __name__", f"{CONTROL}{before}\n\nif __name__"), encoding="utf-8")
    assert law_check.concerns(folder)


@pytest.mark.parametrize("where", ["def decoy():\n    ", "if False:\n    ", "while 0:\n    "])
def test_a_call_that_may_never_be_made_says_nothing(accepted: Path, copy: Callable[[Path], Path], where: str) -> None:
    folder = copy(accepted) / "accepted"
    program = folder / "simulation.py"
    text = program.read_text(encoding="utf-8")
    assert text.count('if __name__ == "__main__":\n    ') == 1
    program.write_text(text.replace('if __name__ == "__main__":\n    ', where), encoding="utf-8")
    assert law_check.concerns(folder)


@pytest.mark.parametrize("content", [b"", b"no arrow file at all"])
def test_a_file_that_could_drive_the_world_is_enough_and_is_not_read(
    accepted: Path, copy: Callable[[Path], Path], monkeypatch: pytest.MonkeyPatch, content: bytes
) -> None:
    """Here no limit of memory holds, as it does where the world is driven by it."""
    folder = copy(accepted) / "accepted"
    (folder / "world" / "inputs.arrows").write_bytes(content)
    monkeypatch.delattr(stored, "Replayable")
    assert law_check.concerns(folder)


def test_facts_that_nest_without_end_are_asked_about(accepted: Path, copy: Callable[[Path], Path]) -> None:
    folder = copy(accepted) / "accepted"
    (folder / "world" / "program.json").write_text("[" * 200_000, encoding="utf-8")
    assert law_check.concerns(folder)


def test_where_the_plan_lets_a_control_write_the_program_is_asked_whatever_its_text_says(
    accepted: Path, copy: Callable[[Path], Path]
) -> None:
    folder = copy(accepted) / "accepted"
    plan = folder / "plan.md"
    text = plan.read_text(encoding="utf-8")
    row = "interventions: [{kind: force, bodies: [ball], law: a push, trigger: always, source: a test}]"
    assert "time_step: 0.002" in text
    plan.write_text(text.replace("time_step: 0.002", f"time_step: 0.002\n{row}"), encoding="utf-8")
    assert law_check.concerns(folder)
