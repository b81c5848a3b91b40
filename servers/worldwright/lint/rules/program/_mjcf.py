"""What the rules about MJCF text share: elements with their ancestors, and what kind of object an element makes."""

from collections.abc import Iterator

from ...mjcf_text import Document, Tag

GENERATES = frozenset({"include", "attach", "replicate", "flexcomp", "composite"})
"""Elements that make or bring in objects whose names do not stand in the text."""
JOINTS, TENDONS = ("joint", "freejoint"), ("spatial", "fixed")


def walk(document: Document) -> Iterator[tuple[Tag, tuple[Tag, ...]]]:
    """Every element with the elements around it, outermost first."""
    stack: list[tuple[Tag, tuple[Tag, ...]]] = [(document.root, ())] if document.root else []
    while stack:
        tag, around = stack.pop()
        yield tag, around
        stack += [(child, (*around, tag)) for child in reversed(tag.children)]


def kind(tag: Tag, around: tuple[Tag, ...]) -> str | None:
    """The kind of named object that an element makes (`body`, `joint`, `actuator` …); None when it makes none."""
    sections = [a.name for a in around]
    if "default" in sections or "name" not in tag.attributes:
        return None
    if len(sections) > 1 and sections[1] in ("actuator", "sensor", "equality", "tendon"):
        return sections[1] if len(sections) == 2 else None
    if tag.name in JOINTS:
        return "joint"
    known = ("body", "geom", "site", "camera", "light", "mesh", "material", "texture", "hfield", "key", "flex", "skin")
    return tag.name if tag.name in known and (len(sections) < 2 or sections[1] != "contact") else None


def closed(document: Document) -> bool:
    """Whether every object of the model stands in this text under its own name."""
    if document.root is None or document.root.name != "mujoco" or document.computed:
        return False
    return not any(tag.name in GENERATES for tag, _ in walk(document))
