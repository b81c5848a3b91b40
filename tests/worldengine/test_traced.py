"""The traced renderer: its shapes, its light, its denoiser, and what happens where its packages are missing."""

from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from worldengine.film import renderers
from worldengine.film.drawn_frames import Frames
from worldengine.film.renderers.traced import (
    coatings,
    denoised,
    figures,
    glimpses,
    leaning,
    rounded,
    tracing,
    unwrapped,
    variant,
)
from worldengine.film.renderers.traced.half_room import Walls
from worldkit import bodies, cameras, materials, scene
from worldkit.settings import ROOM

SHAPES = {
    "box": (rounded.box(np.array([0.2, 0.1, 0.05])), 8 * 0.2 * 0.1 * 0.05),
    "sphere": (rounded.sphere(np.array([0.2, 0.1, 0.3])), 4 / 3 * np.pi * 0.2 * 0.1 * 0.3),
    "cylinder": (rounded.cylinder(0.1, 0.2), np.pi * 0.1**2 * 0.4),
    "capsule": (rounded.capsule(0.1, 0.2), np.pi * 0.1**2 * 0.4 + 4 / 3 * np.pi * 0.1**3),
}


@pytest.mark.parametrize("name", SHAPES)
def test_a_primitive_is_closed_as_large_as_it_should_be_and_turned_outward(name) -> None:
    mesh, volume = SHAPES[name]
    corners = mesh.points[mesh.faces]
    enclosed = np.einsum("fk,fk->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    assert enclosed == pytest.approx(volume, rel=0.02)
    assert np.allclose(np.linalg.norm(mesh.normals, axis=1), 1.0)
    assert (np.einsum("vk,vk->v", mesh.points, mesh.normals) > 0).all()


def test_edges_are_rounded_and_sides_stay_flat() -> None:
    half = np.array([0.2, 0.1, 0.05])
    mesh = rounded.box(half)
    assert np.allclose(np.abs(mesh.points).max(axis=0), half)
    missing = np.linalg.norm(mesh.points - half, axis=1).min()
    assert missing == pytest.approx((np.sqrt(3) - 1) * rounded.edge(0.05), rel=0.02)


def test_no_normal_leans_so_far_that_a_seen_triangle_shows_no_light() -> None:
    crease = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, -1), (0, 1, -1)], dtype=float)
    smooth = np.array([(-1, 0, 1), (0, 0, 1), (0, 0, 1), (-1, 0, 1), (-1, 0, 0), (-1, 0, 0)], dtype=float)
    smooth /= np.linalg.norm(smooth, axis=1, keepdims=True)
    faces = np.array([(0, 1, 2), (0, 2, 3), (0, 3, 5), (0, 5, 4), (0, 0, 1)])
    before = rounded.Mesh(crease, smooth, faces, crease[:, :2])
    after = leaning.upright(before)

    def lean(mesh: rounded.Mesh) -> np.ndarray:
        corners = mesh.points[mesh.faces[:4]]
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        return np.degrees(np.arccos(np.clip(np.einsum("fk,fck->fc", across, mesh.normals[mesh.faces[:4]]), -1, 1)))

    assert lean(before).max() == pytest.approx(45) and lean(after).max() == pytest.approx(leaning.MOST_DEG)
    assert np.array_equal(after.points[after.faces], crease[faces]), "its shape is what it was"
    assert after.uv is not None and np.array_equal(after.uv[after.faces], crease[faces][..., :2])
    eye = np.array([5.0, 0.5, 0.05])  # sees the top at a slant, and the side not at all
    sight = (eye - after.points) / np.linalg.norm(eye - after.points, axis=1, keepdims=True)
    along = [np.einsum("vk,vk->v", n, sight) for n in (after.normals, leaning.facing(after.points, after.normals, eye))]
    assert along[0][after.faces[:2]].min() < -0.3 and along[1][after.faces[:2]].min() > 0.04
    assert np.array_equal(along[0][after.faces[2:4]], along[1][after.faces[2:4]])
    assert leaning.upright(SHAPES["sphere"][0]) is SHAPES["sphere"][0], "what is finely meshed stays as it is"


