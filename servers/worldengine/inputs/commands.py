"""The commands of somebody who drives a world live, and what acts where they fall silent.

A command is a number with a name: a control itself, or a pedal of a vehicle (`worldkit.vehicles`), whose controls follow from it in
each state. It holds as long as it is repeated: after `timeout_s` of the wall clock without a word its failsafe acts, at once
where the driver says that he leaves. What is beyond its bounds is kept within them; what is no finite number is not heard.
"""

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal

from worldkit.errors import ProgramError

if TYPE_CHECKING:
    import mujoco

    from worldkit.vehicles import Bicycle
    from worldkit.vehicles.found_cars import FoundCar

PEDALS = ("steering", "throttle", "brake")
HOLD: Final = "hold"
MOST_NUMBER = 1e12


@dataclass(frozen=True)
class Command:
    """One declared input, as it is offered."""

    name: str
    control: int = -1
    """Into the engine's `ctrl`; -1 for a pedal."""
    car: str = ""
    pedal: str = ""
    """One of `PEDALS`, of that car."""
    low: float = -math.inf
    high: float = math.inf
    unit: str = ""
    failsafe: float | Literal["hold"] = 0.0
    timeout_s: float = 0.5
    ends_after_s: float = math.inf
    """So long after the last word the drive ends, s."""
    bounded_by: str = ""

    def kept(self, value: float) -> float:
        """The value within the bounds."""
        return min(max(value, self.low), self.high)

    def written(self) -> dict[str, Any]:
        """The row as JSON has it, without what is not finite."""
        return {name: value for name, value in vars(self).items() if value not in (math.inf, -math.inf)}


def heard(value: object) -> bool:
    """Whether a value is a number that a command may have: finite, and below `MOST_NUMBER` in size."""
    return type(value) in (int, float) and abs(value) < MOST_NUMBER  # type: ignore[arg-type]


def read(path: Path, controls: int) -> tuple[Command, ...]:
    """The commands that a file lists, for a world with so many controls.

    Raises:
        ProgramError: it cannot be read, or a row makes no sense.
    """
    try:
        rows = tuple(Command(**row) for row in json.loads(path.read_bytes()))
        good = all(
            isinstance(row.name, str)
            and (0 <= row.control < controls) != (row.pedal in PEDALS and bool(row.car))
            and row.low <= row.high
            and row.timeout_s > 0
            and row.ends_after_s > 0
            and (row.failsafe == HOLD or math.isfinite(row.failsafe))
            for row in rows
        )
    except (OSError, ValueError, TypeError, RecursionError) as cause:
        raise ProgramError(f"the commands cannot be read: {cause}", str(path), "let worldwright write them") from cause
    if not good or len({row.name for row in rows}) != len(rows):
        raise ProgramError("the commands make no sense", str(path), "let worldwright write them")
    return rows


class Console:
    """What is commanded now.

    Args:
        rows: the commands.
        cars: the vehicles whose pedals are among them, by name.
        ctrl: the controls as the world begins: what `hold` holds before anybody has spoken.
        clock: of the wall, s.
    """

    def __init__(
        self, rows: tuple[Command, ...], cars: "Mapping[str, FoundCar | Bicycle]", ctrl: Any, clock: Callable[[], float]
    ) -> None:
        self._rows, self._clock = {row.name: row for row in rows}, clock
        self.values = {row.name: float(ctrl[row.control]) if row.control >= 0 else 0.0 for row in rows}
        for row in rows:
            if row.failsafe != HOLD:
                self.values[row.name] = row.kept(float(row.failsafe))
        from worldkit.vehicles import pedals

        self._pedals = pedals
        self._plain = [(row.name, row.control) for row in rows if row.control >= 0]
        called = {"steering": "steering_deg", "throttle": "throttle", "brake": "brake"}
        self._driven = [
            (name, car, [(called[row.pedal], row.name) for row in rows if row.car == name])
            for name, car in cars.items()
        ]
        self._heard: dict[str, float] = {}
        self._last_word: float | None = None
        self._ends_after_s = min((row.ends_after_s for row in rows), default=math.inf)
        self.silent = tuple(self._rows)
        """Names of the commands whose failsafe acts."""

    @property
    def spoken(self) -> bool:
        """Whether anybody has said anything yet."""
        return self._last_word is not None

    def hear(self, line: bytes) -> bool:
        """Take a message: `{"values": {NAME: number, …}}`, `{"left": true}` or both; False where it is neither, or a number is none.

        Of a message with one bad number nothing is taken.
        """
        try:
            said = json.loads(line)
            values = {str(name): value for name, value in said.get("values", {}).items()}
        except (ValueError, AttributeError, RecursionError):
            return False
        if not all(name in self._rows and heard(value) for name, value in values.items()):
            return False
        now = self._clock()
        if said.get("left"):  # before the values, which are of whoever drives next
            self._heard = {}
        for name, value in values.items():
            self.values[name], self._heard[name] = self._rows[name].kept(float(value)), now
            self._last_word = now
        return True

    def settle(self) -> bool:
        """Let failsafes act where nothing was heard for too long; False when the drive is to end for that."""
        now, silent = self._clock(), []
        for name, row in self._rows.items():
            if now - self._heard.get(name, -math.inf) > row.timeout_s:
                silent.append(name)
                if row.failsafe != HOLD:
                    self.values[name] = row.kept(float(row.failsafe))
        self.silent = tuple(silent)
        return self._last_word is None or now - self._last_word <= self._ends_after_s

    def write(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        """Write the controls that follow from the commands in this state."""
        values, ctrl = self.values, data.ctrl
        for name, control in self._plain:
            ctrl[control] = values[name]
        for name, car, asked in self._driven:
            self._pedals(car, model, data, name, **{pedal: values[row] for pedal, row in asked})
