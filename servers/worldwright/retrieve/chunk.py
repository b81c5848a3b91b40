"""A piece of the corpus that answers one question: an attribute, a function, a section, a changelog entry, a rule."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

MAX_CHARACTERS = 4000
"""A longer section is cut at its paragraphs; the parts share its anchor."""
WINDOW = 600
"""Characters of a window: about one thing, so that neither its words nor its meaning are thinned by what stands beside."""
LEAST = 120
"""A shorter rest joins the window before it."""
_SENTENCE = re.compile(r"(?<=[.!?:;]) (?=[A-Z`*\-\d(])")


@dataclass(frozen=True)
class Chunk:
    """One piece."""

    anchor: str
    """The label or heading it stands under; unique names come from the source where it has them."""
    title: str
    """The headings above it, outermost first, joined by ` > `."""
    start: int
    """First line in the file, 1-based."""
    end: int
    """Last line, inclusive."""
    text: str
    """What is shown and searched: the words, without markup."""
    labels: tuple[str, ...] = field(default=())
    """Every label that leads here."""


def slug(heading: str) -> str:
    """A heading as an anchor.

    >>> slug("Version 4.0.0 (November 6, 2026)")
    'version-4-0-0-november-6-2026'
    """
    return re.sub(r"[^a-z0-9]+", "-", heading.lower()).strip("-") or "top"


def paragraphs(lines: list[str], start: int) -> Iterator[tuple[int, int]]:
    """Cut lines into spans of at most `MAX_CHARACTERS`, at blank lines followed by text at the margin.

    Yields (first, last) line numbers, 1-based, `start` being the number of the first line.
    """
    first, size, margin = 0, 0, min((len(x) - len(x.lstrip()) for x in lines if x.strip()), default=0)
    for index, line in enumerate(lines):
        at_margin = bool(line.strip()) and len(line) - len(line.lstrip()) == margin
        fresh = index > first and not lines[index - 1].strip() and at_margin
        if fresh and size > MAX_CHARACTERS:
            yield start + first, start + index - 1
            first, size = index, 0
        size += len(line) + 1
    yield start + first, start + len(lines) - 1


def windows(text: str) -> list[str]:
    """Sentences gathered up to `WINDOW` characters, each run of whitespace one space; a longer sentence is cut at a space.

    A piece is found by its best window and shown whole. There is always one.
    """
    found: list[str] = []
    held = ""
    for sentence in _SENTENCE.split(" ".join(text.split())):
        while len(sentence) > WINDOW:
            end = sentence.rfind(" ", WINDOW // 2, WINDOW)
            end = end if end > 0 else WINDOW
            found += [held] if held else []
            held = ""
            found.append(sentence[:end])
            sentence = sentence[end:].strip()
        if held and len(held) + len(sentence) > WINDOW:
            found.append(held)
            held = sentence
        else:
            held = f"{held} {sentence}".strip()
    if held and found and len(held) < LEAST:
        found[-1] += f" {held}"
    elif held:
        found.append(held)
    return found or [""]
