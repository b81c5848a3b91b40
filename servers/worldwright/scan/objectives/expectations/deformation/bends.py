"""Something bends: a joint, two bodies against each other, or a chain of three at its middle.

Measures the largest change of the angle since the start of the window, degrees: of the hinge; of the orientation of the
second body relative to the first; or, of three bodies, of the angle at the middle one between the ways to the others.
Source: kinematics of chains.
"""

import numpy as np
from pydantic import Field, model_validator

from worldkit.turning import matrices

from .....model.recording.trajectory import Trajectory
from ....known.structures import beam, hinged
from ....measuring.channels import joint
from ....measuring.measured import Measured, Name, UnknowableError, Windowed, at_least, body_index, one_of, window

CODE = "WE220"
EVENT = True


class Given(Windowed):
    """The joint or the bodies, and the angle to reach."""

    joint: Name | None = Field(None, description="a hinge; or")
    bodies: tuple[Name, ...] | None = Field(None, description="two bodies, or three in the order of the chain")
    min_deg: float = Field(gt=0, lt=360, description="least change of the angle, deg")

    @model_validator(mode="after")
    def _one(self) -> "Given":
        one_of(self, "joint", "bodies")
        if self.bodies is not None and len(self.bodies) not in (2, 3):
            raise ValueError("name two bodies, or three in the order of the chain")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the largest change of the angle."""
    rows = window(trajectory, given.window_s, 2)
    if given.joint:
        channel = joint(trajectory, given.joint)
        if channel.unit != "deg":
            raise UnknowableError(f"{given.joint} is a slide, which does not bend")
        angle, name = channel.values[rows], given.joint
        change = np.abs(angle - angle[0])
    else:
        name = ", ".join(given.bodies or ())
        bodies = [body_index(trajectory, body) for body in given.bodies or ()]
        change = _relative_turn(trajectory, rows, bodies) if len(bodies) == 2 else _at_middle(trajectory, rows, bodies)
    most = float(change.max())
    return at_least(most, given.min_deg, "deg", f"{name} bends by {most:.2f} degrees")


def _relative_turn(trajectory: Trajectory, rows: slice, bodies: list[int]) -> np.ndarray:
    """The turn of the second body as seen from the first, relative to the start, deg."""
    one, other = (matrices(trajectory.quat[rows, b]) for b in bodies)
    relative = np.einsum("tji,tjk->tik", one, other)
    trace = np.einsum("ij,tij->t", relative[0], relative)
    return np.degrees(np.arccos(np.clip((trace - 1) / 2, -1, 1)))


def _at_middle(trajectory: Trajectory, rows: slice, bodies: list[int]) -> np.ndarray:
    ends = [trajectory.pos[rows, b] - trajectory.pos[rows, bodies[1]] for b in (bodies[0], bodies[2])]
    sizes = np.linalg.norm(ends[0], axis=1) * np.linalg.norm(ends[1], axis=1)
    angle = np.degrees(np.arccos(np.clip((ends[0] * ends[1]).sum(axis=1) / sizes, -1, 1)))
    return np.abs(angle - angle[0])


CHAIN = ["beam_0", "beam_5", "beam_10"]  # 2 atan(0.1 / 0.5) = 22.62 degrees off straight
GOOD = (
    (lambda: hinged(30.0), {"joint": "hinge", "min_deg": 29.9}),
    (beam, {"bodies": CHAIN, "min_deg": 22.6}),
)
BAD = (
    (beam, {"bodies": CHAIN, "min_deg": 22.7}),
    (beam, {"bodies": ["beam_0", "beam_10"], "min_deg": 1}),
    (lambda: hinged(30.0), {"joint": "hinge", "min_deg": 31}),
)
