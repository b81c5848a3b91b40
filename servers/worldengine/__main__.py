"""The engine's process: `python -m worldengine bundle|physics|unmoved|live|storyboard|still|video|final|frame|scene|sheet|view
--world FILE --program FILE --out DIR …`.

`physics --replay RECORDING` drives the world by the inputs that a recording holds: the same motion, and nobody is asked.

It gets a world as one file and plain facts about its program, never the program. Like every pass it leaves `result.json`
in DIR, or `error.json` with exit status 1, and `progress.json` on the way.
"""

import argparse
import math
import os
import sys
from collections.abc import Sequence
from pathlib import Path

import worldkit  # checks the environment contract before anything else is imported

PASSES = (
    "bundle",
    "physics",
    "unmoved",
    "live",
    "storyboard",
    "still",
    "video",
    "final",
    "frame",
    "scene",
    "sheet",
    "view",
)
WITHOUT_PICTURES = {"bundle", "physics", "live"}


def main(argv: Sequence[str] | None = None) -> int:
    """Run one pass; returns the exit status."""
    from worldkit.program import log_to_console
    from worldkit.reporting import report_failure

    from .given import Given

    options = _parse(argv)
    try:
        log_to_console()
        given = Given.read(options.world, options.program, options.inputs)
        if options.run == "physics":
            from .clock import physics

            physics.run(given, options)
        elif options.run == "unmoved":
            from .clock import unmoved

            unmoved.run(given, options)
        elif options.run == "live":
            from .clock import live_run

            live_run.run(given, options)
        elif options.run == "bundle":
            from . import built_layout

            built_layout.run(given, options)
        elif options.run == "view":
            from .film import window

            window.run(given, options)
        elif options.run == "storyboard":
            from . import storyboard

            storyboard.run(given, options)
        elif options.run == "sheet":
            from . import from_all_sides

            from_all_sides.run(given, options)
        elif options.run == "scene":
            from .film import carried_scene

            carried_scene.run(given, options)
        elif options.run == "final":
            from .film import refining

            refining.run(given, options)
        else:
            from .film import passes

            passes.run(given, options)
    except KeyboardInterrupt:
        return 130
    except Exception as error:
        if (
            options.share is None
        ):  # else the process that asked draws what this one could not, and tells why if it cannot
            report_failure(error, "", None, options.out)
        return 1
    return 0


def _size(text: str) -> tuple[int, int]:
    width, height = (int(side) for side in text.split("x"))
    if not (16 <= width <= 8192 and 16 <= height <= 8192):
        raise ValueError(text)
    return width, height


def _share(text: str) -> tuple[int, int]:
    number, count = (int(part) for part in text.split("/"))
    if not 0 <= number < count:
        raise ValueError(text)
    return number, count


def _spans(text: str) -> list[tuple[int, int]]:
    return [(int(first), int(count)) for first, count in (span.split("+") for span in text.split(","))]


def _point(text: str) -> tuple[float, float, float]:
    x, y, z = (float(number) for number in text.split(","))
    return x, y, z


def _seen(text: str) -> tuple[str, tuple[int, int], float, str]:
    quality, size, at_s, camera = text.split(":", 3)
    if quality not in ("still", "video"):
        raise ValueError(quality)
    return quality, _size(size), float(at_s), camera


