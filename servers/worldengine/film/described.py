"""Read a film's description, which its author's process left, with distrust, and refuse what no film may do."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.errors import ProgramError
from worldkit.film_files import ARRAYS, DESCRIPTION
from worldkit.filming import film_bounds as bounds
from worldkit.filming.drawn_only import SHAPES
from worldkit.scene import GROUND

from . import blanked, gobos, ground_skins, lettering, puffs, skin_reach, stand_ins, swaying, time_map, wisps
from .treatment import Treatments

if TYPE_CHECKING:
    import numpy as np

    from ..recording.stored import Recording

PLACE = "film.py"
MOST_THINGS, MOST_CAPTIONS, MOST_SURFACES = 500, 500, 20
MOST_VERTICES = 3_000_000
CAMERA: dict[str, tuple[int, ...]] = {
    "eye": (3,), "target": (3,), "roll_deg": (), "fovy_deg": (), "focus_m": (), "aperture": (), "time": (),
}  # fmt: skip
"""Arrays with one row per frame, and the shape of a row."""


class FilmError(ProgramError):
    """The film asks for what cannot, or may not, be shown."""

    code = "film"


def _refuse(cause: str, remedy: str = "say it through worldkit.filming") -> FilmError:
    return FilmError(cause, PLACE, remedy)


@dataclass(frozen=True)
class Described:
    """One film, checked against the recording that it shows."""

    shots: tuple[dict[str, Any], ...]
    """`first` frame, number of `frames`, and the plan's camera that is meant (`planned`), if it is one."""
    captions: tuple[dict[str, Any], ...]
    treatments: Treatments
    things: tuple[dict[str, Any], ...]
    surfaces: tuple[dict[str, Any], ...]
    """One substance each: its `name`, the bodies and particles that it is `of`, and its `look`."""
    lamps: tuple[dict[str, Any], ...]
    panels: tuple[dict[str, Any], ...]
    looks: dict[str, Any]
    shutter: float
    samples: int
    arrays: "dict[str, np.ndarray]"
    breeze: tuple[float, float] | None = None
    """The wind that moves what sways, towards x and y, m/s."""
    puffs: tuple[dict[str, Any], ...] = ()
    clouds: tuple[wisps.Cloud, ...] = ()
    """What shows the points of a law, simulated as they are."""
    labels: tuple[str, ...] = ()
    """Words on things that stand in the world."""

    @property
    def frames(self) -> int:
        """The number of frames in the film."""
        return len(self.arrays["time"])

    def shot(self, frame: int) -> int:
        """Number of the shot that a frame belongs to."""
        return max(n for n, shot in enumerate(self.shots) if shot["first"] <= frame)

    def speed(self, frame: int, fps: float) -> float:
        """Recorded seconds in a second of film around a frame, by the shown times themselves."""
        shot = self.shots[self.shot(frame)]
        first, last = shot["first"], shot["first"] + shot["frames"] - 1
        low, high = max(frame - 1, first), min(frame + 1, last)
        time = self.arrays["time"]
        return float(time[high] - time[low]) * fps / max(high - low, 1)

    def drawn_only(self) -> list[str]:
        """Say what is drawn and not simulated, for the statement and the report."""
        said, figures = [], {thing["of"]: thing.get("like", "") for thing in self.things if thing.get("of")}
        for thing in self.things:
            if thing.get("of"):
                if (like := figures.pop(thing["of"], None)) is not None:
                    said.append(thing["of"] + f" ({like})" * bool(like))
            elif thing.get("ways"):
                copies = self.arrays[thing["ways"]].shape[1]
                said.append(f"{thing['name']} ({copies} particles{' of ' * ('like' in thing)}{thing.get('like', '')})")
            elif thing["instead"]:
                away = thing.get("off_m")
                off = "" if away is None else f", up to {away:.2g} m off its surface"
                off = ", within 1 mm of its surface" if away is not None and away < 1e-3 else off
                said.append(f"{thing['name']} (skin over {thing['to']}{off}{thing.get('reach', '')})")
            else:
                about = [f"on {thing['to']}" * bool(thing["to"]), thing.get("like", "")]
                said.append(thing["name"] + (f" ({', '.join(filter(None, about))})" if any(about) else ""))
        said += [stand_ins.covered(one, self.things) for one in self.surfaces]
        said += [f"{one['name']} ({', '.join(filter(None, ('puffs', one.get('like'))))})" for one in self.puffs]
        said += [cloud.said() for cloud in self.clouds]
        balls = {(thing["name"], thing["to"], *thing["pos"]) for thing in self.things if thing["shape"] == "sphere"}
        said += [f"{one['name']} (a lamp)" for one in self.lamps if (one["name"], one["to"], *one["pos"]) not in balls]
        said += [f"{panel['name']} (a panel of light)" for panel in self.panels]
        if gobo := (treated := self.treatments.at(0.0)).light_gobo:
            said.append(f"shadow of {gobo.kind} (a pattern before the light)")
        if otherwise := self.treatments.departs():
            said.append(f"light otherwise than the world states: {', '.join(otherwise)}")
        if self.breeze is not None and any(thing.get("sways") for thing in self.things):
            said.append("breeze (moves what is drawn only)")
        said += ["sky"] if treated.sky_zenith is not None else []
        return said + (["fog"] if treated.fog_rgb is not None else [])

    def told(self, fps: float) -> dict[str, Any]:
        """The film's entry in the statement: what is only drawn, its own looks, its shots and time map, its author's words."""
        looks = {name: look if isinstance(look, str) else "a surface of its own" for name, look in self.looks.items()}
        faint = [name for name in looks if opacity(self.looks[name]) < bounds.SEEN]
        looks |= {name: f"{looks[name]}, nearly clear" for name in faint}
        return {
            "drawn_only": [*self.drawn_only(), *blanked.told(self.treatments, self.frames, fps)],
            "looks": looks,
            "shots": time_map.shots(self, fps),
            "time_map": time_map.paces(self, fps),
            "captions": [*(c["text"] for c in self.captions), *self.labels],
        }


