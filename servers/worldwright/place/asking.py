"""Ask the pre-roll process which objects penetrate, and what happens when they are released."""

import hashlib
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from ..model import call_time, own_time, processor_time
from ..model.errors import JobError
from ..model.plan.committed import AssetRow, Plan, SceneObject
from ..model.plan.formed import arguments
from ..model.plan.imported import is_model, is_road, load
from ..model.plan.layout import Scene
from . import kept_answers
from .start import Motion

STILL_S, TICK_S = 180.0, 0.02
"""It is ended when nothing advances for so long, s, as passes are; while it advances it may take its time."""


class RefusedLayoutError(JobError):
    """The pre-roll cannot take these objects: a fault of what the plan says of them, unlike any other of its failures."""


def jointed(plan: Plan) -> set[str]:
    """Objects that a joint holds, and their parents: the pre-roll leaves them where they are."""
    return {name for joint in plan.topology.joints for name in (joint.parent, joint.child)} - {"world"}


def tied(plan: Plan) -> set[str]:
    """Objects that a declared constraint holds: pins of a cloth, a tie, a latch."""
    rows = plan.simulation_parameters.interventions
    return {name for row in rows if row.kind == "constraint" for name in row.bodies}


def why_held(plan: Plan, scene: Scene) -> dict[str, str]:
    """The objects that are not released, and why: the pre-roll has no joints, without which mechanisms fall apart."""
    reasons: dict[str, str] = {}
    for joint in plan.topology.joints:
        reasons.setdefault(joint.child, f"on {joint.type} {joint.name} of {joint.parent}")
    for joint in plan.topology.joints:
        reasons.setdefault(joint.parent, f"carries {joint.child} by {joint.type} {joint.name}")
    for name in tied(plan):
        reasons.setdefault(name, "held by a declared constraint")
    reasons |= dict.fromkeys(drawn_only(plan), "drawn only")
    return {o.name: reasons[o.name] for o in scene.objects if o.name in reasons}


def drawn_only(plan: Plan) -> set[str]:
    """Objects that are not simulated."""
    return {row.name for row in plan.scene_objects if row.visual_only}


def simulate(
    plan: Plan,
    scene: Scene,
    *,
    only: set[str] | None = None,
    loose: bool = False,
    duration_s: float = 0.0,
    everything: bool = False,
    pairs: Sequence[tuple[str, str]] = (),
    far_m: float = 0.0,
    falling: Sequence[str] = (),
    cameras: Sequence[dict[str, Any]] = (),
    ground: bool = False,
    moved: Mapping[str, Motion] | None = None,
) -> dict[str, Any]:
    """Run the pre-roll on resolved objects (see `preroll.answer`).

    Args:
        plan: the plan, for materials, masses and gravity.
        scene: its layout.
        only: these objects alone; None for all that are simulated.
        loose: give fixed things a free joint too, so that contacts between them are seen; there is then no ground,
            unless `ground` asks for it.
        duration_s: how long they move freely, s.
        everything: include what is only drawn.
        pairs, far_m: pairs whose distances are measured, up to so many metres.
        falling: objects whose height above what stops them straight below is measured.
        cameras: cameras whose view is measured (`visibility`).
        moved: rigid motions to start from, by name (`start.motions`); others start where they are placed.

    Raises:
        RefusedLayoutError: it cannot take these objects, or they diverged.
        JobError: nothing of it advanced any more, or it was killed, which says nothing of the plan.
        CallOverError: the client's call ended first.
    """
    hidden = drawn_only(plan)
    names = {o.name for o in scene.objects if (everything or o.name not in hidden) and (only is None or o.name in only)}
    request = _request(plan, scene, names, loose and not ground, loose) | {"duration_s": duration_s}
    for row in request["objects"]:
        motion = (moved or {}).get(row["name"])
        row["moved"] = None if motion is None else [motion.rotation, motion.shift]
    request |= {"pairs": list(pairs), "far_m": far_m, "falling": list(falling), "cameras": list(cameras)}
    kept = kept_answers.place_of(request)
    if kept is not None and (known := kept_answers.read(kept)) is not None:
        return known
    with tempfile.TemporaryDirectory(prefix="worldwright-preroll-") as folder:
        out = Path(folder) / "answer.json"
        sources = str(Path(__file__).resolve().parents[2])
        paths = os.pathsep.join(p for p in (sources, os.environ.get("PYTHONPATH", "")) if p)
        asked, told = Path(folder) / "request.json", Path(folder) / "errors.txt"
        asked.write_text(json.dumps(request | {"out": str(out)}), encoding="utf-8")
        with asked.open("rb") as question, told.open("wb") as errors:
            process = subprocess.Popen(
                [sys.executable, "-P", "-m", "worldwright.place.preroll"],
                stdin=question,
                stdout=subprocess.DEVNULL,
                stderr=errors,
                cwd=folder,  # the engine may leave a log file where it runs
                env={
                    **os.environ,
                    "PYTHONPATH": paths,
                    "MUJOCO_GL": "disable",
                },  # it draws nothing, and loads no OpenGL
            )
            _follow(process, out.with_suffix(".progress"))
        if not out.is_file():
            last = told.read_text(encoding="utf-8", errors="replace").strip().splitlines()
            how = f"the pre-roll process ended with status {process.returncode}: {last[-1] if last else 'no message'}"
            if process.returncode == -signal.SIGKILL:
                move = "free memory of this machine, then ask again"
                raise JobError(how, code="killed", place="place.preroll", next_move=move)
            raise RefusedLayoutError(
                how,
                code="crashed",
                place="place.preroll",
                next_move="check the sizes and masses of the objects; `worldwright doctor` checks the simulator",
            )
        answer = out.read_bytes()
    result: dict[str, Any] = json.loads(answer)
    if "error" in result:
        raise RefusedLayoutError(
            f"the pre-roll failed: {result['error']}",
            code="crashed",
            place="place.preroll",
            next_move="check sizes, masses and materials of the objects it names",
        )
    if kept is not None:
        kept_answers.keep(kept, answer)
    return result


