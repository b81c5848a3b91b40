"""One skin over a chain of bodies: a tapered limb with twigs and leaves, each piece fixed to the body that it grows on.

A branch is simulated as capsules on hinges; drawn, it is one piece of wood. Its tube is made whole, as the chain stands at the start,
and cut where two bodies meet, a little beyond on both sides, so that no gap opens as it bends.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ..errors import ProgramError
from . import skin_fit
from .drawn_only import Surface
from .dressing import Dressing
from .plain_refusals import whole
from .trees import Mesh, joined, limb

SIDES = 14
SHARES = (0.0, 0.08, 0.36, 0.64, 0.92)
"""Where along each body the tube has a ring; the first past a joint still belongs to the body before it, and so back."""
TURN = 2.399963
"""Twigs follow each other around the wood by the golden angle, radians."""


class Limbs(Dressing):
    """Dressing, with limbs over chains of bodies."""

    def limb(
        self,
        name: str,
        bodies: Sequence[str],
        thick: tuple[float, float],
        *,
        twigs: int = 0,
        twig: float = 0.1,
        leaf: "Sequence[np.ndarray] | None" = None,
        look: str | Surface = "#4a3829",
        leaves: str | Surface = "leaf_green",
        seed: int = 1,
    ) -> None:
        """Draw one tapered limb in place of a chain of bodies, `["branch_1", …, "branch_6"]`, from its root to its tip.

        `thick` is the diameter at the root and at the tip, m. Each body bears `twigs` of about `twig` m, each with three of `leaf`: a
        mesh along x whose first two parts are vertices (V, 3), m, and faces (F, 3), as `sculpt.leaf(0.07, veins=0)` gives it.
        Each piece is a skin of its body: in each direction 0.4 to 2.5 times its size, and a body thinner than 6 mm may be drawn up to
        15 mm thick. What is drawn on a body goes with it; the joints are taken to lie halfway between the middles of two bodies.

        Raises:
            ProgramError: there are fewer than two bodies, one twice or unknown, a size that is not above 0, or
                a piece that does not have its body's size.
        """
        chain = list(bodies)
        good = len(chain) == len(set(chain)) >= 2 and len(thick) == 2 and min(*thick, twig) > 0 and 0 <= twigs <= 20
        if not good:
            raise ProgramError(
                f"the limb {name!r} is no chain of bodies with a diameter at its root and its tip",
                "film.py",
                'film.limb("branch", ["branch_1", "branch_2"], (0.014, 0.005))',
            )
        middles = np.stack([self.recorded.position(body, 0.0) for body in chain])
        ends = 0.5 * (middles[:-1] + middles[1:])
        ends = np.concatenate([[2 * middles[0] - ends[0]], ends, [2 * middles[-1] - ends[-1]]])
        if np.linalg.norm(np.diff(ends, axis=0), axis=1).min() < 1e-6:
            raise ProgramError(
                f"two bodies of the limb {name!r} are in one place", "film.py", "name them from root to tip"
            )
        way = np.concatenate([[a + share * (b - a) for share in SHARES] for a, b in pairwise(ends)])
        way = np.concatenate([way, ends[-1:]])
        far = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(way, axis=0), axis=1))])
        radii = 0.5 * np.interp(far / far[-1], [0.0, 1.0], thick)
        points, _ = limb(way, radii.tolist(), SIDES)
        random = np.random.default_rng(whole(seed))
        for number, body in enumerate(chain):
            first = max(number * len(SHARES) - 1, 0)
            last = min((number + 1) * len(SHARES) + 1, len(way) - 1)
            mine = self.recorded.into(body, points[first * SIDES : (last + 1) * SIDES])
            middle, half = self.recorded.box(body)
            cause = skin_fit.misfit(f"{name} {number + 1}", body, mine, middle - half, middle + half)
            if cause and self.recorded.sized:
                raise ProgramError(cause, "film.py", skin_fit.REMEDY)
            self.mesh(f"{name} {number + 1}", mine, _tube(last - first + 1), to=body, instead=True, look=look)
            if not twigs:
                continue
            grown = [
                _twig(ends[number], ends[number + 1], float(radii[number * len(SHARES)]), turn, twig, leaf, random)
                for turn in TURN * (number * twigs + np.arange(twigs))
            ]
            for part, meshes, given in (
                ("twigs", [g[0] for g in grown], look),
                ("leaves", [m for g in grown for m in g[1]], leaves),
            ):
                if meshes:
                    vertices, faces = joined(meshes)
                    self.mesh(
                        f"{name} {number + 1} {part}", self.recorded.into(body, vertices), faces, to=body, look=given
                    )


def _tube(rings: int) -> np.ndarray:
    """Faces of a tube of so many rings, closed at both ends."""
    k = np.arange(rings * SIDES).reshape(rings, SIDES)
    a, b = k[:-1].ravel(), np.roll(k, -1, axis=1)[:-1].ravel()
    around = np.vstack([np.stack([a, b, b + SIDES], 1), np.stack([a, b + SIDES, a + SIDES], 1)])
    fan = np.array([(0, i + 1, i) for i in range(1, SIDES - 1)])
    return np.vstack([around, fan, fan[:, ::-1] + (rings - 1) * SIDES])


def _twig(
    root: np.ndarray,
    tip: np.ndarray,
    radius: float,
    turn: float,
    long: float,
    leaf: "Sequence[np.ndarray] | None",
    random: np.random.Generator,
) -> tuple[Mesh, list[Mesh]]:
    """A bent twig that leaves the wood at a turn about it, and its leaves: two beside it, one at its end."""
    ahead = (tip - root) / np.linalg.norm(tip - root)
    side = np.cross(ahead, [0.0, 0.0, 1.0] if abs(ahead[2]) < 0.9 else [1.0, 0.0, 0.0])
    side /= np.linalg.norm(side)
    out = np.cos(turn) * side + np.sin(turn) * np.cross(side, ahead)
    long *= random.uniform(0.7, 1.2)
    foot = root + random.uniform(0.15, 0.9) * (tip - root)
    grows = 0.65 * ahead + out
    grows /= np.linalg.norm(grows)
    end = foot + long * (grows + np.array([0.0, 0.0, 0.15]))
    middle = foot + 0.5 * long * grows
    thin = min(radius, 0.02 * long + 0.0004)
    wood = limb(np.array([foot, middle, end]), [thin, 0.7 * thin, 0.35 * thin], 5)
    if leaf is None:
        return wood, []
    vertices, faces = np.asarray(leaf[0], dtype=float), np.asarray(leaf[1], dtype=int)
    stalk = vertices[:, 0].min()
    found = []
    for place, lean in ((middle, 0.9), (middle + 0.4 * (end - middle), -0.9), (end, 0.0)):
        level = np.cross([0.0, 0.0, 1.0], grows)
        level = level / np.linalg.norm(level) if np.linalg.norm(level) > 1e-6 else side
        forward = (
            np.cos(lean) * grows + np.sin(lean) * level - [0.0, 0.0, random.uniform(0.1, 0.6)]
        )  # a leaf hangs a little
        forward /= np.linalg.norm(forward)
        across = np.cross([0.0, 0.0, 1.0], forward) + random.normal(0.0, 0.25, 3)
        across -= (across @ forward) * forward
        across /= np.linalg.norm(across)
        frame = np.stack([forward, across, np.cross(forward, across)])
        found.append((place + random.uniform(0.75, 1.1) * (vertices - [stalk, 0.0, 0.0]) @ frame, faces))
    return wood, found
