"""Light fades in what is clear and coloured by the way that it goes in it, as Beer and Lambert say, in both renderers."""

import mujoco
import numpy as np
import pytest

from worldengine.film.drawn_frames import Frames
from worldengine.film.renderers.preview import mean_chord
from worldengine.film.renderers.traced import absorbed, variant, walked
from worldengine.film.renderers.traced.tracing import Tracing
from worldkit import materials, scene
from worldkit.materials.catalogue import LIBRARY
from worldkit.materials.look import NOTHING

ABSORBS = (1.0, 5.0, 20.0)
THICK_M = 0.1


@pytest.fixture(scope="module")
def mi():
    assert variant.choose() != variant.PLAIN, (
        "paths that fade are walked by a compiled variant: it needs LLVM 17 or newer"
    )
    import mitsuba

    return mitsuba


def slab(mi, index: float, thick: float = THICK_M):
    """A pane between the eye and evenly white surroundings, and its shape."""
    move = mi.ScalarTransform4f().scale([1.0, thick / 2, 1.0])
    pane = {"type": "cube", "to_world": move, "bsdf": {"type": "dielectric", "int_ior": index, "ext_ior": 1.0}}
    found = mi.load_dict({"type": "scene", "around": {"type": "constant"}, "pane": pane})
    return found, found.shapes()[0]


def eye(mi, side: int = 8):
    look = mi.ScalarTransform4f().look_at([0, -3, 0], [0, 0, 0], [0, 0, 1])
    film = {"type": "hdrfilm", "width": side, "height": side, "rfilter": {"type": "box"}, "pixel_format": "rgb"}
    return mi.load_dict({"type": "perspective", "fov": 2.0, "to_world": look, "film": film})


def test_what_absorbs_nothing_is_walked_as_mitsuba_does(mi) -> None:
    world, pane = slab(mi, 1.5)
    mine = walked.light(world, eye(mi), 8, 16, 3, clear=[(pane, NOTHING)])
    assert np.allclose(mine, walked.light(world, eye(mi), 8, 16, 3), rtol=1e-4)  # the two are compiled apart
    where = np.eye(8, dtype=bool)
    some = walked.light(world, eye(mi), 8, 16, 3, where, [(pane, NOTHING)])
    assert np.allclose(some[where], mine[where], rtol=1e-5) and not some[~where].any()


@pytest.mark.parametrize("thick", [0.02, THICK_M])
def test_light_keeps_what_beer_and_lambert_say(mi, thick) -> None:
    world, pane = slab(mi, 1.0001, thick)
    seen = walked.light(world, eye(mi), 8, 4, 0, clear=[(pane, ABSORBS)]).reshape(-1, 3)
    assert seen.mean(axis=0) == pytest.approx(np.exp(-np.array(ABSORBS) * thick), rel=0.01)
    assert np.ptp(seen, axis=0).max() < 1e-3, "it has no noise of its own"


def test_things_within_each_other_absorb_both(mi) -> None:
    """A liquid that reaches into the wall of its glass, as it is modelled."""
    inner = {"type": "cube", "to_world": mi.ScalarTransform4f().scale([0.5, 0.02, 0.5]), "bsdf": {"type": "dielectric", "int_ior": 1.0001, "ext_ior": 1.0}}  # fmt: skip
    outer = {**inner, "to_world": mi.ScalarTransform4f().translate([0, 0.03, 0]).scale([0.5, 0.02, 0.5])}
    world = mi.load_dict(
        {"type": "scene", "around": {"type": "constant"}, "one": inner, "other": outer}, optimize=False
    )
    one, other = world.shapes()
    seen = walked.light(world, eye(mi), 8, 4, 0, clear=[(one, ABSORBS), (other, (0.0, 7.0, 0.0))])
    assert seen.mean(axis=(0, 1))[1] == pytest.approx(np.exp(-(5.0 + 7.0) * 0.04), rel=0.01)


