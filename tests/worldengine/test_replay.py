"""Pictures come from recorded rows, and from nothing else."""

import json

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor, heap, record
from worldengine.film.encode import Video, write_png
from worldengine.film.passes import visible
from worldengine.recording.replay import Replay, frame_rows
from worldkit import program
from worldkit.errors import RecordingError


def test_a_row_is_shown_exactly_as_it_was(tmp_path):
    spec = heap()
    recording = record(spec, tmp_path / "t", 200)
    replay = Replay(spec.compile(), recording)
    for row in (0, 200, 57):
        data = replay.show(row)
        assert np.array_equal(data.xpos[1:], recording.pos[row])
        assert data.time == recording.time[row]


def test_edits_of_the_model_are_followed_forwards_and_backwards(tmp_path):
    spec = empty()
    ball(spec, "ball", (0, 0, 1))

    def glow(model, data):
        model.geom_rgba[0, 0] = min(1.0, data.time * 100)
        model.opt.gravity[2] = -1.0

    recording = record(spec, tmp_path / "t", 20, glow)
    model = spec.compile()
    initial = model.geom_rgba[0, 0]
    replay = Replay(model, recording)
    for row, red in ((0, 0.0), (5, 0.5), (15, 1.0), (3, 0.3), (20, 1.0), (0, 0.0)):
        replay.show(row)
        assert model.geom_rgba[0, 0] == pytest.approx(red, abs=1e-6)
    assert model.opt.gravity[2] == -9.81
    assert initial == 0.5


def test_pictures_of_another_colour_are_not_those_of_this_recording(tmp_path):
    spec = empty()
    ball(spec, "ball", (0, 0, 1))

    def painted(colour):
        def control(model, data):
            model.geom_rgba[0, :3] = colour

        return control

    red, again, green = (
        record(spec, tmp_path / f"{n}", 5, painted(colour))
        for n, colour in enumerate(((1, 0, 0), (1, 0, 0), (0, 1, 0)))
    )
    assert red.sha256 == green.sha256  # it falls alike
    assert red.shown_sha256 == again.shown_sha256 != green.shown_sha256
    plain = record(spec, tmp_path / "plain", 5)
    assert plain.shown_sha256 == plain.sha256 not in (red.shown_sha256, green.shown_sha256)


def test_another_world_s_recording_is_refused(tmp_path):
    recording = record(heap(6), tmp_path / "t", 5)
    with pytest.raises(RecordingError, match="another world"):
        Replay(heap(7).compile(), recording)


def test_frames_show_the_nearest_row_and_last_as_long_as_the_recording():
    time = np.arange(0, 2.0001, 0.001)
    rows = frame_rows(time, 24)
    assert len(rows) == 48
    np.testing.assert_allclose(time[rows], np.arange(48) / 24, atol=0.00051)
    assert frame_rows(np.array([0.0, 0.001]), 24).tolist() == [0]
    assert frame_rows(np.array([0.0, 1.0]), 4).tolist() == [0, 0, 0, 1]


def test_visibility_counts_pixels_per_body():
    model = heap(2).compile()
    geoms = np.full((10, 20), -1)
    geoms[2:5, 3:7] = 1
    geoms[9] = 0
    found = visible(model, geoms)
    assert found["ball_0"] == {"pixels": 12, "fraction": 12 / 200, "box": [3, 2, 6, 4]}
    assert found["world"]["pixels"] == 20
    assert "box_1" not in found


def decode(path):
    import av

    with av.open(str(path)) as container:
        stream = container.streams.video[0]
        frames = [frame.to_ndarray(format="rgb24") for frame in container.decode(stream)]
        return frames, stream.codec_context.name, stream.codec_context.pix_fmt, float(stream.average_rate)


@pytest.mark.parametrize(("joined", "shown"), [(True, {"cloth": 5}), (False, {"cloth": 2, "cloth (flex)": 3})])
def test_a_flex_of_a_bodys_name_takes_none_of_its_pixels(joined, shown):
    cloth = (
        """<flexcomp name="cloth" type="grid" count="3 3 1" spacing="0.1 0.1 0.1" dim="2" mass="1" radius="0.01"/>"""
    )
    inside, outside = (cloth, "") if joined else ("", cloth)
    model = mujoco.MjModel.from_xml_string(
        f"""<mujoco><worldbody><body name="cloth"><geom size="0.1"/>{inside}</body>{outside}</worldbody></mujoco>"""
    )
    geoms = np.full((4, 4), -1)
    geoms[0, :2], geoms[1, :3] = 0, -2
    found = visible(model, geoms)
    assert {name: facts["pixels"] for name, facts in found.items()} == shown
    assert found["cloth"]["box"] == ([0, 0, 2, 1] if joined else [0, 0, 1, 0])


