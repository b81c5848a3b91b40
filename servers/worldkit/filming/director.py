"""`Film`: what is shown, from where, how fast, in what light, with what around it. A description, drawn by another process."""

from typing import Any

import numpy as np

from .. import materials
from ..errors import ProgramError
from . import free_edge, hero, sets, whereabouts
from .drawn_hands import DrawnHands
from .drawn_only import look_facts
from .film_bounds import FAR_M, MOST_FRAMES, NATURAL_SHUTTER, PLACES
from .frame_by_frame import grown, sampled
from .lettered_plates import Labelled
from .plain_refusals import NoTimeError, line, refusing
from .recorded import Recorded
from .viewpoints import Viewpoint, axes

SLOWEST, FASTEST = 1 / 200, 50.0
Speed = float | tuple[float, float]


@refusing
class Film(Labelled, DrawnHands):
    """A film in the making; `recorded` is what happened.

    Shots follow each other; what is not said has good defaults: without any shot the film tells the event by itself, without
    light and sky it has the setting's own.
    """

    def __init__(self, recorded: Recorded) -> None:
        super().__init__(recorded)
        self.now = 0.0
        """Film time at which the next shot begins, s."""
        self.reached = 0.0
        """Recorded time that the last shot ended at, s."""
        self._shots: list[dict[str, Any]] = []
        self._captions: list[dict[str, Any]] = []
        self._shutter, self._samples = NATURAL_SHUTTER, 1
        self.line = 1
        """Line of film.py that what is being described comes from."""

    # -- shots ---------------------------------------------------------------------------------------------------------

    def shot(self, camera: Viewpoint, *, until: float, speed: Speed = 1.0, start: float | None = None) -> None:
        """Show the recording from where the last shot ended (or from `start`, recorded s) to `until`, through a camera.

        `speed` is recorded seconds in a second of film: 0.25 is slow motion, a pair is a ramp from one to the other. The
        picture says by itself how fast it runs whenever that is not 1.

        Raises:
            ProgramError: the times are not in the recording, or do not run forward; the speed is none that can be shown.
        """
        begin = self.reached if start is None else float(start)
        end = min(float(until), self.recorded.duration)
        if not 0.0 <= begin < end:
            raise NoTimeError(
                f"a shot from {begin:.3g} s to {end:.3g} s shows nothing of {self.recorded.duration:.3g} recorded seconds",
                "film.py",
                "give until= a later time, or start= an earlier one",
            )
        first, last = (float(v) for v in (speed if isinstance(speed, (tuple, list)) else (speed, speed)))
        if not (SLOWEST <= first <= FASTEST and SLOWEST <= last <= FASTEST):
            raise ProgramError(
                f"a speed lies between 1/200 and 50, got {speed}", "film.py", "hold a moment with film.hold"
            )
        lasts = (end - begin) / (0.5 * (first + last))
        count = max(2, round(lasts * self.recorded.fps))
        share = np.arange(count + 1) / count
        # The integral of a smooth step from the first speed to the last; whole frames, so it ends within half of one.
        ramp = first * share + (last - first) * (share**3 - 0.5 * share**4)
        times = np.minimum(begin + ramp * count / self.recorded.fps, self.recorded.duration)
        self._take(camera, times[:-1], float(times[-1]))

    def hold(self, camera: Viewpoint, seconds: float, *, at: float | None = None) -> None:
        """Show one recorded moment, the one that was reached or `at`, for some seconds of film, while the camera may move."""
        moment = self.reached if at is None else float(at)
        if not (0.0 <= moment <= self.recorded.duration and 0 < seconds <= 60):
            raise ProgramError(
                f"{moment:.3g} s is no recorded moment, or {seconds} s too long", "film.py", "at most 60 s"
            )
        self._take(camera, np.full(max(2, round(seconds * self.recorded.fps)), moment), moment)

    def _take(self, camera: Viewpoint, times: np.ndarray, reached: float) -> None:
        if not isinstance(camera, Viewpoint):
            raise ProgramError(
                f"a shot needs a camera, not {camera!r}", "film.py", "e.g. film.shot(follow('ball'), until=1)"
            )
        if camera.planned and camera.planned not in self.recorded.cameras:
            known = ", ".join(self.recorded.cameras) or "(none)"
            raise ProgramError(f"the plan has no camera {camera.planned!r}", "film.py", f"name one of: {known}")
        first = sum(len(shot["times"]) for shot in self._shots)
        if first + len(times) > MOST_FRAMES:
            raise ProgramError(f"the film has more than {MOST_FRAMES} frames", "film.py", "show less of it so slowly")
        self._shots.append({"camera": camera, "times": times, "line": line()})
        self.reached, self.now = reached, (first + len(times)) / self.recorded.fps

    def usual(self) -> None:
        """The shots of a film that nobody has thought about: the whole event in one, from its side."""
        for camera, how in hero.shots(self.recorded):
            self.shot(camera, **how)

    # -- words ---------------------------------------------------------------------------------------------------------

    def caption(self, text: str, *, seconds: float = 3.0, start: float | None = None, place: str = "") -> None:
        """Words on the picture from where the next shot begins (or film time `start`): `bottom`, `top`, `left` or `title`.

        Without a place they stand at the bottom, or at the top where movers are in their way at the bottom.

        They come and go softly, in at most a quarter of their time each; spaces and line ends stay as they are written.
        """
        if place not in ("", *PLACES) or not isinstance(text, str) or not text.strip() or len(text) > 200:
            raise ProgramError(
                f"a caption has words (at most 200 letters), a time, and a place of {', '.join(PLACES)}", "film.py", ""
            )
        begin = self.now if start is None else float(start)
        if not (0 <= begin <= FAR_M and 0 < seconds <= FAR_M):
            raise ProgramError(
                f"a caption from {begin:g} s on for {seconds:g} s is never seen",
                "film.py",
                "start=0 is where the film begins",
            )
        told = {"text": text, "start_s": begin, "end_s": begin + float(seconds), "place": place}
        self._captions.append(told | {"line": line()})

    def shutter(self, share: float = 0.5, *, samples: int = 8) -> None:
        """Motion blur: the shutter is open for `share` of each frame's time, drawn as the mean of at most `samples` pictures.

        A frame takes as many as it needs for its fastest part, one each two pixels, and one where nothing goes a pixel far.
        With `samples=1`, as every film is that says nothing of it, one picture is smeared along the way of what moves: nearly
        as good, and nearly for nothing; shadows and mirror images stay sharp. `shutter(0)` leaves all sharp.
        """
        if not (0 <= share <= 1 and 1 <= samples <= 32):
            raise ProgramError("a shutter is open for 0 to 1 of a frame, in 1 to 32 samples", "film.py", "shutter(0.5)")
        self._shutter, self._samples = float(share), int(samples)

    def set(
        self,
        name: str,
        *,
        facing_deg: float = -57.0,
        seed: int = 1,
        colour: str = "",
        hour: str = "",
        bare: bool = False,
    ) -> None:
        """Surroundings in one line: `film.set("meadow")`, drawn only, with light, sky and air that suit them.

        `facing_deg` is the side from which the camera looks (an azimuth; `wide()` looks from -57) and which is kept free;
        another `seed` makes another of the same kind, and `colour` (`#rrggbb`) is that of the wall of a `still_life`, in which a
        vase of dried flowers stands at the side unless it is `bare`. `hour` is
        `noon`, `golden_hour`, `overcast`, `misty_morning`, `dusk` or `night`, when street, park and room have their lamps lit;
        without it a set has its own, or that of the sky which the plan states. Light, sky and ground that the plan states
        stay as they are, and no grass grows on snow or sand; what is said afterwards (light, mood, ground) changes it.

        Raises:
            ProgramError: there is no such set or hour, what happens is too large for it, or it has no such wall.
        """
        stated = str(self.recorded.light.get("sky", ""))
        self._names.building = name
        try:
            hour = hour or (stated if stated in sets.hours.HOURS else "")
            sets.build(self, name, facing_deg, seed, colour, hour, bare=bare)
        finally:
            self._names.building = ""
        self.as_planned()
        if self.recorded.floor:
            self.ground(self.recorded.floor)

    def usual_set(self, *, facing_deg: float = -57.0) -> None:
        """The surroundings that the plan's words name (else its setting), with their hour, wind and, of a liquid, one surface.

        `facing_deg` is the side from which the camera looks, as of `set`. Around a world that brings its own land stand trees and
        hills; where no set suits there is none.
        """
        recorded = self.recorded
        if recorded.setting == "outdoor" and whereabouts.own_land(recorded):
            whereabouts.countryside(self, facing_deg)
        elif name := whereabouts.choose(recorded):
            self.set(name, facing_deg=facing_deg, hour=whereabouts.hour(recorded))
        if any(recorded.wind[:2]):
            self.breeze()
        for body in recorded.grains:  # a liquid or snow is one thing to the eye, whatever points it is reckoned with
            look = recorded.looks.get(body, "")
            if look == "snow" or (look and materials.look(look).clear > 0):
                self.surface(f"{body} as one", of=body, look=look, smooth=2.0 if look == "snow" else 1.0)

    # -- the description -----------------------------------------------------------------------------------------------

    def description(self) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
        """The whole film as JSON and arrays by name; raises `ProgramError` where a camera or a particle is nowhere."""
        if not self._shots:
            self.usual()
        arrays: dict[str, np.ndarray] = {}
        times = np.concatenate([shot["times"] for shot in self._shots])
        told = []
        for number, shot in enumerate(self._shots):
            self.line = shot["line"]
            told.append(sampled(shot, self.recorded, number))
        for name in ("eye", "target", "roll_deg", "fovy_deg", "focus_m", "aperture"):
            arrays[name] = np.concatenate([one[name] for one in told])
        arrays["time"] = times
        shots, first = [], 0
        for shot in self._shots:
            shots.append({"first": first, "frames": len(shot["times"]), "planned": shot["camera"].planned})
            first += len(shot["times"])
        things = [*self._things]
        for thing, at, told_at in self._grown:
            self.line = told_at
            things.append(grown(thing, at, times))
        self.line = 1
        facts = {
            "schema": 1, "shots": shots, "captions": self._words(arrays), "air": self._air,
            "things": [thing.facts(arrays, number, self._breeze is not None) for number, thing in enumerate(things)],
            "lamps": self._lamps, "panels": self._panels,
            "surfaces": [
                one | {"look": look_facts(one["look"], arrays, f"look_surface{n}")} for n, one in enumerate(self._surfaces)
            ],
            "looks": {name: look_facts(look, arrays, f"look_{n}") for n, (name, look) in enumerate(self._looks.items())},
            "ground": None if self._ground_look is None else look_facts(self._ground_look, arrays, "look_ground"),
            "shutter": self._shutter, "samples": self._samples,
        }  # fmt: skip
        if puffs := self._blown(times, arrays):
            facts["puffs"] = puffs
        if self._labels:
            facts["labels"] = self._labels
        if clouds := self._clouded(arrays):
            facts["clouds"] = clouds
        self.line = 1
        facts |= {"breeze": self._breeze} if self._breeze else {}
        return facts | ({"gobo": self._gobo} if self._gobo else {}), arrays

    def _words(self, arrays: dict[str, np.ndarray]) -> list[dict[str, Any]]:
        """The captions, each with its place."""
        names = self.recorded.movers
        radii, (wide, high) = np.array([self.recorded.radius(name) for name in names]), self.recorded.size
        own = np.concatenate([np.full(len(shot["times"]), not shot["camera"].planned) for shot in self._shots])
        found = []
        for one in self._captions:
            self.line = one["line"]
            first, last = (round(one[name] * self.recorded.fps) for name in ("start_s", "end_s"))
            some, place = np.arange(len(own))[first : max(last, first + 1)], one["place"]
            some = some[own[some]]  # where a camera of the plan stands is not known here
            shown = arrays["time"][some]
            if not place and names and len(shown):
                places = np.stack([self.recorded.position(name, shown) for name in names], axis=1)
                eye, target, roll, lens = (arrays[name][some] for name in ("eye", "target", "roll_deg", "fovy_deg"))
                place = free_edge.chosen(eye, axes(eye, target, roll), lens, places, radii, wide / high)
            found.append({name: one[name] for name in ("text", "start_s", "end_s")} | {"place": place or "bottom"})
        self.line = 1
        return found
