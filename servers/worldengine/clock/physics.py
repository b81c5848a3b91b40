"""The physics pass: the world as one file is compiled, simulated, and recorded."""

import argparse
import copy
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.errors import ProgramError

from ..given import Given

if TYPE_CHECKING:
    import mujoco

    from ..inputs.declared_media import Media
    from ..inputs.replayed_inputs import Drive
    from ..recording.drive_source import Beside

TRAJECTORY = "trajectory"


def run(given: Given, options: argparse.Namespace) -> None:
    """Simulate into `options.out`, or take over a recording that fits already.

    Raises:
        WorldkitError: the world, its facts or its variant make no sense; the simulation blew up; the author's process
            ended, keeps silent, or sends nonsense. What was recorded until then is kept.
    """
    from worldkit import world
    from worldkit.files import write_json
    from worldkit.reporting import Progress

    from ..inputs.soft_start import wound
    from ..recording import stored
    from ..recording.record import Recorder
    from ..recording.reuse import describe_seen, reuse
    from ..variants import altered
    from .beside import Beside
    from .simulate import prepare, simulate

    out: Path = options.out
    variant = altered.Variant.parse(options.time_step_factor, options.without, options.weaken, options.vary)
    model = given.model()
    world.check_cast(model, given.movers, given.visual_only)
    # At a finer step the recorded instants and the end stay the same, so that expectations measure the same thing.
    steps = world.steps_of(model, given.duration)
    every = meeting(world.record_every(model, steps), options.meets) * variant.steps_per_step
    steps *= variant.steps_per_step
    hold = altered.alter(model, variant) if variant else None
    silent = bool(hold and hold.silent and not given.laws)  # an author's own laws go on without `control`
    asked = bool(options.replay or (given.answers and options.channel)) and not silent
    if given.laws and not (asked or silent):
        what = f"the plan declares the law {given.laws[0].name}, and nobody is there who steps it"
        raise ProgramError(what, "interventions", "give it to program.main in `laws=` (skill media)")
    meta = _meta(model, given, variant, every, asked)
    meta["motion_key"] = _motion_key(model, given, options, variant, steps, every, asked)
    as_built = copy.copy(model)  # the simulation may write parameters
    began = time.perf_counter()
    kept = reuse(options.reuse, meta["motion_key"], meta, as_built, out / TRAJECTORY, None if variant else given.size)
    common = {"duration_s": given.duration, "time_step": meta["time_step"], "bodies": model.nbody - 1}
    common |= {"motion_key": meta["motion_key"], "world_sha256": _sha256(given.world)}
    if kept is not None:
        wall = round(time.perf_counter() - began, 3)
        write_json(out / "result.json", {"ok": True, "pass": "physics", **kept, **common, "wall_s": wall})
        sys.stdout.write(f"moves as {kept['reused_from']} did, whose recording is taken over: nothing was simulated\n")
        return
    prepare(model)
    data = world.start(model)
    inputs = _inputs(model, data, given, options, variant, hold, steps) if asked else None
    if inputs is not None:
        meta["inputs"] = inputs.ports.as_meta()
        if inputs.ports.media is not None:
            meta["laws"] = [row.written() for row in given.laws]
    beside = Beside(model, data, given.solvers, inputs.ports if inputs else None, hold) if given.solvers else None
    if beside and beside.shown:
        meta["shown"] = beside.shown
    progress = Progress(out, steps, "steps")
    started = time.perf_counter()
    try:
        channels = beside.channels if beside else None
        with Recorder(model, data, out / TRAJECTORY, meta, channels=channels) as recorder:
            for target, value, energy in wound(model, data.qpos):
                recorder.event("interventions", 0.0, "pose", target, tuple(value), energy)
            simulate(model, data, recorder, steps, inputs, every, progress, beside)
    finally:
        if inputs is not None:
            inputs.close()
    wall = time.perf_counter() - started
    if not variant:
        describe_seen(as_built, stored.open(out / TRAJECTORY), given.size, out / TRAJECTORY)
    result = {
        "ok": True,
        "pass": "physics",
        **common,
        "steps": steps,
        "trajectory_sha256": recorder.sha256(),
        "inputs_sha256": stored.inputs_digest(out / TRAJECTORY),
        "rows": recorder.rows,
        "record_every": every,
        "warnings": recorder.warnings,
        "interventions": recorder.counts,
        "max_penetration_m": recorder.max_depth_m,
        "final_time": float(data.time),
        "wall_s": round(wall, 3),
        **({"variant": variant.as_meta()} if variant else {}),
    }
    write_json(out / "result.json", result)
    sys.stdout.write(
        f"{model.nbody - 1} bodies, {steps} steps, {data.time:.3f} s simulated in {wall:.1f} s "
        f"({data.time / wall:.1f} times real time)\nrecorded in {out / TRAJECTORY}\n"
    )


