"""What the planner saw in the reference image: the auditable `image_observation` block of section `topology`.

    image_observation:
      image: reference.png
      viewpoint: perspective                      # a view name; it becomes the first camera's
      visible: [table, {name: mug, described: a red mug near the edge}]
      relations:
        - {subject: mug, relation: left_of, object: laptop}
      facing:
        - {subject: chair, direction: away}       # or  toward: table

Directions are those of the picture: `left_of` and `right_of` by where centres appear, `in_front_of` and `behind` by
distance from the viewer. The block holds observations, not placement: rows place, and `place check` says where they
disagree with it. Source: the reference paper's appendix, "Optional Image Input" (the relations' names and meanings are
ours).
"""

from typing import Any, Literal

from pydantic import field_validator, model_validator

from ..frozen import Frozen

Viewpoint = Literal[
    "perspective",
    "close_up",
    "top_down",
    "side_minus_x",
    "side_plus_x",
    "side_minus_y",
    "side_plus_y",
    "camera_side_minus_x",
    "camera_side_plus_x",
    "camera_side_minus_y",
    "camera_side_plus_y",
    "inside_minus_x_wall",
    "inside_plus_x_wall",
    "inside_minus_y_wall",
    "inside_plus_y_wall",
]
Relation = Literal["left_of", "right_of", "in_front_of", "behind", "above", "below", "on", "inside", "beside"]
REFERENCE_VIEW = "reference_view"
"""Name of the camera that is added for the viewpoint when the plan's first camera looks from elsewhere."""


class Visible(Frozen):
    """An object of the plan that is seen in the image."""

    name: str
    described: str = ""


class SeenRelation(Frozen):
    """How one object appears relative to another."""

    subject: str
    relation: Relation
    object: str


class SeenFacing(Frozen):
    """Which way an object's front points, in the picture or at another object."""

    subject: str
    direction: Literal["toward_viewer", "away", "left", "right"] | None = None
    toward: str | None = None

    @model_validator(mode="after")
    def _one(self) -> "SeenFacing":
        if (self.direction is None) == (self.toward is None):
            raise ValueError("needs either `direction` or `toward`")
        return self


class ImageObservation(Frozen):
    """The whole block."""

    image: str = "reference.png"
    viewpoint: Viewpoint
    visible: tuple[Visible, ...] = ()
    relations: tuple[SeenRelation, ...] = ()
    facing: tuple[SeenFacing, ...] = ()

    @field_validator("visible", mode="before")
    @classmethod
    def _named(cls, value: Any) -> Any:
        if isinstance(value, list | tuple):
            return tuple({"name": v} if isinstance(v, str) else v for v in value)
        return value
