"""What every renderer must do, whichever it is: the seam's contract, on one small world."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from worldengine.film import identity, renderers
from worldkit import bodies, cameras, scene
from worldkit.errors import SeamError
from worldkit.seams import Seam

pytestmark = pytest.mark.gl
WIDTH, HEIGHT = 160, 90


@pytest.fixture(scope="module")
def world():
    spec = scene.new("renderers", time_step=0.002)
    bodies.sphere(spec, "ball", diameter=0.4, pos=(0, 0, 0.2))
    bodies.box(spec, "box", size=(0.3, 0.3, 0.3), pos=(0.7, 0, 0.15))
    cameras.add(spec, "eye", subjects=("ball", "box"))
    model = spec.compile()
    cameras.aim(model)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


@pytest.fixture(scope="module", params=renderers.SEAM.names())
def drawing(request, world):
    taken = renderers.SEAM.find(request.param).take(world[0], WIDTH, HEIGHT)
    yield taken
    taken.close()


@pytest.mark.parametrize("quality", ["still", "video"])
def test_a_picture_is_rgb_of_the_size_asked_for_and_shows_something(drawing, world, quality) -> None:
    image = drawing.image(world[1], 0, quality)
    assert image.shape == (HEIGHT, WIDTH, 3) and image.dtype == np.uint8
    assert image.std() > 10


def test_the_same_state_gives_the_same_picture_whatever_was_drawn_between(drawing, world) -> None:
    model, data = world
    first = drawing.image(data, 0, "video")
    other = mujoco.MjData(model)
    other.qpos[:] = data.qpos
    other.qpos[2] += 0.3
    mujoco.mj_forward(model, other)
    assert not np.array_equal(drawing.image(other, 0, "video"), first), "what moved is seen to have moved"
    drawing.segmentation(data, 0)
    drawing.image(data, 0, "still")
    assert np.array_equal(drawing.image(data, 0, "video"), first)


def test_a_treatment_changes_the_picture_or_is_declined(drawing, world) -> None:
    from worldengine.film.treatment import PLAIN, Treatment

    _, data = world
    plain = drawing.image(data, 0, "video")
    told = drawing.treat(Treatment(grade_exposure_stops=2.0, light_azimuth_deg=60.0))
    assert np.array_equal(drawing.image(data, 0, "video"), plain) != told
    assert drawing.treat(PLAIN) == told
    assert np.array_equal(drawing.image(data, 0, "video"), plain)


def test_segmentation_tells_the_geom_behind_each_pixel(drawing, world) -> None:
    model, data = world
    found = drawing.segmentation(data, 0)
    assert found.shape == (HEIGHT, WIDTH) and found.dtype == np.int32
    with mujoco.Renderer(model, HEIGHT, WIDTH) as reference:
        reference.enable_segmentation_rendering()
        reference.update_scene(data, 0)
        pairs = reference.render()
    told = np.where(pairs[..., 1] == int(mujoco.mjtObj.mjOBJ_GEOM), pairs[..., 0], -1)
    for name in ("ball", "box"):
        mine, theirs = found == model.geom(name).id, told == model.geom(name).id
        assert theirs.sum() > 50
        assert (mine & theirs).sum() / (mine | theirs).sum() > 0.9, name


@pytest.mark.parametrize("name", renderers.SEAM.names())
def test_a_version_names_packages_and_code(name: str) -> None:
    said = identity.renderer_version(name)
    installed = renderers.installed(renderers.SEAM.find(name).PACKAGES)
    assert installed
    assert all(f"{package} {number}" in said for package, number in installed.items()) and "code " in said
    assert identity.identity(name).sha256 == identity.identity(name).sha256


@pytest.mark.parametrize("name", renderers.SEAM.names())
@pytest.mark.parametrize(
    "touched",
    [
        "worldkit/materials/catalogue.py", "worldkit/materials/paint/wood.py", "worldkit/settings.py",
        "worldkit/model_text.py", "worldengine/recording/seen.py", "worldengine/film/panel_lights.py",
        "worldkit/cameras/aiming.py", "worldkit/turning.py", "worldkit/forms/lattice.py", "worldengine/recording/replay.py", "worldengine/film/directed.py", "worldengine/film/renderers/__init__.py",
        "worldengine/film/renderers/preview/things.py", "worldengine/film/renderers/preview/shaders/surface.frag",
    ],
)  # fmt: skip
def test_whatever_makes_its_pictures_is_in_the_version_of_a_renderer_and_in_the_identity(name, touched, monkeypatch):
    def said() -> tuple[str, str]:
        return identity.renderer_version(name), identity.identity(name).sha256

    monkeypatch.setattr(
        identity, "_hash", identity._hash.__wrapped__
    )  # which is remembered while no file's time changes
    before, read = said(), Path.read_bytes
    edited = Path(identity.__file__).parents[2] / touched
    assert edited.is_file()
    monkeypatch.setattr(Path, "read_bytes", lambda path: read(path) + b"#" * (path.resolve() == edited.resolve()))
    changed = name != "classic" or "/preview/" not in touched
    assert [a != b for a, b in zip(before, said(), strict=True)] == [changed, changed]


def test_a_file_that_changes_is_read_anew(tmp_path) -> None:
    def said() -> str:
        stat = path.stat()
        return identity._hash(((path, stat.st_size, stat.st_mtime_ns),))

    path = tmp_path / "shader.frag"
    path.write_text("one")
    before = said()
    assert said() == before
    path.write_text("another")
    assert said() != before


def test_the_shelf_names_what_is_missing(tmp_path, monkeypatch) -> None:
    with pytest.raises(SeamError, match="no renderer 'etching'") as unknown:
        renderers.SEAM.find("etching")
    assert "classic, preview" in unknown.value.next_move
    package = tmp_path / "atelier"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / "etching.py").write_text('"""Lines on copper."""\n\nPACKAGES = ()\n')
    (package / "silent.py").write_text("PACKAGES = ()\n\n\ndef take(model, width, height):\n    return None\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    seam: Seam[renderers.Renderer] = Seam("atelier", renderers.Renderer, "renderer")
    assert seam.names() == ("etching", "silent") and seam.members() == ("PACKAGES", "take")
    with pytest.raises(SeamError, match=r"etching\.py:1: it must define take"):
        seam.find("etching")
    with pytest.raises(SeamError, match=r"silent\.py:1: it needs a docstring"):
        seam.find("silent")
    assert [path.name for path in seam.files("etching")] == ["etching.py"]
