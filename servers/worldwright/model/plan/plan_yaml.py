"""The YAML inside a plan: a tree of nodes that remember where they stand in the document.

A small, strict part of YAML is read, as the 1.2 core schema reads it: mappings, lists and scalars; `true` and `false`
are the only booleans, `1e-3` is a number, `no` is text. Anchors, aliases, tags and several documents in one block are
refused: every number has one owner, so nothing may be written once and meant twice (which also leaves no alias bombs).

Not ruamel.yaml: of the 93 blocks of our examples it writes back 50 otherwise than it read them, unchanged, and reading
them takes 1.3 s instead of 0.07.
"""

import json
import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Literal

import yaml

MAX_DEPTH = 16
"""Deeper nesting than any plan needs; beyond it a block is refused."""

_LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_INTEGER = re.compile(r"[-+]?[0-9]{1,300}|0o[0-7]{1,300}|0x[0-9a-fA-F]{1,300}")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_./-]*( [A-Za-z0-9_./-]+)*")
_CONSTANTS: dict[str, bool | None] = {"": None, "~": None, "null": None, "Null": None, "NULL": None}
_CONSTANTS |= {"true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False}

Complain = Callable[[str, str, int, str, str], None]
"""Called with code, name, offset, message and fix."""


@dataclass
class Node:
    """One value: what it is, and the characters it takes up (`start` inclusive, `end` exclusive)."""

    kind: Literal["scalar", "sequence", "mapping"]
    start: int
    end: int
    scalar: Any = None
    items: list["Node"] | None = None
    """The items of a sequence, or the values of a mapping."""
    keys: list["Node"] | None = None
    """The keys of a mapping."""
    form: Literal["block", "flow", "bullets", "bare", "literal"] = "flow"
    """How it is written: in block or flow style, as markdown bullets, as a bare token, or as a block scalar."""

    def __getitem__(self, key: str | int) -> "Node":
        """A child by key or index; KeyError when there is none."""
        if self.kind == "mapping":
            for name, item in self.pairs():
                if name.scalar == key:
                    return item
        elif self.kind == "sequence" and isinstance(key, int) and 0 <= key < len(self.items or ()):
            return (self.items or [])[key]
        raise KeyError(key)

    def pairs(self) -> Iterator[tuple["Node", "Node"]]:
        """Keys with their values; nothing for a scalar or a list."""
        return zip(self.keys or (), self.items or (), strict=True) if self.kind == "mapping" else iter(())

    def data(self) -> Any:
        """The value as plain Python data."""
        if self.kind == "mapping":
            return {key.scalar: item.data() for key, item in self.pairs()}
        return [item.data() for item in self.items or ()] if self.kind == "sequence" else self.scalar


def compose(text: str, start: int, end: int, complain: Complain) -> Node | None:
    """Read one block of YAML at `text[start:end]`; None when it is empty or unreadable (`complain` hears why)."""
    return _Composer(text[start:end], start, complain).document()


class _Stop(Exception):  # noqa: N818 - already complained about
    """The block cannot be read any further."""


class _Composer:
    """Turns parser events into nodes at document offsets."""

    def __init__(self, text: str, offset: int, complain: Complain) -> None:
        self.text = text
        self.offset = offset
        self.complain = complain
        self.events: Iterator[Any] = yaml.parse(text, Loader=_LOADER)

    def document(self) -> Node | None:
        try:
            self.next()  # the stream
            if isinstance(self.next(), yaml.StreamEndEvent):
                return None
            node = self.node(self.next(), 0)
            self.next()  # the document's end
            event: Any = self.next()
            if not isinstance(event, yaml.StreamEndEvent):
                self.refuse(
                    event, "a second YAML document starts here", "keep one document per block: remove the `---`"
                )
        except _Stop:
            return None
        except yaml.MarkedYAMLError as error:
            self.syntax(error)
            return None
        except yaml.YAMLError as error:
            self.complain("WP006", "yaml_syntax", self.offset, _one_line(str(error)), "write this block as plain YAML")
            return None
        return node

    def next(self) -> Any:
        return next(self.events)

    def node(self, event: Any, depth: int) -> Node:
        start = self.offset + event.start_mark.index
        if isinstance(event, yaml.AliasEvent) or getattr(event, "anchor", None):
            self.refuse(event, "anchors and aliases are not part of the plan format", "write the value out")
        if getattr(event, "tag", None):
            self.refuse(event, f"the YAML tag {event.tag} is not part of the plan format", "remove the tag")
        if depth > MAX_DEPTH:
            self.refuse(event, f"this is nested more than {MAX_DEPTH} levels deep", "flatten it")
        if isinstance(event, yaml.ScalarEvent):
            last: Any = event.end_mark
            end = self.offset + last.index
            value = resolve(event.value) if event.style is None or event.style == "" else event.value
            return Node("scalar", start, end, scalar=value, form="literal" if event.style in ("|", ">") else "flow")
        items: list[Node] = []
        form: Literal["block", "flow"] = "flow" if event.flow_style else "block"
        if isinstance(event, yaml.SequenceStartEvent):
            while not isinstance(event := self.next(), yaml.SequenceEndEvent):
                items.append(self.node(event, depth + 1))
            return Node("sequence", start, self.end(event, form, items, start), items=items, form=form)
        keys: list[Node] = []
        seen: dict[str, int] = {}
        while not isinstance(event := self.next(), yaml.MappingEndEvent):
            key, value = self.node(event, depth + 1), self.node(self.next(), depth + 1)
            if key.kind != "scalar":
                self.refuse(event, "a key must be a word, not a list or a mapping", "write `key: value`")
            key.scalar = event.value  # keys are names: `8: …` and `no: …` are text
            if key.scalar in seen:
                line = self.text.count("\n", 0, key.start - self.offset) - self.text.count(
                    "\n", 0, seen[key.scalar] - self.offset
                )
                self.complain(
                    "WP008",
                    "duplicate_key",
                    key.start,
                    f"key `{key.scalar}` appears twice in one mapping"
                    + (f" (first {line} line{'s' * (line != 1)} above)" if line else ""),
                    "keep one of them: every number has one owner",
                )
                continue
            seen[key.scalar] = key.start
            keys.append(key)
            items.append(value)
        end = self.end(event, form, items, start)
        return Node("mapping", start, end, items=items, keys=keys, form=form)

    def end(self, event: Any, form: str, items: list[Node], start: int) -> int:
        """Where a collection ends: at its bracket, or behind its last item (the parser's mark lies further on)."""
        if form == "flow":
            return self.offset + event.end_mark.index
        return items[-1].end if items else start

    def refuse(self, event: Any, message: str, fix: str) -> None:
        self.complain("WP007", "yaml_feature", self.offset + event.start_mark.index, message, fix)
        raise _Stop

    def syntax(self, error: yaml.MarkedYAMLError) -> None:
        mark = error.problem_mark or error.context_mark
        if error.context_mark and any(word in str(error.context) for word in ("flow", "quoted")):
            mark = error.context_mark  # what was never closed stands where it was opened
        index = min(mark.index if mark else 0, len(self.text))
        problem = _one_line(error.problem or str(error))
        before = self.text[:index].rpartition("\n")[2]
        following = self.text[index:].partition("\n")[0]
        context = str(error.context)
        if "\t" in before + following[:1] and not before.strip():
            fix = "indent with spaces: YAML allows no tabs there"
        elif "quoted" in context:
            fix = "close this quote"
        elif "flow" in context:
            fix = "close this bracket, and put a comma between the items of { } and [ ]"
        elif "mapping values are not allowed" in problem:
            fix = 'put text that holds ": " in quotes, or indent the line as its neighbours are'
        elif "cannot start any token" in problem:
            fix = "put the value in quotes"
        else:
            fix = "indent this line exactly as its neighbours, and close every bracket and quote above it"
        self.complain("WP006", "yaml_syntax", self.offset + index, f"this is not YAML: {problem}", fix)


def resolve(text: str) -> Any:
    """A plain scalar by the YAML 1.2 core schema; a number beyond a float's range stays text."""
    if text in _CONSTANTS:
        return _CONSTANTS[text]
    if _INTEGER.fullmatch(text):
        return int(text, 0) if text[:2] in ("0o", "0x") else int(text)
    if _FLOAT.fullmatch(text) and math.isfinite(value := float(text)):
        return value
    return text


def inline(value: Any) -> str:
    """A value as YAML on one line, in flow style.

    Raises:
        ValueError: NaN, an infinity, a lone surrogate or a type that YAML has no plain form for.
    """
    if isinstance(value, dict):
        return "{" + ", ".join(f"{inline(str(key))}: {inline(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(inline(item) for item in value) + "]"
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return number(value)
    if not isinstance(value, str):
        raise ValueError(f"a plan cannot hold a {type(value).__name__}: {value!r}")
    if _PLAIN.fullmatch(value) and value not in _CONSTANTS:
        return value
    value.encode()  # a lone surrogate has no place in a UTF-8 file
    quoted = json.dumps(value, ensure_ascii=False)
    return re.sub(
        "[\x7f-\x9f\u2028\u2029\ufeff\ufffe\uffff]|[\U0001fffe\U0001ffff]", lambda m: f"\\U{ord(m.group()):08x}", quoted
    )


def number(value: float) -> str:
    """A finite float as the shortest text that reads back the same."""
    if not math.isfinite(value):
        raise ValueError(f"a plan holds finite numbers only, got {value}")
    text = repr(value)
    mantissa, e, exponent = text.partition("e")
    return f"{mantissa}.0e{exponent}" if e and "." not in mantissa else text


def _one_line(text: str) -> str:
    return " ".join(text.split())
