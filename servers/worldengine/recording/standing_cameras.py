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

    Cameras that ride on bodies are left out, as no one place is theirs. Nothing is written where the cameras cannot be
    aimed: the pass that draws says why.
    """
    import mujoco

    from worldkit import cameras
    from worldkit.files import write_json
    from worldkit.naming import names

    from .replay import Replay

    if not len(recording) or not model.ncam:
        return
    replay = Replay(model, recording)
    still = (model.cam_bodyid == 0) & (model.cam_mode == mujoco.mjtCamLight.mjCAMLIGHT_FIXED)
    with suppress(ValueError):
        cameras.aim(model, recording.pos, orientations=recording.quat, aspect=size[0] / size[1])
        data = replay.show(0)
        cameras.track(model, data)
        known = [name for name, stands in zip(names(model, "camera", model.ncam), still, strict=True) if stands]
        stands = {name: cameras.standing(model, data, name) for name in known}
        write_json(folder / CAMERAS_FILE, {"size": list(size), "cameras": stands})
