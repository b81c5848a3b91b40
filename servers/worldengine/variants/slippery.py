"""Less friction at contacts, sliding, spinning and rolling: at all of them, or at those of some geoms.

Where two surfaces meet, the larger friction acts, so that a slippery thing would still rub on rough ground. A pair of two geoms
has a friction of its own, which is scaled; all other contacts of these geoms take theirs from them, as they are given
priority over whatever they meet, flexes too, and with it softness, rebound, adhesion and kind: those that the contacts had. Where
what they meet rubs differently, all of them take the smallest friction that they had, so that a factor of 1 changes nothing only
where it rubs alike. Source: MuJoCo manual, "Contact parameters".
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

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
    for geom, contact in made:
        model.geom_solref[geom], model.geom_solimp[geom], model.geom_condim[geom] = contact[2:5]
        model.geom_adhesion[geom] = contact.adhesion
        model.geom_friction[geom] = factor * contact.friction
    model.geom_priority[geoms] = max(model.geom_priority.max(), model.flex_priority.max(initial=0)) + 1


class Contact(NamedTuple):
    """What decides a contact: of a surface, or of two that meet."""

    priority: int
    share: float
    solref: "np.ndarray"
    solimp: "np.ndarray"
    condim: int
    friction: "np.ndarray"
    adhesion: float

    def alike(self, other: "Contact") -> bool:
        """Whether they are of one kind, softness, rebound and adhesion."""
        same = (self.condim, self.adhesion) == (other.condim, other.adhesion)
        return same and self.solref.tolist() == other.solref.tolist() and self.solimp.tolist() == other.solimp.tolist()


def _contact(model: "mujoco.MjModel", geom: int) -> Contact:
    """The contacts of a geom that have no pair of their own; where the frictions differ the smallest."""
    import numpy as np

    weld = model.body_weldid[model.geom_bodyid]
    paired = {frozenset(pair) for pair in zip(model.pair_geom1.tolist(), model.pair_geom2.tolist(), strict=True)}
    others = [
        int(other)
        for other in np.flatnonzero(_meets(model, geom, "geom") & (weld != weld[geom]))
        if frozenset((geom, int(other))) not in paired
    ]
    soft = np.flatnonzero(_meets(model, geom, "flex")).tolist()
    ours = _surface(model, "geom", geom)
    found = [_mixed(ours, _surface(model, "geom", other)) for other in others]
    found += [_mixed(ours, _surface(model, "flex", flex)) for flex in soft]
    if not found:
        return ours
    if not all(found[0].alike(other) for other in found):
        names = {model.geom(other).name or f"geom {other}" for other in others}
        names |= {model.flex(flex).name or f"flex {flex}" for flex in soft}
        raise ProgramError(
            f"the friction of {model.geom(geom).name or 'it'} alone cannot be changed: it meets {', '.join(sorted(names)[:4])} with unlike "
            "softness, rebound or adhesion",
            "",
            "name the cause `friction`, or give what meets rows under `pairs`",
        )
    return found[0]._replace(friction=np.min([other.friction for other in found], axis=0))


def _meets(model: "mujoco.MjModel", geom: int, kind: str) -> "np.ndarray":
    """(n,) which geoms, or flexes, may touch a geom by their masks."""
    import numpy as np

    types, affinities = (getattr(model, f"{kind}_{name}") for name in ("contype", "conaffinity"))
    met = (model.geom_contype[geom] & affinities) | (types & model.geom_conaffinity[geom])
    return np.asarray(met != 0)


def _surface(model: "mujoco.MjModel", kind: str, index: int) -> Contact:
    """What a geom, or a flex, has by itself."""
    names = ("priority", "solmix", "solref", "solimp", "condim", "friction")
    priority, *rest = (getattr(model, f"{kind}_{name}")[index] for name in names)
    adhesion = float(model.geom_adhesion[index]) if kind == "geom" else 0.0
    share, solref, solimp, condim, friction = rest
    return Contact(int(priority), float(share), solref.copy(), solimp.copy(), int(condim), friction.copy(), adhesion)


def _mixed(one: Contact, other: Contact) -> Contact:
    """The contact of two surfaces, as the engine makes it: of unlike priority it is the higher one's, adhesion too."""
    import numpy as np

    if one.priority != other.priority:
        return max(one, other, key=lambda surface: surface.priority)
    total = one.share + other.share
    share = 0.5 if total < 1e-12 else one.share / total
    mean = lambda a, b: share * a + (1 - share) * b  # noqa: E731
    hard = min(one.solref[0], other.solref[0]) <= 0
    return one._replace(
        solref=np.minimum(one.solref, other.solref) if hard else mean(one.solref, other.solref),
        solimp=mean(one.solimp, other.solimp),
        condim=max(one.condim, other.condim),
        friction=np.maximum(one.friction, other.friction),
        adhesion=one.adhesion + other.adhesion,
    )
