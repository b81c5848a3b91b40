"""Whether a skin has the size and the place of the body that it stands for: asked when film.py draws it, and by the engine."""

import numpy as np

SHARE_OF_BODY = (0.4, 2.5)
"""The size of a skin, as a share of that of the body it stands for, lies between these in each direction."""
THIN_M = 0.006
"""Where a body is thinner than this, and than a fifth of its longest side, its skin may be as if it were so thick: a leaf curls."""
REMEDY = (
    f"a skin stands for its body: give it the body's place, and {SHARE_OF_BODY[0]} to {SHARE_OF_BODY[1]} times its size; "
    f"what is thin may be up to {1e3 * SHARE_OF_BODY[1] * THIN_M:.0f} mm thick"
)


def misfit(name: str, body: str, points: np.ndarray, low: np.ndarray, high: np.ndarray) -> str:
    """What is wrong with a skin; empty when it may stand for the body.

    Args:
        name: of the skin.
        body: that it stands for.
        points: (V, 3) its vertices in the body's frame, m.
        low: (3,) the lower corner of the box around the body's shapes, in its frame, m.
        high: (3,) the upper corner.
    """
    extents = np.maximum(high - low, 1e-9)
    floor = min(THIN_M, extents.max() / 5)
    size, taken = np.ptp(points, axis=0), np.maximum(extents, floor)
    away = np.abs(0.5 * (points.min(axis=0) + points.max(axis=0) - low - high)) / taken
    # A sheet stands for a thin body, but nothing stands for it that is not even that.
    flat = size < SHARE_OF_BODY[0] * extents
    good = flat.sum() <= 1 and (extents[flat] < floor).all()
    if good and ((size < SHARE_OF_BODY[1] * taken) & (away < 0.5)).all():
        return ""
    return f"the skin {name!r} is {np.round(size / extents, 2).tolist()} times the size of {body!r}, or lies beside it"
