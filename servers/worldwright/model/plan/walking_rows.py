"""Robots that walk as rows of a plan: which policy walks a model, how it was trained, and where the robot is to go.

A model's row that says `walks` declares its servos and their controls by that (`robots_declared`), as a vehicle that is driven does.
The policy is a file beside the plan: who approves the plan approves it, by its hash.
"""

from pathlib import Path, PurePosixPath
from typing import Any

from pydantic import Field, field_validator, model_validator

from worldkit.robots.gaits import GAITS
from worldkit.robots.policies import PolicyError, checked

from ..errors import PlanError
from ..frozen import Frozen

Written = Any
"""A row of a plan, whose module imports this one."""


class Plays(Frozen):
    """The ball that a team plays, and the goal that it shoots at; the row of the other team names the same ball."""

    ball: str
    """An object that is free to move."""
    goal: tuple[float, float]
    """The middle of its line, m; each player's place in the team's order is where it starts."""


class Walks(Frozen):
    """A policy, and the line that the robot keeps to, or the ball that it plays."""

    policy: str = Field(pattern=r"\.onnx$")
    """An ONNX file beside the plan, relative to it: observations of `gait` in, one action a joint out."""
    gait: str
    """What the policy was trained with: joints, home pose, servos, observation. go1, go2, t1."""
    sha256: str = Field("", pattern=r"^([0-9a-fA-F]{64})?$")
    """Of the file, where it is to be one that was published."""
    address: str = ""
    """Where it is from."""
    licence: str = ""
    speed_m_s: float = Field(gt=0, le=2)
    """Along its line."""
    until_s: float | None = Field(None, gt=0, allow_inf_nan=False)
    """When it is to stand; None: it walks on."""
    y_m: float | None = Field(None, ge=-1000, le=1000)
    """How far to the left of the world's origin its line lies, seen along it; None: each robot's goes through where it starts."""
    heading_deg: float = Field(0.0, ge=-360, le=360)
    """Of its line, from +X to the left."""

    plays: Plays | None = None
    """In place of a line: the robots of two rows are two teams (`worldkit.robots.teams`)."""

    @field_validator("gait")
    @classmethod
    def _known(cls, gait: str) -> str:
        if gait not in GAITS:
            raise ValueError(f"there is no gait `{gait}`; there are: {', '.join(sorted(GAITS))}")
        return gait

    @model_validator(mode="after")
    def _beside(self) -> "Walks":
        path = PurePosixPath(self.policy)
        if path.is_absolute() or ".." in path.parts:
            raise ValueError(f"`{self.policy}` lies elsewhere: put the file beside the plan and name it from there")
        if self.plays is not None and not {"until_s", "y_m", "heading_deg"}.isdisjoint(self.model_fields_set):
            raise ValueError("who `plays` a ball keeps to no line: remove `until_s`, `y_m` and `heading_deg`")
        return self

    def driven(self, name: str) -> dict[str, str]:
        """The servos of a robot in the world, each with its joint."""
        gait = GAITS[self.gait]
        return {f"{name}_{gait.servo(joint)}": f"{name}_{joint}" for joint in gait.joints}

    @property
    def law(self) -> str:
        """What acts."""
        gait = GAITS[self.gait]
        way = f"along {self.heading_deg:g} degrees"
        if (plays := self.plays) is not None:
            goal = " ".join(f"{part:g}" for part in plays.goal)
            way = f"at most, after the ball {plays.ball} towards the goal at ({goal}) or to a place in the team's order"
        return (
            f"position servos, at most {max(servo.limit for servo in gait.servos):g} N·m, whose targets the policy {self.policy} sets every "
            f"{gait.tick:g} s: the home pose plus {', '.join(f'{scale:g}' for scale in sorted({*gait.scale}))} rad times its action, for "
            f"{self.speed_m_s:g} m/s {way}"
        )

    @property
    def source(self) -> str:
        """Where that is from."""
        return f"walks.policy {self.policy}" + (f", {self.address}" if self.address else "")


def policy_of(row: Written, folder: Path | None) -> Path | None:
    """The policy's file of a row that walks.

    Raises:
        PlanError: it is not there, not the one that the row means, or no policy that runs here.
    """
    if row.walks is None:
        return None
    home = Path() if folder is None else folder
    path = (home / row.walks.policy).resolve()
    if folder is None or not path.is_file() or not path.is_relative_to(home.resolve()):
        raise PlanError(
            f"asset `{row.name}`: there is no policy {row.walks.policy} beside the plan",
            next_move="ask the person to put the ONNX file there; a robot's own comes with it (`worldwright asset robot KEY FOLDER`)",
        )
    try:
        checked(path, row.walks.sha256)
    except PolicyError as error:
        raise PlanError(f"asset `{row.name}`: {error.place}: {error.cause}", next_move=error.next_move) from error
    return path
