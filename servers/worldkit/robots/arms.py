"""Arms with a gripper: joints, motors, and where the fingers hold."""

from dataclasses import dataclass

from .gaits import Servo


@dataclass(frozen=True)
class Motor:
    """What turns a joint by its torque."""

    limit: float
    """N·m."""
    armature: float
    """kg·m²: the rotor's inertia times the square of the gear's ratio."""


@dataclass(frozen=True)
class Arm:
    """Of one kind of robot; names are its own, without the name of the object."""

    joints: tuple[str, ...]
    motors: tuple[Motor, ...]
    hand: str
    """The body that the fingers slide in."""
    tip: tuple[float, float, float]
    """Between the tips of the fingers, m, in the frame of the hand, whose +Z points along them and +X from one to the other."""
    fingers: tuple[str, ...]
    """Their slides: the first opens towards + and has the motor, the others follow it."""
    grip: Servo
    """Of the first finger: N/m, N·s/m, N, kg, N."""
    open_m: float
    """Of the first finger's slide."""
    width_m: float
    """Free between the fingers when they are open."""
    depth_m: float
    """How much of a thing may be between the fingers, measured from their tips."""
    pad_m: float
    """How wide the fingers are across, half to each side."""

    def motor(self, joint: str) -> str:
        """The motor of a joint, or of the gripper: called as the joint, with `_motor`."""
        return f"{joint}_motor"

    @property
    def driven(self) -> tuple[str, ...]:
        """The joints that have a motor: the arm's, then the first finger."""
        return (*self.joints, self.fingers[0])

    @property
    def limits(self) -> tuple[float, ...]:
        """The most of each of their motors, N·m, and N of the finger's."""
        return (*(motor.limit for motor in self.motors), self.grip.limit)

    @property
    def armatures(self) -> tuple[float, ...]:
        """What each of their motors adds, kg·m², and kg to the finger."""
        return (*(motor.armature for motor in self.motors), self.grip.armature)


_SHOULDER, _WRIST = Motor(limit=28.0, armature=0.032), Motor(limit=10.0, armature=0.0018)
YAM = Arm(
    joints=("joint1", "joint2", "joint3", "joint4", "joint5", "joint6"),
    motors=(_SHOULDER,) * 3 + (_WRIST,) * 3,
    hand="link_6",
    tip=(0.0, -0.044, 0.1465),
    fingers=("left_finger", "right_finger"),
    grip=Servo(gain=2000.0, damping=120.0, limit=20.0, armature=2.6, friction=0.0),
    open_m=0.0375,
    width_m=0.076,
    depth_m=0.06,
    pad_m=0.006,
)
"""I2RT YAM: the motors (DM4340, DM4310) and the gripper's transmission as mjlab states them (28 N·m, 10 N·m, 71 mm of stroke for
2.7 rad, hence 2.6 kg of rotor); the grip is held to 20 N, half of what mjlab allows it."""
ARMS = {"yam": YAM}
"""By the key of the robot."""
