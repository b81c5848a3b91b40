"""Marks that stand in a plan's text and in none of its values: prose, unfenced lines, comments, a sentence under the title.

No section reads such a line, so its question would be answered by nobody. What stands in a value is found by its path.
"""

import re
from bisect import bisect_right
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from .plan_sections import Lines, Section
from .plan_yaml import Node

PREAMBLE = "title"
"""What the lines above the first section are told by."""


class OpenMark(NamedTuple):
    """A line of a plan's text that holds a mark and belongs to no value."""

    section: str
    line: int
    """1-based."""
    text: str
    """The line without the blanks around it."""


def unread(
    mark: str, text: str, title: str, sections: Mapping[str, Section], nodes: Mapping[str, Node], lines: Lines
) -> Iterator[OpenMark]:
    """Yield each line on which `mark` stands outside of every value, in document order, once.

    Args:
        mark: what is looked for, e.g. `TO_CLARIFY`.
        text: the whole document, and its title as it was read (a value of its own).
        sections: its sections by name, with their offsets.
        nodes: the YAML tree of each section that has one.
        lines: line and column of each offset.
    """
    values = sorted(span for node in nodes.values() for span in _scalars(node))
    starts = [start for start, _ in values]
    order = sorted(sections.values(), key=lambda section: section.heading)
    headings = [section.heading for section in order]
    told = set()
    for match in re.finditer(re.escape(mark), text):
        at, number = match.start(), lines.at(match.start())
        before = bisect_right(starts, at) - 1
        if number in told or (before >= 0 and at < values[before][1]):
            continue
        first, last = lines.starts[number - 1], lines.starts[number] if number < len(lines.starts) else len(text)
        line = text[first:last].strip().lstrip("\ufeff")
        inside = bisect_right(headings, at) - 1
        if inside < 0 and mark in title and line.startswith("# "):
            continue
        told.add(number)
        yield OpenMark(order[inside].name if inside >= 0 else PREAMBLE, number, line)


def _scalars(node: Node) -> Iterator[tuple[int, int]]:
    """The characters that each scalar takes up, keys included."""
    if node.kind == "scalar":
        yield node.start, node.end
    for part in (*(node.keys or ()), *(node.items or ())):
        yield from _scalars(part)
