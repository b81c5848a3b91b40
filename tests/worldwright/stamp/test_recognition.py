"""What a stranger names blindly decides whether a world is recognised and believed."""

from types import SimpleNamespace

import pytest

from worldwright.model.errors import GateError
from worldwright.model.evidence.reports import Sighting, VisualDescription
from worldwright.model.evidence.run import Run
from worldwright.model.evidence.verdict import CrossCheck, ObjectiveVerdict, Recognition, Verdict
from worldwright.stamp import next_repair, recognition
from worldwright.stamp import tools as stamp
from worldwright.stamp.state import State

BLIND = {
    "named": (Sighting(seen="a red ball", camera="overview"),),
    "event": "it drops to the ground",
    "belief": 8,
    "betrays": ("an empty floor", "a flat sky", "no dust"),
}


def seen(**more) -> VisualDescription:
    return VisualDescription(
        author="world-visual",
        summary="something red above a floor",
        cameras={"overview": "something red", "side": "the same"},
        objects={"ball": "red, in the air"},
        **{**BLIND, **more},
    )


def passed(*recognised: Recognition, **more) -> Verdict:
    return Verdict(
        **{
            "reviewer": "world-review",
            "outcome": "pass",
            "numeric": "clean",
            "visual": "a ball",
            "plan": "bound",
            "objectives": (
                ObjectiveVerdict(index=0, met=True, evidence=("expect:falls",)),
                ObjectiveVerdict(index=1, met=True, evidence=("visual:overview",)),
            ),
            "recognised": recognised,
            "cross_checks": (CrossCheck(claim="it moves", channel="visual", tested_in="numeric", confirmed=True),),
            **more,
        }
    )


BALL = Recognition(wanted="ball", seen_as="a red ball", same=True)
EVENT = Recognition(wanted="event", seen_as="it drops to the ground", same=True)


def test_what_is_recognised_and_believed_passes(reviewed, copy):
    run = copy(reviewed)
    stamp.describe(str(run), seen())
    assert recognition.wanted(State(Run(run))) == ("ball",)
    stamp.review(str(run), passed(BALL, EVENT))
    assert State(Run(run)).review.value.outcome == "pass"


@pytest.mark.parametrize(
    ("left_out", "why"),
    [
        ({"named": ()}, "nothing is named"),
        ({"event": " "}, "nothing is said of what happens"),
        ({"belief": None}, "whether it looks real"),
        ({"betrays": ("a flat sky",)}, "1 details"),
        ({"named": (Sighting(seen="a ball", camera="above"),)}, "of which there is no picture"),
    ],
)
def test_the_visual_role_names_blindly(reviewed, copy, left_out, why):
    with pytest.raises(GateError, match=why):
        stamp.describe(str(copy(reviewed)), seen(**left_out))


@pytest.mark.parametrize(
    ("rows", "why"),
    [
        ((EVENT,), "whether `ball` was recognised"),
        ((BALL,), "whether `event` was recognised"),
        ((Recognition(wanted="ball", seen_as="a football", same=True), EVENT), "names nothing `a football`"),
        ((Recognition(wanted="ball", seen_as="a red ball", same=False), EVENT), "seen as `a red ball`"),
    ],
)
def test_a_world_that_nobody_recognises_does_not_pass(reviewed, copy, rows, why):
    run = copy(reviewed)
    stamp.describe(str(run), seen())
    with pytest.raises(GateError, match=why):
        stamp.review(str(run), passed(*rows))


def test_a_world_that_nobody_believes_gets_one_repair_of_its_look(reviewed, copy):
    run = copy(reviewed)
    stamp.describe(str(run), seen(belief=4))
    with pytest.raises(GateError, match="belief is 4 of 10: an empty floor"):
        stamp.review(str(run), passed(BALL, EVENT))
    ordered = passed(BALL, EVENT, outcome="repair", repair_target="look", repair="give it a ground")
    assert "film.py, one patch" in stamp.review(str(run), ordered).next_move
    stamp.review(str(run), passed(BALL, EVENT))
    assert State(Run(run)).review.value.outcome == "pass"


