"""Run a program and write down what it does with the engine: in the sandbox, never imported into a server.

    watching.py PROGRAM OUT watched|plain

`OUT/events.jsonl` has one line per event; `OUT/end.json` says how the run ended, and is missing when the process died.
"""

import ast
import faulthandler
import gc
import json
import os
import sys
import threading
import traceback
from pathlib import Path
from typing import Any

KEPT = ("events.jsonl", "end.json", "death.txt")
"""Files that the host reads afterwards."""
HERE = str(Path(__file__).parent)


def failure(error: BaseException, path: str) -> dict[str, Any]:
    """Describe an error: what went wrong, and the lines of the program that it passed, outermost first."""
    frames = traceback.extract_tb(error.__traceback__)
    lines = [f.lineno for f in frames if f.filename == path]
    return {
        "failure": type(error).__name__,
        "message": " ".join(str(error).split())[:600],
        "lines": lines,
        "missing": getattr(error, "name", None) if isinstance(error, ImportError) else None,
        "last": frames[-1].filename if frames else "",
    }


def imported(text: str) -> set[str]:
    """First names of the modules that a program imports, anywhere in it."""
    found = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            found |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and not node.level:
            found.add((node.module or "").partition(".")[0])
    return found


def settle(home: Path, out: Path) -> None:
    """Work in the one folder that can be written, where the files beside the program are found under their own names."""
    for entry in home.iterdir():
        if not (out / entry.name).exists() and entry.name not in KEPT:
            (out / entry.name).symlink_to(entry)
    os.chdir(out)


def main(path: str, out: Path, watched: bool) -> None:
    """Run it to its end, or to the end of what is looked at."""
    import mujoco
    import numpy as np  # noqa: F401
    import owners
    import packages
    from said import SAID

    faulthandler.enable((out / "death.txt").open("w"))
    text = Path(path).read_text("utf-8-sig")
    SAID.program = path
    config = mujoco.MjLogConfig.get()
    config.logto_file = False
    config.set()
    import engine
    import made_worlds
    import makers

    if watched:
        SAID.file = (out / "events.jsonl").open("w")
        made_worlds.TEXT[:] = text.splitlines()
        engine.install()
        makers.install()
        code = makers.rewritten(text, path)
    else:
        for name in dir(mujoco):
            if name.startswith("mju_"):
                owners.CALL[name] = getattr(mujoco, name)
        code = compile(text, path, "exec")
    if taken := sorted(imported(text) & {p.stem for p in Path(HERE).glob("*.py")}):
        # Without this the program would get our module in place of its own of the same name.
        refused = {
            "failure": "ModuleNotFoundError",
            "message": f"a module named {taken[0]} cannot be had here",
            "lines": [1],
        }
        (out / "end.json").write_text(json.dumps(refused), encoding="utf-8")
        return
    packages.install()
    settle(Path(path).parent, out)
    sys.argv = [path]
    sys.path[:] = [str(Path(path).parent), *[p for p in sys.path if p != HERE]]
    space: dict[str, Any] = {"__name__": "__main__", "__file__": path, "__builtins__": __builtins__, **makers.WORDS}
    module = type(sys)("__main__")
    vars(module).update(space)
    sys.modules["__main__"] = module
    threading.excepthook = lambda *_: None
    end: dict[str, Any] = {"ended": True}
    gc.freeze()  # at the end all objects are looked through, of which those before the program are by far the most
    try:
        exec(code, vars(module))
    except engine.Enough:
        end["enough"] = True
    except SystemExit as left:
        end["exit"] = left.code if isinstance(left.code, int) else 0
    except BaseException as error:
        end.update(failure(error, path))
    if watched:
        import lifecycle

        sys.path.insert(0, HERE)
        lifecycle.at_end()
        end["steps"] = engine.Progress.steps
    (out / "end.json").write_text(json.dumps(end), encoding="utf-8")


if __name__ == "__main__":
    sys.stdout = sys.stderr = Path(os.devnull).open("w")  # noqa: SIM115
    main(sys.argv[1], Path(sys.argv[2]), sys.argv[3] == "watched")
    os._exit(0)
