"""The vocabulary as a page, written from its modules: `python -m worldwright.place.reference` rewrites the skill's copy.

Every entry tells its formula, what it sets, its parameters and its first worked case; a test compares the page with the code.
"""

from pathlib import Path

from ..shelf import Entry, Shelf
from .vocabulary import PREDICATES, RELATIONS, Case

PAGE = Path(__file__).parents[3] / "skills/coordinates/references/vocabulary.md"
_HEAD = """# The placement vocabulary

Written by `python -m worldwright.place.reference` from `servers/worldwright/place/predicates` and
`servers/worldwright/place/relations`; change those. Metres, degrees, world frame: z up, +X front, +Y left. `min_x`, `max_x` …
are faces of the world box, `half_x` … half its extents (those of a yawed object are rotated).
"""


def page() -> str:
    """The whole page."""
    parts = [_HEAD, _table("Predicates", PREDICATES), _table("Relation templates", RELATIONS)]
    for title, shelf in (("Predicates in full", PREDICATES), ("Relation templates in full", RELATIONS)):
        parts.append(f"## {title}\n")
        parts += [_entry(entry) for entry in shelf.values()]
    return "\n".join(parts)


def _table(title: str, shelf: Shelf) -> str:
    families: dict[str, list[str]] = {}
    for code, entry in shelf.items():
        families.setdefault(entry.FAMILY, []).append(f"`{code}`")
    rows = [f"| {family} | {', '.join(codes)} |" for family, codes in families.items()]
    return "\n".join([f"## {title}\n", "| family | names |", "|---|---|", *rows, ""])


def _entry(entry: Entry) -> str:
    object_ = {"required": "needs an object", "optional": "the object may be left out", "none": "takes no object"}
    lines = [f"### {entry.code}", "", entry.doc, ""]
    if entry.PARAMS:
        lines += ["| parameter | kind | meaning |", "|---|---|---|"]
        for name, parameter in entry.PARAMS.items():
            needed = " (needed)" if parameter.required else ""
            choices = f": {', '.join(parameter.choices)}" if parameter.choices else ""
            lines.append(f"| `{name}`{needed} | {parameter.kind}{choices} | {parameter.meaning} |")
        lines.append("")
    lines.append(f"It {object_[entry.REFERENCE]}; its margin is in {entry.UNIT}. {_worked(entry.GOOD[0])}")
    return "\n".join([*lines, ""])


def _worked(case: Case) -> str:
    """One case in words."""
    given = ", ".join(f"{k} {_value(v)}" for k, v in case.params.items() if not isinstance(v, dict))
    gives = ", ".join(f"{k} = {v:g}" for k, v in case.gives.items())
    reference = f" against {_box(case.reference)}" if case.reference else ""
    outcome = f" gives {gives}" if gives else " holds"
    return f"Worked: {_box(case.subject)}{reference}{' with ' + given if given else ''}{outcome}."


def _box(box: object) -> str:
    data = dict(box) if isinstance(box, dict) else {}
    at = ", ".join(f"{k} {data[k]:g}" for k in ("x", "y", "z", "yaw") if k in data)
    size = " x ".join(f"{v:g}" for v in data.get("size", ()))
    return f"a {size} box" + (f" at {at}" if at else "")


def _value(value: object) -> str:
    if isinstance(value, tuple | list):
        return "[" + ", ".join(_value(v) for v in value) + "]"
    return f"{value:g}" if isinstance(value, float) else str(value)


if __name__ == "__main__":
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text(page(), encoding="utf-8")
