"""An arm as a row of a plan: what it picks up, and what it puts it on."""

from pydantic import Field, field_validator

from worldkit.robots.arms import ARMS

from ..frozen import Frozen


class Picks(Frozen):
    """One thing that an arm picks and places; where both are says the plan as it places them."""

    thing: str
    """The object that it picks: free to move, no wider than its hand opens."""
    places_on: str
    """The object that it puts it on, in the middle of a face that is wide enough."""
    arm: str
    """Which arm the model is: yam."""
    board: int = Field(-1, ge=-50, le=50)
    """Which of the faces of `places_on`, 0 the lowest, -1 the highest."""
    from_s: float = Field(0.0, ge=0, allow_inf_nan=False)
    """When it begins."""
    speed_m_s: float = Field(0.25, gt=0, le=0.5)
    """The most of its hand."""

    @field_validator("arm")
    @classmethod
    def _known(cls, arm: str) -> str:
        if arm not in ARMS:
            raise ValueError(f"there is no arm `{arm}`; there are: {', '.join(sorted(ARMS))}")
        return arm

    def driven(self, name: str) -> dict[str, str]:
        """The motors of an arm in the world, each with its joint."""
        arm = ARMS[self.arm]
        return {f"{name}_{arm.motor(joint)}": f"{name}_{joint}" for joint in arm.driven}

    @property
    def law(self) -> str:
        """What acts."""
        arm = ARMS[self.arm]
        return (
            f"torques of the joints' motors, at most {max(motor.limit for motor in arm.motors):g} N·m, by operational space control of the "
            f"hand, which goes to {self.thing}, closes its fingers with at most {arm.grip.limit:g} N, carries it to {self.places_on} and opens"
        )

    @property
    def source(self) -> str:
        """Where that is from."""
        return f"picks {self.thing}, places_on {self.places_on}"
