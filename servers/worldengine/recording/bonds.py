"""The bonds of a world in which something can break; the many in which nothing can do not load what breaks things."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco

    from worldkit.breaking.letting_go import Bonds


def bonds_of(model: "mujoco.MjModel") -> "Bonds | None":
    """As `worldkit.breaking.bonds_of` tells them, which finds them in the model's tuples."""
    if not model.ntuple:
        return None
    from worldkit.breaking import letting_go

    return letting_go.bonds_of(model)
