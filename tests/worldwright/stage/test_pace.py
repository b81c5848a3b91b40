"""Limits count progress, not the clock on the wall; what is left is told by the last steps."""

from types import SimpleNamespace

import pytest

from worldkit import law_work
from worldwright.stage.pace import WINDOW_S, Pace
from worldwright.stage.tools import start, status, wait


def test_the_time_left_is_that_of_the_last_steps():
    """A world that falls into a heap after 1000 quick steps: 100 a second, then 10."""
    pace = Pace()
    for second in range(10):
        assert pace.advanced(second, 100.0 * second)
    assert pace.left_s(2000) == pytest.approx((2000 - 900) / 100)
    for second in range(40):
        assert pace.advanced(10 + second, 1000 + 10 * second)
    assert pace.left_s(2000) == pytest.approx((2000 - 1390) / 10)
    overall = 49 * (2000 - 1390) / 1390
    assert overall < 0.4 * (2000 - 1390) / 10  # what all steps together would have promised


def test_what_stands_still_has_not_advanced_and_what_counts_anew_starts_anew():
    pace = Pace()
    assert pace.advanced(0, 5) and pace.left_s(10) is None
    assert not pace.advanced(1, 5) and pace.left_s(10) is None
    assert pace.advanced(2, 6)
    assert pace.advanced(3, 1) and pace.left_s(10) is None
    assert not pace.advanced(3 + 2 * WINDOW_S, 1)


FILMED = (
    (2.49, 0), (2.91, 0), (3.32, 0), (3.75, 0), (4.16, 0), (4.58, 0), (4.99, 0), (5.4, 0), (5.85, 0), (6.26, 1), (6.67, 7), (7.08, 14), (7.49, 18), (7.9, 30), (8.31, 35), (8.73, 44), (9.14, 49), (9.55, 60), (9.96, 64), (10.37, 78), (10.78, 84), (11.19, 99), (11.61, 105), (12.02, 110), (12.43, 113), (12.84, 127), (13.25, 134), (13.66, 146), (14.07, 153), (14.49, 166), (14.9, 172), (15.31, 179), (15.72, 193), (16.13, 209), (16.56, 215), (16.97, 220), (17.38, 226), (17.79, 240)
)  # fmt: skip
"""Progress of a real film of 240 frames, (s, frames drawn): half of its first ten seconds went into setting it up."""


def test_what_sets_a_film_up_is_no_frame():
    """After a tenth of the work the estimate is within 30 % of what it really took; with the set-up it was 3.8 times that."""
    pace, told = Pace(), []
    for now, done in FILMED:
        assert pace.advanced(now, done) or done == 0
        if 24 <= done <= 216:
            told.append(pace.left_s(240) / (FILMED[-1][0] - now))
        elif not done:
            assert pace.left_s(240) is None
    assert len(told) > 20
    assert told[0] == pytest.approx(1.0, abs=0.3)
    assert told == pytest.approx([1.0] * len(told), abs=0.35)  # its frames came by fits and starts, on a busy machine


TIRED = """
import time
import mujoco
from worldkit import program

def build():
    spec = mujoco.MjSpec()
    ball = spec.worldbody.add_body(name="ball", pos=(0, 0, 1))
    ball.add_freejoint()
    ball.add_geom(size=(0.1, 0, 0))
    return spec

def control(model, data):
    time.sleep(PAUSE if data.time < 0.001 else 0.02)

program.main(build, control, duration=DURATION)
"""


@pytest.mark.slow
def test_a_pass_that_advances_may_take_all_its_time_and_one_that_stands_still_may_not(make, finish, small_plan):
    """Each step of the first takes 20 ms, all of them more than it may stand still; the second sleeps once."""
    declared = small_plan.replace(
        "inferred: [",
        'interventions:\n  - {kind: force, bodies: [ball], law: "a breath", trigger: always, source: "a test"}\ninferred: [',
    )
    slow = TIRED.replace("PAUSE", "0.02").replace("DURATION", "0.4")
    job = finish(make(slow, "advances", declared), still_s=2.5)
    assert job.state == "succeeded" and job.wall_s > 4, job.text()
    asleep = TIRED.replace("PAUSE", "60").replace("DURATION", "0.6")
    job = finish(make(asleep, "stands", declared), still_s=2)
    assert (job.state, job.code) == ("failed", "timed_out") and "nothing advanced for 2 s" in job.message, job.text()


