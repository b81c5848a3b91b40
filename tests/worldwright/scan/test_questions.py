"""Questions, plots and comparisons: answers for a reviewer who doubts a picture."""

import io
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from worldwright.model.errors import NotFoundError
from worldwright.model.evidence.reports import ExpectReport, ScanReport
from worldwright.model.evidence.run import Run
from worldwright.model.finding import Anomaly
from worldwright.scan import plots, tools
from worldwright.scan.anomalies.engine import CHECKS, run_check
from worldwright.scan.comparing import compare_reports
from worldwright.scan.known.analytic import G, bouncing, collision, resting, rolling, sliding
from worldwright.scan.known.rotation import spinning
from worldwright.scan.query.questions import answer


def interchange(trajectory, path, **more):
    np.savez(
        path, t=trajectory.t, names=np.array(trajectory.names), pos=trajectory.pos, quat=trajectory.quat,
        linvel=trajectory.linvel, angvel=trajectory.angvel, **more,
    )  # fmt: skip
    return str(path)


def test_a_braked_slide_is_told_in_numbers():
    said = answer(sliding(1.0, 0.5, seconds=4.0), "body", None)
    assert said.moved and said.moved_m == pytest.approx(1.0, rel=1e-3)  # v^2 / 2 a
    assert said.max_speed_m_s == pytest.approx(1.0) and said.max_speed_at_s == 0
    assert said.at_rest_from_s == pytest.approx(2.0, abs=0.05)
    assert said.rests_s[-1][1] == pytest.approx(4.0)
    (touch,) = said.touches
    assert (touch.other, touch.share) == ("ground", 1.0) and touch.mean_force_n == pytest.approx(G)
    assert said.touching == "yes" and said.max_force_n == pytest.approx(G)


def test_a_frozen_scene_did_not_move_and_a_spinning_top_is_not_at_rest():
    still = answer(resting(), "body", (0.5, 1.0))
    assert not still.moved and still.at_rest_from_s == 0.5 and "did not move" in still.text()
    top = answer(spinning(10.0), "body", None)
    assert top.moved and top.at_rest_from_s is None and top.max_spin_rad_s == pytest.approx(10.0)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_rest_does_not_depend_on_the_scale(scale):
    """The same world in other lengths, with times as the square root of them (Froude scaling), says the same."""
    small = sliding(1.0, 0.5, seconds=4.0)
    time = np.sqrt(scale)
    facts = replace(small.mechanics, half_extents=small.mechanics.half_extents * scale)
    large = replace(small, t=small.t * time, pos=small.pos * scale, linvel=small.linvel * scale / time, mechanics=facts)
    assert answer(large, "body", None).at_rest_from_s == pytest.approx(
        answer(small, "body", None).at_rest_from_s * time
    )


def test_what_is_dragged_without_a_velocity_is_not_at_rest():
    dragged = replace(rolling(1.0), linvel=np.zeros((1001, 1, 3)), angvel=np.zeros((1001, 1, 3)))
    said = answer(dragged, "ball", None)
    assert said.moved and said.at_rest_from_s is None
    assert any("recorded velocity says 0 m/s" in note for note in said.notes)


def test_a_window_outside_the_recording_and_an_unknown_body_are_refused():
    with pytest.raises(NotFoundError, match="nothing was recorded from 5 to 6 s") as refused:
        answer(resting(), "body", (5.0, 6.0))
    assert "0.000 to 2.000 s" in refused.value.next_move
    with pytest.raises(NotFoundError, match="no body 'nobody'"):
        answer(resting(), "nobody", None)


def test_rows_that_are_not_finite_are_told_and_left_out():
    broken = sliding(1.0)
    broken.pos[500:] = np.nan
    said = answer(broken, "body", None)
    assert np.isfinite(said.moved_m) and said.moved_m == pytest.approx(0.998, abs=0.01)
    assert "501 of 1001 rows are not finite (first at 1.000 s)" in said.notes[0]


