"""Less friction at contacts, sliding, spinning and rolling: at all of them, or at those of some geoms.

Where two surfaces meet, the larger friction acts, so that a slippery thing would still rub on rough ground. A pair of two geoms
has a friction of its own, which is scaled; all other contacts of these geoms take theirs from them, as they are given
priority over whatever they meet, and with it softness, rebound and kind: those that the contacts had. Source: MuJoCo manual,
"Contact parameters".
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from worldkit.errors import ProgramError

if TYPE_CHECKING:
    import mujoco
    import numpy as np


def everywhere(model: "mujoco.MjModel", factor: float) -> None:
    """Scale the friction of every contact of the engine's."""
    for array in (model.geom_friction, model.pair_friction, model.flex_friction, model.opt.o_friction):
        array[:] *= factor


def of_geoms(model: "mujoco.MjModel", geoms: Sequence[int], factor: float) -> None:
    """Scale the friction of every contact of these geoms, and nothing else of it.

    Raises:
        ProgramError: their contacts are of several kinds of softness or rebound, of which a geom can have only one.
    """
    import numpy as np

    if not len(geoms):
        return
    mine = np.isin(model.pair_geom1, geoms) | np.isin(model.pair_geom2, geoms)
    made = [(geom, _contact(model, geom)) for geom in geoms]
    model.pair_friction[mine] *= factor
    for geom, (solref, solimp, condim, friction) in made:
        model.geom_solref[geom], model.geom_solimp[geom], model.geom_condim[geom] = solref, solimp, condim
        model.geom_friction[geom] = factor * friction
    model.geom_priority[geoms] = model.geom_priority.max() + 1


def _contact(model: "mujoco.MjModel", geom: int) -> tuple["np.ndarray", "np.ndarray", int, "np.ndarray"]:
    """solref (2,), solimp (5,), condim and friction (3,) of the contacts of a geom that have no pair of their own; where the
    frictions differ the smallest."""
    import numpy as np

    ours = (model.geom_solref[geom], model.geom_solimp[geom], int(model.geom_condim[geom]), model.geom_friction[geom])
    weld = model.body_weldid[model.geom_bodyid]
    paired = {frozenset(pair) for pair in zip(model.pair_geom1.tolist(), model.pair_geom2.tolist(), strict=True)}
    meets = (model.geom_contype[geom] & model.geom_conaffinity) | (model.geom_contype & model.geom_conaffinity[geom])
    others = [
        int(other)
        for other in np.flatnonzero((meets != 0) & (weld != weld[geom]))
        if frozenset((geom, int(other))) not in paired
    ]
    found = [_mixed(model, geom, other) for other in others]
    if not found:
        return ours
    first = found[0]
    if any(other[2] != first[2] or any(not np.array_equal(first[k], other[k]) for k in (0, 1)) for other in found[1:]):
        names = sorted({model.geom(other).name or f"geom {other}" for other in others})
        raise ProgramError(
            f"the friction of {model.geom(geom).name or 'it'} alone cannot be changed: it meets {', '.join(names[:4])} with unlike softness "
            "or rebound",
            "",
            "name the cause `friction`, or give what meets rows under `pairs`",
        )
    return (*first[:3], np.min([other[3] for other in found], axis=0))


def _mixed(model: "mujoco.MjModel", one: int, other: int) -> tuple["np.ndarray", "np.ndarray", int, "np.ndarray"]:
    """solref, solimp, condim and friction of a contact of two geoms, as the engine makes them."""
    import numpy as np

    above = int(model.geom_priority[one]) - int(model.geom_priority[other])
    if above:
        geom = one if above > 0 else other
        condim = int(model.geom_condim[geom])
        return model.geom_solref[geom].copy(), model.geom_solimp[geom].copy(), condim, model.geom_friction[geom].copy()
    first, second = (float(model.geom_solmix[geom]) for geom in (one, other))
    share = 0.5 if first + second < 1e-12 else first / (first + second)
    mine, theirs = model.geom_solref[one], model.geom_solref[other]
    soft = share * mine + (1 - share) * theirs if min(mine[0], theirs[0]) > 0 else np.minimum(mine, theirs)
    return (
        soft,
        share * model.geom_solimp[one] + (1 - share) * model.geom_solimp[other],
        int(max(model.geom_condim[one], model.geom_condim[other])),
        np.maximum(model.geom_friction[one], model.geom_friction[other]),
    )
