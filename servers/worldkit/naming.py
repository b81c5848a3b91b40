"""What the things of a compiled model are called."""

import itertools
from collections.abc import Container
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco


def names(model: "mujoco.MjModel", kind: str, count: int) -> list[str]:
    """Names of all objects of a kind (`body`, `geom`, …); a nameless one is called by its kind and id, `geom_7`."""
    import mujoco

    code = getattr(mujoco.mjtObj, f"mjOBJ_{kind.upper()}")
    return [mujoco.mj_id2name(model, code, i) or f"{kind}_{i}" for i in range(count)]


def free(stem: str, taken: Container[str]) -> str:
    """The first of `stem`, `stem2`, `stem3` … that is not taken."""
    return next(name for n in itertools.chain(("",), itertools.count(2)) if (name := f"{stem}{n}") not in taken)