def test_paint_lies_at_its_true_scale_on_every_side() -> None:
    mesh = unwrapped.along_sides(rounded.box(np.array([0.5, 0.3, 0.2])), 2, 4.0, 0.0)
    assert mesh.uv is not None
    flat = mesh.points[mesh.faces], mesh.uv[mesh.faces]
    long = np.linalg.norm(flat[0][:, 1] - flat[0][:, 0], axis=1)
    on_paint = np.linalg.norm(flat[1][:, 1] - flat[1][:, 0], axis=1)
    wide = long > 0.1
    assert wide.sum() > 6 and np.allclose(on_paint[wide] / long[wide], 4.0, rtol=0.02)


def test_a_picture_around_a_centre_has_no_seam_across_a_face() -> None:
    mesh = unwrapped.around_centre(rounded.box(np.array([0.1, 0.1, 0.1])))
    assert mesh.uv is not None
    assert np.ptp(mesh.uv[mesh.faces][..., 0], axis=1).max() <= 0.5


def test_a_cube_map_becomes_one_picture_of_all_directions() -> None:
    faces = np.stack([np.full((8, 8, 3), k / 10) for k in range(6)])
    picture = coatings.round_picture(faces, 32)
    assert picture.shape == (32, 64, 3)
    assert picture[1, 0, 0] == pytest.approx(0.4) and picture[-2, 0, 0] == pytest.approx(0.5)  # +z above, -z below
    assert picture[16, 1, 0] == pytest.approx(0.0) and picture[16, 16, 0] == pytest.approx(0.2)  # +x, then +y


def test_a_room_leaves_out_the_wall_that_its_light_comes_through() -> None:
    low, high = np.array([-1.0, -1.0, 0.0]), np.array([1.0, 1.0, 1.0])
    walls = Walls(ROOM, low, high, np.array([[2.0, 0.0, 1.5]]), 0.0)
    around = np.stack(np.meshgrid(*[np.linspace(-1, 1, 9)] * 3), -1).reshape(-1, 3)
    around = around[np.linalg.norm(around, axis=1) > 0.1]
    drawn, painted = walls.seen(np.array([0.0, 0.0, 1.0]), around)
    assert len(painted) == 1 and len(drawn) == 4 and not drawn & painted
    assert walls.seen(np.array([50.0, 0.0, 1.0]), around) == (frozenset(), frozenset())


def test_the_denoiser_takes_noise_out_and_keeps_what_the_guides_show() -> None:
    denoiser = denoised.Denoiser(64, 64)
    assert denoiser.there
    albedo = np.full((64, 64, 3), 0.2, np.float32)
    albedo[:, 32:] = 0.8
    light = albedo * np.random.default_rng(1).exponential(1.0, (64, 64, 1)).astype(np.float32)
    clean = denoiser.clean(light, albedo, np.zeros_like(albedo))
    denoiser.close()
    assert clean[:, :28].std() < 0.3 * light[:, :28].std()
    assert clean[:, 36:].mean() > 2.5 * clean[:, :28].mean()


def test_a_card_of_nvidias_comes_first_then_llvm_then_plain_computing(monkeypatch) -> None:
    assert variant.candidates(True, True) == ("cuda_ad_rgb", "llvm_ad_rgb", "scalar_rgb")
    assert variant.candidates(True, False) == ("cuda_ad_rgb", "scalar_rgb")
    assert variant.candidates(False, True) == ("llvm_ad_rgb", "scalar_rgb")

    class Driver:
        def __init__(self, cards: int) -> None:
            self.cards = cards

        def cuInit(self, flags: int) -> int:
            return 0 if self.cards >= 0 else 100

        def cuDeviceGetCount(self, count) -> int:
            count._obj.value = self.cards
            return 0

    for cards, there in ((1, True), (0, False), (-1, False)):
        monkeypatch.setattr(variant.ctypes, "CDLL", lambda name, cards=cards: Driver(cards))
        assert variant.nvidia() is there

    def missing(name: str) -> None:
        raise OSError(name)

    monkeypatch.setattr(variant.ctypes, "CDLL", missing)
    assert not variant.nvidia()


