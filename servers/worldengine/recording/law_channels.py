"""What a recording has of its media (an author's laws, and what solvers move), as a film's author reads it by name."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .stored import Recording

SUMS = ("mass", "energy", "stored", "volume")
"""Those of `balances` that a film may show."""
MOST_NUMBERS = 40_000_000
"""Of all points at all instants; of more, only every so-manyth instant is handed on."""


def read(recording: "Recording") -> dict[str, Any]:
    """Arrays by name, empty without a medium: `law_names`, `law_shown_by`, `law_grains`, the bodies of balls alone that show one, and of the medium with the number n its `law{n}_time` (F,) s,
    `law{n}_points` (F, P, 3) m, and of a law `law{n}_at` (S,) s with `law{n}_mass`, `_energy`, `_stored`, `_volume` (S,)."""
    import numpy as np

    from ..inputs.told_laws import moved

    if not (recording.meta.get("laws") or recording.meta.get("shown")):
        return {}
    rows, media, step = moved(recording.meta, str(recording.folder)), recording.media, recording.time_step
    medium, when, place = np.asarray(media.medium), np.asarray(media.step), np.asarray(media.place)
    thin = max(1, int(np.ceil(place.size / MOST_NUMBERS)))
    found: dict[str, Any] = {"law_names": np.array([row.name for row in rows], dtype=str)}
    found["law_shown_by"] = np.array([row.shown_by for row in rows], dtype=str)
    found["law_grains"] = np.array(_grains(recording, {row.shown_by for row in rows}), dtype=str)
    for number in range(len(rows)):
        mine, steps = place[medium == number], np.unique(when[medium == number])
        each = len(mine) // max(len(steps), 1)
        whole = len(mine) // max(each, 1)
        found[f"law{number}_time"] = steps[:whole:thin] * step
        found[f"law{number}_points"] = mine[: whole * each].reshape(whole, each, 3)[::thin].astype(np.float32)
    sums = recording.balances
    for number in range(len(recording.meta.get("laws") or ())):
        told = np.asarray(sums.medium) == number
        found[f"law{number}_at"] = np.asarray(sums.step)[told] * step
        found |= {f"law{number}_{name}": np.asarray(getattr(sums, name), float)[told] for name in SUMS}
    return found


def _grains(recording: "Recording", shown_by: set[str]) -> list[str]:
    kinds: dict[str, list[str]] = {}
    for geom in recording.meta["geoms"]:
        kinds.setdefault(str(geom["body"]), []).append(str(geom["type"]))
    return sorted(body for body in shown_by & set(kinds) if len(kinds[body]) > 1 and set(kinds[body]) == {"sphere"})
