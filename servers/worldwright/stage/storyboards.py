"""Storyboards: the moments of a recording that they show, as words for the engine's command line, and their sheets."""

from collections.abc import Sequence
from pathlib import Path

from ..model.errors import NotFoundError
from ..model.evidence.reports import EvidenceKey
from ..model.evidence.run import Run
from ..model.picture import Illustrated, Picture
from . import gates, moments
from .pictures import BUDGET_BYTES, Shown


def arguments(run: Run, key: EvidenceKey, claimed: Sequence[tuple[float, str]] = ()) -> tuple[str, ...]:
    """The moments of the existing storyboard, else those of the recording.

    Args:
        run: the run.
        key: the hashes of its program, plan and environment.
        claimed: (instant in s, name) of the objectives that came true.

    Raises:
        GateError: physics has not passed.
    """
    if (earlier := gates.passed(run, key, "storyboard")) is not None:
        return tuple(earlier.get("arguments", ()))
    gates.require(run, key, "storyboard")
    found = moments.of_recording(run.evidence(key) / "physics" / "trajectory")
    shown = moments.storyboard(found, claimed)
    return tuple(text for at, word in shown for text in ("--moment", f"{at:.4f}:{word}"))


def shown(evidence: Path, camera: str | None) -> Illustrated:
    """The sheets of one key's storyboard, made smaller if they are too large together to be sent.

    Raises:
        NotFoundError: there is none, or none of that camera.
    """
    sheets = {path.stem: path.read_bytes() for path in sorted((evidence / "storyboard").glob("*.jpg"))}
    if not sheets or camera not in (None, *sheets):
        known = f"cameras: {', '.join(sheets)}" if sheets else "run the storyboard pass"
        what = f"of a camera '{camera}'" if sheets else "for this program and plan"
        raise NotFoundError(f"there is no storyboard {what}", place=str(evidence), next_move=known)
    chosen = {name: data for name, data in sheets.items() if camera in (None, name)}
    total = sum(map(len, chosen.values()))
    if total > BUDGET_BYTES:
        chosen = {name: _smaller(data, BUDGET_BYTES / total) for name, data in chosen.items()}
    pictures = tuple(Picture(data, f"{name}: storyboard, row by row", "jpeg") for name, data in chosen.items())
    return Illustrated(Shown(cameras=tuple(chosen), captions=tuple(p.caption for p in pictures)), pictures)


def _smaller(data: bytes, share: float) -> bytes:
    """A JPEG of about this share of the bytes."""
    import cv2
    import numpy as np

    image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
    assert image is not None  # it is one of our own
    small = cv2.resize(image, None, fx=share**0.5, fy=share**0.5, interpolation=cv2.INTER_AREA)
    return cv2.imencode(".jpg", small, [cv2.IMWRITE_JPEG_QUALITY, 75])[1].tobytes()
