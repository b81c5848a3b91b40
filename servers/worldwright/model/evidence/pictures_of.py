"""Which pictures a pass would make now: by what renderer and code, and, of video and final pass, by what film of its author.

`film.py`, beside the program, is no part of the physics: changing it leaves every recording and every still as it is, and
makes video and final pass others; of the video pass only the author's own film has to be drawn again.
"""

import hashlib
from collections.abc import Mapping

from worldengine.film.renderers import FINAL

from .. import companions
from . import environment
from .reports import PassName
from .run import Run

FILM = "film.py"
AUTHORED: tuple[PassName, ...] = ("video", "final")
"""The passes that draw the author's film."""


def identity(run: Run, stage: PassName, film: str = "") -> str:
    """SHA-256 of everything but the recording that the pictures of a pass depend on; empty for those without pictures.

    Args:
        run: the run folder.
        stage: which pass.
        film: the identity of the wanted renderer's films, from one who has asked for it just now; asked for when empty.

    Raises:
        NotFoundError: there is no such renderer as `WORLDKIT_RENDERER` names.
    """
    if stage in ("bundle", "physics"):
        return ""
    known = film if stage != "final" else ""
    drawn = known or environment.film(FINAL if stage == "final" else "").sha256
    authored = author_sha256(run) if stage in AUTHORED else ""
    return hashlib.sha256(f"{drawn}\n{authored}".encode()).hexdigest() if authored else drawn


def author_sha256(run: Run) -> str:
    """One hash over `film.py` and the files that belong to it; empty where nobody wrote one."""
    return sha256_of(files(run))


def sha256_of(found: Mapping[str, bytes]) -> str:
    """The same of files that are read already (`files`)."""
    if FILM not in found:
        return ""
    film = hashlib.sha256(found[FILM]).hexdigest()
    beside = companions.digest_of({name: content for name, content in found.items() if name != FILM})
    return hashlib.sha256(f"{film}\n{beside}".encode()).hexdigest()


def files(run: Run) -> dict[str, bytes]:
    """`film.py` and what belongs to it, by path relative to the run; empty where nobody wrote one."""
    path = run.folder / FILM
    return {FILM: path.read_bytes(), **companions.of(path)} if path.is_file() else {}