def test_light_that_meets_something_on_its_way_fades_both_ways(mi) -> None:
    """A white sheet in the middle of a pane that shines by itself is seen through half of it."""
    pane = {"type": "cube", "to_world": mi.ScalarTransform4f().scale([1, THICK_M / 2, 1]), "bsdf": {"type": "dielectric", "int_ior": 1.0001, "ext_ior": 1.0}}  # fmt: skip
    turn = mi.ScalarTransform4f().rotate([1, 0, 0], 90)
    sheet = {
        "type": "rectangle",
        "to_world": turn,
        "emitter": {"type": "area", "radiance": {"type": "rgb", "value": 1.0}},
    }
    world = mi.load_dict({"type": "scene", "pane": pane, "sheet": sheet}, optimize=False)
    shape = next(shape for shape in world.shapes() if not shape.is_emitter())
    seen = walked.light(world, eye(mi), 8, 4, 0, clear=[(shape, ABSORBS)]).mean(axis=(0, 1))
    assert seen == pytest.approx(np.exp(-np.array(ABSORBS) * THICK_M / 2), rel=0.01)


def test_light_of_a_lamp_fades_on_its_way_to_what_is_in_the_water(mi) -> None:
    """A white sheet in a block, lit by a small lamp beside it in the same block."""
    turn, wide = (mi.ScalarTransform4f().rotate([1, 0, 0], 90), mi.ScalarTransform4f().scale([2, 0.5, 2]))
    white = {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.8}}
    glow = {"type": "area", "radiance": {"type": "rgb", "value": 500.0}}
    told = {
        "type": "scene",
        "block": {"type": "cube", "to_world": wide, "bsdf": {"type": "dielectric", "int_ior": 1.0001, "ext_ior": 1.0}},
        "sheet": {"type": "rectangle", "to_world": turn, "bsdf": white},
        "lamp": {"type": "sphere", "center": [0, -0.3, 0.3], "radius": 0.01, "emitter": glow},
    }  # fmt: skip
    world = mi.load_dict(told, optimize=False)
    block = next(
        shape
        for shape in world.shapes()
        if "Dielectric" in type(shape.bsdf()).__name__ or "dielectric" in str(shape.bsdf()).lower()
    )
    plain, dyed = (
        walked.light(world, eye(mi), 3, 64, 0, clear=[(block, absorbs)]).mean(axis=(0, 1))
        for absorbs in (NOTHING, (0.0, 2.0, 5.0))
    )
    way = 0.5 + np.hypot(0.3, 0.3)  # from the lamp to the sheet, and from there to the eye's side
    assert dyed / plain == pytest.approx(np.exp(-np.array((0.0, 2.0, 5.0)) * way), rel=0.05)


def behind(mi, *between: dict, lamp: dict | None = None, depth: int = 2):
    """Light of a white wall, seen from beside what stands before it, 1 m from a lamp without a size."""
    wall = {
        "type": "rectangle", "to_world": mi.ScalarTransform4f().translate([0, 1, 0]).rotate([1, 0, 0], 90).scale(2),
        "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.5}},
    }  # fmt: skip
    point = {"type": "point", "position": [0.0, -1.0, 0.0], "intensity": {"type": "rgb", "value": 1.0}}
    told = {"type": "scene", "wall": wall, "lamp": lamp or point}
    world = mi.load_dict(told | {f"thing{number}": one for number, one in enumerate(between)}, optimize=False)
    things = [shape for shape in world.shapes() if absorbed.lets_through(shape.bsdf())]
    look = mi.ScalarTransform4f().look_at([1.5, 0.2, 0], [0, 1, 0], [0, 0, 1])
    film = {"type": "hdrfilm", "width": 8, "height": 8, "rfilter": {"type": "box"}, "pixel_format": "rgb"}
    side = mi.load_dict({"type": "perspective", "fov": 2.0, "to_world": look, "film": film})
    clear = [(shape, ABSORBS if shape.bsdf().id() == "tea" else NOTHING) for shape in things]
    return walked.light(world, side, depth, 16, 0, clear=clear or ()).mean(axis=(0, 1))


def plate(mi, half: float, bsdf: dict, at: float = 0.0):
    """A plate across the way of the light, so thick either way of its middle."""
    return {
        "type": "cube",
        "to_world": mi.ScalarTransform4f().translate([0, at, 0]).scale([0.4, half, 0.4]),
        "bsdf": bsdf,
    }


def dielectric(index: float, name: str = "") -> dict:
    return {"type": "dielectric", "int_ior": index, "ext_ior": 1.0} | ({"id": name} if name else {})


