"""Small pictures of a live world, as fast as they are wanted: the plan's cameras, and one that follows what is driven.

Drawn by a thread that owns its graphics context, from the newest state; a picture that is not fetched is never drawn twice.
"""

import contextlib
import os
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from ..model.errors import NotFoundError

if TYPE_CHECKING:
    import mujoco

    from .live_source import LiveSource

CHASE = "chase"
SIZE, FPS, QUALITY = (400, 224), 20.0, 72
QUICK, FILM = "quick", "film"
SUN = (-0.4, 0.3, -0.87)
FOVY_DEG = 50.0
BEHIND, ABOVE, AHEAD = 1.3, 0.5, 0.4
"""Where the camera stands and looks, in sizes of what it follows."""
TURNS_S = 0.35
"""It turns after what it follows in about so many seconds."""
IDLE_S = 0.05
BELOW_THE_WORLD = 5
"""Niceness of the thread that draws."""


class LiveView:
    """Draws states of a world.

    Args:
        source: the world.
        size: width and height, pixels.
        follow: a body.
        look: `quick`, in plain light, or `film`, as the house draws films, at several times the price.

    Raises:
        NotFoundError: the world has no camera of the name that is asked for.
    """

    def __init__(self, source: "LiveSource", size: tuple[int, int] = SIZE, follow: str = "", look: str = QUICK) -> None:
        import mujoco

        from worldengine.film.drawn_frames import Frames
        from worldengine.film.graphics_library import choose_headless
        from worldkit import cameras, portable
        from worldkit.naming import names

        choose_headless()
        spec = portable.spec(source.world)
        self.chase = CHASE
        while spec.camera(self.chase) is not None:
            self.chase += "_"
        spec.worldbody.add_camera(name=self.chase, fovy=FOVY_DEG)
        if look == QUICK:
            plainly_lit(spec)
        self._model = model = spec.compile()
        self.cameras = (self.chase, *(n for n in names(model, "camera", model.ncam) if n != self.chase))
        poses = source.poses()
        if model.ncam > 1:
            cameras.aim(model, poses[0], orientations=poses[1], aspect=size[0] / size[1])
        self.followed = followed(model, source, follow)
        self._turns = any(self.followed == name for name in _cars(model))
        self._size_m = _size_m(model, model.body(self.followed).id)
        self._heading = np.array([1.0, 0.0]) if self._turns else np.array([0.6, 0.8])
        self._data, self._time = mujoco.MjData(model), 0.0
        self._frames = Frames(model, *size, renderer="classic" if look == QUICK else "")

    def draw(self, state: np.ndarray, camera: str = "") -> np.ndarray:
        """(height, width, 3) uint8 of a state (`worldengine.clock.state_frames`); the following camera without a name."""
        import mujoco

        from worldengine.clock.state_frames import signature
        from worldkit import cameras

        if camera and camera not in self.cameras:
            raise NotFoundError(f"there is no camera {camera}", next_move=f"name one of: {', '.join(self.cameras)}")
        mujoco.mj_setState(self._model, self._data, state, signature())
        mujoco.mj_fwdKinematics(self._model, self._data)
        cameras.track(self._model, self._data)
        self._chase()
        return self._frames.image(self._data, camera or self.chase, quality="video")

    def _chase(self) -> None:
        """Stand behind what is followed."""
        from worldkit.turning import quaternion

        model, data, body = self._model, self._data, self._model.body(self.followed).id
        if self._turns:
            ahead = np.array(data.xmat[body]).reshape(3, 3)[:2, 0]
            passed = min(max(float(data.time) - self._time, 0.0), 1.0)
            turned = self._heading + (1 - np.exp(-passed / TURNS_S)) * (ahead - self._heading)
            if (length := float(np.hypot(*turned))) > 1e-3:
                self._heading = turned / length
        self._time = float(data.time)
        size, middle, ahead3 = self._size_m, np.array(data.subtree_com[body]), np.array([*self._heading, 0.0])
        eye = middle + size * (ABOVE * np.array([0, 0, 1.0]) - BEHIND * ahead3)
        back = eye - (middle + AHEAD * size * ahead3)
        back /= np.linalg.norm(back)
        right = np.cross([0.0, 0.0, 1.0], back)
        right /= np.linalg.norm(right)
        axes = np.stack([right, np.cross(back, right), back], axis=1)
        camera = model.camera(self.chase).id
        model.cam_pos[camera], model.cam_quat[camera] = eye, quaternion(axes)
        data.cam_xpos[camera], data.cam_xmat[camera] = eye, axes.ravel()

    def close(self) -> None:
        """Free the renderer."""
        self._frames.close()