def read(folder: Path, recording: "Recording", stated: dict[str, Any] | None = None) -> Described:
    """Read the description in a folder for a recording; `stated` is the light that its world states (`worldkit.lights.of`).

    Raises:
        FilmError: it is damaged or too large, or asks for what no film may do: there are no words to move, hide or recolour a
            body in the course of time, and names that the world lacks are refused.
    """
    import numpy as np

    try:
        told = json.loads((folder / DESCRIPTION).read_bytes())
        with np.load(folder / ARRAYS, allow_pickle=False) as found:
            arrays = {name: np.asarray(found[name]) for name in found.files}
        return _checked(told, arrays, recording, stated)
    except (OSError, ValueError, LookupError, TypeError, AttributeError, ArithmeticError, RecursionError) as cause:
        raise _refuse(f"the film's description is damaged: {type(cause).__name__}: {cause}") from cause


def _checked(
    told: dict[str, Any], arrays: "dict[str, np.ndarray]", recording: "Recording", stated: dict[str, Any] | None
) -> Described:
    import numpy as np

    n = len(arrays["time"])
    if not 1 <= n <= bounds.MOST_FRAMES:
        raise _refuse(f"a film has 1 to {bounds.MOST_FRAMES} frames, not {n}")
    for name, shape in CAMERA.items():
        value = arrays[name] = np.asarray(arrays[name], dtype=float)
        if value.shape != (n, *shape) or not np.isfinite(value).all() or np.abs(value).max() > bounds.FAR_M:
            raise _refuse(f"{name} must be {(n, *shape)} finite numbers, is {value.shape}")
    last = float(recording.time[-1] - recording.time[0])
    if arrays["time"].min() < -1e-9 or arrays["time"].max() > last + 1e-9:
        raise _refuse(f"the film shows moments outside the recording's {last:.4g} s")
    if arrays["fovy_deg"].min() < 1 or arrays["fovy_deg"].max() > 120:
        raise _refuse("a lens sees 1 to 120 degrees")
    cameras = set(map(str, recording.meta.get("cameras", ())))
    shots, at = [], 0
    for shot in told["shots"]:
        first, count, planned = int(shot["first"]), int(shot["frames"]), str(shot["planned"])
        if first != at or count < 1 or (planned and planned not in cameras):
            raise _refuse(f"the shot at frame {first} does not follow the one before, or names no camera of the plan")
        shots.append({"first": first, "frames": count, "planned": planned})
        at += count
    if at != n:
        raise _refuse(f"the shots have {at} frames, the film {n}")
    captions = tuple(_caption(one) for one in told["captions"][: MOST_CAPTIONS + 1])
    if len(captions) > MOST_CAPTIONS or len(told["things"]) > MOST_THINGS:
        raise _refuse(f"a film has at most {MOST_CAPTIONS} captions and draws at most {MOST_THINGS} things")
    bodies = set(recording.names)
    things = tuple(_thing(one, arrays, bodies, n) for one in told["things"])
    particles = {thing["name"] for thing in things if thing.get("ways") and thing["shape"] == "sphere"}
    surfaces = tuple(_surface(one, arrays, bodies | particles) for one in told.get("surfaces", ()))
    things = stand_ins.told(things, arrays, recording, surfaces)
    things = tuple(thing | ground_skins.off(thing, arrays, recording) for thing in things)
    things = tuple(thing | skin_reach.told(thing, arrays, recording) for thing in things)
    if (
        len({one["name"] for one in (*things, *surfaces)}) < len(things) + len(surfaces)
        or len(surfaces) > MOST_SURFACES
    ):
        raise _refuse(
            f"two of the things that are drawn have the same name, or there are over {MOST_SURFACES} surfaces"
        )
    lamps = tuple(_lamp(one, bodies) for one in told.get("lamps", ()))
    if len(lamps) > bounds.MOST_LAMPS:
        raise _refuse(f"a film has at most {bounds.MOST_LAMPS} lamps, not {len(lamps)}", "let one stand for many")
    panels = tuple(_panel(one, bodies) for one in told.get("panels", ()))
    if len(panels) > bounds.MOST_PANELS:
        raise _refuse(f"a film has at most {bounds.MOST_PANELS} panels, not {len(panels)}", "let one stand for many")
    geoms = {str(geom["name"]) for geom in recording.meta["geoms"] if geom["name"]}
    looks = {str(name): _look(look, arrays) for name, look in told["looks"].items()}
    for name in looks:
        if name not in bodies | geoms | {str(flex["name"]) for flex in recording.meta.get("flexes") or ()}:
            raise _refuse(
                f"a look is given to {name!r}, which is no body and no geom of the world", "name one that it has"
            )
    if told.get("ground") is not None and GROUND in geoms:
        looks.setdefault(GROUND, _look(told["ground"], arrays))
    share, samples = float(told["shutter"]), int(told["samples"])
    if not (0 <= share <= 1 and 1 <= samples <= 32):
        raise _refuse("a shutter is open for 0 to 1 of a frame, in 1 to 32 samples")
    air = [_air(one) for one in told["air"]]
    return Described(
        tuple(shots), captions, Treatments(air, stated, gobos.told(told)), things, surfaces, lamps, panels, looks, share, samples,
        arrays, swaying.told(told), stand_ins.of_puffs(puffs.check(told, arrays, n), arrays, recording),
        wisps.read(told, arrays, recording, [body for one in surfaces for body in one["of"]]), lettering.labels(told),
    )  # fmt: skip


