"""A stamp that nobody known signed: the program is asked again whether it would send what was recorded."""

from pathlib import Path

import pytest

from worldwright.lint import tools as lint
from worldwright.stage import sandbox
from worldwright.stage import tools as stage
from worldwright.stamp import tools as stamp

from . import attack, bundle_tricks, forging

STEPS_S = 240


@pytest.fixture(scope="module")
def breezy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An accepted run: a crate that slides farther in a breeze of 1 N, which its `control` sends."""
    honest = attack.Trick("honest", "none", "A breeze.", plan=bundle_tricks.FARTHER, control=bundle_tricks.BLOWS)
    folder = tmp_path_factory.mktemp("breeze") / "run"
    ending = attack.attempt(honest, folder)
    assert ending.won, ending
    return folder


def verified(run: Path, **options: object) -> stamp.Verification:
    while True:
        found = stamp.verify(str(run), timeout_s=STEPS_S, **options)  # type: ignore[arg-type]
        if found.state != "running":
            return found


def test_a_strangers_program_that_sends_what_was_recorded_is_a_yes(breezy: Path, copy) -> None:
    run = copy(breezy)
    forging.resealed(run, key="stranger")
    told = verified(run, anybody=True)
    assert told.ok and told.exit_code == 0, told.text()
    (law,) = [check.detail for check in told.checks if check.name == "law"]
    assert law == "built again by the stamped program: the same content; asked again, it sends the same inputs"
    assert "inputs law re-run" in told.text()


def test_a_stream_that_the_program_would_not_send_is_refused(breezy: Path, copy) -> None:
    """What the plan declares is kept to, and all pictures show what the stream does; only the program would do otherwise."""
    run = copy(breezy)
    bundle_tricks.calm(run)
    for options in ({"anybody": True}, {}, {"anybody": True, "rebuild": True}):
        told = verified(run, **options)
        assert told.state == "refuted" and told.exit_code == 1
        (refused,) = [check for check in told.checks if not check.ok]
        assert refused.name == "law" and "it sends other inputs than were recorded" in refused.detail


def test_a_stream_is_refused_whose_program_would_send_none(breezy: Path, copy) -> None:
    run = copy(breezy)
    path = run / "accepted" / "simulation.py"
    path.write_text(path.read_text(encoding="utf-8").replace("program.main(build, control,", "program.main(build,"))
    facts = run / "accepted" / "world" / "program.json"
    forging.edited(facts, lambda value: {**value, "control": None})
    forging.resealed(run, key="stranger")
    told = verified(run, anybody=True)
    assert not told.ok and "FAIL law" in told.text()


def test_a_false_processor_buys_no_yes_for_a_claim_that_the_program_would_miss(breezy: Path, copy) -> None:
    """Near enough to the recorded motion for another machine; what is claimed does not hold of it."""
    run = copy(breezy)
    bundle_tricks.lull(run)
    told = verified(run, anybody=True)
    assert told.state == "not_shown" and told.exit_code == 1
    (left,) = [check for check in told.checks if not check.ok]
    assert left.name == "law" and left.open and "driven by those, expectations: objective 0" in left.detail
    assert "processor" in told.next_move and "open law: it does not repeat here" in told.text()
    assert "inputs as recorded" in told.text()


def test_what_only_does_not_repeat_elsewhere_is_not_refuted(breezy: Path, copy) -> None:
    run = copy(breezy)
    bundle_tricks.calm(run)
    forging.resealed(run, bundle_tricks.another_processor, key="stranger")
    told = verified(run, anybody=True)
    assert told.state == "not_shown" and not told.ok and told.exit_code == 1
    assert "not shown here" in told.text().splitlines()[0]


@pytest.mark.parametrize("elsewhere", [True, False])
def test_the_rules_of_another_version_are_not_asked(
    breezy: Path, copy, monkeypatch: pytest.MonkeyPatch, elsewhere: bool
) -> None:
    run = copy(breezy)
    forging.resealed(run, *[bundle_tricks.another_processor] * elsewhere, key="stranger")
    monkeypatch.delattr(lint, "check_program")
    told = verified(run, anybody=True)
    assert told.ok and "asked again, it sends the same inputs" in told.text(), told.text()


@pytest.mark.parametrize("anybody", [True, False])
@pytest.mark.parametrize("kept", [True, False], ids=["kept", "without its file"])
def test_without_a_sandbox_it_is_no_yes_and_nothing_is_run(
    breezy: Path, copy, monkeypatch: pytest.MonkeyPatch, anybody: bool, kept: bool
) -> None:
    run = copy(breezy)
    if not kept:
        (run / "accepted" / "world.mjz").unlink()
    forging.resealed(run, key="stranger")
    monkeypatch.delenv("WORLDWRIGHT_SANDBOX", raising=False)
    monkeypatch.setattr(sandbox, "level", lambda: "rlimits")
    monkeypatch.delattr(stage, "start_fresh")
    monkeypatch.delattr(stage, "simulate_given")
    told = verified(run, anybody=anybody)
    assert told.state == "not_shown" and told.exit_code == 1
    assert [check.name for check in told.checks if not check.ok] == ["law"]
    assert "checksums" in told.text() and "no sandbox confines" in told.text()
    assert "worldwright doctor" in told.next_move


def test_whom_somebody_known_signed_is_not_asked(breezy: Path, copy) -> None:
    told = verified(copy(breezy))
    assert told.ok and "inputs as recorded" in told.text()
    assert not [check for check in told.checks if check.name == "law"]
