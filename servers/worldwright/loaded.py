"""`worldwright.load(RUN)`: a world's arrays, model and frames in Python, with no server and no agent.

    import worldwright
    world = worldwright.load("runs/ball")
    world.arrays["qpos"]                  # (T, nq), with world.arrays["time"], (T,) s
    data = world.at(0.3)                  # an MjData of world.model, as it was recorded at 0.3 s
    for frame in world.frames("side"): …  # uint8 (H, W, 3) RGB

    campaign = worldwright.load("runs/balls")
    campaign.table.to_pandas()            # a pyarrow.Table, one row a world
    campaign.world(0).arrays["energy"]

The evidence is that of the present program and plan; where these were never run, the accepted recording stands in.
"""

from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from .model import mp4_file
from .model.errors import NotFoundError, RecordingError
from .model.evidence.reports import ExpectReport, ScanReport
from .model.evidence.run import Run

if TYPE_CHECKING:
    import mujoco
    import numpy as np
    import pyarrow
    import pyarrow.dataset

    from .campaign.campaign_store import Store
    from .campaign.world_row import Row
    from .stamp.state import State


class World:
    """One run, read when it is asked for.

    Args:
        run: the run folder.
    """

    def __init__(self, run: Run) -> None:
        self.run = run

    def __repr__(self) -> str:
        return f"World({str(self.run.folder)!r})"

    @cached_property
    def _state(self) -> "State":
        from .stamp.state import State

        return State(self.run)

    @cached_property
    def folder(self) -> Path:
        """What the arrays, the model and the frames are read from: the evidence of this key, else `accepted/`."""
        evidence = self._state.folder
        if (evidence / "physics" / "trajectory").is_dir():
            return evidence
        if (self.run.accepted / "trajectory.npz").is_file():
            return self.run.accepted
        raise NotFoundError(
            "no recording of this program and plan is here",
            place=str(self.run.folder),
            next_move=f"worldwright go {self.run.folder} --until expect (of an example: worldwright gallery build)",
        )

    @cached_property
    def arrays(self) -> Mapping[str, "np.ndarray"]:
        """What was recorded, by name, as arrays that cannot be written to.

        T rows and B bodies (`names`), world frame, SI units: `time` (T,), `pos` (T,B,3), `quat` (T,B,4) wxyz, `linvel` and
        `angvel` (T,B,3), `energy` (T,2) potential and kinetic; of this key's evidence also `qpos`, `qvel`, `ctrl`, `act`,
        `actuator_force`, `ncon` and all other columns of `worldengine/recording/columns.py`.

        Raises:
            RecordingError: the recording is damaged.
        """
        import numpy as np

        if self.folder == self.run.accepted:
            with np.load(self.folder / "trajectory.npz", allow_pickle=False) as archive:
                found = {("time" if name == "t" else name): archive[name] for name in archive.files}
            for array in found.values():
                array.flags.writeable = False
            return found
        return _Columns(self.folder / "physics" / "trajectory")

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The bodies, in the order of the arrays' second axis."""
        from .model.recording.trajectory_files import read_trajectory

        path = self.folder / "trajectory.npz"
        return read_trajectory(path if path.is_file() else self.folder / "physics" / "trajectory").names

    @cached_property
    def model(self) -> "mujoco.MjModel":
        """The compiled world."""
        from worldkit import portable

        inner = self.folder / "physics" / "world.mjz"
        path = inner if inner.is_file() else self.folder / "world.mjz"
        if not path.is_file():
            raise NotFoundError("the world's file is not here", place=str(path), next_move="worldwright gallery build")
        return portable.read(path)

    def at(self, time_s: float) -> "mujoco.MjData":
        """The recorded row nearest to a moment, as a state of `model` on which `mj_forward` was called.

        All of the state is set: joints, actuators and their controls, mocap bodies, equalities, plastic springs. Not applied are
        recorded edits of the model (`worldengine/recording/replay.py` does that, for a film) and what a solver shows.

        Raises:
            RecordingError: the recording holds no joint positions (an accepted folder's own file).
        """
        import mujoco
        import numpy as np

        from worldengine.recording.replay import STATE

        try:
            state = {name: self.arrays[name] for name in STATE}
        except KeyError as cause:
            raise RecordingError(
                "joint positions are not in this recording",
                place=str(self.folder),
                next_move="worldwright go RUN --until physics records them",
            ) from cause
        row = int(np.abs(self.arrays["time"] - time_s).argmin())
        data = mujoco.MjData(self.model)
        data.time = self.arrays["time"][row]
        for name, recorded in state.items():
            getattr(data, name)[...] = recorded[row]
        mujoco.mj_forward(self.model, data)
        return data

    def frames(self, camera: str | None = None) -> "Iterator[np.ndarray]":
        """The frames of a film, uint8 (H, W, 3) RGB, one after the other.

        Args:
            camera: a camera of the plan, or `film` for the author's; the first film by name without it.
        """
        films = {path.stem: path for path in sorted((self.folder / "video").glob("*.mp4"))}
        path = films.get(camera) if camera else next(iter(films.values()), None)
        if path is None:
            raise NotFoundError(
                f"there is no film of `{camera}`" if camera and films else "nothing of this world was filmed",
                place=str(self.folder / "video"),
                next_move=f"known: {', '.join(films)}"
                if films
                else f"worldwright stage start {self.run.folder} --pass video",
            )
        with mp4_file.opened(path) as container:
            for frame in container.decode(video=0):
                yield frame.to_ndarray(format="rgb24")

    @property
    def expect(self) -> ExpectReport | None:
        """Each objective with what was measured and its margin; None before it was."""
        return self._state.expect.value

    @property
    def scan(self) -> ScanReport | None:
        """What was found implausible; None before it was looked for."""
        return self._state.scan.value


