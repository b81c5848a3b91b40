"""Add to the world what a film shows: drawn things, looks, skins and a camera, none of which has mass or touches anything.

The bodies, joints and coordinates are the recorded world's own, so its recording is replayed on it as it is.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit import materials, portable
from worldkit.lights import LIGHT_GAIN

from ..recording.replay import Replay
from ..recording.seen import UNSET_RGBA
from . import one_surface, panel_lights, sward_normals, swaying, unseen
from .described import Described, FilmError

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..recording.stored import Recording

CAMERA = "film camera"
DRAWN = {"contype": 0, "conaffinity": 0, "mass": 0.0, "group": 2}
HIDDEN_GROUP = 5
BY_BODY = ("geom", "cam")
"""Arrays that lie in the order of the bodies, so that additions shift them."""


def dress(world: Path, film: Described) -> "mujoco.MjModel":
    """The model that the film shows.

    Raises:
        FilmError: a skin does not have the size of its body, a body that can move is made unseen, or something cannot be added to the picture.
    """
    import numpy as np

    spec = portable.spec(world)
    before = unseen.seen(spec)
    for name, look in film.looks.items():
        _relook(spec, name, _material(spec, film, look, f"drawn.look {name}"))
    for thing in film.things:
        _add(spec, film, thing)
    for one in film.surfaces:
        _cover(spec, film, one)
    for cloud in film.clouds:
        for geom in spec.body(cloud.of).geoms:
            geom.group = HIDDEN_GROUP
    unseen.refuse(spec, film, before)
    for lamp in film.lamps:
        _light(spec, lamp)
    swaying.add(spec, [f"drawn.{thing['name']}" for thing in film.things if thing.get("sways") and film.breeze])
    panel_lights.hang(spec, film.panels, HIDDEN_GROUP, **DRAWN)
    eyes = film.arrays["eye"]
    spec.worldbody.add_camera(name=CAMERA, pos=eyes[0])
    for name, corner in (("low", eyes.min(axis=0)), ("high", eyes.max(axis=0))):  # a room surrounds all cameras
        spec.worldbody.add_camera(name=f"{CAMERA} {name}", pos=np.asarray(corner))
    try:
        model = spec.compile()
    except ValueError as cause:
        raise FilmError(
            f"what the film draws cannot be drawn: {cause}", "film.py", "give it a plainer shape"
        ) from cause
    panel_lights.keep(model, film.panels)
    return model


def _material(spec: "mujoco.MjSpec", film: Described, look: Any, name: str) -> str:
    """The name of the material of a look, which is made if it does not exist yet."""
    import mujoco
    import numpy as np

    if isinstance(look, str):
        return materials.add(spec, look)
    material = spec.add_material(
        name=name, rgba=(*look["rgb"], look["opacity"]), roughness=look["roughness"], metallic=look["metallic"],
        emission=look["glow"], specular=0.3, shininess=(1 - look["roughness"]) ** 2,
    )  # fmt: skip
    if "picture" in look:
        pixels = np.ascontiguousarray(film.arrays[look["picture"]])
        texture = spec.add_texture(
            name=name, type=mujoco.mjtTexture.mjTEXTURE_2D, width=pixels.shape[1], height=pixels.shape[0], nchannel=3
        )
        texture.data = pixels.tobytes()
        material.texuniform = True
        material.texrepeat = (1.0 / look["tile_m"], 1.0 / look["tile_m"])
        roles = [""] * int(mujoco.mjtTextureRole.mjNTEXROLE)
        roles[int(mujoco.mjtTextureRole.mjTEXROLE_RGB)] = name
        material.textures = roles
    return name


def _relook(spec: "mujoco.MjSpec", name: str, material: str) -> None:
    """Give a body's visible shapes, one geom, or a soft thing another material."""
    if (soft := spec.flex(name)) is not None:
        soft.material, soft.rgba = material, UNSET_RGBA
        return
    body = spec.body(name)
    geoms = [geom for geom in body.geoms if geom.group <= 2] if body is not None else [spec.geom(name)]
    for geom in geoms:
        geom.material, geom.rgba = material, UNSET_RGBA


