"""Where words stand in no mover's way: at the lower edge of the picture, or at its upper one."""

import numpy as np

BAND = 0.76
"""Words stand further from the middle than this, which is 0 there and 1 at the edge; so wide are they, too."""
OFTEN = 0.1
"""What is among the words in a smaller share of the pictures does not count."""


def chosen(
    eye: np.ndarray, axes: np.ndarray, fovy_deg: np.ndarray, places: np.ndarray, radii: np.ndarray, aspect: float
) -> str:
    """`bottom`, unless movers are there more often than at the top: then `top`.

    Args:
        eye: of the camera in each picture (F, 3), m.
        axes: right, up and back of it (F, 3, 3), as columns.
        fovy_deg: its lens (F,).
        places: the movers' (F, N, 3), m.
        radii: theirs (N,), m.
        aspect: of the picture, its width over its height.
    """
    own = (places - eye[:, None]) @ axes
    depth = -own[..., 2]
    reach = np.maximum(depth, 1e-6) * np.tan(np.radians(fovy_deg) / 2)[:, None]
    x, y = own[..., 0] / reach / aspect, own[..., 1] / reach
    tall = radii / reach
    among = (depth > 0) & (np.abs(x) < BAND) & (np.abs(y) < 1 + tall)
    low = float((among & (y - tall < -BAND)).any(axis=1).mean())
    high = float((among & (y + tall > BAND)).any(axis=1).mean())
    return "top" if low > max(high, OFTEN) else "bottom"
