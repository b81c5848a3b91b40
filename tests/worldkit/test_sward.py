"""Grass grows in clumps, thins out from where it is seen near, and no blade is as its neighbour."""

import numpy as np
import pytest

from worldkit.filming import Film, Recorded, Surface, far_woods, sets, sward
from worldkit.filming.sets import land

AREA = (-6.0, -6.0, 6.0, 6.0)


def level(x, _y):
    return np.zeros(np.shape(x))


def corners(**how):
    points, faces = sward.blades(AREA, 0.2, 8000, level, how.pop("clear_of", ()), how.pop("seed", 1), **how)
    assert faces.max() < len(points) and len(faces) * 5 == len(points) * 3
    return points.reshape(-1, 5, 3)


def filmed(name, radius=1.0, seed=1):
    t = np.linspace(0.0, 1.0, 30)[:, None]
    way = np.hstack([radius * (2 * t - 1), 0 * t, 0.1 + 0 * t])
    film = Film(Recorded.rehearsal({"ball": way}, duration=2.0, radius=0.1))
    film.set(name, seed=seed)
    return film


def test_no_blade_is_as_tall_broad_or_bent_as_its_neighbour():
    found = corners()
    tall = found[:, 4, 2] - found[:, 0, 2]
    broad = np.linalg.norm(found[:, 1] - found[:, 0], axis=1)
    bent = np.linalg.norm(found[:, 4, :2] - found[:, :2, :2].mean(axis=1), axis=1) / tall
    assert found[..., 2].max() <= 0.2 and found[..., 2].min() >= -0.003
    for what in (tall, broad, bent):
        assert what.std() > 0.2 * what.mean()
    assert (bent > 0.8).mean() > 0.03, "some are far over"
    assert broad.max() < 0.025


def test_it_stands_in_clumps_with_thin_places_between():
    feet = corners()[:, 0, :2]
    count, _, _ = np.histogram2d(*feet.T, bins=40, range=[[-6, 6], [-6, 6]])
    even = np.random.default_rng(0).poisson(count.mean(), count.shape)
    assert count.std() > 1.25 * even.std()


def test_most_of_it_stands_where_it_is_seen_from_near_and_there_each_is_slender():
    found = corners(densest=(1.0, 0.0))
    away = np.hypot(found[:, 0, 0] - 1.0, found[:, 0, 1])
    near, far = away < 1.5, away > 4.5
    even = corners()
    assert near.sum() > 2 * (np.hypot(even[:, 0, 0] - 1.0, even[:, 0, 1]) < 1.5).sum()
    broad = np.linalg.norm(found[:, 1] - found[:, 0], axis=1)
    assert np.median(broad[near]) < np.median(broad[far]) and np.median(broad[near]) < 0.006


def test_the_same_seed_is_the_same_grass_and_another_another():
    assert np.array_equal(corners(seed=3), corners(seed=3)) and not np.array_equal(corners(seed=3), corners(seed=4))


@pytest.mark.parametrize("name", ["meadow", "park", "lake", "riverbank", "mountain_side"])
def test_a_turf_has_hues_and_dry_stalks_all_of_them_matt(name):
    grown = [thing for thing in filmed(name)._things if thing.grows]
    looks = {thing.look.colour for thing in grown if isinstance(thing.look, Surface)}
    assert len(looks) >= 5 and all(isinstance(thing.look, Surface) and thing.look.roughness > 0.9 for thing in grown)
    blades = {thing.name: len(thing.vertices) // 5 for thing in grown}
    dry = sum(count for title, count in blades.items() if "dry" in title)
    assert 0.05 < dry / sum(blades.values()) < 0.25 and sum(blades.values()) < 76_000


def test_where_something_passes_only_low_grass_grows():
    film = filmed("meadow")
    for thing in (thing for thing in film._things if thing.grows):
        tips = thing.vertices.reshape(-1, 5, 3)[:, 4]
        tips = tips[(np.abs(tips[:, 0]) < 0.9) & (np.abs(tips[:, 1]) < 0.04)]
        if "short" in thing.name:
            assert len(tips) > 10 and tips[:, 2].max() <= film.recorded.floor_z + land.LOW_M
        else:
            assert not len(tips[tips[:, 2] < 0.05])


def test_the_edge_of_a_wood_is_far_behind_and_each_crown_another():
    film, random = filmed("meadow"), np.random.default_rng(1)
    place = sets.Place.of(film.recorded, -57.0, 1)
    edges = [thing for thing in film._things if thing.name.startswith("edge of the wood")]
    assert len(edges) == 2
    for edge in edges:
        assert np.hypot(*(edge.vertices[:, :2] - place.middle).T).min() > 40
    points, faces = far_woods.crowns(np.array([(0.0, 0.0), (30.0, 0.0)]), 10.0, 0.0, random)
    one, other = np.split(points, 2)
    assert (
        np.array_equal(np.unique(faces), np.arange(len(points))) and abs(np.ptp(one[:, 2]) - np.ptp(other[:, 2])) > 1e-3
    )
    largest = np.linalg.norm(np.diff(points[faces[: 2 * far_woods.CLUMPS]], axis=1), axis=2).max()
    assert largest < 0.15 * np.ptp(one[:, 2]), "a clump is foliage, not a sheet as large as a door"
    hearts = one[4 * far_woods.CLUMPS :]
    assert np.hypot(hearts[:, 0], hearts[:, 1]).max() < np.hypot(one[:, 0], one[:, 1]).max(), (
        "the closed part is within"
    )
    assert points[:, 2].min() > -2.0 and 4.0 < points[:, 2].max() < 12.5
