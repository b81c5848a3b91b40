"""What a walking policy is shown of its robot, as MuJoCo Playground's joystick tasks lay it out; of many robots row by row.

Each number is in the order of the policy's own training. Lengths are metres, angles radians, times seconds; the frame is
that of the inertial sensor (a site). Source: MuJoCo Playground, `locomotion/go1/joystick.py`, `t1/joystick.py`, `g1/joystick.py`
(the observation `state`).
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco
    import numpy as np

STRIDE_HZ = 1.5
"""Of the two-legged robots' phase."""


def felt(model: "mujoco.MjModel", data: "mujoco.MjData", site: str) -> "np.ndarray":
    """(9,) at a site, in its frame: its velocity (m/s), its angular velocity (rad/s), the direction of gravity (unit)."""
    import mujoco
    import numpy as np

    number = model.site(site).id
    twist = np.zeros(6)
    mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_SITE, number, twist, 1)
    down = -data.site_xmat[number].reshape(3, 3)[2]
    return np.concatenate((twist[3:], twist[:3], down))


def four_legs(
    felt: "np.ndarray", away: "np.ndarray", rates: "np.ndarray", last: "np.ndarray", command: "np.ndarray"
) -> "np.ndarray":
    """Go1 (48): what is felt, joints away from their home, their rates, the last action, the command.

    Args:
        felt: (9,) of `felt`.
        away: (12,) rad, joint angles less those of the home pose.
        rates: (12,) rad/s.
        last: (12,) the action before, as the policy gave it.
        command: (3,) forward and left, m/s, and turning left, rad/s.
    """
    import numpy as np

    return np.concatenate((felt, away, rates, last, command), axis=-1)


def scaled_four_legs(
    felt: "np.ndarray", away: "np.ndarray", rates: "np.ndarray", last: "np.ndarray", command: "np.ndarray"
) -> "np.ndarray":
    """Go2 (45), which is not shown its velocity: 0.25 of the angular velocity, gravity, command, joints, 0.05 of their rates, action.

    Arguments as for `four_legs`. Source: rl_sar, `policy/go2/robot_lab/config.yaml`.
    """
    import numpy as np

    return np.concatenate((0.25 * felt[..., 3:6], felt[..., 6:], command, away, 0.05 * rates, last), axis=-1)


def two_legs(
    felt: "np.ndarray", away: "np.ndarray", rates: "np.ndarray", last: "np.ndarray", command: "np.ndarray", phase: "np.ndarray"
) -> "np.ndarray":  # fmt: skip
    """T1 (85, 23 joints) and G1 (103, 29): what is felt, the command, the joints, the last action, cosine and sine of the phase.

    Args:
        felt: (9,), as for four legs; `away`, `rates`, `last` (J,) and `command` (3,) too.
        away: as for four legs. Of T1 the two joints of the head are shown as 0, here and in `rates`.
        rates: rad/s.
        last: the action before.
        command: m/s and rad/s.
        phase: (2,) rad, of the left and the right leg, of `stride`.
    """
    import numpy as np

    return np.concatenate((felt, command, away, rates, last, np.cos(phase), np.sin(phase)), axis=-1)


def stride(time: float, standing: bool = False) -> "np.ndarray":
    """(2,) rad in [-pi, pi): the phases of the two legs at a time (s); both are pi where the robot is to stand."""
    import numpy as np

    if standing:
        return np.full(2, np.pi)
    phase = np.array([0.0, np.pi]) + 2 * np.pi * STRIDE_HZ * time
    return np.mod(phase + np.pi, 2 * np.pi) - np.pi