def meeting(every: int, live: int) -> int:
    """Steps between rows, at least `every`, so that a state that was recorded every `live` steps is a row, too.

    Those recorded live come by powers of two, so that this is less than twice as many.
    """
    return next(n for n in range(every, 2 * live * every + 1) if live % n == 0 or n % live == 0)


def _inputs(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    given: Given,
    options: argparse.Namespace,
    variant: Any,
    hold: Any,
    steps: int,
) -> "Drive":
    """The source of the inputs: a recording, or the author's process at the other end of the channel."""
    from worldkit.channel import ENGINE, Channel, descriptors

    from ..inputs.author_link import Distant
    from ..inputs.ports import Ports
    from ..inputs.replayed_inputs import Asked, Replayed
    from ..recording.stored import Replayable

    # A rate that was asked for stays the same in time; a law that is asked at every step is asked at every finer one.
    every = given.control_every * (variant.steps_per_step if given.control_every > 1 else 1)
    alone = bool(hold and hold.silent)  # a law, without the `control` beside it
    ports = Ports(model, () if alone else given.inputs, _media(model, given, every, steps, alone))
    if options.replay:
        if variant:
            raise ProgramError("a variant is another world", "--replay", "ask its author anew")
        return Replayed(model, data, ports, Replayable(options.replay), steps, given.control_every)
    voice = Distant(model, data, ports, Channel(descriptors(options.channel), ENGINE))
    return Asked(model, data, ports, voice, every, given.latency, hold.shares() if hold else None)


def _media(model: "mujoco.MjModel", given: Given, every: int, steps: int, alone: bool) -> "Media | None":
    """What the author's laws move; None without any. Of those that are alone nobody asks a `control`."""
    from ..inputs.declared_media import Media

    if not given.laws:
        return None
    media = Media(model, given.laws, every * float(model.opt.timestep), given.inputs, steps, every)
    media.alone = alone
    return media


def _meta(model: "mujoco.MjModel", given: Given, variant: Any, every: int, asked: bool) -> dict[str, Any]:
    from ..recording.describing import describe

    meta = {
        **describe(model, given.visual_only),
        "movers": list(given.movers),
        "visual_only": list(given.visual_only),
        "seed": given.seed,
        "duration": given.duration,
        "fps": given.fps,
        "record_every": every,
    }
    if asked:
        meta["control"] = {"every": given.control_every, "latency": given.latency}
    if given.solvers:
        meta["solvers"] = [row.written() for row in given.solvers]
    return {**meta, "variant": variant.as_meta()} if variant else meta


def _motion_key(
    model: "mujoco.MjModel",
    given: Given,
    options: argparse.Namespace,
    variant: Any,
    steps: int,
    every: int,
    asked: bool,
) -> str:
    from ..recording.motion_key import motion_key

    world = _sha256(given.world)
    decided = {"steps": steps, "record_every": every, "seed": given.seed, "variant": variant.as_meta()}
    if given.solvers:
        decided["solvers"] = [row.written() for row in given.solvers]
    if not asked:
        return motion_key(model, decided, world=world)
    rows = None if given.inputs is None else [[kind, sorted(names)] for kind, names in given.inputs]
    decided["control"] = [given.control_every, given.latency, rows]
    if given.laws:
        decided["laws"] = [row.written() for row in given.laws]
    source, beside = _code(options)
    return motion_key(model, decided, given.control, source, laws=bool(given.laws), beside=beside, world=world)


def _code(options: argparse.Namespace) -> "tuple[str | None, Beside | None]":
    """The text of the program, and of what lies beside it if all of that is known; None where it is not there."""
    from ..recording.drive_source import Beside

    try:
        if options.source is None:
            return None, None
        text = options.source.read_text(encoding="utf-8")
        if options.beside is None:
            return text, None
        named = {name: options.source.parent / name for name in options.module}
        return text, Beside({n: path.read_text(encoding="utf-8") for n, path in named.items()}, options.beside)
    except (OSError, ValueError):
        return None, None


def _sha256(path: Path) -> str:
    import hashlib

    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
