"""Vehicles that move because their wheels push on the ground: parametric, drawn whole, with a driver who follows a path.

from worldkit import vehicles

CAR = vehicles.Car(wheelbase_m=2.65, mass_kg=1400, tyre_friction=0.9)
vehicles.add(spec, CAR, name="car", pos=(0, 0, 0))
# in control(model, data):
vehicles.pedals(CAR, model, data, "car", steering_deg=4.0, throttle=0.3, brake=0.0)
"""

from .adding import add
from .bicycle_numbers import Bicycle
from .car_numbers import Car
from .driving_inputs import Commands, Timed, pedals
from .heavy_numbers import Bus, Trailer, Truck
from .path_following import Course, Driver
from .tracked_numbers import Tracked

__all__ = [
    "Bicycle", "Bus", "Car", "Commands", "Course", "Driver", "Timed", "Tracked", "Trailer", "Truck", "add", "pedals",
]  # fmt: skip
