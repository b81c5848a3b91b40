import subprocess
import sys

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldengine.film.drawn_frames import Frames
from worldengine.film.film_curve import film_curve
from worldengine.film.passes import visible
from worldengine.film.treatment import Treatment
from worldkit import cameras, materials, scene

pytestmark = pytest.mark.gl
G = mujoco.mjtGeom
SIZE = (320, 180)


def put(spec, name, kind, size, pos, look, free=False, **options):
    body = spec.worldbody.add_body(name=name, pos=pos, quat=options.pop("quat", (1, 0, 0, 0)))
    if free:
        body.add_freejoint()
    body.add_geom(name=name, type=kind, size=size, material=materials.add(spec, look), **options)
    return body


def still_life(setting="studio", floor=None):
    spec = scene.new("still life", time_step=0.002, setting=setting, floor=floor)
    put(spec, "ball", G.mjGEOM_SPHERE, (0.15, 0, 0), (0, 0, 0.15), "plastic_red")
    put(spec, "box", G.mjGEOM_BOX, (0.12, 0.1, 0.2), (0.4, 0.1, 0.2), "wood_oak")
    put(spec, "can", G.mjGEOM_CYLINDER, (0.08, 0.14, 0), (-0.4, 0, 0.14), "steel_brushed")
    put(spec, "pill", G.mjGEOM_CAPSULE, (0.06, 0.1, 0), (0.1, -0.35, 0.06), "ceramic_blue", quat=(0.7, 0, 0.7, 0))
    put(spec, "egg", G.mjGEOM_ELLIPSOID, (0.08, 0.08, 0.12), (-0.2, -0.3, 0.12), "glass_clear")
    cameras.add(spec, "eye", subjects=("ball", "box", "can", "pill", "egg"))
    model = spec.compile()
    cameras.aim(model)
    return model, posed(model)


def posed(model):
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return data


def bright(image):
    return image.astype(float) @ (0.2126, 0.7152, 0.0722)


@pytest.fixture(scope="module")
def studio():
    model, data = still_life()
    with Frames(model, *SIZE) as frames:
        yield model, data, frames


def test_our_own_shaders_draw(studio):
    _, _, frames = studio
    frames.image(studio[1], "eye")
    assert (frames.renderer, frames.reason) == ("preview", "")


@pytest.mark.parametrize("setting", ["studio", "room", "outdoor", "dark"])
def test_every_setting_is_exposed_within_range(setting):
    model, data = still_life(setting)
    with Frames(model, *SIZE) as frames:
        image = frames.image(data, "eye")
        assert frames.renderer == "preview", frames.reason
    assert image.shape == (180, 320, 3) and image.dtype == np.uint8
    level = bright(image)
    low, high = (25, 130) if setting == "dark" else (70, 190)
    assert low < level.mean() < high
    assert level.std() > 14, "a picture needs contrast"
    assert (level > 253).mean() < 0.02, "no burnt-out areas"
    assert (level < 4).mean() < 0.05, "no black holes, no black horizon"


def test_the_same_state_gives_the_same_picture_in_any_order(studio):
    model, data, frames = studio
    first = frames.image(data, "eye")
    other = posed(model)
    other.geom_xpos[model.geom("ball").id] += (0.2, 0.1, 0.3)
    frames.image(other, "eye")
    frames.image(data, "eye", quality="still")
    assert np.array_equal(first, frames.image(data, "eye"))
    with Frames(model, *SIZE) as again:
        assert np.array_equal(first, again.image(data, "eye"))


def test_stills_are_the_same_view_in_finer_quality(studio):
    _, data, frames = studio
    video, still = (frames.image(data, "eye", quality=q).astype(float) for q in ("video", "still"))
    assert still.shape == video.shape
    assert np.abs(still - video).mean() < 4.0