def test_the_interchange_answers_with_what_it_holds(tmp_path):
    ball = bouncing(1.0, 0.5)
    force = np.where(ball.touching, 12.0, 0.0)
    with_force = tools.query(interchange(ball, tmp_path / "a.npz", contact_force_sum=force), "ball", "0:2")
    assert with_force.touching == "yes" and with_force.max_force_n == 12.0 and with_force.touches == ()
    assert with_force.max_force_at_s == pytest.approx(0.452, abs=0.003)
    assert "not which bodies touch" in with_force.text()
    aloft = tools.query(interchange(ball, tmp_path / "b.npz", ncon=np.zeros(len(ball.t))), "ball")
    assert aloft.touching == "no" and "touches nothing" in aloft.text()
    unsure = tools.query(interchange(ball, tmp_path / "c.npz", ncon=np.ones(len(ball.t))), "ball")
    assert unsure.touching == "unknown" and "up to 1 contacts in the scene" in unsure.text()
    bare = tools.query(interchange(ball, tmp_path / "d.npz"), "ball")
    assert bare.touching == "unknown" and bare.moved


def test_the_ground_answers_too():
    said = answer(resting(), "ground", None)
    assert not said.moved and said.touches[0].other == "body" and said.max_force_n == pytest.approx(G)
    struck = answer(collision(), "a", (0.4, 0.6))
    assert [touch.other for touch in struck.touches] == ["b"] and struck.touches[0].max_force_n == 100.0


def test_a_foreign_recording_is_measured_against_a_plan(tmp_path):
    ball = bouncing(1.0, 0.5)
    path = interchange(ball, tmp_path / "ball.npz")
    plan = Path(__file__).parents[1] / "model" / "good_plan.md"
    text = re.sub(r"(?s)## objectives.*?(?=## implementation_steps)", OBJECTIVES, plan.read_text())
    (tmp_path / "plan.md").write_text(text)
    said = tools.expect(path, str(tmp_path / "plan.md"))
    assert [o.status for o in said.objectives] == ["proved", "refuted", "visual_only", "unproved"]
    assert not said.ok
    assert said.text().splitlines()[-2] == "1 proved, 1 refuted, 1 visual only, 1 unproved"
    assert "no contacts were recorded" in said.objectives[3].reason
    with pytest.raises(NotFoundError, match="no plan beside") as refused:
        tools.expect(path)
    assert "plan" in refused.value.next_move


OBJECTIVES = """## objectives

```yaml
- claim: It falls.
  expect:
    - falls: {body: ball, min_m: 0.9}
    - bounces: {body: ball, min_count: 2, decays: true}
- claim: It is fast.
  expect:
    - reaches_speed: {body: ball, min_m_s: 50}
- claim: It is red.
  visual_only: by eye
- claim: It hits the floor.
  expect:
    - touches: {bodies: [ball, ground]}
```

"""


# -- plots ---------------------------------------------------------------------------------------------------------


def picture(png):
    import cv2

    return cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR)


def reddish(image):
    return int((image[:, :, 2].astype(int) - image[:, :, 1] > 12).sum())


@pytest.mark.parametrize("name", ["teleportation", "failure_to_settle", "spin_up", "below_ground", "energy_gain"])
def test_a_finding_is_marked_where_it_is(name):
    case = next(e for e in CHECKS.values() if e.name == name).BAD[0]()
    _, anomalies = run_check(next(e for e in CHECKS.values() if e.name == name), case.trajectory, case.context)
    mark = plots.mark(case.trajectory, anomalies[0])
    assert mark.view_s[0] <= mark.window_s[0] <= mark.window_s[1] <= mark.view_s[1]
    assert name.replace("_", " ") in mark.title and "threshold" in mark.note
    plain = picture(plots.draw(case.trajectory, mark.quantity, mark.bodies, mark.view_s))
    marked = picture(plots.draw(case.trajectory, mark.quantity, mark.bodies, mark.view_s, mark))
    assert reddish(marked) > reddish(plain) + 100
    if name != "energy_gain":
        assert mark.threshold is not None


def test_a_plot_of_a_foreign_recording_marks_its_finding(tmp_path):
    jump = sliding(1.0)
    jump.pos[600:, :, 0] += 0.5
    path = interchange(jump, tmp_path / "jump.npz")
    shown = tools.plot(path, finding="teleportation")
    assert shown.data.quantity == "position" and shown.data.bodies == ("body",)
    assert shown.pictures[0].data.startswith(b"\x89PNG") and "threshold" in shown.pictures[0].caption
    assert len(shown.pictures[0].data) < 200_000
    with pytest.raises(NotFoundError, match="no finding 'WS199'") as unknown:
        tools.plot(path, finding="WS199")
    assert "WS102:body" in unknown.value.next_move
    forces = tools.plot(interchange(jump, tmp_path / "f.npz", contact_force_sum=np.ones((1001, 1))), "contact_force")
    assert picture(forces.pictures[0].data).shape[1] > 600
    with pytest.raises(NotFoundError, match="no contacts were recorded"):
        tools.plot(path, "penetration")
    assert io.BytesIO(shown.pictures[0].data).getbuffer().nbytes > 5_000


