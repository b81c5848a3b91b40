"""`worldwright asset picture WORDS FILE.png`: a service paints a thing on a plain ground, of which a minter makes a mesh."""

import hashlib
from pathlib import Path
from typing import Annotated

from pydantic import Field

from worldkit.data_folders import data_root
from worldkit.files import write_atomic

from ..expose import Positional
from ..model.errors import NotFoundError
from ..model.frozen import Frozen
from ..model.storage import writing
from . import given_pictures, painters
from .refusing import IntakeFailedError

GROUND = "{words}, the whole of one single object, seen from three quarters, evenly lit, on a plain white background, no shadow"
"""What a minter needs to see besides."""


class Painted(Frozen):
    """A picture that was painted."""

    file: str
    anew: bool
    """Whether it was painted, and paid, now; else it was kept from before."""
    next_move: str

    def text(self) -> str:
        """Where it lies, and what to do with it."""
        return f"{self.file} ({'painted' if self.anew else 'kept from before'})\n  next: {self.next_move}"


def picture(
    words: Annotated[str, Field(description="What to paint, e.g. a red enamel mug.", min_length=1), Positional()],
    file: Annotated[Path, Field(description="Where to put the picture, PNG or JPEG as it comes.")],
    painter: Annotated[str, Field(description="Which service paints: openai_images, google_images.")] = "openai_images",
    model: Annotated[
        str | None, Field(description="Which of its models; without it the one whose price is known.")
    ] = None,
    address: Annotated[str | None, Field(description="Where it listens, if not at the service's own address.")] = None,
    confirm_price: Annotated[
        float | None, Field(description="What you are willing to pay, US dollars; asked without it, the price is told.")
    ] = None,
) -> Painted:
    """Have a service paint one thing on a plain ground; look at the picture, then `worldwright asset mint` it."""
    if painter not in painters.SEAM.names():
        raise NotFoundError(
            f"no service that paints is called {painter!r}", place="painter",
            next_move=f"name one of: {', '.join(painters.SEAM.names())}",
        )  # fmt: skip
    if file.exists():
        raise IntakeFailedError(
            "there is such a file already", code="taken", place=str(file), next_move="name another, or remove it"
        )
    service = painters.SEAM.find(painter)
    chosen = model or service.MODEL
    asked = GROUND.format(words=" ".join(words.split()))
    kept = data_root() / "painted" / hashlib.sha256(f"{painter}\n{chosen}\n{asked}".encode()).hexdigest()
    anew = not kept.is_file()
    if anew:
        there = service.TERMS.server(painter, address)
        service.price(chosen).confirm(confirm_price, painter)
        made = service.paint(asked, chosen, there)
        if not given_pictures.is_one(made, "the answer"):
            raise there.garbage(repr(made[:40]), "picture")
        with writing("the picture", kept):
            write_atomic(kept, made)
    with writing("the picture", file):
        write_atomic(file, kept.read_bytes())
    return Painted(
        file=str(file), anew=anew, next_move=f"look at it; then `worldwright asset mint {file} HEIGHT`, its height in m"
    )
