"""An emitter's puffs leave where, when and as fast as it says, and are the same each time."""

import numpy as np
import pytest

from worldkit.errors import ProgramError
from worldkit.filming import Film, Recorded, still


def told(**words):
    film = Film(Recorded.rehearsal({"ball": np.zeros((10, 3))}, duration=1.0))
    given = {"rate": 100.0, "speed": 2.0, "drag": 4.0, "life": 0.5, "turbulence": 0.0, "spread_deg": 0.0, **words}
    film.emit("mist", (0.0, 0.0, 1.0), **given)
    film.shot(still((0, -3, 1), (0, 0, 1)), until=1.0)
    facts, arrays = film.description()
    assert facts["puffs"][0]["name"] == "mist"
    return arrays["time"], *(arrays[f"puffs0_{what}"] for what in ("places", "wide", "opaque"))


def test_they_leave_at_its_rate_and_go_no_further_than_their_drag_lets_them() -> None:
    time, places, wide, opaque = told()
    alive = (wide > 0).sum(axis=1)
    assert alive[0] == 0 and np.abs(alive[time > 0.55] - 50).max() <= 3  # rate times life
    height = np.where(wide > 0, places[..., 2], 1.0)
    assert height.min() >= 1.0 and 1.0 + 0.3 < height.max() < 1.0 + 1.25 * 2.0 / 4.0
    assert opaque.max() <= 0.12 and (opaque[wide == 0] == 0).all()
    assert all((one == other).all() for one, other in zip(told()[1:], (places, wide, opaque), strict=True))


def test_where_a_puff_comes_from_is_asked_once_and_not_in_every_frame() -> None:
    film = Film(Recorded.rehearsal({"ball": np.zeros((10, 3))}, duration=1.0))
    asked = []
    film.emit("mist", lambda times: (asked.append(len(times)), np.zeros((len(times), 3)))[1], rate=100.0, life=0.5)
    film.shot(still((0, -3, 1), (0, 0, 1)), until=1.0)
    film.description()
    assert sum(asked) <= 100 * 1.5 + 2  # those that left, and one life of seats not yet taken


def test_they_ebb_with_its_rate() -> None:
    time, _, wide, _ = told(rate=lambda t: 200.0 * (t < 0.4))
    assert (wide[time > 0.92] == 0).all() and (wide[np.abs(time - 0.35) < 0.05] > 0).any()


@pytest.mark.parametrize(
    ("words", "said"), [({"rate": 1e7}, "puffs at once"), ({"speed": np.nan}, "nowhere"), ({"life": -1.0}, "life")]
)
def test_what_cannot_be_is_refused(words, said) -> None:
    with pytest.raises(ProgramError, match=said):
        told(**words)


def test_too_many_are_refused_before_they_are_reckoned() -> None:
    film = Film(Recorded.rehearsal({"ball": np.zeros((10, 3))}, duration=200.0))
    asked = []
    film.emit("mist", lambda times: asked.append(len(times)), rate=150_000.0, life=1.0)
    film.shot(still((0, -3, 1), (0, 0, 1)), until=100.0)
    with pytest.raises(ProgramError, match="150001 puffs at once in 2400 frames"):
        film.description()
    assert asked == []


def test_the_hundred_and_first_is_refused_in_words() -> None:
    film = Film(Recorded.rehearsal({"ball": np.zeros((10, 3))}, duration=1.0))
    for number in range(100):
        film.emit(f"mist {number}", (0, 0, 1))
    with pytest.raises(ProgramError, match="'mist 100' is one too many"):
        film.emit("mist 100", (0, 0, 1))


def test_puffs_are_torn_by_eddies_of_one_size_but_for_those_that_are_told_to_stay_even() -> None:
    film = Film(Recorded.rehearsal({"ball": np.zeros((10, 3))}, duration=1.0))

    def at(times):
        return np.zeros((len(times), 2, 3)), 0.1 + 0.1 * times[:, None] * np.ones(2), np.full((len(times), 2), 0.3)

    film.puffs("steam", at)
    film.puffs("glow", at, even=True)
    film.emit("mist", (0.0, 0.0, 1.0))
    film.shot(still((0, -3, 1), (0, 0, 1)), until=1.0)
    assert [one["eddies_m"] for one in film.description()[0]["puffs"]] == [0.125, 0.0, 0.0625]
