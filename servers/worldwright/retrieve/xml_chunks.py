"""MJCF and other XML files: a small file whole, a large one by the children of its root."""

import re
from collections.abc import Iterator

from .chunk import MAX_CHARACTERS, Chunk

_CHILD = re.compile(r"^(?: {2}|\t|)<([A-Za-z][\w:-]*)")


def chunks(text: str, name: str) -> Iterator[Chunk]:
    """Cut at elements indented once; comments go with what follows."""
    lines = text.splitlines()
    if len(text) <= MAX_CHARACTERS:
        if text.strip():
            yield Chunk(name, name, 1, len(lines), text.strip())
        return
    start, tag = 0, name
    for index, line in enumerate([*lines, "<end"]):
        child = _CHILD.match(line)
        size = sum(len(row) + 1 for row in lines[start:index])
        if (child and size > MAX_CHARACTERS // 4) or size > MAX_CHARACTERS or index == len(lines):
            part = "\n".join(lines[start:index])
            if part.strip():
                yield Chunk(tag, f"{name} > {tag}", start + 1, index, part[: 2 * MAX_CHARACTERS])
            start, tag = index, child[1] if child else tag
