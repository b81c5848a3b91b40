"""Reading recordings into a `Trajectory`: the engine's folders, and the npz interchange.

Whatever is wrong with a file ends in a `RecordingError` naming the file, the cause and the next move.
"""

from pathlib import Path
from typing import Any

import numpy as np

from ..errors import RecordingError
from . import law_balances, laws_told
from .coordinates import Coordinates
from .loads import Loads
from .mechanics import Mechanics
from .records import Contacts, Interventions
from .shown_points import ShownPoints
from .solver_channels import SolverChannels
from .stills import Lens, lenses
from .trajectory import OPTIONAL_SHAPES, SHAPES, Trajectory

Array = np.ndarray


def read_trajectory(path: Path | str) -> Trajectory:
    """A recording folder, or an `.npz` interchange file; failures are `RecordingError`s."""
    path = Path(path)
    return read_npz(path) if path.suffix == ".npz" else read_recording(path)


def read_npz(path: Path, mjcf: Path | None = None) -> Trajectory:
    """The interchange of `worldwright.model.recording.trajectory`; keys that are missing, misshapen or pickled are named."""
    try:
        with np.load(path, allow_pickle=False) as archive:
            found = {name: archive[name] for name in archive.files}
    except FileNotFoundError as cause:
        raise RecordingError("there is no such file", place=str(path), next_move="check the path") from cause
    except Exception as cause:  # zip, pickle, header, truncated data, a directory: all of them are a bad file
        raise RecordingError(
            f"not a readable npz archive: {cause}",
            place=str(path),
            next_move="write it with numpy.savez, plain arrays only (no objects, no pickle)",
        ) from cause
    needed = ("t", "names", *SHAPES)
    missing = [name for name in needed if name not in found]
    if missing:
        raise RecordingError(
            f"the archive lacks {', '.join(missing)}; it holds {', '.join(sorted(found)) or 'nothing'}",
            place=str(path),
            next_move=f"needed: {', '.join(needed)}; optional: {', '.join(OPTIONAL_SHAPES)}",
        )
    names = tuple(str(name) for name in np.ravel(found.pop("names")))
    mjcf = path.with_suffix(".xml") if mjcf is None and path.with_suffix(".xml").is_file() else mjcf
    channels: dict[str, Array] = {}
    for name in ("t", *SHAPES, *OPTIONAL_SHAPES):
        if name not in found:
            continue
        if not np.issubdtype(found[name].dtype, np.number) or np.iscomplexobj(found[name]):
            raise RecordingError(
                f"{name} holds {found[name].dtype}, not numbers", place=str(path), next_move="store float64 arrays"
            )
        channels[name] = found[name].astype(float)
    channels, late = _in_order(channels)
    model = None if mjcf is None else _compiled(mjcf)
    about: dict[str, Any] = {} if model is None else _described(model)
    trajectory = Trajectory(
        names=names,
        mechanics=Mechanics() if model is None else Mechanics.from_meta(about, names),
        meta={**about, "source": path.name},
        model=model,
        out_of_order=late,
        **channels,
    )
    trajectory.verify(str(path))
    return trajectory


def _in_order(channels: dict[str, Array]) -> tuple[dict[str, Array], tuple[float, ...]]:
    """The rows whose time is later than every earlier one's, and the times of the others."""
    t = channels["t"]
    if t.ndim != 1 or len(t) < 2 or not np.any(np.isfinite(t)):
        return channels, ()
    highest = np.maximum.accumulate(np.where(np.isfinite(t), t, -np.inf))
    kept = np.isfinite(t) & np.concatenate(([True], t[1:] > highest[:-1]))
    if kept.all():
        return channels, ()
    late = tuple(float(v) for v in np.nan_to_num(t[~kept]))
    return {name: a[kept] if len(a) == len(t) else a for name, a in channels.items()}, late


def _compiled(mjcf: Path) -> Any:
    """The model beside a recording."""
    import mujoco

    try:
        return mujoco.MjModel.from_xml_path(str(mjcf))
    except Exception as cause:  # MuJoCo raises several kinds for a model that does not load
        raise RecordingError(
            f"the MJCF beside the recording does not load: {cause}",
            place=str(mjcf),
            next_move="repair it, or move it away to scan poses alone",
        ) from cause


def _described(model: Any) -> dict[str, Any]:
    from worldengine.recording.describing import describe

    return describe(model)


