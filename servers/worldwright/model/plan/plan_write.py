"""A canonical `plan.md` from a `Plan`: what tools and tests write; people's own layout is kept by edits instead.

`parse_plan(write_plan(plan)).plan == plan`, and writing what was read back gives the same text.
"""

from typing import Any

from .committed import SECTIONS, Plan
from .pairings import said
from .plan_yaml import inline

_WIDTH = 110


def write_plan(plan: Plan) -> str:
    """The thirteen sections as markdown with YAML blocks, values that equal their defaults left out, but for frictions of spinning and
    rolling that are said: what is unsaid yields to them.

    Raises:
        ValueError: a value that a text file cannot hold (NaN, an infinity, a lone surrogate).
    """
    data = plan.model_dump(mode="json", exclude_defaults=True)
    given, told = plan.simulation_parameters, data.get("simulation_parameters", {})
    for name, row in told.get("materials", {}).items():
        row |= said(given.materials[name])
    for row, pair in zip(told.get("pairs", ()), given.pairs, strict=False):
        row |= said(pair)
    parts = [f"# {title}\n"] if (title := " ".join(plan.title.split())) else []
    for name in SECTIONS:
        parts.append(f"## {name}\n")
        if name == "plan_type":
            parts.append(f"{plan.plan_type.value}\n")
        elif data.get(name):
            parts.append("```yaml\n" + "\n".join(_block(data[name], 0)) + "\n```\n")
    return "\n".join(parts)


def _block(value: Any, indent: int) -> list[str]:
    """Lines of a mapping or list in block style; what is short and flat stays on one line."""
    pad = " " * indent
    if isinstance(value, dict) and value:
        lines = []
        for key, item in value.items():
            name = inline(str(key))
            if _nested(item, indent + len(name) + 2):
                lines += [f"{pad}{name}:", *_block(item, indent + 2)]
            else:
                lines.append(f"{pad}{name}: {inline(item)}")
        return lines
    if isinstance(value, list) and value:
        lines = []
        for item in value:
            if _nested(item, indent + 2):
                first, *rest = _block(item, indent + 2)
                lines += [f"{pad}- {first.lstrip()}", *rest]
            else:
                lines.append(f"{pad}- {inline(item)}")
        return lines
    return [pad + inline(value)]


def _nested(value: Any, column: int) -> bool:
    """Whether a value is written over several lines."""
    if not isinstance(value, dict | list) or not value:
        return False
    items = value.values() if isinstance(value, dict) else value
    deep = sum(isinstance(item, dict | list) and bool(item) for item in items)
    return deep > 1 or column + len(inline(value)) > _WIDTH