def mirrored(index: float) -> float:
    return ((index - 1) / (index + 1)) ** 2


def lamps(mi) -> dict[str, dict]:
    aim = mi.ScalarTransform4f().look_at([0, -1, 0], [0, 0, 0], [0, 0, 1])
    white = {"type": "rgb", "value": 1.0}
    slide = {"type": "bitmap", "bitmap": mi.Bitmap(np.ones((4, 4, 3), np.float32)), "raw": True}
    return {
        "point": {"type": "point", "position": [0.0, -1.0, 0.0], "intensity": white},
        "spot": {"type": "spot", "to_world": aim, "intensity": white},
        "directional": {"type": "directional", "to_world": aim, "irradiance": white},
        "projector": {"type": "projector", "to_world": aim, "irradiance": slide, "fov": 40.0},
    }  # fmt: skip


@pytest.mark.parametrize("kind", ["point", "spot", "directional", "projector"])
def test_a_light_without_a_size_shines_through_a_pane_less_what_it_mirrors(mi, kind) -> None:
    lamp = lamps(mi)[kind]
    bare, glass, wood = (
        behind(mi, *things, lamp=lamp)
        for things in ((), [plate(mi, 0.01, dielectric(1.5))], [plate(mi, 0.01, {"type": "diffuse"})])
    )
    assert bare.min() > 0.01 and wood.max() < 1e-6 * bare.min(), "what is opaque still throws its shadow"
    assert glass / bare == pytest.approx(np.full(3, (1 - mirrored(1.5)) ** 2), rel=0.02)


def test_what_is_partly_there_lets_through_the_rest(mi) -> None:
    partly = {"type": "mask", "opacity": 0.3, "nested": {"type": "diffuse"}}
    sheet = {"type": "rectangle", "to_world": mi.ScalarTransform4f().rotate([1, 0, 0], 90).scale(0.4), "bsdf": partly}
    assert behind(mi, sheet) / behind(mi) == pytest.approx(np.full(3, 0.7), rel=0.01)


def test_light_fades_in_a_body_on_its_way_to_the_wall(mi) -> None:
    tea = behind(mi, plate(mi, THICK_M / 2, dielectric(1.33, "tea"))) / behind(mi)
    assert tea == pytest.approx((1 - mirrored(1.33)) ** 2 * np.exp(-np.array(ABSORBS) * THICK_M), rel=0.02)


