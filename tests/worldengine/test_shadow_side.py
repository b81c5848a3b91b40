"""How fine a shadow map is: as the quality has it for a large picture, and no finer than a small one can show."""

import numpy as np
import pytest

from worldengine.film.renderers.preview import shadows, stages
from worldengine.film.renderers.preview.eye import View

FRONT = np.array([[1.0, 0, 0], [0, 0, -1.0], [0, 1.0, 0]])  # right is x, up is z, it looks along y


@pytest.mark.parametrize(
    ("quality", "sides"),
    [
        ("video", {16: 1024, 160: 1024, 640: 2048, 1280: 2048}),
        ("still", {320: 1024, 640: 2048, 1280: 4096, 8192: 4096}),
    ],
)
def test_a_shadow_map_is_as_fine_as_its_picture_can_show(quality, sides):
    assert {pixels: stages.shadow_side(pixels, stages.QUALITIES[quality]) for pixels in sides} == sides


def test_hills_on_the_horizon_do_not_coarsen_the_shadows_of_what_is_in_focus():
    view = View(np.array([0.0, -8.0, 1.5]), FRONT, (0.3, 0.17))
    near, plain = shadows.covered(view, (np.zeros(3), 90.0), 8.0)
    far, hilly = shadows.covered(view, (np.array([0.0, 200.0, 10.0]), 320.0), 8.0)
    for centre, radius in ((near, plain), (far, hilly)):
        assert np.linalg.norm(centre - (0, 0, 1.5)) < 0.6 * radius, "what is in focus lies within"
        assert shadows.steady(radius) < 0.015 * 2048, "a pixel of the map is thinner than a pole"
    assert shadows.steady(hilly) <= 1.5 * shadows.steady(plain)
    _, unfocused = shadows.covered(view, (np.array([0.0, 200.0, 10.0]), 320.0))
    assert unfocused > 3 * hilly
    assert shadows.covered(view, (np.zeros(3), 1.0), 8.0)[1] == 1.0, "a small scene is covered whole"
