"""The film of a drive, through the cameras of its plan, drawn from the recording that the replay made."""

from collections.abc import Sequence
from pathlib import Path

from worldkit.files import write_atomic

from ..model.errors import GateError
from ..stage.one_frame import given_words
from ..stage.short_runs import engine
from . import drive_folder, drive_replay, driven
from .drive_folder import PHYSICS, TRAJECTORY

FILM = "film"
STILL_S = 600.0
"""So long, s of its own, the engine may draw nothing; how long the film is, is the drive's."""


def film(folder: Path, cameras: Sequence[str] = ()) -> tuple[list[Path], driven.Driven]:
    """Draw it into `film/` of the drive; returns the files, and what is stated of the drive: `vouched` tells whether by a known key.

    Raises:
        GateError: the drive is not proved, not as it was stated, or its recording is not the one that was.
        JobError: the engine could not draw it.
    """
    from worldengine.recording import stored

    stated = driven.checked(folder)
    folder = Path(stated.folder)
    recording, again = folder / PHYSICS / TRAJECTORY, f"worldwright drive prove {folder}"
    if not (recording / "complete.json").is_file():
        raise GateError("this drive is not proved yet", place=str(folder), next_move=again)
    with drive_replay.sound(recording):
        shown = stored.digest(stored.open(recording))
    if shown != (said := stated.trajectory_sha256):
        drive_folder.refuse(recording, f"another recording lies here: {shown[:16]}, not {said[:16]}", again)
    words = given_words(folder)
    words[words.index("--from") + 1] = str(recording)
    words += [word for name in cameras for word in ("--camera", name)]
    found = engine(
        ["video", *words],
        (folder,),
        ("*.mp4",),
        wall_s=STILL_S,
        advances=True,
        again=f"worldwright drive film {folder}",
    )
    made = []
    for name, data in found.items():
        if name.endswith(".mp4"):
            made.append(folder / FILM / name)
            made[-1].parent.mkdir(exist_ok=True)
            write_atomic(made[-1], data)
    return made, stated
