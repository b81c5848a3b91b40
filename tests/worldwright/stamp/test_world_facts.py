"""The facts beside an accepted world are those of its plan and program, whoever sealed the folder last."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from worldengine.given import Given
from worldkit.errors import ProgramError
from worldwright.lint import tools as lint
from worldwright.stamp import bundle, verification, world_facts
from worldwright.stamp import tools as stamp
from worldwright.stamp.proof import WORLD
from worldwright.stamp.statement import Statement

Copy = Callable[[Path], Path]


def differ(folder: Path) -> list[str]:
    inside = folder / "accepted"
    facts = inside / bundle.WORLD
    return list(world_facts.differ(inside / WORLD, facts, inside / "simulation.py", inside / "plan.md"))


def test_those_of_an_honest_world_are_the_same(accepted: Path) -> None:
    assert differ(accepted) == []


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("duration", 0.25, "program.json says duration 0.25, the program"),
        ("fps", 5, "program.json says fps 5, the program"),
        ("size", [64, 64], "program.json says size [64, 64], the program"),
        ("movers", [], "program.json says movers [], the program"),
        ("visual_only", ["ball"], 'program.json says visual_only ["ball"], the program []'),
        ("seed", 7, "program.json says seed 7, the program 0"),
        ("control", "control", 'program.json says control "control", the program null'),
        ("latency", 1, "program.json says latency 1, the program 0"),
        ("world_sha256", "0" * 64, "program.json is about another world"),
    ],
)
def test_a_changed_fact_of_the_program_is_named(accepted: Path, copy: Copy, name: str, value: Any, says: str) -> None:
    folder = copy(accepted)
    path = folder / "accepted" / bundle.WORLD / "program.json"
    path.write_text(json.dumps({**json.loads(path.read_bytes()), name: value}))
    assert says in differ(folder)[0]


def test_inputs_that_the_plan_does_not_declare_are_named(accepted: Path, copy: Copy) -> None:
    folder = copy(accepted)
    path = folder / "accepted" / bundle.WORLD / "inputs.json"
    path.write_text(json.dumps([{"kind": "force", "bodies": ["ball"]}]))
    assert differ(folder) == ["inputs.json is not what the plan declares"]


@pytest.mark.parametrize("name", ["program.json", "inputs.json"])
@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"", "is damaged"),
        (b'{"duration": 1', "is damaged"),
        (b'{"duration": NaN}', "it holds NaN"),
        (b'[{"kind": -Infinity}]', "it holds -Infinity"),
        (b"[" * 100_000, "is damaged"),
        (b"17", "it holds no"),
        (b"\xff\xfe\x00", "is damaged"),
        (b" " * (2 << 20), "no plain file of at most 1 MB"),
    ],
)
def test_damaged_facts_are_typed_not_a_crash(
    accepted: Path, copy: Copy, name: str, content: bytes, says: str, tmp_path: Path
) -> None:
    folder = copy(accepted)
    path = folder / "accepted" / bundle.WORLD / name
    path.write_bytes(content)
    (said,) = differ(folder)
    assert said.startswith(f"{name} is damaged") and says in said
    facts = path.parent
    with pytest.raises(ProgramError):  # nor does the engine's process crash
        Given.read(folder / "accepted" / WORLD, facts / "program.json", facts / "inputs.json")


def test_verification_refuses_them_without_running_anything(accepted: Path, copy: Copy) -> None:
    run = copy(accepted)
    folder = run / "accepted"
    path = folder / bundle.WORLD / "program.json"
    path.write_text(json.dumps({**json.loads(path.read_bytes()), "visual_only": ["ball"]}))
    for name in ("stamp.dsse.json", "stamp.pub"):
        (folder / name).unlink(missing_ok=True)
    statement = Statement.model_validate_json((folder / bundle.STAMP).read_bytes())
    bundle.seal(folder, statement.model_copy(update={"subject": bundle.subjects(folder)}))
    (run / "journal.jsonl").unlink()
    found = stamp.verify(str(run), anybody=True)
    assert found.state == "refuted" and not [c for c in found.checks if c.name in ("trajectory", "run")]
    assert [c.name for c in found.checks if not c.ok] == ["facts"]


def test_facts_of_another_build_are_told_where_a_known_signer_vouches_for_them(
    accepted: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Later defaults and a later form of what a plan declares say nothing about an honest world."""
    from worldkit import program
    from worldwright.stage import tools as stage

    def main(build: Any, control: Any = None, *, latency: int = 3, **_: Any) -> None: ...

    monkeypatch.setattr(program, "main", main)
    (said,) = verification._facts(accepted / "accepted", older=True)
    assert said.ok and "as plan and program say" in said.detail
    monkeypatch.setattr(stage, "declared_inputs", lambda _: [{"of": "later"}])
    (said,) = verification._facts(accepted / "accepted", older=True)
    assert said.ok and "not what the plan declares" in said.detail
    (said,) = verification._facts(accepted / "accepted", older=False)
    assert not said.ok and "latency 0, the program 3" in said.detail


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -1.0, 0.0])
def test_a_duration_that_makes_no_sense_is_refused_by_the_engine(value: float, accepted: Path, tmp_path: Path) -> None:
    facts = json.loads((accepted / "accepted" / bundle.WORLD / "program.json").read_bytes())
    path = tmp_path / "program.json"
    path.write_text(json.dumps({**facts, "duration": value}))
    with pytest.raises(ProgramError, match="duration"):
        Given.read(accepted / "accepted" / WORLD, path, None)


MAIN = "from worldkit import program\ndef build():\n    pass\ndef law(model, data):\n    pass\n"


@pytest.mark.parametrize(
    ("text", "name", "value"),
    [
        ("program.main(build, duration=2 * 1.5)", "duration", 3.0),
        ("LENGTH = 2.0\nprogram.main(build, law, duration=LENGTH)", "control", "law"),
        ("program.main(build, law, duration=1.0, movers=('a', 'b'))", "movers", ("a", "b")),
        ("program.main(build, duration=1.0)", "fps", 24),
    ],
)
def test_what_a_program_says_of_itself_is_read_from_its_text(text: str, name: str, value: Any, tmp_path: Path) -> None:
    (tmp_path / "simulation.py").write_text(MAIN + text + "\n")
    found = lint.stated_facts(tmp_path / "simulation.py")[name]
    assert (tuple(found) if isinstance(found, list) else found) == value


@pytest.mark.parametrize(
    "text",
    [
        "program.main(build, **{'duration': 1.0})",
        "program.main(build, duration=1.0)\nprogram.main(build, duration=2.0)",
        "pass",
    ],
)
def test_a_call_that_only_a_run_would_tell_says_nothing(text: str, tmp_path: Path) -> None:
    (tmp_path / "simulation.py").write_text(MAIN + text + "\n")
    assert lint.stated_facts(tmp_path / "simulation.py") == {}
