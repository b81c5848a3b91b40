"""Robots: packaged ones by name, policies that walk them, what they are shown of the world, and what they are told.

from worldkit import robots

WALKERS = robots.walkers(("go2",), "go2", "go2/walk.onnx")
"""

from .gaits import GAITS, Gait, Servo
from .policies import Policy, PolicyError, read
from .walking import Walkers, along, walkers

__all__ = ["GAITS", "Gait", "Policy", "PolicyError", "Servo", "Walkers", "along", "read", "walkers"]