def read_recording(folder: Path) -> Trajectory:
    """A recording folder that the engine wrote, memory-mapped; a partial one reads up to its last whole batch."""
    from worldengine.recording import stored

    try:
        recording = stored.open(folder)
        return from_recording(recording)
    except stored.RecordingError as cause:
        raise RecordingError(
            getattr(cause, "cause", str(cause)),
            place=getattr(cause, "place", "") or str(folder),
            next_move=getattr(cause, "next_move", ""),
        ) from cause


def _shared(words: "np.ndarray") -> list[str]:
    """The same words, each of them in memory once: millions of rows name a few."""
    known: dict[str, str] = {}
    return [known.setdefault(word, word) for word in map(str, words)]


def from_recording(recording: Any) -> Trajectory:
    """A motion out of an open recording, or of what has the same attributes."""
    names = tuple(recording.names)
    mechanics = Mechanics.from_meta(recording.meta, names)
    owner = {name: index for index, name in enumerate(names)}
    # A geom number of -1 is a flex's, which belongs to no rigid body: like the world, it has no index of its own.
    geom_body = np.array([owner.get(row["body"], -1) for row in recording.meta["geoms"]] + [-1], dtype=int)
    touches = recording.contacts
    contacts = Contacts(
        row=touches.row,
        body1=geom_body[touches.geom1],
        body2=geom_body[touches.geom2],
        depth_m=touches.depth_m,
        normal_force=touches.normal_force,
        force=touches.force,
        position=touches.position,
        normal=touches.normal,
        geom1=touches.geom1,
        geom2=touches.geom2,
    )
    acts = recording.interventions
    ledger = Interventions(
        time=acts.time,
        kind=_shared(acts.kind),
        target=_shared(acts.target),
        value=acts.value,
        work_j=acts.work_j,
    )
    warned = recording.warnings
    found = Trajectory(
        t=recording.time,
        names=names,
        pos=recording.pos,
        quat=recording.quat,
        linvel=recording.linvel,
        angvel=recording.angvel,
        energy=recording.energy,
        linmom=recording.linmom,
        angmom=recording.angmom,
        ncon=recording.ncon,
        contacts=contacts,
        interventions=ledger,
        balances=law_balances.read(recording, ledger, _gravity(recording, mechanics)),
        media=ShownPoints(recording=recording),
        warnings=tuple(
            (float(time), str(name), int(count))
            for time, name, count in zip(warned.time, warned.warning, warned.count, strict=True)
        ),
        loads=_loads(recording),
        coordinates=Coordinates(
            qpos=recording.qpos,
            qvel=recording.qvel,
            tendon_length=recording.tendon_length,
            eq_residual=recording.eq_residual,
        ),
        beside=SolverChannels.of(recording),
        mechanics=mechanics,
        meta=recording.meta,
        time_step=float(recording.time_step),
        complete=bool(recording.complete),
        recorded_sha256=recording.sha256 or "",
        cameras=_cameras(recording),
    )
    found.verify(str(recording.folder))
    return found


def _gravity(recording: Any, mechanics: Mechanics) -> Array:
    """(3,) m/s^2: what weighs the points of an author's laws, which a recording with laws has to tell."""
    found = mechanics.gravity
    if found is not None and found.shape == (3,) and np.isfinite(found).all():
        return found
    if not laws_told.of(recording.meta, str(recording.folder)):
        return np.zeros(3)
    cause = "the recording has an author's law, and no gravity that weighs its points"
    raise RecordingError(cause, place=str(recording.folder), next_move="run the physics pass again")


def _cameras(recording: Any) -> dict[str, Lens] | None:
    try:
        return None if recording.cameras is None else lenses(recording.cameras)
    except (KeyError, TypeError, ValueError) as cause:
        raise RecordingError(
            f"the recording's list of cameras is damaged: {cause!r}",
            place=str(recording.folder),
            next_move="run the physics pass again",
        ) from cause


def _loads(recording: Any) -> Loads:
    edits = recording.edits
    return Loads(
        eq_force=recording.eq_force,
        eq_torque=getattr(recording, "eq_torque", None),
        eq_stress=stress if (stress := getattr(recording, "eq_stress", None)) is not None and stress.size else None,
        eq_active=recording.eq_active.astype(bool),
        tendon_force=recording.tendon_force,
        actuator_force=recording.actuator_force,
        ctrl=recording.ctrl,
        edits=tuple(
            (float(time), str(array), int(index), float(value))
            for time, array, index, value in zip(edits.time, edits.array, edits.index, edits.value, strict=True)
        ),
        overlaps=recording.overlaps,
    )
