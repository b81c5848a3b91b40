"""What a file draws becomes one solid: what is mended is said, what cannot be is refused, and mass properties are exact."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldkit.errors import IntakeError
from worldkit.intake import mending, touchable
from worldkit.intake.drawn_pieces import Drawn

CORNERS = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
FACES = np.array([
    (0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3),
])  # fmt: skip


def box(size=(1, 1, 1), at=(0, 0, 0), faces=FACES) -> Drawn:
    return Drawn(CORNERS * size + at, faces)


def solid(*pieces: Drawn) -> mending.Solid:
    return mending.solid_of(list(pieces), "a.stl")


sizes = st.tuples(*[st.floats(0.05, 20)] * 3)


@settings(max_examples=30)
@given(sizes, st.tuples(*[st.floats(-50, 50)] * 3), st.lists(st.booleans(), min_size=12, max_size=12))
def test_a_box_whose_faces_are_turned_anyhow_and_share_no_corner_is_that_box(size, at, flips) -> None:
    faces = np.array([face[::-1] if flip else face for face, flip in zip(FACES, flips, strict=True)])
    soup = Drawn((CORNERS * size + at)[faces].reshape(-1, 3), np.arange(36).reshape(-1, 3))
    found = solid(soup)
    x, y, z = size
    assert found.closed and found.volume == pytest.approx(x * y * z, rel=1e-6)
    assert found.com == pytest.approx(np.array(at) + np.array(size) / 2, abs=1e-4)
    mass = x * y * z
    assert np.diag(found.inertia) == pytest.approx(
        [mass * (a * a + b * b) / 12 for a, b in ((y, z), (x, z), (x, y))], rel=1e-4
    )
    assert any("coincide" in line for line in found.said)


def test_parts_that_overlap_count_once_and_one_inside_out_within_another_is_its_cavity() -> None:
    joined = solid(box(), box(at=(0.5, 0, 0)))
    assert joined.volume == pytest.approx(1.5) and "2 parts joined, overlaps counted once" in joined.said
    hollow = solid(box(), box((0.5, 0.5, 0.5), (0.25, 0.25, 0.25), FACES[:, ::-1]))
    assert hollow.volume == pytest.approx(1 - 0.125)


def test_a_part_inside_out_in_the_gap_of_a_frame_is_no_cavity() -> None:
    frame = [box((3, 1, 1)), box((3, 1, 1), (0, 0, 2)), box((1, 1, 1), (0, 0, 1)), box((1, 1, 1), (2, 0, 1))]
    one = Drawn(np.concatenate([b.vertices for b in frame]), np.concatenate([FACES + 8 * n for n in range(4)]))
    joined = solid(one)
    around = Drawn(joined.vertices, joined.faces)
    found = solid(around, box((0.5, 0.5, 0.5), (1.25, 0.25, 1.25), FACES[:, ::-1]))
    assert found.volume == pytest.approx(8.125) and "a part was inside out: its faces turned" in found.said


def test_parts_that_touch_are_whole_however_the_file_numbers_their_corners() -> None:
    two = [box(), box(at=(1, 0, 0))]
    assert solid(*two).volume == pytest.approx(2)
    one = Drawn(np.concatenate([b.vertices for b in two]), np.concatenate([FACES, FACES + 8]))
    assert solid(one).volume == pytest.approx(2)
    soup = solid(Drawn(one.vertices[one.faces].reshape(-1, 3), np.arange(3 * len(one.faces)).reshape(-1, 3)))
    assert soup.closed and soup.volume == pytest.approx(2)
    skin = [Drawn(CORNERS, FACES[:5]), Drawn(CORNERS, FACES[5:])]
    assert solid(*skin).volume == pytest.approx(1), "a skin of two materials"


def test_inside_out_is_mended_and_said() -> None:
    found = solid(box(faces=FACES[:, ::-1]))
    assert found.volume == pytest.approx(1) and any("inside out" in line for line in found.said)
    beside = solid(box(), box(at=(3, 0, 0), faces=FACES[:, ::-1]))
    assert beside.volume == pytest.approx(2) and any("a part was inside out" in line for line in beside.said)


def test_a_hole_under_it_is_closed_and_an_open_top_is_no_hole() -> None:
    bottom = (CORNERS[FACES][:, :, 2] == 0).all(axis=1)
    found = solid(box(faces=FACES[~bottom]))
    assert found.closed and found.volume == pytest.approx(1) and "1 hole closed" in found.said
    top = (CORNERS[FACES][:, :, 2] == 1).all(axis=1)
    pot = solid(box(faces=FACES[~top]))
    assert not pot.closed and any("no substance of its own" in line for line in pot.said)


def test_faces_without_area_and_those_there_twice_are_removed() -> None:
    faces = np.concatenate([FACES, FACES[:3], [(0, 0, 1), (2, 2, 2)]])
    found = solid(box(faces=faces))
    assert found.volume == pytest.approx(1)
    assert [line for line in found.said if "removed" in line] == [
        "2 faces without area removed",
        "3 faces that were there twice removed",
    ]


@pytest.mark.parametrize("size", [(1, 1, 0), (0, 0, 0), (1, 0, 1)])
def test_what_is_flat_is_refused(size) -> None:
    with pytest.raises(IntakeError, match="flat") as told:
        solid(box(size))
    assert told.value.code == "zero_volume" and told.value.place == "a.stl" and told.value.next_move


def test_a_sheet_is_flat_whichever_way_it_leans() -> None:
    points = np.array([(0, 0, 0), (1, 0, 1), (1, 1, 1), (0, 1, 0)], float)
    faces = np.array([(0, 1, 2), (0, 2, 3), (2, 1, 0), (3, 2, 0)])
    with pytest.raises(IntakeError, match="all of it in one plane"):
        solid(Drawn(points, faces))


def test_a_sheet_drawn_from_both_sides_has_no_substance() -> None:
    points = np.array([(0, 0, 0), (1, 0, 1), (1, 1, 0), (0, 1, 0.5)], float)
    faces = np.array([(0, 1, 2), (0, 2, 3), (2, 1, 0), (3, 2, 0)])
    assert not solid(Drawn(points, faces)).closed


def ball(n: int = 24) -> Drawn:
    import trimesh

    made = trimesh.creation.uv_sphere(radius=0.5, count=(n, n))
    return Drawn(np.asarray(made.vertices), np.asarray(made.faces))


def tube(axis: str) -> Drawn:
    import trimesh

    made = trimesh.creation.cylinder(radius=0.2, height=1.0, sections=48)
    points = np.roll(np.asarray(made.vertices), {"z": 0, "x": 1, "y": 2}[axis], axis=1)
    return Drawn(points, np.asarray(made.faces))


@pytest.mark.parametrize(
    ("piece", "kind"),
    [
        (box((1, 2, 3)), "box"),
        (ball(), "sphere"),
        (tube("z"), "cylinder"),
        (tube("x"), "cylinder"),
        (tube("y"), "cylinder"),
    ],
)
def test_a_primitive_stands_for_what_is_one(piece: Drawn, kind: str) -> None:
    rows, hulls, how = touchable.pieces(solid(piece))
    assert [row["type"] for row in rows] == [kind] and hulls == [] and "within 5% of its volume" in how
    (row,) = rows
    size = np.ptp(piece.vertices, axis=0)
    if kind == "cylinder":
        w, x, y, z = row.get("quat", (1, 0, 0, 0))
        axis = np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
        assert abs(axis[int(size.argmax())]) == pytest.approx(1)
        assert row["height"] == pytest.approx(1) and row["diameter"] == pytest.approx(0.4)


def test_a_wedge_is_one_hull() -> None:
    faces = np.array([(0, 1, 2), (3, 5, 4), (0, 3, 4), (0, 4, 1), (1, 4, 5), (1, 5, 2), (2, 5, 3), (2, 3, 0)])
    points = np.array([(0, 0, 0), (1, 0, 0), (0, 0, 1), (0, 1, 0), (1, 1, 0), (0, 1, 1)], float)
    rows, hulls, how = touchable.pieces(solid(Drawn(points, faces)))
    assert rows == [{"type": "hull", "hull": 0}] and len(hulls[0]) == 6 and how.startswith("one hull")


def test_what_cannot_be_cut_collides_as_its_box_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_):
        raise RuntimeError("no pieces")

    monkeypatch.setattr(touchable, "_cut", fails)
    rows, hulls, how = touchable.pieces(solid(box(), box((0.2, 0.2, 3), (2, 0, 0))))
    assert rows[0]["type"] == "box" and not hulls and "could not be cut into hulls: no pieces" in how


def test_what_is_cut_too_loosely_is_cut_by_planes_and_so_is_everything_without_coacd(monkeypatch) -> None:
    cross = solid(box((3, 0.1, 0.1), (-1.5, 0, 0)), box((0.1, 3, 0.1), (0, -1.5, 0)))
    with monkeypatch.context() as patch:
        patch.setattr(touchable, "_cut", lambda _: ([cross.vertices], "loosely"))
        _, tight, how = touchable.pieces(cross)
    assert "hulls cut by planes" in how
    monkeypatch.setattr(touchable.importlib.util, "find_spec", lambda _: None)
    _, hulls, how = touchable.pieces(cross)
    assert 2 <= len(hulls) == len(tight) <= touchable.cutting.MOST_HULLS and "install the extra `hulls`" in how
    assert sum(map(touchable.volume_of, hulls)) < 1.3 * cross.volume


def test_a_cut_without_end_is_ended_and_planes_cut_instead(monkeypatch) -> None:
    cross = solid(box((3, 0.4, 0.4), (-1.5, 0, 0)), box((0.4, 3, 0.4), (0, -1.5, 0)))
    with pytest.raises(ValueError, match="it took more than 0 s"):
        touchable.cutting.cut(cross.vertices, cross.faces, True, limit_s=0)

    def endless(*_):
        raise ValueError("it took more than 60 s")

    monkeypatch.setattr(touchable.cutting, "cut", endless)
    _, hulls, how = touchable.pieces(cross)
    assert len(hulls) > 1 and "cut by planes (CoACD: it took more than 60 s)" in how
