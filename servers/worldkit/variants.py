"""The same world with one thing changed: a finer time step, a cause taken away, a cause made weaker.

A variant needs no help from the program: it is applied to the compiled model, and around the program's `control`
(`hold`), whatever they are. Bodies are never deleted, so that the program's indices and the recording's columns stay
what they are.

Taken away (`--without NAME`):
    body      it and what it carries touch nothing, hang still, and pull at no equality, tendon or actuator; whatever
              the program writes to them is undone
    geom      it touches nothing
    joint     its spring, its friction, its motors and its initial velocity are gone
    actuator  it exerts no force
    equality  it is off, whatever the program says
    tendon    it carries nothing: no spring, no limit, no motor
    flex      it touches nothing
    gravity, wind, control (everything the program's control writes)
    force:BODY torque:BODY pose:BODY velocity:BODY mocap:BODY control:ACTUATOR constraint:EQUALITY parameter:OWNER
    callback:NAME   one intervention, as the ledger calls it, is undone each time it is made

Made weaker (`--weaken NAME=FACTOR`, 0 < FACTOR):
    body      mass, weight's acceleration, initial and surface speed, and the accelerations its own motors and the
              program's forces give it, all times FACTOR: everything it could push or pull with; or one of `BODY.mass`,
              `BODY.velocity`, `BODY.weight`
    joint     spring, motors, initial velocity      actuator  its force and what it is asked for
    tendon    spring, damper, motors                gravity, wind
    force: torque: pose: velocity: mocap: control: parameter:    what is written, times FACTOR

A bare name means every object that has it; where a body has the name of its joint or geom, the body is meant.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .describe import names
from .errors import ProgramError

if TYPE_CHECKING:
    import mujoco

    from .holding import Hold

OBJECTS = ("body", "geom", "joint", "actuator", "equality", "tendon", "flex")
WORLD = ("gravity", "wind", "control")
WRITES = ("force", "torque", "pose", "velocity", "mocap", "control", "constraint", "parameter", "callback")
ASPECTS = ("mass", "velocity", "weight")
IMMOVABLE = 1e10
"""Added to the inertia of a joint that must not move, kg or kg m^2."""
APART_M = 1e9
"""A contact margin no distance can pass."""
MOST_NAMES = 40


@dataclass(frozen=True)
class Variant:
    """What is different from the program as written."""

    time_step_factor: float = 1.0
    without: tuple[str, ...] = ()
    weaken: tuple[tuple[str, float], ...] = ()

    @classmethod
    def parse(cls, factor: float | None, without: Sequence[str], weaken: Sequence[str]) -> "Variant":
        """From the command line; a `ProgramError` says what is wrong with an option."""
        factor = 1.0 if factor is None else factor
        if not 0 < factor <= 1 or abs(1 / factor - round(1 / factor)) > 1e-9:
            raise ProgramError(
                f"the time step cannot be multiplied by {factor:g}",
                "--time-step-factor",
                "use 0.5, or another whole fraction of one, so that the recorded instants stay the same",
            )
        weaker = []
        for text in weaken:
            name, sign, number = text.rpartition("=")
            try:
                value = float(number)
            except ValueError:
                value = -1.0
            if not (sign and name and 0 < value < 1e6):
                raise ProgramError(
                    f"'{text}' does not say what to weaken by how much", "--weaken", "write NAME=FACTOR, e.g. foot=0.5"
                )
            weaker.append((name, value))
        return cls(factor, tuple(without), tuple(weaker))

    def __bool__(self) -> bool:
        return self.time_step_factor != 1.0 or bool(self.without or self.weaken)

    @property
    def steps_per_step(self) -> int:
        """Steps of the variant in one step of the program as written."""
        return round(1 / self.time_step_factor)

    def as_meta(self) -> dict[str, Any]:
        """As it stands in `meta.json` and `result.json`."""
        return {
            "time_step_factor": self.time_step_factor,
            "without": list(self.without),
            "weaken": [list(pair) for pair in self.weaken],
        }


def apply(
    model: "mujoco.MjModel", variant: Variant, control: Callable[..., Any] | None
) -> Callable[["mujoco.MjModel", "mujoco.MjData"], object] | None:
    """Change the compiled model, and return the control function to simulate it with.

    Raises:
        ProgramError: a name that is not in the world (the known ones are listed), or that cannot be weakened.
    """
    import mujoco

    from .holding import Hold

    hold = Hold(model)
    edit = _Edit(model, hold)
    for name in variant.without:
        for kind, index in resolve(model, name, "--without"):
            edit.remove(kind, index)
    for name, factor in variant.weaken:
        whole, aspect = name, ""
        if "." in name and name.rsplit(".", 1)[1] in ASPECTS and not _known(model, name):
            whole, aspect = name.rsplit(".", 1)
        for kind, index in resolve(model, whole, "--weaken"):
            edit.weaken(kind, index, factor, aspect)
    if variant.without or variant.weaken:
        mujoco.mj_setConst(model, mujoco.MjData(model))
    model.opt.timestep *= variant.time_step_factor
    return hold.around(control)


def resolve(model: "mujoco.MjModel", name: str, place: str = "") -> list[tuple[str, Any]]:
    """(kind, index or target) of everything that a name means."""
    if name in WORLD:
        return [(name, -1)]
    kind, colon, target = name.partition(":")
    if colon and kind in WRITES:
        return [(f"write {kind}", target)] if _writable(model, kind, target, place) else []
    if colon and kind in OBJECTS:
        known = names(model, kind, _count(model, kind))
        if target in known:
            return [(kind, known.index(target))]
    found = _known(model, name)
    if not found:
        raise ProgramError(f"there is no {name} in this world", place, _remedy(model))
    return found


def _count(model: "mujoco.MjModel", kind: str) -> int:
    counts = {
        "body": "nbody",
        "geom": "ngeom",
        "joint": "njnt",
        "equality": "neq",
        "tendon": "ntendon",
        "flex": "nflex",
    }
    return len(model.actuator_trntype) if kind == "actuator" else int(getattr(model, counts[kind]))


def _known(model: "mujoco.MjModel", name: str) -> list[tuple[str, Any]]:
    found = []
    for kind in OBJECTS:
        known = names(model, kind, _count(model, kind))
        if name in known[1:] if kind == "body" else name in known:
            found.append((kind, known.index(name)))
    kinds = [kind for kind, _ in found]
    return [(k, i) for k, i in found if not ("body" in kinds and k in ("joint", "geom"))]


def _remedy(model: "mujoco.MjModel") -> str:
    parts = []
    for kind in OBJECTS:
        known = [n for n in names(model, kind, _count(model, kind)) if n != "world"]
        if known:
            more = f" and {len(known) - MOST_NAMES} more" if len(known) > MOST_NAMES else ""
            parts.append(f"{kind}: {', '.join(known[:MOST_NAMES])}{more}")
    return f"name one of {'; '.join(parts)}; {', '.join(WORLD)}; or an intervention such as force:BODY"


def _writable(model: "mujoco.MjModel", kind: str, target: str, place: str) -> bool:
    """Whether the target of an intervention exists; a `ProgramError` otherwise."""
    owner = target.partition("/")[0].partition("[")[0]
    if kind == "callback" or (kind == "parameter" and target):
        return True
    wanted = {"control": "actuator", "constraint": "equality"}.get(kind, "body")
    known = names(model, wanted, _count(model, wanted))
    if target in known or owner in known or target.rpartition("/")[2] in known:
        return True
    raise ProgramError(
        f"there is no {wanted} {target}", place, f"name one of: {', '.join(known[:MOST_NAMES]) or f'no {wanted}s'}"
    )


class _Edit:
    """Takes things out of a compiled model, or makes them weaker."""

    def __init__(self, model: "mujoco.MjModel", hold: "Hold") -> None:
        self.model, self.hold = model, hold

    def remove(self, kind: str, index: Any) -> None:
        """Take one thing out."""
        model = self.model
        if kind.startswith("write "):
            self.hold.write(kind.removeprefix("write "), index, 0.0)
        elif kind == "body":
            self._remove_body(index)
        elif kind == "geom":
            self._untouchable([index])
        elif kind == "joint":
            self._scale_joint(index, 0.0)
            model.dof_frictionloss[self._dofs(index)] = 0.0
        elif kind == "actuator":
            self._scale_actuator(index, 0.0)
        elif kind == "equality":
            self._off(index)
        elif kind == "tendon":
            self._scale_tendon(index, 0.0)
            model.tendon_frictionloss[index] = 0.0
            model.tendon_limited[index] = 0
        elif kind == "flex":
            model.flex_contype[index] = model.flex_conaffinity[index] = 0
        elif kind == "control":
            self.hold.everything()
        else:
            getattr(model.opt, kind)[:] = 0.0

    def weaken(self, kind: str, index: Any, factor: float, aspect: str) -> None:
        """Make one thing weaker."""
        if aspect and kind != "body":
            raise ProgramError(
                f"only a body has a {aspect} to weaken", "--weaken", f"name a body, or leave out .{aspect}"
            )
        if kind.startswith("write ") and kind.removeprefix("write ") not in ("constraint", "callback"):
            self.hold.write(kind.removeprefix("write "), index, factor)
        elif kind == "body":
            self._weaken_body(index, factor, aspect)
        elif kind == "joint":
            self._scale_joint(index, factor)
        elif kind == "actuator":
            self._scale_actuator(index, factor)
        elif kind == "tendon":
            self._scale_tendon(index, factor)
        elif kind in ("gravity", "wind"):
            getattr(self.model.opt, kind)[:] *= factor
        else:
            raise ProgramError(
                f"{'the program’s control' if kind == 'control' else f'a {kind}'} is there or not: it cannot be weakened",
                "--weaken",
                "take it away with --without, or weaken a body, a joint, an actuator, a tendon, gravity or wind",
            )

    # -- bodies ------------------------------------------------------------------------------------------------------

    def _carried(self, body: int) -> list[int]:
        """The body and everything below it."""
        found = [body]
        for other in range(body + 1, self.model.nbody):
            if self.model.body_parentid[other] in found:
                found.append(other)
        return found

    def _joints(self, bodies: list[int]) -> list[int]:
        return [j for j in range(self.model.njnt) if self.model.jnt_bodyid[j] in bodies]

    def _dofs(self, joint: int) -> slice:
        width = {0: 6, 1: 3}.get(int(self.model.jnt_type[joint]), 1)
        first = int(self.model.jnt_dofadr[joint])
        return slice(first, first + width)

    def _remove_body(self, body: int) -> None:
        from .describe import pulled_bodies

        model, carried = self.model, self._carried(body)
        called = {name for i, name in enumerate(names(model, "body", model.nbody)) if i in carried}
        pulled = pulled_bodies(model)
        self._untouchable([g for g in range(model.ngeom) if model.geom_bodyid[g] in carried])
        for actuator, first in enumerate(model.actuator_outadr):
            outputs = pulled["actuator"][first : first + model.actuator_outnum[actuator]]
            if any(called.intersection(bodies) for bodies in outputs):
                self._scale_actuator(actuator, 0.0)
        for tendon, bodies in enumerate(pulled["tendon"]):
            if called.intersection(bodies):
                self.remove("tendon", tendon)
        for equality in range(model.neq):
            if self._tied(equality) & set(carried):
                self._off(equality)
        for joint in self._joints(carried):
            dofs = self._dofs(joint)
            model.dof_armature[dofs] += IMMOVABLE
            model.key_qvel[:, dofs] = 0.0
        for index in carried:
            for kind in ("force", "torque", "pose", "velocity", "mocap"):
                self.hold.write(kind, names(model, "body", model.nbody)[index], 0.0)

    def _weaken_body(self, body: int, factor: float, aspect: str) -> None:
        """Everything slower by `factor`: forces on it shrink by its square, since its mass shrinks too."""
        model, carried = self.model, self._carried(body)
        known = names(model, "body", model.nbody)
        if not aspect or aspect == "mass":
            model.body_mass[carried] *= factor
            model.body_inertia[carried] *= factor
        if not aspect or aspect == "weight":
            model.body_gravcomp[carried] = 1 - factor * (1 - model.body_gravcomp[carried])
        joints = self._joints(carried)
        if not aspect or aspect == "velocity":
            for joint in joints:
                model.key_qvel[:, self._dofs(joint)] *= factor
        if aspect:
            return
        geoms = [g for g in range(model.ngeom) if model.geom_bodyid[g] in carried]
        model.geom_surfacevel[geoms] *= factor
        model.geom_adhesion[geoms] *= factor**2
        for actuator in range(len(model.actuator_trntype)):
            if model.actuator_trntype[actuator] <= 1 and model.actuator_trnid[actuator, 0] in joints:
                self._scale_actuator(actuator, factor**2)
        for index in carried:
            for kind, power in (("force", 2), ("torque", 2), ("pose", 1), ("velocity", 1), ("mocap", 1)):
                self.hold.write(kind, known[index], factor**power)

    def _untouchable(self, geoms: list[int]) -> None:
        import numpy as np

        model = self.model
        model.geom_contype[geoms] = model.geom_conaffinity[geoms] = 0
        named = np.isin(model.pair_geom1, geoms) | np.isin(model.pair_geom2, geoms)
        model.pair_margin[named], model.pair_gap[named] = -APART_M, 0.0

    # -- joints, actuators, tendons, equalities ----------------------------------------------------------------------

    def _scale_joint(self, joint: int, factor: float) -> None:
        model, dofs = self.model, self._dofs(joint)
        model.jnt_stiffness[joint] *= factor
        model.jnt_stiffnesspoly[joint] *= factor
        model.key_qvel[:, dofs] *= factor
        for actuator in range(len(model.actuator_trntype)):
            if model.actuator_trntype[actuator] <= 1 and model.actuator_trnid[actuator, 0] == joint:
                self._scale_actuator(actuator, factor)

    def _scale_tendon(self, tendon: int, factor: float) -> None:
        model = self.model
        for array in (
            model.tendon_stiffness,
            model.tendon_stiffnesspoly,
            model.tendon_damping,
            model.tendon_dampingpoly,
        ):
            array[tendon] *= factor
        for actuator in range(len(model.actuator_trntype)):
            if model.actuator_trntype[actuator] == 3 and model.actuator_trnid[actuator, 0] == tendon:
                self._scale_actuator(actuator, factor)

    def _scale_actuator(self, actuator: int, factor: float) -> None:
        """Its force; and what it is asked for, since a stiff servo made weaker would still do as it is told."""
        import numpy as np

        model = self.model
        if factor == 0.0:
            model.actuator_forcelimited[actuator] = 1
            model.actuator_forcerange[actuator] = 0.0
            return
        from_control = slice(
            model.actuator_ctrladr[actuator], model.actuator_ctrladr[actuator] + model.actuator_ctrlnum[actuator]
        )
        model.key_ctrl[:, from_control] *= factor
        model.actuator_gainprm[actuator] *= factor
        model.actuator_biasprm[actuator] *= factor
        if np.any(model.actuator_forcelimited[actuator]):
            model.actuator_forcerange[actuator] *= factor
        self.hold.write("control", names(model, "actuator", len(model.actuator_trntype))[actuator], factor)

    def _off(self, equality: int) -> None:
        self.model.eq_active0[equality] = 0
        self.hold.write("constraint", names(self.model, "equality", self.model.neq)[equality], 0.0)

    def _tied(self, equality: int) -> set[int]:
        """Bodies that an equality holds."""
        from .describe import tied_bodies

        known = names(self.model, "body", self.model.nbody)
        return {known.index(name) for name in tied_bodies(self.model, equality, known)}
