"""Bodies are tied together otherwise than by the plan.

What it does: compares every equality constraint with the one of that name in the world of the plan's draft: its kind, what it
ties, where, whether it holds at the start, and how firmly; of a bond of a thing that breaks also what the program itself says it is
worth: axes, area, moduli, strength. Finds constraints that neither a loop of `topology.joints` nor an
intervention of the plan names.

Why is this bad: a weld holds what should fall, and breaks when it suits; in a picture it is not there. The stress of a bond is
computed from its area and moduli: a thousandth of them, and a pane breaks at a thousandth of its load.

Use instead: `worldkit.loops` for a joint that closes a loop; for a tie that breaks an intervention of kind `constraint` with
its threshold.
"""

from collections.abc import Iterator

import numpy as np

from ....compiled.view import ModelView
from ....harm import Measured, after
from ....problem import Problem
from ._twins import GROUND, PLAN, SOUND, alike, changed, compared, missing, names, shown, twins, unplanned, yields

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
    yield from _worth(view, planned)
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


def _worth(view: ModelView, planned: ModelView) -> Iterator[Problem]:
    """Compare what a program says of its bonds with the plan's cut; a stress in another section says nothing of the plan's."""
    if view.bonds_wrong:
        yield view.of_world(view.bonds_wrong, "leave the fields of bonds to `worldkit.breaking.add`", "breaking")
        return
    here = dict(zip(view.bond_equality.tolist(), view.bond_told, strict=True))
    there = dict(zip(planned.bond_equality.tolist(), planned.bond_told, strict=True))
    fix = "cut it and give its strength as the plan says: leave the fields of bonds to `worldkit.breaking.add`"
    twin_of = dict(twins(view, "equality"))
    for index in sorted({*here, *(one for one, twin in twin_of.items() if twin in there)}):
        name, told, plans = names(view, "equality")[index], here.get(index), there.get(twin_of.get(index, -1))
        if told is None or plans is None:
            has, should = ("no bond", "one") if told is None else ("a bond with a strength of its own", "none")
            yield view.at("equality", index, f"constraint {name} is {has}, by the plan it is {should}", fix)
            continue
        for word, part, same in (
            ("normal", slice(0, 3), alike(told[:3], plans[:3], atol=1e-3)),
            ("area (m^2)", slice(9, 10), alike(told[9], plans[9], rtol=1e-2, atol=0)),
            ("moduli (m^3), or the axes they are about,", slice(10, 13), _bends_alike(told, plans)),
            ("strength (Pa)", slice(13, 14), alike(told[13], plans[13], rtol=1e-2)),
            ("part as a hold (1) or between pieces (0)", slice(14, 15), told[14] == plans[14]),
        ):
            if not same:
                message = f"the {word} of bond {name} is {shown(told[part])}, by the plan it is {shown(plans[part])}"
                yield view.at("equality", index, message, fix)


def _bends_alike(told: np.ndarray, plans: np.ndarray) -> bool:
    """Whether two sections (15,) take moments alike, within 5 %: the axes of a round one are only by the last digit where they are."""
    one, other = (np.einsum("k,ki,kj->ij", 1 / row[11:13], *[row[3:9].reshape(2, 3)] * 2) for row in (told, plans))
    return alike(told[10], plans[10], 0.05, 0) and alike(one, other, 0, 0.05 * float(np.abs(other).max()))


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
