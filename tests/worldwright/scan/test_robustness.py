"""Claims that hold only just are told; what holds everywhere is counted; nothing blocks."""

from pathlib import Path

from staged import Here, World, box, empty

from worldwright.model.evidence.audits import RobustReport
from worldwright.model.evidence.run import Run
from worldwright.scan.audits import robustness


def sliding() -> object:
    """A brick that slides over a floor."""
    spec = empty()
    box(spec, "brick", (0, 0, 0.1))
    key = spec.add_key(name="start")
    key.qpos, key.qvel = [0, 0, 0.1, 1, 0, 0, 0], [1.5, 0, 0, 0, 0, 0]
    return spec


def audited(objectives: tuple[dict[str, object], ...], folder: Path, duration: float = 1.0) -> RobustReport:
    world = World(sliding, None, duration, ("brick",), objectives=objectives)
    planned = world.run(folder / "planned")
    trials = Here(Run(folder), world=world, folder=folder)
    robustness.ask(trials)
    trials.collect()
    return robustness.report(planned, world.plan, trials)


def moves(least: float) -> dict[str, object]:
    return {"claim": f"{least} m", "expect": [{"moves": {"body": "brick", "min_m": least}}]}


def test_what_holds_with_room_holds_everywhere_and_what_holds_just_does_not(tmp_path: Path) -> None:
    far = audited((moves(0.01),), tmp_path / "first").claims[0]
    assert (far.holds, far.of, far.not_in) == (7, 7, ())
    world = World(sliding, None, 1.0, ("brick",))
    came = float(world.run(tmp_path / "came").pos[-1, 0, 0])
    report = audited((moves(0.99 * came), moves(2 * came)), tmp_path / "second")
    (just,) = report.claims  # what does not hold as planned is no claim whose robustness could be told
    assert just.of == 7 and "vary friction=1.2" in just.not_in and "vary friction=0.8" not in just.not_in
    assert "objective 0, moves: holds in" in report.text() and "not with vary friction=1.2" in report.text()
    assert report.everywhere == 0 and "0 of 1 measured claims hold in all of 7 worlds" in report.text()


def failing(folder: Path, *failures: tuple[str, str]) -> RobustReport:
    """The report of a claim with room, where these worlds (label, why) could not be simulated."""
    world = World(sliding, None, 0.2, ("brick",), objectives=(moves(0.01),))
    planned = world.run(folder / "planned")
    trials = Here(Run(folder), world=world, folder=folder)
    robustness.ask(trials)
    trials.collect()
    for label, why in failures:
        trials.failed[label] = why
        del trials.made[label]
    return robustness.report(planned, world.plan, trials)


def test_a_world_that_cannot_be_simulated_is_told_and_nothing_is_said_to_hold_there(tmp_path: Path) -> None:
    report = failing(tmp_path, ("vary start=0.99", "timed_out: it takes long"))
    assert (report.claims[0].holds, report.claims[0].of, report.claims[0].not_in) == (6, 6, ())
    assert "vary start=0.99 could not be simulated: timed_out" in report.text()
    assert report.everywhere == 0 and "0 of 1 measured claims hold in all of 7 worlds" in report.text()


def test_where_none_can_be_simulated_nothing_holds_everywhere(tmp_path: Path) -> None:
    labels = [robustness.label_of(words) for words in robustness.WORLDS]
    report = failing(tmp_path, *((label, "out_of_memory: it is large") for label in labels))
    assert report.claims[0].of == 0 and report.everywhere == 0
    assert not RobustReport(trajectory_sha256="", claims=report.claims).everywhere


def test_a_world_that_diverges_is_one_in_which_no_claim_holds(tmp_path: Path) -> None:
    (claim,) = failing(tmp_path, ("vary start=0.99", "diverged: at 0.1 s")).claims
    assert (claim.holds, claim.of, claim.not_in) == (6, 7, ("vary start=0.99",))
    assert claim.message == "vary start=0.99: diverged: at 0.1 s"
