"""What the text of a model reads from elsewhere, by the line it stands in: found before the engine sees it, since the engine
opens such files while it parses.

The list of what may name a file is closed, so that an attribute which a later engine adds is refused rather than read.
"""

from collections.abc import Iterator
from xml.parsers import expat

NAMED = frozenset(
    (("mesh", "file"), ("mesh", "filename"), ("texture", "file"), ("texture", "filename"), ("hfield", "file"))
)
"""Attributes that may name a file, by element; where it lies is checked of the parsed model. URDF calls them `filename`."""
OTHER_MODELS = ("include", "model", "attach")
"""Elements that bring in another model: the engine reads it whole."""


def outside(text: str) -> Iterator[tuple[int, str]]:
    """Line (1-based) and element of everything in an XML text that reads a file and may not.

    Elements are taken by the name that is written, as the engine does, whatever namespace they claim.
    """
    found: list[tuple[int, str]] = []
    reader = expat.ParserCreate()

    def element(tag: str, attributes: dict[str, str]) -> None:
        line = reader.CurrentLineNumber
        names = [key for key in attributes if key.startswith("file") and (tag, key) not in NAMED]
        if tag in OTHER_MODELS:
            found.append((line, f"<{tag}>"))
        elif names:
            found.append((line, f"<{tag} {names[0]}={attributes[names[0]]!r}>"))

    def document_type(name: str, *_: object) -> None:
        found.append(
            (reader.CurrentLineNumber, f"<!DOCTYPE {name}>")
        )  # its entities can stand for any element, or file

    reader.StartElementHandler = element
    reader.StartDoctypeDeclHandler = document_type
    reader.Parse(text.strip(), True)
    yield from found
