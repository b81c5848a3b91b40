"""Simulate the temperatures of bodies: they cool to what is around them, conduct where they touch, are heated, melt, and grow.

    C dT/dt = P - h A (T - T_around) - sum of K (T - T_other) over what touches

Each body has one temperature. What is molten is told as a share, and does not flow away; what has an `expansion` is as large as the plan
says at the start, and grows from there (`worldkit.fields.expansion`). Mass and surface are those of the world. Sources: Newton 1701; Incropera and DeWitt, Heat and Mass Transfer, chapter 5 (`worldkit.fields.lumped_heat`).
"""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from worldkit.errors import ProgramError
from worldkit.fields.surface_area import of_body
from worldkit.naming import names

from ..recording.columns import Column
from . import Case, each

if TYPE_CHECKING:
    import mujoco
    import numpy as np

CONSTANTS = {
    "warm": ("K", "of each of its bodies, at the start"),
    "around": ("K", "of the air and all else"),
    "specific_heat": ("J/(kg K)", "of each"),
}
OPTIONAL = {
    "cooling": ("W/(m^2 K)", "from each to the air, over its whole surface; 0 where nothing is said"),
    "contact": ("W/K", "between each two that touch; 0 where nothing is said"),
    "source": ("W", "into each; 0 where nothing is said"),
    "melts": ("K", "of each, at which it melts; 0: it does not"),
    "latent": ("J/kg", "of each, to melt it; 0: it does not"),
    "expansion": ("1/K", "of each, linear; 0: it keeps its size"),
}
EACH = frozenset({"warm", "specific_heat", "cooling", "source", "melts", "latent", "expansion"})
STANDING, PUSHES = True, False
TOUCH_M = 2e-4
"""What is nearer than this touches."""
CASES = (
    Case(
        '<mujoco><option timestep="0.005" gravity="0 0 0"/><worldbody><body name="a"><freejoint/><geom size="0.1" mass="0.05"/></body>'
        "</worldbody></mujoco>",
        bodies=("a",),
        constants={"warm": 360.0, "around": 290.0, "specific_heat": 400.0, "cooling": 100.0},
        seconds=1.0,
        channel="temperature",
        expected=290.0 + 70.0 * math.exp(-100 * 4 * math.pi * 0.01 / 20.0),
        tolerance=0.02,
        because="Newton: T - T_around falls by exp(- h A t / C)",
    ),
    Case(
        '<mujoco><option timestep="0.005"/><worldbody><body name="floor"><geom type="box" size="1 1 0.1" mass="0.1"/></body>'
        '<body name="a" pos="0 0 0.199999"><freejoint/><geom size="0.1" mass="0.05"/></body></worldbody></mujoco>',
        bodies=("a", "floor"),
        constants={"warm": (400.0, 300.0), "around": 0.0, "specific_heat": (400.0, 100.0), "contact": 10.0},
        seconds=1.0,
        channel="temperature",
        expected=300.0 + 100.0 * (2 / 3 + math.exp(-10.0 * (1 / 20 + 1 / 10)) / 3),
        tolerance=0.05,
        because="two that share heat come to C T / (C + C'), and their difference falls by exp(- K t (1 / C + 1 / C'))",
    ),
    Case(
        '<mujoco><option timestep="0.005" gravity="0 0 0"/><worldbody><body name="ice"><geom size="0.1" mass="0.1"/></body></worldbody></mujoco>',
        bodies=("ice",),
        constants={
            "warm": 263.0,
            "around": 0.0,
            "specific_heat": 2000.0,
            "source": 2e4,
            "melts": 273.0,
            "latent": 334e3,
        },
        seconds=1.0,
        channel="melted",
        expected=(2e4 - 0.1 * 2000 * 10) / (0.1 * 334e3),
        tolerance=1e-4,
        because="what is left of the heat when it is warmed up melts it",
    ),
    Case(
        '<mujoco><option timestep="0.005" gravity="0 0 0"/><worldbody><body name="rod"><geom type="box" size="0.2 0.01 0.01" mass="0.5"/></body>'
        "</worldbody></mujoco>",
        bodies=("rod",),
        constants={"warm": 300.0, "around": 0.0, "specific_heat": 400.0, "source": 2e4, "expansion": 2e-5},
        seconds=1.0,
        channel="grown",
        expected=2e-5 * 2e4 / (0.5 * 400.0),
        tolerance=1e-6,
        because="alpha (T - T0), and it warms by P t / C",
    ),
)


