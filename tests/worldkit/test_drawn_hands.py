"""A film's hands: they hold where they are told, go along with the body, come and go at their times, and say what they lack."""

import numpy as np
import pytest

from worldkit.errors import ProgramError
from worldkit.filming import Film, Recorded, drawn_hands, still
from worldkit.sculpt.hands import hand

WAY = np.column_stack([np.linspace(0, 0.3, 100), np.zeros(100), np.linspace(0.5, 0.2, 100)])


def described(**how):
    """The things and arrays of a film in which a hand holds a kettle."""
    film = Film(Recorded.rehearsal({"kettle": WAY}, duration=3.0))
    film.hand("kettle", at=(0, 0, 0.1), **how)
    film.shot(still((1, -1, 0.5), (0, 0, 0.3)), until=3.0)
    facts, arrays = film.description()
    return [thing for thing in facts["things"] if thing.get("of")], arrays


def test_it_goes_along_with_what_it_holds_and_is_one_thing_by_name():
    things, arrays = described(pose="fist", axis=(1, 0, 0))
    assert {thing["of"] for thing in things} == {"hand on kettle"} and len(things) == 3
    for thing in things:
        ways, times = arrays[thing["ways"]][:, 0], arrays["time"]
        there = np.stack([np.interp(times, np.linspace(0, 3, 100), WAY[:, k]) for k in range(3)], axis=1)
        assert np.allclose(ways - there, ways[0] - there[0], atol=1e-5), "it neither slips nor turns"
        assert (arrays[thing["sizes"]] == 1).all()


def test_the_palm_looks_where_it_is_told_and_the_forearm_lies_where_the_arm_comes_from():
    for side in ("left", "right"):
        things, arrays = described(pose="fist", side=side, axis=(1, 0, 0), palm=(0, 0, -1), arm=(0.2, -1.0, 0.3))
        skin, sleeve = (next(t for t in things if t["name"].endswith(end)) for end in ("skin", "sleeve"))
        w, x, y, z = arrays[skin["turns"]][0, 0]
        back = np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
        assert back @ (0, 0, 1) > 0.9, "its back is up"
        turned = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z)],
                [2 * (x * z - w * y), 2 * (y * z + w * x)],
            ]
        )
        points = arrays[sleeve["vertices"]]
        far = np.column_stack([turned, back]) @ points[np.argmin(points[:, 0])]
        assert far @ (0.2, -1.0, 0.3) / np.linalg.norm(far) / 1.063 > 0.95, side


def test_it_comes_closes_lets_go_and_leaves():
    things, arrays = described(pinch=0.02, takes=1.6, leaves=2.0)
    times, shown = arrays["time"], {}
    for thing in things:
        if "skin" in thing["name"]:
            shown[thing["name"]] = arrays[thing["sizes"]][:, 0] > 0
    seen = np.sum(list(shown.values()), axis=0)
    assert seen.max() == 1, "one pose at a time"
    assert seen[times > 0.2].all() and not seen[0], "it comes from out of sight"
    closed = shown["hand on kettle skin"]
    assert (
        closed[(times > 1.62) & (times < 1.98)].all()
        and not closed[times < 1.3].any()
        and not closed[times > 2.4].any()
    )


@pytest.mark.parametrize(
    ("how", "says"),
    [
        ({"grip": 0.3}, "holds 6 to 80 mm"),
        ({"grip": 0.02, "pinch": 0.01}, "one pose"),
        ({"pose": "fist", "axis": (0, 0, 1)}, "cannot lie on a bar"),
        ({"pose": "fist", "arm": (0, 0, 0)}, "no direction"),
        ({"pose": "fist", "takes": 2.0, "leaves": 1.0}, "leaves it at 1 s"),
        ({"pose": "wave"}, "no pose 'wave'"),
    ],
)
def test_what_it_cannot_do_is_told_with_the_next_move(how, says):
    with pytest.raises(ProgramError, match=says):
        described(**how)


def test_a_hand_on_no_body_is_refused():
    film = Film(Recorded.rehearsal({"kettle": WAY}, duration=3.0))
    with pytest.raises(ProgramError, match="kettle"):
        film.hand("ketle", pose="fist")


def test_a_grip_in_the_air_is_refused_with_where_the_body_is_in_its_own_frame():
    recorded = Recorded.rehearsal({"stick": WAY}, duration=3.0, radius=0.1 * np.sqrt(3))
    recorded.sized = True  # as of a world
    film = Film(recorded)
    film.hand("stick", at=(0.09, 0, 0), grip=0.03)
    film.hand("stick", at=(0.3, 0, 0), pose="open", name="a hand that points at it")
    with pytest.raises(ProgramError, match=r"hold the air, 0\.10 m beside 'stick'") as refused:
        film.hand("stick", at=(-0.2, 0, 0), grip=0.03, name="another")
    assert "from [-0.1, -0.1, -0.1] to [0.1, 0.1, 0.1]" in refused.value.next_move


@pytest.mark.parametrize("arm", [(-0.6, -0.7, 0.5), (0.6, 0.3, 0.4), (0.0, -0.8, 0.3), (1.0, 0.0, 0.0)])
@pytest.mark.parametrize("axis", [(0, -0.342, 0.94), (0.5, 0.0, 0.8), (0, 0, 1)])
def test_a_pen_is_held_by_a_wrist_that_is_nearly_straight(arm, axis):
    """A palm that looked down, as for a cup, turned the hand on its back."""
    closed = hand("hold_rod", 0.01)
    end, towards = (np.asarray(v, dtype=float) / np.linalg.norm(v) for v in (axis, arm))
    one = drawn_hands._easiest(closed, end, towards)
    assert drawn_hands._forearm(closed, *one) @ towards > 0.6
    turned = drawn_hands._turned(closed, *one)
    assert np.allclose(turned.T @ turned, np.eye(3), atol=1e-9) and np.linalg.det(turned) > 0
    assert np.allclose(turned @ closed.axis, end, atol=1e-9), "its tail is the upper end"


def test_a_pen_is_held_the_same_whichever_end_is_named():
    def told(way):
        film = Film(Recorded.rehearsal({"pen": np.zeros((9, 3))}, duration=1.0))
        film.hand("pen", rod=0.01, axis=way, arm=(0.6, 0.3, 0.4))
        film.shot(still((1, 0, 0), (0, 0, 0)), until=1.0)
        return film.description()[1]

    both = told((0, -0.342, 0.94)), told((0, 0.342, -0.94))
    assert all(np.array_equal(both[0][key], both[1][key]) for key in both[0])
