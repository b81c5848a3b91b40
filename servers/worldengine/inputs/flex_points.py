"""The point bodies of each flex: what is declared of a flex is declared of its points.

A ledger speaks of bodies (`cloth_3`), a plan of the thing (`cloth`). Only bodies that are called after the flex are its
points: a flex spanned between the links of a robot does not open the robot.
"""

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from worldkit.naming import names

if TYPE_CHECKING:
    import mujoco


def own_points(flex: str, bodies: Iterable[str]) -> tuple[str, ...]:
    """Those of the bodies that carry a flex which are its own: `cloth_0`, `cloth_1` … of `cloth`."""
    return tuple(name for name in bodies if flex and name.startswith(f"{flex}_"))


def of_model(model: "mujoco.MjModel") -> dict[str, tuple[str, ...]]:
    """The names of each flex's point bodies (of an interpolated one: of its nodes), by the flex's name."""
    if not model.nflex:
        return {}
    bodies = names(model, "body", model.nbody)
    found = {}
    for f, flex in enumerate(names(model, "flex", model.nflex)):
        first, node = int(model.flex_vertadr[f]), int(model.flex_nodeadr[f])
        owners = list(model.flex_vertbodyid[first : first + int(model.flex_vertnum[f])])
        owners += list(model.flex_nodebodyid[node : node + int(model.flex_nodenum[f])]) if node >= 0 else []
        found[flex] = own_points(flex, dict.fromkeys(bodies[int(b)] for b in owners if b > 0))
    return found


def covered(said: Iterable[str], points: Mapping[str, tuple[str, ...]]) -> tuple[str, ...]:
    """The names of a declaration, with the points of each flex among them."""
    return tuple(dict.fromkeys(name for one in said for name in (one, *points.get(one, ()))))
