"""The final renderer traces paths of light with Mitsuba and denoises them: bounce light, true mirrors, glass and water.

It needs the `film` extra (Mitsuba, OIDN) and a few seconds for each picture.
"""

from typing import TYPE_CHECKING

from .. import Drawing

if TYPE_CHECKING:
    import mujoco

PACKAGES = ("mitsuba", "drjit", "pyoidn", "opencv-python-headless")


def take(model: "mujoco.MjModel", width: int, height: int) -> Drawing:
    """Prepare to draw a model.

    Raises:
        MissingRendererError: the packages of the `film` extra are not installed, or cannot work here.
    """
    from . import variant

    variant.choose()
    from .tracing import Tracing

    return Tracing(model, width, height)
