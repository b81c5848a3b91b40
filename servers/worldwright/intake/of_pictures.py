"""`worldwright asset mint PICTURE`: a server that the user runs makes a mesh of a picture, which is taken in like any file.

What a server made of a picture is kept by the hash of both, so that nothing is made, or paid, twice.
"""

import hashlib
import os
import re
import tempfile
from pathlib import Path
from typing import Annotated

from pydantic import Field

from worldkit.data_folders import data_root
from worldkit.files import write_atomic
from worldkit.intake import declared_sizes

from ..expose import Positional
from ..model.errors import NotFoundError
from ..model.picture import Illustrated
from ..model.progress import Progress, silent
from ..model.storage import writing
from .minters import SEAM
from .refusing import IntakeFailedError
from .taking_in import add

MOST_PICTURE = 16 << 20
NO_MESH = ("truncated", "no_mesh", "unreadable", "unknown_format", "not_finite", "zero_volume")
"""What an intake says of a mesh that is worth nothing: it is asked for anew."""


def mint(
    picture: Annotated[
        Path, Field(description="A PNG or JPEG of one thing, its ground plain or cut away."), Positional()
    ],
    height: Annotated[float, Field(description="How high it stands in the real world, m: no server tells.", gt=0)],
    key: Annotated[str | None, Field(description="What plans call it; without it the picture's name.")] = None,
    server: Annotated[str, Field(description="Which kind of server it is.")] = "hunyuan3d",
    address: Annotated[
        str | None, Field(description="Where it listens; without it the server's environment variable.")
    ] = None,
    material: Annotated[str | None, Field(description="What it is of: density, friction, restitution.")] = None,
    licence: Annotated[
        str | None, Field(description="Of picture and mesh together, as the server's terms have it.")
    ] = None,
    replace: Annotated[bool, Field(description="Take the place of an asset of the same key.")] = False,
    progress: Progress = silent,
) -> Illustrated:
    """Have a server make a mesh of a picture, and take it in as an asset of your own; without a server, sculpt the thing."""
    if server not in SEAM.names():
        raise NotFoundError(
            f"no kind of server is called {server!r}",
            place="server",
            next_move=f"name one of: {', '.join(SEAM.names())}",
        )
    minter = SEAM.find(server)
    where = address or os.environ.get(minter.variable(), "")
    if not where:
        raise NotFoundError(
            f"no {server} server is named", place=f"--address, or {minter.variable()}",
            next_move=f"{minter.starting()}; or sculpt the thing (skill sculpting)",
        )  # fmt: skip
    data = _picture(picture)
    name = hashlib.sha256(f"{server}\n".encode() + data).hexdigest()
    kept = data_root() / "minted" / f"{name}.glb"
    if not kept.is_file():
        made = minter.mint(data, where)
        with writing("the mesh", kept):
            write_atomic(kept, made)
    asked = {
        "key": key or re.sub(r"[^a-z0-9]+", "_", picture.stem.lower()).strip("_"), "height": height, "material": material,
        "licence": licence, "source": f"made by {server} of the picture {picture.name}",
    }  # fmt: skip
    with tempfile.TemporaryDirectory(prefix="worldwright-minted-") as folder:
        file = Path(folder) / "minted.glb"
        file.write_bytes(kept.read_bytes())
        asked = {word: value for word, value in asked.items() if value is not None}
        try:
            return add(file, asked, replace=replace, progress=progress)
        except IntakeFailedError as error:
            if error.code in NO_MESH:
                kept.unlink(missing_ok=True)
            raise


def _picture(path: Path) -> bytes:
    if not path.is_file():
        raise NotFoundError("there is no such picture", place=str(path), next_move="give the path of a PNG or JPEG")
    with path.open("rb") as file:
        data = file.read(MOST_PICTURE + 1)
    if len(data) > MOST_PICTURE or declared_sizes.picture(data[: declared_sizes.HEADER_BYTES], path.name) == (0, 0):
        raise IntakeFailedError(
            f"it is no PNG or JPEG of at most {MOST_PICTURE >> 20} MB", code="no_picture", place=str(path),
            next_move="save it as PNG or JPEG, smaller",
        )  # fmt: skip
    return data
