"""Light crosses from glass into the water that it holds as if they touched, and is guided by what is seen behind them."""

import numpy as np
import pytest

from worldengine.film.renderers.traced import interfaces, variant, walked
from worldkit.materials.look import NOTHING

WATER, GLASS = 1.333, 1.5


@pytest.fixture(scope="module")
def mi():
    assert variant.choose() != variant.PLAIN, "it needs LLVM 17 or newer"
    import mitsuba

    return mitsuba


def block(mi, index: float, low: float, high: float) -> dict:
    """A clear block from `low` to `high` along y, wide across."""
    move = mi.ScalarTransform4f().translate([0, (low + high) / 2, 0]).scale([3, (high - low) / 2, 3])
    return {"type": "cube", "to_world": move, "bsdf": {"type": "dielectric", "int_ior": index, "ext_ior": 1.0}}


def sheet(mi, at: float, rgb: tuple[float, float, float], beside: float = 0.0) -> dict:
    """A sheet across y that faces the eye, shining where it is `white`."""
    move = mi.ScalarTransform4f().translate([beside, at, 0]).rotate([1, 0, 0], 90).scale([2, 2, 1])
    glow = {"type": "area", "radiance": {"type": "rgb", "value": 1.0}}
    return {
        "type": "rectangle", "to_world": move, "emitter": glow,
        "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": list(rgb)}},
    }  # fmt: skip


def eye(mi, start=(0.0, -3.0, 0.0), channels: str = "rgb", fov: float = 2.0, side: int = 8):
    look = mi.ScalarTransform4f().look_at(list(start), [0, 0, 0], [0, 0, 1])
    film = {"type": "hdrfilm", "width": side, "height": side, "rfilter": {"type": "box"}, "pixel_format": channels}
    return mi.load_dict({"type": "perspective", "fov": fov, "to_world": look, "film": film})


def world(mi, *parts: dict):
    found = mi.load_dict({"type": "scene"} | {f"part{k}": part for k, part in enumerate(parts)}, optimize=False)
    clear = [
        (shape, NOTHING)
        for shape in found.shapes()
        if mi.has_flag(shape.bsdf().flags(), mi.BSDFFlags.DeltaTransmission)
    ]
    return found, clear


def mirrored(one: float, other: float) -> float:
    return ((one - other) / (one + other)) ** 2


def test_water_that_reaches_into_its_glass_touches_it(mi) -> None:
    """A sheet that shines under water is seen through the wall: dimmed by air to glass and glass to water, spread by the water."""
    black = (0.0, 0.0, 0.0)
    scene, clear = world(mi, block(mi, GLASS, 0.0, 0.1), block(mi, WATER, 0.098, 1.0), sheet(mi, 0.5, black))
    seen = walked.light(scene, eye(mi), 12, 4096, 0, clear=clear).mean()
    through = (1 - mirrored(1, GLASS)) * (1 - mirrored(GLASS, WATER)) / WATER**2
    assert seen == pytest.approx(through, rel=5e-3)


def test_drops_in_the_water_that_they_are_made_of_are_not_there(mi) -> None:
    """They would be lenses, which turn what is behind them upside down."""
    ball = {"type": "sphere", "center": [0, 0.3, 0], "radius": 0.25, "bsdf": block(mi, WATER, 0, 1)["bsdf"]}
    parts = block(mi, WATER, 0.0, 1.5), sheet(mi, 1.0, (0.0, 0.0, 0.0), beside=2.0)
    with_it, without = (
        walked.light(scene, eye(mi, fov=8.0), 12, 256, 0, clear=clear).mean(axis=(0, 2))
        for scene, clear in (world(mi, *parts, ball), world(mi, *parts))
    )
    assert without[:3].max() < 0.1 * without[5:].min(), "a half is dark, the other shines"
    assert np.allclose(with_it, without, atol=0.02)


def test_a_path_that_begins_in_water_leaves_it_for_air(mi) -> None:
    """Beyond the angle at which all light is mirrored, nothing of the sheet outside is seen."""
    parts = block(mi, WATER, -1.0, 0.0), sheet(mi, 0.5, (0.0, 0.0, 0.0))
    scene, clear = world(mi, *parts)
    steep, level = (
        walked.light(scene, eye(mi, start), 2, 64, 0, clear=clear).mean() for start in ((0, -0.5, 0), (0.7, -0.5, 0))
    )
    assert steep == pytest.approx((1 - mirrored(1, WATER)) * WATER**2, rel=0.02) and level < 1e-3


@pytest.mark.parametrize("some", [False, True])
def test_the_denoiser_is_guided_by_what_is_behind_the_glass(mi, some) -> None:
    red = (0.7, 0.1, 0.05)
    scene, clear = world(mi, block(mi, GLASS, 0.0, 0.1), block(mi, WATER, 0.098, 1.0), sheet(mi, 0.5, red))
    where = np.eye(8, dtype=bool) if some else None
    said = walked.guides(scene, eye(mi, channels="rgba"), 4, where, clear)
    assert said.shape == (8, 8, 13)
    chosen = said[where] if some else said.reshape(-1, 13)
    assert np.allclose(chosen[:, 3], 1) and np.allclose(chosen[:, 4:7], red, atol=1e-3)
    assert np.allclose(chosen[:, 7:10], (0, -1, 0), atol=1e-3) and np.allclose(chosen[:, 11], 0, atol=1e-3)
    assert not some or not said[~where].any()


def test_so_many_substances_are_told_apart_that_their_numbers_fit() -> None:
    assert interfaces.told_apart([GLASS, WATER, GLASS]) == [WATER, GLASS]
    many = interfaces.told_apart([1.3 + 0.1 * k for k in range(7)] + [1.3001, 1.9001])
    assert len(many) == interfaces.KINDS and interfaces.BITS * (1 + interfaces.KINDS) <= 32
    assert np.allclose(many, [1.3 + 0.1 * k for k in range(7)], atol=1e-3)
