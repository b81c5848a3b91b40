"""MJCF documents inside a program's strings (or a bare model file), with the source line of every element."""

import ast
import re
from collections.abc import Collection
from dataclasses import dataclass, field, replace
from xml.parsers import expat

MAX_DEPTH = 200


@dataclass
class Tag:
    """One element as written."""

    name: str
    attributes: dict[str, str]
    line: int
    children: "list[Tag]" = field(default_factory=list)


@dataclass(frozen=True)
class Document:
    """One MJCF document; `root` is None when it is not well-formed."""

    root: Tag | None
    error: str = ""
    error_line: int = 1
    computed: bool = False
    """Parts of it are made at run time, so absent names and odd values prove nothing."""


ROBOT = re.compile(r"\s*(<\?.*?\?>\s*|<!--.*?-->\s*)*<robot[\s>]", re.DOTALL)
"""A URDF, which may speak to the engine in a `<mujoco>` of its own."""


def documents(text_nodes: list[ast.AST], lines: tuple[str, ...], changed: Collection[ast.AST] = ()) -> list[Document]:
    """Every MJCF document among a program's strings; from those in `changed` it makes other texts."""
    found = []
    for node in text_nodes:
        text = _text(node)
        if text is None or not re.search(r"<mujoco[\s>]", text) or ROBOT.match(text):
            continue
        text = text[text.index("<") :] if text.lstrip()[:1] == "<" else ""
        if not text or not re.search(r"</mujoco\s*>|<mujoco[^>]*/>", text):
            continue
        first, last = getattr(node, "lineno", 1), getattr(node, "end_lineno", None) or 1
        offset = _leading_newlines(node, lines)
        document = parse(text, lambda line, a=first + offset, z=last: min(a + line - 1, z))
        computed = isinstance(node, ast.JoinedStr) or node in changed or bool(re.search(r"\{\w*\}|%[sdfg(]|\$\w", text))
        found.append(replace(document, computed=computed))
    return found


def parse(text: str, place=lambda line: line) -> Document:
    """Parse one document; `place` turns its line numbers into the file's."""
    parser = expat.ParserCreate()
    stack: list[Tag] = []
    roots: list[Tag] = []

    def start(name: str, attributes: dict[str, str]) -> None:
        if len(stack) >= MAX_DEPTH:
            raise ValueError(f"elements are nested deeper than {MAX_DEPTH}")
        tag = Tag(name, attributes, place(parser.CurrentLineNumber))
        (stack[-1].children if stack else roots).append(tag)
        stack.append(tag)

    def end(_name: str) -> None:
        stack.pop()

    def doctype(*_: object) -> None:
        raise ValueError("a document type declaration has no place in MJCF")

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.StartDoctypeDeclHandler = doctype
    try:
        parser.Parse(text.strip(), True)
    except (expat.ExpatError, ValueError) as cause:
        line = getattr(cause, "lineno", parser.CurrentLineNumber)
        return Document(None, str(cause).split(":")[0], place(line))
    return Document(roots[0] if roots else None)


def _text(node: ast.AST) -> str | None:
    """The text of a string expression; parts that only a run would tell become `0`."""
    if isinstance(node, ast.Constant):
        return node.value if isinstance(node.value, str) else None
    if isinstance(node, ast.JoinedStr):
        return "".join(
            p.value if isinstance(p, ast.Constant) and isinstance(p.value, str) else "0" for p in node.values
        )
    return None


def _leading_newlines(node: ast.AST, lines: tuple[str, ...]) -> int:
    r"""Lines between the opening quotes and the first `<`, also across a `\` at the end of the first line."""
    first, last = getattr(node, "lineno", 1), getattr(node, "end_lineno", 1) or 1
    start = lines[first - 1][getattr(node, "col_offset", 0) :] if first <= len(lines) else ""
    for skipped, line in enumerate([start, *lines[first:last]]):
        if "<" in line:
            return skipped
    return 0
