"""What shows an author's law: closed tubes, surfaces and grains that the engine does not simulate."""

from collections import Counter

import numpy as np
import pytest

from small_worlds import empty
from worldkit import moved_shapes
from worldkit.errors import ProgramError

TURN = 2 * np.pi * np.arange(6) / 6
RING = 0.1 * np.stack([np.cos(TURN), np.sin(TURN), 0 * TURN], axis=1)
HEXAGON = 6 * 0.5 * 0.1**2 * np.sin(np.pi / 3)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_tube_is_closed_and_faces_outwards_whichever_way_it_runs(sense: float) -> None:
    rings = 4
    along = np.linspace(0.0, 0.6 * sense, rings)[:, None, None] * (0.0, 0.0, 1.0)
    points = (along + RING * (1.0, sense, 1.0)).reshape(-1, 3)
    triangles = np.array(moved_shapes.tube(rings, len(RING)))
    edges = Counter((int(t[i]), int(t[(i + 1) % 3])) for t in triangles for i in range(3))
    assert set(edges.values()) == {1} and all((b, a) in edges for a, b in edges)
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6 == pytest.approx(HEXAGON * 0.6)


def test_neither_surface_nor_grains_are_simulated() -> None:
    spec = empty()
    points = np.concatenate([RING, RING + np.array([0, 0, 0.3])])
    moved_shapes.surface(spec, "cord", points, moved_shapes.tube(2, 6), look="rubber_red")
    moved_shapes.grains(spec, "drops", points[:5], 0.01, look="rubber_red")
    model = spec.compile()
    assert model.nv == 0 and not model.flex_contype.any() and not model.geom_contype.any()
    assert model.flex_vertnum.tolist() == [12] and model.ngeom == 5 and model.body("drops").mass == 0.0
    assert int(model.flex_matid[0]) == model.material("rubber_red").id


@pytest.mark.parametrize(
    ("points", "triangles"),
    [(RING[:, :2], [(0, 1, 2)]), (RING, [(0, 1, 6)]), (RING, []), (RING * np.nan, [(0, 1, 2)]), (RING, [(0, 1)])],
)
def test_what_is_no_surface_is_refused_in_words(points: np.ndarray, triangles: list[tuple[int, ...]]) -> None:
    with pytest.raises(ProgramError, match="cord has points of the shape"):
        moved_shapes.surface(empty(), "cord", points, triangles)
