"""Steps come when they are due; what is late is caught up or given up, and told."""

import itertools

import pytest

from worldengine.clock.pacing import LOOK_S, MOST_BEHIND_S, Pace


class Wall:
    """A clock that nobody waits for; each part takes `cost` s of it."""

    def __init__(self, cost=0.0):
        self.now, self.cost, self.looks = 100.0, cost, []

    def __call__(self):
        return self.now

    def sleep(self, seconds):
        assert seconds > 0
        self.now += seconds


def pace(wall, between=lambda step: True, **other):
    asked = {"step_s": 0.001, "every": 10, "speed": 1.0, "most": 1000, **other}
    return Pace(**asked, between=between, clock=wall, sleep=wall.sleep)


@pytest.mark.parametrize(("speed", "steps"), [(1.0, 10), (5.0, 20), (0.1, 10)])
def test_a_second_takes_a_second_over_the_speed(speed, steps):
    wall = Wall()
    paced = pace(wall, speed=speed)
    assert list(paced) == list(range(1000)) and paced.steps == steps
    assert wall.now - 100.0 == pytest.approx((1000 - steps) / 1000 / speed)
    assert (paced.overruns, paced.lost_s, paced.jumps) == (0, 0.0, 0)


def test_steps_that_nobody_has_to_do_with_are_left_to_the_engine():
    found, paced = [], pace(Wall(), rows=64, most=203)
    for step in paced:
        found += range(step, step + 1 + paced.ahead)
        assert step % 10 == 0 or step % 64 == 0
    assert found == list(range(203))
    looked = list(pace(Wall(), rows=64, most=203, speed=5.0, steady=True))
    assert looked == [0, 20, 40, 60, 64, 80, 100, 120, 128, 140, 160, 180, 192, 200]


def test_what_is_a_little_late_is_caught_up_and_counted():
    wall = Wall()

    def slow(step):
        wall.now += 0.1 if step == 500 else 0.0
        return True

    paced = pace(wall, slow)
    assert len(list(paced)) == 1000
    assert wall.now - 100.0 == pytest.approx(0.99) and paced.lost_s == 0.0
    assert paced.overruns > 5 and paced.worst_s == pytest.approx(0.09)


def test_a_world_that_cannot_keep_up_loses_time_and_never_runs_after_it():
    wall = Wall()

    def dear(step):
        wall.now += 0.03
        return True

    paced = pace(wall, dear)
    assert len(list(paced)) == 1000 and paced.overruns > 90
    assert paced.lost_s > 1.0 and paced.worst_s < MOST_BEHIND_S + 0.04


@pytest.mark.parametrize("jump_s", [3600.0, -3600.0])
def test_a_clock_that_jumps_is_set_anew(jump_s):
    wall = Wall()

    def jumps(step):
        wall.now += jump_s if step == 500 else 0.0
        return True

    paced = pace(wall, jumps)
    assert len(list(paced)) == 1000 and paced.jumps == 1
    assert wall.now - 100.0 - jump_s == pytest.approx(0.99, abs=0.02)


def test_it_ends_when_it_is_told_to_between_two_questions():
    assert list(pace(Wall(), lambda step: step < 40)) == list(range(40))


def test_in_a_long_wait_whoever_drives_is_heard_and_may_end_it():
    wall, looks = Wall(), []

    def looked(step):
        looks.append(wall.now)
        return wall.now < 103.0

    assert list(pace(wall, looked, speed=0.01)) == [*range(30)]
    assert max(b - a for a, b in itertools.pairwise(looks)) <= LOOK_S + 1e-9
