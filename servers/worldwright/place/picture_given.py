"""Keep the picture that a person gave in the run's folder, beside the plan."""

import shutil
from pathlib import Path

from ..model.errors import NotFoundError

KINDS = (".png", ".jpg", ".jpeg", ".webp")
LARGEST_BYTES = 30_000_000


def keep(image: Path, folder: Path) -> Path:
    """Copy `image` into the folder as `reference` with its own ending; returns the copy.

    Raises:
        NotFoundError: there is no such file, or not every harness can show this kind of picture.
    """
    target = folder / f"reference{image.suffix.lower()}"
    if image.suffix.lower() not in KINDS or not image.is_file() or image.stat().st_size > LARGEST_BYTES:
        raise NotFoundError(
            f"{image} is no picture that can be kept: a file of at most 30 MB that ends in {', '.join(KINDS)}",
            next_move="name the file that the person gave, with its whole path",
        )
    import cv2

    if cv2.imread(str(image)) is None:
        raise NotFoundError(f"{image} cannot be read as a picture", next_move="ask the person for a PNG or JPEG of it")
    if target.is_symlink():
        target.unlink()
    if not (target.exists() and target.samefile(image)):
        shutil.copyfile(image, target)
    return target
