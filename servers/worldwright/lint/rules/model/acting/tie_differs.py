"""Bodies are tied together otherwise than by the plan.

What it does: compares every equality constraint with the one of that name in the world of the plan's draft: its kind, what it
ties, where, whether it holds at the start, and how firmly. Finds constraints that neither a loop of `topology.joints` nor an
intervention of the plan names.

Why is this bad: a weld holds what should fall, and breaks when it suits; in a picture it is not there.

Use instead: `worldkit.loops` for a joint that closes a loop; for a tie that breaks an intervention of kind `constraint` with
its threshold.
"""

from collections.abc import Iterator

import numpy as np

from ....compiled.view import ModelView
from ....harm import Measured, after
from ....problem import Problem
from ._twins import GROUND, PLAN, SOUND, changed, compared, missing, names, twins, unplanned, yields

CODE = "WM167"
SEVERITY = "error"
SCOPE = "acts"
WELD = "spec.add_equality(name='glue', type=mujoco.mjtEq.mjEQ_WELD, objtype=mujoco.mjtObj.mjOBJ_BODY, name1='crate')"
FREE = "d = spec.equality('glue').data; d[:] = [0.0] * len(d); d[10] = 1"
DECLARED = {"kind": "constraint", "bodies": ["glue"], "law": "breaks at 50 N", "source": "a data sheet"}
_TIED = changed(WELD, FREE)
GOOD = (
    *SOUND,
    (_TIED[0], PLAN | {"simulation_parameters": PLAN["simulation_parameters"] | {"interventions": [DECLARED]}}),  # type: ignore[operator]
)
BAD = (
    _TIED,
    changed("spec.add_equality(type=mujoco.mjtEq.mjEQ_JOINT, objtype=mujoco.mjtObj.mjOBJ_JOINT, name1='pivot')"),
)
EVIDENCE = Measured(
    "the crate does not slide",
    lambda s: float(after(s, 1.0)[1].body("crate").xpos[0]),
    0.02,
    "m",
    bad=_TIED[0],
    good=changed()[0],
)
SAME = (("eq_type", "kind"), ("eq_active0", "state at the start"))
NEAR = 2e-3


def check(view: ModelView) -> Iterator[Problem]:
    """Check constraints of both worlds, then those of one."""
    planned = view.planned
    assert planned is not None
    for index, twin in twins(view, "equality"):
        yield from compared(view, "equality", SAME, index, twin)
        name = names(view, "equality")[index]
        if _ends(view, index) != _ends(planned, twin):
            here, there = (" and ".join(ends) for ends in (_ends(view, index), _ends(planned, twin)))
            yield view.at(
                "equality", index, f"constraint {name} ties {here}, by the plan {there}", "tie what the plan ties"
            )
        elif not np.allclose(view.eq_data[index], planned.eq_data[twin], atol=NEAR, rtol=1e-2):
            yield view.at(
                "equality", index, f"constraint {name} holds at another place than the plan's", "give the plan's anchor"
            )
        if yields(view.eq_solref[index], view.eq_solimp[index], (planned.eq_solref[twin], planned.eq_solimp[twin])):
            yield view.at(
                "equality",
                index,
                f"constraint {name} is softer than the plan's",
                "leave its solref as worldkit sets it",
            )
    for index in unplanned(view, "equality", "constraint"):
        if view.equality_kind[index] != "flex":
            message = (
                f"{view.name('equality', index)} ties {' and '.join(_ends(view, index))}, which the plan does not say"
            )
            fix = "add a joint that closes the loop, or an intervention of kind `constraint` that names it; or leave it out"
            yield view.at("equality", index, message, fix)
    for name in missing(view, "equality"):
        yield view.of_world(f"the plan's constraint {name} is not there", "build it under that name", name)


def _ends(view: ModelView, index: int) -> tuple[str, ...]:
    """Names of what a constraint ties."""
    kind = {1: "body", 3: "joint", 6: "site"}.get(int(view.eq_objtype[index]), "body")
    if view.equality_kind[index] in ("joint", "tendon"):
        kind = str(view.equality_kind[index])
    found = []
    for field in ("eq_obj1id", "eq_obj2id"):
        target, known = int(getattr(view, field)[index]), names(view, kind)
        found.append(known[target] if 0 < target < len(known) or (kind != "body" and target == 0) else GROUND)
    return tuple(found)
