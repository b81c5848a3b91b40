"""Computed plainly, lamps without a size shine through what is clear as they do where paths are compiled."""

import numpy as np
import pytest

from worldengine.film.renderers.traced import absorbed, variant, walked


@pytest.fixture
def mi():
    """Mitsuba's plain variant, for the time of a test."""
    before = variant.choose()
    import mitsuba

    mitsuba.set_variant(variant.PLAIN)
    yield mitsuba
    mitsuba.set_variant(before)


def glass(mi, index, at=0.0, half=0.01, tint=1.0):
    move = mi.ScalarTransform4f().translate([0, at, 0]).scale([0.4, half, 0.4])
    bsdf = {"type": "dielectric", "int_ior": index, "ext_ior": 1.0}
    return {"type": "cube", "to_world": move, "bsdf": bsdf | {"specular_transmittance": {"type": "rgb", "value": tint}}}


def wall_behind(mi, *between, lamp=None, eye=(1.5, 0.2, 0), depth=2):
    """Light of a white wall 2 m from a lamp, seen from beside what stands between them, or through it."""
    wall = {
        "type": "rectangle", "to_world": mi.ScalarTransform4f().translate([0, 1, 0]).rotate([1, 0, 0], 90).scale(2),
        "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.5}},
    }  # fmt: skip
    point = {"type": "point", "position": [0.0, -1.0, 0.0], "intensity": {"type": "rgb", "value": 1.0}}
    told = {"type": "scene", "wall": wall, "lamp": lamp or point}
    world = mi.load_dict(told | {f"thing{number}": one for number, one in enumerate(between)}, optimize=False)
    clear = [(shape, (0.0, 0.0, 0.0)) for shape in world.shapes() if absorbed.lets_through(shape.bsdf())]
    look = mi.ScalarTransform4f().look_at(list(eye), [0, 1, 0], [0, 0, 1])
    film = {"type": "hdrfilm", "width": 6, "height": 6, "rfilter": {"type": "box"}, "pixel_format": "rgb"}
    side = mi.load_dict({"type": "perspective", "fov": 2.0, "to_world": look, "film": film})
    return walked.light(world, side, depth, 4, 0, clear=clear).mean(axis=(0, 1))


def mirrored(index):
    return ((index - 1) / (index + 1)) ** 2


@pytest.mark.parametrize("kind", ["point", "spot", "directional", "projector"])
def test_a_light_without_a_size_shines_through_a_pane_less_what_it_mirrors(mi, kind):
    aim = mi.ScalarTransform4f().look_at([0, -1, 0], [0, 0, 0], [0, 0, 1])
    white = {"type": "rgb", "value": 1.0}
    slide = {"type": "bitmap", "bitmap": mi.Bitmap(np.ones((4, 4, 3), np.float32)), "raw": True}
    lamp = {
        "point": {"type": "point", "position": [0.0, -1.0, 0.0], "intensity": white},
        "spot": {"type": "spot", "to_world": aim, "intensity": white},
        "directional": {"type": "directional", "to_world": aim, "irradiance": white},
        "projector": {"type": "projector", "to_world": aim, "irradiance": slide, "fov": 40.0},
    }[kind]
    bare, clear = wall_behind(mi, lamp=lamp), wall_behind(mi, glass(mi, 1.5), lamp=lamp)
    assert bare.min() > 0.01
    assert clear / bare == pytest.approx(np.full(3, (1 - mirrored(1.5)) ** 2), rel=0.02)
    wood = glass(mi, 1.5) | {"bsdf": {"type": "diffuse"}}
    assert wall_behind(mi, wood, glass(mi, 1.5, at=0.4), lamp=lamp).max() < 1e-6 * bare.min()


def test_a_tint_and_what_is_partly_there_take_their_share(mi):
    tint = np.array([0.9, 0.5, 0.2])
    dyed = wall_behind(mi, glass(mi, 1.0001, tint=tint.tolist())) / wall_behind(mi)
    assert dyed == pytest.approx(tint**2, rel=0.02)
    partly = {"type": "mask", "opacity": 0.3, "nested": {"type": "diffuse"}}
    sheet = {"type": "rectangle", "to_world": mi.ScalarTransform4f().rotate([1, 0, 0], 90).scale(0.4), "bsdf": partly}
    assert wall_behind(mi, sheet) / wall_behind(mi) == pytest.approx(np.full(3, 0.7), rel=0.02)


def test_water_in_a_glass_mirrors_only_where_there_is_air(mi):
    walls = [glass(mi, 1.5, at) for at in (-0.1, 0.1)]
    full = wall_behind(mi, *walls, glass(mi, 1.33, half=0.095))
    assert full / wall_behind(mi) == pytest.approx(np.full(3, (1 - mirrored(1.5)) ** 2), rel=0.02)


def test_what_is_seen_through_clear_sides_is_lit_through_them(mi):
    """From beside the lamp, so both the eye and the lamp look through the pane."""
    bare = wall_behind(mi, eye=(0.1, -0.9, 0))
    seen = wall_behind(mi, glass(mi, 1.5), eye=(0.1, -0.9, 0), depth=4)
    assert seen / bare == pytest.approx(np.full(3, (1 - mirrored(1.5)) ** 4), rel=0.03)


def test_nothing_is_added_where_nothing_clear_is_between(mi):
    beside = wall_behind(mi, glass(mi, 1.5, at=0.9), lamp=None, eye=(1.5, -0.5, 0))
    away = wall_behind(mi, glass(mi, 1.5, at=-1.5))
    assert away == pytest.approx(wall_behind(mi), rel=1e-6) and beside.min() > 0


@pytest.mark.parametrize("index", [1.33, 1.5])
def test_the_compiled_variant_says_the_same(mi, index):
    plain = wall_behind(mi, glass(mi, index, half=0.1)) / wall_behind(mi)
    mi.set_variant(variant.choose())
    assert variant.choose() != variant.PLAIN
    assert plain == pytest.approx(wall_behind(mi, glass(mi, index, half=0.1)) / wall_behind(mi), rel=0.01)
