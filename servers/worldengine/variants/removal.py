"""Take things out of a compiled model, or make them weaker: the part of a variant that edits the model.

Nothing is deleted: bodies become untouchable and immovable, actuators are clamped to no force, constraints are off.
"""

from typing import TYPE_CHECKING, Any

from worldkit.errors import ProgramError
from worldkit.naming import names

from . import slippery

if TYPE_CHECKING:
    import mujoco

    from .holding import Hold

IMMOVABLE = 1e10
"""The inertia that is added to a joint that must not move, kg or kg m^2."""
APART_M = 1e9
"""As a negative margin, m, it lets no distance to a plane make a contact."""


def taken_away(model: "mujoco.MjModel", body: int) -> bool:
    """Whether a variant took this body away, or what carries it: nothing of it touches, and it does not move."""
    root = int(model.body_weldid[body])
    first, count = int(model.body_dofadr[root]), int(model.body_dofnum[root])
    return count > 0 and bool((model.dof_armature[first : first + count] >= IMMOVABLE).all())


class Removal:
    """Takes things out of a compiled model, or makes them weaker."""

    def __init__(self, model: "mujoco.MjModel", hold: "Hold") -> None:
        self.model, self.hold = model, hold

    def remove(self, kind: str, index: Any) -> None:
        """Take one thing out."""
        model = self.model
        if kind.startswith("write "):
            self.hold.write(kind.removeprefix("write "), index, 0.0)
            if kind == "write pose":
                self._unwind(index)
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
        elif kind == "friction":
            slippery.everywhere(model, 0.0)
        else:
            self._scale_law(kind, 0.0)

    def weaken(self, kind: str, index: Any, factor: float, aspect: str) -> None:
        """Make one thing weaker."""
        if aspect == "friction" and kind == "geom":
            slippery.of_geoms(self.model, [index], factor)
        elif aspect and kind != "body":
            raise ProgramError(f"only a body has a {aspect} of its own", "", f"name a body, or leave out .{aspect}")
        elif kind.startswith("write ") and kind.removeprefix("write ") != "constraint":
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
            self._scale_law(kind, factor)
        elif kind == "friction":
            slippery.everywhere(self.model, factor)
        else:
            raise ProgramError(
                f"{'the program’s control' if kind == 'control' else f'a {kind}'} is there or not: it cannot be weakened",
                "--weaken",
                "take it away with --without, or weaken a body, a joint, an actuator, a tendon, gravity, wind or friction",
            )

    def _scale_law(self, kind: str, factor: float) -> None:
        """Scale gravity or wind as the world begins, and as `control` writes it anew."""
        getattr(self.model.opt, kind)[:] *= factor
        self.hold.laws[f"opt.{kind}"] = factor

    def _unwind(self, target: str) -> None:
        """Let the springs of a body's joints begin as in the model's own pose."""
        from .holding import found

        model = self.model
        body = found(names(model, "body", model.nbody), target)
        for joint in self._joints([body]):
            first = int(model.jnt_qposadr[joint])
            end = int(model.jnt_qposadr[joint + 1]) if joint + 1 < model.njnt else model.nq
            if model.jnt_type[joint] != 0:
                model.key_qpos[:, first:end] = model.qpos0[first:end]

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
        from ..recording.describing import pulled_bodies

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
        """Make everything slower by `factor`: forces on the body shrink by its square, since its mass shrinks, too."""
        model, carried = self.model, self._carried(body)
        if aspect == "friction":
            slippery.of_geoms(model, [g for g in range(model.ngeom) if model.geom_bodyid[g] in carried], factor)
            return
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
        round_ = model.geom_rbound[np.stack([model.pair_geom1, model.pair_geom2])]
        # The engine compares the square of both radii and the margin with that of a distance: where they sum up to nought nothing is
        # near. Far below it everything is, and the algorithm for convex shapes then ignores the margin.
        apart = np.where((round_ > 0).all(axis=0), -round_.sum(axis=0), -APART_M)
        model.pair_margin[named], model.pair_gap[named] = apart[named], 0.0

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
        """Scale an actuator's force and its command, since a weaker stiff servo would still follow the command."""
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
        """The bodies that an equality holds."""
        from ..recording.describing import tied_bodies

        known = names(self.model, "body", self.model.nbody)
        return {known.index(name) for name in tied_bodies(self.model, equality, known)}
