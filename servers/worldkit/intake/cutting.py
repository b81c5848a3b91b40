"""A process that cuts a mesh into convex pieces, so that a cut without end costs a bounded time: `python -m worldkit.intake.cutting`.

Its arguments are a file with `vertices`, `faces` and the numbers below, the file for the pieces, and its seconds of processor time.
Source: X. Wei et al., "Approximate convex decomposition for 3D meshes with collision-aware concavity" (2022), CoACD.
"""

import os
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np

Array = np.ndarray
CONCAVITY, MOST_HULLS, CORNERS, SEED = 0.05, 32, 40, 7
CLOSED = {"preprocess_mode": "auto", "mcts_iterations": 100}
OPEN = {"preprocess_mode": "on", "preprocess_resolution": 30, "mcts_iterations": 60, "resolution": 1000}
"""What is no solid is made one first, of many small faces, which are then cut less carefully."""
LIMIT_S, OVER = 60, 124


def cut(vertices: Array, faces: Array, closed: bool, limit_s: int = LIMIT_S) -> list[Array]:
    """The corners (N, 3) of convex pieces of a mesh.

    Raises:
        ValueError: it could not be cut within so many seconds of processor time, or not at all.
    """
    with tempfile.TemporaryDirectory() as folder:
        given, made = Path(folder) / "given.npz", Path(folder) / "made.npz"
        np.savez(given, vertices=vertices, faces=faces, closed=closed)
        call = [sys.executable, "-s", "-P", "-m", "worldkit.intake.cutting", str(given), str(made), str(limit_s)]
        done = subprocess.run(call, capture_output=True, check=False)
        if done.returncode or not made.is_file():
            last = (
                done.stderr.decode(errors="replace").strip().splitlines() or [f"it ended with status {done.returncode}"]
            )[-1]
            raise ValueError(f"it took more than {limit_s} s" if done.returncode == OVER else last[:120])
        with np.load(made) as held:
            return [held[f"arr_{number}"] for number in range(len(held.files))]


def _ended_after(seconds: float) -> None:
    """End this process once it has computed for so long: a sandbox lets nobody change a limit of the kernel's."""
    while time.process_time() <= seconds:
        time.sleep(0.05)
    os._exit(OVER)


def main(argv: Sequence[str] | None = None) -> int:
    """Cut one mesh; returns the exit status."""
    given, made, limit = sys.argv[1:] if argv is None else argv
    threading.Thread(target=_ended_after, args=(float(limit),), daemon=True).start()
    import coacd

    with np.load(given) as held:
        vertices, faces, closed = held["vertices"], held["faces"], bool(held["closed"])
    coacd.set_log_level("error")
    parts = coacd.run_coacd(
        coacd.Mesh(vertices, faces.astype(np.int32)), threshold=CONCAVITY, max_convex_hull=MOST_HULLS,
        max_ch_vertex=CORNERS, seed=SEED, **(CLOSED if closed else OPEN),
    )  # fmt: skip
    np.savez(made, *(np.asarray(points, float) for points, _ in parts))
    return 0


if __name__ == "__main__":
    sys.exit(main())
