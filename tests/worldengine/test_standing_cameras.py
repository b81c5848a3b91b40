"""A recording tells where each camera stands over it; one that rides on a body has no one place."""

import json

import mujoco
import numpy as np

from small_worlds import ball, empty, floor, record
from worldengine.recording import standing_cameras
from worldkit import cameras
from worldwright.model.recording.trajectory_files import read_trajectory


def test_the_recording_knows_where_its_cameras_stand(tmp_path):
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.5))
    cameras.add(spec, "side", view="side_minus_y", subjects=["ball"])
    cameras.add(spec, "with_it", subjects=["ball"], follow=True)
    spec.body("ball").add_camera(name="rider")
    spec.worldbody.add_camera()  # nameless
    spec.worldbody.add_camera(name="flat", proj=mujoco.mjtProjection.mjPROJ_ORTHOGRAPHIC)
    model = spec.compile()
    recording = record(spec.compile(), tmp_path / "t", 200)
    standing_cameras.write(model, recording, (320, 180), tmp_path / "t")
    found = read_trajectory(tmp_path / "t").cameras
    assert set(found) == {"side", "with_it"}
    fall = recording.pos[:, 0]
    pixels = found["side"].pixels(fall)
    assert (pixels >= 0).all() and (pixels <= (320, 180)).all()  # all of the way is in the picture
    assert np.ptp(pixels[:, 1]) > 40  # and fills much of its height
    cameras.aim(model, recording.pos, orientations=recording.quat, aspect=16 / 9)
    assert np.allclose(found["side"].eye, model.cam_pos[model.camera("side").id])
    assert found["with_it"].follows == ("ball",)


def test_cameras_that_cannot_be_aimed_are_left_to_the_pass_that_draws(tmp_path):
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.5))
    spec.worldbody.add_camera(name="odd")
    intent = {
        "view": "perspective",
        "subjects": ["nobody"],
        "position": None,
        "target": None,
        "fovy": 40,
        "follow": False,
    }
    spec.add_text(name="worldkit.camera.odd", data=json.dumps(intent))
    recording = record(spec.compile(), tmp_path / "t", 20)
    standing_cameras.write(spec.compile(), recording, (320, 180), tmp_path / "t")
    assert read_trajectory(tmp_path / "t").cameras is None
