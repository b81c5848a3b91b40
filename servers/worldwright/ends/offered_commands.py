"""What a person may command of a world that is stepped live: its declared controls, and the pedals of its vehicles."""

import math
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal

from worldengine.inputs.commands import HOLD, PEDALS, Command

from ..model.errors import GateError
from ..model.plan.declared_inputs import Live
from .controls import control_inputs

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from worldengine.given import Given

    from ..model.plan.committed import Plan

BRAKE: Final = "brake"


def offered(model: "mujoco.MjModel", plan: "Plan", given: "Given", drove: Path | None) -> tuple[Command, ...]:
    """The commands of a world, cars first.

    A car whose controls are all declared is driven by its pedals, and its own controls are not offered beside them. What acts in
    silence is the plan's `live` of the control; where that names no failsafe, a servo holds its position, a car brakes, all else is 0.

    Args:
        model: the world.
        plan: declares the controls.
        given: what the engine is given of the world.
        drove: the folder of the recorded inputs, which widen bounds that nobody clamps; None without any.

    Raises:
        GateError: the plan declares no control, or gives the pedals of a car one number.
    """
    from worldengine.inputs.ports import Ports
    from worldkit.vehicles.found_cars import find_cars

    indices = tuple(Ports(model, given.inputs).entries.get("ctrl", ()))
    found = {row.name: row for row in control_inputs(model, plan, indices, recorded(model, given, drove))}
    said = _live(plan)
    rows: list[Command] = []
    for name, car in find_cars(model).items():
        own = car.actuators(name)
        if not found.keys() >= set(own):
            continue
        live = next((said[control] for control in own if control in said), Live())
        for control in own:
            found.pop(control)
        bounds = ((-car.steering_deg, car.steering_deg, "deg"), (-1.0, 1.0, ""), (0.0, 1.0, ""))
        silent: dict[str, float | Literal["hold"]] = {"steering": HOLD, "throttle": 0.0, "brake": 1.0}
        if live.failsafe == HOLD:
            silent = dict.fromkeys(PEDALS, HOLD)
        elif live.failsafe not in (None, BRAKE):
            raise GateError(
                f"{name} is driven by three pedals, and they have no one failsafe of {live.failsafe:g}",
                place="simulation_parameters.interventions",
                next_move="write `brake` or `hold` as its failsafe, and build the world again",
            )
        for pedal, (low, high, unit) in zip(PEDALS, bounds, strict=True):
            rows.append(
                Command(
                    f"{name}.{pedal}", car=name, pedal=pedal, low=low, high=high, unit=unit, bounded_by="the car",
                    failsafe=silent[pedal], timeout_s=live.timeout_s, ends_after_s=live.ends_after_s or math.inf,
                )
            )  # fmt: skip
    for row in found.values():
        live = said.get(row.name, Live())
        failsafe = (HOLD if row.kind == "position" else BRAKE) if live.failsafe is None else live.failsafe
        rows.append(
            Command(
                row.name, control=row.index, low=row.low, high=row.high, unit=row.unit, bounded_by=row.bounded_by,
                failsafe=0.0 if failsafe == BRAKE else failsafe,
                timeout_s=live.timeout_s, ends_after_s=live.ends_after_s or math.inf,
            )
        )  # fmt: skip
    if not rows:
        raise GateError(
            "this plan declares no control, so there is nothing to drive",
            place="simulation_parameters.interventions",
            next_move="declare one (`kind: control`, skill interventions), and build the world again",
        )
    return tuple(rows)


def _live(plan: "Plan") -> dict[str, Live]:
    """The plan's word on silence, by the control that a row names."""
    rows = plan.simulation_parameters.interventions
    return {name: row.live for row in rows if row.live is not None for name in row.bodies}


def recorded(model: "mujoco.MjModel", given: "Given", drove: Path | None) -> "np.ndarray":
    """(questions, controls) what the declared controls were in a recording; no row without one."""
    import numpy as np

    from worldengine.inputs.ports import Ports
    from worldengine.inputs.strict_stream import Recorded
    from worldengine.recording.stored import Replayable
    from worldkit.world import steps_of

    ports = Ports(model, given.inputs)
    width = len(ports.entries.get("ctrl", ()))
    if drove is None:
        return np.zeros((0, width))
    steps = steps_of(model, given.duration)
    stream, rows = Recorded(Replayable(drove), model, ports, steps, given.control_every), []
    for step in range(0, steps, given.control_every):
        if stream.speaks(step):
            rows.append(stream.answer(step)[0][:width].copy())
    return np.array(rows).reshape(len(rows), width)
