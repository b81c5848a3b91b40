"""The arrays of a model that can be written while it is simulated, by name, and whose each of their elements is."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco
    import numpy as np

BULKY = (
    "mesh_", "tex_", "bvh_", "hfield_", "skin_", "oct_", "name", "text_", "path", "key_", "B_", "M_", "D_", "map",
)  # fmt: skip
"""Prefixes of assets and tables that no simulation edits."""
SHAPES = ("mesh_vert", "mesh_normal", "mesh_graph", "mesh_polyvert", "mesh_polynormal", "hfield_data", "hfield_size")
"""Bulky assets that collisions read."""
LOOKS = ("_rgba", "_matid", "_group", "mat_", "light_", "cam_", "vis_", "_castshadow", "site_size", "_material")
"""Parts of the names of arrays that change only the picture."""
OWNERS = {
    "body": "body", "jnt": "joint", "dof": "dof", "geom": "geom", "site": "site", "cam": "camera", "light": "light",
    "mat": "material", "pair": "pair", "eq": "equality", "tendon": "tendon", "actuator": "actuator", "sensor": "sensor",
    "flex": "flex", "exclude": "exclude",
}  # fmt: skip
OPTIONS = (
    "timestep", "impratio", "tolerance", "ls_tolerance", "noslip_tolerance", "ccd_tolerance", "sleep_tolerance",
    "gravity", "wind", "magnetic", "density", "viscosity", "o_margin", "o_solref", "o_solimp", "o_friction",
    "integrator", "cone", "jacobian", "solver", "iterations", "ls_iterations", "noslip_iterations", "ccd_iterations",
    "disableflags", "enableflags", "disableactuator",
)  # fmt: skip


@dataclass(frozen=True)
class Edit:
    """One model array with what changed in it."""

    array: str
    index: "np.ndarray"
    """Indices into the flattened array."""
    values: "np.ndarray"
    """New values at those places."""
    looks_only: bool
    """Whether it changes only the picture, not the motion."""


def values(model: "mujoco.MjModel") -> "dict[str, np.ndarray]":
    """Copies of all that can be written, flat, by the names that edits have: arrays, the `SHAPES` among the bulky ones, options."""
    import numpy as np

    found = {
        name: np.array(array).reshape(-1)
        for name in dir(model)
        if name in SHAPES or not name.startswith(("_", *BULKY))
        if isinstance(array := getattr(model, name), np.ndarray) and array.nbytes and array.flags.c_contiguous
    }
    options = {
        f"opt.{name}": np.array(getattr(model.opt, name)).reshape(-1) for name in OPTIONS if hasattr(model.opt, name)
    }
    return found | options


def owner_of(model: "mujoco.MjModel", edit: Edit) -> list[tuple[str, "np.ndarray", "np.ndarray"]]:
    """(target, flat indices, new values) of each element an edit touches, e.g. `ball.geom_friction[ball_skin]`.

    Targets begin with the body that owns the element where there is one, else with the element or `opt`.
    """
    import numpy as np

    from .naming import names

    if edit.array.startswith("opt."):
        return [(edit.array, edit.index, edit.values)]
    array = getattr(model, edit.array)
    prefix = edit.array.split("_")[0]
    kind = OWNERS.get(prefix)
    if kind is None or not array.ndim:
        return [(edit.array, edit.index, edit.values)]
    per_element = max(1, array.size // len(array))
    elements = edit.index // per_element
    bodies = names(model, "body", model.nbody)
    if kind == "dof":
        labels = [f"{bodies[b]}" for b in model.dof_bodyid]
    elif kind == "flex":
        labels = [f"{kind}_{i}" for i in range(len(array))]
    else:
        labels = names(model, kind, len(array))
    body_of = {"geom": "geom_bodyid", "joint": "jnt_bodyid", "dof": "dof_bodyid", "site": "site_bodyid"}
    found = []
    for element in np.unique(elements):
        label = labels[element]
        if kind == "body":
            target = f"{label}.{edit.array}"
        elif kind in body_of:
            target = f"{bodies[getattr(model, body_of[kind])[element]]}.{edit.array}[{label}]"
        else:
            target = f"{label}.{edit.array}"
        mine = elements == element
        found.append((target, edit.index[mine], edit.values[mine]))
    return found
