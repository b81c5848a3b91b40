"""A film that fails on a world that stands still: whose fault that is."""

from collections.abc import Callable

import numpy as np
import pytest

from worldkit.errors import ProgramError
from worldkit.filming import Film, Recorded, lacking_motion, still

ARRAYS = {
    "time": np.linspace(0.0, 1.0, 61),
    "pos": np.zeros((61, 1, 3)),
    "quat": np.tile([1.0, 0.0, 0.0, 0.0], (61, 1, 1)),
    "middle": np.zeros((1, 3)),
    "half": np.full((1, 3), 0.1),
    "bodies": np.array(["ball"]),
    "cameras": np.array([], str),
    "movers": np.array(["ball"]),
    "fps": np.array(24),
    "size": np.array([64, 36]),
    "floor_z": np.array(0.0),
    **{f"touch_{name}": np.zeros(0) for name in ("time", "a", "b", "force")},
}


def shot(film: Film) -> None:
    film.shot(still((1, 0, 1), (0, 0, 0)), until=1.0)


def by_its_way(film: Film) -> None:
    way = film.recorded.position("ball", np.array([0.0, 1.0]))
    ahead = np.diff(way, axis=0)[0]
    with np.errstate(invalid="ignore"):
        ahead = ahead / np.linalg.norm(ahead)
    film.draw("arrow", "box", (0.1, 0.1, 0.1), pos=tuple(ahead))
    shot(film)


def by_its_touch(film: Film) -> None:
    first = film.recorded.touches("ball")[0]
    film.shot(still((1, 0, 1), (0, 0, 0)), until=first.time_s)


def too_many(film: Film) -> None:
    speed = film.recorded.speed("ball", 0.5)
    film.particles("dust", lambda t: np.zeros((len(t), 10_001, 3)) + speed)
    shot(film)


def misspelt(film: Film) -> None:
    film.recorded.touches()
    film.shoot()  # type: ignore[attr-defined]


def boils(film: Film) -> float:
    """When the kettle boils: never, in a world that stands still."""
    times = np.linspace(0.0, 1.0, 11)
    moved = film.recorded.position("ball", times)[:, 0] > 9.0
    return float(times[moved.argmax()]) if moved.any() else 1.0


def from_no_moment_on(film: Film) -> None:
    film.shot(still((1, 0, 1), (0, 0, 0)), until=1.0)
    film.shot(still((1, 0, 1), (0, 0, 0)), start=boils(film), until=1.0)


def failure(told: Callable[[Film], None]) -> tuple[Exception, bool]:
    film = Film(Recorded(ARRAYS))
    try:
        told(film)
        film.description()
    except Exception as failed:
        assert film.recorded.asked_of_motion
        return failed, lacking_motion.may_hold(failed, told, ARRAYS)
    raise AssertionError("it does not fail")


@pytest.mark.parametrize(
    ("told", "kind"), [(by_its_way, ProgramError), (by_its_touch, IndexError), (from_no_moment_on, ProgramError)]
)
def test_what_the_missing_motion_may_have_done_is_no_fault_of_the_film(told, kind) -> None:
    error, may_hold = failure(told)
    assert isinstance(error, kind) and may_hold


@pytest.mark.parametrize(("told", "said"), [(too_many, "at most 10000"), (misspelt, "shoot")])
def test_what_no_motion_mends_is(told, said) -> None:
    error, may_hold = failure(told)
    assert said in str(error) and not may_hold


def test_who_moves_is_motion_where_the_plan_names_nobody() -> None:
    nobody = ARRAYS | {"movers": np.array([], str)}
    film = Film(Recorded(nobody))
    with pytest.raises(IndexError) as failed:
        film.recorded.movers[0]
    assert film.recorded.asked_of_motion
    assert lacking_motion.may_hold(failed.value, lambda film: film.recorded.movers[0], nobody)
    named = Recorded(ARRAYS)
    assert named.movers == ("ball",) and not named.asked_of_motion
    named.into("ball", np.zeros((1, 3)))
    assert named.asked_of_motion


def steaming(film: Film) -> None:
    film.emit("steam", (0.0, 0.0, 1.0), start=boils(film))
    film.emit("mist", (0.0, 0.0, 1.0), rate=lambda times: 100.0 * (times > boils(film)))
    film.emit("dust", (0.0, 0.0, 1.0))
    shot(film)


def test_what_streams_from_a_moment_on_that_never_comes_is_left_out_where_nothing_moves_yet() -> None:
    """Before, the film was refused: 'steam' would have 0 puffs at once, from 1 s to 1 s."""
    film = Film(Recorded(ARRAYS))
    film.recorded.unmoved = True
    steaming(film)
    assert [one["name"] for one in film.description()[0]["puffs"]] == ["dust"]
    with pytest.raises(ProgramError, match="puffs at once, from 1 s to 1 s"):
        steaming(Film(Recorded(ARRAYS)))


def test_what_is_told_to_last_for_no_time_is_refused_there_too() -> None:
    film = Film(Recorded(ARRAYS))
    film.recorded.unmoved = True
    with pytest.raises(ProgramError, match="puffs at once"):
        film.emit("steam", (0.0, 0.0, 1.0), start=0.5, until=0.5)
