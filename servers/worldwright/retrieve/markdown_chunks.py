"""Markdown by its headings, as markdown-it finds them; what stands above the first, front matter too, is a piece of its own."""

from collections.abc import Iterator
from itertools import pairwise

from .chunk import Chunk, paragraphs, slug


def chunks(text: str) -> Iterator[Chunk]:
    """Cut a page."""
    from markdown_it import MarkdownIt

    lines = text.splitlines()
    tokens = MarkdownIt("zero").enable(["heading", "fence"]).parse("\n".join(lines))
    opened = [(token, inline.content) for token, inline in pairwise(tokens) if token.type == "heading_open"]
    starts = [0, *(token.map[0] for token, _ in opened if token.map), len(lines)]
    above: dict[int, str] = {}
    for (start, end), (depth, title) in zip(
        pairwise(starts), [(0, "top"), *((int(token.tag[1:]), title) for token, title in opened)], strict=True
    ):
        above = {level: over for level, over in above.items() if level < depth} | ({depth: title} if depth else {})
        for first, last in paragraphs(lines[start:end], start + 1):
            shown = "\n".join(lines[first - 1 : last]).strip()
            if shown.strip("-# \n"):
                yield Chunk(slug(title), " > ".join(above.values()), first, last, shown)
