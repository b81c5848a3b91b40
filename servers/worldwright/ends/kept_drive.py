"""A drive as a run of its own: its program builds the world that was driven, and gives the commands as they were recorded.

    RUN/simulation.py        `build` reads the world's file, `control` the table of commands
    RUN/driven_world.mjz, driven_commands.npz, driven_names.json    world, commands and names, so that evidence is about them, too
    RUN/plan.md              the drive's plan, as long as it was driven, its controls "driven live by …"
    RUN/driven/drive.json, …    who drove it, as it was stated and signed

It is scanned, filmed and accepted as any other run: its claims are the plan's, and a person may have to write what the drive shows.
That it is the drive is proved by `same`: its recording passes through the rows that were recorded live, bit for bit.
"""

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.files import write_atomic, write_json

from ..model.errors import NotFoundError
from ..model.evidence.run import Run, sha256_file
from ..model.plan.plan_edit import edit
from ..model.plan.plan_text import parse_plan, read_plan
from ..model.printable import line
from ..model.storage import writing
from ..stamp import driven_live, signing
from . import drive_folder, drive_replay, driven
from .drive_folder import STATEMENT, STREAM, TRAJECTORY

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from .driven import Driven

WORLD, COMMANDS, NAMES = "driven_world.mjz", "driven_commands.npz", "driven_names.json"
PROGRAM = '''"""{title}

The world is the file that was driven, and its controls are what was commanded then, at the steps where that took effect.
"""

import json
from pathlib import Path

import mujoco
import numpy as np

from worldkit import portable, program

HERE = Path(__file__).parent
TIME_STEP = {time_step!r}  # s
BEGAN = {began!r}  # s, what the clock of the world says at its start
DURATION = {duration!r}  # s
EVERY = {every}  # steps from one command to the next
NAMES = json.loads((HERE / "{names}").read_text(encoding="utf-8"))
TOLD = np.load(HERE / "{commands}")
CONTROLS, VALUES = TOLD["controls"], TOLD["values"]


def build() -> mujoco.MjSpec:
    """The world at t = 0, as it was driven, with every body and camera that it had."""
    spec = portable.spec(HERE / "{world}")
    missing = [name for name in NAMES["bodies"] if spec.body(name) is None]
    missing += [name for name in NAMES["cameras"] if spec.camera(name) is None]
    if missing:
        raise ValueError(f"this is not the world that was driven: it lacks {{missing}}")
    return spec


def control(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Whoever drove gave these commands."""
    question = round((data.time - BEGAN) / TIME_STEP) // EVERY
    data.ctrl[CONTROLS] = VALUES[min(question, len(VALUES) - 1)]


def main(*argv: str) -> int:
    return program.main(
        build,
        control,
        duration=DURATION,
        fps={fps},
        size={size},
        movers={movers},
        visual_only={visual_only},
        seed={seed},
        control_every=EVERY,
        argv=argv or None,
    )


if __name__ == "__main__":
    main()
'''


def keep(folder: Path, into: Path) -> "Driven":
    """Make a run of a drive; returns what is stated of the drive.

    Args:
        folder: of the drive, finished.
        into: the run's folder, not there yet.

    Raises:
        GateError: the drive is not finished or not as it was stated, or more than controls drove it.
        NotFoundError: there is something in the new folder.
        StorageError: it cannot be written.
    """
    import numpy as np

    from worldkit.naming import names

    if into.exists() and (not into.is_dir() or any(into.iterdir())):
        raise NotFoundError(f"{into} is there already", next_move="name a folder that is not")
    stated = driven.checked(folder)
    folder = Path(stated.folder)
    facts = drive_folder.facts(folder, "program.json")
    with drive_replay.sound(folder):
        model, controls, values = commands(folder)
        began = float(drive_replay.recorded(folder).time[0])
        text = program_text(facts, stated, float(model.opt.timestep), began)
    plan = plan_text(folder, stated)
    drivers = _drivers(stated)
    with _whole(into) as room:
        (room / "prompt.md").write_text(
            f"{line(stated.run)}, driven live by {drivers} for {stated.simulated_s:g} s.\n", encoding="utf-8"
        )
        (room / "plan.md").write_text(plan, encoding="utf-8")
        shutil.copyfile(folder / "world.mjz", room / WORLD)
        np.savez_compressed(room / COMMANDS, controls=controls, values=values)
        found = {"bodies": names(model, "body", model.nbody)[1:], "cameras": names(model, "camera", model.ncam)}
        write_json(room / NAMES, {kind: [name for name in rows if name] for kind, rows in found.items()})
        for name in (STATEMENT, signing.ENVELOPE, signing.PUBLIC):
            if (folder / name).is_file():
                (room / "driven").mkdir(exist_ok=True)
                shutil.copyfile(folder / name, room / "driven" / name)
        write_atomic(room / "simulation.py", text)
    return stated


@contextmanager
def _whole(into: Path) -> Iterator[Path]:
    """A folder beside a new run to make it in, which takes its place when it is whole; else nothing is left."""
    with writing("the run of the drive", into):
        into = into.resolve()
        into.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".keeping-", dir=into.parent) as room:
            made = Path(room) / "run"
            made.mkdir()
            yield made
            made.replace(into)