def _add(spec: "mujoco.MjSpec", film: Described, thing: dict[str, Any]) -> None:
    import mujoco
    import numpy as np

    name = f"drawn.{thing['name']}"
    body = spec.body(thing["to"]) if thing["to"] else spec.worldbody
    material = _material(spec, film, thing["look"], name)
    common: dict[str, Any] = {**DRAWN, "material": material}
    if thing.get("ways") and thing["shape"] == "sphere":
        places, sizes = film.arrays[thing["ways"]], film.arrays[thing["sizes"]]
        for number, place in enumerate(places[0]):
            body.add_geom(
                name=f"{name}/{number}", type=mujoco.mjtGeom.mjGEOM_SPHERE, pos=place.astype(float),
                size=(max(float(sizes[:, number].max()) / 2, 1e-6), 0, 0), **common,
            )  # fmt: skip
        return
    half = np.array(thing["size"]) / 2
    common |= {"name": name, "pos": thing["pos"], "quat": thing["quat"]}
    kinds = mujoco.mjtGeom
    if thing["shape"] == "mesh":
        points = film.arrays[thing["vertices"]].astype(float) * np.array(thing["size"])
        mesh = spec.add_mesh(
            name=name, uservert=points.ravel(), userface=film.arrays[thing["faces"]].astype(np.int32).ravel(),
            inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL,
        )  # fmt: skip
        if thing.get("grows"):
            mesh.usernormal = sward_normals.of(points, film.arrays[thing["faces"]]).ravel()
        if "uv" in thing:
            mesh.usertexcoord = film.arrays[thing["uv"]].astype(float).ravel()
        if thing.get("ways"):
            for number, place in enumerate(film.arrays[thing["ways"]][0]):
                body.add_geom(
                    name=f"{name}/{number}", type=kinds.mjGEOM_MESH, meshname=name, pos=place.astype(float), **DRAWN,
                    material=material,
                )  # fmt: skip
            return
        if thing["instead"]:
            _skin(spec, thing, points)
        body.add_geom(type=kinds.mjGEOM_MESH, meshname=name, **common)
        return
    kind, size = {
        "box": (kinds.mjGEOM_BOX, half),
        "sphere": (kinds.mjGEOM_SPHERE, (half[0], 0, 0)),
        "cylinder": (kinds.mjGEOM_CYLINDER, (half[0], half[2], 0)),
        "capsule": (kinds.mjGEOM_CAPSULE, (half[0], max(half[2] - half[0], 1e-4), 0)),
        "ellipsoid": (kinds.mjGEOM_ELLIPSOID, half),
    }[thing["shape"]]
    body.add_geom(type=kind, size=size, **common)


def _light(spec: "mujoco.MjSpec", lamp: dict[str, Any]) -> None:
    """Hang up a lamp; the renderers make of MuJoCo's numbers what the film means."""
    import mujoco
    import numpy as np

    kinds = mujoco.mjtLightType
    body = spec.body(lamp["to"]) if lamp["to"] else spec.worldbody
    way = np.array([0.0, 0.0, -1.0]) if lamp["aim"] is None else np.array(lamp["aim"]) - np.array(lamp["pos"])
    body.add_light(
        name=f"drawn.{lamp['name']}", pos=lamp["pos"], dir=way / max(float(np.linalg.norm(way)), 1e-9),
        type=kinds.mjLIGHT_POINT if lamp["aim"] is None else kinds.mjLIGHT_SPOT, cutoff=lamp["cone_deg"],
        diffuse=lamp["strength"] * np.array(lamp["rgb"]) ** 2.2 / LIGHT_GAIN, castshadow=False,
    )  # fmt: skip


def _cover(spec: "mujoco.MjSpec", film: Described, one: dict[str, Any]) -> None:
    """Leave out the shapes that a surface stands for, and make room for it: a skin that each picture fills anew."""
    import numpy as np

    count = 0
    for geom in members(spec, one):
        geom.group = HIDDEN_GROUP
        count += 1
    name, faces = f"drawn.{one['name']}", one_surface.room(count * one_surface.SAMPLES)
    vertices = faces // 2 + 2
    skin = spec.add_skin(name=name, material=_material(spec, film, one["look"], name))
    skin.vert, skin.face = [0.0] * (3 * vertices), [0, 1, 2] * faces
    skin.bodyname, skin.bindpos, skin.bindquat = ["world"], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]
    skin.vertid, skin.vertweight = [np.arange(vertices).tolist()], [[1.0] * vertices]