def test_moments_are_joined_by_what_is_seen_in_each() -> None:
    ones = np.ones((1, 2, 3), np.float32)
    first = tracing.Rays(2 * ones, ones, ones, 4 * ones, np.array([[1.0, 0.0]]))
    second = tracing.Rays(4 * ones, ones, -ones, 8 * ones, np.array([[1.0, 1.0]]))
    both = first.joined(second, 1)
    assert both.light.ravel() == pytest.approx(3.0) and both.normals.ravel() == pytest.approx(0.0)
    assert both.places[0, 0] == pytest.approx(6.0) and both.places[0, 1] == pytest.approx(8.0)
    assert both.seen.tolist() == [[1.0, 0.5]]
    again = both.joined(first, 2)
    assert again.light.ravel() == pytest.approx(8 / 3)


@pytest.mark.gl
def test_more_samples_are_denoised_better_and_lose_no_light(monkeypatch) -> None:
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><geom type='plane' size='1 1 .1'/><camera name='eye' pos='0 -2 1' xyaxes='1 0 0 0 0.4 1'/></worldbody></mujoco>"
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    seen = []

    class Watched(denoised.Denoiser):
        def __init__(self, width: int, height: int, card: bool, fine: bool) -> None:
            self.fine = fine
            super().__init__(width, height, card, fine)

        def clean(self, light, albedo, normal):
            seen.append((self.fine, float(light.max())))
            return super().clean(light, albedo, normal)

    def bright(self, *given, **named):
        guides.append(given[6])
        rays = there(self, *given, **named)
        rays.light[0, 0] = 100.0
        return rays

    guides, there = [], tracing.Tracing.trace
    monkeypatch.setattr(tracing, "Denoiser", Watched)
    monkeypatch.setattr(tracing.Tracing, "trace", bright)
    with Frames(model, 32, 18, "traced") as frames:
        for samples in (6, 18, 54, 162):
            frames.image(data, "eye", samples)
        assert frames.renderer == "traced", frames.reason
    assert seen == [(False, 12.0), (True, 12.0), (True, 100.0), (True, 100.0)]
    assert guides == [4, 16, 16, 16]


@pytest.mark.gl
def test_what_moves_is_seen_where_it_is_and_nowhere_else() -> None:
    spec = scene.new("ball", time_step=0.002, setting="studio")
    bodies.sphere(spec, "ball", diameter=0.6, pos=(0, 0, 1), look="phenolic_red")
    spec.worldbody.add_camera(name="eye", pos=(0, -4, 1), xyaxes=(1, 0, 0, 0, 0, 1))
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    middles = []
    with Frames(model, 96, 54, "traced") as frames:
        for x in (-0.8, 0.0, 0.9):
            data.qpos[0] = x
            mujoco.mj_forward(model, data)
            image = frames.image(data, "eye", 2).astype(int)
            red = np.nonzero(image[..., 0] - image[..., 1] > 60)
            middles.append(float(np.median(red[1])))
            assert len(red[1]) > 40 and (np.abs(red[1] - middles[-1]) < 8).mean() > 0.95
        assert frames.renderer == "traced", frames.reason
    assert middles[1] == pytest.approx(47.5, abs=1.5)
    assert middles[0] < 36 and middles[2] > 60


def test_the_denoiser_computes_on_the_processor_where_there_is_no_card() -> None:
    denoiser = denoised.Denoiser(32, 32, card=True)
    light = np.random.default_rng(2).random((32, 32, 3)).astype(np.float32)
    plain = denoised.Denoiser(32, 32)
    guides = np.full_like(light, 0.5), np.zeros_like(light)
    assert denoiser.card or np.array_equal(denoiser.clean(light, *guides), plain.clean(light, *guides))
    denoiser.close()
    plain.close()


def test_without_llvm_it_computes_plainly(monkeypatch, tmp_path) -> None:
    monkeypatch.setattr(variant, "FOLDERS", (tmp_path,))
    for name in ("libLLVM-16.so.1", "libLLVM-14.so"):
        (tmp_path / name).touch()
    assert variant.library() == "" or "llvm-" in variant.library()
    (tmp_path / "libLLVM.so.19.1").touch()
    assert variant.library().endswith("libLLVM.so.19.1")


@pytest.fixture(scope="module")
def glass():
    spec = scene.new("glass", time_step=0.002)
    bodies.box(spec, "behind", size=(0.05, 0.05, 1.0), pos=(0, 0.5, 0.5), look="plastic_red")
    bodies.sphere(spec, "lens", diameter=0.4, pos=(0.0, 0, 0.3), look="glass_clear")
    cameras.add(spec, "eye", subjects=("behind", "lens"))
    model = spec.compile()
    cameras.aim(model)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


