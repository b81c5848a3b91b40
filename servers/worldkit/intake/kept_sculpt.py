"""What a run's file sculpts, as the files of an asset, in the confined process: the file sees what lies beside it and nothing else."""

import sys
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from .. import contacts
from ..errors import IntakeError, ProgramError
from ..sculpt import from_files
from ..sculpt.figure import Part
from . import of_figure

HEADER = "Kept by `worldwright asset keep`; what is measured here is of the files beside it."
UNSTATED = 0.5
"""Sliding friction of what nobody says."""
ON = "give its lowest part a flat base, or more of one, and keep it again"


def taken(root: Path, asked: dict[str, Any]) -> tuple[dict[str, bytes], dict[str, Any]]:
    """The files and the facts of what a file below `root` sculpts.

    Args:
        root: the run's folder, or a copy of it with what the file reads.
        asked: `key`, `file` and `of` as a plan's row names them, `said` as of `of_figure.files`, and of the row, where the plan
            tells: `mass`, kg, `surface` (friction, restitution, density) and `look`.

    Raises:
        IntakeError: the file fails (`reads_elsewhere` where it looks for what does not lie beside it).
    """
    file, of = asked["file"], asked["of"]
    sys.path.insert(0, str(root))
    try:
        surface = contacts.surface(**asked["surface"]) if asked.get("surface") else None
        with from_files.sculpted(file, of) as held:
            parts = from_files.as_planned(list(held), asked.get("mass"), surface, asked.get("look"))
            made, facts = of_figure.files(
                asked["key"], parts, asked["said"] if surface else rubbing(parts, asked["said"])
            )
    except (IntakeError, MemoryError):
        raise
    except ProgramError as error:
        raise IntakeError("no_sculpt", error.cause, error.place, error.next_move) from error
    except Exception as error:  # author code may raise anything
        raise IntakeError(*_told(error, file)) from error
    facts["measured"]["collides_as"] = f"{(count := len(facts['collision']))} hull{'s' if count > 1 else ''}"
    return made, facts


def rubbing(parts: Sequence[Part], said: dict[str, Any]) -> dict[str, Any]:
    """What is said of a thing whose plan names no material, with how it rubs: as its parts do by themselves, where all of them tell."""
    own = [part.surface["friction"] for part in parts if part.surface and "friction" in part.surface]
    if len(own) < len(parts):
        unsaid = f"how it rubs is not stated: its friction is taken as {UNSTATED:g}; name a material in the plan's row"
        return {**said, "friction": UNSTATED, "assumed": [*said["assumed"], unsaid]}
    worst = map(max, zip(*own, strict=True))  # of two surfaces the larger acts
    told = dict(zip(("friction", "torsional", "rolling"), map(float, worst), strict=True))
    return {**said, **told, "contact_source": "its parts' own surfaces, the largest of each number"}


def _told(error: Exception, file: str) -> tuple[str, str, str, str]:
    """Code, cause, place and next move of an error that an author's file ended with."""
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename.endswith(file)]
    place = f"{file}:{lines[-1]}" if lines else file
    if isinstance(error, FileNotFoundError | PermissionError | ModuleNotFoundError):
        missing = getattr(error, "filename", None) or getattr(error, "name", None) or error
        cause = f"it reads {missing}, which does not lie beside it in the run"
        return (
            "reads_elsewhere",
            cause,
            place,
            "copy that into the run folder and name it by its relative path, as a text in the code",
        )
    return "sculpt_failed", f"{type(error).__name__}: {error}", place, f"correct it: worldwright sculpt sheet {file}"
