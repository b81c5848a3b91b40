"""When a film is developed so that next to nothing is left to see: faded out, far over or under exposed, or without contrast.

A fade at either end of a film is usual, and is told only where it lasts.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .treatment import Treatment, Treatments

FADED, STOPS, FLAT = 0.9, 5.0, 0.15
"""The fade from which on, the stops of exposure beyond which, and the contrast below which a picture tells next to nothing."""
ENDS_S = 1.0
"""So long a fade at an end of the film goes untold."""


def _why(one: "Treatment") -> str:
    if one.grade_fade >= FADED:
        return "faded out"
    if abs(one.grade_exposure_stops) >= STOPS:
        return "over exposed" if one.grade_exposure_stops > 0 else "under exposed"
    return "without contrast" if one.grade_contrast <= FLAT else ""


def told(treatments: "Treatments", frames: int, fps: float) -> list[str]:
    """Such stretches of a film, for its statement: `picture faded out from 1.2 to 1.3 s of the film`."""
    if not treatments.told:
        return []
    found, first = [], 0
    of: Callable[[int], str] = lambda frame: _why(treatments.at(frame / fps)) if frame < frames else ""  # noqa: E731
    before = of(0)
    for frame in range(1, frames + 1):
        if (now := of(frame)) == before and frame < frames:
            continue
        at_end = first == 0 or frame == frames
        if before and not (at_end and before == "faded out" and (frame - first) / fps <= ENDS_S):
            found.append(f"picture {before} from {first / fps:.3g} to {frame / fps:.3g} s of the film")
        first, before = frame, now
    return found
