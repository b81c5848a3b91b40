"""Several pictures of one size on one sheet, each with its words in a corner."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

COLUMNS, GAP, QUALITY = 3, 4, 85


def labelled(image: "np.ndarray", label: str) -> "np.ndarray":
    """Write words in the upper left corner of a picture: uint8 (H, W, 3) RGB."""
    import cv2

    image, font = image.copy(), cv2.FONT_HERSHEY_SIMPLEX
    (width, height), _ = cv2.getTextSize(label, font, 0.5, 1)
    cv2.rectangle(image, (4, 4), (12 + width, 14 + height), (255, 255, 255), -1)
    cv2.putText(image, label, (8, 9 + height), font, 0.5, (20, 20, 20), 1, cv2.LINE_AA)
    return image


def laid_out(pictures: "list[np.ndarray]", most: int = COLUMNS) -> bytes:
    """Lay pictures of one size row by row on white, as a JPEG."""
    import cv2
    import numpy as np

    height, width, _ = pictures[0].shape
    columns = min(most, len(pictures))
    rows = -(-len(pictures) // columns)
    page = np.full((rows * (height + GAP) + GAP, columns * (width + GAP) + GAP, 3), 255, np.uint8)
    for index, picture in enumerate(pictures):
        top, left = GAP + index // columns * (height + GAP), GAP + index % columns * (width + GAP)
        page[top : top + height, left : left + width] = picture
    return cv2.imencode(".jpg", page[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, QUALITY])[1].tobytes()
