"""What a compound weighs and where its centre of mass is, from the masses and densities of the plan."""

from dataclasses import dataclass, replace

from worldkit.parts import Vec3

from .committed import Plan
from .scene_objects import SceneObject


@dataclass(frozen=True)
class Weight:
    """The weight of a compound object."""

    mass_kg: float
    parts: int
    """How many solids it consists of, copies included."""
    centre: Vec3
    """Centre of mass from the centre of its box, m, after its tilt, before its yaw."""

    def __str__(self) -> str:
        x, y, z = (round(v, 4) + 0.0 for v in self.centre)
        count = f"{self.parts} part{'s' if self.parts != 1 else ''}"
        return f"{self.mass_kg:.4g} kg in {count}, centre of mass ({x:g}, {y:g}, {z:g}) m from the centre of its box"


def weight(plan: Plan, row: SceneObject) -> Weight:
    """The weight of a compound.

    Raises:
        ValueError: the masses of its parts contradict the object's.
    """
    materials = plan.simulation_parameters.materials

    def density(material: str | None) -> float | None:
        found = materials.get(material or "")
        return None if found is None else found.density

    whole = row.whole()
    dense = {part.name: density(part.material) if part.material else None for part in row.parts}
    solids = tuple(
        replace(solid, part=replace(solid.part, surface={"density": d}))
        if (d := dense[solid.part.name]) is not None
        else solid
        for solid in whole.solids
    )
    whole = replace(whole, solids=solids)
    masses = whole.masses(plan.simulation_parameters.masses.get(row.name), density(row.material))
    return Weight(sum(masses), len(solids), whole.centre_of_mass(masses))
