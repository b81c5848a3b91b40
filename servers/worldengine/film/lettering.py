"""Write words on a picture: captions, and how fast the film runs and what else is not as it was, which no author can leave out."""

from bisect import bisect_right
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np

FADE_S, FADE_SHARE = 0.35, 0.25
"""A caption comes and goes within so many seconds, and within this share of the time that it stands."""
MOST_LABELS = 500
USUAL = 0.02
"""A speed this near to 1 counts as 1."""


def pace(speed: float) -> str:
    """Say how fast recorded time passes: empty at its own speed, `slow motion 1/4`, `slow motion 0.6 ×`, `fast motion 2 ×`, `held`, `backwards`."""
    if abs(speed - 1) <= USUAL:
        return ""
    if abs(speed) < 1e-6:
        return "held"
    if speed < 0:
        return f"backwards, {pace(-speed)}".removesuffix(", ")
    word, part = "fast motion" if speed > 1 else "slow motion", round(1 / speed)
    if part >= 2 and abs(speed * part - 1) < 0.015:
        return f"{word} 1/{part}"
    if speed > 1 and abs(speed - round(speed)) < 0.02:
        return f"{word} {round(speed)} ×"
    return f"{word} {speed:.2f} ×" if speed < 0.1 or 0.95 < speed < 1.05 else f"{word} {speed:.1f} ×"


def letter(
    image: "np.ndarray", film_s: float, captions: Sequence[dict[str, Any]], speed: float, again: bool, *more: str
) -> "np.ndarray":
    """Write the words of this moment on a picture: uint8 (H, W, 3) RGB.

    Args:
        image: the picture, which stays unchanged.
        film_s: time in the film, s.
        captions: `text`, `place`, `start_s`, `end_s` of each.
        speed: recorded seconds per second of film.
        again: whether the film has shown this moment before.
        more: what else the corner says; empty words are left out.
    """
    import numpy as np

    words = ", ".join(word for word in (pace(speed), "again" if again else "", *more) if word)
    active = [c for c in captions if c["start_s"] <= film_s < c["end_s"]]
    if not words and not active:
        return image
    out = np.array(image)
    for caption in active:
        since, left = film_s - caption["start_s"], caption["end_s"] - film_s
        fade = min(FADE_S, FADE_SHARE * (since + left))
        strength = float(np.clip(min(since, left) / fade + 0.08, 0.0, 1.0))
        _caption(out, caption["text"], caption["place"], strength)
    if words:
        _badge(out, words)
    return out


def _font() -> Any:
    import cv2

    return cv2.FontFace("sans")


def _extent(text: str, size: int, weight: int) -> tuple[int, int]:
    """Width of a text, and how far its letters rise, pixels."""
    import cv2

    _, _, width, _ = cv2.getTextSize((10_000, 1_000), text, (0, 0), _font(), size, weight)
    return int(width), round(0.72 * size)


def _write(
    image: "np.ndarray", text: str, at: tuple[int, int], size: int, weight: int, colour: Any, strength: float
) -> None:
    """Write letters with their foot at `at`, over a soft shadow."""
    import cv2
    import numpy as np

    mask = np.zeros(image.shape[:2], np.uint8)
    cv2.putText(mask, text, at, 255, _font(), size, weight)
    x, y, wide, high = cv2.boundingRect(mask)
    # All but the letters and their shadow, which reaches a third of their size, stays as it is.
    part = slice(max(y - size, 0), y + high + size), slice(max(x - size, 0), x + wide + size)
    image, mask = image[part], mask[part]
    if not wide:
        return
    shade = cv2.GaussianBlur(mask, (0, 0), max(size * 0.12, 0.8)).astype(np.float32) / 255 * 0.75 * strength
    letters = mask.astype(np.float32) / 255 * strength
    light = image.astype(np.float32) * (1 - shade[..., None])
    light = light * (1 - letters[..., None]) + np.asarray(colour, np.float32) * letters[..., None]
    image[...] = np.clip(light + 0.5, 0, 255).astype(np.uint8)


def _lines(text: str, size: int, weight: int, most: int) -> list[str]:
    """Break a text between words so that no line is wider than `most` pixels; its own spaces and line ends stay."""
    lines: list[str] = []
    for part in text.strip().splitlines():
        lines.append("")
        for number, word in enumerate(part.split(" ")):
            longer = f"{lines[-1]} {word}" if number else word
            if not word or not lines[-1].strip() or _extent(longer, size, weight)[0] <= most:
                lines[-1] = longer
            else:
                lines.append(word)
    return [line.rstrip() for line in lines]


def _caption(image: "np.ndarray", text: str, place: str, strength: float) -> None:
    height, width = image.shape[:2]
    size, weight = {"title": (round(height * 0.085), 600)}.get(place, (max(round(height * 0.045), 12), 450))
    lines = _lines(text, size, weight, round(width * (0.5 if place == "left" else 0.82)))
    step = round(size * 1.3)
    top = {
        "title": round(height * 0.5 - step * (len(lines) - 1) / 2 + size * 0.3),
        "top": round(height * 0.08 + size * 0.7),
        "left": round(height * 0.80 - step * (len(lines) - 1)),
        "bottom": round(height * 0.93 - step * (len(lines) - 1)),
    }[place]
    for number, line in enumerate(lines):
        x = round(width * 0.06) if place == "left" else (width - _extent(line, size, weight)[0]) // 2
        _write(image, line, (x, top + number * step), size, weight, (250, 248, 244), strength)


def _cut(text: str, size: int, weight: int, most: int) -> str:
    """A text no wider than `most` pixels: what does not fit is left out at its end, where `…` tells of it."""
    if _extent(text, size, weight)[0] <= most:
        return text
    short = [f"{text[:count].rstrip(', ')}…" for count in range(len(text))]
    return short[max(bisect_right(short, most, key=lambda one: _extent(one, size, weight)[0]) - 1, 0)]


def _badge(image: "np.ndarray", words: str) -> None:
    """Write how fast the film runs, and what fits beside it, small and without a ground in the upper right corner."""
    height, width = image.shape[:2]
    size, edge = max(round(height * 0.024), 11), round(height * 0.035)
    words = _cut(words, size, 450, width - 2 * edge)
    wide, tall = _extent(words, size, 450)
    _write(image, words, (width - edge - wide, edge + tall), size, 450, (250, 248, 244), 0.75)


def labels(told: dict[str, Any]) -> tuple[str, ...]:
    """The words that a film's description writes on things in the world.

    Raises:
        ValueError: they are no words, or too many.
    """
    found = tuple(told.get("labels", ()))
    if len(found) > MOST_LABELS or not all(isinstance(one, str) and 0 < len(one) <= 200 for one in found):
        raise ValueError("what is written on things is no list of words")
    return tuple(dict.fromkeys(found))
