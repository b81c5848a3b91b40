"""A window on the world: a recording played back, or the simulation live, in real time."""

import sys
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .errors import ProgramError

if TYPE_CHECKING:
    import mujoco

    from .trajectory import Recording

FRAME_S = 1 / 60


def replay(model: "mujoco.MjModel", recording: "Recording") -> None:
    """Play a recording over and over until the window is closed."""
    import numpy as np

    from .replay import Replay

    shown = Replay(model, recording)
    shown.show(0)
    times = recording.time - recording.time[0]
    with _window(model, shown.data) as window:
        started = time.perf_counter()
        while window.is_running():
            now = (time.perf_counter() - started) % (float(times[-1]) + 1.0)  # a second of rest at the end
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