def _surface(told: dict[str, Any], arrays: "dict[str, np.ndarray]", known: set[str]) -> dict[str, Any]:
    name, of = str(told["name"]), [str(one) for one in told["of"]]
    if not 0 < len(name) <= 60 or not of or not set(of) <= known:
        raise _refuse(f"the surface {name!r} is of what is no body and no particles", "name some that there are")
    if not 1.0 <= (smooth := float(told.get("smooth", 1.0))) <= bounds.SMOOTHEST:
        raise _refuse(f"the surface {name!r} is {smooth:g} smooth, not 1 to {bounds.SMOOTHEST:g}")
    look, blended = _look(told["look"], arrays), told.get("blended") is True
    return {"name": name, "of": of, "look": look, "blended": blended, "smooth": smooth}


def _lamp(told: dict[str, Any], bodies: set[str]) -> dict[str, Any]:
    import numpy as np

    found: dict[str, Any] = {"name": str(told["name"]), "to": str(told["to"])}
    for key, length in (("pos", 3), ("aim", 3), ("rgb", 3), ("strength", 0), ("cone_deg", 0)):
        value = None if told[key] is None else np.asarray(told[key], dtype=float)
        if value is None and key == "aim":
            found["aim"] = None
            continue
        if value is None or value.shape != ((length,) if length else ()) or not np.isfinite(value).all():
            raise _refuse(f"the lamp {found['name']!r} has no {key}")
        found[key] = value.tolist()
    good = 0 < found["strength"] <= 1000 and 1 <= found["cone_deg"] <= 89
    if not (min(found["rgb"]) >= 0 and max(found["rgb"]) <= 1):
        raise _refuse(f"the lamp {found['name']!r} has a colour of {found['rgb']}", "give it three numbers from 0 to 1")
    if not good or np.abs(found["pos"]).max() > bounds.FAR_M or (found["to"] and found["to"] not in bodies):
        raise _refuse(f"the lamp {found['name']!r} is none that can be lit, or is fixed to no body")
    return found


