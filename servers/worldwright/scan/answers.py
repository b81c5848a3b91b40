"""What `query` answers: numbers about one body in one stretch of time."""

from ..model.frozen import Frozen


class Touch(Frozen):
    """Contact with one other body."""

    other: str
    first_s: float
    share: float
    """Share of the window spent in contact."""
    max_force_n: float


class Answer(Frozen):
    """What the recording says."""

    body: str
    window_s: tuple[float, float]
    moved_m: float
    """Farthest from where it was at the start of the window."""
    travelled_m: float
    """Length of its path."""
    from_m: tuple[float, float, float]
    to_m: tuple[float, float, float]
    max_speed_m_s: float
    mean_speed_m_s: float
    turned_deg: float
    """Angle between its first and last orientation."""
    at_rest_from_s: float | None
    """From when on it stays under 2 cm/s to the end of the window; None: it does not."""
    touches: tuple[Touch, ...] = ()

    def text(self) -> str:
        """A few lines."""
        start, end = self.window_s
        rest = "never at rest" if self.at_rest_from_s is None else f"at rest from {self.at_rest_from_s:.3f} s"
        lines = [
            f"{self.body}, {start:.3f} to {end:.3f} s: moved {self.moved_m:.4f} m, travelled {self.travelled_m:.4f} m, "
            f"turned {self.turned_deg:.1f} deg, {rest}",
            f"  speed at most {self.max_speed_m_s:.4f} m/s, {self.mean_speed_m_s:.4f} m/s on average",
        ]
        for touch in self.touches:
            lines.append(
                f"  touches {touch.other} from {touch.first_s:.3f} s, {touch.share:.0%} of the time, "
                f"with up to {touch.max_force_n:.3g} N"
            )
        return "\n".join(lines)
