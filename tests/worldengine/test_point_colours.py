"""Colours that an author's law gives to its points: recorded, driven again, and drawn by both renderers."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from hung_springs import Springs, run, world
from small_worlds import empty
from worldengine.film.drawn_frames import Frames
from worldengine.film.renderers.preview.soft_shapes import SoftShapes
from worldengine.recording import point_colours, stored
from worldengine.recording.replay import Replay
from worldkit import moved_shapes
from worldkit.errors import ProgramError

SIZE = (96, 64)
SIDE = 9


class Dyed(Springs):
    """Springs whose first point turns from red to blue."""

    def step(self, model, data, seconds):
        given = super().step(model, data, seconds)
        share = min(data.time / 0.15, 1.0)
        self.colours = np.array([(1.0 - share, 0.0, share), (0.2, 0.4, 0.6), (1.0, 1.0, 1.0)])
        return given

    def start(self, model, data):
        super().start(model, data)
        self.colours = np.array([(1.0, 0.0, 0.0), (0.2, 0.4, 0.6), (1.0, 1.0, 1.0)])


@pytest.fixture(scope="module")
def dyed(tmp_path_factory: pytest.TempPathFactory) -> stored.Recording:
    return run(tmp_path_factory.mktemp("dyed") / "out", Dyed())


def test_they_are_recorded_in_eight_bits_and_shown_in_between(dyed: stored.Recording) -> None:
    colour = dyed.media.colour.reshape(-1, 3)
    assert (colour[0] == (0xFF0000, 0x336699, 0xFFFFFF)).all() and colour[-1, 0] & 0xFF > 250
    assert point_colours.shares(colour[0]) == pytest.approx(np.array([(1, 0, 0), (0.2, 0.4, 0.6), (1, 1, 1)]))
    model = world().compile()
    Replay(model, dyed).show(15)
    halfway = (point_colours.shares(colour[1]) + point_colours.shares(colour[2])) / 2
    assert point_colours.of(model).flex == pytest.approx(halfway, abs=1e-6)


def test_a_replay_hands_them_on_and_keys_and_digests_depend_on_them(tmp_path: Path, dyed: stored.Recording) -> None:
    again, plain = run(tmp_path / "again", drive=dyed), run(tmp_path / "plain")
    assert (again.media.colour == dyed.media.colour).all()
    digests = [stored.inputs_digest(one.folder) for one in (dyed, again, plain)]
    assert digests[0] == digests[1] != digests[2], "in all else the two recordings are the same"
    assert dyed.sha256 == plain.sha256 and dyed.shown_sha256 != plain.shown_sha256
    assert (plain.media.colour == -1).all()


@pytest.mark.parametrize("colours", [np.full((3, 3), 1.5), np.zeros((2, 3)), np.full((3, 3), np.nan), ["red"] * 3])
def test_what_is_no_colour_is_refused_where_it_is_told(tmp_path: Path, colours) -> None:
    law = Springs()
    law.colours = colours
    with pytest.raises(ProgramError, match="colours"):
        run(tmp_path / "out", law)


def sheet() -> mujoco.MjModel:
    """A level sheet of a law's points, a metre wide, seen from above."""
    spec = empty()
    at = np.stack(np.meshgrid(*[np.linspace(-0.5, 0.5, SIDE)] * 2), -1).reshape(-1, 2)
    corner = np.arange(SIDE * (SIDE - 1)).reshape(-1, SIDE)[:, :-1].ravel()
    faces = np.concatenate(
        [np.stack([corner, corner + 1, corner + SIDE], 1), np.stack([corner + 1, corner + SIDE + 1, corner + SIDE], 1)]
    )
    moved_shapes.surface(spec, "sheet", np.column_stack([at, np.zeros(len(at))]), faces, look="paint_red")
    spec.worldbody.add_camera(name="above", pos=(0, 0, 1.5))
    return spec.compile()


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["preview", "traced"])
def test_both_renderers_draw_them_from_corner_to_corner(renderer: str) -> None:
    model = sheet()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    own, right = point_colours.of(model).flex, data.flexvert_xpos[:, :1] + 0.5
    own[:] = (1 - right) * (0.0, 0.9, 0.0) + right * (0.0, 0.0, 0.9)
    with Frames(model, *SIZE, renderer) as frames:
        quality = "still" if renderer == "preview" else 8
        first = frames.image(data, 0, quality).astype(int)
        own[:] = (0.9, 0.9, 0.0)
        second = frames.image(data, 0, quality).astype(int)
        assert frames.renderer == renderer, frames.reason
    row = first[SIZE[1] // 2]
    blue = row[..., 2] - row[..., 1]
    left, middle, end = (blue[at - 3 : at + 3].mean() for at in (30, 48, 66))
    assert left < -60 and end > 60 and left + 30 < middle < end - 30, (left, middle, end)
    assert row[30:66, 0].max() < 110, "nothing of the look's own red"
    centre = second[SIZE[1] // 2, SIZE[0] // 2]
    assert centre[0] > 120 and centre[1] > 120 and centre[2] < 90, "and they change"


def octahedra() -> mujoco.MjModel:
    """A large closed surface of a law's points, and a small one beside it, a bead."""
    spec = empty()
    ball = np.concatenate([np.eye(3), -np.eye(3)])
    faces = np.array([(0, 1, 2), (1, 3, 2), (3, 4, 2), (4, 0, 2), (1, 0, 5), (3, 1, 5), (4, 3, 5), (0, 4, 5)])
    points = np.concatenate([0.3 * ball, 0.1 * ball + (0.55, 0, 0)])
    moved_shapes.surface(spec, "ball", points, np.concatenate([faces, faces + 6]), look="paint_red")
    spec.worldbody.add_camera(name="above", pos=(0, 0, 1.5))
    return spec.compile()


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["preview", "traced"])
def test_a_closed_surface_has_the_colours_of_its_corners_and_so_has_its_bead(renderer: str) -> None:
    model = octahedra()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    own = point_colours.of(model).flex
    own[:6] = np.where(data.flexvert_xpos[:6, :1] < -0.1, (0.0, 0.9, 0.0), (0.0, 0.0, 0.9))
    own[6:] = (0.9, 0.9, 0.0)
    with Frames(model, *SIZE, renderer) as frames:
        image = frames.image(data, 0, "still" if renderer == "preview" else 8).astype(int)
        assert frames.renderer == renderer, frames.reason
    assert SoftShapes(model).is_closed(0)
    row = image[SIZE[1] // 2 - 1]
    left, right = (row[at : at + 3].mean(axis=0) for at in (34, 54))
    assert left[1] > left[2] + 20 and right[2] > right[1] + 60, (left, right)
    bead = row[72:76].mean(axis=0)
    assert min(bead[:2]) > bead[2] + 60, bead
