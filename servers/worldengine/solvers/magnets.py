"""Simulate magnets, soft iron, and the eddy currents that moving magnets drive in tubes and plates of metal.

Its bodies are magnets (cylinders and bars, along their axis or longest side, and balls, along their z), balls of soft iron or steel, tubes
and plates that conduct. Each acts on every other and is acted on: what stands fast too, so the ledger holds actio and reactio.

    F = - grad U,   U = - mu0 / (4 pi) sum J . J' / r - V integral of M dB - m . B_0;   in metal i = sigma (u x B), F = i x B

`worldkit.fields` (`filaments`, `magnetism`, `eddies`) says what is left out, and the sources: soft balls do not magnetise each other,
iron is no hindrance to a field, currents follow at once. A field from far away turns magnets and magnetises iron.
"""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from worldkit.errors import ProgramError
from worldkit.fields import MU0
from worldkit.naming import names

from ..recording.columns import Column
from . import Case, each

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from worldkit.fields.filaments import Filaments

CONSTANTS = {"remanence": ("T", "of each body along its axis or longest side; negative: the other way; 0: no magnet")}
OPTIONAL = {
    "saturation": ("T", "of each body of soft iron, which is balls; 0: none"),
    "conductivity": ("S/m", "of each body, a tube or a plate of metal; 0: none"),
    "field_x": ("T", "of a field from far away, along X"),
    "field_y": ("T", "along Y"),
    "field_z": ("T", "along Z"),
}
EACH = frozenset({"remanence", "saturation", "conductivity"})
STANDING = True
SPHERE, CYLINDER, BOX = 2, 5, 6
"""mjtGeom."""
ENERGY = Column("energy", (), "J", "of the field, 0 with all bodies far apart")
HEAT = Column("heat", (), "J", "of eddy currents, since the start")
REACH = 3.5
"""So many of its radii away from a magnet, what a tube brakes is below a thousandth."""

_BALL = 1.3 / MU0 * 4 / 3 * math.pi * 0.005**3
"""A m^2: the moment of a ball of 1 cm."""
_WALL = 15 / 1024 * (MU0 * _BALL) ** 2 * 5.8e7 * (0.0075**-3 - 0.0095**-3)
"""kg/s: its drag in a long tube of copper."""
_RIM = " ".join(
    f"{r * math.cos(a):.9f} {r * math.sin(a):.9f} {z}"
    for r in (0.0075, 0.0095) for z in (-0.15, 0.15) for a in (math.tau * n / 24 for n in range(24))
)  # fmt: skip
CASES = (
    Case(
        '<mujoco><option timestep="0.002" gravity="0 0 0"/><worldbody><body name="a"><freejoint/><geom size="0.005" mass="9"/></body>'
        '<body name="b" pos="0 0 0.05"><freejoint/><geom size="0.005" mass="9"/></body></worldbody></mujoco>',
        bodies=("a", "b"),
        constants={"remanence": 1.3},
        seconds=0.02,
        channel="energy",
        expected=-MU0 * _BALL**2 / (2 * math.pi * 0.05**3),
        tolerance=1e-4 * MU0 * _BALL**2 / (2 * math.pi * 0.05**3),
        because="Griffiths, Introduction to Electrodynamics, problem 6.3: two dipoles on one axis",
    ),
    Case(
        f'<mujoco><option timestep="0.001"/><asset><mesh name="m" vertex="{_RIM}"/></asset><worldbody><body name="tube">'
        '<geom type="mesh" mesh="m" contype="0" conaffinity="0"/></body><body name="a" pos="0 0 0.05"><joint type="slide" axis="0 0 1"/>'
        '<geom size="0.005" mass="0.004"/></body></worldbody></mujoco>',
        bodies=("a", "tube"),
        constants={"remanence": (1.3, 0.0), "conductivity": (0.0, 5.8e7)},
        seconds=0.2,
        channel="heat",
        expected=(0.004 * 9.81) ** 2 / _WALL * (0.2 - 1.5 * 0.004 / _WALL),
        tolerance=0.01 * (0.004 * 9.81) ** 2 / _WALL * 0.2,
        because="Saslow, Am. J. Phys. 60, 693: its drag in a long tube is k v, so v = m g / k (1 - exp(-k t / m)), and heat is k v^2",
    ),
)


