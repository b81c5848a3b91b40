"""Sets: one line of a film gives surroundings at true scale, around what happens and never in front of the camera."""

from pathlib import Path

import numpy as np
import pytest

from worldkit.errors import ProgramError
from worldkit.filming import Film, Recorded, sets

NAMES = sets.names()
MOST = 3_000_000


def recorded(radius: float) -> Recorded:
    t = np.linspace(0.0, 1.0, 30)[:, None]
    way = np.hstack([radius * (2 * t - 1), 0 * t, 0.1 + 0 * t])
    return Recorded.rehearsal({"ball": way}, duration=2.0, radius=0.1 * radius)


def described(name: str, radius: float, **how: float) -> tuple[dict, dict, Film]:
    film = Film(recorded(radius))
    film.set(name, **how)
    return *film.description(), film


@pytest.mark.parametrize("name", NAMES)
def test_every_set_stands_around_the_action_and_leaves_the_camera_its_side(name):
    radius = 0.4 * min(sets.SETS.find(name).WIDEST, 2.0)
    facts, arrays, film = described(name, radius)
    assert sets.SETS.find(name).__doc__ and facts["ground"] is not None and facts["air"]
    place = sets.Place.of(film.recorded, -57.0, 1)
    toward = np.array(place.spot(1.0, 0.0)[:2]) - place.middle
    triangles = 0
    for thing in facts["things"]:
        if "vertices" not in thing:
            continue
        triangles += len(arrays[thing["faces"]])
        points = arrays[thing["vertices"]] + np.array(thing["pos"])
        assert np.isfinite(points).all()
        ahead = (points[:, :2] - place.middle) @ toward
        beside = np.linalg.norm((points[:, :2] - place.middle) - ahead[:, None] * toward, axis=1)
        inside = np.linalg.norm(points[:, :2] - place.middle, axis=1) < 0.5 * radius
        tall = points[:, 2] > film.recorded.floor_z + 0.5
        assert not (inside & tall).any(), f"{thing['name']} stands in the action"
        assert not (tall & (ahead > radius) & (beside < 0.5 * ahead)).any(), f"{thing['name']} stands before the camera"
    assert triangles < MOST


def test_the_same_seed_gives_the_same_set_and_another_another():
    one, again, other = (described("meadow", 1.0, seed=seed)[1] for seed in (1, 1, 2))
    assert all(np.array_equal(one[name], again[name]) for name in one)
    assert any(not np.array_equal(one[name], other[name]) for name in one if name in other)


def test_it_turns_with_the_camera():
    here, there = (described("street", 1.0, facing_deg=facing)[0] for facing in (-57.0, 90.0))
    kerb = [next(t for t in facts["things"] if t["name"] == "kerb")["pos"] for facts in (here, there)]
    assert kerb[0] != kerb[1] and kerb[1][1] < 0  # behind, for a camera that looks from +y


def test_a_set_is_turned_by_more_than_once_around_as_by_the_rest():
    facts = [described("street", 1.0, facing_deg=facing)[0] for facing in (20.0, -700.0, 20.0 + 360 * 1000, 21.0)]
    assert facts[0] == facts[1] == facts[2] != facts[3]
    assert sets.Place.of(recorded(1.0), -57.0, 1).facing_deg == -57.0
    with pytest.raises(ProgramError):
        described("street", 1.0, facing_deg=np.inf)


def test_an_unknown_set_lists_those_that_there_are():
    with pytest.raises(ProgramError, match="no set 'moon'") as refused:
        Film(recorded(1.0)).set("moon")
    assert "living_room" in refused.value.next_move and "furniture" not in refused.value.next_move


def test_what_is_too_large_for_a_room_is_told_with_wider_sets():
    with pytest.raises(ProgramError, match="holds 4 m") as refused:
        Film(recorded(9.0)).set("living_room")
    assert "gym" in refused.value.next_move and "kitchen_counter" not in refused.value.next_move


