"""Which fields of a compiled model decide its motion, and whether two models agree in them."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco

LOOKS = ("cam_", "light_", "mat_", "tex_", "skin_", "text_", "name_", "numeric_", "nskin", "ntex", "nnames", "nnumeric")
"""Beginnings of the names of fields on which no force depends."""
LOOKS_TOO = {
    "ncam", "nlight", "nmat", "nuser_cam", "npaths", "nbuffer", "names", "names_map", "paths", "signature",
    "vis", "stat", "geom_castshadow",
}  # fmt: skip
ENDINGS = ("_matid", "_rgba", "_pathadr")
NAMED = (
    "body", "jnt", "geom", "site", "flex", "mesh", "hfield", "pair", "exclude", "eq", "tendon", "actuator", "sensor",
    "tuple", "key", "plugin",
)  # fmt: skip
"""Kinds of things whose names count, because control code and recordings use them."""


def decides(field: str) -> bool:
    """Whether a field of the model decides the motion."""
    return not (field.startswith(LOOKS) or field.endswith(ENDINGS) or field in LOOKS_TOO)


def compared(one: "mujoco.MjModel", other: "mujoco.MjModel") -> tuple[float, str]:
    """(largest relative difference, name) over the fields that decide the motion; infinite where they cannot be compared."""
    found = differences(one, other)
    where = max(found, key=lambda name: found[name], default="")
    return found.get(where, 0.0), where


def differences(one: "mujoco.MjModel", other: "mujoco.MjModel") -> dict[str, float]:
    """The relative difference of each field that decides the motion, where there is one; infinite for another shape.

    A difference is relative to the largest number of its array, but to one at least. Where things have other names, that is
    all that is said: nothing else can be compared.
    """
    import numpy as np

    if kind_names(one) != kind_names(other):
        return {"the naming": float("inf")}
    found: dict[str, float] = {}
    for holder, twin, prefix in ((one, other, ""), (one.opt, other.opt, "opt.")):
        for name in filter(decides, sorted(n for n in dir(holder) if not n.startswith("_"))):
            a, b = getattr(holder, name), getattr(twin, name)
            if not isinstance(a, (np.ndarray, bool, int, float, np.generic)) or name == "narena":
                continue
            a, b = np.asarray(a, float), np.asarray(b, float)
            if a.shape != b.shape:
                found[prefix + name] = float("inf")
                continue
            apart = float(np.max(np.abs(a - b), initial=0.0)) / max(1.0, float(np.max(np.abs(a), initial=0.0)))
            if apart != 0:
                found[prefix + name] = apart if apart > 0 else float("inf")  # not a number equals nothing
    return found


def kind_names(model: "mujoco.MjModel", kinds: tuple[str, ...] = NAMED) -> dict[str, list[str]]:
    """Names by kind, in the order of the ids."""
    table = bytes(model.names)
    return {
        kind: [table[at : table.index(b"\0", at)].decode(errors="replace") for at in getattr(model, f"name_{kind}adr")]
        for kind in kinds
    }
