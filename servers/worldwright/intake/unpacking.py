"""`worldwright asset unpack ARCHIVE`: a robot's archive becomes a folder beside a plan, and what models it holds is told."""

import shutil
from pathlib import Path
from typing import Annotated

from pydantic import Field

from worldkit import model_files
from worldkit.errors import IntakeError
from worldkit.intake import unpacked

from ..expose import Positional
from ..model.errors import NotFoundError
from ..model.frozen import Frozen
from ..stage import given_models
from .refusing import IntakeFailedError


class UnpackedModels(Frozen):
    """What an archive held."""

    folder: str
    models: tuple[str, ...]
    """The URDF and MJCF files in it that no other of them includes, below the folder."""

    def text(self) -> str:
        """The folder, and how a plan names what is in it."""
        name = Path(self.folder).name
        rows = [
            f"  {{name: robot, type: {'urdf' if m.endswith('.urdf') else 'mjcf'}, filename: {name}/{m}}}"
            for m in self.models
        ]
        return "\n".join(
            [self.folder, *(["a plan beside it names in `assets`:", *rows] if rows else ["there is no model in it"])]
        )


def unpack(
    archive: Annotated[
        Path, Field(description=".zip or .tar (also compressed) with a URDF or MJCF and its meshes."), Positional()
    ],
    into: Annotated[
        Path | None, Field(description="A new folder; without it one of the archive's name, beside it.")
    ] = None,
) -> UnpackedModels:
    """Unpack a robot's model and meshes into a new folder, bounded and in its place; nothing is left of what is refused."""
    if not archive.is_file():
        raise NotFoundError("there is no such archive", place=str(archive), next_move="give the path of a .zip or .tar")
    folder = (into or archive.parent / archive.name.partition(".")[0]).absolute()
    if folder.exists():
        raise IntakeFailedError(
            "it is there already", code="taken", place=str(folder), next_move="name another folder: --into FOLDER"
        )
    if archive.suffix.lower() not in unpacked.ARCHIVES:
        raise IntakeFailedError(
            "it is no archive", code="unknown_format", place=str(archive), next_move="give a .zip or .tar"
        )
    try:
        unpacked.extract(archive, folder, given_models.WANTED)
    except IntakeError as error:
        shutil.rmtree(folder, ignore_errors=True)
        raise IntakeFailedError(error.cause, code=error.code, place=str(archive), next_move=error.next_move) from error
    found = tuple(path.relative_to(folder).as_posix() for path in model_files.models_in(folder))
    return UnpackedModels(folder=str(folder), models=found)
