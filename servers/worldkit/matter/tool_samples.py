"""What of a tool or a float lies where, for a liquid that knows columns only: its room as some hundred samples that go with its body."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..errors import ProgramError
from .touched_geoms import Geoms

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray
LEAST, MOST = 3, 40
"""Samples along each side of a geom's box."""


class Samples:
    """Samples of the room of some bodies.

    Args:
        model, data: the world as it begins.
        bodies: names.
        apart: m, about, from one sample to the next.

    Raises:
        ProgramError: a body is not there, or has no geom that collides.
    """

    def __init__(self, model: "mujoco.MjModel", data: "mujoco.MjData", bodies: Sequence[str], apart: float) -> None:
        self.bodies, places, sizes, owners, self.coarse = [], [], [], [], apart
        self.thin = np.full(len(bodies), apart)
        """m: the thinnest side of the largest part of each."""
        for row, body in enumerate(bodies):
            geoms = Geoms(model, [body], 2 * apart)
            geoms.place(data)
            number = int(geoms.bodies[0])
            self.bodies.append(number)
            if not geoms.ids:
                cause = f"{body} has nothing that collides, and stirs nothing"
                raise ProgramError(cause, "worldkit.matter.Stirred", "let its parts collide")
            turn = data.xmat[number].reshape(3, 3)
            largest = max(geoms.ids, key=lambda geom: float(np.prod(model.geom_aabb[geom, 3:])))
            self.thin[row] = max(2 * float(model.geom_aabb[largest, 3:].min()), 0.5 * apart)
            for geom in geoms.ids:
                box, frame = model.geom_aabb[geom], data.geom_xmat[geom].reshape(3, 3)
                counts = np.clip(np.ceil(2 * box[3:] / apart), LEAST, MOST).astype(int)
                axes = [(np.arange(n) + 0.5) / n * 2 - 1 for n in counts]
                own = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3) * box[3:] + box[:3]
                there = own @ frame.T + data.geom_xpos[geom]
                inside = there[geoms.gaps(there)[0] < 0.0]
                places.append((inside - data.xpos[number]) @ turn)
                sizes.append(np.full(len(inside), float(np.prod(2 * box[3:] / counts))))
                owners.append(np.full(len(inside), row))
        self._local = np.concatenate(places) if places else np.zeros((0, 3))
        self.sizes = np.concatenate(sizes) if sizes else np.zeros(0)
        self.owners = np.concatenate(owners) if owners else np.zeros(0, int)

    def now(self, data: "mujoco.MjData", bodies: Array) -> tuple[Array, Array, Array, Array]:
        """Places (s, 3) m, velocities (s, 3) m/s, room (s,) m^3 and owners (s,); bodies (k, 9) as `BodyMotion.now` tells them."""
        at = np.array(self.bodies)[self.owners] if len(self.owners) else np.zeros(0, int)
        places = data.xpos[at] + np.einsum("nij,nj->ni", data.xmat[at].reshape(-1, 3, 3), self._local)
        mine = bodies[self.owners]
        ways = mine[:, 3:6] + np.cross(mine[:, 6:], places - mine[:, :3])
        return places, ways, self.sizes, self.owners
