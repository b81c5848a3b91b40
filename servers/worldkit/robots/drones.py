"""Drones: rotors, what they lift, and the drag of the air."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Rotor:
    """One rotor, which pushes along its site's +Z."""

    name: str
    """Of its actuator, without the name of the object."""
    site: str
    place: tuple[float, float]
    """m, in the frame of the drone."""
    spin: int
    """+1 where its drag turns the drone to the left (it turns to the right itself), else -1."""


@dataclass(frozen=True)
class Drone:
    """Of one kind; names are its own, without the name of the object."""

    rotors: tuple[Rotor, Rotor, Rotor, Rotor]
    most_n: float
    """Thrust of a rotor."""
    drag_m: float
    """N·m of torque about its axis for each N of thrust."""
    air: tuple[float, float, float]
    """N of drag for each m/s of the air past it, along its own axes."""


_ARM = 0.03536
CF21B = Drone(
    rotors=(
        Rotor("rotor0", "motor0", (_ARM, -_ARM), -1),
        Rotor("rotor1", "motor1", (-_ARM, -_ARM), 1),
        Rotor("rotor2", "motor2", (-_ARM, _ARM), -1),
        Rotor("rotor3", "motor3", (_ARM, _ARM), 1),
    ),
    most_n=0.2,
    drag_m=0.00594,
    air=(0.0215, 0.0215, 0.0236),
)
"""Bitcraze Crazyflie 2.1 Brushless, as the wheel `drone-models` has measured it (`data/params.toml`, cf21B_500)."""
DRONES = {"cf21b": CF21B}
"""By the key of the robot."""