class _Columns(Mapping[str, "np.ndarray"]):
    """The columns of a recording, each read when it is first asked for."""

    def __init__(self, folder: Path) -> None:
        from worldengine.recording import stored

        try:
            self._recording = stored.open(folder)
        except stored.RecordingError as cause:
            raise RecordingError(cause.cause, place=cause.place, next_move=cause.next_move) from cause
        self._names = tuple(self._recording._state.columns)

    def __getitem__(self, name: str) -> "np.ndarray":
        if name not in self._names:
            raise KeyError(f"{name!r}; recorded: {', '.join(self._names)}")
        found: np.ndarray = getattr(self._recording, name)
        return found

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


class Worlds:
    """A campaign: its table, its rows, and each of its worlds.

    Args:
        store: its folder.
    """

    def __init__(self, store: "Store") -> None:
        self.store = store

    def __repr__(self) -> str:
        return f"Worlds({str(self.store.folder)!r})"

    @cached_property
    def table(self) -> "pyarrow.Table":
        """One row a world that is done, by the worlds' numbers; columns as in `campaign/campaign_table.py`."""
        from .campaign import campaign_table

        return campaign_table.of(self.rows())

    def rows(self) -> "list[Row]":
        """The same as data of ours, with causes, margins and minutes."""
        return sorted(self.store.rows(), key=lambda row: row.number)

    def trajectories(self, part: str = "train") -> "pyarrow.dataset.Dataset":
        """The recordings of one part (`train`, `validation`, `test`), written before by `worldwright campaign trajectories`.

        A `pyarrow.dataset.Dataset`, read a batch at a time; its columns are told in `campaign/trajectories.py`.
        """
        import pyarrow.dataset

        from .campaign import trajectories

        folder = self.store.folder / trajectories.FOLDER / f"split={part}"
        whole = (folder.parent / trajectories.SCHEMA).is_file()
        if not folder.is_dir() or not whole:
            raise NotFoundError(
                f"there is no part `{part}` of its trajectories"
                if whole
                else "its trajectories are not written to the end",
                place=str(folder),
                next_move=f"`worldwright campaign trajectories {self.store.folder.name}`; known: {', '.join(trajectories.PARTS)}",
            )
        return pyarrow.dataset.dataset(folder)

    def world(self, which: int | str) -> World:
        """A world by its number in the campaign, or by its address."""
        row = next((row for row in self.store.rows() if which in (row.number, row.world)), None)
        if row is None:
            raise NotFoundError(
                f"no world `{which}` is done", place=str(self.store.folder), next_move="worldwright campaign status"
            )
        if not row.folder:
            raise NotFoundError(
                f"world {row.number} left nothing behind: {row.cause.said.splitlines()[0] if row.cause else row.outcome}",
                place=str(self.store.row_path(row.world)),
                next_move=(row.cause.next_move if row.cause else "") or "worldwright campaign resume",
            )
        return World(Run(self.store.folder / row.folder))


def load(name: Path | str) -> World | Worlds:
    """A run, or a campaign, by its folder or its name under runs/ or examples/."""
    from .campaign.campaign_store import ABOUT, Store

    if any((place / ABOUT).is_file() for place in (Path(name), Path("runs") / name)):
        return Worlds(Store.find(name))
    return World(Run.find(name))
