"""Open a window on a world: play a recording back, or simulate live, in real time."""

import argparse
import sys
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from worldkit.errors import ProgramError

if TYPE_CHECKING:
    import mujoco

    from ..given import Given
    from ..recording.stored import Recording

FRAME_S = 1 / 60


def run(given: "Given", options: argparse.Namespace) -> None:
    """Open a window on the recording `options.recording`, or on the world itself, simulated live."""
    from worldkit import world

    from ..inputs.ledger import refresh

    model = given.model()
    if options.recording is not None:
        from ..recording import stored

        replay(model, stored.open(options.recording))
        return
    world.steps_of(model, given.duration)
    data = world.start(model)
    voice = answers = media = None
    if given.answers and options.channel:
        from worldkit.channel import ENGINE, Channel, descriptors

        from ..inputs.author_link import Distant
        from ..inputs.declared_media import Media
        from ..inputs.ports import Ports
        from ..inputs.replies import Answers

        media = Media(model, given.laws, float(model.opt.timestep), given.inputs) if given.laws else None
        ports = Ports(model, given.inputs, media)
        voice, answers = (
            Distant(model, data, ports, Channel(descriptors(options.channel), ENGINE)),
            Answers(model, data, ports),
        )

    def control(model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        assert voice is not None and answers is not None
        answers.shown(voice.ask())
        voice.go()
        voice.hear()
        answers.read(voice.message)
        answers.push()
        answers.edit()
        if answers.changes:
            answers.change()
            refresh(model, data)
        if media is not None:
            for place, (_, points, _) in zip(media.places, media.parts(media.read(voice.media)), strict=True):
                place.show(data, points)

    live(model, data, None if voice is None else control, given.duration)


def replay(model: "mujoco.MjModel", recording: "Recording") -> None:
    """Play a recording over and over until the window is closed."""
    import numpy as np

    from ..recording.replay import Replay

    shown = Replay(model, recording)
    shown.show(0)
    times = recording.time - recording.time[0]
    with _window(model, shown.data) as window:
        started = time.perf_counter()
        while window.is_running():
            now = (time.perf_counter() - started) % (float(times[-1]) + 1.0)  # rest for a second at the end
            with window.lock():
                shown.show(min(int(np.searchsorted(times, now)), len(times) - 1))
            window.sync()
            time.sleep(FRAME_S)


def live(model: "mujoco.MjModel", data: "mujoco.MjData", control: Callable[..., Any] | None, duration: float) -> None:
    """Simulate in real time until the duration (s) is over or the window is closed."""
    import mujoco

    rk4 = model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4
    end = data.time + duration
    with _window(model, data) as window:
        offset = time.perf_counter() - data.time
        while window.is_running() and data.time < end:
            with window.lock():
                while data.time < min(end, time.perf_counter() - offset):
                    mujoco.mj_step1(model, data)
                    if control is not None:
                        control(model, data)
                    (mujoco.mj_step if rk4 else mujoco.mj_step2)(model, data)
            window.sync()
            time.sleep(FRAME_S)
        while window.is_running():
            time.sleep(FRAME_S)


def _window(model: "mujoco.MjModel", data: "mujoco.MjData") -> Any:
    try:
        from mujoco import viewer

        return viewer.launch_passive(model, data)
    except (ImportError, RuntimeError) as failure:
        remedy = "run it with mjpython" if sys.platform == "darwin" else "use --pass physics, then --pass video"
        raise ProgramError(f"no window can be opened: {failure}", "--pass view", remedy) from failure
