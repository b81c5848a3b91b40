"""List the declared inputs of a world: the entries of its data and its model that may be written from outside.

The engine's process makes this list from the plan's rows and its own model; what is not on it has no message. Entries are
flat indices by array, in the order of `worldkit.speaking.ARRAYS`: that is the layout of an answer.
"""

from typing import TYPE_CHECKING, Any

from worldkit.errors import ProgramError
from worldkit.model_arrays import owner_of
from worldkit.naming import names
from worldkit.speaking import ARRAYS

from . import flex_points
from .openings import opens

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..given import Given
    from .declared_media import Media

FREE, BALL, SLIDE, HINGE = range(4)
"""mjtJoint."""


class Ports:
    """The open entries of a world.

    Args:
        model: the world.
        rows: declared (kind, names); None opens everything. A flex' name stands for its points too.
        media: of the author's laws, which open the wrench (`xfrc_applied`) of their bodies, and nothing of their joints.

    Raises:
        ProgramError: a row opens a push on a body of a law, by its name or by a joint's.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        rows: "tuple[tuple[str, frozenset[str]], ...] | None",
        media: "Media | None" = None,
    ) -> None:
        self.media = media
        laws = {body: row.name for row in media.rows for body in row.bodies} if media is not None else {}
        points = {} if rows is None else flex_points.of_model(model)
        self._model = model
        self._rows = None if rows is None else [(kind, frozenset(flex_points.covered(of, points))) for kind, of in rows]
        self._bodies = names(model, "body", model.nbody)
        self._joints = names(model, "joint", model.njnt)
        self.entries: dict[str, list[int]] = {name: [] for name in ARRAYS}
        for kind, target, array, indices in self._candidates():
            law = laws.get(self._pushed(array, indices[0]))
            if law and self._rows is not None:
                _refuse_second(law, target, self._open(kind, target))
                opened = array == "xfrc_applied"
            else:
                opened = self._open(kind, target)
            if opened:
                self.entries[array] += indices
        self.entries = {name: sorted(set(found)) for name, found in self.entries.items() if found}
        self.parameters = self._parameters()

    @property
    def width(self) -> int:
        """The number of entries of an answer's vector."""
        return sum(map(len, self.entries.values()))

    def __bool__(self) -> bool:
        return bool(self.entries or self.parameters or self.media)

    def as_meta(self) -> dict[str, Any]:
        """The ports for the author's process and the recording: entries by array, and parameters in their order."""
        told = {**self.entries, "parameters": [[name, index] for name, index in self.parameters]}
        return told if self.media is None else {**told, "media": self.media.as_meta()}

    def _open(self, kind: str, target: str) -> bool:
        """Whether a row opens a target; a solver's row opens nothing, as the solver writes in the engine's own process."""
        rows = self._rows
        return rows is None or any(row != "solver" and opens(row, called, kind, target) for row, called in rows)

    def _pushed(self, array: str, index: int) -> str:
        """The body that an entry of an array pushes; empty where it pushes none."""
        if array == "xfrc_applied":
            return self._bodies[index // 6]
        return self._bodies[int(self._model.dof_bodyid[index])] if array == "qfrc_applied" else ""

    def _candidates(self) -> "list[tuple[str, str, str, list[int]]]":
        """(kind, target in the ledger's words, array, flat indices) of everything in an MjData that can be written."""
        from ..recording.describing import actuator_columns, pulled_bodies
        from .force_outputs import outputs

        model = self._model
        found: list[tuple[str, str, str, list[int]]] = []
        pulled = pulled_bodies(model)["actuator"]
        for control, (name, output) in enumerate(zip(actuator_columns(model)[0], outputs(model).tolist(), strict=True)):
            owners = pulled[output]
            found.append(("control", f"{owners[0]}/{name}" if len(owners) == 1 else name, "ctrl", [control]))
        for body, name in enumerate(self._bodies):
            if body:
                first = 6 * body
                found.append(("force", name, "xfrc_applied", [first, first + 1, first + 2]))
                found.append(("torque", name, "xfrc_applied", [first + 3, first + 4, first + 5]))
            mocap = int(model.body_mocapid[body])
            if mocap >= 0:
                found.append(("mocap", name, "mocap_pos", list(range(3 * mocap, 3 * mocap + 3))))
                found.append(("mocap", name, "mocap_quat", list(range(4 * mocap, 4 * mocap + 4))))
        for joint in range(model.njnt):
            found += self._of_joint(joint)
        for equality, name in enumerate(names(model, "equality", model.neq)):
            found.append(("constraint", name, "eq_active", [equality]))
        for array, size in (("act", model.na), ("plastic", model.nplastic), ("userdata", model.nuserdata)):
            found += [("parameter", f"{array}[{i}]", array, [i]) for i in range(size)]
        return found

    def _of_joint(self, joint: int) -> "list[tuple[str, str, str, list[int]]]":
        model, body = self._model, int(self._model.jnt_bodyid[joint])
        target = self._bodies[body]
        if model.body_jntnum[body] > 1:
            target = f"{target}/{self._joints[joint]}"
        first, dof, kind = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint]), int(model.jnt_type[joint])
        positions, dofs = {FREE: (7, 6), BALL: (4, 3)}.get(kind, (1, 1))
        linear = {FREE: 3, SLIDE: 1}.get(kind, 0)
        found = [
            ("pose", target, "qpos", list(range(first, first + positions))),
            ("velocity", target, "qvel", list(range(dof, dof + dofs))),
        ]
        if linear:
            found.append(("force", target, "qfrc_applied", list(range(dof, dof + linear))))
        if dofs > linear:
            found.append(("torque", target, "qfrc_applied", list(range(dof + linear, dof + dofs))))
        return found

    def _parameters(self) -> "list[tuple[str, list[int] | None]]":
        """(array of the model or option, flat indices, None for all of it) of the parameters that are open, by name."""
        import numpy as np

        from worldkit.model_arrays import Edit, values

        if self._rows is not None and not any(kind == "parameter" for kind, _ in self._rows):
            return []
        safe = {name: value for name, value in values(self._model).items() if _safe(name, value, self._rows is None)}
        if self._rows is None:
            return [(name, None) for name in sorted(safe)]
        found: list[tuple[str, list[int] | None]] = []
        for name, value in sorted(safe.items()):
            everything = Edit(name, np.arange(len(value)), value.astype(float), looks_only=False)
            mine = [
                i
                for target, index, _ in owner_of(self._model, everything)
                if self._open("parameter", target)
                for i in index.tolist()
            ]
            if mine:
                found.append((name, sorted(mine)))
        return found