def _parse(argv: Sequence[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m worldengine", description="Own a world while it runs.")
    parser.add_argument("run", choices=PASSES)
    parser.add_argument("--world", type=Path, required=True, help="the world as one file")
    parser.add_argument("--program", type=Path, required=True, help="facts about the program")
    parser.add_argument("--inputs", type=Path, help="what may be written: rows of kind and bodies; all when left out")
    parser.add_argument("--out", type=Path, required=True, help="folder for the results")
    parser.add_argument("--from", dest="recording", type=Path, help="recording to draw")
    parser.add_argument(
        "--replay", type=Path, help="recorded inputs to be driven by again (physics): a recording's folder"
    )
    parser.add_argument(
        "--meets", type=int, default=1, help="a replay's rows are among every so many-th state (physics)"
    )
    parser.add_argument("--channel", help="descriptors of the memory and the pipes to the author's process")
    parser.add_argument("--socket", type=int, help="descriptor of the stream to whoever drives (live)")
    parser.add_argument("--commands", type=Path, help="what may be commanded (live)")
    parser.add_argument("--waits", action="store_true", help="for the first command (live)")
    parser.add_argument("--speed", type=float, default=1.0, help="simulated seconds in a second (live)")
    parser.add_argument("--seconds", type=float, default=3600.0, help="simulated seconds at most (live)")
    parser.add_argument("--source", type=Path, help="text of the program, never run: tells whether a motion is known")
    parser.add_argument("--module", action="append", default=[], help="a module beside it, below its folder (physics)")
    parser.add_argument("--beside", help="hash of all else beside it: with --module that is all it runs with (physics)")
    parser.add_argument("--film", type=Path, help="folder with a film's description (still, video, final, frame)")
    parser.add_argument("--minutes", type=float, default=5.0, help="time for drawing (final)")
    parser.add_argument("--at", type=float, action="append", help="seconds of the film, or of the recording (frame)")
    parser.add_argument("--shots", action="store_true", help="three moments of every shot of the film (frame)")
    parser.add_argument("--moving", action="store_true", help="the whole film, small and in few frames (frame)")
    parser.add_argument(
        "--seen",
        action="append",
        default=[],
        type=_seen,
        help="one of several pictures: still|video:WIDTHxHEIGHT:SECONDS:CAMERA, the camera `film` for the film's own (frame)",
    )
    parser.add_argument(
        "--within", type=float, default=math.inf, help="no further picture is begun after so many s (--seen, --moving)"
    )
    parser.add_argument("--samples", type=float, help="paths a pixel, by the final pass's renderer (frame)")
    parser.add_argument("--size", type=_size, help="WIDTHxHEIGHT in pixels (frame, sheet)")
    parser.add_argument("--eye", type=_point, help="where an unplanned camera stands: X,Y,Z in m (frame)")
    parser.add_argument("--target", type=_point, default=(0.0, 0.0, 0.0), help="what it looks at: X,Y,Z in m")
    parser.add_argument("--plain", action="store_true", help="one picture without its camera's name (sheet)")
    parser.add_argument("--fovy", type=float, default=45.0, help="height of what it sees, degrees")
    parser.add_argument("--format", choices=("gltf", "usd"), default="gltf", help="how the scene is written (scene)")
    parser.add_argument("--camera", dest="cameras", action="append", default=[])
    parser.add_argument("--moment", dest="moments", action="append", default=[], help="of the storyboard: SECONDS:WORD")
    parser.add_argument("--time-step-factor", type=float)
    parser.add_argument("--without", action="append", default=[])
    parser.add_argument("--weaken", action="append", default=[])
    parser.add_argument("--vary", action="append", default=[])
    parser.add_argument(
        "--reuse", action="append", default=[], type=Path, help="an earlier pass that may hold the same"
    )
    parser.add_argument("--room-mb", type=int, default=0, help="memory that all who draw it may take (video)")
    parser.add_argument("--share", type=_share, help="K/N: only every N-th frame of the film, from K on (video)")
    parser.add_argument("--only", type=_spans, help="FIRST+COUNT,…: of these frames of the film (video)")
    parser.add_argument("--to", type=int, help="descriptor that such frames are written to")
    options = parser.parse_args(argv)
    options.words = list(sys.argv[1:] if argv is None else argv)
    options.at = options.at or [0.0]
    if options.run == "final" and options.film is None:
        parser.error("the final pass draws a film: name the folder of its description with --film")
    return options


if __name__ == "__main__":
    assert worldkit
    if set(sys.argv[1:2]) & WITHOUT_PICTURES:  # the simulator's package would bring in the graphics library it names
        os.environ["MUJOCO_GL"] = "disable"
    status = main()
    if sys.argv[1:2] == ["view"]:
        sys.exit(status)
    # All is written and closed. Taking modules and the graphics driver apart costs as much as many a simulation or still.
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)
