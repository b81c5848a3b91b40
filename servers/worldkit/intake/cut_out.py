"""A thing is cut from its ground: `python -m worldkit.intake.cut_out PICTURE OUT`, confined, as a stranger's picture is decoded.

By GrabCut (Rother, Kolmogorov, Blake, SIGGRAPH 2004) where the border of the picture is of one plain colour; it leaves `cut.png`
with transparency, or says in `result.json` why it left the picture alone.
"""

import sys
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np

from ..files import write_json

BORDER = 0.03
"""Width of the border that is looked at, as a share of the shorter side."""
PLAIN = 14.0
"""Farthest that nine tenths of the border's pixels lie from its median colour in CIE Lab, where 2.3 is just seen."""
FAR = 26.0
"""Distance in Lab from which on a pixel is likely the thing."""
ROUNDS, SEED = 4, 1
LARGEST = 1024
"""GrabCut works on no longer side than this, px; its mask is scaled up."""
LEAST, MOST = 0.005, 0.95
"""Share of the picture that a thing covers."""


def cut(picture: np.ndarray) -> tuple[np.ndarray | None, str]:
    """The picture (H, W, 4) BGRA with what is not the thing transparent; or None, and why.

    Args:
        picture: (H, W), (H, W, 3) or (H, W, 4), 8 or 16 bits, BGR.
    """
    if picture.dtype != np.uint8:
        picture = (picture / 257).astype(np.uint8)
    if picture.ndim == 2:
        picture = cv2.cvtColor(picture, cv2.COLOR_GRAY2BGR)
    if picture.shape[2] == 4:
        if (picture[..., 3] < 128).mean() > LEAST:
            return None, "it is cut out already"
        picture = picture[..., :3]
    scale = min(LARGEST / max(picture.shape[:2]), 1.0)
    small = cv2.resize(picture, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA) if scale < 1 else picture
    mask, why = _mask(np.ascontiguousarray(small))
    if mask is None:
        return None, why
    soft = cv2.GaussianBlur(mask * np.float32(255), (3, 3), 0)
    alpha = cv2.resize(soft, (picture.shape[1], picture.shape[0]), interpolation=cv2.INTER_LINEAR)
    return np.dstack([picture, np.clip(alpha, 0, 255).astype(np.uint8)]), "its ground was cut away"


def _mask(picture: np.ndarray) -> tuple[np.ndarray | None, str]:
    """Where the thing is, (H, W) 0 or 1; or None, and why."""
    high, wide = picture.shape[:2]
    edge = max(round(BORDER * min(high, wide)), 1)
    if min(high, wide) < 16:
        return None, "it is too small to be cut out"
    lab = cv2.cvtColor(picture.astype(np.float32) / 255, cv2.COLOR_BGR2Lab)
    border = np.ones((high, wide), bool)
    border[edge:-edge, edge:-edge] = False
    ground = np.median(lab[border], axis=0)
    off = np.linalg.norm(lab - ground, axis=-1)
    if np.quantile(off[border], 0.9) > PLAIN:
        return None, "its ground is not plain, and was left as it is"
    told = np.where(off > FAR, cv2.GC_PR_FGD, cv2.GC_PR_BGD).astype(np.uint8)
    told[border & (off < FAR)] = cv2.GC_BGD
    if not LEAST < (told == cv2.GC_PR_FGD).mean() < MOST:
        return None, "nothing stands out from its ground"
    cv2.setRNGSeed(SEED)
    cv2.grabCut(picture, told, (0, 0, 0, 0), np.zeros((1, 65)), np.zeros((1, 65)), ROUNDS, cv2.GC_INIT_WITH_MASK)
    likely = np.isin(told, (cv2.GC_FGD, cv2.GC_PR_FGD)).astype(np.uint8)
    opened = cv2.morphologyEx(likely, cv2.MORPH_OPEN, np.ones((3, 3), np.uint8))
    count, parts, stats, _ = cv2.connectedComponentsWithStats(opened)
    if count < 2:
        return None, "nothing stands out from its ground"
    areas = stats[:, cv2.CC_STAT_AREA].copy()
    areas[0] = 0
    # What is small beside the thing is dust of the ground.
    keep = areas > 0.02 * areas.max()
    found = keep[parts].astype(np.uint8)
    if not LEAST < found.mean() < MOST:
        return None, "nothing stands out from its ground"
    return found, ""


def main(argv: Sequence[str] | None = None) -> int:
    """Cut one file; returns the exit status."""
    file, out = (Path(word) for word in (sys.argv[1:] if argv is None else argv))
    data = np.frombuffer(file.read_bytes(), np.uint8)
    # Of a photograph the camera says in its EXIF how it was held, which `IMREAD_UNCHANGED` would leave out.
    photograph = data[:2].tobytes() == b"\xff\xd8"
    picture = cv2.imdecode(data, cv2.IMREAD_COLOR if photograph else cv2.IMREAD_UNCHANGED)
    if picture is None:
        write_json(out / "result.json", {"ok": False, "why": "it cannot be decoded"})
        return 1
    made, why = cut(picture)
    if made is not None:
        cv2.imwrite(str(out / "cut.png"), made)
    write_json(out / "result.json", {"ok": True, "why": why})
    return 0


if __name__ == "__main__":
    sys.exit(main())
