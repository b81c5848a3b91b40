"""The page of all lint rules, written from their modules.

`python -m worldwright.lint.reference` rewrites the skill's copy; a test compares it with the code.
"""

from pathlib import Path

from ..shelf import Entry
from . import engine
from .harm import Argued, Measured, Raises, Warns

PAGE = Path(__file__).parents[3] / "skills/lint-rules/references/rules.md"
TITLES = {
    "symbols": "Symbols and drift: names against the installed MuJoCo",
    "mistakes": "Silent mistakes and staging in programs and MJCF",
    "model": "Compiled worlds",
    "run": "What plain programs are seen to do when they run",
    "plan": "Plans",
}
_HEAD = """# Lint rules

Written by `python -m worldwright.lint.reference` from `servers/worldwright/lint/rules`; change those. `worldwright lint
explain CODE` shows a rule with its cases. *Fixable* ones are mended by `worldwright lint check-program FILE --fix`. The
evidence of each is run by the tests against the installed MuJoCo.
"""


def page() -> str:
    """The whole page."""
    rules = engine.all_rules()
    parts = [_HEAD]
    for name in engine.GROUPS:
        chosen = [rule for rule in rules if engine.group(rule) == name]
        parts += [f"## {TITLES[name]}", "", "| code | rule | severity | what it finds |", "|---|---|---|---|"]
        for rule in chosen:
            star = " (fixable)" if rule.FIXED else ""
            parts.append(
                f"| {rule.code} | [`{rule.name}`](#{rule.code.lower()}-{rule.name}){star} | {rule.SEVERITY} | {rule.summary} |"
            )
        parts.append("")
    for rule in rules:
        parts += [f"### {rule.code} {rule.name}", "", rule.doc, "", f"Evidence: {evidence(rule)}.", ""]
    return "\n".join(parts).rstrip() + "\n"


def evidence(rule: Entry) -> str:
    """Say in words how a rule's harm is shown."""
    proof = rule.EVIDENCE
    if isinstance(proof, Raises):
        return (
            "its bad cases fail when they are run, its good ones do not"
            if proof.good
            else "its bad cases fail when they are run"
        )
    if isinstance(proof, Warns):
        return f"the engine warns of its bad cases (`{proof.match}`)"
    if isinstance(proof, Measured):
        unit = f" by more than {proof.apart:g} {proof.unit}".rstrip() if proof.unit else ""
        return f"measured: {proof.claim}{f' (apart{unit})' if unit else ''}"
    assert isinstance(proof, Argued)
    return f"argued: {proof.reason}"


if __name__ == "__main__":
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text(page(), encoding="utf-8")
