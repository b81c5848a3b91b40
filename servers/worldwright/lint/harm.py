"""How a rule proves that what it warns of really happens: kinds of evidence, run by the tests on the rule's own cases.

Nothing here runs in a server: `EVIDENCE` of a rule says what to run, and the test-suite runs it against the installed
MuJoCo. Cases are part of the project, so they may be executed by its tests.
"""

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import mujoco

    from .compiled.fetch import Outcome


@dataclass(frozen=True)
class Raises:
    """Every BAD case fails when it is run, compiled or stepped; every GOOD case does not."""

    match: str = ""
    """A pattern in the message."""
    without: tuple[int, ...] = ()
    """Indices of BAD cases that fail only on other data; the docstring of the rule says why."""
    good: bool = True
    """Run the GOOD cases too."""


@dataclass(frozen=True)
class Warns:
    """Every BAD case makes the engine warn, no GOOD case does."""

    match: str


@dataclass(frozen=True)
class Measured:
    """A number measured on BAD differs from the same number on GOOD, by more than `apart`."""

    claim: str
    """What the difference means, in one sentence."""
    measure: Callable[[Any], float]
    """From a case (a program's source, a plan's change) to the number."""
    apart: float
    unit: str = ""
    bad: Any = 0
    """Index of the BAD case that is measured, or a whole world that shows the same harm."""
    good: Any = 0
    """Index of the GOOD case it is compared with, or a whole world."""


@dataclass(frozen=True)
class Argued:
    """No run can show the harm; `reason` says why in one sentence."""

    reason: str


Evidence = Raises | Warns | Measured | Argued
KINDS = (Raises, Warns, Measured, Argued)


def model_of(source: str) -> "mujoco.MjModel":
    """The world of a case: MJCF text, or a program that defines `build`, `spec` or `model`."""
    import mujoco

    if source.lstrip().startswith("<"):
        return mujoco.MjSpec.from_string(source).compile()
    space = executed(source)
    made = space["build"]() if "build" in space else space.get("model", space.get("spec"))
    return made.compile() if isinstance(made, mujoco.MjSpec) else made


def executed(source: str) -> dict[str, Any]:
    """The names a case's program leaves behind, run as a module."""
    space: dict[str, Any] = {"__name__": "case"}
    exec(compile(source, "case", "exec"), space)
    return space


def answer(source: str) -> float:
    """The number that a case's program calls its answer."""
    return float(executed(source)["answer"])


def after(source: str, seconds: float) -> "tuple[mujoco.MjModel, mujoco.MjData]":
    """The world of a case, simulated for `seconds` from keyframe "start" or its initial state."""
    import mujoco

    model = model_of(source)
    data = mujoco.MjData(model)
    key = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_KEY, "start")
    if key >= 0:
        mujoco.mj_resetDataKeyframe(model, data, key)
    mujoco.mj_forward(model, data)
    for _ in range(round(seconds / model.opt.timestep)):
        mujoco.mj_step(model, data)
    return model, data


def height_after(source: str, seconds: float = 1.0) -> float:
    """Height of the last body, m."""
    return float(after(source, seconds)[1].xpos[-1, 2])


def fastest(source: str, seconds: float = 0.2) -> float:
    """The greatest speed that any degree of freedom reaches, m/s or rad/s."""
    import mujoco

    model, data = after(source, 0.0)
    most = 0.0
    for _ in range(round(seconds / model.opt.timestep)):
        mujoco.mj_step(model, data)
        most = max(most, float(abs(data.qvel).max(initial=0.0)))
    return most


def diverged(source: str, seconds: float = 1.0) -> float:
    """How many times the engine gave up and started anew."""
    _, data = after(source, seconds)
    return float(sum(w.number for w in data.warning))


def pixels(source: str, geom: int = -1, camera: int = 0) -> float:
    """Share of a camera's picture that shows a geom (counted from the end when negative)."""
    import mujoco

    model, data = after(source, 0.0)
    with mujoco.Renderer(model, 120, 160) as renderer:
        renderer.enable_segmentation_rendering()
        renderer.update_scene(data, camera)
        ids = renderer.render()
    wanted = geom % model.ngeom
    shown = (ids[..., 0] == wanted) & (ids[..., 1] == int(mujoco.mjtObj.mjOBJ_GEOM))
    return float(shown.mean())


def brightness(source: str) -> float:
    """Mean brightness of the first camera's picture, 0 to 255."""
    import mujoco

    model, data = after(source, 0.0)
    with mujoco.Renderer(model, 120, 160) as renderer:
        renderer.update_scene(data, 0)
        return float(renderer.render().mean())


def outcome_of(source: str) -> "Outcome":
    """What the sandbox would report about a case; it is made here, as cases are trusted and programs are not."""
    from .compiled.fetch import Outcome
    from .compiled.measure import facts

    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            arrays, texts = facts(model_of(source))
        except Exception as error:
            return Outcome("failed", failure=type(error).__name__, message=str(error))
    return Outcome("compiled", arrays=arrays, texts=texts, warnings=tuple(str(w.message) for w in said))
