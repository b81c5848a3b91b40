"""The ways to push a world, and the work that each does: forces and torques on bodies and joints, controls of actuators.

The work of a force that is constant over a step is that force times the mean of the velocities at both ends, times the step:
exactly the kinetic energy that it hands to a body of constant mass. It is worked out for many steps and targets at once; of
one step and target, the products of the single numbers are summed in their order, x first.

What is noted of B targets lies number by number: the first of all of them, then the second, and so on.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from worldkit.mirror import Mirror
from worldkit.naming import names

from ..recording.describing import actuator_columns, pulled_bodies
from .force_outputs import outputs

if TYPE_CHECKING:
    import mujoco

    from .ports import Ports

FREE, BALL, SLIDE, HINGE = range(4)
"""mjtJoint."""
WRENCH = {"force": (0, 1, 2), "torque": (3, 4, 5)}
"""Numbers of a body's wrench in `xfrc_applied`, by kind."""


class Way(NamedTuple):
    """One way to push some targets. Indices are into the numbers of the engine's data (`Mirror.numbers`)."""

    array: str
    """Where nothing pushes while this array of the data is zero; empty: it is always noted."""
    inputs: Any
    speeds: Any
    forces: Any
    kind: str
    targets: Sequence[str]
    width: int
    """So many numbers of each target are told (`push_blocks`)."""
    plain: bool
    """Whether these are the inputs, as they are."""
    told: Callable[..., object]
    """Tells S steps: given (S + 1,) times, (S, …) inputs, velocities at the beginning and at the end of the steps, and forces, and
    the inputs of the step before the first, it fills (S, B) what is told, (S, width, B) numbers that are not plain, (S, B) works."""


def ways(model: "mujoco.MjModel", data: "mujoco.MjData", ports: "Ports") -> list[Way]:
    """The ways that these ports open, in the order in which the ledger tells them."""
    made = (_controls, _wrenches, _joints)
    return [way for make in made for way in make(model, _Where(Mirror(model, data, sends=False)), ports.entries)]


class _Where:
    """Flat indices of numbers of arrays."""

    def __init__(self, mirror: Mirror) -> None:
        self._mirror = mirror

    def __call__(self, array: str, items: Any, width: int = 1, wanted: Sequence[int] = (0,)) -> Any:
        """The wanted numbers of some items, of which each has so many: the first of all items, then the second, …"""
        import numpy as np

        flat = np.asarray(items, np.intp) * width + np.array(wanted, np.intp)[:, None]
        return self._mirror.at(array) // 8 + flat.reshape(-1)


def _controls(model: "mujoco.MjModel", where: _Where, entries: dict[str, list[int]]) -> Iterator[Way]:
    """Actuators, while their controls are not zero or change: the control, and the force (N, N·m) that came of it."""
    import numpy as np

    controls = np.array(entries.get("ctrl", ()), np.intp)
    if not len(controls):
        return
    pulled, columns, output = pulled_bodies(model)["actuator"], actuator_columns(model)[0], outputs(model)
    called = [  # an actuator that moves one body's joint is called `body/actuator`
        f"{pulled[output[c]][0]}/{columns[c]}" if len(pulled[output[c]]) == 1 else columns[c] for c in controls.tolist()
    ]

    def told(
        time: Any, pushed: Any, begin: Any, end: Any, exerted: Any, before: Any, acts: Any, numbers: Any, works: Any
    ) -> None:
        former = np.concatenate([before[None], pushed[:-1]])
        acts[:] = (pushed != 0) | (pushed != former)
        numbers[:, 0], numbers[:, 1] = pushed, exerted
        works[:] = exerted * (begin + end) * _half(time)

    driven = output[controls]
    yield Way(
        "", where("ctrl", controls), where("actuator_velocity", driven), where("actuator_force", driven),
        "control", called, 2, False, told,
    )  # fmt: skip


