"""The same world with one thing changed: a finer time step, a cause taken away or made weaker, a number a little otherwise.

A variant needs no help from the program: it changes the compiled model, and what the program's `control` sends (`hold`).
Bodies are never deleted, so that the program's indices and the recording's columns stay the same.

Taken away (`--without NAME`):
    body      it and what it carries touch nothing, hang still, and pull at no equality, tendon or actuator; whatever
              the program writes to them is undone
    geom      it touches nothing
    joint     its spring, its friction, its motors and its initial velocity are gone
    actuator  it exerts no force
    equality  it is off, whatever the program says
    tendon    it carries nothing: no spring, no limit, no motor
    flex      it touches nothing
    BODY.velocity, BODY.weight, BODY.friction    its initial velocity, its weight, the friction at all its contacts
    gravity, wind, friction (of every contact), control (everything the program's control writes; laws of the author's own go on, and it is not called)
    force:BODY torque:BODY pose:BODY velocity:BODY mocap:BODY control:ACTUATOR constraint:EQUALITY parameter:OWNER
                    one intervention, as the ledger calls it, is undone each time it is made
    solver:BODY     force and torque of what steps beside the engine

Made weaker (`--weaken NAME=FACTOR`, 0 < FACTOR):
    body      mass, weight's acceleration, initial and surface speed, and the accelerations its own motors and the
              program's forces give it, all times FACTOR: everything it could push or pull with; or one of `BODY.mass`,
              `BODY.velocity`, `BODY.weight`, `BODY.friction`
    joint     spring, motors, initial velocity      actuator  its force and what it is asked for
    tendon    spring, damper, motors                gravity, wind, friction
    force: torque: solver: pose: velocity: mocap: control: parameter:    what is written, times FACTOR

A little otherwise (`--vary friction|masses|start=FACTOR`): see `varied`.

A bare name means every object that has it; where a body has the name of its joint or geom, the body is meant.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from worldkit.errors import ProgramError
from worldkit.naming import names

if TYPE_CHECKING:
    import mujoco

    from .holding import Hold

OBJECTS = ("body", "geom", "joint", "actuator", "equality", "tendon", "flex")
WORLD = ("gravity", "wind", "friction", "control")
BESIDE = {"solver": ("force", "torque")}
"""What a law or a solver beside the engine does to a body, as the ledger calls it."""
WRITES = ("force", "torque", "pose", "velocity", "mocap", "control", "constraint", "parameter")
ASPECTS = ("mass", "velocity", "weight", "friction")
MOST_NAMES = 40


@dataclass(frozen=True)
class Variant:
    """The differences from the program as written."""

    time_step_factor: float = 1.0
    without: tuple[str, ...] = ()
    weaken: tuple[tuple[str, float], ...] = ()
    vary: tuple[tuple[str, float], ...] = ()

    @classmethod
    def parse(
        cls, factor: float | None, without: Sequence[str], weaken: Sequence[str], vary: Sequence[str] = ()
    ) -> "Variant":
        """Read the command line; raises `ProgramError` with what is wrong with an option."""
        factor = 1.0 if factor is None else factor
        if not 0 < factor <= 1 or abs(1 / factor - round(1 / factor)) > 1e-9:
            raise ProgramError(
                f"the time step cannot be multiplied by {factor:g}",
                "--time-step-factor",
                "use 0.5, or another whole fraction of one, so that the recorded instants stay the same",
            )
        weaker = tuple(_factor(text, "weaken", "foot=0.5") for text in weaken)
        return cls(factor, tuple(without), weaker, tuple(_factor(text, "vary", "friction=1.2") for text in vary))

    def __bool__(self) -> bool:
        return self.time_step_factor != 1.0 or bool(self.without or self.weaken or self.vary)

    @property
    def steps_per_step(self) -> int:
        """The number of the variant's steps in one step of the program as written."""
        return round(1 / self.time_step_factor)

    def as_meta(self) -> dict[str, Any]:
        """The variant as `meta.json` and `result.json` have it."""
        return {
            "time_step_factor": self.time_step_factor,
            "without": list(self.without),
            "weaken": [list(pair) for pair in self.weaken],
            **({"vary": [list(pair) for pair in self.vary]} if self.vary else {}),
        }


def _factor(text: str, option: str, example: str) -> tuple[str, float]:
    """(name, factor) of `NAME=FACTOR`."""
    name, sign, number = text.rpartition("=")
    try:
        value = float(number)
    except ValueError:
        value = -1.0
    if not (sign and name and 0 < value < 1e6):
        raise ProgramError(
            f"'{text}' does not say what to {option} by how much", f"--{option}", f"write NAME=FACTOR, e.g. {example}"
        )
    return name, value


def alter(model: "mujoco.MjModel", variant: Variant) -> "Hold":
    """Change the compiled model, and return what is held of the inputs.

    Raises:
        ProgramError: a name is not in the world (the known ones are listed), or cannot be weakened.
    """
    import mujoco

    from .holding import Hold
    from .removal import Removal
    from .varied import vary

    hold = Hold(model)
    edit = Removal(model, hold)
    for name in variant.without:
        whole, aspect = _aspect(model, name)
        if aspect == "mass":
            raise ProgramError(
                f"nothing moves without a mass, so {name} cannot be taken away",
                "--without",
                f"take away {whole}, {whole}.velocity, {whole}.weight or {whole}.friction, or weaken {name}",
            )
        for kind, index in resolve(model, whole, "--without"):
            edit.weaken(kind, index, 0.0, aspect) if aspect else edit.remove(kind, index)
    for name, factor in variant.weaken:
        whole, aspect = _aspect(model, name)
        for kind, index in resolve(model, whole, "--weaken"):
            edit.weaken(kind, index, factor, aspect)
    if variant.without or variant.weaken:
        mujoco.mj_setConst(model, mujoco.MjData(model))
    for name, factor in variant.vary:
        vary(model, name, factor)
    model.opt.timestep *= variant.time_step_factor
    return hold


def _aspect(model: "mujoco.MjModel", name: str) -> tuple[str, str]:
    """(`stone`, `velocity`) of `stone.velocity`; the aspect is empty when the whole is meant, or a thing has that name."""
    whole, _, aspect = name.rpartition(".")
    return (whole, aspect) if whole and aspect in ASPECTS and not _known(model, name) else (name, "")


def resolve(model: "mujoco.MjModel", name: str, place: str = "") -> list[tuple[str, Any]]:
    """(kind, index or target) of everything that a name means."""
    if name in WORLD:
        return [(name, -1)]
    kind, colon, target = name.partition(":")
    if colon and (kind in WRITES or kind in BESIDE):
        kinds = BESIDE.get(kind, (kind,))
        return [(f"write {each}", target) for each in kinds if _writable(model, each, target, place)]
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
    """Whether the target of an intervention exists; raises `ProgramError` otherwise."""
    from .holding import found

    if kind == "parameter" and target:
        return True
    wanted = {"control": "actuator", "constraint": "equality"}.get(kind, "body")
    known = names(model, wanted, _count(model, wanted))
    if found(known, target) >= 0:
        return True
    raise ProgramError(
        f"there is no {wanted} {target}", place, f"name one of: {', '.join(known[:MOST_NAMES]) or f'no {wanted}s'}"
    )
