"""`program.main`: one command line for every generated program.

    simulation.py --pass physics|still|video|view|build|control [--out DIR] [--from RECORDING]
                  [--seed N] [--camera NAME]… [--duration S]
                  [--time-step-factor 0.5] [--without NAME]… [--weaken NAME=FACTOR]…
                  [--vary friction|masses|start=FACTOR]… [--reuse PASS]…

A program answers two questions and owns nothing else: what the world is (`build`), and what its inputs are in a state that
it is shown (`control`). Another process, `worldengine`, owns the world while it runs: it compiles the file that the build
pass writes (`world.mjz`), steps it, records it into `DIR/trajectory`, and films what is recorded.

build writes `world.mjz` and `program.json`; physics builds, has the world simulated, and answers for `control`; still and
video draw recorded states (`--from`) and never step the physics; view opens a window; control answers an engine that is
there already. Every pass leaves `result.json`, or `error.json` and exit status 1. Without arguments a program opens a window
where there is a display, else simulates into `./out`. What a program run by hand leaves is marked as no proof (`NO_PROOF`).

Importing a program runs nothing: `build()` alone gives the complete world, initial motion included (keyframe "start").
"""

import argparse
import json
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .asked import Asked
from .errors import ProgramError

if TYPE_CHECKING:
    from .laws import Law

PASSES = ("build", "physics", "control", "still", "video", "view", "bundle")
BY_HAND = ("physics", "still", "video")
"""Passes that the suite never asks a program for: it has its own process for them."""
TRAJECTORY = "trajectory"
NO_PROOF = "none: run by hand, where nothing confines the program, no plan is asked and no run's journal vouches for it"
"""What `result.json` says as `proof` of what a program made that was not started by the suite."""


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
    control_every: int = 1,
    latency: int = 0,
    inputs: Sequence[str] | None = None,
    laws: "Sequence[Law]" = (),
    argv: Sequence[str] | None = None,
) -> int:
    """Run the pass that the command line asks for; returns the exit status.

    A program run as a script ends with that status by itself; with `argv` given, it is only returned.

    Args:
        build: `build()` or `build(rng)` returning an MjSpec.
        control: `control(model, data)` or `control(model, data, rng)`, asked when everything that derives from positions
            and velocities is up to date. `model` and `data` are its own copies; of what it writes, the values of the
            declared inputs are sent to the engine, and nothing else has any effect.
        duration: simulated time, s.
        fps: frames a second of the video.
        size: width and height of pictures in pixels, both even.
        movers: names of bodies that are expected to move.
        seed: of every random draw.
        visual_only: names of bodies, geoms or flexes that are drawn but not simulated, as the plan declares.
        control_every: steps from one question to the next; inputs stay as they are in between.
        latency: 0: the world waits for the answer to the state it shows; 1: the answer to a question takes effect at the
            next one, and both processes work at once.
        inputs: what `control` may write, as `KIND:TARGET` (`control:motor`, `force:ball`, …), where no plan says so;
            None opens everything.
        laws: the author's own (`worldkit.laws.Law`), stepped at every question before `control` is asked.
        argv: the command line; None takes the process's own.
    """
    from .reporting import report_failure

    program = getattr(getattr(build, "__code__", None), "co_filename", None) or sys.argv[0]
    line = sys._getframe(1).f_lineno
    options = _parse(sys.argv[1:] if argv is None else list(argv), Path(program).name)
    asked = Asked(
        build, control, duration, fps, size, movers, seed, visual_only, control_every, latency, inputs, laws,
        options.seed, options.duration,
    )  # fmt: skip
    status, out = 0, None
    try:
        out = _prepare(options)
        asked.check()
        log_to_console()
        status = _PASSES[options.run](asked, options, out, program, line)
        if out is not None and options.run in BY_HAND and not status:
            _mark(out)
    except KeyboardInterrupt:
        sys.stderr.write("interrupted; what was recorded until now can be read\n")
        status = 130
    except Exception as error:  # author code may raise anything
        report_failure(error, program, line, out)
        status = 1
    if argv is None and status:
        raise SystemExit(status)
    return status


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
    parser.add_argument(
        "--channel", help="descriptors of the memory and the pipes that an engine asks through (control)"
    )
    changed = parser.add_argument_group("the same world with one thing changed (physics; see worldengine.variants)")
    changed.add_argument("--time-step-factor", metavar="F", help="simulate in finer steps, e.g. 0.5")
    changed.add_argument("--without", action="append", default=[], metavar="NAME", help="take it away; repeatable")
    changed.add_argument("--weaken", action="append", default=[], metavar="NAME=FACTOR", help="repeatable")
    changed.add_argument(
        "--vary", action="append", default=[], metavar="WHAT=FACTOR", help="friction, masses or start; repeatable"
    )
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
        if options.out is not None:  # the earlier results stay as they are
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


