"""Reading `plan.md`: markdown with thirteen `## sections` and fenced YAML blocks, into a `Plan`.

Every problem names file, line, section, cause and fix, and all problems of a document are reported at once. Writing is
lossless: an edit changes only the characters of the values it sets (`plan_edit`).

| section | may be written as |
|---|---|
| plan_type, visualization, recording_mode | a bare word, or a ```yaml block; `none` under `recording_mode` films nothing |
| objectives, clarifications_needed, asset_dimensions | markdown bullets, or a ```yaml block |
| all others | a ```yaml block; no block (prose only) means empty |
"""

import re
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from ..errors import NotFoundError, PlanError
from ..finding import Finding
from .committed import SECTIONS, TO_CHANGE, TO_CLARIFY, Plan
from .open_marks import unread
from .plan_problems import Problem, dotted, keys_of, unsafe_numbers, value_problems
from .plan_references import reference_problems
from .plan_sections import Lines, Section, split
from .plan_yaml import Node, compose

MAX_BYTES = 8 * 1024 * 1024
"""A plan of ten thousand objects is about half of this; a larger file is not a plan."""

BARE = {"plan_type": None, "visualization": "mode", "recording_mode": "mode"}
"""Sections that may be one bare word, each with the key whose value that word is."""
BULLETS = ("objectives", "clarifications_needed", "asset_dimensions")
_TOKEN = re.compile(r"[`*]*([A-Za-z_][\w-]*)[`*]*[.]?")
_NOTHING = re.compile(r"\W*(none|n/?a|not applicable|nothing|empty)\W*", re.IGNORECASE)
_YAML_LIKE = re.compile(r"\s*(?:-\s+)?\{?([a-z_]\w*):(?:\s|$)")
_CONTROL = re.compile("[^\t\n\r\x20-\x7e\xa0-\u2027\u202f-\u2065\u206a-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that no person types: among them line ends that YAML knows and editors do not show, and reversed reading order."""


@dataclass(frozen=True)
class PlanDocument:
    """A plan together with the text it was read from."""

    file: str
    text: str
    """Exactly as in the file: byte-order mark and line ends included."""
    plan: Plan
    sections: dict[str, Section]
    nodes: dict[str, Node]
    """The YAML tree of each section that has one."""
    lines: Lines

    def node(self, section: str, *path: str | int) -> Node:
        """The value at a path; KeyError when the document does not have it."""
        node = self.nodes[section]
        for part in path:
            node = node[part]
        return node

    def line_of(self, section: str, *path: str | int) -> int | None:
        """1-based line of a value, or of the innermost value around it; None when there is no such section."""
        rows = self.plan.source_rows
        if section == "scene_objects" and path and isinstance(path[0], int) and path[0] < len(rows):
            path = (rows[path[0]], *path[1:])  # copies have one row
        return _line(section, path, self.sections, self.nodes, self.lines)


def read_plan(path: Path | str) -> PlanDocument:
    """Read a plan file.

    Raises:
        NotFoundError: there is no such file, or it cannot be opened.
        PlanError: it is not a plan; `findings` holds every problem.
    """
    path = Path(path)
    if path.is_dir():
        path /= "plan.md"
    try:
        with path.open("rb") as stream:
            data = stream.read(MAX_BYTES + 1)
    except (OSError, ValueError) as cause:
        raise NotFoundError(
            f"the plan cannot be read: {getattr(cause, 'strerror', None) or cause}",
            place=str(path),
            next_move="name an existing plan.md (the skill plan-format shows one)",
        ) from cause
    if len(data) > MAX_BYTES:
        _refuse(str(path), f"the file is larger than {MAX_BYTES // 1024**2} MiB", "a plan is a text of a few pages")
    try:
        text = data.decode()
    except UnicodeDecodeError as cause:
        line = data.count(b"\n", 0, cause.start) + 1
        if b"\0" in data:
            _refuse(str(path), "this is a binary file, not a text", "name the plan.md", line)
        _refuse(str(path), f"byte 0x{data[cause.start]:02x} is not UTF-8", "save the file as UTF-8", line)
    document = parse_plan(text, str(path))
    document.plan.read_from(path.parent)
    return document


def parse_plan(text: str, file: str = "plan.md") -> PlanDocument:
    """Read a plan from its text.

    Raises:
        PlanError: it is not a plan; `findings` holds every problem, in document order.
    """
    try:
        document = _parsed(text)
    except PlanError as error:
        found = tuple(finding.model_copy(update={"file": file}) for finding in error.findings)
        raise PlanError(error.cause, findings=found, place=file, next_move=error.next_move) from None
    # Each reader has a plan of its own, which knows the folder that it was read from.
    return replace(document, file=file, plan=document.plan.model_copy())


@lru_cache(maxsize=16)
def _parsed(text: str) -> PlanDocument:
    """Parse a text once, wherever copies of it lie: a build reads the same plan at every step and in every folder."""
    file = "plan.md"
    lines = Lines(text)
    body = text.removeprefix("\ufeff")
    if not body.strip():
        _refuse(file, "the plan is empty", "write its thirteen sections (the skill plan-format shows them)")
    if control := _CONTROL.search(body):
        shown = "this is a binary file, not a text" if control.group() == "\0" else "a control character"
        offset = control.start() + len(text) - len(body)
        _refuse(file, f"{shown} ({control.group()!r})", "save the plan as plain UTF-8 text", lines.at(offset))
    title, sections, findings = split(text, file, lines)
    reader = _Reader(text, file, lines, sections, findings)
    for section in sections.values():
        reader.section(section)
    plan = reader.plan(title)
    if plan is None or findings:
        findings.sort(key=lambda f: (f.line is None, f.line or 0))
        count = len(findings)
        raise PlanError(
            f"the plan has {count} problem{'s' * (count != 1)}",
            findings=tuple(findings),
            place=file,
            next_move=f"fix line {findings[0].line}: {findings[0].fix}" if findings[0].line else findings[0].fix,
        )
    marked = (match.start() for match in re.finditer(TO_CHANGE, text))
    plan.copied_at(tuple(dict.fromkeys(lines.at(offset) for offset in marked)))
    plan.left_open_at(tuple(unread(TO_CLARIFY, text, title, sections, reader.nodes, lines)))
    return PlanDocument(file, text, plan, sections, reader.nodes, lines)


def _refuse(file: str, message: str, fix: str, line: int | None = None) -> None:
    finding = Finding(code="WP001", name="not_a_text", severity="error", message=message, fix=fix, file=file, line=line)
    raise PlanError(message, findings=(finding,), place=file, next_move=fix)


def _line(
    section: str, path: tuple[Any, ...], sections: dict[str, Section], nodes: dict[str, Node], lines: Lines
) -> int | None:
    if section not in sections:
        return None
    node = nodes.get(section)
    if node is None:
        return lines.at(sections[section].heading)
    offset = node.start if path else sections[section].heading
    for part in path:
        try:
            parent, node = node, node[part]
        except KeyError:
            break
        offset = next((k.start for k, _ in parent.pairs() if k.scalar == part), node.start)
    return lines.at(offset)


class _Reader:
    """Reads the sections of one document; collects data, nodes and findings."""

    def __init__(
        self, text: str, file: str, lines: Lines, sections: dict[str, Section], findings: list[Finding]
    ) -> None:
        self.text = text
        self.file = file
        self.lines = lines
        self.sections = sections
        self.findings = findings
        self.nodes: dict[str, Node] = {}
        self.data: dict[str, Any] = {}
        self.broken: set[str] = set()
        """Sections whose values could not be read."""
        self.name = ""

    def complain(self, code: str, name: str, offset: int, message: str, fix: str) -> None:
        """Note a problem of the section being read."""
        self.findings.append(
            Finding(
                code=code,
                name=name,
                severity="error",
                message=message,
                fix=fix,
                file=self.file,
                line=self.lines.at(offset),
                column=self.lines.column(offset),
                section=self.name,
            )
        )
        if code in ("WP005", "WP006", "WP007"):
            self.broken.add(self.name)

    def section(self, section: Section) -> None:
        """Read one section into data and nodes."""
        self.name = section.name
        blocks = section.blocks
        if len(blocks) > 1:
            self.complain(
                "WP005",
                "misplaced_block",
                blocks[1].opened,
                f"section `{section.name}` has a second ```yaml block",
                "merge the blocks of a section into one",
            )
        if blocks:
            node = compose(self.text, blocks[0].start, blocks[0].end, self.complain)
            if node is not None:
                node = _unwrapped(node, section.name)
        elif section.name in BULLETS and section.bullets():
            node = self.bullets(section)
        elif section.name in BARE:
            node = self.bare(section)
        else:
            self.check_unfenced(section)
            node = None
        if node is not None:
            self.keep(section.name, node)

    def keep(self, name: str, node: Node) -> None:
        """Store a section's node and its data in the shape that `Plan` takes."""
        if name == "asset_dimensions" and node.kind == "sequence":
            node = self.joined(node)
        self.nodes[name] = node
        data = node.data()
        if name in BARE and isinstance(data, str) and BARE[name]:
            data = {BARE[name]: data}
        if name == "objectives" and isinstance(data, list):
            data = [{"claim": item} if isinstance(item, str) else item for item in data]
        if data is not None:
            self.data[name] = data

    def bare(self, section: Section) -> Node | None:
        """The one word of a section like `plan_type`."""
        first = next(section.prose(), None)
        if first is None:
            return None
        if BARE[section.name] and (nothing := _NOTHING.fullmatch(first.text)):
            if section.name != "recording_mode":
                return None
            start, end = first.start + nothing.start(1), first.start + nothing.end(1)
            return Node("scalar", start, end, scalar="none", form="bare")  # no film is made
        match = _TOKEN.fullmatch(first.text.strip())
        if not match:
            if section.name == "plan_type" or _YAML_LIKE.match(first.text):
                self.complain(
                    "WP005",
                    "misplaced_block",
                    first.start,
                    f"section `{section.name}` should start with one bare word or hold a ```yaml block",
                    f"write the {'plan type' if section.name == 'plan_type' else 'mode'} alone on a line",
                )
            return None
        start = first.start + first.text.index(match[1])
        return Node("scalar", start, start + len(match[1]), scalar=match[1], form="bare")

    def bullets(self, section: Section) -> Node:
        """A flat list written as markdown bullets."""
        items: list[Node] = []
        for bullet in section.bullets():
            if _NOTHING.fullmatch(bullet.text):
                continue
            if section.name == "asset_dimensions":
                node = compose(self.text, bullet.start, bullet.end, self.complain)
                if node is not None:
                    items.append(node)
            else:
                items.append(Node("scalar", bullet.start, bullet.end, scalar=bullet.text, form="bullets"))
        start = section.bullets()[0].start
        return Node("sequence", start, items[-1].end if items else start, items=items, form="bullets")

    def joined(self, node: Node) -> Node:
        """`- table: 0.75` bullets as one mapping."""
        keys: list[Node] = []
        values: list[Node] = []
        for item in node.items or ():
            if item.kind != "mapping":
                self.complain(
                    "WP010",
                    "wrong_value",
                    item.start,
                    "a dimension is written `- <asset>: <height in metres>`",
                    "write e.g. `- table: 0.75`",
                )
                continue
            for key, value in item.pairs():
                if key.scalar in (k.scalar for k in keys):
                    self.complain(
                        "WP008",
                        "duplicate_key",
                        key.start,
                        f"`{key.scalar}` has two heights",
                        "keep one: every number has one owner",
                    )
                    continue
                keys.append(key)
                values.append(value)
        return Node("mapping", node.start, node.end, keys=keys, items=values, form="bullets")

    def check_unfenced(self, section: Section) -> None:
        """Complain about YAML that stands outside a ```yaml block, where it would be ignored."""
        for fence in section.fences:
            if not fence.language and fence.closed:
                self.complain(
                    "WP005",
                    "misplaced_block",
                    fence.opened,
                    f"the block of section `{section.name}` is not marked as YAML",
                    "open it with ```yaml",
                )
                return
        known = keys_of(section.name)
        for line in section.prose():
            match = _YAML_LIKE.match(line.text)
            if match and (match[1] in known or not known):
                self.complain(
                    "WP005",
                    "misplaced_block",
                    line.start,
                    f"section `{section.name}` has YAML outside a fenced block",
                    "put it between ```yaml and ```",
                )
                return

    def plan(self, title: str) -> Plan | None:
        """Validate the collected data; None when something was wrong (the findings say what)."""
        problems = [
            Problem(
                "WP010", "wrong_value", path, f"`{dotted(path)}` is beyond every physical scale", "write it in SI units"
            )
            for path in unsafe_numbers((), self.data)
        ]
        plan = None
        try:
            if not problems:
                plan = _validate({"title": " ".join(title.split()), **self.data})
        except ValidationError as error:
            problems += value_problems(error, self.nodes)
        problems += reference_problems(self.data, [n for n in SECTIONS if n in self.broken or n not in self.sections])
        for problem in problems:
            section = str(problem.path[0]) if problem.path else ""
            if section in self.broken or (len(problem.path) == 1 and section not in self.sections):
                continue  # already reported: the section is missing or cannot be read
            self.findings.append(
                Finding(
                    code=problem.code,
                    name=problem.name,
                    severity="error",
                    message=problem.message,
                    fix=problem.fix,
                    file=self.file,
                    line=_line(section, problem.path[1:], self.sections, self.nodes, self.lines),
                    section=section or None,
                )
            )
        return plan


def _validate(data: dict[str, Any]) -> Plan:
    """Strictly, as JSON: a quoted number is not a number, but a list is a tuple."""
    import json

    return Plan.model_validate_json(json.dumps(data, allow_nan=False), strict=True)


def _unwrapped(node: Node, name: str) -> Node:
    """A block that repeats its section's name as its only key means what is under that key."""
    if node.kind == "mapping" and [key.scalar for key in node.keys or ()] == [name] and name in SECTIONS:
        return node[name]
    return node
