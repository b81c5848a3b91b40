"""The vocabulary of expectations and the list of anomaly checks as pages, written from their modules.

`python -m worldwright.scan.reference` rewrites the skills' copies; a test compares them with the code.
"""

import json
from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import Any

from ..shelf import Entry
from .anomalies.engine import CHECKS
from .objectives.claims import EXPECTATIONS

SKILLS = Path(__file__).parents[3] / "skills"
VOCABULARY, ANOMALIES = SKILLS / "expectations/references/vocabulary.md", SKILLS / "review/references/anomalies.md"
FAMILIES = (
    "kinematics", "contact", "rotation", "oscillation", "energy", "deformation", "fracture", "flow", "comparison", "picture"
)  # fmt: skip
_VOCABULARY = """# The vocabulary of expectations

Written by `python -m worldwright.scan.reference` from `servers/worldwright/scan/objectives/expectations`; change those. Metres,
kilograms, seconds, newtons, degrees; world frame, z up. A margin is in the unit of what is measured, and positive when the
claim holds. Those marked with a star are **events**: they come true at a moment, so they can be ordered
(`happens_before` …) and their causes tested. `window_s: [start, end]` restricts any of them to a stretch of time.

A body means the whole rigid thing: what touches a part that is welded to it (a child without a joint of its own) touches it,
and it weighs what all of it weighs. So `lands_on: {body: toy, support: table}` holds when the toy's foot lands first,
and `never_touches: {bodies: [ball, toy]}` fails when the ball touches the foot. A part's own name means that part alone, with
what is welded on below it; where both are named (`touches: {bodies: [hammer, hammer_head]}`), the part no longer counts
for the rest. Bodies on joints never count for the one they hang on.
"""
_ANOMALIES = """# The anomaly checks

Written by `python -m worldwright.scan.reference` from `servers/worldwright/scan/anomalies/checks`; change those. Each looks at every
recording, whatever the plan claims. *Needs* names the channels without which a check is skipped, and says so. *Of wholes*
are checks that take bodies welded to each other (without joints between them) for the one rigid body that they are, called
by the name of the one that carries the others; the other checks look at each body as it was recorded.
"""


_AUDITS = """
## The audits

Not checks of one recording: they repeat the physics (`worldwright scan scan RUN --refine --causes`).

| code | finding | what it means |
|---|---|---|
| WS311 | `numerical_artefact` | a claim holds at the plan's time step and fails at half of it, or the other way round |
| WS321 | `effect_without_cause` | the effect comes although its declared cause was taken away: it was staged |
| WS322 | `effect_unmoved` | the cause was weakened and the effect neither came later nor measured differently: it was timed |
| WS323 | `timed_trigger` | what the plan declares as a consequence acts at the same moment whatever happens |
| WS324 | `cause_untested` | a declared cause could not be tested: the effect has no expectation, nothing of the cause can be removed, or without it a motor elsewhere never acts |

`--robust` measures every claim again with friction a fifth higher and lower, masses and start a hundredth otherwise, and half
the time step, and tells in how many of these worlds it holds. It is a remark and blocks nothing.
"""


def vocabulary() -> str:
    """The page of expectations."""
    families = {name: [e for e in EXPECTATIONS.values() if _family(e) == name] for name in FAMILIES}
    others = [e for e in EXPECTATIONS.values() if _family(e) not in FAMILIES]
    if others:  # third parties' modules live elsewhere
        families["others"] = others
    parts = [_VOCABULARY, "| family | expectations |", "|---|---|"]
    for name, entries in families.items():
        parts.append(f"| [{name}](#{name}) | {', '.join(f'`{e.name}`' + _mark_event(e) for e in entries)} |")
    for name, entries in families.items():
        package = import_module(f"{EXPECTATIONS.package}.{name}") if name in FAMILIES else None
        parts += ["", f"## {name}", "", (package.__doc__ or "").strip() if package else "From plug-ins."]
        for entry in entries:
            parts += ["", _expectation(entry)]
    return "\n".join(parts) + "\n"