class Magnets:
    """They, at work in one world."""

    def __init__(
        self, model: "mujoco.MjModel", data: "mujoco.MjData", bodies: Sequence[int], constants: Mapping[str, Any]
    ) -> None:
        import numpy as np

        from worldkit.fields import bores, filaments

        count = len(bodies)
        self._model, self._bodies = model, np.array(bodies)
        self._remanence, self._saturation, conducts = (each(constants.get(name, 0.0), count) for name in ("remanence", "saturation", "conductivity"))  # fmt: skip
        self._uniform = np.array([constants.get(f"field_{axis}", 0.0) for axis in "xyz"], float)
        self._magnets: list[tuple[int, int, Filaments]] = []
        """Row, geom, and currents in the geom's frame."""
        self._nets = []
        soft: list[tuple[int, int]] = []
        called = names(model, "body", model.nbody)
        for row, body in enumerate(bodies):
            name = called[body]
            kinds = (self._remanence[row] != 0, self._saturation[row] != 0, conducts[row] != 0)
            if sum(kinds) > 1 or min(self._saturation[row], conducts[row]) < 0:
                raise ProgramError(
                    f"{name!r} is a magnet, soft iron and a conductor at once, or has less of it than none",
                    "interventions",
                    "give it one of remanence, saturation (above 0) and conductivity (above 0), and 0 for the others",
                )
            solid = bores.solid(model, body)
            if kinds[0]:
                self._magnets += [(row, g, _magnet(filaments, model, g, self._remanence[row], name)) for g in solid]
            if kinds[1]:
                if odd := [g for g in solid if model.geom_type[g] != SPHERE]:
                    what = f"{name!r} is soft iron, and its geom {odd[0]} is no ball"
                    raise ProgramError(what, "interventions", "make it of balls: of others nothing is known here")
                soft += [(row, g) for g in solid]
            if kinds[2]:
                self._nets.append((row, body, *_conductor(model, body, solid, conducts[row], name)))
        self._half = {geom: float(np.linalg.norm(own.at, axis=1).max()) for _, geom, own in self._magnets}
        self._soft = np.array([g for _, g in soft], int)
        self._soft_of = np.array([row for row, _ in soft], int)
        self._volume = 4 / 3 * np.pi * model.geom_size[self._soft, 0] ** 3
        self._power = 0.0
        self.channels = {ENERGY: np.zeros(()), HEAT: np.zeros(())}

    def look(self, data: "mujoco.MjData") -> "np.ndarray":
        """The field's energy, the power of the currents, and the forces (n, 6)."""
        import numpy as np

        from worldkit.fields import magnetism
        from worldkit.fields.filaments import Filaments, cross

        wrench = np.zeros((len(self._bodies), 6))
        middles = data.xipos[self._bodies]

        def push(row: int, at: "np.ndarray", forces: "np.ndarray", turned: Any = 0.0) -> None:
            wrench[row, :3] += forces.sum(axis=0)
            wrench[row, 3:] += (cross(at - middles[row], forces) + turned).sum(axis=0)

        placed = []
        energy = 0.0
        for row, geom, own in self._magnets:
            turn = data.geom_xmat[geom].reshape(3, 3).T
            magnet = Filaments(data.geom_xpos[geom] + own.at @ turn, own.current @ turn, own.smeared)
            placed.append((row, geom, magnet))
            moment = own.moment @ turn
            wrench[row, 3:] += cross(moment, self._uniform)
            energy -= float(moment @ self._uniform)
        for n, (row, _, magnet) in enumerate(placed):
            for other, _, second in placed[:n]:
                if other != row:
                    felt, here = magnetism.between(magnet, second), len(magnet.at)
                    push(row, magnet.at, felt.currents[:here], felt.turned[:here])
                    push(other, second.at, felt.currents[here:], felt.turned[here:])
                    energy += felt.energy
        if len(self._soft) and placed:
            whole = Filaments(*map(np.concatenate, zip(*(magnet for _, _, magnet in placed), strict=True)))
            balls = data.geom_xpos[self._soft]
            felt = magnetism.on_balls(whole, balls, self._volume, self._saturation[self._soft_of], self._uniform)
            energy += felt.energy
            first = 0
            for row, _, magnet in placed:
                mine = slice(first, first + len(magnet.at))
                push(row, magnet.at, felt.currents[mine], felt.turned[mine])
                first += len(magnet.at)
            for n, row in enumerate(self._soft_of):
                push(int(row), balls[n : n + 1], felt.balls[n : n + 1])
        self._power = sum(self._currents(data, net, placed, push) for net in self._nets)
        self.channels[ENERGY][...] = energy
        return wrench

    def advance(self, step_s: float) -> None:
        """Add up what currents warmed."""
        self.channels[HEAT][...] += self._power * step_s

    def _currents(self, data: "mujoco.MjData", net: Any, placed: Any, push: Any) -> float:
        """Push what a conductor and the magnets by it do to each other; the power that its currents take, W."""
        import numpy as np

        from worldkit.fields.filaments import cross, field

        from ..inputs.pushes import twist

        row, body, conductor, place, turn, far = net
        near = [magnet for magnet in placed if magnet[0] != row]
        world = data.xmat[body].reshape(3, 3)
        middle = data.xpos[body] + world @ place
        used = conductor.near(
            [((data.geom_xpos[geom] - middle) @ (world @ turn), self._half[geom]) for _, geom, _ in near], far
        )
        if not len(used.at):
            return 0.0
        at, along = middle + used.at @ (world @ turn).T, used.along @ (world @ turn).T
        moves = _moves(twist(self._model, data, body), data.xipos[body], at)
        fields = [field(at, magnet) for _, _, magnet in near]
        driven = cross(moves, np.broadcast_to(self._uniform, at.shape))
        for (whose, _, _), own in zip(near, fields, strict=True):
            of = int(self._bodies[whose])
            driven += cross(moves - _moves(twist(self._model, data, of), data.xipos[of], at), own)
        driven = np.einsum("ej,ej->e", driven, along)
        current = used.currents(driven)
        pieces = current[:, None] * along
        push(row, at, cross(pieces, sum(fields, np.broadcast_to(self._uniform, at.shape))))
        for (whose, _, _), own in zip(near, fields, strict=True):
            push(whose, at, -cross(pieces, own))
        return float((current * driven).sum())


