"""Refusing a compiled world with a number that is none (nan, inf), also where only a picture would be spoilt by it.

The engine warns of one in a world's text, and compiles. Nothing that is compiled honestly has any.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from .naming import names

if TYPE_CHECKING:
    import mujoco
    import numpy as np

FOLLOWS = ("invweight", "aabb", "rbound", "subtree", "efm0")
"""Fields, by parts of their names, that the compiler reckons from others: those are told first."""
KINDS = {"jnt": "joint", "cam": "camera", "mat": "material", "tex": "texture", "eq": "equality"}
"""Kinds of things whose fields begin otherwise than the kind is called."""
MOST = 3


def nowhere(model: "mujoco.MjModel") -> str:
    """Where numbers of a compiled model are none, in words; empty when all are finite."""
    found = dict(_holes(model))
    told = sorted(found, key=lambda field: (field.endswith("0") or any(part in field for part in FOLLOWS), field))
    words = ", ".join(field + f" of {found[field]}" * bool(found[field]) for field in told[:MOST])
    return words + f" (and {len(told) - MOST} more)" * (len(told) > MOST)


def _holes(model: "mujoco.MjModel") -> Iterator[tuple[str, str]]:
    """(field, name of the first thing in it that has one; empty where it is nothing's) of each field with a number that is none."""
    import numpy as np

    groups = {"": model, "opt.": model.opt, "stat.": model.stat}
    groups |= {f"vis.{name}.": getattr(model.vis, name) for name in ("global_", "headlight", "map", "quality", "scale")}
    for prefix, holder in groups.items():
        for name in dir(holder):
            value = getattr(holder, name) if not name.startswith("_") else None
            if (
                not isinstance(value, float | np.ndarray)
                or np.asarray(value).dtype.kind != "f"
                or np.isfinite(value).all()
            ):
                continue
            yield prefix + name, "" if prefix else _whose(model, name, np.asarray(value))


def _whose(model: "mujoco.MjModel", field: str, value: "np.ndarray") -> str:
    """The name of the first thing whose row holds none; empty where rows of the field belong to no kind of thing."""
    import mujoco
    import numpy as np

    start = field.partition("_")[0]
    kind = KINDS.get(start, start)
    count = getattr(model, f"n{start}", getattr(model, f"n{kind}", None))
    if not value.ndim or len(value) != count or not hasattr(mujoco.mjtObj, f"mjOBJ_{kind.upper()}"):
        return ""
    return names(model, kind, count)[int(np.argwhere(~np.isfinite(value))[0][0])]