def _panel(told: dict[str, Any], bodies: set[str]) -> dict[str, Any]:
    import numpy as np

    name, to = str(told["name"]), str(told["to"])
    found: dict[str, Any] = {"name": name, "to": to, "seen": bool(told["seen"]), "strength": float(told["strength"])}
    for key, length in (("pos", 3), ("towards", 3), ("size", 2), ("rgb", 3)):
        value = np.asarray(told[key], dtype=float)
        if value.shape != (length,) or not np.isfinite(value).all() or np.abs(value).max() > bounds.FAR_M:
            raise _refuse(f"the panel {name!r} has no {key}")
        found[key] = value.tolist()
    good = 0 < found["strength"] <= 1000 and min(found["rgb"]) >= 0 and max(found["rgb"]) <= 1
    good &= bounds.PANEL_M[0] <= min(found["size"]) and max(found["size"]) <= bounds.PANEL_M[1] and 0 < len(name) <= 60
    good &= float(np.linalg.norm(np.subtract(found["towards"], found["pos"]))) > 1e-6
    if not good or (to and to not in bodies):
        raise _refuse(f"the panel {name!r} is none that can be lit, or is fixed to no body")
    return found


def _caption(told: dict[str, Any]) -> dict[str, Any]:
    text, place = str(told["text"]), str(told["place"])
    if place not in bounds.PLACES or not 0 < len(text) <= 200:
        raise _refuse(f"no caption can be put at {place!r}")
    begin, end = float(told["start_s"]), float(told["end_s"])
    if not 0 <= begin <= end <= 2 * bounds.FAR_M:
        raise _refuse(f"the caption {text!r} stands from {begin} s to {end} s of the film")
    return {"text": text, "place": place, "start_s": begin, "end_s": end}


def _air(told: dict[str, Any]) -> dict[str, Any]:
    import numpy as np

    found: dict[str, Any] = {"at_s": float(told["at_s"])}
    if not 0 <= found["at_s"] <= bounds.FAR_M:
        raise _refuse(f"nothing of the light is told for {found['at_s']} s of the film")
    for name, value in told.items():
        if name == "at_s":
            continue
        if name not in bounds.LIGHT:
            raise _refuse(f"nothing of the light is called {name!r}")
        low, high = bounds.LIGHT[name]
        numbers = np.asarray(value, dtype=float)
        wanted = (3,) if name in bounds.COLOURS else ()
        if numbers.shape != wanted or not ((numbers >= low) & (numbers <= high)).all():
            said = name.replace("_", " ", 1)
            raise _refuse(f"{said} must lie between {low} and {high}, got {value}", "give it such a number")
        found[name] = tuple(numbers.tolist()) if wanted else float(numbers)
    return found


def _look(told: Any, arrays: "dict[str, np.ndarray]") -> Any:
    """A look of the library by name, or a surface's numbers."""
    import numpy as np

    from worldkit.materials import look

    if isinstance(told, str):
        try:
            look(told)
        except ValueError as unknown:
            raise _refuse(str(unknown), "name one of them, '#rrggbb', or make a Surface") from None
        return told
    found: dict[str, Any] = {name: float(told[name]) for name in ("roughness", "metallic", "glow", "opacity", "tile_m")}
    found["rgb"] = tuple(float(v) for v in told["rgb"])
    if len(found["rgb"]) != 3 or not found["tile_m"] > 0 or not 0 <= found["glow"] <= 50:
        raise _refuse("a surface has a colour of three numbers, a tile above 0 m, and a glow of at most 50")
    if "picture" in told:
        pixels = arrays[str(told["picture"])]
        if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] != 3 or max(pixels.shape) > 4096:
            raise _refuse("a painted picture is uint8 (height, width, 3), at most 4096 a side")
        found["picture"] = str(told["picture"])
    return found


def opacity(look: Any) -> float:
    """How opaque a look of a film is, 0 to 1."""
    from worldkit.materials import look as known

    return float(known(look).rgba[3] if isinstance(look, str) else look["opacity"])


