"""`Labelled`: plates with words that stand in the world, drawn only."""

import numpy as np

from ..errors import ProgramError
from .drawn_only import Surface, Vec3, rgb
from .dressing import Dressing

ROWS = 160
"""Pixels of a plate's height; its letters take half of it."""
MOST = 40


class Labelled(Dressing):
    """What a film dresses the world with, and what is written on it."""

    def label(
        self,
        text: str,
        pos: Vec3,
        *,
        height: float = 0.03,
        facing_deg: float = -57.0,
        colour: str = "#26231f",
        ink: str = "#efe6d2",
        to: str = "",
        name: str = "",
    ) -> None:
        """A plate with one line of words, drawn only: `height` m high, as wide as they need, its middle at `pos` (m).

        It stands upright and faces `facing_deg`, the azimuth that the camera looks from, in the world or fixed `to` a body, in
        whose frame its place and azimuth are then. It is called `name`, or by its words; the
        statement has these as it has captions.

        Raises:
            ProgramError: it has no words or more than 40 letters, or no height.
        """
        words = text.strip() if isinstance(text, str) else ""
        if not 0 < len(words) <= MOST or not words.isprintable() or not 0 < height < np.inf:
            raise ProgramError(
                f"a label has 1 to {MOST} letters in one line and a height, not {text!r} of {height} m",
                "film.py",
                "film.label('KINETIC', (0.3, 0, 0.02))",
            )
        picture = _written(words, colour, ink)
        wide, thick = height * picture.shape[1] / picture.shape[0], 0.15 * height
        x, z = wide / 2, height / 2
        front = np.array([(-x, 0, -z), (x, 0, -z), (x, 0, z), (-x, 0, z)]) - [0, thick / 2 + 0.01 * height, 0]
        uv = np.array([(0, 1), (1, 1), (1, 0), (0, 0)], dtype=float)
        title, yaw = name or words, facing_deg + 90.0
        self.draw(
            f"{title} plate", "box", (wide, thick, height), pos=pos, yaw_deg=yaw, look=Surface(colour=colour), to=to
        )
        self.mesh(
            title, front, np.array([(0, 1, 2), (0, 2, 3)]), uv=uv, pos=pos, yaw_deg=yaw, to=to,
            look=Surface(picture=picture, roughness=0.5),
        )  # fmt: skip
        self._labels.append(words)


def _written(words: str, colour: str, ink: str) -> np.ndarray:
    """Words in the middle of a plate, uint8 (H, W, 3)."""
    import cv2

    font, size = cv2.FontFace("sans"), ROWS // 2
    _, _, across, _ = cv2.getTextSize((10_000, 1_000), words, (0, 0), font, size, 600)
    letters = np.zeros((ROWS, int(across) + ROWS), np.uint8)
    cv2.putText(letters, words, (ROWS // 2, round(ROWS / 2 + 0.36 * size)), 255, font, size, 600)
    share = letters[..., None] / 255
    return np.round(255 * ((1 - share) * rgb(colour) + share * rgb(ink))).astype(np.uint8)
