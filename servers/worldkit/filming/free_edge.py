"""Where words stand in no mover's way: at the lower edge of the picture, or at its upper one."""

import numpy as np

BAND = 0.76
"""Words stand further from the middle than this, which is 0 there and 1 at the edge; so wide are they, too."""
OFTEN = 0.1
"""What is among the words in a smaller share of the pictures does not count."""


def chosen(
    eye: np.ndarray, target: np.ndarray, fovy_deg: np.ndarray, places: np.ndarray, radii: np.ndarray, aspect: float
) -> str:
    """`bottom`, unless movers are there more often than at the top: then `top`.

    Args:
        eye, target: of the camera in each picture (F, 3), m.
        fovy_deg: its lens (F,).
        places: the movers' (F, N, 3), m.
        radii: theirs (N,), m.
        aspect: of the picture, its width over its height.
    """
    ahead = target - eye
    away = np.linalg.norm(ahead, axis=1, keepdims=True)
    ahead = ahead / np.maximum(away, 1e-9)
    side = np.cross(ahead, [0.0, 0.0, 1.0])
    side /= np.maximum(np.linalg.norm(side, axis=1, keepdims=True), 1e-9)
    up = np.cross(side, ahead)
    own = places - eye[:, None]
    depth = np.einsum("fnk,fk->fn", own, ahead)
    reach = np.maximum(depth, 1e-6) * np.tan(np.radians(fovy_deg) / 2)[:, None]
    x, y = np.einsum("fnk,fk->fn", own, side) / reach / aspect, np.einsum("fnk,fk->fn", own, up) / reach
    tall = radii / reach
    among = (depth > 0) & (np.abs(x) < BAND) & (np.abs(y) < 1 + tall)
    low = float((among & (y - tall < -BAND)).any(axis=1).mean())
    high = float((among & (y + tall > BAND)).any(axis=1).mean())
    return "top" if low > max(high, OFTEN) else "bottom"