def _build(asked: Asked, options: argparse.Namespace, out: Path, program: str, line: int) -> int:
    """The world as one file, and what else the engine is to know."""
    from .files import write_json

    facts = asked.write(out)
    write_json(out / "result.json", {"ok": True, "pass": options.run, "file": Asked.WORLD, **facts})
    sys.stdout.write(f"{out / Asked.WORLD}: {facts['files']} files, {facts['bytes'] / 1e6:.1f} MB\n")
    return 0


def _physics(asked: Asked, options: argparse.Namespace, out: Path, program: str, line: int) -> int:
    """Build, and have the world simulated."""
    from . import handover

    asked.write(out)
    words = ["physics", *_world(out), "--out", str(out), "--source", program]
    for name in ("time_step_factor", "without", "weaken", "vary", "reuse"):
        given = getattr(options, name)
        for value in given if isinstance(given, list) else [given] if given else []:
            words += [f"--{name.replace('_', '-')}", str(value)]
    if not asked.answers:
        status = handover.run(words)
    else:
        status = handover.converse(words, asked.controller(), asked.stray, asked.laws)
        asked.tell_strays()
    if status:
        _blame(out, program, line)
    elif options.plain:
        sys.stdout.write(f"film it: --pass video --from {out / TRAJECTORY}\nproof: {NO_PROOF}\n")
    return status


def _control(asked: Asked, options: argparse.Namespace, out: Path, program: str, line: int) -> int:
    """Answer an engine that is there already."""
    from . import law_work
    from .channel import AUTHOR, Channel, descriptors
    from .files import write_json
    from .speaking import serve

    end = Channel(descriptors(options.channel), AUTHOR)
    try:
        asked.make()  # `control` may use what `build` has stored in the program's own names
        law_work.write(out, asked.laws, asked.duration)
        serve(asked.controller(), end, asked.stray, asked.laws)
    finally:
        end.close()
    write_json(out / "result.json", {"ok": True, "pass": "control", "went_nowhere": asked.strays})
    asked.tell_strays()
    return 0


def _pictures(asked: Asked, options: argparse.Namespace, out: Path, program: str, line: int) -> int:
    """Run the still or the video pass, on the world beside the recording or else on the world that is built now."""
    from . import handover

    folder = options.recording or out / TRAJECTORY
    if (folder / TRAJECTORY / "meta.json").is_file():  # the folder around the recording was named
        folder = folder / TRAJECTORY
    if options.recording is None and not folder.exists():
        raise ProgramError("there is no recording to draw", str(folder), "run --pass physics first, or give --from")
    asked.draw_as(_read(folder / "meta.json").get("seed"))
    asked.write(out)
    cameras = [word for name in options.cameras for word in ("--camera", name)]
    status = handover.run([options.run, *_world(out), "--from", str(folder), "--out", str(out), *cameras])
    if status:
        _blame(out, program, line)
    return status


def _view(asked: Asked, options: argparse.Namespace, out: Path | None, program: str, line: int) -> int:
    import tempfile

    from . import handover

    if not has_display():
        raise ProgramError(
            "there is no display to open a window on", "--pass view", "use --pass physics, then --pass video"
        )
    with tempfile.TemporaryDirectory(prefix="worldkit-") as folder:
        if options.recording is not None:
            asked.draw_as(_read(options.recording / "meta.json").get("seed"))
        asked.write(Path(folder))
        words = ["view", *_world(Path(folder)), "--out", folder]
        if options.recording is not None:
            return handover.run([*words, "--from", str(options.recording)])
        if not asked.answers:
            return handover.run(words)
        return handover.converse(words, asked.controller(), asked.stray, asked.laws)


def _world(folder: Path) -> list[str]:
    words = ["--world", str(folder / Asked.WORLD), "--program", str(folder / Asked.FACTS)]
    inputs = folder / Asked.INPUTS
    return [*words, "--inputs", str(inputs)] if inputs.is_file() else words


def _read(path: Path) -> dict[str, Any]:
    """What a file says; nothing when it cannot be read, which the engine reports better where it matters."""
    try:
        found = json.loads(path.read_bytes())
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}


def _mark(out: Path) -> None:
    """Say in a result that it is no proof."""
    from .files import write_json

    write_json(out / "result.json", {**_read(out / "result.json"), "proof": NO_PROOF})


def _blame(out: Path, program: str, line: int) -> None:
    """Give an error of the engine's process the only place in the program that it has: the call that handed the world over."""
    from .files import write_json

    facts = _read(out / "error.json")
    if facts and not facts.get("line"):
        write_json(out / "error.json", {**facts, "file": program, "line": line})


def has_display() -> bool:
    """Whether a window could be opened."""
    return sys.platform in ("darwin", "win32") or bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def log_to_console() -> None:
    """Keep the engine's warnings on standard error, and its log file out of the working directory."""
    import mujoco

    config = mujoco.MjLogConfig.get()
    config.logto_file = False
    config.set()


_PASSES: dict[str, Callable[[Asked, argparse.Namespace, Any, str, int], int]] = {
    "build": _build,
    "bundle": _build,
    "physics": _physics,
    "control": _control,
    "still": _pictures,
    "video": _pictures,
    "view": _view,
}
