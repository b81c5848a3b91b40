"""Refuse a film that makes a body which can move unseen: claims are about what moves, and a film shows what happened.

A wall may be cut away, which its look tells; a mover stays in the picture, by its own shapes, a skin or a surface.
"""

from collections.abc import Container
from typing import TYPE_CHECKING, Any

from worldkit.filming.film_bounds import SEEN

from ..recording.seen import shown_rgba
from .described import FilmError, opacity

if TYPE_CHECKING:
    import mujoco

FIX = "give it a look with an opacity of 0.2 or more; to show what is behind it, place the camera elsewhere"


def seen(spec: "mujoco.MjSpec", beside: Container[str] = ()) -> set[str]:
    """Bodies that can move and are seen by a shape that is drawn, and opaque enough, and not named among those `beside` theirs."""
    return {
        body.name
        for body in spec.bodies
        if _moves(body) and any(_opaque(spec, geom) for geom in body.geoms if not _is_of(geom.name, beside))
    }


def refuse(spec: "mujoco.MjSpec", film: Any, before: set[str]) -> None:
    """Refuse a film by whose looks and skins a body that was seen `before` is seen no more.

    Raises:
        FilmError: naming the body.
    """
    covered = {name: one for one in film.surfaces for name in one["of"]}
    beside = {f"drawn.{thing['name']}" for thing in film.things if not thing["instead"]}
    shown = seen(spec, beside) | {name for name, one in covered.items() if opacity(one["look"]) >= SEEN}
    for name in sorted(before - shown):
        raise FilmError(
            f"the film makes {name!r}, which can move, nearly clear: what happened to it is unseen", "film.py", FIX
        )


def _moves(body: Any) -> bool:
    while body is not None and body.name != "world":
        if len(body.joints):
            return True
        body = body.parent
    return False


def _is_of(name: str, things: Container[str]) -> bool:
    """Whether a geom is one of these things, or one of the copies of it: `drawn.dust` and `drawn.dust/3`."""
    return name in things or name.rpartition("/")[0] in things


def _opaque(spec: "mujoco.MjSpec", geom: Any) -> bool:
    if geom.group > 2:
        return False
    material = spec.material(geom.material) if geom.material else None
    return float(shown_rgba(geom.rgba, geom.rgba if material is None else material.rgba)[3]) >= SEEN
