"""How the geoms of a model that is brought in look, and how they touch."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import mujoco

TABLE_LOOK = "look:"
"""What the name of a material begins with that stands for a look of `worldkit.materials`: `look:brass`."""
UNSAID = [0.5, 0.5, 0.5]
"""The engine's own colour, of a geom that says none."""


def dress(
    spec: "mujoco.MjSpec", geom: "mujoco.MjsGeom", prefix: str, look: str | None, surface: dict[str, Any] | None
) -> None:
    """Give a geom of a model the look that its material names, or `look` where it says none; and the surface, where it touches."""
    from . import materials

    if geom.material.startswith(f"{prefix}{TABLE_LOOK}"):
        geom.material = materials.add(spec, geom.material.removeprefix(f"{prefix}{TABLE_LOOK}"))
    if not geom.material and geom.rgba[:3].tolist() == UNSAID:
        geom.material = materials.add(spec, look or "plastic_white")
    if surface and (geom.contype or geom.conaffinity):
        for key, value in surface.items():
            if key != "density":
                setattr(geom, key, value)
