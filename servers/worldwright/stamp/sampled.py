"""The trajectory in the accepted folder: plain numpy, to be replayed in `world.mjz` by anybody.

    import mujoco, numpy as np
    model = mujoco.MjSpec.from_file("world.mjz").compile()
    motion = np.load("trajectory.npz")           # t (T,), qpos (T, nq), qvel (T, nv), and the interchange of `scan`
    data = mujoco.MjData(model)
    data.qpos[:] = motion["qpos"][-1]; mujoco.mj_forward(model, data)

It holds every n-th recorded row, n as small as `BYTES` allows, and the last; `every` says n. The hash in the stamp is of
all rows. The same file can be scanned: `worldwright scan scan trajectory.npz`.
"""

import io
from pathlib import Path

from worldkit.files import write_atomic

NAME = "trajectory.npz"
BYTES = 2_000_000
"""Upper bound of the numbers in it, before compression."""


def write(recording: Path, path: Path) -> None:
    """Write the sampled trajectory of a recording folder."""
    import numpy as np

    from worldengine.recording import stored

    recorded = stored.open(recording)
    columns = {
        name: np.asarray(getattr(recorded, name)) for name in ("qpos", "qvel", "pos", "quat", "linvel", "angvel")
    }
    columns["energy"] = np.asarray(recorded.energy)
    rows = len(recorded.time)
    width = 8 * (1 + sum(int(np.prod(values.shape[1:])) for values in columns.values()))
    every = max(1, -(-rows * width // BYTES))
    kept = np.unique(np.append(np.arange(0, rows, every), rows - 1))
    buffer = io.BytesIO()
    np.savez_compressed(
        buffer,
        t=np.asarray(recorded.time)[kept],
        names=np.array(recorded.names, dtype=np.str_),
        every=np.array(every),
        **{name: values[kept] for name, values in columns.items()},
    )
    write_atomic(path, buffer.getvalue())
