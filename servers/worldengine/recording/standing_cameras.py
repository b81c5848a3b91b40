"""Where the cameras stand once a motion is recorded: in numbers, before anything is drawn."""

from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from .columns import CAMERAS_FILE

if TYPE_CHECKING:
    import mujoco

    from .stored import Recording


def write(model: "mujoco.MjModel", recording: "Recording", size: tuple[int, int], folder: Path) -> None:
    """Aim the model's cameras at a recording, as its pictures of `size` (pixels) will, and write `cameras.json` beside it.

    Left out are cameras without a name, those that ride on bodies, as no one place is theirs, and orthographic ones, which no
    field of view describes. Nothing is written where the cameras cannot be aimed: the pass that draws says why.
    """
    import mujoco

    from worldkit import cameras
    from worldkit.files import write_json

    from .replay import Replay

    if not len(recording) or not model.ncam:
        return
    replay = Replay(model, recording)
    still = (model.cam_bodyid == 0) & (model.cam_mode == mujoco.mjtCamLight.mjCAMLIGHT_FIXED)
    still &= model.cam_projection == mujoco.mjtProjection.mjPROJ_PERSPECTIVE
    with suppress(ValueError, KeyError):  # where they stand is an extra: no recording is lost for it
        cameras.aim(model, recording.pos, orientations=recording.quat, aspect=size[0] / size[1])
        data = replay.show(0)
        cameras.track(model, data)
        known = [name for camera in range(model.ncam) if still[camera] and (name := model.camera(camera).name)]
        stands = {name: cameras.standing(model, data, name) for name in known}
        write_json(folder / CAMERAS_FILE, {"size": list(size), "cameras": stands})