def wedge(mi, path, leaning: float, flat: bool) -> dict:
    """A body of tea, 0.3 m thick, level light leaves the wall by its upright side and goes out of one that is 70 degrees off,
    shaded as if it were `leaning`, degrees."""
    across = [[(0.3, 0.109), (0.3, -0.109)], [(0.3, -0.109), (-0.3, -0.109)], [(-0.3, -0.109), (0.3, 0.109)]]
    turned = np.radians([180, 90 + 180, leaning])  # of their normals from -y, towards up
    points, faces = [], []
    for (one, other), angle in zip(across, turned, strict=True):
        normal = (0, -np.cos(angle), np.sin(angle))
        first = len(points)
        points += [(x, *end, *normal) for end in (one, other) for x in (-0.4, 0.4)]
        faces += [(first, first + 1, first + 3), (first, first + 3, first + 2)]
    for x in (-0.4, 0.4):
        faces.append((len(points), len(points) + 1, len(points) + 2))
        points += [(x, *end, np.sign(x), 0, 0) for end, _ in across]
    head = ["ply", "format ascii 1.0", f"element vertex {len(points)}"]
    head += [f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")]
    head += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    rows = [" ".join(f"{v:.9g}" for v in point) for point in points] + ["3 {} {} {}".format(*face) for face in faces]
    path.write_text("\n".join([*head, *rows]) + "\n")
    return {"type": "ply", "filename": str(path), "face_normals": flat, "bsdf": dielectric(1.33, "tea")}


def test_light_leaves_a_body_by_its_triangles_not_by_how_they_are_shaded(mi, tmp_path) -> None:
    """At the rim of what is shaded as if it were round, a way out looks like a way in; equally slanted, so as much is mirrored."""
    bare = behind(mi)
    flat, round_ = (behind(mi, wedge(mi, tmp_path / f"{flat}.ply", 110, flat)) / bare for flat in (True, False))
    assert flat[0] > 0.4 and round_ == pytest.approx(flat, rel=0.05)


def test_water_in_a_glass_mirrors_only_where_there_is_air(mi) -> None:
    """The water reaches a little into both walls of its glass."""
    walls = [plate(mi, 0.01, dielectric(1.5), at) for at in (-0.1, 0.1)]
    full, empty = behind(mi, *walls, plate(mi, 0.095, dielectric(1.33))), behind(mi, *walls)
    assert full / behind(mi) == pytest.approx(np.full(3, (1 - mirrored(1.5)) ** 2), rel=0.02)
    assert empty / behind(mi) == pytest.approx(np.full(3, (1 - mirrored(1.5)) ** 4), rel=0.02)


def test_what_lies_in_water_is_lit_from_outside(mi) -> None:
    """The wall itself is under water, and is seen through its side."""
    deep = {"type": "cube", "to_world": mi.ScalarTransform4f().translate([0, 1, 0]).scale([3, 0.5, 3]), "bsdf": dielectric(1.33)}  # fmt: skip
    dyed = deep | {"bsdf": dielectric(1.33, "tea")}
    clear, tea = behind(mi, deep, depth=3), behind(mi, dyed, depth=3)
    assert clear.min() > 0.01
    # 0.5 m from the side to the wall, and the way back to the eye, which water makes steeper
    out = np.array([1.5, 0.8]) / np.hypot(1.5, 0.8)
    back = 0.5 / np.sqrt(1 - (out[0] / 1.33) ** 2)
    assert np.log(tea / clear) == pytest.approx(-np.array(ABSORBS) * (0.5 + back), rel=0.03)


@pytest.mark.gl
@pytest.mark.parametrize(("look", "lit"), [("glass_clear", True), ("water_clear", True), ("plaster", False)])
def test_behind_clear_things_of_a_world_its_lamps_light_the_wall(mi, look, lit) -> None:
    def light(things: bool) -> float:
        spec = scene.new("lit", time_step=0.002, setting="dark", floor="paper")
        kind = mujoco.mjtLightType.mjLIGHT_POINT
        spec.worldbody.add_light(name="lamp", type=kind, pos=(0, -0.5, 0.5), diffuse=(9, 9, 9))
        box = mujoco.mjtGeom.mjGEOM_BOX
        if things:
            spec.worldbody.add_geom(
                type=box, size=(0.2, 0.02, 0.2), pos=(0, 0, 0.5), material=materials.add(spec, look)
            )
        paper = materials.add(spec, "plaster")
        spec.worldbody.add_geom(type=box, size=(2, 0.01, 1), pos=(0, 0.51, 0.5), material=paper)
        spec.worldbody.add_camera(name="eye", pos=(0, 0.1, 0.5), xyaxes=(1, 0, 0, 0, 0, 1), fovy=20)
        model = spec.compile()
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        drawing = Tracing(model, 16, 12)
        view, _, drawn, _ = drawing._seen(data, 0)
        return float(drawing.trace(data, view, drawn, 16, 0).light.mean())

    share = light(True) / light(False)
    assert share > 0.6 if lit else share < 0.4, share


def standing(kind: str, look: str):
    """A thing of each kind of shape, clear and 0.12 m thick, before a white wall, seen level."""
    kinds, half = mujoco.mjtGeom, 0.06
    spec = scene.new("standing", time_step=0.002, setting="studio", floor="paper")
    told = {"type": getattr(kinds, f"mjGEOM_{kind.upper()}"), "material": materials.add(spec, look)}
    size = {
        "sphere": (half, 0, 0), "capsule": (half, half, 0), "cylinder": (half, half, 0), "box": (half,) * 3,
        "ellipsoid": (half,) * 3, "plane": (half, half, 1),
    }.get(kind)  # fmt: skip
    if kind == "mesh":
        spec.add_mesh(name="ball", scale=(half,) * 3).make_sphere(4)
        told |= {"meshname": "ball"}
    if kind == "plane":
        told |= {"quat": (np.sqrt(0.5), np.sqrt(0.5), 0, 0)}
    if size:
        told |= {"size": size}
    spec.worldbody.add_geom(pos=(0, 0, 0.1), **told)
    back = materials.add(spec, "plaster")
    spec.worldbody.add_geom(type=kinds.mjGEOM_BOX, size=(2, 0.01, 1), pos=(0, 0.5, 0.5), material=back)
    spec.worldbody.add_camera(name="eye", pos=(0, -1.0, 0.1), xyaxes=(1, 0, 0, 0, 0, 1), fovy=12)
    return spec.compile()


@pytest.mark.gl
@pytest.mark.parametrize("kind", ["sphere", "capsule", "cylinder", "box", "ellipsoid", "mesh", "plane"])
def test_tea_of_every_shape_is_coloured_in_the_preview(kind) -> None:
    tea = middle(standing(kind, "tea"), "preview", "video")
    assert tea[0] > 1.15 * tea[2], tea


def poured(look: str, radius: float = 0.06):
    """A cylinder of a liquid before a white wall, seen level."""
    spec = scene.new("poured", time_step=0.002, setting="studio", floor="paper")
    body = spec.worldbody.add_body(name="liquid", pos=(0, 0, 0.1))
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=(radius, 0.1, 0), material=materials.add(spec, look), mass=1.0
    )
    back = materials.add(spec, "plaster")
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(2, 0.01, 1), pos=(0, 0.5, 0.5), material=back)
    spec.worldbody.add_camera(name="eye", pos=(0, -1.0, 0.1), xyaxes=(1, 0, 0, 0, 0, 1), fovy=12)
    return spec.compile()


