"""The words of `worldkit.sculpt` on one page, written from the code: what a sculptor reads instead of looking up each.

`python -m worldwright.sculpting_words` rewrites the skill's copy; a test compares it with the code.
"""

import inspect
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from worldkit import sculpt
from worldkit.files import write_atomic
from worldkit.sculpt import brushes, crisp

PAGE = Path(__file__).parents[2] / "skills/sculpting/references/words.md"
HEAD = """# The words of worldkit.sculpt

Written by `python -m worldwright.sculpting_words` from `servers/worldkit/sculpt`; change that. Metres, degrees, full extents and
diameters; radii are only those of blending and rounding, and of a profile's (radius, height); z up, +x the front. What an
argument means beyond that: `worldwright retrieve symbol worldkit.sculpt.NAME`.
"""
PARTS = (
    ("Shapes", "sphere ellipsoid box cylinder torus capsule round_cone half_space revolved extruded tube strap"),
    ("Of one shape", "bend twist rough"),
    ("Of several", "union difference intersection linear radial repeat"),
    ("Where things go", "along skin share_along"),
    ("Into the world", "Part add assemble from_file dress made leaf hand hand_parts"),
)
SOLIDS = "box ball cylinder pipe torus lathe vessel turned slab loft hull sweep wire ring curve together around"
MASKS = "gradient over plain step within stripes spots net mottled noise label dial"


def page() -> str:
    """The whole page."""
    text = [HEAD]
    for title, words in PARTS:
        text.append(f"\n## {title}\n")
        text += [_line(word, getattr(sculpt, word)) for word in words.split()]
        if title == "Of one shape":
            text += [_line(f".{name}", method) for name, method in _methods(sculpt.Shape)]
    text.append("\n## Exact solids: `sculpt.crisp`, joined by `|`, cut by `-`, shared by `&`\n")
    text += [_line(word, getattr(crisp, word)) for word in SOLIDS.split()]
    text += [_line(f".{name}", method) for name, method in _methods(crisp.Solid)]
    text.append("\n## Brushes: `from worldkit.sculpt import brushes`\n")
    text += [_line(word, getattr(brushes, word)) for word in MASKS.split()]
    return "".join(text)


def _methods(cls: type) -> Iterator[tuple[str, Any]]:
    for name, thing in vars(cls).items():
        if not name.startswith("_") and inspect.isfunction(thing):
            yield name, thing


def _line(name: str, thing: Any) -> str:
    given: list[str] = []
    for one in inspect.signature(thing).parameters.values():
        if one.name == "self":
            continue
        if one.kind is one.KEYWORD_ONLY and not any(word.startswith("*") for word in given):
            given.append("*")
        stars = "*" if one.kind is one.VAR_POSITIONAL else "**" if one.kind is one.VAR_KEYWORD else ""
        given.append(f"{stars}{one.name}" + ("" if one.default is one.empty else f"={_shown(one.default)}"))
    said = (inspect.getdoc(thing) or "").partition("\n")[0]
    return f"- `{name}({', '.join(given)})` {said}\n"


def _shown(value: Any) -> str:
    return str(tuple(f"{v:g}" for v in value)).replace("'", "") if isinstance(value, tuple) and value else repr(value)


if __name__ == "__main__":
    write_atomic(PAGE, page())