BALL = TIRED.replace("program.main(build, control, duration=DURATION)", "program.main(build, duration=0.02)")


def test_what_needs_a_pass_under_way_queues_and_is_what_is_waited_for(make, evidence):
    run = make(
        BALL.replace(
            "    return spec",
            '    spec.worldbody.add_camera(name="eye", pos=(0, -3, 1), xyaxes=(1, 0, 0, 0, 0, 1))\n    time.sleep(1)\n    return spec',
        )
    )
    first = start(str(run.folder))
    second = start(str(run.folder), stage="stills")
    assert (first.state, second.state) == ("queued", "queued") and second.job != first.job
    assert start(str(run.folder), stage="stills").job == second.job
    done = wait(str(run.folder), timeout_s=40)
    assert (done.job, done.state) == (second.job, "succeeded"), done.text()
    assert (evidence(run) / "stills/eye.png").is_file()


def test_what_queues_behind_a_pass_that_fails_fails_with_its_reason(make):
    run = make("import time; time.sleep(1); raise SystemExit(3)")
    first = start(str(run.folder))
    queued = start(str(run.folder), stage="stills")
    last = wait(str(run.folder), job=queued.job, timeout_s=40)
    assert (last.state, last.code) == ("failed", "refused") and "physics pass has not succeeded" in last.message
    assert wait(str(run.folder), job=first.job, timeout_s=5).state == "failed"


def test_an_audit_is_never_what_is_waited_for_unasked(make, finish):
    from worldwright.stage.tools import cancel, run_variant

    run = make(BALL)
    job = finish(run)
    beside = run_variant(run, "half-step", ("--time-step-factor", "0.5"), timeout_s=0)
    assert wait(str(run.folder), timeout_s=0.1).job == job.job == cancel(str(run.folder)).job
    shown = status(str(run.folder))
    assert [one.job for one in shown.jobs] == [job.job]
    assert wait(str(run.folder), job=beside.job, timeout_s=40).state == "succeeded"
    assert status(str(run.folder)).audits == ()


def test_what_is_left_of_a_law_that_pours_is_told_by_what_is_still_to_come():
    """1,400 steps whose cost grows with the number of points: of the first 114 the pace alone promised a twentieth."""
    law = SimpleNamespace(mass=range(100), grows=lambda first, whole: whole / first)
    told, pace, plain = law_work.shares([law], 7.0), Pace(), Pace()
    pace.spread(told)
    whole = 550.0
    for done in range(0, 115, 6):
        for one in (pace, plain):
            one.advanced(whole * (done / 1400) ** 2, done)
    left = whole * (1 - (114 / 1400) ** 2)
    assert pace.left_s(1400) == pytest.approx(left, rel=0.25)
    assert plain.left_s(1400) < left / 8


@pytest.mark.parametrize("odd", [None, "0101", [0, 2, 1], [0.0, float("nan"), 1.0], [0.5, 1.0], [1.0], {"a": 1}])
def test_a_spread_of_work_that_is_none_counts_for_nothing(odd):
    pace, plain = Pace(), Pace()
    pace.spread(odd)
    for one in (pace, plain):
        one.advanced(0, 1)
        one.advanced(1, 3)
    assert pace.left_s(10) == plain.left_s(10) == pytest.approx(3.5)


def test_laws_that_tell_nothing_of_it_or_fail_are_spread_evenly():
    def fails(first, whole):
        raise ValueError

    assert law_work.shares([SimpleNamespace(mass=[1.0])], 2.0) == []
    assert law_work.shares([SimpleNamespace(mass=[1.0], grows=fails)], 2.0) == []
    even = law_work.shares([SimpleNamespace(mass=[1.0], grows=lambda first, whole: 1.0)], 2.0)
    assert even == pytest.approx([n / law_work.PARTS for n in range(law_work.PARTS + 1)])
