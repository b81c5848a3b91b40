"""`program.main`: one command line for every generated program, and the passes behind it.

    simulation.py --pass physics|still|video|view|bundle [--out DIR] [--from RECORDING]
                  [--seed N] [--camera NAME]… [--duration S]
                  [--time-step-factor 0.5] [--without NAME]… [--weaken NAME=FACTOR]… [--reuse PASS]…

physics simulates and records into `DIR/trajectory`; still and video draw recorded states (`--from`) and never step the
physics; view opens a window; bundle writes the world as one file that plain MuJoCo opens. Every pass leaves `progress.json` while it runs, then `result.json`, or `error.json` and
exit status 1. Without arguments a program opens a window where there is a display, else simulates into `./out`.

Importing a program runs nothing: `build()` alone gives the complete world, initial motion included (keyframe "start").
"""

import argparse
import copy
import os
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .errors import ProgramError

if TYPE_CHECKING:
    import mujoco

    from .trajectory import Recording

PASSES = ("physics", "still", "video", "view", "bundle")
TRAJECTORY = "trajectory"


def main(
    build: Callable[..., Any],
    control: Callable[..., Any] | None = None,
    *,
    duration: float,
    fps: int = 24,
    size: tuple[int, int] = (1280, 720),
    movers: Sequence[str] = (),
    seed: int = 0,
    visual_only: Sequence[str] = (),
    argv: Sequence[str] | None = None,
) -> int:
    """Run the pass that the command line asks for; returns the exit status.

    A program run as a script ends with that status by itself; with `argv` given, it is only returned.

    Args:
        build: `build()` or `build(rng)` returning an MjSpec (a compiled MjModel is fine too).
        control: `control(model, data)` or `control(model, data, rng)`, called every step when everything that derives
            from positions and velocities is up to date. What it writes is recorded as interventions.
        duration: simulated time, s.
        fps: frames a second of the video.
        size: width and height of pictures in pixels, both even.
        movers: names of bodies that are expected to move.
        seed: of every random draw.
        visual_only: names of bodies or geoms that are drawn but not simulated, as the plan declares.
        argv: the command line; None takes the process's own.
    """
    from .reporting import report_failure

    program = getattr(getattr(build, "__code__", None), "co_filename", None) or sys.argv[0]
    line = sys._getframe(1).f_lineno
    options = _parse(sys.argv[1:] if argv is None else list(argv), Path(program).name)
    settings = _Settings(build, control, duration, fps, size, tuple(movers), seed, tuple(visual_only))
    status, out = 0, None
    try:
        out = _prepare(options)
        settings.check(movers, visual_only)
        log_to_console()
        _PASSES[options.run](settings, options, out)
    except KeyboardInterrupt:
        sys.stderr.write("interrupted; what was recorded until now can be read\n")
        status = 130
    except Exception as error:  # author code may raise anything
        report_failure(error, program, line, out)
        status = 1
    if argv is None and status:
        raise SystemExit(status)
    return status


class _Settings:
    """What the program asks for."""

    def __init__(
        self,
        build: Callable[..., Any],
        control: Callable[..., Any] | None,
        duration: float,
        fps: int,
        size: tuple[int, int],
        movers: tuple[str, ...],
        seed: int,
        visual_only: tuple[str, ...],
    ) -> None:
        self.build, self.control, self.duration = build, control, duration
        self.fps, self.size = fps, size
        self.movers, self.seed, self.visual_only = movers, seed, visual_only

    def check(self, movers: Any, visual_only: Any) -> None:
        """Frame rate and size must make a video; names must come as a list of names."""
        if not (isinstance(self.fps, int) and 1 <= self.fps <= 1000):
            raise ProgramError(f"fps is {self.fps!r}", "program.main", "give a whole number from 1 to 1000")
        good = len(self.size) == 2 and all(isinstance(s, int) and 16 <= s <= 8192 and s % 2 == 0 for s in self.size)
        if not good:
            raise ProgramError(
                f"size is {self.size!r}", "program.main", "give an even width and height from 16 to 8192 pixels"
            )
        for name, value in (("movers", movers), ("visual_only", visual_only)):
            if isinstance(value, str):
                raise ProgramError(f"{name} is the text {value!r}", "program.main", f'write {name}=("{value}",)')


