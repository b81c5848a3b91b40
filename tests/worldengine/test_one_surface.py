"""Many bodies of one substance are one smooth closed surface, in both renderers, from where they are in each picture."""

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor, lay_film, record
from worldengine.film import described, dressed, motion_facts, one_surface, renderers
from worldengine.film.described import FilmError
from worldengine.film.directed import Screening
from worldengine.recording import point_colours
from worldkit import portable
from worldkit.errors import ProgramError
from worldkit.filming import Film, Recorded, still

SIZE = (96, 54)


def volume(vertices, faces) -> float:
    corners = vertices[faces]
    return float(np.einsum("fk,fk->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6)


def grid(side: int, apart: float) -> np.ndarray:
    return np.stack(np.meshgrid(*[np.arange(side)] * 3), -1).reshape(-1, 3) * apart


def test_a_block_of_beads_becomes_one_closed_piece_of_about_its_size():
    points = grid(6, 0.019) + np.random.default_rng(1).normal(size=(216, 3)) * 5e-4
    vertices, faces, _ = one_surface.around(points, np.full(216, 0.01), 60_000, 60_000)
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    _, shared = np.unique(edges, axis=0, return_counts=True)
    assert (shared == 2).all(), "closed"
    assert len(vertices) - len(edges) // 2 + len(faces) == 2, "one piece without holes"
    assert volume(vertices, faces) == pytest.approx((6 * 0.019) ** 3, rel=0.15)


def test_drops_far_apart_stay_drops_of_their_size():
    points = np.array([[0, 0, 0], [0.2, 0, 0], [0, 0.3, 0.1]])
    vertices, faces, _ = one_surface.around(points, np.full(3, 0.01), 60_000, 60_000)
    assert volume(vertices, faces) == pytest.approx(3 * 4 / 3 * np.pi * 1e-6, rel=0.3)
    away = np.linalg.norm(vertices[:, None] - points, axis=-1).min(axis=1)
    assert away.mean() == pytest.approx(0.01, rel=0.1) and np.ptp(away) < 0.002


def test_it_tells_how_thick_it_is_at_each_corner():
    radii = np.full(300, 0.01)
    slab = np.stack(np.meshgrid(np.arange(10), np.arange(10), np.arange(3), indexing="ij"), -1).reshape(-1, 3) * 0.015
    vertices, _, thick = one_surface.around(slab, radii, 60_000, 60_000)
    inner = (np.abs(vertices[:, :2] - 0.0675) < 0.04).all(axis=1)
    assert np.median(thick[inner]) == pytest.approx(np.ptp(vertices[inner, 2]), rel=0.1), "through a slab, not along it"
    _, _, alone = one_surface.around(slab[:1], radii[:1], 60_000, 60_000)
    assert np.median(alone) == pytest.approx(0.02, rel=0.15), "through a drop"


def test_a_smooth_one_is_even_where_points_are_not_and_as_large():
    level = np.stack(np.meshgrid(*[np.arange(-0.1, 0.1, 0.014)] * 2, np.arange(0, 0.05, 0.014)), -1).reshape(-1, 3)
    heap = level + np.random.default_rng(1).uniform(-0.006, 0.006, level.shape)
    drop = np.array([[0.5, 0.0, 0.0]])
    found = {}
    for smooth in (1.0, 2.0):
        vertices, *_ = one_surface.around(
            np.vstack([heap, drop]), np.full(len(heap) + 1, 0.0105), 90_000, 90_000, 0.0, smooth
        )
        own = vertices[vertices[:, 0] < 0.3]
        top = own[(own[:, 2] > 0.03) & (np.abs(own[:, :2]).max(axis=1) < 0.07), 2]
        found[smooth] = top.std(), np.ptp(own[:, 0]), np.ptp(vertices[vertices[:, 0] > 0.3, 0])
    (rough, wide, drop_m), (even, as_wide, same_drop_m) = found[1.0], found[2.0]
    assert (
        even < 0.5 * rough
        and as_wide == pytest.approx(wide, rel=0.04)
        and same_drop_m == pytest.approx(drop_m, rel=0.15)
    )


def test_what_falls_alone_is_narrower_and_what_lies_together_is_not():
    points = np.concatenate([grid(4, 0.015), [[0.2, 0, 0], [0, 0.3, 0]]])
    radii = one_surface.narrowed(points, np.full(66, 0.01), 0.5)
    assert radii[-2:] == pytest.approx(0.005) and (radii[:-2] == 0.01).all()
    vertices, *_ = one_surface.around(points, radii, 60_000, 60_000)
    drop = vertices[vertices[:, 0] > 0.1]
    assert len(drop) and np.ptp(drop, axis=0).max() == pytest.approx(0.01, rel=0.4)


def test_it_keeps_to_the_room_that_it_has_and_none_is_none():
    vertices, faces, _ = one_surface.around(grid(8, 0.03), np.full(512, 0.01), 3000, 2000)
    assert 100 < len(faces) <= 3000 and len(vertices) < 2000
    assert [len(part) for part in one_surface.around(np.zeros((0, 3)), np.zeros(0), 9, 9)] == [0, 0, 0]


def test_colours_mix_where_they_meet_and_nowhere_else():
    points = grid(8, 0.02)[:64] * (1, 1, 0)
    left = points[:, :1] < points[:, 0].mean()
    colours = np.where(left, (1.0, 0.8, 0.0), (0.0, 0.6, 0.9))
    vertices, *_ = one_surface.around(points, np.full(64, 0.012), 60_000, 60_000)
    found = one_surface.mixed(vertices, points, np.full(64, 0.012), colours)
    across = vertices[:, 0] - points[:, 0].mean()
    assert found[across < -0.045] == pytest.approx(np.tile((1.0, 0.8, 0.02), ((across < -0.045).sum(), 1)), abs=0.03)
    middle = found[np.abs(across) < 0.003]
    assert (middle[:, 1] > 1.5 * middle[:, [0, 2]].max(axis=1)).all(), "of yellow and blue comes green"
    order = np.argsort(across)
    assert np.abs(np.diff(found[order, 2])).max() < 0.5, "smoothly"


def test_what_an_eye_does_not_see_is_not_made():
    points, radii = grid(6, 0.019), np.full(216, 0.01)
    fine, coarse = (one_surface.around(points, radii, 60_000, 60_000, finest) for finest in (0.0, 0.006))
    assert len(coarse[1]) < 0.5 * len(fine[1])
    assert volume(*coarse[:2]) == pytest.approx(volume(*fine[:2]), rel=0.1)


class Poured:
    """Nine balls that fall onto a floor, seen by a film."""

    def __init__(self, folder):
        spec = empty()
        floor(spec)
        for number in range(9):
            ball(spec, f"drop_{number}", (0.19 * (number % 3), 0.19 * (number // 3), 0.3), rgba=(0.1, 0.1, 0.8, 1))
        ball(spec, "other", (-0.8, 0, 0.3))
        spec.worldbody.add_camera(name="side", pos=(0, -3, 0.5), xyaxes=(1, 0, 0, 0, 0, 1))
        self.folder = folder
        portable.write(spec, folder / "world.mjz")
        self.recording = record(spec, folder / "trajectory", 300)
        self.plain = portable.read(folder / "world.mjz")
        motion_facts.write(self.recording, folder / "motion.npz", {"fps": 24, "size": list(SIZE), "movers": []})
        with np.load(folder / "motion.npz") as arrays:
            self.seen = Recorded(dict(arrays))

    def film(self, change=None, look="plastic_red", blended=False):
        film = Film(self.seen)
        film.surface("honey", of="drop_*", look=look, blended=blended)
        film.shot(still((0.2, -1.6, 0.5), (0.2, 0.2, 0.2), lens_mm=35), until=0.25)
        lay_film(self.folder, film, change and (lambda facts, _: change(facts)))
        return described.read(self.folder, self.recording)


@pytest.fixture(scope="module")
def poured(tmp_path_factory):
    return Poured(tmp_path_factory.mktemp("poured"))


def test_the_statement_lists_it_and_names_are_checked(poured):
    assert poured.film().drawn_only() == ["honey (one surface in place of 9 shapes)"]
    film = Film(poured.seen)
    with pytest.raises(ProgramError, match="names no body"):
        film.surface("honey", of="bead_*")
    film.surface("honey", of=["drop_1", "drop_2"])
    with pytest.raises(ProgramError, match="or another's"):
        film.surface("jam", of="drop_*")
    with pytest.raises(FilmError, match="no body and no particles"):
        poured.film(lambda facts: facts["surfaces"][0]["of"].append("nobody"))


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["preview", "traced"])
def test_both_renderers_show_it_where_the_bodies_are(poured, renderer):
    film = poured.film()
    with Screening(poured.folder / "world.mjz", poured.plain, poured.recording, film, SIZE, 24, renderer) as screening:
        first, last = (screening.picture(number, 2).astype(int) for number in (0, film.frames - 1))
        assert screening.frames.renderer == renderer, screening.frames.reason
        (surface,) = dressed.surfaces(screening.model, film)
        surface.place(screening._replay.data)
        used = surface._vertices[surface._vertices[:, 2] > -100]
        middles = [screening._replay.data.body(f"drop_{k}").xpos for k in range(9)]
        assert np.linalg.norm(used[:, None] - np.array(middles), axis=-1).min(axis=1).max() < 0.2
    red = [(image[..., 0] - image[..., 2:].max(axis=-1) > 40) for image in (first, last)]
    assert min(mask.sum() for mask in red) > 60, "it is seen, in its own look"
    rows = [np.nonzero(mask)[0].mean() for mask in red]
    assert rows[1] > rows[0] + 1, "it has fallen"


@pytest.mark.gl
def test_the_preview_shows_through_it_what_lies_behind_a_clear_one(poured):
    pictures = {}
    for look in ("plastic_red", "glass_clear"):
        film = poured.film(look=look)
        with Screening(
            poured.folder / "world.mjz", poured.plain, poured.recording, film, SIZE, 24, "preview"
        ) as screening:
            pictures[look] = screening.picture(film.frames - 1, 2).astype(int)
    red = pictures["plastic_red"][..., 0] - pictures["plastic_red"][..., 2] > 40
    through, floor_beside = pictures["glass_clear"][red], pictures["glass_clear"][-6:, :12].reshape(-1, 3)
    assert np.abs(np.median(through, axis=0) - np.median(floor_beside, axis=0)).max() < 40


def test_particles_can_be_a_surface_too(poured):
    film = Film(poured.seen)
    places = grid(3, 0.03)
    film.particles("foam", lambda times: np.tile(places, (len(times), 1, 1)), diameter=0.04)
    film.surface("lather", of="foam", look="#ffffff")
    lay_film(poured.folder, film)
    told = described.read(poured.folder, poured.recording)
    model = dressed.dress(poured.folder / "world.mjz", told)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    (surface,) = dressed.surfaces(model, told)
    surface.place(data)
    assert (surface._vertices[:, 2] > -100).sum() > 100
    assert renderers.USUAL == "preview"


def test_a_law_that_stops_telling_colours_leaves_none(poured):
    told = poured.film()
    model = dressed.dress(poured.folder / "world.mjz", told)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    (surface,) = dressed.surfaces(model, told)
    colours = point_colours.of(model)
    for given, seen in ((0.5, 0.5), (-1.0, -1.0)):
        colours.geom[:] = given
        surface.place(data)
        assert colours.skin == pytest.approx(np.full_like(colours.skin, seen))


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["preview", "traced"])
def test_bodies_of_several_colours_are_one_skin_that_has_them_all(poured, renderer):
    film = poured.film(look="plastic_red", blended=True)
    for geom in range(poured.plain.ngeom):
        if poured.plain.geom(geom).name.startswith("drop_"):
            assert poured.plain.geom_rgba[geom, 2] == pytest.approx(0.8)
    with Screening(poured.folder / "world.mjz", poured.plain, poured.recording, film, SIZE, 24, renderer) as screening:
        image = screening.picture(film.frames - 1, 2).astype(int)
        assert screening.frames.renderer == renderer, screening.frames.reason
        assert len(screening._surfaces) == 1
    assert ((image[..., 2] - image[..., 0]) > 40).sum() > 60, "blue as its bodies are"
    assert ((image[..., 0] - image[..., 2]) > 40).sum() == 0, "and nowhere red as its look"


@pytest.mark.gl
def test_a_picture_lays_its_surface_once_however_often_it_is_set_up(poured, monkeypatch):
    """How far things move is asked at three moments, and what a smeared picture shows, once more: none of these draws it."""
    laid, around = [], one_surface.around
    monkeypatch.setattr(one_surface, "around", lambda *told: laid.append(1) or around(*told))
    film = poured.film()
    with Screening(poured.folder / "world.mjz", poured.plain, poured.recording, film, SIZE, 24) as screening:
        assert film.shutter > 0 and film.samples == 1
        first = screening.picture(2)
        assert len(laid) == 1
        screening.picture(4)
        assert len(laid) == 2
        assert (screening.picture(2) == first).all() and len(laid) == 3, "what has moved is laid anew"


def test_balls_are_read_together_as_one_by_one():
    spec = empty()
    for number in range(4):
        ball(spec, f"drop_{number}", (0.2 * number, 0, 0.3))
    model = spec.compile()
    model.geom_size[1, 0] = 1e-9
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    geoms = np.arange(model.ngeom)
    together = one_surface.balls(model, data, geoms)
    single = [one_surface.balls(model, data, geoms[n : n + 1]) for n in range(model.ngeom)]
    assert all((a == np.concatenate(b)).all() for a, b in zip(together, zip(*single, strict=True), strict=True))
    assert together[2].tolist() == [0, 2, 3] and together[0][1] == pytest.approx((0.4, 0, 0.3))
