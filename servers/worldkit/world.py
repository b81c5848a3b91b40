"""From a program's `build` to a compiled world with a checked clock, cast and seed."""

import functools
import inspect
import math
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from . import sliding, within_bounds
from .errors import ProgramError
from .motion import START

if TYPE_CHECKING:
    import mujoco
    import numpy as np

MOST_STEPS = 100_000_000
STATE_BYTES = 1 << 30
"""Bytes of state rows above which not every step is recorded."""


def seeded(seed: int) -> "tuple[np.random.Generator, np.random.Generator]":
    """Independent random generators for `build` and for `control`; the global ones are seeded too."""
    import random

    import numpy as np

    if seed < 0:
        raise ProgramError(f"the seed must be zero or positive, got {seed}", "--seed", "use any non-negative integer")
    random.seed(seed)
    np.random.seed(seed % 2**32)  # noqa: NPY002 - for programs that draw from numpy's global generator all the same
    first, second = np.random.SeedSequence(seed).spawn(2)
    return np.random.default_rng(first), np.random.default_rng(second)


def make(build: Callable[..., Any], rng: "np.random.Generator") -> "mujoco.MjModel":
    """Call `build()` or `build(rng)` and compile the spec that it returns.

    It gets explicit pairs where sliding bodies would hop (`worldkit.sliding`).
    """
    return finish(as_built(build, rng), f"{getattr(build, '__name__', 'build')}()")


def finish(spec: "mujoco.MjSpec", place: str) -> "mujoco.MjModel":
    """Compile a spec, after giving it the pairs that keep sliding bodies down; `place` is where it was made."""
    within_bounds.check(spec)
    try:
        model = spec.compile()
        return spec.compile() if sliding.add_pairs(spec, model) else model
    except ValueError as failure:
        cause, move = str(failure), "repair what the compiler names"
        if installed := callbacks():
            cause += (
                f" (the engine asks what this program installed by set_{', set_'.join(installed)} while it compiles)"
            )
            move = "take it out: `control(model, data)` is called at every step"
        raise ProgramError(f"the world does not compile: {cause}", place, move) from failure


def callbacks() -> list[str]:
    """Names of the engine's callbacks that something has installed in this process, e.g. `mjcb_control`."""
    import mujoco

    asked = [name for name in dir(mujoco) if name.startswith("get_mjcb_")]
    return [name.removeprefix("get_") for name in asked if getattr(mujoco, name)() is not None]


def as_built(build: Callable[..., Any], rng: "np.random.Generator") -> "mujoco.MjSpec":
    """The spec that `build()` or `build(rng)` returns.

    Raises:
        ProgramError: it returned something else, with the line of its last `return`. A compiled model is refused, too: what
            is simulated is compiled from a file, which only a spec can be written as.
    """
    import mujoco

    made = build(rng) if _positional(build) else build()
    if isinstance(made, mujoco.MjSpec):
        return made
    name = getattr(build, "__name__", "build")
    if isinstance(made, mujoco.MjModel):
        cause = f"{name}() returned a compiled model, which cannot be written as the world's file"
        move = "return the mujoco.MjSpec, before `compile()`, and set in it what was set in the model"
        raise ProgramError(cause, f"{name}()", move, _last_return(build))
    end = " (end it with `return spec`)" if made is None else ""
    cause = f"{name}() returned {type(made).__name__}, not a world{end}"
    raise ProgramError(cause, f"{name}()", "return a mujoco.MjSpec", _last_return(build))


def _last_return(function: Callable[..., Any]) -> int | None:
    """The last line on which a function returns; None for what is not written in Python."""
    import dis

    code = getattr(inspect.unwrap(function), "__code__", None)
    found = [i.positions for i in dis.get_instructions(code) if i.opname.startswith("RETURN")] if code else []
    return max((place.lineno for place in found if place and place.lineno), default=None)


def controller(control: Callable[..., Any] | None, rng: "np.random.Generator") -> Callable[..., Any] | None:
    """`control(model, data)`, whether the program's takes two arguments or a generator as the third."""
    if control is None:
        return None
    if not callable(control):
        raise ProgramError(f"control is {control!r}, not a function", "program.main", "pass a function, or nothing")
    if _positional(control) >= 3:

        @functools.wraps(control)
        def drawing(model: "mujoco.MjModel", data: "mujoco.MjData") -> object:
            return control(model, data, rng)

        return drawing
    return control


def start(model: "mujoco.MjModel") -> "mujoco.MjData":
    """Data at keyframe "start" when there is one, else at the model's initial state."""
    import mujoco

    data = mujoco.MjData(model)
    key = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_KEY, START)
    if key >= 0:
        mujoco.mj_resetDataKeyframe(model, data, key)
    return data


def steps_of(model: "mujoco.MjModel", duration: float) -> int:
    """How many steps the duration (s) takes; a `ProgramError` when either is nonsense."""
    step = float(model.opt.timestep)
    if not (math.isfinite(step) and step > 0):
        raise ProgramError(f"the time step is {step} s", "build()", "set spec.option.timestep to a positive number")
    if not (isinstance(duration, (int, float)) and math.isfinite(duration) and duration > 0):
        raise ProgramError(f"the duration is {duration!r}", "duration", "give a positive, finite number of seconds")
    steps = round(duration / step)
    if steps < 1:
        raise ProgramError(
            f"a duration of {duration} s is shorter than one time step of {step} s", "duration", "simulate longer"
        )
    if steps > MOST_STEPS:
        raise ProgramError(
            f"{duration} s in steps of {step} s are {steps} steps", "duration", f"stay under {MOST_STEPS} steps"
        )
    return steps


def record_every(model: "mujoco.MjModel", steps: int) -> int:
    """Steps from one recorded row to the next: 1, unless the state rows would outgrow `STATE_BYTES`."""
    row = 8 * (16 * model.nbody + model.nq + model.nv + model.nsensordata + model.nplastic + 3 * model.nu)
    return max(1, math.ceil(row * steps / STATE_BYTES))


def check_cast(model: "mujoco.MjModel", movers: Iterable[str], visual_only: Iterable[str]) -> None:
    """The named bodies must exist; the message lists the ones that do."""
    from .naming import names

    bodies = names(model, "body", model.nbody)[1:]
    drawn = [*bodies, *names(model, "geom", model.ngeom), *names(model, "flex", model.nflex)]
    for role, wanted, known in (("movers", movers, bodies), ("visual_only", visual_only, drawn)):
        if isinstance(wanted, str):
            raise ProgramError(f"{role} is the text {wanted!r}", "program.main", f'write {role}=("{wanted}",)')
        if unknown := [name for name in wanted if name not in known]:
            raise ProgramError(
                f"{role} names {', '.join(unknown)}, which is not in the world",
                "program.main",
                f"name some of: {', '.join(bodies) or '(the world has no bodies)'}",
            )


def _positional(function: Callable[..., Any]) -> int:
    """How many positional arguments a function can take at most (a `*args` counts as none)."""
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return 0
    return sum(p.kind in (p.POSITIONAL_ONLY, p.POSITIONAL_OR_KEYWORD) for p in parameters)