def _parse(argv: Sequence[str], name: str) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog=name, description="Simulate, draw or view this world.")
    parser.add_argument(
        "--pass", dest="run", choices=PASSES, help="what to do; default: view, or physics without a display"
    )
    parser.add_argument("--out", type=Path, help="folder for the results (default: ./out)")
    parser.add_argument("--from", dest="recording", type=Path, help="recording folder to draw (still, video, view)")
    parser.add_argument("--seed", type=int, help="seed of every random draw")
    parser.add_argument("--camera", dest="cameras", action="append", default=[], help="only this camera; repeatable")
    parser.add_argument("--duration", type=float, help="simulated seconds")
    changed = parser.add_argument_group("the same world with one thing changed (physics; see worldkit.variants)")
    changed.add_argument("--time-step-factor", type=float, metavar="F", help="simulate in finer steps, e.g. 0.5")
    changed.add_argument("--without", action="append", default=[], metavar="NAME", help="take it away; repeatable")
    changed.add_argument("--weaken", action="append", default=[], metavar="NAME=FACTOR", help="repeatable")
    parser.add_argument(
        "--reuse", action="append", default=[], type=Path, metavar="PASS",
        help="folder of an earlier physics pass: its recording is taken over if the same motion follows; repeatable",
    )  # fmt: skip
    options = parser.parse_args(argv)
    options.plain = options.run is None
    if options.run is None:
        options.run = "view" if has_display() else "physics"
    return options


def _prepare(options: argparse.Namespace) -> Path | None:
    """The results folder, without the traces of an earlier run of the same pass; None for view."""
    if options.run == "view":
        return None
    out: Path = options.out or Path("out")
    if options.run == "physics" and (out / TRAJECTORY).exists():
        if options.out is not None:  # its results stay as they are
            raise ProgramError(
                "there is a recording in this folder already", str(out / TRAJECTORY), "give another --out"
            )
        import shutil

        shutil.rmtree(out / TRAJECTORY, ignore_errors=True)  # the default folder holds the latest run
    try:
        out.mkdir(parents=True, exist_ok=True)
        for stale in ("error.json", "result.json", "progress.json"):
            (out / stale).unlink(missing_ok=True)
    except OSError as failure:
        raise ProgramError(f"the folder cannot be used: {failure}", str(out), "give another --out") from failure
    return out


