"""Compile the surface shader in the variants that a model needs: only the features in use, each only once."""

from __future__ import annotations

from dataclasses import dataclass

from . import gl
from .things import Batch

VARIED_GROUND = 0.13
"""Looks that vary at least this much also get a second, turned copy of their texture."""


@dataclass(frozen=True)
class Features:
    """The features of a variant; the fields are the definitions in `shaders/surface.frag`."""

    setting: int
    paint: int
    relief: bool
    vary: int
    coat: bool
    sheen: bool
    mark: bool
    bevel: int
    worn: bool
    """Its edges are rubbed."""
    curved: bool
    ball: bool
    ground: int
    """0: not the ground; 1: ground; 2: ground that mirrors the world."""
    clear: bool
    panels: bool
    lamps: bool
    """Lamps cast shadows."""
    gobo: bool
    """A slide is before the key light."""
    mirror: bool
    """It reflects the picture itself."""
    coloured: bool
    """Its corners have colours of their own."""
    thin: int
    """Light comes through it, so many hundredths."""
    simple: bool
    """It omits relief, contact shadows and fine glints, as mirror images do."""
    hazed: bool
    """Air hides what of it is far."""
    metal: bool = False
    """It mirrors what stands and moves around metal."""
    from_metal: bool = False
    """It is drawn as metal sees it, with its distance."""


def features(
    batch: Batch,
    setting: int,
    *,
    reflecting: bool,
    simple: bool,
    mirror: bool,
    paint: int,
    panels: bool,
    lamps: bool,
    gobo: bool,
    coloured: bool,
    hazed: bool,
    around_metal: bool = False,
    from_metal: bool = False,
) -> Features:
    """The features that a batch needs."""
    look, kind = batch.finish.look, batch.shape[0]
    bevel = {"box": 1, "cylinder": 2}.get(kind, 0) if look.clear == 0 and not simple else 0
    ground = (2 if reflecting else 1) if kind == "disc" else 0
    return Features(
        setting=setting,
        paint=paint,
        relief=look.relief_m > 0 and paint in (1, 2) and not simple,
        vary=0 if look.vary <= 0 else 2 if look.vary >= VARIED_GROUND and not simple else 1,
        coat=look.coat > 0 and not (batch.clear and look.clear == 0),
        sheen=look.sheen > 0 and not simple,
        mark=look.mark and kind == "sphere",
        bevel=bevel,
        worn=bool(bevel) and look.worn_m > 0 and paint == 1,
        curved=kind not in ("box", "plane", "disc"),
        ball=kind == "sphere",
        ground=ground,
        clear=batch.clear,
        panels=panels,
        lamps=lamps,
        gobo=gobo,
        mirror=mirror,
        coloured=coloured,
        thin=round(100 * look.thin),
        simple=simple,
        hazed=hazed,
        metal=around_metal and not simple and metal(batch),
        from_metal=from_metal,
    )


def glossy(batch: Batch) -> bool:
    """Whether mirror images of neighbours show on the things of a batch."""
    look = batch.finish.look
    polished = look.roughness < 0.3 and (look.metallic > 0.5 or look.coat >= 0.4)
    return polished and not batch.clear and batch.shape[0] != "disc"


def metal(batch: Batch) -> bool:
    """Whether a batch is of bare metal that shows what is around it, sharp or soft."""
    look = batch.finish.look
    return look.metallic > 0.5 and look.roughness < 0.5 and not batch.clear and batch.shape[0] != "disc"


class Variants:
    """Programs by their features."""

    def __init__(self) -> None:
        self._programs: dict[Features, gl.Program] = {}

    def get(self, wanted: Features) -> gl.Program:
        """The program with these features, compiled on first use."""
        if wanted not in self._programs:
            defines = {name.upper(): int(getattr(wanted, name)) for name in wanted.__dataclass_fields__}
            self._programs[wanted] = gl.Program("thing.vert", "surface.frag", FULL=1, **defines)
        return self._programs[wanted]