CHOICES = ("geom_contype", "geom_conaffinity", "geom_group", "geom_priority", "site_group")
"""Whole numbers that may be written: masks and groups, which the engine does not take for addresses."""
LAWS = ("gravity", "wind", "magnetic", "density", "viscosity")
"""Options that a plan can declare; the engine's accuracy is nobody's input."""


def _safe(name: str, value: "np.ndarray", unplanned: bool) -> bool:
    """Whether a parameter may be written at all: the engine takes most whole numbers for addresses, and trusts them."""
    if name.startswith("opt."):
        return unplanned or name.removeprefix("opt.") in LAWS
    return value.dtype.kind in "fb" or name in CHOICES


def _refuse_second(law: str, target: str, opened: bool) -> None:
    if opened:
        cause = f"{target!r} would be pushed by the law {law} and by another input"
        move = "let one of them push it: of two forces on one body, nobody could tell whose work is whose"
        raise ProgramError(cause, "interventions", move)


def of(model: "mujoco.MjModel", given: "Given") -> Ports:
    """The ports of a world as its plan declares them."""
    return Ports(model, given.inputs)


def flat(model: "mujoco.MjModel", name: str) -> "np.ndarray":
    """A parameter's live numbers as a flat array; a number of the options is copied into an array of one."""
    import numpy as np

    option = name.removeprefix("opt.")
    return np.reshape(getattr(model.opt if option != name else model, option), -1)
