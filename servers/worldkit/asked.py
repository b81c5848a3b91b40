"""The arguments of `program.main`: they are checked, and written to files for the engine's process."""

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import laws
from .errors import ProgramError

if TYPE_CHECKING:
    import mujoco

    from .laws import Law
    from .speaking import Control


class Asked:
    """The arguments of one `program.main`, and the seed and duration that the command line may put in their place."""

    WORLD = "world.mjz"
    """Name of the world's file, as `portable` writes it."""
    FACTS = "program.json"
    """File with what the engine needs to know of a program besides its world."""
    INPUTS = "inputs.json"
    """File that lists what `control` may write, where the program says so itself."""

    def __init__(
        self,
        build: Callable[..., Any],
        control: Callable[..., Any] | None,
        duration: float,
        fps: int,
        size: tuple[int, int],
        movers: Sequence[str],
        seed: int,
        visual_only: Sequence[str],
        control_every: int,
        latency: int,
        inputs: Sequence[str] | None,
        given_laws: Any = (),
        other_seed: int | None = None,
        other_duration: float | None = None,
    ) -> None:
        self.build, self.control, self.fps, self.size = build, control, fps, size
        self.duration = duration if other_duration is None else other_duration
        self.movers, self.visual_only, self.inputs = movers, visual_only, inputs
        self.control_every, self.latency = control_every, latency
        self._given_laws = given_laws
        self.laws: tuple[Law, ...] = ()
        """The program's own laws, once they are checked."""
        self.seed = seed if other_seed is None else other_seed
        self._seed_given = other_seed is not None
        self._rng: Any = None
        self.strays: list[dict[str, Any]] = []

    def check(self) -> None:
        """Refuse arguments that cannot be right: frame rate and size of the video, lists of names, steps between questions."""
        if not (isinstance(self.fps, int) and 1 <= self.fps <= 1000):
            raise ProgramError(f"fps is {self.fps!r}", "program.main", "give a whole number from 1 to 1000")
        good = len(self.size) == 2 and all(isinstance(s, int) and 16 <= s <= 8192 and s % 2 == 0 for s in self.size)
        if not good:
            raise ProgramError(
                f"size is {self.size!r}", "program.main", "give an even width and height from 16 to 8192 pixels"
            )
        for name in ("movers", "visual_only", "inputs"):
            value = getattr(self, name)
            if isinstance(value, str):
                raise ProgramError(f"{name} is the text {value!r}", "program.main", f'write {name}=("{value}",)')
        if self.control is not None and not callable(self.control):
            raise ProgramError(
                f"control is {self.control!r}, not a function", "program.main", "pass a function, or nothing"
            )
        if not (isinstance(self.control_every, int) and self.control_every >= 1):
            raise ProgramError(
                f"control_every is {self.control_every!r}", "program.main", "give a whole number of steps, 1 or more"
            )
        if self.latency not in (0, 1):
            raise ProgramError(
                f"latency is {self.latency!r}", "program.main", "give 0 (the world waits) or 1 (one question later)"
            )
        self.laws = laws.check(self._given_laws)
        if self.laws and self.latency:
            raise ProgramError(
                "a law acts on the state that it is shown, and latency is 1", "program.main", "leave latency at 0"
            )
        for text in self.inputs or ():
            if ":" not in text:
                raise ProgramError(
                    f"the input {text!r} names no kind", "program.main", 'write KIND:TARGET, "force:ball"'
                )

    def draw_as(self, seed: Any) -> None:
        """Take a recording's seed, unless the command line gave one."""
        if isinstance(seed, int) and not self._seed_given:
            self.seed = seed

    def make(self) -> "tuple[mujoco.MjSpec, mujoco.MjModel]":
        """The world, built and compiled with the pairs that keep sliding bodies down; checked against the cast."""
        from . import world

        build_rng, self._rng = world.seeded(self.seed)
        name = f"{getattr(self.build, '__name__', 'build')}()"
        spec = world.as_built(self.build, build_rng)
        model = world.finish(spec, name)
        world.check_cast(model, self.movers, self.visual_only)
        world.steps_of(model, self.duration)
        return spec, model

    def write(self, out: Path) -> dict[str, Any]:
        """Write the world as one file, and beside it what else the engine needs to know; returns the file's facts."""
        from . import portable
        from .assets import catalog
        from .files import write_json

        spec, _ = self.make()
        facts = portable.write(spec, out / self.WORLD)
        control = self.control
        write_json(
            out / self.FACTS,
            {
                "duration": self.duration,
                "fps": self.fps,
                "size": list(self.size),
                "movers": list(self.movers),
                "visual_only": list(self.visual_only),
                "seed": self.seed,
                "control": None if control is None else str(getattr(control, "__name__", "control")),
                "control_every": self.control_every,
                "latency": self.latency,
                "world_sha256": facts["sha256"],
                "rounded": facts["rounded"],
                "assets": list(catalog.taken()),
                **({"laws": laws.rows(self.laws)} if self.laws else {}),
            },
        )
        if self.inputs is not None:
            rows = [text.partition(":") for text in self.inputs]
            written: list[dict[str, Any]] = [{"kind": kind, "bodies": [target]} for kind, _, target in rows]
            written += [{"kind": "solver", "bodies": row["bodies"], "law": row} for row in laws.rows(self.laws)]
            write_json(out / self.INPUTS, written)
        return facts

    @property
    def answers(self) -> bool:
        """Whether the program answers anything while its world runs."""
        return bool(self.control is not None or self.laws)

    def controller(self) -> "Control | None":
        """`control(model, data)`, where the program has one; the world must have been made."""
        from . import world

        return world.controller(self.control, self._rng)

    def stray(self, array: str, of_model: bool) -> None:
        """Remember that something was written that is no declared input."""
        from .strays import line_of

        file, line = line_of(self.control, array)
        self.strays.append({"array": f"{'model' if of_model else 'data'}.{array}", "file": file, "line": line})

    def tell_strays(self) -> None:
        """List on standard error what was written that is no declared input, one line each."""
        for row in self.strays:
            place = f"{Path(row['file']).name}:{row['line']}"
            sys.stderr.write(f"{place}: control writes {row['array']}, which is no declared input: it has no effect\n")
