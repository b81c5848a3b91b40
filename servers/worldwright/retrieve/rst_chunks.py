"""reStructuredText by its own structure: labels, headings, and the numbered entries of a changelog.

Not docutils: it takes 17 s for the manual's 40 pages instead of 0.8, and fails on 8,800 of their roles, which are Sphinx's.
"""

import re
from collections.abc import Iterator

from ..simulator.rst import plain
from .chunk import Chunk, paragraphs, slug

_LABEL = re.compile(r"^\.\. _([^:`]+):\s*$")
_UNDERLINE = re.compile(r"^([=\-^~\"'#*+.:_])\1{2,}\s*$")
_ENTRY = re.compile(r"^ {0,6}(?:\d+|#)\.\s+\S")


def chunks(text: str, entries: bool = False) -> Iterator[Chunk]:
    """Cut a page.

    Args:
        text: the page.
        entries: numbered list items are pieces of their own (changelog).
    """
    lines = text.splitlines()
    headings: list[tuple[str, str]] = []  # (underline character, title), outermost first
    labels: list[str] = []
    anchor, start = "top", 0

    def emit(end: int) -> Iterator[Chunk]:
        version = next((v for _, title in reversed(headings) if (v := _versioned(title))), "") if entries else ""
        yield from _chunks(lines[start:end], start + 1, version or anchor, headings, tuple(labels))

    index = 0
    while index < len(lines):
        label = _LABEL.match(lines[index])
        heading = index + 1 < len(lines) and lines[index].strip() and _UNDERLINE.match(lines[index + 1])
        overlined = bool(_UNDERLINE.match(lines[index])) and index + 2 < len(lines) and bool(lines[index + 1].strip())
        overlined = overlined and bool(_UNDERLINE.match(lines[index + 2]))
        entry = entries and _ENTRY.match(lines[index])
        if label:
            if start < index and not (labels and not _content(lines[start:index])):
                yield from emit(index)
                labels, start = [], index
            labels.append(label[1].strip())
            anchor = labels[0]
            index += 1
        elif overlined or heading:
            row = index + 1 if overlined else index
            kind = lines[row + 1].strip()[0] * (2 if overlined else 1)
            title = plain(lines[row]).strip()
            if _content(lines[start:index]):
                yield from emit(index)
                labels, start = [], index
            while headings and kind in [k for k, _ in headings]:
                headings.pop()
            headings.append((kind, title))
            if not labels:
                anchor = slug(title)
            index = row + 2
        elif entry and start < index and _content(lines[start:index]):
            yield from emit(index)
            labels, start = [], index
            index += 1
        else:
            index += 1
    yield from emit(len(lines))


def _chunks(
    lines: list[str], start: int, anchor: str, headings: list[tuple[str, str]], labels: tuple[str, ...]
) -> Iterator[Chunk]:
    while lines and not lines[-1].strip():
        lines = lines[:-1]
    while lines and not lines[0].strip():
        lines, start = lines[1:], start + 1
    title = " > ".join(t for _, t in headings)
    for first, last in paragraphs(lines, start):
        part = lines[first - start : last - start + 1]
        shown = plain("\n".join(line for line in part if not _LABEL.match(line) and not _UNDERLINE.match(line)))
        if len(shown.strip()) >= 3:
            yield Chunk(anchor, title, first, last, shown.strip("\n"), labels)


def _content(lines: list[str]) -> bool:
    """Whether there is anything besides labels, underlines and blank lines."""
    return any(line.strip() and not _LABEL.match(line) and not _UNDERLINE.match(line) for line in lines)


def _versioned(title: str) -> str:
    """`version-4-0-0` for a changelog's version heading."""
    match = re.match(r"Version (\d+(?:\.\d+)+)", title)
    return "version-" + match[1].replace(".", "-") if match else ""
