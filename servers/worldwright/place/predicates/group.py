"""Names a group after its leader: the subject leads, `members` belong to it and can be copied together.

    |center - member.center| <= within        for each member, when `within` is given

The row places nothing. `members` is a list of other objects, placed by rows of their own; `within` demands that each member's
centre is at most that many metres from the leader's. Source: paper, predicate algebra, grouping (the excerpt is silent on
parameters; these are ours).
"""

import math

from ..anchors import TOLERANCE_M, Box, CannotResolveError, Derivation
from ..parameters import Parameter
from ..vocabulary import Case, Expansion

CODE = "GROUP"
FAMILY = "Grouping"
REFERENCE = "none"
PARAMS = {
    "members": Parameter("objects", "the other objects of the group", required=True),
    "within": Parameter("number", "metres from the leader's centre to each member's, at most", 0.0),
}
UNIT = "m"
GROUPS = True
FORK = {"name": "fork", "size": (0.2, 0.02, 0.02), "x": 0.0, "y": 0.3, "z": 0.4, "yaw": 0}
GOOD = (Case({"size": (0.3, 0.3, 0.02), "x": 0.0, "y": 0.0, "z": 0.0}, None, {"member": FORK, "within": 0.5}),)
BAD = (Case({"size": (0.3, 0.3, 0.02), "x": 0.0, "y": 0.0, "z": 0.0}, None, {"member": FORK, "within": 0.4}),)


def expand(row: Expansion) -> list[tuple[str, dict]]:
    """Expand to one demand for each member."""
    within = {"within": row.params["within"]} if "within" in row.params else {}
    return [(row.subject, {"member": row.boxes[name], **within}) for name in row.params["members"]]


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets nothing."""
    return {}


def resolve(dof: str, subject: Box, reference: Box | None, params: dict) -> Derivation:
    """A group places nothing."""
    raise CannotResolveError("GROUP places nothing", "place each member by rows of its own")


def holds(subject: Box, reference: Box | None, params: dict) -> float:
    """Measure how much nearer than demanded the member is; the tolerance when nothing is demanded."""
    if "within" not in params:
        return TOLERANCE_M
    member: Box = params["member"]
    away = math.dist([subject.get(a) for a in "xyz"], [member.get(a) for a in "xyz"])
    return float(params["within"] - away + TOLERANCE_M)
