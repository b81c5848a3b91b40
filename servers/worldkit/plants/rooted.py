"""Add a plant to a world: limbs on springs, which hold it as it has grown against its weight; leaves that catch the wind."""

from math import degrees, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from ..bodies import COLLIDES, DRAWN, mesh
from . import foliage_meshes
from .plant_numbers import SEEN, Plant

if TYPE_CHECKING:
    import mujoco

    from .branching import Limb

LOOKS = ("foliage", "foliage_young")
YOUNG = 3
"""Every so-manieth leaf is a young one."""
LEAST_STIFFNESS = 1e-4
UP = np.array([0.0, 0.0, 1.0])


def add(
    spec: "mujoco.MjSpec",
    plant: Plant,
    *,
    name: str,
    pos: tuple[float, float, float],
    yaw_deg: float = 0.0,
    look: str = "bark",
    surface: dict[str, Any] | None = None,
    parent: str | None = None,
) -> "mujoco.MjsBody":
    """Add a plant whose root is held at `pos`, m, on the world or on the body `parent`, turned by `yaw_deg`.

    Each limb bends at its foot by two hinges, `NAME_LIMB_side` and `NAME_LIMB_up`, as stiff as its wood: E I / length. At rest in
    calm air it hangs as it is drawn. The wood of stems and trunk collides, twigs and leaves do not. Use a time step of at most 2 ms.

    Raises:
        ValueError: a name that is taken, or a parent that is not in the world.
    """
    from .. import bodies, materials

    if spec.body(name) is not None:
        raise ValueError(f"there is a body {name!r} already: name this {plant.word} otherwise")
    root = bodies.placed(spec, name, pos, yaw_deg, parent)
    stuff = {"wood": materials.add(spec, look), **{one: materials.add(spec, one) for one in LOOKS}}
    refs = _rests(plant, -float(spec.option.gravity[2]))
    made, feet = {"": root}, {"": np.zeros(3)}
    for limb in plant.limbs:
        foot = np.array(limb.foot)
        body = made[limb.above].add_body(name=f"{name}_{limb.name}", pos=foot - feet[limb.above])
        made[limb.name], feet[limb.name] = body, foot
        _hinged(body, plant, limb, refs[limb.name])
        _weighs(body, plant, limb, surface or {})
        _drawn(spec, body, limb, stuff)
    return root


def _axes(limb: "Limb") -> tuple[np.ndarray, np.ndarray]:
    """What a limb bends about: to its side about nearly the vertical, and up and down about the level."""
    ahead = np.subtract(limb.tip, limb.foot) / limb.long_m
    level = np.cross(ahead, UP if abs(ahead[2]) < 0.95 else np.array([1.0, 0.0, 0.0]))
    level /= np.linalg.norm(level)
    return np.cross(level, ahead), level


def stiffness(plant: Plant, limb: "Limb") -> float:
    """Of the bend at the foot of a limb, N·m/rad: E I / length, I = pi d^4 / 64; twice that at a root that is held."""
    bend = plant.modulus_pa * pi * limb.mean_m**4 / 64 / limb.long_m
    return max(bend * (1.0 if limb.above else 2.0), LEAST_STIFFNESS)


def _cloud(limb: "Limb") -> np.ndarray:
    """The middle of a limb's leaves."""
    return np.mean([np.add(foot, tip) / 2 for foot, tip, _ in limb.leaves], axis=0)


def _rests(plant: Plant, gravity: float) -> dict[str, tuple[float, float]]:
    """By each limb the angles, rad, at which its two springs hold what it bears as it is drawn."""
    moment: dict[str, list[tuple[float, np.ndarray]]] = {limb.name: [] for limb in plant.limbs}
    above = {limb.name: limb.above for limb in plant.limbs}
    for limb in plant.limbs:
        own = [(plant.wood_kg(limb), np.add(limb.foot, limb.tip) / 2)]
        own += [(plant.leaves_kg(limb), _cloud(limb))] if limb.leaves else []
        bearer = limb.name
        while bearer:
            moment[bearer] += own
            bearer = above[bearer]
    found = {}
    for limb in plant.limbs:
        pull = sum(np.cross(place - np.array(limb.foot), -mass * gravity * UP) for mass, place in moment[limb.name])
        k = stiffness(plant, limb)
        side, level = (float(-axis @ pull) / k for axis in _axes(limb))
        found[limb.name] = (side, level)
    return found


def _hinged(body: "mujoco.MjsBody", plant: Plant, limb: "Limb", rest: tuple[float, float]) -> None:
    import mujoco

    k = stiffness(plant, limb)
    for way, axis, angle in zip(("side", "up"), _axes(limb), rest, strict=True):
        joint = body.add_joint(name=f"{body.name}_{way}", type=mujoco.mjtJoint.mjJNT_HINGE, axis=axis)
        joint.stiffness[0], joint.damping[0] = k, plant.damping_s * k
        joint.springref = degrees(angle) if body.compiler.degree else angle


def _weighs(body: "mujoco.MjsBody", plant: Plant, limb: "Limb", surface: dict[str, Any]) -> None:
    """The wood, and the leaves as a cube whose faces are as large as what the leaves turn towards the wind."""
    import mujoco

    from ..turning import quaternion

    ahead = np.subtract(limb.tip, limb.foot)
    radius, half = limb.mean_m / 2, 0.5 * limb.long_m
    side, level = _axes(limb)
    way = {"pos": ahead / 2, "quat": quaternion(np.stack([side, level, ahead / limb.long_m], axis=1))}
    touching = surface if not limb.leaves else {"contype": 0, "conaffinity": 0}
    body.add_geom(
        name=body.name, type=mujoco.mjtGeom.mjGEOM_CAPSULE, size=(radius, half, 0), **way, **touching,
        **COLLIDES | {"mass": plant.wood_kg(limb)},
    )  # fmt: skip
    if limb.leaves:
        side_m = (SEEN * plant.leaf_area_m2 * len(limb.leaves)) ** 0.5
        # A body of its own, fixed to the twig: the wind acts on the box of a body's inertia.
        cloud = body.add_body(name=f"{body.name}_leaves", pos=_cloud(limb) - np.array(limb.foot))
        cloud.add_geom(
            name=cloud.name, type=mujoco.mjtGeom.mjGEOM_BOX, size=(side_m / 2,) * 3, contype=0, conaffinity=0,
            **COLLIDES | {"mass": plant.leaves_kg(limb)},
        )  # fmt: skip


def _drawn(spec: "mujoco.MjSpec", body: "mujoco.MjsBody", limb: "Limb", stuff: dict[str, str]) -> None:
    """The tube, and the leaves in two hues."""
    import mujoco

    kinds = [("wood", foliage_meshes.wood(limb))]
    if limb.leaves:
        kinds += [
            (look, foliage_meshes.leaves(some))
            for look, some in zip(
                LOOKS, (limb.leaves[1::YOUNG] + limb.leaves[2::YOUNG], limb.leaves[::YOUNG]), strict=True
            )
            if some
        ]
    for what, (points, normals, faces) in kinds:
        shape = mesh(spec, points - np.array(limb.foot), normals, faces)
        told = {**DRAWN, "material": stuff[what], "meshname": shape}
        body.add_geom(name=f"{body.name}/{what}", type=mujoco.mjtGeom.mjGEOM_MESH, **told)
