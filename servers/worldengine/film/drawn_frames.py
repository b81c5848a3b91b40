"""Draw pictures of one model with the wanted renderer, or with a plainer one where that cannot."""

from collections.abc import Sequence
from types import TracebackType
from typing import TYPE_CHECKING, cast

from worldkit import lights

from . import renderers
from .identity import renderer_version
from .treatment import PLAIN as UNTREATED
from .treatment import Treatment

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from .renderers.preview.shaded import Shaded


class Frames:
    """Draws pictures of one model, `width` x `height` pixels; a context manager.

    `image` gives the good-looking picture, `segmentation` the geom behind each pixel. The same state, camera and quality
    always give the same picture. Where a renderer's packages are missing, or the driver cannot do what it asks, the usual
    one takes over, and MuJoCo's own where that cannot either; `renderer` and `reason` say so.

    Args:
        model: the model to draw.
        width, height: pixels.
        renderer: the wanted one, in place of that of `WORLDKIT_RENDERER`.

    Raises:
        SeamError: no renderer has this name.
        ValueError: the size is less than 8 x 8 pixels.
    """

    def __init__(self, model: "mujoco.MjModel", width: int, height: int, renderer: str = "") -> None:
        if width < 8 or height < 8:
            raise ValueError(f"a picture needs at least 8 x 8 pixels, got {width} x {height}")
        self.model, self.width, self.height = model, width, height
        self.wanted = self.renderer = renderer or renderers.wanted()
        """The wanted renderer, and the one that draws."""
        self.reason = ""
        """Why a plainer renderer draws in place of the wanted one."""
        self.untreated = False
        """Light, fog, focus or grading were asked for, which this renderer lacks."""
        self._treatment = UNTREATED
        self._drawing: renderers.Drawing | None = None
        chosen = renderers.SEAM.find(self.wanted)
        try:
            self._drawing = chosen.take(model, width, height)
        except Exception as error:
            # Any driver may lack any feature in its own way; a plainer picture is better than none.
            self._fall_back(error)
        if stated := lights.of(model):
            self.treat(UNTREATED.started_from(stated))

    def _fall_back(self, why: Exception) -> None:
        """Let the next plainer renderer draw from now on."""
        plainer = renderers.plainer(self.renderer)
        if not plainer:
            raise why
        self.close()
        said = f"{type(why).__name__}: {' '.join(str(why).split())}"
        self.renderer, self.reason = plainer, f"{self.reason}; {said}" if self.reason else said
        try:
            self._drawing = renderers.SEAM.find(plainer).take(self.model, self.width, self.height)
        except Exception as error:
            self._fall_back(error)

    def give_way(self) -> None:
        """Let the next plainer renderer draw from now on, by choice: `told` then names it alone."""
        self.close()
        self.renderer = self.wanted = renderers.plainer(self.renderer) or self.renderer
        try:
            self._drawing = renderers.SEAM.find(self.renderer).take(self.model, self.width, self.height)
        except Exception as error:
            self._fall_back(error)
        self.treat(self._treatment)

    @property
    def _open(self) -> renderers.Drawing:
        if self._drawing is None:
            raise RuntimeError("these Frames are closed; make new ones")
        return self._drawing

    def image(self, data: "mujoco.MjData", camera: str | int, quality: renderers.Quality = "video") -> "np.ndarray":
        """The picture of `data` through a camera of the model: uint8 (height, width, 3), RGB, row 0 the top.

        `data` needs positions and cameras up to date (`mj_kinematics`, `mj_comPos`, `mj_camlight`, or `mj_forward`).
        Raises ValueError when there is no such camera, or quality.
        """
        if quality not in ("still", "video") and not (isinstance(quality, int | float) and quality > 0):
            raise ValueError(f"quality is 'still', 'video' or a number of samples, not {quality!r}")
        index, drawing = _camera_index(self.model, camera), self._open
        try:
            return drawing.image(data, index, quality)
        except RuntimeError as error:
            # Programs are compiled when first used, so a driver may give up only here.
            self._fall_back(error)
            self.treat(self._treatment)
            return self.image(data, index, quality)

    def blurred(
        self, moments: Sequence[renderers.Moment], camera: int, quality: renderers.Quality = "video"
    ) -> "np.ndarray":
        """The picture of a shutter that is open for these moments, each of which is set up when it is called for.

        A renderer adds up their light where it can; of any other, the pictures are averaged by the light of the screen.
        """
        import numpy as np

        blurred = getattr(self._open, "blurred", None)
        if blurred is None:
            pictures = (self.image(moment(), camera, quality) for moment in moments)
            total = sum((picture.astype(np.float32) / 255) ** 2.2 for picture in pictures)
            return np.asarray(255 * (total / len(moments)) ** (1 / 2.2) + 0.5).astype(np.uint8)
        try:
            return np.asarray(blurred((moment() for moment in moments), len(moments), camera, quality))
        except RuntimeError as error:
            self._fall_back(error)
            self.treat(self._treatment)
            return self.blurred(moments, camera, quality)

    def over(
        self,
        before: Sequence[renderers.Before],
        moments: Sequence[renderers.Moment],
        camera: int,
        quality: renderers.Quality = "video",
    ) -> "np.ndarray":
        """The picture of these moments, as `image` or `blurred` draws it; a renderer that can takes what has not changed from
        the pictures `before`, which are of the same shot."""
        import numpy as np

        over = getattr(self._open, "over", None) if before else None
        if over is None:
            if len(moments) == 1:
                return self.image(moments[0](), camera, quality)
            return self.blurred(moments, camera, quality)
        try:
            return np.asarray(over(before, moments, camera, quality))
        except RuntimeError as error:
            self._fall_back(error)
            self.treat(self._treatment)
            return self.over(before, moments, camera, quality)

    def beside(self, moments: int, quality: renderers.Quality) -> tuple[int, float]:
        """How many pictures `before` at most are drawn with one of so many moments, as the drawing is treated now, and how many
        times as dear each of them is."""
        beside = getattr(self._open, "beside", None)
        return (0, 1.0) if beside is None else beside(moments, quality)

    @property
    def looking(self) -> "Shaded | None":
        """The drawing itself, where it can tell what a picture shows, pixel by pixel."""
        return cast("Shaded", self._drawing) if hasattr(self._drawing, "surfaces") else None

    def treat(self, treatment: Treatment) -> None:
        """Apply this light, haze, focus and grading from now on, as far as the renderer can."""
        self._treatment = treatment
        if not self._open.treat(treatment):
            self.untreated |= treatment != UNTREATED

    def segmentation(self, data: "mujoco.MjData", camera: str | int) -> "np.ndarray":
        """Geom number behind each pixel, -1 where there is none: int32 (height, width), row 0 the top."""
        return self._open.segmentation(data, _camera_index(self.model, camera))

    def layers(self, data: "mujoco.MjData", camera: str | int) -> "list[np.ndarray]":
        """As `segmentation`, and where something is see-through another one, without it."""
        through = getattr(self._open, "seen_through", None)
        behind = None if through is None else through(data, _camera_index(self.model, camera))
        return [self.segmentation(data, camera), *([] if behind is None else [behind])]

    def shared(self) -> bytes:
        """What the model's other cameras add to the picture of any one of them."""
        shared = getattr(self._drawing, "shared", None)
        return (
            shared() if shared is not None else b"".join(x.tobytes() for x in (self.model.cam_pos, self.model.cam_quat))
        )

    def told(self) -> dict[str, str]:
        """The renderer, for the evidence: `name`, `version`; `instead_of` and `because` if another was wanted; `without`
        if it left
        something out."""
        said = {"name": self.renderer, "version": renderer_version(self.renderer)}
        said |= {"without": "light, sky, fog, focus, grading"} if self.untreated else {}
        return said | ({"instead_of": self.wanted, "because": self.reason} if self.reason else {})

    def close(self) -> None:
        """Free the graphics context; may be called twice."""
        if self._drawing is not None:
            self._drawing.close()
            self._drawing = None

    def __enter__(self) -> "Frames":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _camera_index(model: "mujoco.MjModel", camera: str | int) -> int:
    import mujoco

    if isinstance(camera, int) and 0 <= camera < model.ncam:
        return camera
    index = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_CAMERA, camera) if isinstance(camera, str) else -1
    if index < 0:
        names = [mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_CAMERA, i) for i in range(model.ncam)]
        raise ValueError(
            f"no camera is called {camera!r}. Use one of: {', '.join(map(str, names)) or '(the model has none)'}."
        )
    return index