@pytest.mark.gl
def test_missing_packages_are_named_and_the_usual_renderer_draws(glass, monkeypatch) -> None:
    def missing() -> str:
        raise variant.MissingRendererError("it needs Mitsuba", "mitsuba", variant.INSTALL)

    monkeypatch.setattr(variant, "choose", missing)
    monkeypatch.setenv(renderers.VARIABLE, "traced")
    with Frames(glass[0], 64, 36) as frames:
        assert frames.image(glass[1], "eye").std() > 5
        told = frames.told()
    assert told["name"] == "preview" and told["instead_of"] == "traced"
    assert "MissingRendererError" in told["because"] and "pip install 'worldwright[film]'" in told["because"]


@pytest.mark.gl
def test_glass_bends_what_is_behind_it(glass) -> None:
    model, data = glass
    eye = model.camera("eye").id
    data.cam_xpos[eye] = (0.12, -2.0, 0.3)
    data.cam_xmat[eye] = (1, 0, 0, 0, 0, -1, 0, 1, 0)
    model.cam_fovy[eye] = 20
    drawing = renderers.SEAM.find("traced").take(model, 160, 90)
    image = drawing.image(data, eye, "video").astype(float)
    drawing.close()
    red = (image[..., 0] > 1.5 * image[..., 1]).astype(float)
    columns = np.arange(160)

    def at(rows: slice) -> float:
        return float((red[rows] * columns).sum() / max(red[rows].sum(), 1))

    assert red[40:50].sum() > 20 and red[:15].sum() > 20
    assert abs(at(slice(40, 50)) - at(slice(0, 15))) > 3, "through the ball the bar stands elsewhere"


def test_looks_become_materials_of_their_kind() -> None:
    variant.choose()
    from worldengine.film.renderers.preview.finish import Finish

    spec = scene.new("looks", time_step=0.002)
    made = coatings.Coatings(spec.compile())
    grey = np.full(3, 0.5)
    assert "Principled" in str(made.of(Finish(materials.look("chrome")), grey, 1.0))
    assert "Dielectric" in str(made.of(Finish(materials.look("glass_clear")), grey, 0.2))
    assert made.of(Finish(materials.look("chrome")), grey, 1.0) is made.of(Finish(materials.look("chrome")), grey, 1.0)


def test_the_moments_of_a_moving_camera_fit_into_memory():
    assert glimpses.glimpses_apart(8, 1280 * 720) == 1
    for pixels in (1920 * 1080, 3840 * 2160, 1 << 26):
        kept = -(-32 // glimpses.glimpses_apart(32, pixels))
        assert kept == 1 or kept * 44 * pixels <= glimpses.GLIMPSES_BYTES


def test_only_meshes_of_any_shape_are_turned_to_the_eye_and_only_where_they_lean():
    class Params(dict):
        def update(self):
            self["told"] = self.get("told", 0) + 1

    figure = figures.Figure(None, np.zeros(3), geoms=[0, 1], meshed=[False, True], params=Params())
    figure.owner, figure.points = np.repeat([0, 1], 3), np.tile(np.eye(3), (2, 1))
    figure.normals, figure._any_shape = np.tile((0.1, 0, -0.995), (6, 1)), np.repeat([False, True], 3)
    data = SimpleNamespace(geom_xmat=np.tile(np.eye(3).ravel(), (2, 1)), geom_xpos=np.zeros((2, 3)))
    figure.place(data, np.ones(2))
    figure.face(np.array((0, 0, -50.0)))
    assert figure.params["told"] == 1, "what faces the eye is not handed over again"
    figure.face(np.array((-50.0, 0, 0)))
    normals = figure.params["vertex_normals"].reshape(-1, 3)
    assert figure.params["told"] == 2 and np.allclose(normals[:3], figure.normals[:3])
    assert (normals[3:, 0] < 0).all()
    figure.face(np.array((0, 0, -50.0)))
    assert np.allclose(figure.params["vertex_normals"].reshape(-1, 3), figure.normals), "and turned back again"
