"""What a film's author gets of a world with two laws: steam that a body of balls shows, and what soaks a sponge, which is none."""

import numpy as np

STILL = {
    "time": np.linspace(0.0, 4.0, 9),
    "pos": np.zeros((9, 2, 3)),
    "quat": np.tile([1.0, 0.0, 0.0, 0.0], (9, 2, 1)),
    "middle": np.zeros((2, 3)),
    "half": np.full((2, 3), 0.01),
    "bodies": np.array(["kettle", "vapour"]),
    "cameras": np.array([], str),
    "movers": np.array(["kettle"]),
    "fps": np.array(24),
    "size": np.array([64, 36]),
    "floor_z": np.array(0.0),
    **{f"touch_{name}": np.zeros(0) for name in ("time", "a", "b", "force")},
    "law_names": np.array(["steam", "soak"]),
    "law_shown_by": np.array(["vapour", "sponge"]),
    "law_grains": np.array(["vapour"]),
    "law0_time": np.array([0.0, 4.0]),
    "law0_points": np.array([[[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]], [[1.0, 0.0, 2.0], [0.0, 0.0, 4.0]]]),
    "law1_time": np.array([0.0, 4.0]),
    "law1_points": np.array([[[0.0, 3.0, 0.0], [0.2, 3.0, 0.0]]] * 2),
    "law1_at": np.array([0.0, 4.0]),
    **{f"law1_{name}": np.array([1.0, 2.0]) for name in ("mass", "energy", "stored", "volume")},
}
