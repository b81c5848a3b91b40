"""The MJCF schema of the installed build: its elements, where they stand, and their attributes.

The text comes from the engine itself (`mj_printSchema`); the accepted keywords of an attribute, and the anchor that
documents it, come from the manual that ships with it.
"""

import re
from dataclasses import dataclass, field
from difflib import get_close_matches
from functools import cache, cached_property

from . import installed, symbols

META = ("frame", "replicate", "include")
"""Meta elements are outside the printed schema; the manual's XML reference describes them."""


@dataclass
class Element:
    """One element at one place of the schema."""

    name: str
    recursive: bool = False
    attributes: set[str] = field(default_factory=set)
    children: "dict[str, Element]" = field(default_factory=dict)

    def child(self, tag: str) -> "Element | None":
        """The element that `tag` means inside this one; meta elements keep the place in which they stand."""
        if tag in self.children:
            return self.children[tag]
        if tag == self.name and self.recursive:
            return self
        kinematic = "geom" in self.children and self.recursive and self.name != "default"
        if kinematic and tag in ("frame", "replicate"):
            return Element(tag, True, set(meta_attributes()[tag]), {**self.children, "body": self})
        return None


class Schema:
    """The tree of elements."""

    def __init__(self, text: str) -> None:
        self.root = _parse(text)

    @cached_property
    def by_tag(self) -> dict[str, list[Element]]:
        """Every place of an element, by its name."""
        found: dict[str, list[Element]] = {}
        stack = [self.root]
        while stack:
            element = stack.pop()
            found.setdefault(element.name, []).append(element)
            stack += element.children.values()
        for name, attributes in meta_attributes().items():
            found.setdefault(name, []).append(Element(name, attributes=set(attributes)))
        found["worldbody"] = found.get("body", [])
        return found

    def parents(self, tag: str) -> list[str]:
        """Names of the elements that may contain `tag`."""
        return sorted({e.name for places in self.by_tag.values() for e in places if tag in e.children})

    def nearest_element(self, tag: str) -> list[str]:
        """Up to three element names that look like `tag`."""
        return get_close_matches(tag, list(self.by_tag), n=3, cutoff=0.65)


@cache
def load() -> Schema:
    """The schema of the installed build."""
    return Schema(symbols.load().schema_text)


@cache
def meta_attributes() -> dict[str, frozenset[str]]:
    """The attributes of the meta elements, by the anchors that document them."""
    path = installed.manual_folder() / "XMLreference.rst"
    text = path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""
    found = re.findall(rf"^\.\. _({'|'.join(META)})-(\w+):", text, re.MULTILINE)
    return {name: frozenset(attribute for element, attribute in found if element == name) for name in META}


def _parse(text: str) -> Element:
    root: Element | None = None
    stack: list[tuple[int, Element]] = []
    for line in text.splitlines():
        head = re.match(r"^( *)(\S+) \((.)\) *(.*)$", line)
        if head is None:
            if stack:
                stack[-1][1].attributes.update(line.split())
            continue
        depth, name, mark, attributes = len(head[1]), head[2], head[3], head[4]
        element = Element("body" if name == "(world)body" else name, mark == "R", set(attributes.split()))
        while stack and stack[-1][0] >= depth:
            stack.pop()
        if stack:
            stack[-1][1].children[element.name] = element
            if name == "(world)body":
                stack[-1][1].children["worldbody"] = element
        elif root is None:
            root = element
        stack.append((depth, element))
    if root is None:
        raise symbols.IntrospectionError("the engine printed an empty MJCF schema", place="mujoco.mj_printSchema")
    return root


@cache
def anchors() -> dict[tuple[str, str], tuple[str, ...]]:
    """The manual's anchors by (element, attribute); the attribute of an element itself is the empty string."""
    found: dict[tuple[str, str], tuple[str, ...]] = {}
    path = installed.manual_folder() / "XMLschema.rst"
    if not path.is_file():
        return found
    element = ""
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        match = re.search(r":ref:`([^<`]+)<([^>]+)>`", line)
        if match is None:
            continue
        name, label = match[1].strip().replace("(world)", ""), match[2]
        if "dropdown::" in line:
            element, key = name, (name, "")
        else:
            key = (element, name)
        if label not in found.get(key, ()):
            found[key] = (*found.get(key, ()), label)
    return found


@cache
def keywords() -> dict[str, tuple[str, ...]]:
    """The accepted keywords of every attribute that takes one of a list, by its anchor."""
    found: dict[str, tuple[str, ...]] = {}
    path = installed.manual_folder() / "XMLreference.rst"
    if not path.is_file():
        return found
    labels: list[str] = []
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        if match := re.match(r"^\.\. _([^:]+):\s*$", line):
            labels.append(match[1])
        elif match := re.match(r"^:at:`[^`]+`: *:at-val:`\[([^\]]+)\]", line):
            words = tuple(word.strip() for word in match[1].split(","))
            if all(re.fullmatch(r"[A-Za-z][\w-]*", word) for word in words):
                found.update(dict.fromkeys(labels, words))
            labels = []
        elif line.strip():
            labels = []
    return found