def middle(model, renderer: str, quality) -> np.ndarray:
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with Frames(model, 64, 48, renderer) as frames:
        picture = frames.image(data, "eye", quality).astype(float)
        assert frames.renderer == renderer, frames.reason
    return picture[16:32, 26:38].mean(axis=(0, 1))


@pytest.mark.gl
@pytest.mark.parametrize(("renderer", "quality"), [("preview", "video"), ("traced", 8)])
def test_tea_is_red_brown_water_is_clear_thin_tea_is_paler_and_any_colour_can_be_told(renderer, quality) -> None:
    tea, water = (middle(poured(look), renderer, quality) for look in ("tea", "water_clear"))
    thin = middle(poured("tea", 0.02), renderer, quality)
    assert tea[0] > 1.3 * tea[1] > 1.3 * 1.2 * tea[2] and np.ptp(water) < 40
    assert thin[1] > 1.15 * tea[1] and water[1] > thin[1]
    green = middle(poured("clear #3c9a3c 60mm"), renderer, quality)
    assert green[1] > 1.3 * green[0] and green[1] > 1.3 * green[2], "one that the film names by its colour"


def test_two_liquids_of_one_shape_keep_their_own_colours() -> None:
    """Plain looks are drawn together where they may be: not these."""
    spec = scene.new("two", time_step=0.002, setting="studio")
    for place, look in ((-0.1, "tea"), (0.1, "water_clear")):
        body = spec.worldbody.add_body(name=look, pos=(place, 0, 0.1))
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=(0.05, 0.1, 0), material=materials.add(spec, look), mass=1
        )
    spec.worldbody.add_camera(name="eye", pos=(0, -1.0, 0.1), xyaxes=(1, 0, 0, 0, 0, 1), fovy=20)
    from worldengine.film.renderers.preview.things import Things

    assert {batch.finish.look.absorbs for batch in Things(spec.compile()).batches if batch.clear} == {
        materials.look("tea").absorbs, materials.look("water_clear").absorbs,
    }  # fmt: skip


def test_the_mean_chord_of_a_ball_is_that_of_its_radius() -> None:
    spec = mujoco.MjSpec()
    spec.add_mesh(name="ball").make_sphere(4)
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="ball")
    assert mean_chord.radius(spec.compile(), 0) == pytest.approx(1.0, rel=0.02)


def test_every_look_that_absorbs_is_clear_and_no_more_than_ink() -> None:
    for name, entry in LIBRARY.items():
        assert 1.0 < entry.index < 2.5, name
        if entry.absorbs != NOTHING:
            assert entry.clear > 0 and min(entry.absorbs) >= 0 and max(entry.absorbs) < 1000, name
