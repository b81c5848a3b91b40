"""Bodies that slide stay on what they slide on.

In MuJoCo's contact, normal and friction are one convex problem. A contact that slides wants a friction which its cone
does not allow, and pays for a little more of it with normal force: the body is thrown up, by more the stiffer the damper
is that brakes the slip. A stiff, hardly bouncing contact (`contacts.surface`) has a stiff damper: a crate of 12 kg that
slides at 2 m/s was 7 mm in the air and touched the floor in one row of seven, at 6 kN.

The cure is MuJoCo's own: explicit pairs take another damper for friction than for the normal (`solreffriction`). With
`GRIP` the same crate stays within 0.1 mm, its stopping distance is that of Coulomb's law within 0.2 %, and on a slope of
15 degrees it creeps by 0.13 mm/s. Sticking gives way to sliding where the slip exceeds `mu g / GRIP`, a few cm/s.

That is too soft where slow slip is the whole motion: the round peg of a top slips by less, and friction then acts with a
part of its strength. A top of 0.55 kg at 46 rad/s leaned to 20 degrees at 3.72 s with `GRIP`; with the engine's own contact
it does at 4.14 to 4.17 s, at four times as fine a step and whatever the contact's stiffness. So round shapes of what is
started spinning about the vertical grip harder (`_grips`): 4.14 s, and hops of 33 um.

The pairs are added when the world is compiled by `world.make`, not by `build().compile()`: who steps a program's world
himself takes `world.make(build, world.seeded(0)[0])`, or steps another world than the one that is recorded.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco
    import numpy as np

GRIP = 50.0
"""1/s: damping of slip per unit mass."""
FIRM = 150.0
"""1/s: a contact in MuJoCo's own format (time constant, damping ratio) brakes slip harder than this when it is firmer than
the engine's default (105 1/s), which is left alone."""
SPUN_M_S2 = 200.0
"""Damping times slip of a round shape that spins on its point: harder would throw a top up by more than tens of um."""
LEAST_SPIN, MOST_GRIP = 10.0, 600.0
"""rad/s from which on a thing counts as one that spins on its point, and 1/s: what slides or is hit later at a few m/s is thrown up by
more the harder it grips (0.1 m ball at 1 m/s: 0.3 mm at 600, 0.9 mm at 1000; at 3 m/s 2.7 and 7.6 mm)."""
MOST = 1500
"""Pairs of one world; in a crowd beyond that, contacts stay as they are."""
MOST_AT_ONCE = 1_000_000
"""Pairs that are looked at together: 0.11 GB."""


def add_pairs(spec: "mujoco.MjSpec", model: "mujoco.MjModel") -> int:
    """Give every pair of surfaces with a stiffer damper than `GRIP` a pair of its own; returns how many.

    Args:
        spec: the world; unchanged when there is nothing to do.
        model: the same world compiled.

    Source: MuJoCo manual, "Contact parameters" (how geoms mix), "Collision detection" (which pairs are filtered), XML
    reference `contact/pair`.
    """
    import mujoco
    import numpy as np

    if model.opt.cone != mujoco.mjtCone.mjCONE_ELLIPTIC:
        return 0  # pyramids mix normal and friction: the manual says that the damper would not be used
    pairs = _pairs(model)
    if not 0 < len(pairs) <= MOST:
        return 0
    names, grips = _named(spec), _grips(spec, model)
    for one, other in pairs:
        friction = np.maximum(model.geom_friction[one], model.geom_friction[other])
        pair = spec.add_pair(geomname1=names[one], geomname2=names[other])
        pair.condim = int(max(model.geom_condim[one], model.geom_condim[other]))
        pair.friction = friction[[0, 0, 1, 2, 2]]
        pair.solref = _mixed(model.geom_solref[one], model.geom_solref[other])
        pair.solimp = (model.geom_solimp[one] + model.geom_solimp[other]) / 2
        pair.solreffriction = (-1.0, -max(grips[one], grips[other]))
    return len(pairs)


def _grips(spec: "mujoco.MjSpec", model: "mujoco.MjModel") -> "np.ndarray":
    """(geoms,) 1/s: `GRIP`, but more for round shapes of free bodies that start spinning, mostly about the vertical.

    Their slip is at most their speed and their spin times their reach from the axis; it is damped by `SPUN_M_S2` then.
    """
    import mujoco
    import numpy as np

    from .motion import START

    grips = np.full(model.ngeom, GRIP)
    key = next((key for key in spec.keys if key.name == START), None)
    if key is None:
        return grips
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, key.id)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    shapes = mujoco.mjtGeom
    rounded = {int(kind) for kind in (shapes.mjGEOM_SPHERE, shapes.mjGEOM_CAPSULE, shapes.mjGEOM_ELLIPSOID)}
    for geom, body in enumerate(model.geom_bodyid.tolist()):
        joint = int(model.body_jntadr[body])
        free = joint >= 0 and int(model.jnt_type[joint]) == int(mujoco.mjtJoint.mjJNT_FREE)
        if not free or int(model.geom_type[geom]) not in rounded:
            continue
        first = int(model.jnt_dofadr[joint])
        spin = data.xmat[body].reshape(3, 3) @ data.qvel[first + 3 : first + 6]
        if abs(spin[2]) <= max(np.hypot(spin[0], spin[1]), LEAST_SPIN):
            continue  # it rolls, or hardly turns
        away = np.linalg.norm((data.geom_xpos[geom] - data.xipos[body])[:2]) + model.geom_size[geom].max()
        slip = np.linalg.norm(data.qvel[first : first + 3]) + abs(spin[2]) * away
        grips[geom] = np.clip(SPUN_M_S2 / slip, GRIP, MOST_GRIP)
    return grips


