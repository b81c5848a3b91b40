"""The pre-roll may take its time while it advances; what ends it says nothing of the plan, what it cannot take does."""

import math
import resource
from contextlib import nullcontext
from types import SimpleNamespace

import pytest

from worldwright.model import call_time, processor_time
from worldwright.model.errors import CallOverError, JobError
from worldwright.model.plan.committed import Plan
from worldwright.place import asking, preroll
from worldwright.place import tools as place
from worldwright.place.asking import RefusedLayoutError, simulate
from worldwright.place.engine import resolve

pytestmark = pytest.mark.usefixtures("started_preroll")


def crates() -> Plan:
    """Two crates side by side, close enough for the pre-roll to be asked."""
    crate = {"primitive": "box", "size": [0.4, 0.4, 0.4]}
    return Plan.model_validate(
        {
            "plan_type": "mbs",
            "simulation_parameters": {
                "time_step": 0.002, "simulation_duration": 1.0, "masses": {"one": 1, "other": 1},
            },
            "objectives": [{"claim": "they stand"}],
            "scene_objects": [{"name": name, **crate} for name in ("one", "other")],
            "topology": {"body_positions": {"one": {"x": 0, "y": 0, "z": 0.2}, "other": {"x": 0.35, "y": 0, "z": 0.2}}},
            "implementation_steps": [{"description": "stand", "motion_expectations": ["one"]}],
        }
    )  # fmt: skip


@pytest.fixture
def unkept(monkeypatch, tmp_path):
    """No answer is kept from before."""
    monkeypatch.setenv("WORLDWRIGHT_PREROLLS", str(tmp_path / "prerolls"))


def test_it_says_where_it_is_at_each_step_distance_and_drop(monkeypatch, unkept):
    asked = []
    monkeypatch.setattr(asking.kept_answers, "read", lambda _: {"known": True})
    monkeypatch.setattr(asking.kept_answers, "place_of", lambda request: asked.append(request) or "here")
    plan = crates()
    simulate(plan, resolve(plan).scene, duration_s=0.02, pairs=[("one", "other")], far_m=1.0, falling=["one"])
    told = []
    preroll.answer(asked[0], told.append)
    assert told[0] == "built" and "distance 1 of 1" in told and "drop 1 of 1" in told
    assert [t for t in told if t.startswith("step")] == [f"step {n} of 10" for n in range(1, 11)]


@pytest.mark.usefixtures("unkept")
def test_one_that_stands_still_is_no_fault_of_the_plan(monkeypatch, tmp_path, small_plan):
    monkeypatch.setattr(asking, "STILL_S", 0.0)
    plan = crates()
    with pytest.raises(JobError, match="nothing advanced") as told:
        simulate(plan, resolve(plan).scene, duration_s=0.1)
    assert told.value.code == "timed_out" and not isinstance(told.value, RefusedLayoutError)
    (tmp_path / "plan.md").write_text(small_plan, encoding="utf-8")
    place.resolve(tmp_path / "plan.md")
    with pytest.raises(JobError, match="nothing advanced"):
        place.settle(tmp_path / "plan.md")


@pytest.mark.parametrize(("advances", "starved"), [(True, False), (False, True), (False, False)])
def test_it_is_waited_for_as_long_as_it_advances_or_has_no_processor(monkeypatch, tmp_path, advances, starved):
    progress, clock, needs_s = tmp_path / "answer.progress", [0.0], 10 * asking.STILL_S
    monkeypatch.setattr(asking.own_time, "of_process", lambda _: (clock[0] / 15 if starved else clock[0], True))

    def sleep(_: float) -> None:
        clock[0] += asking.STILL_S / 2
        progress.write_text(f"step {clock[0]}" if advances else "built")

    monkeypatch.setattr(asking, "time", SimpleNamespace(monotonic=lambda: clock[0], sleep=sleep))
    monkeypatch.setattr(asking, "_ended", lambda *_: clock[0] >= needs_s)
    with (
        nullcontext() if advances or starved else pytest.raises(JobError, match=r"nothing advanced for 180 s \(built\)")
    ):
        asking._follow(SimpleNamespace(returncode=0, pid=0), progress)
    assert (clock[0] >= needs_s) == (advances or starved)


@pytest.mark.usefixtures("unkept")
def test_the_clock_of_the_call_ends_it_whatever_its_own_would_say(monkeypatch):
    monkeypatch.setattr(asking, "STILL_S", math.inf)
    plan = crates()
    with call_time.limited(0.0), pytest.raises(CallOverError):
        simulate(plan, resolve(plan).scene, duration_s=1e4)


@pytest.mark.usefixtures("unkept")
def test_what_it_cannot_take_is_told_of_the_plan():
    plan = crates()
    with pytest.raises(RefusedLayoutError, match="the pre-roll failed"):
        simulate(plan, resolve(plan).scene, cameras=[{"measured": []}])


@pytest.mark.usefixtures("unkept")
def test_what_its_process_computes_is_counted():
    """Who tells what a call has cost asks for that, too, and not for the caller's own part alone."""
    plan = crates()
    children, before = resource.getrusage(resource.RUSAGE_CHILDREN), processor_time.spent_s()
    own = resource.getrusage(resource.RUSAGE_SELF)
    simulate(plan, resolve(plan).scene, duration_s=0.1)
    after, now = resource.getrusage(resource.RUSAGE_CHILDREN), resource.getrusage(resource.RUSAGE_SELF)
    theirs = after.ru_utime + after.ru_stime - children.ru_utime - children.ru_stime
    ours = now.ru_utime + now.ru_stime - own.ru_utime - own.ru_stime
    assert theirs > 0.05
    assert processor_time.spent_s() - before == pytest.approx(ours + theirs, abs=0.05)
