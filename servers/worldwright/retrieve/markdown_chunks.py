"""Markdown by its headings; front matter is a piece of its own."""

import re
from collections.abc import Iterator

from .chunk import Chunk, paragraphs, slug


def chunks(text: str) -> Iterator[Chunk]:
    """Cut a page."""
    lines = text.splitlines()
    headings: list[tuple[int, str]] = []
    start, anchor, fenced = 0, "top", False

    def emit(end: int) -> Iterator[Chunk]:
        body = lines[start:end]
        title = " > ".join(t for _, t in headings)
        for first, last in paragraphs(body, start + 1):
            shown = "\n".join(lines[first - 1 : last]).strip()
            if shown.strip("-# \n"):
                yield Chunk(anchor, title, first, last, shown)

    for index, line in enumerate(lines):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        match = None if fenced else re.match(r"^(#{1,6})\s+(.+?)\s*#*$", line)
        if match is None:
            continue
        yield from emit(index)
        depth, title = len(match[1]), match[2]
        while headings and headings[-1][0] >= depth:
            headings.pop()
        headings.append((depth, title))
        start, anchor = index, slug(title)
    yield from emit(len(lines))
