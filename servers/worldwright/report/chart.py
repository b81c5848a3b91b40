"""Charts as data for the page: positions in percent, so that text stays text and the width follows the window.

The page draws the lines in one stretched SVG per chart and everything else in HTML; a script moves a common time cursor
over all of them and reads the values back from the drawn points.

Not uPlot: it adds 51 kB of script to every report, and draws nothing where scripts do not run; the bars of the contacts and
the paths at equal scale would stay as they are here.
"""

import math
from dataclasses import dataclass

from .series import Line, Touch

LEAST_SPAN = 0.02
"""An axis spans at least this share of its largest value."""


@dataclass(frozen=True)
class Tick:
    """A labelled position on an axis."""

    at: float
    """Percent of the axis, from the left or from the bottom."""
    label: str


@dataclass(frozen=True)
class Curve:
    """One line in a box of 1000 x 1000, y downwards."""

    name: str
    points: str
    tone: int


@dataclass(frozen=True)
class Chart:
    """A line chart."""

    title: str
    unit: str
    x0: float
    x1: float
    y0: float
    y1: float
    x_ticks: list[Tick]
    y_ticks: list[Tick]
    curves: list[Curve]
    note: str = ""


@dataclass(frozen=True)
class Bar:
    """A stretch of time, percent of the axis."""

    left: float
    width: float
    title: str


@dataclass(frozen=True)
class Row:
    """One row of the timeline."""

    name: str
    detail: str
    bars: list[Bar]


def over_time(title: str, unit: str, lines: list[Line], end: float, tones: dict[str, int], note: str = "") -> Chart:
    """Lines over 0 to `end` seconds; the y axis holds every value and, when it is near, zero."""
    values = [y for line in lines for y in line.y]
    low, high = (min(values), max(values)) if values else (0.0, 1.0)
    return _chart(title, unit, lines, (0.0, end or 1.0), _room(low, high), tones, note)


def from_above(lines: list[Line], tones: dict[str, int]) -> tuple[Chart, float]:
    """Paths in the ground plane at equal scale, and the box's width over its height."""
    xs = [x for line in lines for x in line.x] or [0.0]
    ys = [y for line in lines for y in line.y] or [0.0]
    reach = max(max(xs) - min(xs), max(ys) - min(ys), 0.05)
    width = max(max(xs) - min(xs), reach / 3) + 0.16 * reach
    height = max(max(ys) - min(ys), reach / 3) + 0.16 * reach
    mid = ((max(xs) + min(xs)) / 2, (max(ys) + min(ys)) / 2)
    x_range = (mid[0] - width / 2, mid[0] + width / 2)
    y_range = (mid[1] - height / 2, mid[1] + height / 2)
    return _chart("Paths from above", "m", lines, x_range, y_range, tones), width / height


def timeline(touches: list[Touch], end: float) -> list[Row]:
    """Contact intervals as bars."""
    rows = []
    for touch in touches:
        bars = []
        for start, stop in touch.spans:
            left, right = _percent(start, 0, end), _percent(min(stop, end), 0, end)
            bars.append(Bar(left, max(0.0, right - left), f"{start:.3f} to {stop:.3f} s"))
        times = "once" if len(bars) == 1 else f"{len(bars)} times"
        if touch.lasts(0.01 * end, 0.99 * end):
            times = "throughout"
        rows.append(Row(touch.name, f"{times}, up to {quantity(touch.peak_n)} N", bars))
    return rows


def ticks(low: float, high: float, count: int = 5) -> list[float]:
    """Round numbers from `low` to `high`, about `count` of them."""
    span = high - low
    raw = span / max(1, count)
    if not (math.isfinite(span) and raw > 1e-300):  # below that, numbers lose their digits and logarithms their range
        return [low]
    power = 10.0 ** math.floor(math.log10(raw))
    step = next(power * m for m in (1, 2, 2.5, 5, 10) if power * m >= raw * 0.999)
    first = math.ceil(low / step - 1e-9)
    return [i * step for i in range(first, math.floor(high / step + 1e-9) + 1)]


def axis(low: float, high: float, count: int) -> list[Tick]:
    """Labelled ticks of an axis."""
    values = ticks(low, high, count)
    return [Tick(_percent(v, low, high), _label(v, values)) for v in values]


def quantity(value: float) -> str:
    """A number to three significant digits, as people write it."""
    if not math.isfinite(value):
        return str(value)
    if value == 0 or 1e-3 <= abs(value) < 1e5:
        text = f"{value:,.0f}" if abs(value) >= 1000 else f"{value:.3g}"
        return text.replace(",", "\u202f").replace("-", "−")
    mantissa, _, exponent = f"{value:.2e}".partition("e")
    return f"{mantissa.replace('-', '−')}e{int(exponent)}"


def _room(low: float, high: float) -> tuple[float, float]:
    if low > 0 and low < 0.5 * high:
        low = 0.0
    if high <= low:
        pad = max(abs(low) * 0.1, 0.01)
        return low - pad, high + pad
    least = LEAST_SPAN * max(abs(low), abs(high))
    if high - low < least:  # what hardly changes is drawn as hardly changing, not as its rounding
        middle = (low + high) / 2
        low, high = middle - least / 2, middle + least / 2
    pad = 0.06 * (high - low)
    return (low if low == 0 else low - pad), high + pad


def _chart(
    title: str,
    unit: str,
    lines: list[Line],
    x_range: tuple[float, float],
    y_range: tuple[float, float],
    tones: dict[str, int],
    note: str = "",
) -> Chart:
    (x0, x1), (y0, y1) = x_range, y_range
    curves = [
        Curve(
            line.name,
            " ".join(
                f"{10 * _percent(x, x0, x1):.1f},{1000 - 10 * _percent(y, y0, y1):.1f}"
                for x, y in zip(line.x, line.y, strict=True)
            ),
            tones.get(line.name, i),
        )
        for i, line in enumerate(lines)
    ]
    return Chart(
        title,
        unit,
        x0,
        x1,
        y0,
        y1,
        axis(x0, x1, 6),
        axis(y0, y1, 4),
        curves,
        note,
    )


def _percent(value: float, low: float, high: float) -> float:
    return 100 * (value - low) / ((high - low) or 1.0)


def _label(value: float, every: list[float]) -> str:
    """A tick's number with just the digits that tell it from its neighbours."""
    step = abs(every[1] - every[0]) if len(every) > 1 else abs(value) or 1.0
    if step >= 1e5 or step < 1e-4:
        return quantity(value)
    digits = max(0, -math.floor(math.log10(step) + 1e-9))
    if round(step, digits) != round(step, digits + 1):
        digits += 1
    return f"{value + 0.0:.{digits}f}".replace("-", "−")
