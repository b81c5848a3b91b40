"""The frames of a final film that are drawn so far: they lie in a folder of their own, and outlive the pass that drew them."""

import hashlib
import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.files import write_json

from .encode import write_png
from .expected_time import Pace

if TYPE_CHECKING:
    import numpy as np

STATE = "state.json"
DRAFT, FIRST, FACTOR = 0.5, 2, 3
"""Samples a pixel of the draft, of the first round after it, and how many times more each further round takes."""
CHEAPER = 0.6
"""A sample of a finer picture takes this share of one of a draft: 1.2 s of a processor for half a sample, and 2.9 s for two."""


class Refined:
    """The frames drawn so far, with how many samples each.

    Args:
        folder: where they lie; those of another film, recording or renderer are forgotten.
        count: frames of the film.
        about: what they depend on, in one text.
    """

    def __init__(self, folder: Path, count: int, about: str) -> None:
        self._folder, self._about = folder, hashlib.sha256(about.encode()).hexdigest()
        folder.mkdir(parents=True, exist_ok=True)
        try:
            said = json.loads((folder / STATE).read_text(encoding="utf-8"))
            samples = [float(n) for n in said["samples"]] if said["about"] == self._about else []
            samples = samples if all(map(math.isfinite, samples)) else []  # else a frame would be good enough for ever
            self.pace = Pace(*(float(n) for n in said["pace"])) if samples else Pace()
        except (OSError, ValueError, KeyError, TypeError):
            samples, self.pace = [], Pace()
        self.samples = samples if len(samples) == count else [0.0] * count
        self.samples = [n if self.path(k).is_file() else 0.0 for k, n in enumerate(self.samples)]
        self.taken_over = sum(n > 0 for n in self.samples)
        """So many frames stood already."""
        self.reckoned = 0
        """So many frames of the file were reckoned between drawn ones."""

    def path(self, number: int) -> Path:
        """The file of a frame."""
        return self._folder / f"{number:05d}.png"

    def keep(self, number: int, image: "np.ndarray", samples: float) -> None:
        """Replace a frame by a better one."""
        write_png(self.path(number), image)
        self.samples[number] = samples
        pace = [self.pace.level, self.pace.dearest, self.pace.recent]
        write_json(self._folder / STATE, {"about": self._about, "samples": self.samples, "pace": pace})

    def nearest(self, number: int, shots: Sequence[range]) -> int:
        """The frame that is shown at this place: itself, or the nearest drawn of its shot, or the nearest of all."""
        drawn = [k for k, n in enumerate(self.samples) if n > 0]
        shot = next((shot for shot in shots if number in shot), range(0))
        return min([k for k in drawn if k in shot] or drawn, key=lambda k: abs(k - number))

    def read(self, number: int) -> "np.ndarray":
        """A frame that is drawn: uint8 (H, W, 3)."""
        import cv2

        image = cv2.imread(str(self.path(number)), cv2.IMREAD_COLOR)
        assert image is not None  # it was written by us
        return cv2.cvtColor(image, cv2.COLOR_BGR2RGB)

    def told(self) -> dict[str, Any]:
        """How far it has come: `samples` a pixel of the drawn frames, least and most; the number `drawn`; of these, those
        `taken_over`; those `reckoned` between them; and about how many seconds it takes to draw the rest, `rest_s`."""
        taken = [n for n in self.samples if n > 0] or [0.0]
        drawn = sum(n > 0 for n in self.samples)
        each = self.pace.recent * (CHEAPER if self.pace.level < 1 else 1.0)
        rest = 0.0  # what is reckoned so far is first drawn in the second round, after all others have had both
        if drawn < len(self.samples):
            rest = each * sum(level for n in self.samples for level in (FIRST, FIRST * FACTOR) if n < level)
            rest -= each * FIRST * (len(self.samples) - drawn)
        return {
            "samples": {"least": min(taken), "most": max(taken)},
            "drawn": drawn,
            "taken_over": self.taken_over,
            "reckoned": self.reckoned,
            "rest_s": round(rest, 1),
        }

    def text(self) -> str:
        """The same in words."""
        said, count = self.told(), len(self.samples)
        text = f"{said['drawn']} of {count} frames, {said['samples']['least']:g} to {said['samples']['most']:g} samples a pixel"
        return f"{text}; {self.reckoned} reckoned between them" if self.reckoned else text
