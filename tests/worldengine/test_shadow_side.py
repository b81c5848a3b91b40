"""How fine a shadow map is: as the quality has it for a large picture, and no finer than a small one can show."""

import pytest

from worldengine.film.renderers.preview import pipeline


@pytest.mark.parametrize(
    ("quality", "sides"),
    [
        ("video", {16: 1024, 160: 1024, 640: 2048, 1280: 2048}),
        ("still", {320: 1024, 640: 2048, 1280: 4096, 8192: 4096}),
    ],
)
def test_a_shadow_map_is_as_fine_as_its_picture_can_show(quality, sides):
    assert {pixels: pipeline.shadow_side(pixels, pipeline.QUALITIES[quality]) for pixels in sides} == sides
