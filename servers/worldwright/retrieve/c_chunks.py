"""C and C++ by their own structure: a function with the comment above it, a struct or an enum whole.

Headers and sources are read alike: a declaration ends at its `;`, a definition at the closing brace in the first column.
"""

import re
from collections.abc import Iterator

from .chunk import MAX_CHARACTERS, Chunk

_TYPE = re.compile(r"^(?:typedef\s+)?(struct|enum|union|class)\s+(\w+)[^;]*\{")
_FUNCTION = re.compile(r"^(?!typedef|using|return|else|namespace)[A-Za-z_][\w\s*&:<>,]*?[\s*&](~?\w+)\s*\(")
_BANNER = re.compile(r"^//\s*-{4,}\s*(.+?)\s*-{4,}\s*$")
_END_NAME = re.compile(r"^\}\s*(\w+)\s*;")


def chunks(text: str) -> Iterator[Chunk]:
    """Cut a header or a source file; what is neither declared nor defined in the first column is left out."""
    lines = text.splitlines()
    section, index = "", 0
    while index < len(lines):
        line = lines[index]
        if banner := _BANNER.match(line):
            section = banner[1]
        kind = _TYPE.match(line)
        function = None if kind else _FUNCTION.match(line)
        if kind is None and function is None:
            index += 1
            continue
        last = _closing(lines, index) if kind else _ending(lines, index)
        name = kind[2].rstrip("_") if kind else function[1] if function else ""
        if kind and (closing := _END_NAME.match(lines[last])):
            name = closing[1]
        first = index
        while first > 0 and lines[first - 1].startswith("//") and not _BANNER.match(lines[first - 1]):
            first -= 1
        yield from _pieces(lines, first, last, name, section)
        index = last + 1


def _closing(lines: list[str], index: int) -> int:
    """The line of the brace that closes what opens at `index`."""
    for last in range(index, len(lines)):
        if lines[last].startswith("}") or (last == index and "}" in lines[last]):
            return last
    return len(lines) - 1


def _ending(lines: list[str], index: int) -> int:
    """The last line of a declaration or of a definition."""
    for last in range(index, min(len(lines), index + 40)):
        code = lines[last].split("//")[0].rstrip()
        if code.endswith(";"):
            return last
        if code.endswith("{"):
            return _closing(lines, last)
    return index


def _pieces(lines: list[str], first: int, last: int, name: str, section: str) -> Iterator[Chunk]:
    """A long body is cut; the parts share the name."""
    title = f"{section} > {name}" if section else name
    start, size = first, 0
    for number in range(first, last + 1):
        size += len(lines[number]) + 1
        if size > MAX_CHARACTERS and number > start:
            yield Chunk(name, title, start + 1, number, "\n".join(lines[start:number]), (name,))
            start, size = number, len(lines[number]) + 1
    yield Chunk(name, title, start + 1, last + 1, "\n".join(lines[start : last + 1]), (name,))
