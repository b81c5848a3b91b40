"""Trees of a species: each as its kind grows, as high as asked, within its budget, and bare where its season says so; drawn only."""

import numpy as np
import pytest

from worldkit.filming import groves, species


def flat(x, _y):
    return np.zeros(np.shape(x))


def planted(kind, season="summer", count=1, leaves="", height=8.0, seed=3):
    at = [(9.0 * k, 0.0) for k in range(count)]
    return groves.planted("one", kind, at, flat, height, season, leaves, "", seed)


@pytest.mark.parametrize("kind", species.NAMES)
def test_a_tree_is_as_high_as_asked_keeps_its_budget_and_its_crown_at_any(kind):
    crowns = []
    for triangles in (4000, 16_000):
        one = species.grown(kind, 8.0, "summer", 3, triangles)
        count = len(one.wood_faces) + 2 * sum(map(len, one.leaves))
        assert 2000 < count <= triangles
        cards = np.concatenate(one.leaves)
        assert max(one.wood[:, 2].max(), cards[..., 2].max()) == pytest.approx(8.0) and np.isfinite(cards).all()
        assert one.wood[:, 2].min() > -0.3 and one.wood_faces.max() < len(one.wood) and cards[..., 2].min() >= 0
        across = np.cross(cards[:, 2] - cards[:, 0], cards[:, 3] - cards[:, 1])
        crowns.append((0.5 * np.linalg.norm(across, axis=1).sum(), np.ptp(cards[..., 0])))
    assert crowns[0] == pytest.approx(crowns[1], rel=0.35), "fewer leaves are larger ones"
    assert (species.grown(kind, 8.0, "summer", 3, 16_000).wood == one.wood).all()
    assert not np.array_equal(species.grown(kind, 8.0, "summer", 4, 16_000).leaves[1], one.leaves[1])


def test_kinds_have_their_shapes():
    wide, low = {}, {}
    for kind in ("oak", "birch", "pine", "willow", "palm"):
        cards = np.concatenate(species.grown(kind, 8.0, "summer", 3, 12_000).leaves)
        wide[kind], low[kind] = np.ptp(cards[..., 0]), np.quantile(cards[..., 2], 0.03)
    assert wide["oak"] > 1.3 * wide["birch"], "an oak spreads, a birch is slender"
    assert low["willow"] < 2.0 < 2.4 < low["pine"], "a willow hangs to the ground, a pine has lost its lower limbs"
    assert low["palm"] > 4.0


@pytest.mark.parametrize(
    ("kind", "sheds"), [("oak", True), ("birch", True), ("willow", True), ("pine", False), ("palm", False)]
)
def test_what_sheds_its_leaves_is_bare_in_winter_and_coloured_in_autumn(kind, sheds):
    names = {season: [thing.name for thing in planted(kind, season)] for season in species.SEASONS}
    assert len(names["summer"]) == 4 and len(names["winter"]) == (1 if sheds else 4)
    hues = {season: [thing.look for thing in planted(kind, season)][1:] for season in ("summer", "autumn")}
    assert (hues["summer"] != hues["autumn"]) == sheds


def test_trees_of_one_call_share_a_budget_sway_whole_and_take_one_look():
    for kind in species.NAMES:
        for season in ("summer", "winter"):
            assert (
                sum(map(len, (one := species.grown(kind, 8.0, season, 1, 6000)).leaves)) * 2 + len(one.wood_faces)
                <= 6000
            )
    made = planted("birch", count=40, leaves="foliage_gold")
    assert sum(len(thing.faces) for thing in made) <= groves.TRIANGLES and {t.look for t in made[1:]} == {
        "foliage_gold"
    }
    for thing in made:
        assert thing.sways.shape == (len(thing.vertices), 2) and (thing.sways[:, 0] >= 0).all()
    assert np.ptp(made[1].sways.reshape(-1, 4, 2), axis=1).max() < 1e-9, "a leaf is carried whole"
    first, second = (made[0].vertices[np.abs(made[0].vertices[:, 0] - x) < 3.5] - [x, 0, 0] for x in (0.0, 9.0))
    assert len(first) and len(second) and not np.allclose(first[:50], second[:50]), "no tree is as the next"


def test_looks_that_trees_wear_are_in_the_library():
    from worldkit import materials

    for kind in species.NAMES:
        for season in species.SEASONS:
            bark, hues = species.looks(kind, season)
            for look in (bark, *hues):
                assert look.startswith("#") or materials.look(look)


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"kind": "baobab"}, "hedge"),
        ({"season": "monsoon"}, "no season"),
        ({"count": 101}, "1 to 100"),
        ({"height": 0.0}, "0.0 m high"),
    ],
)
def test_what_does_not_grow_is_said(wrong, says):
    from worldkit.errors import ProgramError

    with pytest.raises(ProgramError) as told:
        planted(**{"kind": "oak", **wrong})
    assert says in str(told.value)