def commands(folder: Path) -> "tuple[mujoco.MjModel, np.ndarray, np.ndarray]":
    """What was driven and commanded: the world, (C,) indices of its `ctrl`, and (questions, C) values.

    Raises:
        GateError: more than controls drove it.
    """
    import numpy as np

    from worldengine.given import Given
    from worldengine.inputs.ports import Ports
    from worldengine.inputs.strict_stream import Recorded
    from worldengine.recording.stored import Replayable
    from worldkit.world import steps_of

    given = Given.read(folder / "world.mjz", folder / "program.json", folder / "inputs.json")
    model = given.model()
    ports, told = Ports(model, given.inputs), Replayable(folder / STREAM)
    controls = np.array(ports.entries.get("ctrl", []), int)
    if len(told.edits) or (len(told.inputs) and int(np.max(told.inputs.entry)) >= len(controls)):
        drive_folder.refuse(folder, "pushes or writes of the state drove it besides its controls", "keep it as a drive")
    steps = steps_of(model, given.duration)
    stream = Recorded(told, model, ports, steps, given.control_every)
    rows = []
    for step in range(0, steps, given.control_every):
        if stream.speaks(step):
            stream.answer(step)
        rows.append(stream.vector[: len(controls)].copy())
    return model, controls, np.array(rows).reshape(len(rows), len(controls))


def program_text(facts: dict[str, Any], stated: "Driven", time_step: float, began: float) -> str:
    """The program of the kept run, for the drive's time step and what its clock said at its first row, s."""
    lists = {name: tuple(map(str, facts.get(name, ()))) for name in ("movers", "visual_only")}
    width, height = facts["size"]
    return PROGRAM.format(
        title=f"A world as it was driven live by {_drivers(stated)}.", time_step=time_step, began=began,
        duration=float(facts["duration"]), every=int(facts.get("control_every", 1)), commands=COMMANDS, world=WORLD,
        names=NAMES,
        fps=int(facts["fps"]), size=(int(width), int(height)), seed=int(facts.get("seed", 0)), **lists,
    )  # fmt: skip


def plan_text(folder: Path, stated: "Driven") -> str:
    """The drive's plan with the time that was driven, and who drove in the rows that declare the controls.

    Raises:
        GateError: it cannot be changed so.
    """
    document = parse_plan((folder / "plan.md").read_text(encoding="utf-8"), str(folder / "plan.md"))
    plan = read_plan(folder / "plan.md").plan
    law = f"driven live by {_drivers(stated)}, whose commands were recorded"
    signed = "signed by the live run" if stated.vouched else "not signed by the live run"
    source = f"drive {folder.name}, {signed}, drive.json sha256:{sha256_file(folder / STATEMENT)[:16]}"
    at = ("simulation_parameters", "interventions")
    written = document.nodes["simulation_parameters"].data().get("interventions") or []
    rows = [
        {**row, "law": law, "source": source, "trigger": "always"} if row.get("kind") == "control" else dict(row)
        for row in written
    ]
    known = {name for row in rows for name in row.get("bodies", ())}
    for one in plan.simulation_parameters.interventions:
        if one.kind == "control" and not known.issuperset(one.bodies):
            bodies = list(one.bodies)
            rows.append({"kind": "control", "bodies": bodies, "law": law, "source": source, "trigger": "always"})
    changes: list[tuple[tuple[str | int, ...], Any]] = [
        (("simulation_parameters", "simulation_duration"), stated.simulated_s),
        (at, rows),
    ]
    for number, asset in enumerate(document.nodes["assets"].data() or [] if "assets" in document.nodes else []):
        vehicle = asset.get("vehicle") if isinstance(asset, dict) else None
        if isinstance(vehicle, dict) and "follows" in vehicle:
            kept = {name: value for name, value in vehicle.items() if name != "follows"}
            changes.append((("assets", number, "vehicle"), kept))
    return edit(document, changes)


def _drivers(stated: "Driven") -> str:
    """Whose hand it was, by the names that were given: letters, digits and blanks alone, since they go into texts that are read."""
    return driven_live.named(row["driver"] for row in stated.driven_by)


def same(recording: Path, folder: Path) -> int:
    """How many rows recorded live a recording of the kept run has, too, bit for bit.

    Raises:
        GateError: it moves otherwise than the drive, or cannot be read.
    """
    from worldengine.recording import stored

    live = drive_replay.recorded(drive_folder.checked(folder))
    with drive_replay.sound(recording):
        whole = stored.open(recording)
    return drive_replay.compared(live, whole, drive_replay.steps_of(live))


def recording_of(run: Path) -> Path:
    """The recording of a kept run as it is; a `GateError` where nothing is recorded of it."""
    from ..model.evidence import environment
    from ..stage.one_frame import recorded

    kept = Run.find(run)
    return recorded(kept, kept.evidence_key(environment.current().sha256())) / TRAJECTORY
