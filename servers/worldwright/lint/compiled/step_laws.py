"""Step an author's own laws for a moment, and write down their sums: run in the sandbox by `law_trial.py`, never imported into a server.

    step_laws.py FILE OUT SECONDS WHOLE

The program is run up to the moment it hands its world to worldkit; then its laws are asked as its process is, by the engine's own
steps, without its control. `sums.npz` holds what `model.recording.law_balances` is told of each law, `outcome.json` how far it came, and how
many times as much one of WHOLE seconds costs, by a law's own `grows`, and what the process held, MiB.
"""

import json
import os
import resource
import runpy
import sys
import time
import traceback
from pathlib import Path
from typing import Any

from compile_world import Capture, Enough  # beside this script, which takes its folder from the path

KEPT_S = 0.2
"""How far it came is written down so often, s."""


def main(path: Path, out: Path, seconds: float, whole: float) -> None:
    """Write the outcome; the process's exit code says nothing."""
    told: dict[str, Any] = {"wanted_s": seconds, "reached_s": 0.0, "wall_s": 0.0}
    try:
        _step(path, out, seconds, whole, told)
    except BaseException as error:
        frames = [f for f in traceback.extract_tb(error.__traceback__) if Path(f.filename).is_relative_to(path.parent)]
        told |= {"failure": type(error).__name__, "message": str(getattr(error, "cause", error))[:2000]}
        told |= {"place": getattr(error, "place", ""), "next_move": getattr(error, "next_move", "")}
        told |= {"line": frames[-1].lineno, "file": Path(frames[-1].filename).name} if frames else {}
    (out / "outcome.json").write_text(json.dumps(told), encoding="utf-8")


def _step(path: Path, out: Path, seconds: float, whole: float, told: dict[str, Any]) -> None:
    import mujoco
    import numpy as np

    from worldengine.inputs.declared_media import Medium, Place
    from worldkit import laws, naming, world

    capture = Capture(out / "compiling")
    capture.install(mujoco)
    sys.argv = [str(path)]
    sys.path.insert(0, str(path.parent))
    try:
        runpy.run_path(str(path), run_name="__main__")
    except Enough:
        pass
    finally:
        for owner, name, original in capture.undo:
            setattr(owner, name, original)
    own = laws.check(capture.keywords.get("laws", ()))
    model = world.make(capture.build, world.seeded(int(capture.keywords.get("seed", 0)))[0])
    data, every = world.start(model), int(capture.keywords.get("control_every", 1))
    rows = laws.rows(own)
    media = [Medium.read({"bodies": row["bodies"], "law": row}) for row in rows]
    for row, medium in zip(rows, media, strict=True):
        row["points"] = Place(model, medium).count
    for row, law in zip(rows, own, strict=True):
        row["suites"] = any(base.__module__.startswith("worldkit.") for base in type(law).__mro__)
        row["cell"] = float(getattr(law, "cell", 0.0)) if row["suites"] else 0.0
    ask = every * float(model.opt.timestep)
    told["points"] = sum(row["points"] for row in rows)
    asks = max(3, round(seconds / ask))
    numbers = np.zeros(sum(laws.TOTALS + laws.EACH * row["points"] for row in rows))
    stepped = laws.Stepped(own, model, {"rows": rows, "seconds": ask, "every": 1, "end": asks}, numbers.ctypes.data)
    bodies = naming.names(model, "body", model.nbody)
    pushed_by = [[bodies.index(body) for body in medium.bodies] for medium in media]
    sums = np.zeros((len(own), asks + 1, laws.TOTALS + 4))
    pushed = np.zeros(len(own))
    starts = np.cumsum([0, *(laws.TOTALS + laws.EACH * row["points"] for row in rows)])[:-1]
    given, work = np.zeros((len(own), 3)), np.zeros(len(own))
    began, written = time.perf_counter(), 0.0
    for question in range(asks + 1):
        mujoco.mj_step1(model, data)
        stepped.step(model, data)
        for number, start in enumerate(starts):
            sums[number, question] = [*numbers[start : start + laws.TOTALS], *given[number], work[number]]
        if question == 1:  # what is compiled when it is first called is paid once, and kept
            began = time.perf_counter()
        told |= {"reached_s": max(float(data.time) - ask, 0.0), "wall_s": time.perf_counter() - began}
        grows = [law.grows(told["reached_s"], whole) for law in own if told["reached_s"] and hasattr(law, "grows")]
        told["grows"] = max([1.0, *map(float, grows)])
        told["memory_mb"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        if time.perf_counter() - written > KEPT_S:  # what is slow is ended from outside
            (out / "outcome.json").write_text(json.dumps(told), encoding="utf-8")
            written = time.perf_counter()
        if question == asks:
            break
        stepped.push(data)
        before = data.xipos.copy()
        for step in range(every):
            if step:
                mujoco.mj_step1(model, data)
            turning = data.cvel[:, :3].copy()
            mujoco.mj_step2(model, data)
            mujoco.mj_kinematics(model, data)
            mujoco.mj_comPos(model, data)
            for number, own_bodies in enumerate(pushed_by):
                force = data.xfrc_applied[own_bodies]
                given[number] += force[:, :3].sum(axis=0) * model.opt.timestep
                pushed[number] += np.linalg.norm(force[:, :3], axis=1).sum() * model.opt.timestep
                work[number] += float((force[:, :3] * (data.xipos - before)[own_bodies]).sum())
                work[number] += float((force[:, 3:] * turning[own_bodies]).sum() * model.opt.timestep)
            before = data.xipos.copy()
    np.savez(
        out / "sums.npz", t=np.arange(asks + 1) * ask, sums=sums, pushed=pushed, gravity=np.array(model.opt.gravity)
    )
    told |= {"laws": rows, "done": True}


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]), float(sys.argv[3]), float(sys.argv[4]))
    sys.stdout.flush()
    os._exit(0)  # what the program left running is of no interest