class Heat:
    """The temperatures of some bodies."""

    def __init__(self, model: "mujoco.MjModel", bodies: Sequence[int], constants: Mapping[str, Any]) -> None:
        import numpy as np

        from worldkit.fields.expansion import Grown
        from worldkit.fields.lumped_heat import Warmth

        count = len(bodies)
        told = {name: each(constants.get(name, 0.0), count) for name in EACH}
        self._contact = float(constants.get("contact", 0.0))
        weight, called = model.body_mass[list(bodies)], names(model, "body", model.nbody)
        capacity = weight * told["specific_heat"]
        if (odd := np.flatnonzero(~(capacity > 0))).size:
            cause = f"{called[bodies[odd[0]]]!r} has no mass, or no specific heat, and so no temperature of its own"
            raise ProgramError(cause, "interventions", "give it a mass and a specific heat, or leave it out")
        if (
            min(told["cooling"].min(), self._contact, told["latent"].min()) < 0
            or min(told["warm"].min(), float(constants["around"])) < 0
        ):
            cause = "heat has a temperature below 0 K, or a cooling, contact or latent heat below 0"
            raise ProgramError(cause, "interventions", "give temperatures in K, and the others from 0 on")
        loss = np.array(
            [h * of_body(model, body) if h else 0.0 for h, body in zip(told["cooling"], bodies, strict=True)]
        )
        latent = told["latent"] * weight
        melts = np.where((told["melts"] > 0) & (latent > 0), told["melts"], np.inf)
        latent[np.isinf(melts)] = 0.0
        if (odd := np.flatnonzero(told["warm"] > melts)).size:
            cause = f"{called[bodies[odd[0]]]!r} begins warmer than it melts at"
            raise ProgramError(cause, "interventions", "let it begin solid, or say that it does not melt")
        around = float(constants["around"])
        self.warmth = Warmth(told["warm"], capacity, loss, around, told["source"], melts, latent)
        self._grown, self._cold = Grown(model, bodies, told["expansion"], called), told["warm"]
        self._row = np.full(model.nbody, -1)
        self._row[list(bodies)] = np.arange(count)
        self._body_of = model.geom_bodyid
        self._touching, self._strain = np.zeros((count, count)), np.zeros(count)
        told_ = (
            ("temperature", "K", "of each of its bodies"),
            ("melted", "1", "the share of each that is molten"),
            ("grown", "1", "the lengths of each over those at the start, less one"),
        )
        self._told = [Column(name, (count,), unit, says) for name, unit, says in told_]
        self._lost = Column("lost", (), "J", "to the air, since the start")
        self._stored = Column("stored", (), "J", "in all of its bodies, above 0 K")
        self.channels = {
            **{column: np.zeros(count) for column in self._told},
            **{column: np.zeros(()) for column in (self._lost, self._stored)},
        }

    def look(self, data: "mujoco.MjData") -> "np.ndarray":
        """See what touches, and tell; nothing is pushed."""
        import numpy as np

        self._touching[:] = 0.0
        contact = data.contact
        ends = contact.geom[(contact.dist < TOUCH_M) & (contact.geom.min(axis=1, initial=0) >= 0)] if data.ncon else ()
        for one, other in self._row[self._body_of[ends]] if len(ends) else ():
            if min(one, other) >= 0 and one != other:
                self._touching[one, other] = self._touching[other, one] = self._contact
        self.channels[self._told[0]][:] = self.warmth.temperature
        self.channels[self._told[1]][:] = self.warmth.melted
        self.channels[self._told[2]][:] = self._strain
        self.channels[self._lost][...] = self.warmth.lost
        self.channels[self._stored][...] = self.warmth.stored
        return np.zeros((len(self._touching), 6))

    def advance(self, step_s: float) -> None:
        """Let heat flow, and shapes follow."""
        self.warmth.advance(step_s, self._touching)
        self._strain = self._grown.follow(self.warmth.temperature - self._cold)


def start(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    bodies: Sequence[int],
    constants: Mapping[str, Any],
    shown_by: str = "",
) -> Heat:
    """Start with the temperatures that are told."""
    return Heat(model, bodies, constants)


def show(model: "mujoco.MjModel", data: "mujoco.MjData", geom: int, channels: Mapping[str, Any]) -> None:
    """Do nothing: a temperature is not seen."""
