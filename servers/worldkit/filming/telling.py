"""The author's process of a film: `python -m worldkit.filming.telling FILM.PY --motion FILE --out DIR`.

It runs `film.py` on what was recorded and leaves the description, `film.json` and `film.npz`; or `error.json` and status 1.
With `--unmoved` nothing was recorded yet, and the motion is that of a world that stands still: `error.json` has the code
`needs_recording` where that may be why it failed.
"""

import argparse
import runpy
import signal
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..film_files import ARRAYS, DESCRIPTION

MOST_CPU_S = 90
"""A description takes a second or two; one that takes so much processor time never ends."""


class Endless(BaseException):
    """The author's code does not end; no `except Exception` of its own swallows it."""


def _stop(*_: Any) -> None:
    raise Endless(f"it computed for {MOST_CPU_S} s and did not end")


def _line(error: BaseException, program: str) -> int | None:
    """The line of `film.py` that an error passed last."""
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == program]
    return lines[-1] if lines else getattr(error, "line", None)


def main(argv: Sequence[str] | None = None) -> int:
    """Have a film described; returns the exit status."""
    import numpy as np

    from ..errors import ProgramError
    from ..files import write_json
    from ..reporting import report_failure
    from . import lacking_motion
    from .director import Film
    from .recorded import Recorded

    parser = argparse.ArgumentParser(description="Have a film described.")
    parser.add_argument("program", type=Path)
    parser.add_argument("--motion", type=Path, required=True)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--unmoved", action="store_true")
    options = parser.parse_args(argv)
    program = str(options.program)
    film: Film | None = None
    told: Any = None
    arrays: dict[str, Any] = {}
    signal.signal(signal.SIGPROF, _stop)
    signal.setitimer(signal.ITIMER_PROF, MOST_CPU_S, 1.0)
    try:
        with np.load(options.motion, allow_pickle=False) as found:
            arrays = dict(found)
        film = Film(Recorded(arrays))
        film.recorded.unmoved = options.unmoved
        sys.path.insert(0, str(options.program.parent))
        told = runpy.run_path(program).get("film")
        if not callable(told):
            raise ProgramError("there is no function film(film) in it", "film.py", "def film(film: Film) -> None: …")
        told(film)
        facts, numbers = film.description()
        np.savez(options.out / ARRAYS, **numbers)  # type: ignore[arg-type]
        write_json(options.out / DESCRIPTION, facts)
        write_json(
            options.out / "result.json", {"ok": True, "frames": len(numbers["time"]), "shots": len(facts["shots"])}
        )
    except (Exception, Endless) as error:  # author code may raise anything
        signal.setitimer(signal.ITIMER_PROF, 0)
        if (
            options.unmoved
            and film is not None
            and film.recorded.asked_of_motion
            and lacking_motion.may_hold(error, told, arrays)
        ):
            error = lacking_motion.NeedsRecordingError(f"{type(error).__name__}: {error}", line=_line(error, program))
        report_failure(error, program, film.line if film else 1, options.out)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
