"""Who goes for the ball, who holds the order, and how players keep apart: from the state alone."""

import numpy as np

from worldkit.robots import teams

SIDE = np.array([0, 0, 1, 1])
GOALS = np.array([[10.0, 0.0], [-10.0, 0.0]])
HOMES = np.array([[-2.0, 0.0], [-6.0, 2.0], [2.0, 0.0], [6.0, -2.0]])


def wanted(at=HOMES, ball=(0.0, 0.0), able=(True,) * 4):
    return teams.order(SIDE, HOMES, GOALS, np.asarray(at, float), np.asarray(ball, float), np.asarray(able), 0.6)


def test_the_nearest_goes_for_the_ball_and_the_other_teams_nearest_bars_the_way():
    made = wanted(at=[(-1.0, 0), (-6, 2), (3.0, 0), (6, -2)])
    assert made.on_ball.tolist() == [True, False, False, False]
    assert np.allclose(made.velocity[0], (0.6, 0)), "it is behind the ball: on, to the goal"
    assert np.allclose(made.velocity[2], (-0.6, 0)), "to 1.5 m before its own goal's side of the ball"
    assert not made.velocity[[1, 3]].any(), "they are where they belong"


def test_who_stands_before_the_ball_goes_around_it():
    made = wanted(at=[(1.0, 0.1), (-6, 2), (5.0, 0), (6, -2)])
    assert made.on_ball[0] and made.velocity[0, 0] < 0 < made.velocity[0, 1], "back, by the side it is on"


def test_the_order_moves_along_with_the_ball():
    made = wanted(at=[(4.5, 0), (-6, 2), (6.5, 0.0), (6, -2)], ball=(5.0, 3.0))
    way = made.velocity[1] / np.linalg.norm(made.velocity[1])
    assert np.allclose(way, np.array((5.0, 3.0)) / np.hypot(5, 3))


def test_who_lies_is_given_no_part_and_wants_nothing():
    made = wanted(at=[(-0.6, 0), (-3, 0), (4.0, 0), (6, -2)], able=(False, True, True, True))
    assert not made.velocity[0].any() and made.on_ball.tolist() == [False, True, False, False]


def test_a_match_goes_on_where_a_whole_team_lies():
    made = wanted(at=[(-1.0, 0), (-6, 2), (3.0, 0), (6, -2)], able=(True, True, False, False))
    assert made.on_ball.tolist() == [True, False, False, False]
    assert np.allclose(made.velocity[0], (0.6, 0)), "at the goal that its own team shoots at"
    assert not wanted(able=(False,) * 4).velocity.any() and not wanted(able=(False,) * 4).on_ball.any()


def test_two_that_are_near_part():
    made = wanted(at=[(-1.0, 0), (-6, 2), (8.0, 3.0), (8.0, 3.5)], ball=(-5.0, 3.0))
    assert made.velocity[2, 1] < made.velocity[3, 1]
    far = wanted(at=[(-1.0, 0), (-6, 2), (8.0, 3.0), (8.0, 9.5)], ball=(-5.0, 3.0))
    assert far.velocity[2, 1] < 0, "alone it would come down to its place"


def test_what_is_told_is_in_the_players_own_frame():
    facing = teams.Order(np.array([[0.6, 0.0], [0.0, 0.0], [0.0, 0.05]]), np.array([0.0, 0.1, 2.0]), np.zeros(3, bool))
    told = teams.told(facing, np.array([np.pi / 2, 0.0, 0.0]))
    assert np.allclose(told[0], (0, -0.3, -0.8)), "to its right at most so fast, turning right"
    assert not told[1].any(), "there, and nearly turned: it stands"
    assert np.allclose(told[2], (0, 0.05, 0.8)), "it stands, and turns round"


def test_the_same_state_gives_the_same_orders():
    first, second = wanted(ball=(1.0, 0.3)), wanted(ball=(1.0, 0.3))
    assert (first.velocity == second.velocity).all() and (first.facing == second.facing).all()
