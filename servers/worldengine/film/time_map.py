"""Which recorded time a film shows when: its shots with what each leaps over, and recorded seconds in each second of film.

A shot's own speed says nothing of its cuts: many short shots that leap ahead show a slow motion fast, each at speed 1, and such
that each begin before the one before show it backwards.
"""

from typing import Any

from . import camera_roll
from .lettering import USUAL, pace

LEAST_S, SEEN_S = 1e-3, 0.05
"""A cut leaps from the first on, s, and one alone is told in the picture from the second on."""
WINDOW_S = 1.0
"""The picture tells of the cuts of so many last seconds of film."""


def leaps(film: Any) -> dict[int, float]:
    """Recorded seconds that the film leaps over by the frame that comes after the cut: ahead, or below 0 where it goes back."""
    time = film.arrays["time"]
    found: dict[int, float] = {}
    for before, shot in zip(film.shots, film.shots[1:], strict=False):
        first = shot["first"]
        step = float(time[first - 1] - time[first - 2]) if before["frames"] > 1 else 0.0
        gone = float(time[first] - time[first - 1])
        leap = gone - (max(step, 0.0) if gone > 0 else min(step, 0.0))
        if leap * gone > 0 and abs(leap) >= LEAST_S:
            found[first] = leap
    return found


def shots(film: Any, fps: float) -> list[dict[str, Any]]:
    """Each shot for the statement: `film_s`, `seconds`, `from_s`, `to_s`, `speed`; `leap_s`, `rolled_deg` and `camera` where it has any."""
    time, leapt = film.arrays["time"], leaps(film)
    rows: list[dict[str, Any]] = []
    for shot in film.shots:
        first, last = shot["first"], shot["first"] + shot["frames"] - 1
        speed = (float(time[last]) - float(time[first])) * fps / max(last - first, 1)
        row: dict[str, Any] = {"film_s": round(first / fps, 4), "seconds": round(shot["frames"] / fps, 4)}
        row |= {"from_s": round(float(time[first]), 4), "to_s": round(float(time[last]), 4), "speed": round(speed, 3)}
        row |= {"leap_s": round(leapt[first], 4)} if first in leapt else {}
        rolled = max((camera_roll.degrees(film, frame) for frame in range(first, last + 1)), key=abs)
        row |= {"rolled_deg": round(rolled, 1)} if rolled else {}
        rows.append(row | ({"camera": shot["planned"]} if shot["planned"] else {}))
    return rows


def _pace(film: Any, low: int, high: int, fps: float) -> float:
    """Recorded seconds in a second of film from one frame to a later one, cuts and all; below 0 where it comes out earlier."""
    time = film.arrays["time"]
    return float(time[high] - time[low]) * fps / (high - low)


def paces(film: Any, fps: float) -> list[dict[str, float]]:
    """The time map: from `film_s` on, for `seconds` of film, a second of it shows `pace` recorded seconds, cuts and all.

    Where cuts go back in time, `back_s` is by how many recorded seconds, however far others leap ahead.
    """
    found: list[dict[str, float]] = []
    leapt = leaps(film)
    step = max(round(fps), 1)
    for low in range(0, max(film.frames - 1, 1), step):
        high = min(low + step, film.frames - 1)
        now = round(_pace(film, low, high, fps), 2) if high > low else 0.0
        end = film.frames if high == film.frames - 1 else high  # a frame that is left over has no second of its own
        seconds = round((end - low) / fps, 4)
        back = round(-sum(leap for first, leap in leapt.items() if low < first <= high and leap < 0), 4)
        if found and found[-1]["pace"] == now and not back and "back_s" not in found[-1]:
            found[-1]["seconds"] = round(found[-1]["seconds"] + seconds, 4)
        else:
            row = {"film_s": round(low / fps, 4), "seconds": seconds, "pace": now}
            found.append(row | ({"back_s": back} if back else {}))
    return found


def words(film: Any, frame: int, fps: float) -> str:
    """What the picture says of the cuts before a frame: `1.5 s later`, `fast motion 3 × by cuts`, `2 s earlier`, `backwards by cuts`,
    `goes back by cuts`; empty where none leapt."""
    low = max(frame - round(WINDOW_S * fps), 0)
    near = [leap for first, leap in leaps(film).items() if low < first <= frame]
    if not near or sum(map(abs, near)) * fps <= USUAL * (frame - low):
        return ""
    run = _pace(film, low, frame, fps)
    if len(near) > 1 and min(near) < 0 <= run:
        return "goes back by cuts"
    if len(near) > 1 and pace(run):
        return f"{pace(run)} by cuts"
    return f"{abs(near[-1]):.2g} s {'later' if near[-1] > 0 else 'earlier'}" if abs(near[-1]) >= SEEN_S else ""