def anomalies() -> str:
    """The page of checks."""
    parts = [_ANOMALIES, "| code | check | what it finds |", "|---|---|---|"]
    parts += [f"| {e.code} | `{e.name}` | {e.summary} |" for e in CHECKS.values()]
    for entry in CHECKS.values():
        needs = ", ".join(f"`{name}`" for name in entry.NEEDS) or "poses alone"
        parts += ["", f"## {entry.code} {entry.name}", "", entry.doc, "", f"Needs: {needs}.{_note_on_wholes(entry)}"]
    return "\n".join(parts) + "\n" + _AUDITS


def _note_on_wholes(entry: Entry) -> str:
    return " Of wholes." if entry.WHOLE else ""


PAGES = {VOCABULARY: vocabulary, ANOMALIES: anomalies}


def _expectation(entry: Entry) -> str:
    lines = [
        f"### {entry.name}{_mark_event(entry)}",
        "",
        entry.doc,
        "",
        "| argument | kind | meaning |",
        "|---|---|---|",
    ]
    schema = entry.Given.model_json_schema(by_alias=True)
    for name, field in schema["properties"].items():
        if name == "window_s":
            continue
        needed = " (needed)" if name in schema.get("required", ()) else ""
        default = field.get("default")
        usual = f" ({_yaml_line(default)} if left out)" if default not in (None, [], "") and name != "low" else ""
        usual = "" if isinstance(default, list) else usual
        lines.append(f"| `{name}`{needed} | {_kind(field)} | {field.get('description', '')}{usual} |")
    lines += ["", f"Example: `- {entry.name}: {_yaml_line(entry.GOOD[0][1])}` · {entry.code}"]
    return "\n".join(lines)


def _kind(field: Mapping[str, Any]) -> str:
    """A JSON schema in a few words."""
    options = [option for option in field.get("anyOf", ()) if option.get("type") != "null"]
    if options:
        return " or ".join(dict.fromkeys(_kind({**field, "anyOf": (), **option}) for option in options))
    if "enum" in field:
        return " or ".join(f"`{value}`" for value in field["enum"])
    if "const" in field:
        return f"`{field['const']}`"
    kind = field.get("type")
    if kind == "array":
        if (count := field.get("maxItems")) and count == field.get("minItems"):
            inner = {_kind(item) for item in field.get("prefixItems", ())}
            return f"list of {count} ({', '.join(sorted(inner))})"
        return f"list of {_kind(field.get('items', {}))}"
    if kind in ("number", "integer"):
        signs = (("exclusiveMinimum", ">"), ("minimum", "≥"), ("exclusiveMaximum", "<"), ("maximum", "≤"))
        bounds = ", ".join(f"{sign} {field[key]:g}" for key, sign in signs if key in field)
        return f"{'number' if kind == 'number' else 'whole number'} {bounds}".strip()
    if kind == "object":
        return "one event with its arguments"
    return {"string": "text", "boolean": "true or false"}.get(str(kind), str(kind or "value"))


def _yaml_line(value: Any) -> str:
    """YAML on one line."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key}: {_yaml_line(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_yaml_line(inner) for inner in value) + "]"
    if isinstance(value, float):
        return f"{value:.4g}"
    if isinstance(value, str):
        return value if value.replace("_", "").isalnum() else json.dumps(value, ensure_ascii=False)
    return json.dumps(value)


def _family(entry: Entry) -> str:
    return (["", *entry.module.__name__.split(".")])[-2]


def _mark_event(entry: Entry) -> str:
    return " \\*" if entry.EVENT else ""


if __name__ == "__main__":
    for page, write in PAGES.items():
        page.parent.mkdir(parents=True, exist_ok=True)
        page.write_text(write(), encoding="utf-8")
