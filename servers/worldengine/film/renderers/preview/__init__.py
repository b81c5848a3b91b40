"""The preview renderer uses OpenGL, in software or hardware: soft shadows, surroundings, painted materials, a film curve."""

from typing import TYPE_CHECKING

from .. import Drawing

if TYPE_CHECKING:
    import mujoco

PACKAGES = ("PyOpenGL", "opencv-python-headless")


def take(model: "mujoco.MjModel", width: int, height: int) -> Drawing:
    """Prepare to draw a model, with an OpenGL context of its own."""
    from .shaded import Shaded

    return Shaded(model, width, height)
