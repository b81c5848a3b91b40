"""Bodies that slide stay on what they slide on.

In MuJoCo's contact, normal and friction are one convex problem. A contact that slides wants a friction which its cone
does not allow, and pays for a little more of it with normal force: the body is thrown up, by more the stiffer the damper
is that brakes the slip. A stiff, hardly bouncing contact (`contacts.surface`) has a stiff damper: a crate of 12 kg that
slides at 2 m/s was 7 mm in the air and touched the floor in one row of seven, at 6 kN.

The cure is MuJoCo's own: explicit pairs take another damper for friction than for the normal (`solreffriction`). With
`GRIP` the same crate stays within 0.1 mm, its stopping distance is that of Coulomb's law within 0.2 %, and on a slope of
15 degrees it creeps by 0.13 mm/s. Sticking gives way to sliding where the slip exceeds `mu g / GRIP`, a few cm/s.
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
MOST = 1500
"""Pairs of one world; in a crowd beyond that, contacts stay as they are."""


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
    names = _named(spec)
    for one, other in pairs:
        friction = np.maximum(model.geom_friction[one], model.geom_friction[other])
        pair = spec.add_pair(geomname1=names[one], geomname2=names[other])
        pair.condim = int(max(model.geom_condim[one], model.geom_condim[other]))
        pair.friction = friction[[0, 0, 1, 2, 2]]
        pair.solref = _mixed(model.geom_solref[one], model.geom_solref[other])
        pair.solimp = (model.geom_solimp[one] + model.geom_solimp[other]) / 2
        pair.solreffriction = (-1.0, -GRIP)
    return len(pairs)


def _pairs(model: "mujoco.MjModel") -> "np.ndarray":
    """(P, 2) geoms that can collide, and whose contact brakes slip harder than `GRIP`, or `FIRM` in MuJoCo's own format."""
    import mujoco
    import numpy as np

    plain = (
        (model.geom_margin == 0)
        & (model.geom_solmix == 1)
        & (model.geom_gap == 0)
        & (model.geom_friction[:, 0] > 0)
        & ~model.geom_surfacevel.reshape(model.ngeom, -1).any(axis=1)
        & ~model.geom_adhesion.reshape(model.ngeom, -1).any(axis=1)
    )
    rows, columns = np.triu_indices(model.ngeom, 1)
    keep = plain[rows] & plain[columns]
    rows, columns = rows[keep], columns[keep]
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