def _wrenches(model: "mujoco.MjModel", where: _Where, entries: dict[str, list[int]]) -> Iterator[Way]:
    """Forces (N) and torques (N·m) on bodies, at their centres of mass, world frame."""
    import numpy as np

    bodies, numbers = np.divmod(np.array(entries.get("xfrc_applied", ()), np.intp), 6)
    called = names(model, "body", model.nbody)
    # Where a body is all of its tree, its centre of mass is the point that its velocity refers to.
    alone = np.bincount(model.body_rootid, minlength=model.nbody)[model.body_rootid] == 1
    for kind, wanted in WRENCH.items():
        pushed = np.unique(bodies[np.isin(numbers, wanted)])
        if not len(pushed):
            continue
        carried = np.flatnonzero(~alone[pushed]) if kind == "force" else np.zeros(0, np.intp)
        parts = [where("cvel", pushed, 6, (3, 4, 5) if kind == "force" else (0, 1, 2))]
        if len(carried):
            trees = model.body_rootid[pushed[carried]]
            parts.append(where("cvel", pushed[carried], 6, (0, 1, 2)))
            parts += [where("xipos", pushed[carried], 3, (0, 1, 2)), where("subtree_com", trees, 3, (0, 1, 2))]
        ends = np.cumsum([len(part) for part in parts])

        def moves(speeds: Any, ends: Any = ends, carried: Any = carried) -> Any:
            """(S, 3, B) velocities of what is pushed, m/s or rad/s."""
            first, *rest = np.split(speeds, ends[:-1], axis=1)
            found = first.reshape(len(speeds), 3, -1)
            if rest:
                spin, centre, tree = (part.reshape(len(speeds), 3, -1) for part in rest)
                found = found.copy()
                found[:, :, carried] += np.cross(spin, centre - tree, axis=1)
            return found

        yield Way(
            "xfrc_applied", where("xfrc_applied", pushed, 6, wanted), np.concatenate(parts), np.zeros(0, np.intp),
            kind, [called[body] for body in pushed], 3, True, _told(3, moves),
        )  # fmt: skip


def _joints(model: "mujoco.MjModel", where: _Where, entries: dict[str, list[int]]) -> Iterator[Way]:
    """Forces on joints, as force (N) or torque (N·m) on the bodies that own them, world frame.

    Forces and velocities of joints are dual: their product is the power, whatever their frame.
    """
    import numpy as np

    dofs = np.array(entries.get("qfrc_applied", ()), np.intp)
    owner = model.dof_jntid[dofs]
    kind, place = model.jnt_type[owner], dofs - model.jnt_dofadr[owner]
    bodies, joints = names(model, "body", model.nbody), names(model, "joint", model.njnt)
    turns = (kind == BALL) | ((kind == FREE) & (place >= 3))
    for word, mine, width in (
        ("force", (kind == FREE) & (place < 3), 3), ("torque", turns, 3), ("torque", kind == HINGE, 1), ("force", kind == SLIDE, 1)
    ):  # fmt: skip
        pushed = np.unique(owner[mine])
        if not len(pushed):
            continue
        of = model.jnt_bodyid[pushed].tolist()
        called = [
            bodies[body] if model.body_jntnum[body] == 1 else f"{bodies[body]}/{joints[joint]}"
            for body, joint in zip(of, pushed.tolist(), strict=True)
        ]
        first = model.jnt_dofadr[pushed] + np.where((model.jnt_type[pushed] == FREE) & (word == "torque"), 3, 0)
        numbers = range(width)
        parts = [where("qvel", first, 1, numbers)]
        if width == 1:
            parts.append(where("xaxis", pushed, 3, (0, 1, 2)))
        elif word == "torque":
            parts.append(where("xmat", of, 9, range(9)))
        count = len(parts[0])

        def moves(speeds: Any, count: int = count, width: int = width) -> Any:
            return speeds[:, :count].reshape(len(speeds), width, -1)

        def seen(force: Any, begin: Any, count: int = count, width: int = width) -> Any:
            """(S, 3, J) the joints' own forces (S, width, J), in the world frame."""
            frame = begin[:, count:]
            if width == 1:
                return frame.reshape(len(force), 3, -1) * force
            return np.einsum("sklj,slj->skj", frame.reshape(len(force), 3, 3, -1), force)

        inputs = where("qfrc_applied", first, 1, numbers)
        plain = len(parts) == 1
        yield Way(
            "qfrc_applied", inputs, np.concatenate(parts), np.zeros(0, np.intp),
            word, called, 3, plain, _told(width, moves, None if plain else seen),
        )  # fmt: skip


def _told(width: int, moves: Callable[..., Any], seen: Callable[..., Any] | None = None) -> Callable[..., object]:
    """What tells of targets pushed by `width` numbers each, moving as `moves` says, as they are `seen`."""
    import numpy as np

    kept = np.zeros((0, 0, 0))  # what is made anew every time is fresh pages every time

    def told(
        time: Any, pushed: Any, begin: Any, end: Any, _exerted: Any, _before: Any, acts: Any, numbers: Any, works: Any
    ) -> None:
        nonlocal kept
        force = pushed.reshape(len(pushed), width, -1)
        if len(kept) < len(force):
            kept = np.empty(force.shape)
        shares = np.add(moves(begin), moves(end), out=kept[: len(force)])
        shares *= force
        works[:] = shares[:, 0]
        for n in range(1, width):
            works += shares[:, n]
        works *= _half(time)
        if seen is not None:
            numbers[:] = seen(force, begin)
        acts[:] = everyone = numbers[:, 0].all()
        if not everyone:
            np.not_equal(numbers[:, 0], 0, out=acts)
            for n in (1, 2):
                acts |= numbers[:, n] != 0

    return told


def _half(time: Any) -> Any:
    """(S, 1) s: half of each step."""
    import numpy as np

    return np.diff(time)[:, None] / 2