def test_shadows_soften_away_from_what_casts_them():
    """The penumbra of a high edge is wider than that of a low one."""
    spec = scene.new("shadows", time_step=0.002, floor="paper")
    put(spec, "low", G.mjGEOM_BOX, (0.2, 0.2, 0.05), (-0.5, 0, 0.05), "plastic_white")
    put(spec, "high", G.mjGEOM_BOX, (0.2, 0.2, 0.05), (0.6, 0, 1.15), "plastic_white")
    cameras.add(spec, "eye", position=(0.5, 0.9, 3.6), target=(0.5, 0.9, 0), fovy=40)
    model = spec.compile()
    with Frames(model, 640, 360) as frames:
        level = bright(frames.image(posed(model), "eye", quality="still"))
        numbers = frames.segmentation(posed(model), "eye")
    ground = numbers == model.geom("ground").id

    def width(rows, columns):
        """Pixels over which the steepest fall to the darkest value on a column takes place, on the ground alone."""
        widths = []
        for column in columns:
            line = np.where(ground[rows, column], level[rows, column], np.nan)
            line = line[np.isfinite(line)]
            span = line.max() - line.min()
            if span > 20:
                widths.append(span / np.abs(np.diff(line)).max())
        return float(np.median(widths))

    data = posed(model)

    def pixel(point):
        local = (np.array(point) - data.cam_xpos[0]) @ data.cam_xmat[0].reshape(3, 3)
        half = np.tan(np.radians(20))
        return 180 - local[1] / -local[2] / half * 180, 320 + local[0] / -local[2] / half * 180

    # The key light stands at azimuth -122, elevation 50: shadows fall toward azimuth 58.
    away = np.array([np.cos(np.radians(58)), np.sin(np.radians(58)), 0]) / np.tan(np.radians(50))
    widths = []
    for centre, top in (((-0.5, 0.2, 0), 0.1), ((0.6, 0.2, 0), 1.2)):
        edge = np.array(centre) + away * top
        row, column = pixel(edge)
        rows = slice(max(int(row) - 45, 0), int(row) + 45)
        widths.append(width(rows, range(int(column) - 6, int(column) + 6)))
    assert widths[1] > 1.8 * widths[0]


def test_contact_darkens_the_floor():
    """Just beside a resting ball the floor is darker than farther away, on the lit side as well."""
    spec = scene.new("contact", time_step=0.002, floor="paper")
    put(spec, "ball", G.mjGEOM_SPHERE, (0.3, 0, 0), (0, 0, 0.3), "plastic_white")
    cameras.add(spec, "eye", position=(-0.9, -2.0, 1.2), target=(-0.1, -0.2, 0.1))
    model = spec.compile()
    data = posed(model)
    with Frames(model, *SIZE) as frames:
        level = bright(frames.image(data, "eye", quality="still"))
        ball = frames.segmentation(data, "eye") == model.geom("ball").id
    column = int(np.flatnonzero(ball.any(axis=0)).mean())
    bottom = int(np.flatnonzero(ball[:, column]).max())
    assert level[bottom + 1 : bottom + 4, column].mean() < 0.92 * level[bottom + 30 : bottom + 34, column].mean()


def test_a_lit_floor_is_smooth_not_speckled():
    spec = scene.new("floor", time_step=0.002, floor="#b0a090")
    put(spec, "box", G.mjGEOM_BOX, (0.2, 0.2, 0.2), (0, 0, 0.2), "#8090a0")
    cameras.add(spec, "eye", subjects=("box",))
    model = spec.compile()
    cameras.aim(model)
    data = posed(model)
    with Frames(model, *SIZE) as frames:
        level = bright(frames.image(data, "eye"))
    inner = level[2:-2, 2:-2]
    around = np.stack(
        [level[2 + y : level.shape[0] - 2 + y, 2 + x : level.shape[1] - 2 + x] for y in (-2, 2) for x in (-2, 2)]
    )
    lonely = (inner > around.max(axis=0) + 25) | (inner < around.min(axis=0) - 25)
    assert lonely.mean() < 0.003


