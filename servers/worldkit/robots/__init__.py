"""Robots: packaged ones by name, what drives them, policies that walk them, what they are shown of the world, what they are told.

from worldkit import robots

WALKERS = robots.walkers(("go2",), "go2", "go2/walk.onnx")
PICKER = robots.picker("yam", "yam", "mug", "shelf")
FLIER = robots.flier("drone", "cf21b", ((0, 0, 1), (1, 0, 1)))
"""

from .arm_control import ArmControl
from .arms import ARMS, Arm
from .drones import DRONES, Drone
from .flying import Flier, flier
from .gaits import GAITS, Gait, Servo
from .gusts import Gusts
from .picking import Picker, PickError, picker
from .policies import Policy, PolicyError, read
from .walking import Walkers, along, walkers

__all__ = [
    "ARMS", "DRONES", "GAITS", "Arm", "ArmControl", "Drone", "Flier", "Gait", "Gusts", "PickError", "Picker", "Policy",
    "PolicyError", "Servo", "Walkers", "along", "flier", "picker", "read", "walkers",
]  # fmt: skip