def test_a_video_is_what_was_drawn(tmp_path):
    colours = [(200, 30, 30), (30, 160, 40), (40, 60, 200), (240, 240, 240), (10, 10, 10)]
    with Video(tmp_path / "film.mp4", 64, 48, 24) as film:
        for colour in colours:
            film.add(np.full((48, 64, 3), colour, np.uint8))
            assert not (tmp_path / "film.mp4").exists()
    frames, codec, pixels, rate = decode(tmp_path / "film.mp4")
    assert (codec, pixels, rate, len(frames)) == ("h264", "yuv420p", 24.0, 5)
    content = (tmp_path / "film.mp4").read_bytes()
    assert content.index(b"moov") < content.index(b"mdat")  # the index comes first
    import cv2

    reader = cv2.VideoCapture(str(tmp_path / "film.mp4"))
    shown = [reader.read()[1][24, 32, ::-1] for _ in colours]
    for colour, seen in zip(colours, shown, strict=True):
        np.testing.assert_allclose(seen.astype(int), colour, atol=12)
    assert [p.name for p in tmp_path.iterdir()] == ["film.mp4"]


def test_a_video_that_fails_leaves_nothing(tmp_path):
    def film():
        with Video(tmp_path / "film.mp4", 64, 48, 24) as video:
            video.add(np.zeros((48, 64, 3), np.uint8))
            raise RuntimeError("the renderer gave up")

    with pytest.raises(RuntimeError, match="gave up"):
        film()
    assert list(tmp_path.iterdir()) == []


def test_a_png_is_lossless(tmp_path):
    import cv2

    image = np.random.default_rng(0).integers(0, 256, (48, 64, 3), np.uint8)
    write_png(tmp_path / "still.png", image)
    assert np.array_equal(cv2.imread(str(tmp_path / "still.png"))[..., ::-1], image)


@pytest.mark.gl
def test_the_passes_draw_every_camera_without_stepping_the_physics(tmp_path, monkeypatch):
    def build():
        from worldkit import cameras, scene

        spec = scene.new("test", time_step=0.002)
        ball(spec, "ball", (0, 0, 0.5), rgba=(1, 0, 0, 1))
        cameras.add(spec, "overview", view="perspective", subjects=("ball",))
        cameras.add(spec, "side", view="side_minus_y", subjects=("ball",), follow=True)
        return spec

    settings = {"duration": 0.3, "fps": 10, "size": (320, 240), "movers": ("ball",)}
    physics = tmp_path / "physics"
    assert program.main(build, argv=["--pass", "physics", "--out", str(physics)], **settings) == 0
    for name in ("mj_step", "mj_step1", "mj_step2", "mj_forwardSkip"):
        monkeypatch.setattr(mujoco, name, lambda *_, name=name: pytest.fail(f"{name} was called"))
    out = tmp_path / "still"
    arguments = ["--out", str(out), "--from", str(physics / "trajectory")]
    assert program.main(build, argv=["--pass", "still", *arguments], **settings) == 0
    seen = json.loads((out / "visibility.json").read_text())
    assert set(seen) == {"overview", "side"}
    assert seen["overview"]["ball"]["pixels"] > 20
    assert (out / "overview.png").exists() and (out / "side.png").exists()
    result = json.loads((out / "result.json").read_text())
    assert result["cameras"] == ["overview", "side"] and result["same_model"] is True
    out = tmp_path / "video"
    arguments = ["--out", str(out), "--from", str(physics), "--camera", "side"]
    assert program.main(build, argv=["--pass", "video", *arguments], **settings) == 0
    frames, _, _, rate = decode(out / "side.mp4")
    assert (len(frames), rate, frames[0].shape) == (3, 10.0, (240, 320, 3))
    assert json.loads((out / "result.json").read_text())["frames"] == 3
    assert not (out / "overview.mp4").exists()


def test_a_floor_alone_can_be_recorded_and_shown(tmp_path):
    spec = empty()
    floor(spec)
    recording = record(spec, tmp_path / "t", 3)
    assert Replay(spec.compile(), recording).show(3).time == pytest.approx(0.003)
