"""Which graphics library draws: that of the display, else EGL, else whatever `MUJOCO_GL` names; MuJoCo reads it when it is imported."""

import os
import sys

from worldkit.program import has_display


def choose_headless() -> None:
    """Without a display, draw through EGL, even if MuJoCo was imported before anyone could choose."""
    if sys.platform == "linux" and "MUJOCO_GL" not in os.environ and not has_display():
        os.environ["MUJOCO_GL"] = "egl"
        load_chosen()


def load_chosen() -> None:
    """Give MuJoCo's package the library that `MUJOCO_GL` names now."""
    import importlib

    import mujoco
    import mujoco.gl_context
    import mujoco.rendering.classic.gl_context as classic
    import mujoco.rendering.classic.renderer as renderer

    for module in (classic, mujoco.gl_context, renderer):
        importlib.reload(module)
    mujoco.GLContext, mujoco.Renderer = classic.GLContext, renderer.Renderer