def test_surroundings_do_not_band():
    """Neighbouring pixels of a smooth backdrop never differ by more than dither."""
    spec = scene.new("backdrop", time_step=0.002)
    put(spec, "ball", G.mjGEOM_SPHERE, (0.15, 0, 0), (0, 0, 0.15), "plastic_red")
    cameras.add(spec, "eye", position=(2, -2, 0.5), target=(0, 0, 1.0))
    model = spec.compile()
    data = posed(model)
    with Frames(model, *SIZE) as frames:
        image = frames.image(data, "eye").astype(int)
        sky = frames.segmentation(data, "eye") == -1
    steps = np.abs(np.diff(image, axis=1)).max(axis=2)[sky[:, 1:] & sky[:, :-1]]
    assert steps.size > 100 and np.percentile(steps, 99) <= 3


place = st.tuples(st.floats(-1, 1), st.floats(-1, 1), st.floats(0.3, 1.2))


@given(st.lists(st.tuples(st.sampled_from("SCEYB"), place, st.integers(0, 1000)), min_size=1, max_size=6))
@settings(max_examples=8, deadline=None)
def test_segmentation_agrees_with_mujocos_own(things):
    kinds = {
        "S": G.mjGEOM_SPHERE,
        "C": G.mjGEOM_CAPSULE,
        "E": G.mjGEOM_ELLIPSOID,
        "Y": G.mjGEOM_CYLINDER,
        "B": G.mjGEOM_BOX,
    }
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(name="ground", type=G.mjGEOM_PLANE, size=(3, 3, 1))
    for kind, pos, seed in things:
        generator = np.random.default_rng(seed)
        body = spec.worldbody.add_body(pos=pos, quat=generator.normal(size=4))
        body.add_geom(type=kinds[kind], size=generator.uniform(0.08, 0.3, 3))
    spec.worldbody.add_camera(name="eye", pos=(0, -4, 1.6), xyaxes=None, quat=(0.76, 0.65, 0, 0))
    model = spec.compile()
    data = posed(model)
    with Frames(model, *SIZE) as frames:
        ours = frames.segmentation(data, "eye")
        assert frames.renderer == "preview"
    with mujoco.Renderer(model, SIZE[1], SIZE[0]) as renderer:
        renderer.enable_segmentation_rendering()
        renderer.update_scene(data, "eye")
        pairs = renderer.render()
    theirs = np.where(pairs[..., 1] == int(mujoco.mjtObj.mjOBJ_GEOM), pairs[..., 0], -1)
    assert (ours == theirs).mean() > 0.985


def test_meshes_height_fields_tendons_and_flexes_are_drawn():
    spec = scene.new("shapes", time_step=0.002)
    corners = np.array([(x, y, z) for x in (0, 0.3) for y in (0, 0.3) for z in (0, 0.3)], dtype=float)
    spec.add_mesh(name="cube", uservert=corners.ravel())
    spec.worldbody.add_geom(
        name="mesh", type=G.mjGEOM_MESH, meshname="cube", pos=(-0.8, 0, 0.2), rgba=(0.9, 0.1, 0.1, 1)
    )
    grid = np.outer(np.sin(np.linspace(0, 3, 12)), np.sin(np.linspace(0, 3, 12)))
    spec.add_hfield(name="hill", nrow=12, ncol=12, size=(0.3, 0.3, 0.3, 0.05), userdata=grid.ravel())
    spec.worldbody.add_geom(
        name="hill", type=G.mjGEOM_HFIELD, hfieldname="hill", pos=(0, 0, 0.06), rgba=(0.1, 0.9, 0.1, 1)
    )
    for x in (0.6, 1.0):
        spec.worldbody.add_site(name=f"peg{x}", pos=(x, 0, 0.5))
    rope = spec.add_tendon(name="rope", width=0.03, rgba=(0.1, 0.1, 0.9, 1))
    rope.wrap_site("peg0.6")
    rope.wrap_site("peg1.0")
    cameras.add(spec, "eye", position=(0, -2.6, 1.0), target=(0, 0, 0.2), fovy=45)
    model = spec.compile()
    data = posed(model)
    with Frames(model, *SIZE) as frames:
        image = frames.image(data, "eye").astype(int)
        numbers = frames.segmentation(data, "eye")
        assert frames.renderer == "preview", frames.reason
    assert (numbers == model.geom("mesh").id).sum() > 200 and (numbers == model.geom("hill").id).sum() > 200
    for channel in range(3):
        others = image[..., [c for c in range(3) if c != channel]].max(axis=2)
        assert (image[..., channel] > others + 40).sum() > 60


