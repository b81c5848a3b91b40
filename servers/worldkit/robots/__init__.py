"""Robots: packaged ones by name, what drives them, policies that walk them, what they are shown of the world, what they are told.

from worldkit import robots

WALKERS = robots.walkers(("go2",), "go2", "go2/walk.onnx")
PICKER = robots.picker("yam", "yam", "mug", "shelf")
FLIER = robots.flier("drone", "cf21b", ((0, 0, 1), (1, 0, 1)))
MATCH = robots.match({"red": (10, 0), "blue": (-10, 0)}, "t1", "t1/walk.onnx", ball="ball", speed=0.6)
"""

from .arm_control import ArmControl
from .arms import ARMS, Arm
from .drones import DRONES, Drone
from .flying import Flier, flier
from .gaits import GAITS, Gait, Servo
from .gusts import Gusts
from .matches import Match, match
from .picking import Picker, PickError, picker
from .policies import Policy, PolicyError, read
from .walking import Walkers, along, walkers

__all__ = [
    "ARMS", "DRONES", "GAITS", "Arm", "ArmControl", "Drone", "Flier", "Gait", "Gusts", "Match", "PickError", "Picker", "Policy",
    "PolicyError", "Servo", "Walkers", "along", "flier", "match", "picker", "read", "walkers",
]  # fmt: skip
