"""What the things of a compiled model are called."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco


def names(model: "mujoco.MjModel", kind: str, count: int) -> list[str]:
    """Names of all objects of a kind (`body`, `geom`, …); a nameless one is called by its kind and id, `geom_7`."""
    import mujoco

    code = getattr(mujoco.mjtObj, f"mjOBJ_{kind.upper()}")
    return [mujoco.mj_id2name(model, code, i) or f"{kind}_{i}" for i in range(count)]