def _moves(twist: "np.ndarray", middle: "np.ndarray", at: "np.ndarray") -> "np.ndarray":
    """(p, 3) m/s of the places of a body that moves so about its middle."""
    from worldkit.fields.filaments import cross

    return twist[:3] + cross(twist[3:], at - middle)


def _magnet(filaments: Any, model: "mujoco.MjModel", geom: int, remanence: float, name: str) -> "Filaments":
    """A geom's currents, in its own frame."""
    import numpy as np

    kind, size = int(model.geom_type[geom]), model.geom_size[geom]
    if kind == SPHERE:
        return filaments.ball(size[0], remanence)
    if kind == CYLINDER:
        return filaments.cylinder(size[0], 2 * size[1], remanence)
    if kind != BOX:
        what = f"the magnet {name!r} has a geom that is no ball, cylinder or box"
        raise ProgramError(what, "interventions", "make it of these, each magnetised along its axis or longest side")
    long = filaments.axis_of(True, size)
    order = [(long + 1) % 3, (long + 2) % 3, long]  # its own z is the longest side
    made = filaments.bar(*(2 * size[order]), remanence)
    back = np.argsort(order)
    return made._replace(at=made.at[:, back], current=made.current[:, back])


def _conductor(
    model: "mujoco.MjModel", body: int, geoms: Sequence[int], conductivity: float, name: str
) -> tuple[Any, ...]:
    """A net in its own frame, its middle (3,) and turn (3, 3) in the body's, and how far from a magnet it counts, m."""
    import numpy as np

    from worldkit.fields import bores, eddies
    from worldkit.turning import matrices

    if len(geoms) == 1 and model.geom_type[geoms[0]] == BOX:
        size = 2 * model.geom_size[geoms[0]]
        thin = int(np.argmin(size))
        order = [(thin + 1) % 3, (thin + 2) % 3, thin]
        turn = matrices(model.geom_quat[geoms[0]]) @ np.eye(3)[:, order]
        width, depth, thickness = map(float, size[order])
        return eddies.plate(width, depth, thickness, conductivity), model.geom_pos[geoms[0]].copy(), turn, np.inf
    if (found := bores.of_geoms(model, geoms)) is not None:
        net = eddies.tube(found.inner, found.outer, found.length, conductivity)
        return net, found.middle, found.turn, REACH * found.outer
    what = f"{name!r} conducts, and is neither a straight tube along an axis of its own nor one box"
    raise ProgramError(what, "interventions", "give it the primitive `tube` with a straight path, or `box`")


def start(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    bodies: Sequence[int],
    constants: Mapping[str, Any],
    shown_by: str = "",
) -> Magnets:
    """Start them where they are."""
    return Magnets(model, data, bodies, constants)


def show(model: "mujoco.MjModel", data: "mujoco.MjData", geom: int, channels: Mapping[str, Any]) -> None:
    """Do nothing: no field is seen."""
