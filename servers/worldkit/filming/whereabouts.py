"""Where a world is by the words of its plan, and what stands around it then."""

from collections import Counter
from collections.abc import Iterable
from functools import partial

import numpy as np

from . import sets
from .dressing import Dressing
from .recorded import Recorded
from .sets import Place, land

INDOORS: dict[str, str] = {
    "kitchen_counter": "kitchen breakfast honey egg bread toast pan cup mug plate bowl spoon fork coffee tea milk cook fruit "
    "apple lemon soup cake dough jar counter dish butter pasta bottle glass straw",
    "laboratory": "laborator- experiment- beaker flask laser burner prism lens",
    "still_life": "pendulum spring magnet gyroscope oscillat- newton incline candle balanc- torsion cork coin top",
    "workshop": "workshop hammer nail saw drill wrench tool gear crate ladder garage screw engine bench plank pulley rope "
    "chain brick wedge lever hinge",
    "gym": "basketball court gym dumbbell barbell trampoline hoop gymnast- volleyball sport racket badminton tennis",
    "living_room": "living sofa toy cat lamp carpet book room suitcase domino marble billiard pool snooker bowling doll balloon table chair "
    "child clock vase shoe",
}
OUTDOORS: dict[str, str] = {
    "beach": "beach sand shore sea ocean wave shell surf",
    "snow_field": "snow ski sled sledge ice skat- frozen winter",
    "street": "street road asphalt car bicycle bike skateboard kerb pavement truck bus traffic scooter ladder wall house",
    "lake": "lake pond boat duck swan",
    "riverbank": "river stream brook bank bridge",
    "forest": "forest wood fir tree log axe mushroom fox",
    "mountain_side": "mountain hill slope cliff rock boulder climb- avalanche edge",
    "park": "park playground swing slide kite dog frisbee picnic tether- football soccer garden leaf branch twig breeze",
    "meadow": "meadow grass field lawn horse cow flower wind butterfly",
    "night_sky": "night star moon firework comet",
}
HOURS: dict[str, str] = {
    "night": "night midnight moonlight moonlit streetlight starlit",
    "dusk": "dusk twilight evening",
    "golden_hour": "sunset sunrise",
    "overcast": "overcast cloudy rain drizzle",
}
FALLBACK = {"room": "living_room", "outdoor": "meadow"}
SMALL_M = 0.4
"""What happens within this radius, in a room of no kind, is a still life: a room would be out of focus behind it."""
ON_A_TOP = ("kitchen_counter", "laboratory")
"""Sets whose ground is a table's top."""
LEAST_WORDS = {"studio": 2, "dark": 99}
"""A plan that chose a plain place gets another only if its words say so."""
WET = ("water", "river", "lake", "sea", "pond", "pool", "stream")
GREEN = ("grass", "turf", "lawn", "meadow", "moss")
OWN_LAND_M = 5.0
"""What stands still and is as wide as this, m, is land that the world brings itself."""


def choose(recorded: Recorded) -> str:
    """The set that suits the plan's setting, its words and the size of what happens; empty where none does."""
    wanted = dict(OUTDOORS if recorded.setting == "outdoor" else INDOORS)
    scores = _scores(recorded.words, wanted)
    least = LEAST_WORDS.get(recorded.setting, 1)
    place = Place.of(recorded, -57.0, 1)
    low = place.top - place.floor < 0.7 and place.standing < 0.8
    fit = [
        name
        for name in wanted
        if place.radius <= sets.SETS.find(name).WIDEST
        and (name not in ON_A_TOP or (low and not recorded.floor))
        and (name != "still_life" or not recorded.floor)
    ]
    best = max(fit, key=lambda name: scores[name], default="")
    if best and scores[best] >= least:
        return best
    usual = FALLBACK.get(recorded.setting, "")
    if recorded.setting == "room" and "still_life" in fit and place.radius <= SMALL_M:
        return "still_life"
    if usual in fit or recorded.setting not in FALLBACK:
        return usual
    return next((name for name in ("gym", "meadow") if name in fit), "")


def hour(recorded: Recorded) -> str:
    """The time of day that the words of a plan name, where it states no light; empty where they name none."""
    scores = Counter[str]() if recorded.light else _scores(recorded.words, HOURS)
    return max(scores, key=lambda name: scores[name]) if any(scores.values()) else ""


def _scores(words: Iterable[str], wanted: dict[str, str]) -> Counter[str]:
    found: Counter[str] = Counter()
    for name, stems in wanted.items():
        known = tuple(stems.split())
        found[name] = sum(1 for word in words if any(_means(word, stem) for stem in known))
    return found


def _means(word: str, stem: str) -> bool:
    """Whether a word is a stem or its plural; what ends in `-` begins words."""
    if stem.endswith("-"):
        return word.startswith(stem[:-1])
    return word in (stem, f"{stem}s", f"{stem}es", f"{stem.removesuffix('y')}ies")


def own_land(recorded: Recorded) -> tuple[str, ...]:
    """What stands still and is land rather than a thing that stands on it."""
    wide = []
    for name in recorded.still:
        low, high = recorded.extent(name)
        if float((high - low)[:2].max()) >= OWN_LAND_M:
            wide.append(name)
    return tuple(wide)


def countryside(film: Dressing, facing_deg: float, seed: int = 1) -> None:
    """Around a world that brings its own land: grass on what is green, trees where there is ground, hills on the horizon."""
    recorded = film.recorded
    place = Place.of(recorded, facing_deg, seed)
    wide = own_land(recorded)
    wet = [name for name in wide if any(part in WET for part in name.lower().replace("-", "_").split("_"))]
    film.mood("noon")
    film.light(azimuth_deg=facing_deg - 62, elevation_deg=38, strength=1.05)
    film.as_planned()
    reach = 1.4 * place.radius + 3.0

    def ground(x: np.ndarray, y: np.ndarray, only: str = "") -> np.ndarray:
        top, top_of = np.full(np.shape(x), recorded.floor_z - 1e-6), np.full(np.shape(x), "", dtype=object)
        for name in wide:
            height = np.nan_to_num(recorded.surface(name)(x, y), nan=-np.inf)
            higher = height > top
            top, top_of = np.where(higher, height, top), np.where(higher, name, top_of)
        bad = np.isin(top_of.astype(str), wet) | (top_of.astype(str) != only if only else np.zeros(np.shape(x), bool))
        return np.where(bad, np.nan, top)

    x0, y0 = place.middle - reach
    x1, y1 = place.middle + reach
    for name in wide:
        if any(stem in recorded.looks.get(name, "") for stem in GREEN):
            film.grass(
                f"grass on {name}", area=(x0, y0, x1, y1), height=0.13, count=60_000, look="#6f9440",
                clear_of=place.clear(0.05), z=partial(ground, only=name), seed=seed,
            )  # fmt: skip
    for kind, count, near, far, height, free in (
        ("broadleaf", 14, 1.6 * place.radius + 6.0, 2.2 * place.radius + 34.0, 8.0, 150.0),
        ("conifer", 22, 2.0 * place.radius + 25.0, 2.5 * place.radius + 80.0, 13.0, 200.0),
    ):
        spots = place.around(count, near, far, free)
        level = ground(spots[:, 0], spots[:, 1])
        good = [(float(x), float(y)) for (x, y), z in zip(spots, level, strict=True) if np.isfinite(z)]
        if good:
            film.tree(f"{kind} trees", kind, at=good, height=height, z=ground, seed=seed)
    land.range_of_hills(film, place, away=260, height=45, look="#54683f", name="hills", rough=0.4)