def members(spec: "mujoco.MjSpec", one: dict[str, Any]) -> list[Any]:
    """The shapes that a surface stands for: those of its bodies that can be seen, and its particles."""
    own = [geom for name in one["of"] if (body := spec.body(name)) is not None for geom in body.geoms]
    particles = tuple(f"drawn.{name}/" for name in one["of"])
    grown = [geom for geom in spec.worldbody.geoms if geom.name.startswith(particles)]
    return [geom for geom in own if geom.group <= 2 and not geom.name.startswith("drawn.")] + grown


def surfaces(model: "mujoco.MjModel", film: Described) -> list[one_surface.Surface]:
    """The surfaces of a dressed world, to be laid around their shapes for each picture."""
    import numpy as np

    found = []
    names = [model.geom(geom).name for geom in range(model.ngeom)]
    for one in film.surfaces:
        bodies = {model.body(name).id for name in one["of"] if name in _bodies(model)}
        particles = tuple(f"drawn.{name}/" for name in one["of"])
        mine = [
            geom
            for geom, name in enumerate(names)
            if model.geom_group[geom] == HIDDEN_GROUP
            and (name.startswith(particles) or (model.geom_bodyid[geom] in bodies and not name.startswith("drawn.")))
        ]
        skin, alone = model.skin(f"drawn.{one['name']}").id, one_surface.FLAKE if one["look"] == "snow" else 1.0
        found.append(one_surface.Surface(model, skin, np.array(mine, dtype=int), one["blended"], alone, one["smooth"]))
    return found


def _bodies(model: "mujoco.MjModel") -> set[str]:
    return {model.body(body).name for body in range(model.nbody)}


def _skin(spec: "mujoco.MjSpec", thing: dict[str, Any], points: "np.ndarray") -> None:
    """Leave out the shapes of the body that a skin stands for, if the skin has the body's size."""
    import numpy as np

    from worldkit.filming import skin_fit
    from worldkit.turning import turned

    model = spec.copy().compile()
    body = model.body(thing["to"]).id
    first, count = int(model.body_geomadr[body]), int(model.body_geomnum[body])
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    for geom in range(first, first + count):
        if model.geom_group[geom] <= 2:
            box = model.geom_aabb[geom]
            corners = model.geom_pos[geom] + turned(model.geom_quat[geom][None], box[:3] + signs * box[3:])
            low, high = np.minimum(low, corners.min(axis=0)), np.maximum(high, corners.max(axis=0))
    placed = turned(np.array(thing["quat"])[None], points) + np.array(thing["pos"])
    if cause := skin_fit.misfit(thing["name"], thing["to"], placed, low, high):
        raise FilmError(cause, "film.py", skin_fit.REMEDY)
    for geom in spec.body(thing["to"]).geoms:
        if not geom.name.startswith("drawn."):
            geom.group = HIDDEN_GROUP


class DressedReplay(Replay):
    """Shows a recording on the dressed world: recorded edits reach the right rows, wherever additions shifted them.

    Args:
        model: the dressed world.
        plain: the recorded world itself.
        recording: the recording to show.
    """

    def __init__(self, model: "mujoco.MjModel", plain: "mujoco.MjModel", recording: "Recording") -> None:
        super().__init__(model, recording)
        moved = []
        for row, array, index, value in self._edits:
            kind = array.split("_", 1)[0]
            if kind in BY_BODY:
                width = max(getattr(plain, array)[0].size, 1) if len(getattr(plain, array)) else 1
                owner = int(getattr(plain, f"{kind}_bodyid")[index // width])
                before = int((getattr(plain, f"{kind}_bodyid") < owner).sum())
                after = int((getattr(model, f"{kind}_bodyid") < owner).sum())
                index += (after - before) * width
            moved.append((row, array, index, value))
        self._edits = moved