def _follow(process: "subprocess.Popen[bytes]", progress: Path) -> None:
    """Wait for a process as long as what it writes there changes; what other work takes of the processor meanwhile does not count.

    Raises:
        JobError: nothing has for so long.
        CallOverError: the client's call ended first.
    """
    said, advanced, own = b"", 0.0, own_time.OwnTime(time.monotonic())
    try:
        while not _ended(process, os.WNOHANG):
            time.sleep(TICK_S)
            if call_time.left_s() <= 0:
                raise call_time.over()
            now = own.after(time.monotonic(), *own_time.of_process(process.pid))
            with suppress(OSError):
                if (says := progress.read_bytes()) != said:
                    said, advanced = says, now
            if now - advanced > STILL_S:
                raise JobError(
                    f"the pre-roll was ended: nothing advanced for {STILL_S:g} s ({said.decode(errors='replace') or 'at its start'})",
                    code="timed_out",
                    place="place.preroll",
                    next_move="ask again when the machine has less to do; if it stands still there again, split the plan",
                )
    finally:
        if process.returncode is None:
            process.kill()
            _ended(process, 0)


def _ended(process: "subprocess.Popen[bytes]", options: int) -> bool:
    """Whether a process has ended; what it computed is counted when it has (`model.processor_time`)."""
    ended, status, used = os.wait4(process.pid, options)
    if ended:
        process.returncode = os.waitstatus_to_exitcode(status)
        processor_time.add(used.ru_utime + used.ru_stime)
    return bool(ended)


def _request(plan: Plan, scene: Scene, names: set[str], floating: bool, loose: bool) -> dict[str, Any]:
    parameters = plan.simulation_parameters
    held = jointed(plan) | tied(plan)
    step = parameters.time_step
    rows: dict[str, SceneObject | AssetRow] = {row.name: row for row in plan.scene_objects}
    rows |= {name: row for row in plan.assets for name in row.instances}
    ground = parameters.materials.get("ground")
    objects = []
    for placed in scene.objects:
        if placed.name not in names:
            continue
        row = rows[placed.name]
        surface = _surface(plan, row.material)
        objects.append(
            {
                "name": placed.name,
                "asset": row.filename if isinstance(row, AssetRow) and row.type == "mesh" else None,
                "model": _model(plan, row),
                "vehicle": _vehicle(row),
                "road": _road(plan, row),
                "primitive": row.primitive
                if isinstance(row, SceneObject)
                else "box"
                if row.type in ("sculpt", "plant")
                else None,
                "wall": row.wall_thickness if isinstance(row, SceneObject) else None,
                "size": row.size if isinstance(row, SceneObject) else placed.size,
                "parts": _parts(plan, row),
                "form": arguments(row.primitive, vars(row)) if isinstance(row, SceneObject) and row.formed else None,
                "tilt_deg": row.deg_x if isinstance(row, SceneObject) else 0.0,
                "position": placed.position,
                "deg_z": placed.deg_z,
                "fixed": not loose and (placed.fixed or placed.name in held),
                "surface": surface,
                "mass": parameters.masses.get(placed.name, parameters.masses.get(row.name)),
            }
        )
    return {
        "objects": objects,
        "gravity": parameters.gravity_vector,
        "time_step": min(step if isinstance(step, float) else 0.002, 0.002),
        "ground": None if floating else (_surface(plan, "ground") if ground else {}),
    }


def _model(plan: Plan, row: SceneObject | AssetRow) -> dict[str, Any] | None:
    """Text of a model file, and where its meshes lie: a catalog folder, or `files` below a `root`, which is the plan's folder."""
    if not isinstance(row, AssetRow) or not is_model(row):
        return None
    model = load(row, plan.folder)
    told: dict[str, Any] = {"text": model.text, "folder": model.folder}
    return told | ({"files": model.files, "root": str(plan.folder.absolute())} if model.files and plan.folder else {})


def _vehicle(row: SceneObject | AssetRow) -> dict[str, Any] | None:
    """Kind and numbers of a vehicle, which is put there on its wheels."""
    if not isinstance(row, AssetRow) or row.vehicle is None:
        return None
    return {"kind": row.vehicle.kind, "numbers": row.vehicle.numbers}


def _road(plan: Plan, row: SceneObject | AssetRow) -> dict[str, str] | None:
    """The file of a road, and what it holds: an answer that was kept is of this surface."""
    if not isinstance(row, AssetRow) or not is_road(row) or plan.folder is None:
        return None
    path = (plan.folder / row.filename).absolute()
    return {"file": str(path), "sha256": hashlib.sha256(path.read_bytes()).hexdigest()}


def _parts(plan: Plan, row: SceneObject | AssetRow) -> list[dict[str, Any]]:
    """Arguments of `worldkit.parts.Part` for each part of a compound."""
    if not isinstance(row, SceneObject):
        return []
    return [vars(part.part()) | {"surface": _surface(plan, part.material)} for part in row.parts]


def _surface(plan: Plan, material: str | None) -> dict[str, float] | None:
    """Arguments of `worldkit.contacts.surface` for a material of the plan."""
    constants = plan.simulation_parameters.materials.get(material or "")
    if constants is None:
        return None
    values = {
        "friction": constants.friction,
        "torsional": constants.torsional_friction,
        "rolling": constants.rolling_friction,
        "restitution": constants.restitution,
        "density": constants.density,
    }
    return {key: value for key, value in values.items() if value is not None}
