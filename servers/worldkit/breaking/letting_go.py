"""The rule by which bonds break: once, for good, by the stress that the engine's own forces make in their section."""

from typing import TYPE_CHECKING, NamedTuple

from ..errors import ProgramError
from .bonded import FIELD, WIDTH
from .section import stress

if TYPE_CHECKING:
    import mujoco
    import numpy as np

HALF = 0.5
"""A weld's three last rows act on half the rotation (a quaternion's vector part)."""


class Bonds(NamedTuple):
    """Every bond of a model, B of them."""

    equality: "np.ndarray"
    """(B,) which equality."""
    second: "np.ndarray"
    """(B,) the body in whose frame the axes are."""
    pieces: "np.ndarray"
    """(B, 2) the pieces that it holds, as bodies; of a hold twice the same."""
    axes: "np.ndarray"
    """(B, 3, 3)"""
    area: "np.ndarray"
    """(B,) m^2."""
    moduli: "np.ndarray"
    """(B, 3) m^3."""
    strength: "np.ndarray"
    """(B,) Pa."""


def bonds_of(model: "mujoco.MjModel") -> Bonds | None:
    """What the fields of a model say of its bonds, in the order of its equalities; None where it has none.

    Raises:
        ProgramError: a field says something else than `add` writes.
    """
    import mujoco
    import numpy as np

    rows: list[np.ndarray] = [np.zeros((0, WIDTH))]
    found: list[np.ndarray] = [np.zeros(0, int)]
    holds: list[np.ndarray] = [np.zeros(0, bool)]
    for one in range(model.ntuple):
        if (mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_TUPLE, one) or "").startswith(FIELD):
            at, size = int(model.tuple_adr[one]), int(model.tuple_size[one])
            rows.append(_told(model, one))
            found.append(model.tuple_objid[at : at + size])
            holds.append(model.tuple_objprm[at : at + size] > 0)
    if len(found) == 1:
        return None
    told, equality = np.concatenate(rows), np.concatenate(found)
    if len(np.unique(equality)) < len(equality):
        raise _malformed(FIELD.strip(), "lists a weld twice")
    order = np.argsort(equality)
    told, equality, hold = told[order], equality[order], np.concatenate(holds)[order]
    first, second = model.eq_obj1id[equality], model.eq_obj2id[equality]
    return Bonds(
        equality,
        second,
        np.stack([first, np.where(hold, first, second)], axis=1),
        told[:, :9].reshape(-1, 3, 3),
        told[:, 9],
        told[:, 10:13],
        told[:, 13],
    )


def _told(model: "mujoco.MjModel", one: int) -> "np.ndarray":
    """(n, WIDTH) what the numeric field of a tuple's name says of the n welds that the tuple lists."""
    import mujoco
    import numpy as np

    called, at, size = model.tuple(one).name, int(model.tuple_adr[one]), int(model.tuple_size[one])
    field = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_NUMERIC, called)
    if field < 0:
        raise _malformed(called, "has no numeric field of its name beside it")
    ties = model.tuple_objid[at : at + size]
    if (model.tuple_objtype[at : at + size] != mujoco.mjtObj.mjOBJ_EQUALITY).any():
        raise _malformed(called, "lists what is no equality")
    if ((model.eq_type[ties] != mujoco.mjtEq.mjEQ_WELD) | (model.eq_objtype[ties] != mujoco.mjtObj.mjOBJ_BODY)).any():
        raise _malformed(called, "lists an equality that is no weld of bodies")
    if (model.body_weldid[model.eq_obj1id[ties]] == model.body_weldid[model.eq_obj2id[ties]]).any():
        raise _malformed(called, "lists a weld of bodies that cannot move against each other")
    start, width = int(model.numeric_adr[field]), int(model.numeric_size[field])
    if width != size * WIDTH:
        raise _malformed(called, f"has {width} numbers for {size} welds: each has {WIDTH}")
    told = model.numeric_data[start : start + width].reshape(-1, WIDTH)
    if not (np.isfinite(told).all() and (told[:, 9:] > 0).all()):
        raise _malformed(called, "has an area, a modulus or a strength that is not above 0, or no finite number")
    axes = told[:, :9].reshape(-1, 3, 3)
    if np.abs(np.einsum("bik,bjk->bij", axes, axes) - np.eye(3)).max() > 1e-3:
        raise _malformed(called, "has axes that are no frame of unit vectors")
    return np.asarray(told)


def _malformed(called: str, what: str) -> ProgramError:
    return ProgramError(f"the field {called!r} {what}", next_move="leave those fields to `worldkit.breaking.add`")


def stresses(bonds: Bonds, data: "mujoco.MjData") -> "np.ndarray":
    """(B,) Pa: the largest tension in each bond by the forces of the last solution; 0 of one that is broken.

    Call it where `efc_force` is that of the state: after `mj_forward`, or after a step's second half.
    """
    import numpy as np

    found = np.zeros(len(bonds.equality))
    held = np.flatnonzero(data.eq_active[bonds.equality])
    if not len(held) or not data.ne:
        return found
    first = np.searchsorted(data.efc_id[: data.ne], bonds.equality[held])
    rows = data.efc_force[first[:, None] + np.arange(6)]
    turn = data.xmat[bonds.second[held]].reshape(-1, 3, 3)
    forces = np.einsum("bij,bkj,bk->bi", bonds.axes[held], turn, rows[:, :3])
    moments = np.einsum("bij,bj->bi", bonds.axes[held], HALF * rows[:, 3:])
    found[held] = stress(forces, moments, bonds.area[held], bonds.moduli[held])
    return found


class LettingGo:
    """The rule for every bond of a world: call it in `control`.

    let_go = breaking.LettingGo()

    def control(model, data):
        let_go(model, data)
    """

    def __init__(self) -> None:
        self._of: mujoco.MjModel | None = None
        self._bonds: Bonds | None = None

    def __call__(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> int:
        """Break bonds whose stress in this very state is above their strength; returns how many it broke.

        A crack is faster than a step: of each piece the most loaded bond goes, then the forces are solved anew without it, until
        what is left carries the load. Where nothing breaks, only the solution for the forces is repeated; nothing once all are broken.

        Raises:
            ProgramError: forces that are no finite numbers, or fields of bonds that `add` did not write.
        """
        import mujoco
        import numpy as np

        if self._of is not model:
            self._of, self._bonds = model, bonds_of(model)
        bonds, before = self._bonds, int(data.eq_active.sum())
        if bonds is None or not data.eq_active[bonds.equality].any():
            return 0
        mujoco.mj_forwardSkip(model, data, mujoco.mjtStage.mjSTAGE_VEL, 1)
        while True:
            share = stresses(bonds, data) / bonds.strength
            if not np.isfinite(share).all():
                raise ProgramError(
                    f"the forces in its bonds are no finite numbers at {data.time:.4g} s",
                    next_move="look at what pushes it: a force, a speed or a mass beyond reason, or too long a time step",
                )
            if not (share > 1).any():
                return before - int(data.eq_active.sum())
            most = np.zeros(model.nbody)
            np.maximum.at(most, bonds.pieces.ravel(), np.repeat(share, 2))
            worst = (share > 1) & (share >= most[bonds.pieces].max(axis=1))
            data.eq_active[bonds.equality[worst]] = 0
            mujoco.mj_forward(model, data)