def test_the_wall_of_a_still_life_has_the_colour_that_is_asked_for_and_others_have_none():
    facts, arrays, _ = described("still_life", 0.4, colour="#884422")
    painted = arrays[next(t for t in facts["things"] if t["name"] == "wall")["look"]["picture"]]
    assert np.allclose(painted.mean(axis=(0, 1)), (0x88, 0x44, 0x22), atol=3) and 1 < painted[..., 0].std() < 12
    assert facts["gobo"]["kind"] == "window" and facts["air"][-1]["light_softness_deg"] < 2
    with pytest.raises(ProgramError, match="no wall whose colour") as refused:
        described("beach", 1.0, colour="#884422")
    assert "still_life" in refused.value.next_move


def test_a_still_life_s_wall_is_behind_all_that_moves_or_stands_there():
    facts, arrays, _ = described("still_life", 0.4, facing_deg=-90.0)
    wall = next(t for t in facts["things"] if t["name"] == "back board")
    front = arrays[wall["vertices"]][:, 1].min()
    assert 0.03 < front < 0.4, "close behind a ball that moves along it"


def block(middle: tuple[float, float, float], half: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
    """A box that stands still: its corners, and two triangles that name them all."""
    corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * half + middle
    return corners, np.arange(9).reshape(3, 3) % 8


def front(**around: tuple[np.ndarray, np.ndarray]) -> float:
    """Where the wall of a still life begins behind a ball that moves along it, seen from -y, with what stands still around."""
    t = np.linspace(0.0, 1.0, 30)[:, None]
    ways = {"ball": np.hstack([0.3 * t - 0.15, 0 * t, 0.05 + 0 * t])}
    ways |= {"target": np.tile([0.3, 0.65, 0.05], (30, 1))} if "target" in around else {}
    still = {name: where for name, where in around.items() if name != "target"}
    film = Film(Recorded.rehearsal(ways, duration=1.0, radius=0.05, ground=still))
    film.set("still_life", facing_deg=-90.0)
    facts, arrays = film.description()
    board = next(t for t in facts["things"] if t["name"] == "back board")
    return float(arrays[board["vertices"]][:, 1].min())


def test_a_still_life_s_wall_is_behind_what_stands_still_but_not_behind_the_ground():
    alone = front()
    assert 0.05 < alone < 0.4
    assert front(target=block((0, 0, 0), (1, 1, 1))) > 0.7, "a body that stands still behind the ball"
    assert front(world=block((0, 1.2, 0.2), (0.1, 0.1, 0.2))) > 1.3, "a thing of the world itself"
    assert front(world=block((0, 0.9, 0.5), (3.0, 0.05, 0.5))) > 0.95, "a wide wall of the world"
    assert front(slab=block((0, 0, -0.1), (20, 20, 0.1))) == alone, "wide ground goes on under the wall"
    assert front(before=block((0, -9, 0.5), (0.1, 0.1, 0.5))) == alone
    with pytest.raises(ProgramError, match=r"'tower' stands 9\.1 m behind"):
        front(tower=block((0, 9, 0.5), (0.1, 0.1, 0.5)))


@pytest.mark.parametrize("name", ["laboratory", "kitchen_counter", "living_room", "workshop"])
def test_a_room_has_light_from_one_side_whose_shadows_are_seen(name):
    facts, _, _ = described(name, 0.4)
    lit = facts["air"][0]
    assert lit["light_softness_deg"] <= 3 and lit["sky_strength"] < 0.7 and lit["light_elevation_deg"] < 40


def test_what_is_said_afterwards_changes_it():
    film = Film(recorded(1.0))
    film.set("street")
    film.mood("night")
    film.ground("snow")
    facts, _ = film.description()
    assert facts["ground"] == "snow" and facts["air"][-1]["grade_exposure_stops"] == pytest.approx(0.9)


def test_the_skill_names_every_set():
    text = (Path(__file__).parents[2] / "skills/film/SKILL.md").read_text()
    assert [name for name in NAMES if f"`{name}`" not in text] == []


@pytest.mark.parametrize("hour", sets.hours.HOURS)
@pytest.mark.parametrize("name", ["street", "living_room"])
def test_a_set_has_the_light_of_its_hour_and_its_lamps_burn_after_sunset(name, hour):
    facts, _, _ = described(name, 0.6, hour=hour)
    told = {key: value for one in facts["air"] for key, value in one.items()}
    dark = hour in sets.hours.LIT
    assert (told["light_strength"] < 0.35) is (dark or (hour == "overcast" and name != "living_room"))
    assert bool(facts["lamps"]) is dark
    if name == "street":
        lit = [t for t in facts["things"] if "lit panes" in t["name"]]
        assert bool(lit) is dark and all(t["look"]["glow"] > 0 for t in lit)


def test_a_lamp_by_night_gives_the_ground_below_it_the_light_of_its_hour():
    for name in ("street",):
        facts, _, film = described(name, 1.0, hour="night")
        high = [lamp["pos"][2] - film.recorded.floor_z for lamp in facts["lamps"]]
        given = [lamp["strength"] / h**2 for lamp, h in zip(facts["lamps"], high, strict=True)]
        assert given == pytest.approx([sets.hours.BELOW] * len(given)) and len(given) <= 4


def test_the_sky_that_a_plan_states_lights_the_lamps_and_an_unknown_hour_lists_those_that_there_are():
    known = recorded(1.0)
    known.light = {"sky": "night"}
    film = Film(known)
    film.set("park")
    assert film.description()[0]["lamps"]
    with pytest.raises(ProgramError, match="hour 'evening'") as refused:
        Film(recorded(1.0)).set("park", hour="evening")
    assert "dusk" in refused.value.next_move


@pytest.mark.parametrize(("floor", "grass"), [("snow", False), ("soil", True), ("", True)])
def test_the_ground_that_a_plan_states_stays_and_no_grass_grows_on_snow(floor, grass):
    known = recorded(1.0)
    known.floor = floor
    film = Film(known)
    film.set("park")
    facts = film.description()[0]
    assert facts["ground"] == (floor or "grass")
    assert any("grass" in thing["name"] for thing in facts["things"]) is grass
    film.ground("asphalt")
    assert film.description()[0]["ground"] == "asphalt"


@pytest.mark.parametrize("name", ["living_room", "workshop", "kitchen_counter", "laboratory", "still_life"])
def test_sun_falls_through_the_panes_of_a_room_until_it_is_taken_away(name: str) -> None:
    assert described(name, 0.3)[0]["gobo"]["kind"] == "window"
    assert described(name, 0.3, hour="golden_hour")[0]["gobo"]["kind"] == "window"
    film = Film(recorded(0.3))
    film.set(name)
    film.gobo("none")
    assert "gobo" not in film.description()[0]


@pytest.mark.parametrize("hour", ["overcast", "night"])
def test_without_sun_no_panes_are_seen_on_the_floor(hour: str) -> None:
    assert "gobo" not in described("living_room", 0.3, hour=hour)[0]


def test_dried_flowers_stand_beside_what_happens_in_a_still_life_unless_it_is_bare_or_too_small() -> None:
    facts, arrays, _ = described("still_life", 0.4, facing_deg=-90.0)
    names = {thing["name"]: thing for thing in facts["things"]}
    assert {"vase", "dry stalks", "dry berries"} <= names.keys()
    wall = arrays[names["back board"]["vertices"]][:, 1].max()
    for name in ("vase", "dry stalks", "dry berries"):
        points = arrays[names[name]["vertices"]]
        assert points[:, 0].max() < -0.44 and points[:, 1].max() < wall, "beside the way of the ball, before the wall"
        assert points[:, 2].min() >= 0.0 and points[:, 2].max() < 0.7
    for facts in (described("still_life", 0.4, bare=True)[0], described("still_life", 0.05)[0]):
        assert not {thing["name"] for thing in facts["things"]} & {"vase", "dry stalks"}
