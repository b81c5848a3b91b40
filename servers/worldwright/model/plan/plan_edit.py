"""Changing values in a plan without touching anything else.

An edit is a set of splices: each replaces the characters of one value, or inserts one `key: value`. Comments, order,
prose, blank lines, quoting and line ends of everything else survive byte for byte. The result is read back before it
is returned, so that an edit that would damage the document cannot happen.
"""

from collections.abc import Iterable
from copy import deepcopy
from dataclasses import dataclass
from typing import Any

from ..errors import PlanError
from .plan_problems import dotted
from .plan_text import BARE, PlanDocument, parse_plan
from .plan_yaml import Node, inline

Path = tuple[str | int, ...]
_WIDTH = 110
"""A flow mapping that would become longer than this continues on a new line."""


@dataclass(frozen=True)
class _Splice:
    start: int
    end: int
    text: str


def edit(document: PlanDocument, changes: Iterable[tuple[Path, Any]]) -> str:
    """The document's text with values set.

    Args:
        document: the plan as it was read.
        changes: (path, value) pairs; a path starts with the section. The mapping that the last key belongs to must
            exist (or the section must be empty); the key itself need not.

    Raises:
        PlanError: a path leads nowhere, or the changed text would not be a plan any more (`findings` says why).
        ValueError: a value that YAML cannot hold.
    """
    wanted = {path: value for path, value in changes if not _same(_value(document, path), value)}
    if not wanted:
        return document.text
    splices: list[_Splice] = []
    additions: dict[Path, list[tuple[str, Any]]] = {}
    for path, value in wanted.items():
        node = _node(document, path)
        if node is not None:
            splices += _replace(document, node, value)
        else:
            additions.setdefault(path[:-1], []).append((str(path[-1]), value))
    for parent, pairs in additions.items():
        splices.append(_add(document, parent, pairs))
    text = document.text
    for splice in sorted(splices, key=lambda s: (s.start, s.end), reverse=True):
        text = text[: splice.start] + splice.text + text[splice.end :]
    _verify(document, parse_plan(text, document.file), wanted)
    return text


def _verify(before: PlanDocument, after: PlanDocument, wanted: dict[Path, Any]) -> None:
    """The new document holds exactly the old values and the new ones."""
    data = {name: deepcopy(node.data()) for name, node in before.nodes.items()}
    for path, value in wanted.items():
        section = str(path[0])
        if len(path) == 1:
            data[section] = value
            continue
        if isinstance(data.get(section), str):  # a bare word became a block
            data[section] = {str(BARE[section]): data[section]}
        owner = data.setdefault(section, {})
        for part in path[1:-1]:
            owner = owner[part]
        owner[path[-1]] = value
    for name, expected in data.items():
        found = after.nodes[name].data() if name in after.nodes else None
        if isinstance(found, str) and isinstance(expected, dict):
            found = {str(BARE[name]): found}
        if not _same(found, expected):
            raise PlanError(
                f"the edit of section `{name}` would not read back as meant; nothing was changed",
                place=before.file,
                next_move="write the section as a plain ```yaml block in block style",
            )


def _same(left: Any, right: Any) -> bool:
    """Equal as plan data: tuples are lists, 1 is 1.0, but true is not 1."""
    if isinstance(left, bool) or isinstance(right, bool):
        return left is right
    if isinstance(left, dict) and isinstance(right, dict):
        return left.keys() == right.keys() and all(_same(left[key], right[key]) for key in left)
    if isinstance(left, list | tuple) and isinstance(right, list | tuple):
        return len(left) == len(right) and all(map(_same, left, right))
    return bool(left == right)


_MISSING = object()


def _node(document: PlanDocument, path: Path) -> Node | None:
    try:
        node = document.node(str(path[0]), *path[1:])
    except KeyError:
        if path[0] in document.nodes and len(path) == 2 and path[1] == BARE.get(str(path[0])):
            bare = document.nodes[str(path[0])]
            return bare if bare.kind == "scalar" else None
        return None
    return node


def _value(document: PlanDocument, path: Path) -> Any:
    node = _node(document, path)
    return _MISSING if node is None else node.data()


def _replace(document: PlanDocument, node: Node, value: Any) -> list[_Splice]:
    """Replace a value; inside a mapping with the same keys, or a list as long, only what differs."""
    if isinstance(value, dict) and node.kind == "mapping" and {k.scalar for k in node.keys or ()} == value.keys():
        pairs = [(item, value[key.scalar]) for key, item in node.pairs()]
    elif isinstance(value, list | tuple) and node.kind == "sequence" and len(node.items or ()) == len(value):
        pairs = list(zip(node.items or (), value, strict=True))
    else:
        return [_Splice(node.start, node.end, _fitting(document, node, value))]
    return [s for item, new in pairs if not _same(item.data(), new) for s in _replace(document, item, new)]


