"""The answer of `query`: numbers about one body in one stretch of time."""

from typing import Literal

from ...model.frozen import Frozen


class Touch(Frozen):
    """Contact with one other body."""

    other: str
    first_s: float
    share: float
    """Share of the window spent in contact, with hops of up to 20 ms, as stiff contacts make them."""
    max_force_n: float
    mean_force_n: float = 0.0
    """The mean over the rows in contact, N."""
    max_depth_m: float = 0.0
    last_s: float = 0.0


class Answer(Frozen):
    """What the recording says about one body."""

    body: str
    window_s: tuple[float, float]
    moved: bool = False
    """Whether it moved or turned by more than rounding: a thousandth of its own size, or of a radian."""
    moved_m: float
    """The farthest that it gets from where it was at the start of the window, m."""
    travelled_m: float
    """Length of its path, m."""
    from_m: tuple[float, float, float]
    to_m: tuple[float, float, float]
    max_speed_m_s: float
    max_speed_at_s: float = 0.0
    mean_speed_m_s: float
    max_spin_rad_s: float = 0.0
    turned_deg: float
    """Angle between its first and last orientation."""
    at_rest_from_s: float | None
    """The instant, s, from which it rests to the end of the window; None when it does not."""
    rests_s: tuple[tuple[float, float], ...] = ()
    """The longest stretches of rest, s, in the order of time."""
    rest_speed_m_s: float = 0.0
    """Below this speed, rim speed included, it rests: 2 % of the speed of falling by half its own size."""
    touching: Literal["yes", "no", "unknown"] = "unknown"
    """It is `unknown` when the recording holds no contacts."""
    touching_share: float = 0.0
    """Share of the window in which it touches anything, hops of up to 20 ms included."""
    max_force_n: float | None = None
    """Largest sum of the contact forces on it in one row; None: no forces were recorded."""
    max_force_at_s: float = 0.0
    touches: tuple[Touch, ...] = ()
    """The bodies that it touches; none where only the sums of forces were recorded."""
    notes: tuple[str, ...] = ()
    """Points that the recording leaves open."""

    def text(self) -> str:
        """A few lines."""
        start, end = self.window_s
        rest = (
            "not at rest at the end" if self.at_rest_from_s is None else f"at rest from {self.at_rest_from_s:.3f} s on"
        )
        lines = [
            (
                f"{self.body}, {start:.3f} to {end:.3f} s: {'moved' if self.moved else 'did not move'}: "
                f"{self.moved_m:.4g} m away, travelled {self.travelled_m:.4g} m, turned {self.turned_deg:.1f} deg"
            ),
            (
                f"  speed at most {self.max_speed_m_s:.4g} m/s (at {self.max_speed_at_s:.3f} s), {self.mean_speed_m_s:.4g} m/s on "
                f"average; spin at most {self.max_spin_rad_s:.4g} rad/s"
            ),
            f"  {rest} (under {self.rest_speed_m_s:.3g} m/s)"
            + "".join(f"; rests {a:.3f} to {b:.3f} s" for a, b in self.rests_s),
        ]
        if self.touching == "unknown":
            lines.append("  touching: the recording does not tell")
        elif self.touching == "no":
            lines.append("  touches nothing")
        else:
            force = (
                ""
                if self.max_force_n is None
                else f", with up to {self.max_force_n:.3g} N at {self.max_force_at_s:.3f} s"
            )
            lines.append(f"  touches something for {self.touching_share:.0%} of the time{force}")
        for touch in self.touches:
            lines.append(
                f"  touches {touch.other} from {touch.first_s:.3f} to {touch.last_s:.3f} s, {touch.share:.0%} of the time, "
                f"with up to {touch.max_force_n:.3g} N ({touch.mean_force_n:.3g} N on average), "
                f"{touch.max_depth_m * 1000:.2g} mm deep"
            )
        return "\n".join([*lines, *(f"  note: {note}" for note in self.notes)])
