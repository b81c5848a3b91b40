"""What codes mean that are no lint rule's: findings of the plan reader and of place, anomalies and expectations of scan.

Their text stands in the skills, where agents read it; `explain` answers with that very text.
"""

from pathlib import Path

from .report import RuleDoc

SKILLS = Path(__file__).parents[3] / "skills"
TELLERS = {"WP0": "the plan reader", "WP2": "place", "WP3": "place", "WS": "scan", "WE": "scan"}


def passage(code: str) -> RuleDoc | None:
    """What the skills say of a code, with the page it stands on; None for one that no page has."""
    code = code.upper()
    teller = next((who for prefix, who in TELLERS.items() if code.startswith(prefix) and code[2:].isdigit()), None)
    if teller is None:
        return None
    for page in sorted(SKILLS.rglob("*.md")):
        text = page.read_text("utf-8")
        if code in text and (found := _row(text, code) if code.startswith("WP") else _section(text, code)):
            name, said = found
            more = f"{said}\n\nThe whole page: `worldwright retrieve read skills/{page.relative_to(SKILLS).as_posix()}`"
            summary = said.splitlines()[0]
            return RuleDoc(code=code, name=name, severity=f"a finding of {teller}", summary=summary, documentation=more)
    return None


def _row(text: str, code: str) -> tuple[str, str] | None:
    """Of a table of findings: what a code means, and what to do."""
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip("| ").split(" | ")]
        codes = cells[0].replace("`", "").split()
        if line.startswith("| `WP") and code in codes and len(cells) > 1:
            together = [f"The row is of {' and '.join(codes)}."] if len(codes) > 1 else []
            does = [f"Do: {cells[2]}."] if len(cells) > 2 else []
            return "finding", "\n".join([f"What it means: {cells[1]}.", *does, *together])
    return None


def _section(text: str, code: str) -> tuple[str, str] | None:
    """Of a page of a shelf: the section headed by a code, or the one whose example names it."""
    for part in text.split("\n## ")[1:]:
        heading, _, body = part.partition("\n")
        if heading.startswith(f"{code} "):
            return heading.removeprefix(code).strip(), body.strip()
    for part in text.replace("\n## ", "\n### ").split("\n### ")[1:]:
        heading, _, body = part.partition("\n")
        if f"· {code}\n" in f"{body}\n":
            return heading.strip(), body.strip()
    return None