def _fitting(document: PlanDocument, node: Node, value: Any) -> str:
    """The new text of a value, with the white space that its place needs."""
    if node.form in ("bare", "bullets") and isinstance(value, str):
        return " ".join(value.split())
    text = inline(value)
    before = document.text[node.start - 1 : node.start]
    if node.form == "literal":  # its span runs to the end of its last line
        return text + _newline(document, node.start)
    if node.kind == "sequence" and node.form == "block":  # a block list may stand as far left as its key
        return f"  {text}"
    return f" {text}" if node.start == node.end and before == ":" else text


def _add(document: PlanDocument, parent: Path, pairs: list[tuple[str, Any]]) -> _Splice:
    """Insert keys behind the last one of a mapping."""
    if not parent or parent[0] not in document.sections:
        raise PlanError(
            f"there is no section `{dotted(parent)}`", place=document.file, next_move="add its heading first"
        )
    node = _node(document, parent)
    if node is None and len(parent) == 1:
        return _new_block(document, str(parent[0]), pairs)
    if node is not None and node.form == "bare":
        lines = [f"{BARE[str(parent[0])]}: {node.scalar}", *_rendered(pairs)]
        newline = _newline(document, node.start)
        line_start, line_end = _line_around(document.text, node.start)
        return _Splice(line_start, line_end, newline.join(["```yaml", *lines, "```"]))
    if node is None or node.kind != "mapping":
        raise PlanError(
            f"`{dotted(parent)}` is not a mapping, so no key can be added to it",
            place=document.file,
            next_move="write it as a mapping first",
        )
    if node.form == "flow":
        return _add_to_flow(document, node, pairs)
    newline = _newline(document, node.start)
    if node.form == "bullets":
        prefix = "- "
        indent = _column(document.text, (node.keys or [node])[-1].start) - len(prefix)
    else:
        prefix, indent = "", _column(document.text, (node.keys or [node])[0].start)
    added = newline.join(" " * indent + prefix + line for line in _rendered(pairs))
    end = node.end
    if end > 0 and document.text[end - 1] in "\r\n":  # behind a block scalar: already at the start of a line
        return _Splice(end, end, added + newline)
    end = _line_around(document.text, end)[1]
    return _Splice(end, end, newline + added)


def _add_to_flow(document: PlanDocument, node: Node, pairs: list[tuple[str, Any]]) -> _Splice:
    rendered = _rendered(pairs)
    at = (node.items or [node])[-1].end if node.items else node.start + 1
    line_start, line_end = _line_around(document.text, at)
    separator = ", " if node.items else ""
    one_line = separator + ", ".join(rendered)
    if line_end - line_start + len(one_line) <= _WIDTH:
        return _Splice(at, at, one_line)
    # As the paper writes long rows: the resolved state continues under the opening brace.
    following = _newline(document, node.start) + " " * (_column(document.text, node.start) + 1)
    text = ""
    width = _WIDTH  # so that the first key goes to a new line
    for line in rendered:
        fits = width + 2 + len(line) <= _WIDTH
        text += f"{',' if text or node.items else ''}{' ' if fits else following}{line}"
        width = width + 2 + len(line) if fits else len(following) + len(line)
    return _Splice(at, at, text)


def _new_block(document: PlanDocument, section: str, pairs: list[tuple[str, Any]]) -> _Splice:
    """A fenced block at the end of a section that has none."""
    found = document.sections[section]
    newline = _newline(document, found.heading)
    text = document.text[found.heading : found.end]
    at = found.heading + len(text.rstrip())
    block = newline.join(["```yaml", *_rendered(pairs), "```"])
    return _Splice(at, at, newline * 2 + block)


def _rendered(pairs: list[tuple[str, Any]]) -> list[str]:
    return [f"{inline(key)}: {inline(value)}" for key, value in pairs]


def _newline(document: PlanDocument, offset: int) -> str:
    """The line end in use around an offset."""
    end = _line_around(document.text, offset)[1]
    if document.text.startswith("\r\n", end):
        return "\r\n"
    return "\r" if document.text.startswith("\r", end) else "\n"


def _line_around(text: str, offset: int) -> tuple[int, int]:
    """Start and end (without its line end) of the line that holds an offset."""
    start = offset
    while start > 0 and text[start - 1] not in "\r\n":
        start -= 1
    end = offset
    while end < len(text) and text[end] not in "\r\n":
        end += 1
    return start, end


def _column(text: str, offset: int) -> int:
    return offset - _line_around(text, offset)[0]