def _pairs(model: "mujoco.MjModel") -> "np.ndarray":
    """(P, 2) geoms that can collide, and whose contact brakes slip harder than `GRIP`, or `FIRM` in MuJoCo's own format.

    What never collides is no part of it, and rows are looked at in blocks: snow is ten thousand grains that are only drawn, and their
    pairs with one another would take gigabytes. None where they are more than `MOST`.
    """
    import numpy as np

    plain = (
        (model.geom_margin == 0)
        & (model.geom_solmix == 1)
        & (model.geom_gap == 0)
        & (model.geom_friction[:, 0] > 0)
        & ~model.geom_surfacevel.reshape(model.ngeom, -1).any(axis=1)
        & ~model.geom_adhesion.reshape(model.ngeom, -1).any(axis=1)
    )
    able = np.flatnonzero(plain & ((model.geom_contype | model.geom_conaffinity) != 0))
    block = max(1, MOST_AT_ONCE // max(len(able), 1))
    found = [np.zeros((0, 2), int)]
    for first in range(0, len(able), block):
        rest = able[first:]
        rows, columns = np.triu_indices(min(block, len(rest)), 1, len(rest))
        found.append(_stiff(model, rest[rows], rest[columns]))
        if sum(map(len, found)) > MOST:
            return found[0]
    return np.concatenate(found)


def _stiff(model: "mujoco.MjModel", rows: "np.ndarray", columns: "np.ndarray") -> "np.ndarray":
    """(P, 2) of the pairs of geoms (n,) and (n,), those of `_pairs`."""
    import mujoco
    import numpy as np

    hits = (model.geom_contype[rows] & model.geom_conaffinity[columns]) | (
        model.geom_contype[columns] & model.geom_conaffinity[rows]
    )
    weld = model.body_weldid[model.geom_bodyid]
    above = model.body_weldid[model.body_parentid[weld]]
    one, other = weld[rows], weld[columns]
    keep = (hits != 0) & (one != other)
    keep &= (model.body_treeid[one] >= 0) | (model.body_treeid[other] >= 0)
    if not model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_FILTERPARENT:
        # The world is everybody's parent, and yet collides with its children.
        keep &= ~((one != 0) & (other != 0) & ((above[rows] == other) | (above[columns] == one)))
    keep &= model.geom_priority[rows] == model.geom_priority[columns]
    solref = _mixed(model.geom_solref[rows], model.geom_solref[columns])
    width = (model.geom_solimp[rows, 1] + model.geom_solimp[columns, 1]) / 2
    direct = solref[:, 0] <= 0
    time_constant = np.maximum(np.where(direct, 1.0, solref[:, 0]), 2 * model.opt.timestep)  # as the engine raises it
    keep &= np.where(direct, -solref[:, 1] > GRIP, 2 / (width * time_constant) > FIRM)
    bodies = np.sort(model.geom_bodyid[np.stack([rows, columns], axis=1)], axis=1).astype(np.int64)
    keep &= ~np.isin((bodies[:, 0] << 16) + bodies[:, 1], np.asarray(model.exclude_signature, dtype=np.int64))
    listed = {frozenset(p) for p in zip(model.pair_geom1.tolist(), model.pair_geom2.tolist(), strict=True)}
    found = np.stack([rows, columns], axis=1)[keep]
    return found if not listed else np.array([p for p in found if frozenset(p.tolist()) not in listed]).reshape(-1, 2)


def _mixed(one: "np.ndarray", other: "np.ndarray") -> "np.ndarray":
    """(…, 2) solref of a contact: the mean of two in MuJoCo's own format, else the smaller numbers (more damping)."""
    import numpy as np

    own = (one[..., :1] > 0) & (other[..., :1] > 0)
    return np.where(own, (one + other) / 2, np.minimum(one, other))


def _named(spec: "mujoco.MjSpec") -> list[str]:
    """Names of the geoms in the compiled order; a pair can only call geoms by name, so the nameless get one."""
    geoms = sorted(spec.geoms, key=lambda geom: geom.id)
    taken = {geom.name for geom in geoms}
    for geom in geoms:
        if not geom.name:
            name = f"geom_{geom.id}"
            geom.name = name if name not in taken else f"{name}_"
    return [geom.name for geom in geoms]