def test_a_cloth_is_drawn_where_it_hangs():
    xml = """<mujoco><worldbody><light pos="0 0 3"/><camera name="eye" pos="0 -2 1" xyaxes="1 0 0 0 0 1"/>
    <flexcomp name="cloth" type="grid" count="6 6 1" spacing="0.15 0.15 0.15" pos="0 0 1" quat="0.707 0.707 0 0"
      dim="2" mass="1" radius="0.01" rgba="0.9 0.1 0.1 1"><contact selfcollide="none"/></flexcomp></worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(xml)
    with Frames(model, *SIZE) as frames:
        image = frames.image(posed(model), "eye").astype(int)
        seen = visible(model, frames.segmentation(posed(model), "eye"))["cloth"]
        assert frames.renderer == "preview", frames.reason
    red = (image[..., 0] > image[..., 1] + 50) & (image[..., 0] > image[..., 2] + 50)
    rows, columns = np.nonzero(red)
    assert seen["pixels"] == pytest.approx(red.sum(), rel=0.05)
    assert 2000 < red.sum() < 20000
    assert abs(rows.mean() - 90) < 12 and abs(columns.mean() - 160) < 12


def test_a_cloth_wears_its_material():
    """MuJoCo 4 keeps a flex's material by element, and its scene names none."""
    spec = scene.new("cloth", time_step=0.002)
    flex = spec.worldbody.make_flex(
        "cloth", type="grid", dim=2, count=(6, 6, 1), spacing=(0.15, 0.15, 0.15), pos=(0, 0, 1), radius=0.01
    )
    flex.material = [materials.add(spec, "fabric_red")]
    cameras.add(spec, "eye", position=(0, -1.2, 2.2), target=(0, 0, 1), fovy=45)
    model = spec.compile()
    with Frames(model, *SIZE) as frames:
        image = frames.image(posed(model), "eye").astype(int)
        assert frames.renderer == "preview", frames.reason
    red = (image[..., 0] > image[..., 1] + 30) & (image[..., 0] > image[..., 2] + 30)
    assert red.sum() > 2000


def test_outlines_are_smooth_where_a_film_wants_them():
    """Drawn once in each pixel, what is thin and slants was dashed."""
    spec = scene.new("wires", time_step=0.002, setting="studio")
    turn = (np.cos(0.05), 0.0, np.sin(0.05), 0.0)
    put(spec, "wire", G.mjGEOM_CYLINDER, (0.0015, 0.5, 0), (0, 0, 0.6), "plastic_black", quat=turn)
    cameras.add(spec, "eye", view="side_minus_y", subjects=("wire",))
    model = spec.compile()
    cameras.aim(model, aspect=16 / 9)
    data = posed(model)

    def stairs(outlines):
        """How far the wire's middle is beside a straight line, pixels."""
        with Frames(model, 960, 540) as frames:
            frames.treat(Treatment(grade_outlines=outlines))
            image = frames.image(data, "eye", quality="video")
        light = bright(image)[200:340, 400:560]
        rows, across = np.arange(len(light)), np.arange(light.shape[1])
        line = np.polyval(np.polyfit(rows, light.argmin(axis=1), 1), rows)
        dark = np.where(np.abs(across - line[:, None]) < 4, light.max(axis=1, keepdims=True) - light - 8, 0).clip(0)
        middle = (dark * across).sum(axis=1) / dark.sum(axis=1)
        return np.std(middle - np.polyval(np.polyfit(rows, middle, 1), rows))

    assert stairs(1.0) < 0.6 * stairs(0.0)