@pytest.mark.parametrize(
    ("target", "first"),
    [
        ("look", "film.py"),
        ("not_recognised", "film.py"),
        ("camera_placement", "plan.md"),
        ("plan", "plan.md"),
        ("scale", "simulation.py"),
    ],
)
def test_the_move_after_a_repair_names_the_file_that_its_target_is_in(tmp_path, target, first):
    told = next_repair.next_move(State(Run(tmp_path)), target)
    named = [name for name in ("plan.md", "film.py", "simulation.py") if name in told]
    assert min(named, key=told.index) == first


def test_copies_of_one_object_are_wanted_once(small_plan, tmp_path):
    (tmp_path / "plan.md").write_text(small_plan.replace("name: ball,", "name: ball, count: 3,", 1))
    wanted = recognition.wanted(State(Run(tmp_path)))
    assert wanted == ("ball",)


def of_plan(objects, joints=(), families=None, unwanted=()):
    """A state whose plan wants all of these objects but the unwanted ones, as far as recognition asks."""
    rows = [SimpleNamespace(type=kind, parent=parent, child=child) for kind, parent, child in joints]
    plan = SimpleNamespace(
        cameras=lambda: (SimpleNamespace(subjects=objects),),
        implementation_steps=(),
        object_names=lambda: (*objects, *unwanted),
        families=families or {},
        topology=SimpleNamespace(joints=rows),
    )
    return SimpleNamespace(plan=plan)


def test_what_is_joined_or_only_numbered_is_recognised_together():
    objects = ("stump", "leaf", "leaf_lee", "branch_1", "branch_2", "branch_3", "tuft_1")
    joints = [("weld", "leaf", "leaf_lee"), ("weld", "branch_3", "tuft_1"), ("slide", "stump", "leaf")]
    groups = recognition.together(of_plan(objects, joints))
    assert groups == (("stump",), ("leaf", "leaf_lee"), ("branch_1", "branch_2", "branch_3", "tuft_1"))
    figure = recognition.together(of_plan(("torso", "arm", "ball"), [("hinge", "torso", "arm")]))
    assert figure == (("torso", "arm"), ("ball",))


def test_what_hangs_on_one_thing_that_nobody_asked_for_is_not_one_thing():
    joints = [("weld", "ceiling", "lamp"), ("hinge", "ceiling", "fan")]
    hung = of_plan(("lamp", "fan"), joints, unwanted=("ceiling",))
    assert recognition.together(hung) == (("lamp",), ("fan",))


def test_all_that_is_not_told_is_told_at_once(reviewed, copy):
    run = copy(reviewed)
    stamp.describe(str(run), seen())
    with pytest.raises(GateError, match="whether `ball`, `event` were recognised") as refused:
        stamp.review(str(run), passed())
    assert "a red ball" in refused.value.next_move
    loud = Recognition(wanted="ball", seen_as="A red  ball", same=True)
    stamp.review(str(run), passed(loud, EVENT))


def test_before_anybody_writes_a_verdict_the_status_tells_what_it_has_to_recognise(reviewed, copy):
    run = copy(reviewed)
    (review,) = run.glob("evidence/*/review.json")
    review.unlink()
    assert "`recognised`" not in stamp.status(str(run)).text(), "nobody named anything"
    stamp.describe(str(run), seen())
    asked = "`recognised` has a row for each of ball, event; `seen_as` is copied from: a red ball; of event: it drops to the ground"
    assert asked in stamp.status(str(run)).text()


def test_a_claim_of_rest_that_fails_sends_to_the_plan_first(tmp_path):
    state = State(Run(tmp_path))
    assert "plan.md claims" in next_repair.of_anomaly(state, "WS107")
    assert next_repair.of_anomaly(state, "WS110").startswith(f"correct {state.place}/simulation.py")
