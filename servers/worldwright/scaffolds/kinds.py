"""The kinds of entries that can be scaffolded: the place of each, the choice of its code, and what to run afterwards.

A code is never used twice, and codes of one folder stay together.
"""

import importlib
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from ..shelf import Shelf

HERE = Path(__file__).parents[1]
LINT_PAGE = "python -m worldwright.lint.reference"
SCAN_PAGE = "python -m worldwright.scan.reference"
PLACE_PAGE = "python -m worldwright.place.reference"


def numbered(prefix: str, step: int = 1, below: int = 900) -> Callable[[Shelf, Path, str], str]:
    """Codes such as `WS134`: the first free one after the highest of its folder; 9xx belong to third parties."""

    def code(shelf: Shelf, folder: Path, _name: str) -> str:
        pattern = re.compile(rf'^CODE = "{prefix}(\d{{3}})"', re.MULTILINE)
        texts = [path.read_text(encoding="utf-8") for path in sorted(folder.glob("*.py"))]
        here = [number for text in texts for number in map(int, pattern.findall(text)) if number % 100 != 99]
        taken = {int(c.removeprefix(prefix)) for c in shelf if c.startswith(prefix)} | set(here)
        # The next one of the lowest hundred, to which most of a folder belongs; other hundreds are families of their own.
        first = [n for n in here if n // 100 == min(here) // 100] if here else [99 + step]
        number = max(first) + step
        while number in taken:
            number += step
        if number >= below:
            raise ValueError(f"the codes {prefix} are used up")
        return f"{prefix}{number:03d}"

    return code


def named(change: Callable[[str], str]) -> Callable[[Shelf, Path, str], str]:
    """Codes that equal the name as plans write it."""
    return lambda _shelf, _folder, name: change(name)


@dataclass(frozen=True)
class Kind:
    """One kind of entry."""

    shelf: str
    """Module and attribute of its shelf; a function there is called."""
    folder: str
    """Its folder below `worldwright`."""
    code: Callable[[Shelf, Path, str], str]
    tests: str
    """The tests that run its cases."""
    pages: tuple[str, ...] = ()
    """The commands that rewrite the generated pages about it."""
    families: bool = False
    """Whether its folder has folders."""
    also: str = ""
    """Further work, in a sentence."""

    def open(self) -> Shelf:
        """The shelf itself."""
        module, _, attribute = self.shelf.partition(":")
        found = getattr(importlib.import_module(f"worldwright.{module}"), attribute)
        return found if isinstance(found, Shelf) else found()

    def members(self) -> Iterator[tuple[str, str]]:
        """(name, meaning) of what an entry defines."""
        for name, meant in self.open().protocol.items():
            yield name, ("" if meant.required else "(may be left out) ") + meant.meaning


RULES = "tests/worldwright/lint/test_lint_rules.py tests/worldwright/lint/test_lint_evidence.py"
KINDS = {
    "rule": Kind("lint.engine:PROGRAM_RULES", "lint/rules/program", numbered("WL"), RULES, (LINT_PAGE,)),
    "model-rule": Kind("lint.engine:MODEL_RULES", "lint/rules/model", numbered("WM"), RULES, (LINT_PAGE,)),
    "run-rule": Kind(
        "lint.engine:RUN_RULES",
        "lint/rules/run",
        numbered("WR"),
        "tests/worldwright/lint/test_lint_run.py tests/worldwright/lint/test_lint_evidence.py",
        (LINT_PAGE,),
        also="what it speaks of is told by a module of `lint/observed/inside`: `SAID.event(NAME, line, …)`",
    ),
    "plan-rule": Kind("lint.engine:PLAN_RULES", "lint/rules/plan", numbered("WP"), RULES, (LINT_PAGE,)),
    "check": Kind(
        "scan.anomalies.engine:CHECKS",
        "scan/anomalies/checks",
        numbered("WS"),
        "tests/worldwright/scan/test_checks.py",
        (SCAN_PAGE,),
    ),
    "expectation": Kind(
        "scan.objectives.claims:EXPECTATIONS",
        "scan/objectives/expectations",
        numbered("WE"),
        "tests/worldwright/scan/test_expectations.py",
        (SCAN_PAGE,),
        families=True,
    ),
    "predicate": Kind(
        "place.vocabulary:PREDICATES",
        "place/predicates",
        named(lambda name: name.upper().replace("_", "-")),
        "tests/worldwright/place/test_place_vocabulary.py",
        (PLACE_PAGE,),
    ),
    "relation": Kind(
        "place.vocabulary:RELATIONS",
        "place/relations",
        named(str),
        "tests/worldwright/place/test_place_vocabulary.py",
        (PLACE_PAGE,),
    ),
    "gate": Kind(
        "stamp.gates:shelf",
        "stamp/gates",
        numbered("WG", 5),
        "tests/worldwright/stamp/test_stamp_gates.py",
        also="a tool must ask it: `gates.pass_through(NAME, state)`; a run that it refuses and one that it opens for "
        "go into the tests",
    ),
    "section": Kind(
        "report.sections:SECTIONS",
        "report/sections",
        numbered("RS", 10),
        "tests/worldwright/report",
        also="its HTML is the template beside it, and its styles are in style.css",
    ),
}
