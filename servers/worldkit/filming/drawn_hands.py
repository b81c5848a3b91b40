"""A hand that holds what was recorded, drawn only: it reaches in, closes, goes along with the body, lets go and withdraws.

It moves nothing. What the body does comes from the recording, and in the plan something that stands for the hand does it: a declared
intervention. The statement lists the hand, and the picture says `drawn: hand` where it is as large as what moves.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..errors import ProgramError
from ..sculpt.hand_paint import SKIN
from ..sculpt.hands import Hand, hand
from ..turning import quaternion
from .drawn_only import Surface, Thing, Vec3
from .limbs import Limbs
from .plain_refusals import line

ON_THE_WAY = 5
"""Poses that are drawn between open and closed, and the open one."""
CLOSES_S, COMES_S = 0.45, 1.1
"""How long fingers take to close, and before that the arm to come, in the time of the recording."""
BACK_M, REACH_M = 0.07, 1.0
"""How far an open hand draws back from what it held, and how far the arm then goes, with a hand of an adult."""
ADULT_M, ARM_M = 0.19, 0.62
"""Of an adult: from wrist to fingertip, and as much of an arm as leaves the picture of what a hand holds; a sleeve that ends in it is seen to."""
AIR_M = 0.02
"""A grip lies at most so far beside what it holds."""
LEVEL = 0.3
"""A rod whose way has a smaller share of up or down lies."""
FLEXION, DEVIATION = (-60.0, 65.0), (-28.0, 20.0)
"""Degrees that a wrist bends: from towards the back to towards the palm, from towards the little finger to towards the thumb."""


class DrawnHands(Limbs):
    """Dressing, with hands."""

    def hand(
        self,
        body: str,
        *,
        at: Vec3 = (0.0, 0.0, 0.0),
        grip: float = 0.0,
        pinch: float = 0.0,
        rod: float = 0.0,
        pose: str = "",
        axis: Vec3 = (1.0, 0.0, 0.0),
        palm: Vec3 | None = None,
        arm: Vec3 | None = None,
        side: str = "right",
        takes: float | None = None,
        leaves: float | None = None,
        sleeve: str = "#33475b",
        skin: str = SKIN,
        length: float = 0.19,
        name: str = "",
    ) -> None:
        """Draw a hand that holds a body and goes along with it; it moves nothing, and is listed as drawn.

        It closes around a bar of the diameter `grip`, m (a handle, a neck: 6 to 80 mm), holds what is `pinch` thick between thumb and
        index, or a `rod` as one holds a spoon or pen; or has the pose `flat`, `fist`, `point`, `open` or `relaxed`. Its middle is at
        `at`, m, the bar runs along `axis`, the palm looks to `palm` (down), and the arm comes from `arm`: all in the body's frame. Without
        `arm`, `axis` points to the thumb; with it the hand is turned so that the forearm lies that way, as far as a wrist bends. A rod
        with an `arm` needs no palm: it is held so that the wrist bends least.

        Without `takes` it holds from the start, else it reaches in and has closed at that time of the recording, s; from `leaves` on it
        opens and withdraws. `sleeve` and `skin` are colours; an empty sleeve leaves the arm bare. `length` is from wrist to fingertip, m.

        Raises:
            ProgramError: there is no such body or pose, the hand cannot hold what is so thick, a direction is none, or nothing of the
                body is `at` its grip.
        """
        self._carrier(body)
        wanted = {"grip": grip, "pinch": pinch, "hold_rod": rod}
        held = [key for key, size in wanted.items() if size]
        kind = pose or (held[0] if held else "relaxed")
        if len(held) > 1 or (held and pose):
            raise ProgramError("a hand has one pose: grip=, pinch=, rod= or pose=", "film.py", "give one of them")
        thumb, out, towards = _directions(axis, palm or (0, 0, -1), arm)
        handed = -1.0 if side == "left" else 1.0
        if held and self.recorded.sized:
            self._within_reach(body, at, wanted[held[0]])
        try:
            closed = hand(
                kind,
                wanted.get(kind, 0.0),
                side=side,
                length=length,
                forearm=ARM_M * length / ADULT_M,
                skin=skin,
                sleeve=sleeve,
            )
        except ValueError as cause:
            raise ProgramError(
                str(cause), "film.py", 'film.hand("kettle", at=(0, 0, 0.2), grip=0.025, axis=(1, 0, 0))'
            ) from None
        if palm is None and towards is not None and rod:
            # A pen's end points up out of the hand; of one that lies flat either may.
            tails = (thumb, -thumb) if abs(thumb[2]) < LEVEL else (np.sign(thumb[2]) * thumb,)
            held_so = (_easiest(closed, end, towards) for end in tails)
            thumb, out = max(held_so, key=lambda one: float(_forearm(closed, *one) @ towards))
        elif (
            towards is not None and handed * np.cross(thumb, out) @ towards > 0
        ):  # fingers point away from where the arm comes from
            thumb = -thumb
        turned = _turned(closed, thumb, out)
        if towards is not None:
            x, y, z = (-towards @ turned) * (1.0, handed, 1.0)
            bent = np.clip(np.degrees(np.arctan2(z, x)), *FLEXION)
            closed = replace(
                closed, pose=closed.pose.bent(bent, np.clip(-np.degrees(np.arcsin(np.clip(y, -1, 1))), *DEVIATION))
            )
        begins, ends = (None if t is None else float(t) for t in (takes, leaves))
        if begins is not None and ends is not None and not begins < ends:
            raise ProgramError(
                f"the hand takes {body!r} at {begins:g} s and leaves it at {ends:g} s", "film.py", "leave later"
            )
        whole = name or f"hand on {body}"
        way = _Way(turned, np.asarray(at, dtype=float) - turned @ closed.point, closed, begins, ends)
        opens = bool(held) and (begins is not None or ends is not None)
        poses = (
            [closed]
            if not opens
            else [
                closed.towards(replace(closed, pose=opened(closed).pose), n / ON_THE_WAY) for n in range(ON_THE_WAY + 1)
            ]
        )
        for number, one in enumerate(poses):
            for mesh in one.meshes(fine=number == 0):
                if mesh.name == "sleeve" and number:
                    continue
                look = Surface(colour=mesh.colour, roughness=mesh.roughness, picture=mesh.picture)
                label = " ".join([whole, mesh.name, *([str(number)] if number else [])])[:60]
                thing = Thing(
                    label,
                    "mesh",
                    (1, 1, 1),
                    look,
                    (0, 0, 0),
                    (1, 0, 0, 0),
                    vertices=mesh.vertices,
                    faces=mesh.faces,
                    uv=mesh.uv,
                    of=whole,
                )
                self._add(thing)
                always = mesh.name == "sleeve"
                self._grown.append(
                    (self._things.pop(), self._going(body, way, None if always else number, len(poses)), line())
                )

    def _within_reach(self, body: str, at: Vec3, size: float) -> None:
        """Refuse a grip in the air, as where `at` was told in another frame than the body's.

        Raises:
            ProgramError: nothing of the body is there.
        """
        middle, half = self.recorded.box(body)
        away = float(np.linalg.norm(np.maximum(np.abs(np.asarray(at, dtype=float) - middle) - half, 0.0)))
        if away > size / 2 + AIR_M:
            low, high = (np.round(corner, 3).tolist() for corner in (middle - half, middle + half))
            raise ProgramError(
                f"the hand would hold the air, {away:.2f} m beside {body!r}",
                "film.py",
                f"`at` is a point of the body's own frame, in which it reaches from {low} to {high}",
            )

    def _going(
        self, body: str, way: "_Way", number: int | None, count: int
    ) -> Callable[[np.ndarray], tuple[np.ndarray, ...]]:
        """Where a piece of a hand is at some recorded times: of one of its poses, or of what it has in all."""

        def at(times: np.ndarray) -> tuple[np.ndarray, ...]:
            moments = np.clip(
                times, way.begins if way.begins is not None else -np.inf, way.ends if way.ends is not None else np.inf
            )
            turn, origin = self.recorded.orientation(body, moments), self.recorded.origin(body, moments)
            open_, offset, seen = way.at(times)
            places = origin + np.einsum("fij,fj->fi", turn, way.place + offset)
            shown = seen & ((number is None) | (np.rint(open_ * (count - 1)) == number))
            turns = np.array([quaternion(one @ way.turned) for one in turn])
            return places[:, None], shown[:, None].astype(float), turns[:, None]

        return at


def _turned(closed: Hand, thumb: np.ndarray, out: np.ndarray) -> np.ndarray:
    """How a hand is turned (3, 3) that holds a bar along `thumb`, with its back to `out`."""
    handed = -1.0 if closed.left else 1.0
    there = np.stack([handed * np.cross(thumb, out), thumb, out], axis=1)
    found: np.ndarray = there @ np.stack([handed * np.cross(closed.axis, closed.into), closed.axis, closed.into])
    return found


def _forearm(closed: Hand, thumb: np.ndarray, out: np.ndarray) -> np.ndarray:
    """Where the forearm of a hand comes from that is turned so, its wrist straight."""
    return np.asarray(_turned(closed, thumb, out) @ (-1.0, 0.0, 0.0))


def _easiest(closed: Hand, thumb: np.ndarray, towards: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Along a rod, and where the back of the hand looks when it bends its wrist least for an arm that comes from `towards`."""
    side = np.cross(thumb, (0.0, 0.0, 1.0) if abs(thumb[2]) < 0.9 else (1.0, 0.0, 0.0))
    side /= np.linalg.norm(side)
    turns = np.linspace(0.0, 2 * np.pi, 72, endpoint=False)
    ways = [np.cos(turn) * side + np.sin(turn) * np.cross(thumb, side) for turn in turns]
    return thumb, max(ways, key=lambda out: float(_forearm(closed, thumb, out) @ towards))


