"""`worldwright asset mint PICTURE`: a server makes a mesh of a picture, which is taken in like any file.

The picture's plain ground is cut away, a price is confirmed before it is spent, and what a server made of a picture is kept by the
hash of both, so that nothing is made, or paid, twice.
"""

import hashlib
import re
import tempfile
from pathlib import Path
from typing import Annotated

from pydantic import Field

from worldkit.data_folders import data_root
from worldkit.files import write_atomic

from ..expose import Positional
from ..model.errors import NotFoundError
from ..model.picture import Illustrated
from ..model.progress import Progress, silent
from ..model.storage import writing
from . import given_pictures, minters
from .orders import Order
from .refusing import IntakeFailedError
from .taking_in import add
from .web_calls import MintError

NO_MESH = ("truncated", "no_mesh", "unreadable", "unknown_format", "not_finite", "zero_volume")
"""What an intake says of a mesh that is worth nothing: it is asked for anew."""
KINDS = (".glb", ".obj")


def mint(
    picture: Annotated[
        Path, Field(description="A PNG or JPEG of one thing, its ground plain or cut away."), Positional()
    ],
    height: Annotated[float, Field(description="How high it stands in the real world, m: no server tells.", gt=0)],
    key: Annotated[str | None, Field(description="What plans call it; without it the picture's name.")] = None,
    server: Annotated[
        str, Field(description="Which kind of server it is: hunyuan3d, trellis, triposr, meshy, tripo.")
    ] = "hunyuan3d",
    address: Annotated[
        str | None, Field(description="Where it listens; without it the server's environment variable.")
    ] = None,
    cut: Annotated[bool, Field(description="Cut the thing from a plain ground first.")] = True,
    confirm_price: Annotated[
        float | None, Field(description="What you are willing to pay; asked without it, the price is told.")
    ] = None,
    material: Annotated[str | None, Field(description="What it is of: density, friction, restitution.")] = None,
    licence: Annotated[
        str | None, Field(description="Of picture and mesh together, as the server's terms have it.")
    ] = None,
    replace: Annotated[bool, Field(description="Take the place of an asset of the same key.")] = False,
    progress: Progress = silent,
) -> Illustrated:
    """Have a server make a mesh of a picture, and take it in as an asset of your own; without a server, sculpt the thing."""
    if server not in minters.SEAM.names():
        raise NotFoundError(
            f"no kind of server is called {server!r}",
            place="server",
            next_move=f"name one of: {', '.join(minters.SEAM.names())}",
        )
    minter = minters.SEAM.find(server)
    there = minter.TERMS.server(server, address)
    data = given_pictures.read(picture)
    told = ""
    if cut:
        data, told = given_pictures.cut(data)
    name = hashlib.sha256(f"{server}\n".encode() + data).hexdigest()
    folder = data_root() / "minted"
    kept = next((file for kind in KINDS if (file := folder / f"{name}{kind}").is_file()), None)
    order = Order(folder / f"{name}.ordered", lambda said: progress(0, 0, f"{server}: {said}"))
    if kept is None:
        if not order.file.is_file():
            minter.TERMS.price.confirm(confirm_price, server)
        try:
            made = minter.mint(data, there, order)
            kind = _kind(made)
            if kind is None:
                raise there.garbage(repr(made[:40]), "GLB")
        except MintError as error:
            if order.file.is_file():
                error.next_move += f"; its work is kept in {order.file}: without that file it is begun, and paid, anew"
            raise
        kept = folder / f"{name}{kind}"
        with writing("the mesh", kept):
            write_atomic(kept, made)
        order.done()
    said = "; ".join([f"made by {server} of the picture {picture.name}", *([told] if told else []), *order.said])
    asked = {
        "key": key or re.sub(r"[^a-z0-9]+", "_", picture.stem.lower()).strip("_"), "height": height, "material": material,
        "licence": licence, "source": said,
    }  # fmt: skip
    with tempfile.TemporaryDirectory(prefix="worldwright-minted-") as scratch:
        file = Path(scratch) / f"minted{kept.suffix}"
        file.write_bytes(kept.read_bytes())
        asked = {word: value for word, value in asked.items() if value is not None}
        try:
            return add(file, asked, replace=replace, progress=progress)
        except IntakeFailedError as error:
            if error.code in NO_MESH:
                kept.unlink(missing_ok=True)
            raise


def _kind(made: bytes) -> str | None:
    """How a file of this content is called; None for what is no mesh."""
    if made[:4] == b"glTF":
        return ".glb"
    lines = made[:4096].decode("ascii", errors="replace").splitlines()
    return ".obj" if any(re.match(r"v\s+[-+.\d]", line) for line in lines) else None