def test_coplanar_faces_do_not_flicker():
    """Of two faces in one plane the later geom shows everywhere, from any side."""
    spec = scene.new("coplanar", time_step=0.002)
    put(spec, "under", G.mjGEOM_BOX, (0.5, 0.5, 0.1), (0, 0, 0.1), "#ff0000")
    put(spec, "over", G.mjGEOM_BOX, (0.3, 0.3, 0.1), (0, 0, 0.1), "#00ff00")
    for number, eye in enumerate([(2, -2, 1.2), (-1, -3, 0.7), (0.3, 0.2, 3)]):
        cameras.add(spec, f"eye{number}", position=eye, target=(0, 0, 0.2))
    model = spec.compile()
    data = posed(model)
    over = model.geom("over").id
    with Frames(model, *SIZE) as frames:
        for number in range(3):
            mask = frames.segmentation(data, f"eye{number}") == over
            rows = np.flatnonzero(mask.any(axis=1))
            filled = sum(np.ptp(np.flatnonzero(mask[row])) + 1 for row in rows)
            assert mask.sum() == filled, "holes inside a convex face"


def test_collision_hulls_stay_hidden(studio):
    spec = scene.new("hidden", time_step=0.002)
    put(spec, "hull", G.mjGEOM_SPHERE, (0.5, 0, 0), (0, 0, 0.5), "plastic_red", group=3)
    cameras.add(spec, "eye", position=(2, -2, 1), target=(0, 0, 0.5))
    model = spec.compile()
    with Frames(model, *SIZE) as frames:
        assert model.geom("hull").id not in frames.segmentation(posed(model), "eye")


def test_mistakes_are_named(studio):
    model, data, frames = studio
    with pytest.raises(ValueError, match=r"no camera is called 'ear'.*eye"):
        frames.image(data, "ear")
    with pytest.raises(ValueError, match="quality"):
        frames.image(data, "eye", quality="best")
    with pytest.raises(ValueError, match="8 x 8"):
        Frames(model, 4, 4)
    closed = Frames(model, *SIZE)
    closed.close()
    closed.close()
    with pytest.raises(RuntimeError, match="closed"):
        closed.image(data, "eye")


def test_the_plain_renderer_takes_over(monkeypatch):
    monkeypatch.setenv("WORLDKIT_RENDERER", "classic")
    model, data = still_life()
    with Frames(model, *SIZE) as frames:
        assert frames.renderer == "classic"
        assert bright(frames.image(data, "eye", quality="still")).std() > 10
        assert model.geom("ball").id in frames.segmentation(data, "eye")


@pytest.mark.parametrize("stage", ["Pipeline", "image"])
def test_a_driver_that_gives_up_leads_to_the_plain_renderer(monkeypatch, stage):
    from worldengine.film.renderers.preview import pipeline

    def refuse(*_):
        raise RuntimeError("no such extension")

    if stage == "image":
        monkeypatch.setattr(pipeline.Pipeline, "image", refuse)
    else:
        monkeypatch.setattr(pipeline, "Pipeline", refuse)
    model, data = still_life()
    with Frames(model, *SIZE) as frames:
        assert frames.image(data, "eye").std() > 10
        assert frames.renderer == "classic" and "no such extension" in frames.reason


@given(st.floats(0, 20), st.floats(0, 20))
def test_the_film_curve_rises_and_stays_in_range(a, b):
    low, high = sorted((a, b))
    developed = film_curve(np.array([low, high]))
    assert 0 <= developed[0] <= developed[1] + 1e-12 <= 1 + 1e-9


def test_importing_render_loads_no_heavy_library():
    code = "import sys, worldengine.film.drawn_frames; sys.exit(any(m in sys.modules for m in ('mujoco', 'cv2', 'OpenGL')))"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