def _sways(name: str, look: Any, points: "np.ndarray", weight: "np.ndarray") -> None:
    """Refuse what sways further than it is large, under a picture, or see-through: both drawings agree on neither."""
    from worldkit.materials import look as known

    if (weight < 0).any() or weight.max() > min(10.0, float((points.max(axis=0) - points.min(axis=0)).max())):
        raise _refuse(f"{name!r} sways further than it is large, or by over 10 m", "give it smaller sways")
    if "picture" in look or (known(look).clear > 0 if isinstance(look, str) else look["opacity"] < 0.997):
        raise _refuse(f"{name!r} sways under a picture, or is see-through", "give it a plain, opaque look")


def _thing(told: dict[str, Any], arrays: "dict[str, np.ndarray]", bodies: set[str], frames: int) -> dict[str, Any]:
    import numpy as np

    name, shape, to = str(told["name"]), str(told["shape"]), str(told["to"])
    if not 0 < len(name) <= 60 or shape not in SHAPES:
        raise _refuse(f"{name!r} is drawn in no shape that there is", f"use one of: {', '.join(SHAPES)}")
    if to and to not in bodies:
        raise _refuse(
            f"{name!r} is fixed to {to!r}, which is no body", f"name one of: {', '.join(sorted(bodies)[:10])}"
        )
    found: dict[str, Any] = {
        "name": name,
        "shape": shape,
        "to": to,
        "instead": bool(told["instead"] and to and shape == "mesh" and "ways" not in told),
    }
    for key, length in (("size", 3), ("pos", 3), ("quat", 4)):
        numbers = [float(v) for v in told[key]]
        if len(numbers) != length or not np.isfinite(numbers).all() or max(map(abs, numbers)) > bounds.FAR_M:
            raise _refuse(f"the {key} of {name!r} must be {length} numbers")
        found[key] = numbers
    if min(found["size"]) <= 0 or abs(float(np.linalg.norm(found["quat"])) - 1) > 1e-3:
        raise _refuse(f"{name!r} has no size, or its quaternion is none")
    found["look"] = _look(told["look"], arrays)
    if shape == "mesh":
        points, faces = arrays[str(told["vertices"])], arrays[str(told["faces"])]
        good = points.ndim == 2 and points.shape[1] == 3 and 3 < len(points) <= MOST_VERTICES and faces.ndim == 2
        if (
            not good
            or faces.shape[1] != 3
            or not np.isfinite(points).all()
            or faces.min() < 0
            or faces.max() >= len(points)
        ):
            raise _refuse(f"{name!r} is no mesh of at least four points and their triangles")
        found |= {"vertices": str(told["vertices"]), "faces": str(told["faces"]), "grows": bool(told.get("grows"))}
        if "uv" in told:
            found["uv"] = str(told["uv"])
            if arrays[found["uv"]].shape != (len(points), 2) or not np.isfinite(arrays[found["uv"]]).all():
                raise _refuse(f"{name!r} has not one uv for each vertex")
            found["sways"] = bool(told.get("sways")) and not found["instead"]
            if found["sways"]:
                _sways(name, found["look"], points * found["size"], arrays[found["uv"]][:, 0])
    if "ways" in told:
        ways, sizes = arrays[str(told["ways"])], arrays[str(told["sizes"])]
        good = (
            ways.ndim == 3
            and ways.shape[0] == frames
            and ways.shape[2] == 3
            and 1 <= ways.shape[1] <= bounds.MOST_COPIES
        )
        if not good or shape != ("mesh" if "turns" in told else "sphere") or not np.isfinite(ways).all():
            raise _refuse(f"{name!r} has no place in each of the {frames} frames")
        if sizes.shape != ways.shape[:2] or not ((sizes >= 0) & (sizes <= bounds.FAR_M)).all():
            raise _refuse(f"{name!r} has not a size of 0 to {bounds.FAR_M:g} m for each of its particles in each frame")
        found |= {"ways": str(told["ways"]), "sizes": str(told["sizes"])}
        if "turns" in told:
            found["turns"] = str(told["turns"])
            turns = arrays[found["turns"]]
            found |= {"of": str(told["of"])[:60]} if told.get("of") else {}
            if turns.shape != (*ways.shape[:2], 4) or not (np.abs(np.linalg.norm(turns, axis=2) - 1) < 1e-3).all():
                raise _refuse(f"{name!r} is not turned by a quaternion for each of its particles in each frame")
    return found