# -- comparisons ---------------------------------------------------------------------------------------------------


def kept(tmp_path, key, blocking=(), objectives=()):
    """An iteration's reports: blocking anomalies by body, objectives as (claim, status, margin)."""
    folder = tmp_path / "evidence" / key
    folder.mkdir(parents=True)
    found = [
        Anomaly(code="WS102", name="teleportation", severity="blocking", body=b, window_s=(0, 1), measured=1, threshold=0.1, unit="m", message="it jumps")
        for b in blocking
    ]  # fmt: skip
    rows = [
        {
            "index": k, "claim": claim, "status": status, "reason": "",
            "expectations": [] if margin is None else [
                {
                    "name": "falls", "arguments": {"body": "a", "min_m": 1.0}, "measured": 1 + margin, "margin": margin,
                    "status": "holds" if margin >= 0 else "fails", "unit": "m",
                }
            ],
        }
        for k, (claim, status, margin) in enumerate(objectives)
    ]  # fmt: skip
    (folder / "scan.json").write_text(ScanReport(trajectory_sha256=key, anomalies=tuple(found)).model_dump_json())
    report = ExpectReport.model_validate({"trajectory_sha256": key, "objectives": rows})
    (folder / "expect.json").write_text(report.model_dump_json())
    return key


GOOD = [("it falls", "proved", 0.5), ("it is pretty", "visual_only", None)]


@pytest.mark.parametrize(
    ("first", "second", "better", "decided"),
    [
        (((), GOOD), ((), GOOD), "equal", "nothing"),
        ((("a",), GOOD), ((), [("it falls", "refuted", -0.5), GOOD[1]]), "second", "blocking"),
        (((), GOOD), (("a",), GOOD), "first", "blocking"),
        ((("a", "b"), GOOD), (("c",), GOOD), "second", "blocking"),
        (((), [("it falls", "refuted", -0.1), GOOD[1]]), ((), GOOD), "second", "objectives"),
        (((), GOOD), ((), [("it falls", "unproved", None), GOOD[1]]), "first", "objectives"),
        (((), GOOD), ((), [("it falls", "visual_only", None), GOOD[1]]), "first", "objectives"),
        (((), GOOD), ((), GOOD[1:]), "first", "objectives"),
        (((), GOOD), ((), [("it falls", "proved", 2.0), GOOD[1]]), "second", "margins"),
        (((), [("it falls", "refuted", -0.5)]), ((), [("it falls", "refuted", -0.1)]), "second", "margins"),
    ],
)
def test_iterations_are_ranked_by_blocking_findings_then_objectives_then_margins(
    tmp_path, first, second, better, decided
):
    run = Run(tmp_path)
    one, two = kept(tmp_path, "one", *first), kept(tmp_path, "two", *second)
    said = compare_reports(run, one, two)
    assert (said.better, said.decided_by) == (better, decided), said.text()
    assert (said.first, said.second) == ("one", "two")
    if better == "second":
        assert said.improved
    if better == "first":
        assert said.worsened
    back = compare_reports(run, two, one)
    assert back.better == {"equal": "equal", "first": "second", "second": "first"}[better]
    assert (set(back.improved) == set(said.worsened)) or decided in ("blocking", "objectives", "margins")


def test_what_got_better_and_worse_is_told_with_numbers(tmp_path):
    one = kept(tmp_path, "one", ("a",), [("it falls", "proved", 0.5), ("it lands", "proved", 0.4)])
    two = kept(tmp_path, "two", (), [("it falls", "refuted", -0.5), ("it lands", "proved", 0.4)])
    said = compare_reports(Run(tmp_path), one, two)
    assert said.improved == ("no more teleportation of a",)
    assert said.worsened == ("it falls proved before, refuted now", "falls: holds by 0.5 m, then fails by 0.5 m")
    assert "fewer blocking anomalies" in said.text()
    with pytest.raises(NotFoundError, match="iteration three was not scanned") as missing:
        compare_reports(Run(tmp_path), one, "three")
    assert "one, two" in missing.value.next_move
