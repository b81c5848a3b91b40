"""The texts of new entries by kind: well-formed, with what is left to the author marked AUTHOR, and a case that fails.

`{name}`, `{code}` and, for lint rules, `{seen}` and `{bad}` are filled in.
"""

from ..new_rule import BODIES, RULE_HEAD

CHECK = '''"""AUTHOR: what is wrong with the motion, in one sentence.

What it means: AUTHOR: what was done wrong for such a motion to come about.

Formula: AUTHOR: what is measured, in symbols.
Threshold: AUTHOR: and why not more or less.
Source: AUTHOR: the law.
"""

from collections.abc import Iterator

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign

CODE = "{code}"
NEEDS = ("linvel",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """AUTHOR: yield a Sign for each body that moves so."""
    yield from ()


GOOD = (lambda: Case("a body that falls", analytic.falling()),)
# AUTHOR: make the motion that must be found; this one fails until the check finds something in it.
BAD = (lambda: Case("AUTHOR: the motion that must be found", analytic.resting()),)
'''

EXPECTATION = '''"""AUTHOR: what a body does, in one sentence.

Measures AUTHOR: which number, and its unit. Source: AUTHOR: the law.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import falling, resting
from ....measuring.measured import Measured, OfBody, at_least, body_index, window

CODE = "{code}"
EVENT = False


class Given(OfBody):
    """AUTHOR: what a plan says of it."""

    min_m: float = Field(gt=0, description="AUTHOR: what it is, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """AUTHOR: the number, and how far it is on the right side of what was claimed."""
    rows, body = window(trajectory, given.window_s), body_index(trajectory, given.body)
    found = 0.0 * float(trajectory.pos[rows, body, 2].max())
    return at_least(found, given.min_m, "m", f"AUTHOR: what {{given.body}} does")


# This one fails until something is measured.
GOOD = ((falling, {{"body": "body", "min_m": 1.0}}),)
BAD = ((resting, {{"body": "body", "min_m": 1.0}}),)
'''

PLACING = '''"""AUTHOR: where the subject stands to the reference, in one sentence.

    x = AUTHOR

AUTHOR: what the parameters mean, in which unit, and what is left out. Source: AUTHOR.
"""

from ..anchors import TOLERANCE_M, Box, Derivation, total
from ..vocabulary import Case

CODE = "{code}"
FAMILY = "AUTHOR: a row of the page"
REFERENCE = "required"
PARAMS: dict = {{}}
UNIT = "m"
TABLE = {{"name": "table", "size": (1.0, 2.0, 0.7), "x": 0.5, "y": 1.0, "z": 0.35, "yaw": 0}}
# This one fails until x is what the formula says.
GOOD = (Case({{"size": (0.4, 0.6, 1), "yaw": 0}}, TABLE, {{}}, {{"x": 1.2}}),)
BAD = (Case({{"size": (0.4, 0.6, 1), "yaw": 0, "x": 5.0}}, TABLE),)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """The x coordinate."""
    return {{"x": ("reference.x", "reference.extents", "self.extents")}}


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """AUTHOR: the sum of what it reads."""
    return total("x", (f"{{reference.name}}.center_x", reference.get("x")))


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Tolerance minus the error, metres."""
    return TOLERANCE_M - abs(subject.get("x") - reference.get("x"))
'''

GATE = '''"""AUTHOR: what may be done once this gate is open, and what it needs.

Why: AUTHOR: what would go wrong without it.
"""

from collections.abc import Iterator

from ..refusal import Refusal
from ..state import State

CODE = "{code}"


def check(state: State) -> Iterator[Refusal]:
    """AUTHOR: refuse what is missing, each with the command that mends it; it refuses everything until it is written."""
    yield Refusal(cause="AUTHOR: the gate {name} is not written", next_move="write it")
'''

SECTION = '''"""AUTHOR: what this part of the page shows, in one sentence."""

from typing import Any

from ..material import Material

CODE = "{code}"
TEMPLATE = "{name}.html"


def context(material: Material) -> dict[str, Any]:
    """What its template shows besides the material; the template asks for more until it is written."""
    return {{}}
'''

TEMPLATE = """<section id="{name}">
  <h2>AUTHOR: a heading</h2>
  <p class="intro">{{{{ AUTHOR }}}}</p>
</section>
"""

TEXTS = {
    **{
        kind: RULE_HEAD + BODIES[of]
        for kind, of in (("rule", "program"), ("model-rule", "model"), ("run-rule", "run"), ("plan-rule", "plan"))
    },
    "check": CHECK,
    "expectation": EXPECTATION,
    "predicate": PLACING,
    "relation": PLACING,
    "gate": GATE,
    "section": SECTION,
}