def _physics(settings: _Settings, options: argparse.Namespace, out: Path) -> None:
    from . import overlaps, trajectory, variants, world
    from .describe import describe
    from .files import write_json
    from .motion_key import motion_key
    from .record import Recorder
    from .reporting import Progress
    from .reuse import reuse
    from .simulate import prepare, simulate

    variant = variants.Variant.parse(options.time_step_factor, options.without, options.weaken)
    seed = settings.seed if options.seed is None else options.seed
    duration = settings.duration if options.duration is None else options.duration
    build_rng, control_rng = world.seeded(seed)
    model = world.make(settings.build, build_rng)
    drive, control = settings.control, world.controller(settings.control, control_rng)
    world.check_cast(model, settings.movers, settings.visual_only)
    # At a finer step the recorded instants stay the same, so that expectations measure the same thing.
    every = world.record_every(model, world.steps_of(model, duration)) * variant.steps_per_step
    if variant:
        control = variants.apply(model, variant, control)
    steps = world.steps_of(model, duration)
    meta = {
        **describe(model, settings.visual_only),
        "movers": list(settings.movers),
        "visual_only": list(settings.visual_only),
        "seed": seed,
        "duration": duration,
        "fps": settings.fps,
        "record_every": every,
        **({"variant": variant.as_meta()} if variant else {}),
    }
    decided = {"steps": steps, "record_every": every, "seed": seed, "variant": variant.as_meta()}
    meta["motion_key"] = motion_key(model, drive, decided, _source(settings))
    as_built = copy.copy(model)  # the program may edit the one that is simulated
    began = time.perf_counter()
    kept = reuse(options.reuse, meta["motion_key"], meta, as_built, out / TRAJECTORY, overlap=not variant)
    if kept is not None:
        facts = {"duration_s": duration, "time_step": meta["time_step"], "bodies": model.nbody - 1}
        wall = round(time.perf_counter() - began, 3)
        write_json(
            out / "result.json",
            {"ok": True, "pass": "physics", **kept, **facts, "motion_key": meta["motion_key"], "wall_s": wall},
        )
        sys.stdout.write(f"moves as {kept['reused_from']} did, whose recording is taken over: nothing was simulated\n")
        return
    prepare(model)
    data = world.start(model)
    progress = Progress(out, steps, "steps")
    started = time.perf_counter()
    with Recorder(model, data, out / TRAJECTORY, meta) as recorder:
        simulate(model, data, recorder, steps, control, every, progress)
    wall = time.perf_counter() - started
    if not variant:
        overlaps.write(as_built, trajectory.open(out / TRAJECTORY), out / TRAJECTORY)
    result = {
        "ok": True,
        "pass": "physics",
        "steps": steps,
        "duration_s": duration,
        "time_step": meta["time_step"],
        "trajectory_sha256": recorder.sha256(),
        "motion_key": meta["motion_key"],
        "rows": recorder.rows,
        "record_every": every,
        "warnings": recorder.warnings,
        "interventions": recorder.counts,
        "bodies": model.nbody - 1,
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
    if options.plain:
        sys.stdout.write(f"film it: --pass video --from {out / TRAJECTORY}\n")


def _source(settings: _Settings) -> str | None:
    """The text of the program's file; None when it cannot be read."""
    code = getattr(settings.build, "__code__", None)
    try:
        return Path(code.co_filename).read_text(encoding="utf-8") if code else None
    except (OSError, ValueError):
        return None


def _pictures(settings: _Settings, options: argparse.Namespace, out: Path) -> None:
    """The still and the video pass."""
    headless_gl()
    from . import pictures
    from .describe import fingerprint
    from .files import write_json
    from .reporting import Progress

    recording = _recording(options, out)
    model = _rebuild(settings, options, recording)
    same = fingerprint(model) == recording.meta["model"]["fingerprint"]
    started = time.perf_counter()
    if options.run == "still":
        progress = Progress(out, 0, "cameras")
        summary = pictures.stills(model, recording, options.cameras, out, settings.size, progress)
    else:
        progress = Progress(out, 0, "frames")
        summary = pictures.video(model, recording, options.cameras, out, settings.size, settings.fps, progress)
    result = {"ok": True, "pass": options.run, **summary, "trajectory_sha256": recording.sha256, "same_model": same}
    write_json(out / "result.json", {**result, "wall_s": round(time.perf_counter() - started, 3)})
    sys.stdout.write(f"{', '.join(summary['cameras'])} in {out}\n")


def _bundle(settings: _Settings, options: argparse.Namespace, out: Path) -> None:
    """The world as one file."""
    import mujoco

    from . import portable, world
    from .files import write_json

    build_rng, _ = world.seeded(settings.seed if options.seed is None else options.seed)
    made = world.as_built(settings.build, build_rng)
    if isinstance(made, mujoco.MjModel):
        raise ProgramError("build() returned a compiled model, which no XML can hold", "build()", "return the MjSpec")
    world.finish(made, "build()")
    facts = portable.write(made, out / portable.NAME)
    write_json(out / "result.json", {"ok": True, "pass": "bundle", "file": portable.NAME, **facts})
    sys.stdout.write(f"{out / portable.NAME}: {facts['files']} files, {facts['bytes'] / 1e6:.1f} MB\n")


def _recording(options: argparse.Namespace, out: Path | None) -> "Recording":
    from . import trajectory

    folder = options.recording or (out or Path("out")) / TRAJECTORY
    if (folder / TRAJECTORY / "meta.json").is_file():  # the folder around the recording was named
        folder = folder / TRAJECTORY
    if options.recording is None and not folder.exists():
        raise ProgramError("there is no recording to draw", str(folder), "run --pass physics first, or give --from")
    return trajectory.open(folder)


def _rebuild(settings: _Settings, options: argparse.Namespace, recording: "Recording") -> "mujoco.MjModel":
    """The world again, drawn from the seed that the recording was made with."""
    from . import world

    seed = recording.meta.get("seed", settings.seed) if options.seed is None else options.seed
    build_rng, _ = world.seeded(seed)
    return world.make(settings.build, build_rng)


def _view(settings: _Settings, options: argparse.Namespace, out: Path | None) -> None:
    from . import view, world

    if not has_display():
        raise ProgramError(
            "there is no display to open a window on", "--pass view", "use --pass physics, then --pass video"
        )
    if options.recording is not None:
        recording = _recording(options, out)
        view.replay(_rebuild(settings, options, recording), recording)
        return
    build_rng, control_rng = world.seeded(settings.seed if options.seed is None else options.seed)
    model = world.make(settings.build, build_rng)
    duration = settings.duration if options.duration is None else options.duration
    world.steps_of(model, duration)
    view.live(model, world.start(model), world.controller(settings.control, control_rng), duration)


def has_display() -> bool:
    """Whether a window could be opened."""
    return sys.platform in ("darwin", "win32") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def log_to_console() -> None:
    """Keep the engine's warnings on standard error, and its log file out of the working directory."""
    import mujoco

    config = mujoco.MjLogConfig.get()
    config.logto_file = False
    config.set()


def headless_gl() -> None:
    """Without a display, let MuJoCo draw through EGL, even when it was imported before anyone could say so."""
    if sys.platform != "linux" or "MUJOCO_GL" in os.environ or has_display():
        return
    os.environ["MUJOCO_GL"] = "egl"
    import importlib

    import mujoco.gl_context
    import mujoco.rendering.classic.gl_context as classic

    importlib.reload(classic)
    importlib.reload(mujoco.gl_context)


_PASSES: dict[str, Callable[[_Settings, argparse.Namespace, Any], None]] = {
    "physics": _physics,
    "still": _pictures,
    "video": _pictures,
    "view": _view,
    "bundle": _bundle,
}