def _directions(axis: Vec3, palm: Vec3, arm: Vec3 | None) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Along the bar, out of the back of the hand, and to the elbow, each of length 1."""
    vectors = [np.asarray(v, dtype=float) for v in (axis, palm, *([] if arm is None else [arm]))]
    if any(v.shape != (3,) or not np.isfinite(v).all() or not np.linalg.norm(v) > 1e-6 for v in vectors):
        raise ProgramError(
            f"axis={axis}, palm={palm} or arm={arm} is no direction",
            "film.py",
            "axis=(1, 0, 0), palm=(0, 0, -1), arm=(0, -1, 0.3)",
        )
    along, looks, *rest = (v / np.linalg.norm(v) for v in vectors)
    across = looks - (looks @ along) * along
    if not np.linalg.norm(across) > 1e-3:
        raise ProgramError(
            f"a palm that looks to {palm} cannot lie on a bar along {axis}", "film.py", "the palm looks across the bar"
        )
    return along, -across / np.linalg.norm(across), rest[0] if rest else None


class _Way:
    """How a hand comes and goes in the frame of what it holds."""

    def __init__(
        self, turned: np.ndarray, place: np.ndarray, closed: Hand, begins: float | None, ends: float | None
    ) -> None:
        self.turned, self.place, self.begins, self.ends = turned, place, begins, ends
        scale = closed.bones.scale
        fore = closed.bones.forearm[1][:, 0] * (1.0, -1.0 if closed.left else 1.0, 1.0)
        self._back = BACK_M * scale * turned @ closed.into
        self._arm = -REACH_M * scale * turned @ fore
        if closed.pose.numbers()[:16].max() < 25.0:  # a flat hand lies on what it presses and is lifted off
            self._back = 1.5 * self._back

    def at(self, times: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """How far it is open, 0 to 1, and away (F, 3), m, from where it holds, and whether it is there at all, at some times."""
        before = np.zeros(len(times)) if self.begins is None else np.maximum(self.begins - times, 0.0)
        after = np.zeros(len(times)) if self.ends is None else np.maximum(times - self.ends, 0.0)
        since = np.maximum(before, after)
        open_ = _smooth(since / CLOSES_S)
        back, gone = (
            _smooth((since - 0.35 * CLOSES_S) / CLOSES_S),
            np.clip((since - 0.9 * CLOSES_S) / COMES_S, 0.0, 1.0),
        )
        offset = back[:, None] * self._back + (gone * gone * (3 - 2 * gone))[:, None] * (self._arm + self._back)
        return open_, offset, gone < 1.0


def opened(closed: Hand) -> Hand:
    """The hand as it is before it closes: fingers nearly straight, the thumb away from them."""
    angles = closed.pose.numbers()
    angles[:16] *= np.tile([1.0, 0.42, 0.30, 0.35], 4)
    angles[16:21] = 0.45 * angles[16:21] + 0.55 * np.array([46.0, 32.0, 6.0, 4.0, 6.0])
    return replace(closed, pose=closed.pose.of(angles))


def _smooth(share: np.ndarray) -> np.ndarray:
    clipped = np.clip(share, 0.0, 1.0)
    return np.asarray(clipped * clipped * (3 - 2 * clipped))
