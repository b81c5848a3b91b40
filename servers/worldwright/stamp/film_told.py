"""What a stamp tells of the author's film against that film described anew: the words of a pass's result are nobody's proof."""

from collections.abc import Mapping
from typing import Any

from .statement import Filmed

SAID = ("drawn_only", "looks", "captions", "shots", "time_map")
OFTEN, FEW = 3.0, 4
"""Of frames drawn by chance something may be hidden in so many times as many as is told, and so many more: chance alone brings more than
that once in a hundred thousand films. Of a film of a dozen frames, all of which are asked, one more is enough."""


def otherwise(filmed: Filmed, said: Mapping[str, Any]) -> str:
    """The first thing that is told otherwise than the film is; empty where nothing is.

    Args:
        filmed: what is, or is to be, stamped.
        said: `film` and `hides`, as the engine tells them of the film that was described anew (`chosen_frames.each`).
    """
    film, told = said.get("film") or {}, filmed.model_dump(mode="json")
    for name in SAID:
        if name in film and not _same(told[name], film[name]):
            return (
                f"{name.replace('_', ' ')}: it is told {_short(told[name])}, and film.py describes {_short(film[name])}"
            )
    hides = said.get("hides") or {}
    looked, seconds = int(hides.get("frames", 0)), sum(float(shot["seconds"]) for shot in film.get("shots", ()))
    for what, count in sorted((hides.get("hidden") or {}).items()):
        said_s = filmed.hidden.get(what, 0.0)
        if count > OFTEN * looked * said_s / max(seconds, 1e-9) + (FEW if looked > 3 * FEW else 1):
            return f"hidden: {what} is told for {said_s:g} s, and is about {seconds * count / looked:.1f} s of the film"
    return ""


def _same(told: Any, found: Any) -> bool:
    """Whether two values of JSON are the same; numbers as nearly as they are told."""
    if isinstance(told, list) and isinstance(found, list | tuple):
        return len(told) == len(found) and all(map(_same, told, found))
    if isinstance(told, dict) and isinstance(found, dict):
        return told.keys() == found.keys() and all(_same(told[name], found[name]) for name in told)
    if isinstance(told, float | int) and isinstance(found, float | int):
        return abs(told - found) <= 1e-6 * max(1.0, abs(found))
    return bool(told == found)


def _short(value: Any) -> str:
    text = str(value) if value else "nothing"
    return text if len(text) <= 120 else f"{text[:117]}..."
