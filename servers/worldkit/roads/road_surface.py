"""A road from its file: where its reference line runs, how high it is beside it, and a lane to follow."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .crg_file import CrgFile, RoadFileError, read_crg

if TYPE_CHECKING:
    import numpy as np

CLOSES_M = 3.0
"""A line whose ends are so near to each other, and look the same way, is a circuit."""


@dataclass(frozen=True)
class Road:
    """A road in the frame of its file. Arrays along the reference line have N points, across it M sections."""

    line: "np.ndarray"
    """(N, 3) m: x, y and z of the reference line."""
    heading: "np.ndarray"
    """(N,) rad."""
    sections_m: "np.ndarray"
    """(M,) to the left of the line."""
    heights: "np.ndarray"
    """(N, M) m: of the surface, with slope and banking; what was not measured is as high as what is next to it."""

    @cached_property
    def closed(self) -> bool:
        """Whether it is a circuit."""
        import numpy as np

        gap = float(np.hypot(*(self.line[-1, :2] - self.line[0, :2])))
        turn = (self.heading[-1] - self.heading[0] + np.pi) % (2 * np.pi) - np.pi
        return gap < CLOSES_M and abs(turn) < 0.3 and len(self.line) > 10

    @cached_property
    def _near(self) -> Any:
        """Answers which point of the reference line is next to a place."""
        from scipy.spatial import cKDTree

        return cKDTree(self.line[:, :2])

    @cached_property
    def length_m(self) -> float:
        """Along the reference line."""
        import numpy as np

        return float(np.hypot(*np.diff(self.line[:, :2], axis=0).T).sum())

    def lane(
        self,
        left_m: float = 0.0,
        spacing_m: float = 4.0,
        at: tuple[float, float, float] = (0.0, 0.0, 0.0),
        yaw_deg: float = 0.0,
    ) -> "np.ndarray":
        """(K, 2) m: points of the line that runs `left_m` beside the reference line, for `vehicles.Course`.

        `at` and `yaw_deg` are those of the road in the world. Over `spacing_m` the heading of a survey is evened out.
        """
        import numpy as np

        x, y = self.line[:, 0] - left_m * np.sin(self.heading), self.line[:, 1] + left_m * np.cos(self.heading)
        along = np.concatenate([[0.0], np.cumsum(np.hypot(np.diff(x), np.diff(y)))])
        count = max(round(along[-1] / spacing_m), 3)
        wanted = np.linspace(0, along[-1], count + 1)
        window = max(round(spacing_m / max(along[-1] / len(along), 1e-9)), 1)
        points = np.stack([np.interp(wanted, along, _evened(v, window)) for v in (x, y)], axis=1)
        if self.closed:
            points = points[:-1] if np.hypot(*(points[-1] - points[0])) < spacing_m else points
        turn = np.radians(yaw_deg)
        c, s = np.cos(turn), np.sin(turn)
        return points @ np.array([[c, s], [-s, c]]) + np.asarray(at[:2])

    def height(self, points: "np.ndarray") -> "tuple[np.ndarray, np.ndarray]":
        """Heights (K,) m of places (K, 2), and how far beside the reference line they lie, (K,) m to the left.

        Beside the road it goes on as high as its edge; before its beginning and behind its end, as high as there.
        """
        import numpy as np

        line, count = self.line[:, :2], len(self.line)
        _, near = self._near.query(points)
        step = np.diff(line, axis=0)
        long = np.maximum(np.hypot(*step.T), 1e-9)
        best_u, best_v, best = np.zeros(len(points)), np.zeros(len(points)), np.full(len(points), np.inf)
        for offset in (-1, 0):  # the piece before the nearest point, and the one behind it
            piece = np.clip(near + offset, 0, count - 2)
            ahead = points - line[piece]
            along = (ahead * step[piece]).sum(axis=1) / long[piece] ** 2
            share = np.clip(along, 0, 1)
            away = ahead - share[:, None] * step[piece]
            side = (step[piece, 0] * ahead[:, 1] - step[piece, 1] * ahead[:, 0]) / long[piece]
            distance = np.hypot(*away.T)
            nearer = distance < best
            best_u = np.where(nearer, piece + share, best_u)
            best_v = np.where(nearer, np.where(side < 0, -distance, distance), best_v)
            best = np.minimum(best, distance)
        row = np.minimum(best_u.astype(int), count - 2)
        part = best_u - row
        across = np.clip(best_v, self.sections_m[0], self.sections_m[-1])
        column = np.clip(np.searchsorted(self.sections_m, across, side="right") - 1, 0, len(self.sections_m) - 2)
        wide = (across - self.sections_m[column]) / (self.sections_m[column + 1] - self.sections_m[column])
        z = self.heights
        low = z[row, column] * (1 - wide) + z[row, column + 1] * wide
        high = z[row + 1, column] * (1 - wide) + z[row + 1, column + 1] * wide
        return low * (1 - part) + high * part, best_v


def read(file: str | Path) -> Road:
    """A road of an OpenCRG file, which lies beside the program.

    Modifiers (`$ROAD_CRG_MODS`) are not applied: the world says where the road lies.

    Raises:
        RoadFileError: see `read_crg`; or its heights were nowhere measured.
    """
    from ..beside_program import found

    path = Path(file)
    if not path.is_absolute():
        try:
            path = found(str(file), "of the road")
        except ValueError as cause:
            raise RoadFileError(f"there is no file {file} beside the program") from cause
    return of_file(read_crg(path), path.name)


def of_file(made: CrgFile, name: str = "road") -> Road:
    """A road of what a file says.

    Source: ASAM OpenCRG 1.2, "Reference line": phi and slope of a row are those of the piece that ends there.
    """
    import numpy as np

    given = made.numbers
    count = len(made.grid)
    step = given["reference_line_increment"]
    start = {key: given.get(f"reference_line_start_{key}", 0.0) for key in ("x", "y", "z", "phi", "s", "b")}
    phi = made.channels.get("phi")
    heading = np.full(count, start["phi"]) if phi is None else np.array(phi)
    if not np.isfinite(heading[0]):
        heading[0] = start["phi"] if "reference_line_start_phi" in given else heading[1]
    slope = np.array(made.channels.get("slope", np.full(count, _constant_slope(given, start, count * step - step))))
    slope[0] = 0.0
    banking = np.array(made.channels.get("banking", np.full(count, start["b"])))
    banking[0] = banking[0] if np.isfinite(banking[0]) else banking[1]
    if not all(np.isfinite(values).all() for values in (heading, slope, banking)):
        raise RoadFileError(f"{name}: its reference line has gaps: heading, slope and banking are needed all along")
    x, y = (
        np.concatenate([[start[key]], start[key] + np.cumsum(step * turn(heading[1:]))])
        for key, turn in (("x", np.cos), ("y", np.sin))
    )
    z = start["z"] + np.cumsum(step * slope)
    grid = _filled(made.grid, name)
    heights = z[:, None] + banking[:, None] * made.sections_m[None, :] + grid
    return Road(np.stack([x, y, z], axis=1), heading, made.sections_m, heights)


def _constant_slope(given: dict[str, float], start: dict[str, float], length: float) -> float:
    if "reference_line_end_z" in given and not start["s"]:
        return (given["reference_line_end_z"] - start["z"]) / length
    return start["s"]


def _filled(grid: "np.ndarray", name: str) -> "np.ndarray":
    """Heights with those that were not measured as their nearest neighbours', first across the road, then along it."""
    import numpy as np

    known = np.isfinite(grid)
    if not known.any():
        raise RoadFileError(f"{name}: none of its heights was measured")
    if known.all():
        return grid
    from scipy.ndimage import distance_transform_edt

    rows, columns = distance_transform_edt(~known, sampling=(4.0, 1.0), return_distances=False, return_indices=True)
    filled: np.ndarray = grid[rows, columns]
    return filled


def _evened(values: "np.ndarray", window: int) -> "np.ndarray":
    """A running mean that keeps both ends."""
    import numpy as np

    if window < 2:
        return values
    half = min(window // 2, (len(values) - 1) // 2)
    padded = np.concatenate([2 * values[0] - values[half:0:-1], values, 2 * values[-1] - values[-2 : -half - 2 : -1]])
    return np.convolve(padded, np.ones(2 * half + 1) / (2 * half + 1), mode="valid")
