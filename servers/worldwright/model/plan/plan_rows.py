"""Adding rows and keys to a plan without touching what stands there.

Rows go behind the last one of their list, keys behind the last one of their mapping; a list or a section that is not there yet is
made. All additions are read back together, since rows refer to each other, before anything is returned.
"""

from collections.abc import Mapping, Sequence
from typing import Any

from ..errors import PlanError
from .plan_problems import dotted
from .plan_text import PlanDocument, parse_plan
from .plan_yaml import Node, inline

Path = tuple[str, ...]
Splice = tuple[int, int, str]


def completed(
    document: PlanDocument, lists: Mapping[Path, Sequence[Any]], keys: Mapping[Path, Mapping[str, Any]]
) -> PlanDocument:
    """The document with rows and keys added.

    Args:
        document: the plan as it was read.
        lists: rows by the path of their list: a section, or a section and a key of it.
        keys: values by key, by the path of their mapping: a section and a key of it.

    Raises:
        PlanError: something is written in a form that takes no addition, or the result is no plan (`findings` says why).
    """
    splices: list[Splice] = []
    made: dict[str, list[str]] = {}
    for path, rows in lists.items():
        if rows:
            _into(document, path, [f"- {inline(row)}" for row in rows], splices, made)
    for path, values in keys.items():
        if values:
            _into(document, path, [f"{inline(key)}: {inline(value)}" for key, value in values.items()], splices, made)
    for section, lines in made.items():  # several new keys of one section stand together
        splices.append(_behind(document, (section,), lines))
    text = document.text
    for start, end, new in sorted(splices, reverse=True):
        text = text[:start] + new + text[end:]
    return parse_plan(text, document.file)


def _into(
    document: PlanDocument, path: Path, lines: list[str], splices: list[Splice], made: dict[str, list[str]]
) -> None:
    """The lines of one list or mapping: behind those that are there, or under a new key."""
    node = _node(document, path)
    if node is not None and node.items and node.form == "block":
        splices.append(_behind(document, path, lines))
    elif node is not None and node.form == "flow" and node.kind != "scalar":
        opening = document.text[node.start]
        inside = document.text[node.start + 1 : node.end - 1].rstrip().rstrip(",")
        added = ", ".join(line.removeprefix("- ") if opening == "[" else line for line in lines)
        closing = document.text[node.end - 1]
        joined = f"{inside}, {added}" if inside.strip() else added
        splices.append((node.start, node.end, f"{opening}{joined}{closing}"))
    elif node is None and len(path) == 2:
        made.setdefault(path[0], []).extend([f"{path[1]}:", *(f"  {line}" for line in lines)])
    elif node is None:
        splices.append(_behind(document, path, lines))
    else:
        raise PlanError(
            f"`{dotted(path)}` is written in a form that takes no addition",
            place=document.file,
            next_move="write it as a ```yaml block in block style",
        )


def _behind(document: PlanDocument, path: Path, lines: list[str]) -> Splice:
    """Whole lines behind the last one of a block, or a block of their own in a section that has none."""
    text, node = document.text, _node(document, path)
    if node is None or not node.items:
        section = document.sections[path[0]]
        if section.blocks:
            at = section.blocks[0].start
            return at, at, "".join(f"{line}\n" for line in lines)
        line_end = text.find("\n", section.heading) + 1 or len(text)
        block = "\n```yaml\n" + "".join(f"{line}\n" for line in lines) + "```\n\n"
        return line_end, section.end, block if text[line_end:].strip() else block.rstrip("\n") + "\n"
    first = (node.keys or node.items)[0].start
    indent = text[text.rfind("\n", 0, first) + 1 : first].split("-")[0]
    end = node.items[-1].end
    at = end if text[end - 1] == "\n" else (text.find("\n", end) + 1 or len(text))
    return at, at, "".join(f"{indent}{line}\n" for line in lines)


def _node(document: PlanDocument, path: Path) -> Node | None:
    try:
        return document.node(*path)
    except KeyError:
        return None
