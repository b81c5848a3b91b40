"""Compile a world and write down what it is: run in the sandbox by `fetch.py`, never imported into a server.

    compile_world.py program|mjcf FILE OUT [SECONDS]

A program is run as a script up to the moment it hands its world to worldkit, or takes its first step; a model file, or the
archive that a bundle pass has made, is compiled; SECONDS is how long such a world is simulated, 0 that its price is not asked. What is left behind is `outcome.json` and, when there is a world, `facts.npz`: numbers and names, no code.
"""

import contextlib
import json
import os
import runpy
import sys
import traceback
import warnings
from pathlib import Path
from typing import Any

from measure import facts  # beside this script
from rehearse import rehearse

sys.path.pop(0)  # the program must not find our modules


class Enough(BaseException):
    """Stops the program: its world is known, the rest is not needed."""


class Capture:
    """Stands in for the few functions that make models, take steps, or take over the program."""

    def __init__(self, mark: Path) -> None:
        self.mark = mark
        """This file exists while the engine's compiler works."""
        self.models: list[Any] = []
        self.build: Any = None
        self.keywords: dict[str, Any] = {}
        self.undo: list[tuple[Any, str, Any]] = []

    def install(self, mujoco: Any) -> None:
        """Wrap the engine's constructors, and stop at the first step."""
        for owner, name in (
            (mujoco.MjModel, "from_xml_string"),
            (mujoco.MjModel, "from_xml_path"),
            (mujoco.MjModel, "from_binary_path"),
            (mujoco.MjSpec, "compile"),
            (mujoco.MjSpec, "from_string"),
            (mujoco.MjSpec, "from_file"),
        ):
            original = getattr(owner, name)

            def made(*arguments: Any, _original: Any = original, **keywords: Any) -> Any:
                self.mark.touch()
                try:
                    model = _original(*arguments, **keywords)
                finally:
                    self.mark.unlink(missing_ok=True)
                if isinstance(model, mujoco.MjModel):
                    self.models.append(model)
                return model

            setattr(owner, name, made if name == "compile" else staticmethod(made))

        def stop(*_: Any, **__: Any) -> None:
            raise Enough

        self.undo = []
        for name in ("mj_step", "mj_step1", "mj_step2"):
            original_step = getattr(mujoco, name)
            self.undo.append((mujoco, name, original_step))
            # Before any model is known, a step is the program's own mistake, and fails as it would.
            setattr(mujoco, name, lambda *a, _o=original_step, **k: stop() if self.models else _o(*a, **k))
        from worldkit import program

        def main(build: Any, control: Any = None, **keywords: Any) -> None:  # noqa: ARG001
            self.build, self.keywords = build, keywords
            raise Enough

        program.main = main  # type: ignore[assignment]


def run(path: Path, mark: Path) -> tuple[Any, dict[str, Any], dict[str, Any]]:
    """Run a program up to its world; returns (model, facts, what works beside it), with no model when it makes none."""
    import mujoco

    capture = Capture(mark)
    capture.install(mujoco)
    sys.argv = [str(path)]
    sys.path.insert(0, str(path.parent))
    space: dict[str, Any] = {}
    try:
        space = runpy.run_path(str(path), run_name="__main__")
    except Enough:
        pass
    except (Exception, SystemExit):
        if not capture.models:
            raise
    finally:
        for owner, name, original in capture.undo:
            setattr(owner, name, original)
    build = capture.build or space.get("build")
    if callable(build):
        from worldkit import world

        seed = capture.keywords.get("seed", 0)
        model = world.make(build, world.seeded(seed if isinstance(seed, int) else 0)[0])
        beside: dict[str, Any] = {
            name: capture.keywords[name] for name in ("laws", "control_every") if name in capture.keywords
        }
        return model, {"made_by": "build", "duration_s": capture.keywords.get("duration")}, beside
    if capture.models:
        return capture.models[-1], {"made_by": "script"}, {}
    return None, {"made_by": "nothing"}, {}


def failure(error: BaseException, path: Path) -> dict[str, Any]:
    """Describe an error: what went wrong, and the last line of the program that it passed."""
    frames = [f for f in traceback.extract_tb(error.__traceback__) if Path(f.filename).name == path.name]
    return {
        "failure": type(error).__name__,
        "message": str(error)[:2000],
        "line": frames[-1].lineno if frames else getattr(error, "line", None),
    }


def main(kind: str, path: Path, out: Path, lasting_s: float | None = None) -> None:
    """Write the outcome; the process's exit code says nothing."""
    import mujoco
    import numpy as np

    from worldkit import portable

    outcome: dict[str, Any] = {}
    model, beside = None, dict[str, Any]()
    config = mujoco.MjLogConfig.get()
    config.logto_file = False
    config.set()
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            if kind == "mjcf":
                (out / "compiling").touch()
                model = portable.read(path) if path.suffix == ".mjz" else mujoco.MjSpec.from_file(str(path)).compile()
                (out / "compiling").unlink()
                outcome |= {"made_by": "file", "duration_s": lasting_s}
            else:
                model, more, beside = run(path, out / "compiling")
                outcome.update(more)
        except BaseException as error:
            outcome.update(failure(error, path))
        if model is not None:
            arrays, texts = facts(model)
            outcome.update(texts)
            np.savez(out / "facts.npz", **arrays)
    outcome["warnings"] = [str(w.message)[:500] for w in said if w.category is UserWarning][:20]
    seconds = outcome.pop("duration_s", None) if lasting_s != 0 else None
    (out / "outcome.json").write_text(json.dumps(outcome), encoding="utf-8")
    if model is not None and isinstance(seconds, int | float):  # after that: a step may never return
        with contextlib.suppress(
            Exception
        ):  # a world that blows up here does so in the pass, too, which says it better
            outcome["rehearsed"] = rehearse(model, float(seconds), out, **beside)
            (out / "outcome.json").write_text(json.dumps(outcome), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]), *map(float, sys.argv[4:]))
    sys.stdout.flush()
    os._exit(0)  # what the program left running is of no interest