def plainly_lit(spec: "mujoco.MjSpec") -> None:
    """Light a world for the engine's own renderer: day, a sky, no shadows, and pixels drawn once.

    Of a car in 400 x 224 that takes 13 ms of a processor, a sixth of the 80 ms that the house's own look takes, whose four passes over
    all vertices, soft shadows and development a hand at the wheel cannot wait for. A hard shadow would double it.
    """
    import mujoco

    spec.visual.quality.offsamples = 0
    spec.visual.headlight.active = 1
    spec.visual.headlight.ambient, spec.visual.headlight.diffuse = (0.42, 0.42, 0.44), (0.2, 0.2, 0.2)
    spec.visual.headlight.specular = (0.05, 0.05, 0.05)
    for light in spec.lights:
        light.active = False
    spec.worldbody.add_light(
        type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL, dir=SUN, diffuse=(0.6, 0.58, 0.55), specular=(0.2, 0.2, 0.2),
        castshadow=False,
    )  # fmt: skip
    if not any(texture.type == mujoco.mjtTexture.mjTEXTURE_SKYBOX for texture in spec.textures):
        spec.add_texture(
            name="sky of the live picture", type=mujoco.mjtTexture.mjTEXTURE_SKYBOX, width=64, height=384,
            builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT, rgb1=(0.35, 0.5, 0.72), rgb2=(0.82, 0.86, 0.9),
        )  # fmt: skip


def _cars(model: "mujoco.MjModel") -> tuple[str, ...]:
    from worldkit.vehicles.found_cars import find_cars

    return tuple(find_cars(model))


def followed(model: "mujoco.MjModel", source: "LiveSource", asked: str = "") -> str:
    """The body that a camera follows: the one that is asked for, a car, what is expected to move, else the first.

    Raises:
        NotFoundError: there is no such body; the known ones are listed.
    """
    from worldkit.naming import names

    known = names(model, "body", model.nbody)[1:]
    if asked and asked not in known:
        raise NotFoundError(f"there is no body {asked}", next_move=f"name one of: {', '.join(known) or '(none)'}")
    return asked or next(iter((*_cars(model), *source.given.movers, *known)), "world")


def _size_m(model: "mujoco.MjModel", body: int) -> float:
    """Across what belongs to a body, m: as far as its geoms reach about its middle (that of mass) as it is built."""
    import mujoco

    tree = [
        i for i in range(model.ngeom) if _under(model, int(model.geom_bodyid[i]), body) and model.geom_rbound[i] > 0
    ]
    if body == 0 or not tree:
        return max(2.0 * float(model.stat.extent), 0.2)
    data = mujoco.MjData(model)
    mujoco.mj_fwdKinematics(model, data)
    away = np.linalg.norm(data.geom_xpos[tree] - data.subtree_com[body], axis=1)
    return max(2.0 * float((away + model.geom_rbound[tree]).max()), 0.1)


def _under(model: "mujoco.MjModel", body: int, root: int) -> bool:
    while body > root:
        body = int(model.body_parentid[body])
    return body == root


class PictureThread:
    """Draws the newest state so often, as JPEG, while somebody wants to see it.

    Args:
        view: makes what draws, on the thread.
        newest: gives the (facts, state) that is to be drawn.
        fps: pictures a second.

    Attributes:
        camera: through which it is drawn; any thread may change it to one of `cameras`.
        wanted: whether anybody looks at the page.
        always: whether anybody looks elsewhere.
        jpeg: (number, bytes) of the newest picture.
        image: (height, width, 3) uint8, the same.
        problem: why nothing is drawn.
    """

    def __init__(self, view: Callable[[], LiveView], newest: Callable[[], tuple[Any, Any]], fps: float = FPS) -> None:
        self._view, self._newest, self._fps = view, newest, fps
        self.camera, self.wanted, self.always, self.problem = "", False, False, ""
        self.cameras: tuple[str, ...] = ()
        self.jpeg: tuple[int, bytes] = (0, b"")
        self.image = np.zeros((0, 0, 3), np.uint8)
        self.made: list[Callable[[], object]] = []
        """They are called, on the thread, when there is a newer picture."""
        self._ended, self.ready = threading.Event(), threading.Event()
        self._thread = threading.Thread(target=self._work, name="pictures", daemon=True)
        self._thread.start()

    def _work(self) -> None:
        import cv2

        # A software driver takes all processors, and the world needs one of them, before any picture.
        os.environ.setdefault("LP_NUM_THREADS", "1")
        with contextlib.suppress(OSError, AttributeError):
            os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), BELOW_THE_WORLD)
        try:
            view = self._view()
        except Exception as cause:  # any driver may lack anything in its own way; the drive needs no picture
            self.problem = f"no pictures: {type(cause).__name__}: {cause}"
            self.ready.set()
            return
        self.cameras, shown, due = view.cameras, (None, ""), time.monotonic()
        self.ready.set()
        try:
            while not self._ended.wait(max(due - time.monotonic(), 0.0) if self.wanted or self.always else IDLE_S):
                state = self._newest()[1]
                camera = self.camera if self.camera in self.cameras else ""
                if not (self.wanted or self.always) or state is None or (state is shown[0] and camera == shown[1]):
                    due = time.monotonic() + 1 / self._fps
                    continue
                due = max(due + 1 / self._fps, time.monotonic())
                shown = (state, camera)
                image = view.draw(state, camera)
                done, data = cv2.imencode(".jpg", image[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, QUALITY])
                if done:
                    self.image = image
                    self.jpeg = (self.jpeg[0] + 1, data.tobytes())
                    for call_back in self.made:
                        call_back()
        except Exception as cause:
            self.problem = f"no more pictures: {type(cause).__name__}: {cause}"
        finally:
            view.close()

    def close(self) -> None:
        """Stop drawing."""
        self._ended.set()
        self._thread.join(10)
