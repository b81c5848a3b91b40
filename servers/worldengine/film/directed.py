"""Draw a film as its author described it: each frame from recorded rows, through the film's own camera."""

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from worldkit import cameras, turning
from worldkit.filming.viewpoints import axes

from ..recording.replay import Replay
from . import behind_drawn, camera_roll, puffs, renderers, smear, stand_ins, streaks, time_map
from .described import Described
from .drawn_frames import Frames
from .dressed import CAMERA, DressedReplay, dress, surfaces
from .lettering import letter
from .renderers import Before
from .renderers.preview.eye import of_camera
from .standing_outlines import LEAST_FRAMES, StandingOutlines

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path
    from types import TracebackType

    import mujoco
    import numpy as np

    from ..recording.stored import Recording
    from .carrying import Surfaces
    from .renderers import Moment, Quality
    from .renderers.preview.eye import View
    from .renderers.preview.shaded import Shaded

HELD = ("eye", "target", "roll_deg", "fovy_deg", "focus_m", "aperture")
"""What does not change while a camera stands still."""
GONE = 1e-9
"""What is not there in a frame is drawn so many times smaller: a point, which neither picture nor ray meets."""


class Screening:
    """A film ready to be drawn, frame by frame, in any order; a context manager.

    Args:
        world: the world as one file.
        plain: the same, compiled.
        recording: the recording to show.
        film: the description of the film.
        size: of the picture, pixels.
        fps: frames per second of the film.
        renderer: the wanted one, in place of that of `WORLDKIT_RENDERER`.
    """

    _last_seen: "tuple[int, Surfaces] | None" = None
    """A frame, and what it shows, where nothing was set up since that was looked at."""

    def __init__(
        self,
        world: "Path",
        plain: "mujoco.MjModel",
        recording: "Recording",
        film: Described,
        size: tuple[int, int],
        fps: int,
        renderer: str = "",
    ) -> None:
        import numpy as np

        from .hiding import Swaying

        self.film, self.fps = film, fps
        self.model = dress(world, film)
        self._replay = DressedReplay(self.model, plain, recording)
        self._time = np.asarray(recording.time) - recording.time[0]
        self._movers = [name for name in recording.meta.get("movers") or () if name in recording.names]
        self._aims = behind_drawn.aims(recording, self._movers)
        self._camera = int(self.model.camera(CAMERA).id)
        flying = [thing for thing in film.things if thing.get("ways")]
        self._copies = [self._by_frame(thing, "ways", "sizes") for thing in flying if "turns" not in thing]
        self._leaves = [self._by_frame(thing, "ways", "sizes", "turns") for thing in flying if "turns" in thing]
        self._surfaces = surfaces(self.model, film)
        self._swaying = Swaying(self.model)
        self._planned: Replay | None = None
        if any(shot["planned"] for shot in film.shots):
            self._planned = Replay(plain, recording)
            cameras.aim(plain, recording.pos, orientations=recording.quat, aspect=size[0] / size[1])
        shown = film.arrays["time"]
        self._again = [
            bool(shot["first"] and shown[shot["first"]] < shown[: shot["first"]].max() - 1.5 / fps)
            for shot in film.shots
        ]
        self._blown: tuple[float, float, float] | None = None
        self._still: dict[int, tuple[int, ...]] = {}
        self._fine, self._outlines = False, StandingOutlines(self._plate)
        self.alone = False
        """Few pictures are wanted: nothing is drawn that others could be drawn over."""
        self.tick: Callable[[], object] = lambda: None
        """Called whenever a moment is set up, since a picture may take minutes."""
        self.frames = Frames(self.model, *size, renderer)
        self._seen: Shaded | None = None
        self._shown = 0
        self.puffless = ""
        """Why no puffs are drawn, where the driver does not say how far away is what a picture shows."""
        self._sharp = ""
        """Why nothing is smeared, where the driver cannot draw what a picture shows."""

    def _by_frame(self, thing: dict[str, Any], *told: str) -> "tuple[Any, ...]":
        """The geom of a thing's first copy, and what is told of it frame by frame."""
        return self.model.geom(f"drawn.{thing['name']}/0").id, *(self.film.arrays[thing[key]] for key in told)

    @property
    def sways(self) -> bool:
        """Whether a breeze moves anything."""
        return self.film.breeze is not None and len(self._swaying.geoms) > 0

    def picture(self, frame: int, quality: "Quality" = "video") -> "np.ndarray":
        """One frame, words and all: uint8 (height, width, 3)."""
        return self.lettered(frame, self.wordless(frame, quality))

    def wordless(self, frame: int, quality: "Quality" = "video") -> "np.ndarray":
        """One frame without its words: uint8 (height, width, 3)."""
        plates = self._plates(frame, quality)
        self._outlines.ready(plates)
        moments = self._moments(quality, frame)
        smeared = self._reckons and self._travel_px(frame) >= streaks.LEAST_PX
        before = [Before(number, self._parts(number, moments)) for number in self.standing(frame, quality)]
        picture = self.frames.over(before, self._parts(frame, moments), self._camera, quality)
        picture = self._outlines.smoothed(picture) if plates else picture
        return self._smeared(frame, picture) if smeared else picture

    def _plate(self, frame: int, fine: bool) -> "np.ndarray":
        self._fine = fine
        try:
            return self.frames.image(self._moment(float(frame)), self._camera)
        finally:
            self._fine = False

    def _plates(self, frame: int, quality: "Quality") -> tuple[int, ...]:
        """The frames by which what stands in a frame gets smooth outlines: of its shot, developed alike, where the camera stands."""
        shot = self.film.shots[self.film.shot(frame)]
        if self.alone or quality != "video" or self.frames.renderer != renderers.USUAL or shot["frames"] < LEAST_FRAMES:
            return ()
        treatment, fps = self.film.treatments.at(frame / self.fps), self.fps
        if treatment.grade_outlines > 0.5:
            return ()
        return tuple(n for n in self._held(frame) if self.film.treatments.at(n / fps) == treatment)

    @property
    def _reckons(self) -> bool:
        """Whether a frame is drawn once, and smeared along the way of what moves while the shutter is open."""
        return self.film.shutter > 0 and self.film.samples == 1 and not self._sharp

    def _smeared(self, frame: int, picture: "np.ndarray") -> "np.ndarray":
        """A picture of a frame as an open shutter sees it; as it is where the driver cannot draw what it shows."""
        try:
            after, begun = frame + self.film.shutter * (1 - 1e-6), self._row(float(frame))
            gone = self._seconds(after) - self._seconds(float(frame))
            row = min(max(self._row(after), begun + (gone > 0)), len(self._time) - 1)
            lasts = float(self._time[row] - self._time[begun])
            after_it = self._moment(after, row, treated=False, laid=False)
            poses, view = self._looking().placed(after_it, self._camera)
            now = self.surfaces(frame)  # and what was drawn last is this frame again
            return streaks.streaked(picture, now, poses, view, gone / lasts if lasts > 0 else 1.0)
        except Exception as error:  # drivers fail in ways of their own, and a sharp picture is better than none
            self._sharp = f"{type(error).__name__}: {error}"[:300]
            self._moment(frame)
            return picture

    def lettered(self, frame: int, image: "np.ndarray") -> "np.ndarray":
        """A picture with the puffs and the words of a frame, which none can leave out: uint8 (height, width, 3)."""
        if (self.film.puffs or self.film.clouds) and not self.puffless:
            film, treatment = self.film, self.film.treatments.at(frame / self.fps)
            try:
                shown = self._looked_at(frame)
            except Exception as error:  # drivers fail in ways of their own, and a film without mist is better than none
                self.puffless = f"{type(error).__name__}: {error}"[:300]
                return letter(image, frame / self.fps, self.film.captions, *self.words(frame))
            image = puffs.over(image, film.arrays, film.puffs, frame, shown, treatment, film.clouds)
        return letter(image, frame / self.fps, self.film.captions, *self.words(frame))

    def words(self, frame: int) -> tuple[float, bool, str, str, str]:
        """What the picture of a frame says of itself: its speed, whether its moment was shown before, and what else is not as it was."""
        film = self.film
        more = time_map.words(film, frame, self.fps), camera_roll.words(film, frame), stand_ins.words(film, frame)
        return film.speed(frame, self.fps), self._again[film.shot(frame)], *more

    def surfaces(self, frame: int, coarser: int = 1) -> "Surfaces":
        """What a frame shows, pixel by pixel, in the middle of the time that its shutter is open, `coarser` times smaller each way.

        Raises:
            RuntimeError: the graphics driver refuses; other exceptions of its own, too.
        """
        data = self._moment(frame + self._middle)
        found = self._looking().surfaces(data, self._camera, coarser)
        self._last_seen = (frame, found) if coarser == 1 else None
        return found

    def _looked_at(self, frame: int) -> "Surfaces":
        """The `surfaces` of a frame; those that were found last where nothing else was set up since."""
        return self._last_seen[1] if self._last_seen and self._last_seen[0] == frame else self.surfaces(frame)

    def placed(self, frame: int) -> "tuple[np.ndarray, View]":
        """Where each thing of `surfaces` is (N, 3, 4), and the view, without drawing anything."""
        return self._looking().placed(self._moment(frame + self._middle, laid=False), self._camera)

    @property
    def _middle(self) -> float:
        """From a frame to the middle of the time that its shutter is open; one drawn once is drawn in the middle."""
        return 0.0 if self.film.samples == 1 else self.film.shutter / 2

    def _looking(self) -> "Shaded":
        from .renderers.preview.shaded import Shaded

        if (own := self.frames.looking) is not None:
            return own
        if self._seen is None:
            self._seen = Shaded(self.model, self.frames.width, self.frames.height)
        return self._seen

    def _moments(self, quality: "Quality", frame: int) -> int:
        """How many moments the shutter is open for: as many as what goes furthest in the picture takes, and no more.

        Where samples are shared out among them they cost next to nothing: then each takes one at least, and a draft is sharp.
        """
        most = self.film.samples if self.film.shutter > 0 else 1
        if not isinstance(quality, str):
            return min(most, max(1, int(quality)))
        return most if most == 1 else smear.moments(self._travel_px(frame), most)

    def dearer(self, frame: int, height: int) -> float:
        """How many times as many moments a frame of the film takes in pictures of another height: what moves goes further in large ones."""
        if self.film.samples == 1 or self.film.shutter <= 0:
            return 1.0
        far, most = self._travel_px(frame), self.film.samples
        return smear.moments(far * height / self.frames.height, most) / smear.moments(far, most)

    def _travel_px(self, frame: int) -> float:
        """How far anything goes in the picture while the shutter is open for a frame."""
        import numpy as np

        views, shown = [], []
        for share in smear.LOOKS:
            data = self._moment(frame + self.film.shutter * share, treated=not self._reckons, laid=False)
            views.append(of_camera(self.model, data, self._camera, self.frames.width, self.frames.height))
            there = smear.drawn(self.model, data)
            swaying = self._swaying.some(data, self._blown)
            shown.append(there._replace(loose=np.concatenate([there.loose, swaying])))
        return smear.travel_px(views, shown, self.frames.height)

    def _parts(self, frame: int, moments: int) -> "list[Moment]":
        """The moments while the shutter is open for a frame."""
        return [partial(self._moment, frame + self.film.shutter * part / moments) for part in range(moments)]

    def standing(self, frame: int, quality: "Quality") -> tuple[int, ...]:
        """The frames that stand in for what does not change in a shot, if its camera and light do not: its last, where most
        has come to rest, and its first, for what is about to move; a draft needs none."""
        return () if self.alone or isinstance(quality, str) or quality < 1 else self._held(frame)

    def _held(self, frame: int) -> tuple[int, ...]:
        """The last and the first frame of the shot of a frame, if its camera and light stand still; else none."""
        shot = self.film.shot(frame)
        if shot not in self._still:
            film, first, count = self.film, self.film.shots[shot]["first"], self.film.shots[shot]["frames"]
            lit = {film.treatments.at(frame / self.fps).lit for frame in range(first, first + count)}
            seen = () if film.shots[shot]["planned"] else HELD
            held = all((film.arrays[name][first : first + count] == film.arrays[name][first]).all() for name in seen)
            self._still[shot] = (first + count - 1, first) if held and len(lit) == 1 and count > 1 else ()
        return self._still[shot]

    def stills(self, frame: int, quality: "Quality") -> float:
        """What else the renderer draws with this frame, if it is the first of its shot: that takes as long as so many frames."""
        standing = self.standing(frame, quality)
        if not standing:
            return 0.0
        self._moment(frame, laid=False)  # whether any stands depends on how it is treated
        most, dearer = self.frames.beside(self._moments(quality, frame), quality)
        return dearer * len(standing[:most]) - (frame in standing[:most])

    def _between(self, at: float) -> tuple[dict[str, Any], int, int, float]:
        """The shot of a place between two frames, these, and how far it is from the first to the second."""
        shot = self.film.shots[self.film.shot(int(at))]
        low = int(at)
        return shot, low, min(low + 1, shot["first"] + shot["frames"] - 1), at - low

    def _seconds(self, at: float) -> float:
        """The recorded time that is shown between two frames of one shot, s."""
        (shot, low, high, part), time = self._between(at), self.film.arrays["time"]
        if shot["frames"] > 1 and high == low and part > 0:  # past the shot's last frame, it goes on as before
            return min(float(time[low] + part * (time[low] - time[low - 1])), float(self._time[-1]))
        return float((1 - part) * time[low] + part * time[high])

    def _row(self, at: float) -> int:
        """The recorded row that is shown between two frames of one shot."""
        import numpy as np

        return int(np.abs(self._time - self._seconds(at)).argmin())

    def _moment(self, at: float, row: int = -1, treated: bool = True, laid: bool = True) -> "mujoco.MjData":
        """Set up what is shown between two frames of one shot, by another recorded row than its own if one is given.

        With `treated` False the drawing keeps the light of what was set up before: that is not going to be drawn. With `laid`
        False surfaces stay as they were: it is asked only where things are, and to lay one takes longer than to draw it.
        """
        import numpy as np

        self.tick()
        self._last_seen = None
        film = self.film
        shot, low, high, part = self._between(at)
        self._shown = low if part < 0.5 else high

        def told(name: str) -> Any:
            values = film.arrays[name]
            return (1 - part) * values[low] + part * values[high]

        row = self._row(at) if row < 0 else row
        data = self._replay.show(row)
        for first, ways, sizes in self._copies:
            count = ways.shape[1]
            data.geom_xpos[first : first + count] = (1 - part) * ways[low] + part * ways[high]
            self.model.geom_size[first : first + count, 0] = np.maximum(sizes[low] / 2, 1e-9)
        for first, ways, sizes, turns in self._leaves:
            copies, mesh = slice(first, first + ways.shape[1]), int(self.model.geom_dataid[first])
            turned = turning.matrices(turns[low if part < 0.5 else high])
            place = (1 - part) * ways[low] + part * ways[high]
            data.geom_xpos[copies] = place + turned @ self.model.mesh_pos[mesh]
            data.geom_xmat[copies] = (turned @ turning.matrices(self.model.mesh_quat[mesh])).reshape(-1, 9)
            data.geom_xmat[copies][sizes[low if part < 0.5 else high] == 0] *= GONE
        self._look(data, shot, row, told)
        if self._surfaces and laid:
            pixel = np.radians(self.model.cam_fovy[self._camera]) / self.frames.height
            for surface in self._surfaces:
                surface.place(data, data.cam_xpos[self._camera], float(pixel))
        if not treated:
            return data
        treatment = film.treatments.at(at / self.fps, float(told("focus_m")), float(told("aperture")))
        if film.breeze is not None and self.sways:  # else what stands would be drawn anew for nothing
            self._blown = (*film.breeze, self._seconds(at))
            treatment = replace(treatment, breeze=self._blown)
        self.frames.treat(replace(treatment, grade_outlines=1.0) if self._fine else treatment)
        return data

    def _look(self, data: "mujoco.MjData", shot: dict[str, Any], row: int, told: "Callable[[str], Any]") -> None:
        """Put the film's camera where the shot has it."""
        camera = self._camera
        if shot["planned"]:
            assert self._planned is not None
            theirs = self._planned.show(row)
            cameras.track(self._planned.model, theirs)
            index = self._planned.model.camera(shot["planned"]).id
            data.cam_xpos[camera], data.cam_xmat[camera] = theirs.cam_xpos[index], theirs.cam_xmat[index]
            self.model.cam_fovy[camera] = self._planned.model.cam_fovy[index]
            return
        data.cam_xpos[camera] = told("eye")
        data.cam_xmat[camera] = axes(told("eye"), told("target"), float(told("roll_deg"))).ravel()
        self.model.cam_fovy[camera] = float(told("fovy_deg"))

    def hidden(self) -> list[str]:
        """The film's own things that cover the middle of a moving body in the frame drawn last, or most around it: `ball behind pillar`.

        The plan's cameras are drawn without them, so evidence is never hidden; the statement tells where the film hides it.
        What sways counts where the breeze has carried it; puffs, where together they hide half of what is behind them.
        """
        if self._blown is not None and self._movers:
            self._swaying.blow(self._replay.data, self._blown)
        with self._swaying:
            return behind_drawn.met(
                self.model,
                self._replay.data,
                self._camera,
                self.film,
                self._shown,
                self._aims,
                self._swaying,
                not self.puffless,
            )

    def segmentation(self) -> "np.ndarray":
        """The first of `layers`."""
        return self.frames.segmentation(self._replay.data, self._camera)

    def layers(self) -> "list[np.ndarray]":
        """Geom numbers of the dressed world in the frame drawn last, and without what is see-through, if anything is: int32 (height,
        width), of what sways as in calm air or blown."""
        return self.frames.layers(self._replay.data, self._camera)

    def close(self) -> None:
        """Free the graphics contexts."""
        self.frames.close()
        if self._seen is not None:
            self._seen.close()
            self._seen = None

    def __enter__(self) -> "Screening":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: "TracebackType | None"
    ) -> None:
        self.close()
