"""Light falls as claimed in a still: a shadow is so long, its edge so soft, a place so bright or of such a colour.

`shadow_length` and `edge_width` follow a line of the world, best on the ground from the foot of a thing through its shadow: the
longest stretch darker than halfway between its dark and its lit parts, metres; and the way over which the far end of that
stretch goes from 10 to 90 % of the light, metres. `brightness` is the mean luminance, 0 to 1, and `colour` the distance from a
colour, CIE 1976 Delta E, within `radius_m` of a place. Only the still of the first instant is looked at, as it was drawn: what
stands before a place hides it. Source: geometrical optics (a shadow of h / tan(elevation), a penumbra of d times the angle
of the light); IEC 61966-2-1; CIE 1976 L*a*b*.
"""

from typing import Literal

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.pictured import from_above
from ....measuring.measured import Measured, Point, UnknowableError, at_most, between
from ....measuring.through_cameras import OfCamera, luminance, sampled

CODE = "WE301"
LASTING = True
POINTS, CONTRAST = 600, 1.15
"""Samples of a line; how many times as bright as its shadow the lit part of it is at least."""
WHITE = (0.95047, 1.0, 1.08883)
"""X, Y and Z of the white point D65."""
LINES, PLACES = ("shadow_length", "edge_width"), ("brightness", "colour")


class Given(OfCamera):
    """Which number, where, in what range."""

    of: Literal["shadow_length", "edge_width", "brightness", "colour"] = Field(description="what is measured")
    line: tuple[Point, Point] | None = Field(None, description="of a shadow: two points of the world, m")
    place: Point | None = Field(None, description="of a brightness or colour: a point of the world, m")
    radius_m: float = Field(0.02, gt=0, description="how far around the place counts, m")
    min_m: float | None = Field(None, ge=0, description="least length or width, m")
    max_m: float | None = Field(None, gt=0, description="largest length or width, m")
    min_share: float | None = Field(None, ge=0, le=1, description="least luminance, of that of white")
    max_share: float | None = Field(None, ge=0, le=1, description="largest luminance, of that of white")
    colour: str | None = Field(None, pattern="^#[0-9a-fA-F]{6}$", description="the colour, `#rrggbb`")
    tolerance: float = Field(15.0, gt=0, description="largest distance from the colour, Delta E; 2 is just seen")

    @model_validator(mode="after")
    def _whole(self) -> "Given":
        if self.window_s is not None:
            raise ValueError("a still shows the first instant: leave `window_s` out")
        if self.of in LINES:
            if self.line is None or self.line[0] == self.line[1]:
                raise ValueError(f"`{self.of}` needs a `line` of two points apart from each other")
            if self.min_m is None and self.max_m is None:
                raise ValueError("give min_m, max_m or both")
        elif self.place is None:
            raise ValueError(f"`{self.of}` needs a `place`")
        if self.of == "brightness" and self.min_share is None and self.max_share is None:
            raise ValueError("give min_share, max_share or both")
        if self.of == "colour" and self.colour is None:
            raise ValueError("give the `colour`, #rrggbb")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The number asked for."""
    if given.of in LINES:
        return _shadow(trajectory, given)
    colours = _around(trajectory, given)
    told = f"at {_told(given.place)} in {given.camera}"
    if given.of == "brightness":
        value = float(luminance(colours).mean())
        return between(value, given.min_share, given.max_share, "1", f"the luminance is {value:.3f} {told}")
    wanted = np.array([int((given.colour or "#000000")[k : k + 2], 16) for k in (1, 3, 5)]) / 255
    mean = colours.mean(axis=0)
    apart = float(np.linalg.norm(_lab(mean) - _lab(wanted)))
    shown = "#" + "".join(f"{round(255 * float(c)):02x}" for c in mean)
    return at_most(apart, given.tolerance, "Delta E", f"the colour is {shown} {told}, {apart:.1f} from {given.colour}")


def _shadow(trajectory: Trajectory, given: Given) -> Measured:
    start, end = (np.array(point) for point in given.line or ())
    share = np.linspace(0.0, 1.0, POINTS)
    points = start + share[:, None] * (end - start)
    light = luminance(sampled(given.picture(trajectory), given.lens(trajectory).pixels(points)))
    told = f"along {_told(given.line[0] if given.line else None)} to {_told(given.line[1] if given.line else None)}"
    if not np.isfinite(light).all():
        raise UnknowableError(f"the line {told} is not all in the picture of {given.camera}")
    light = np.convolve(np.pad(light, 3, mode="edge"), np.full(7, 1 / 7), mode="valid")
    dark, lit = (float(v) for v in np.percentile(light, (5, 95)))
    step = float(np.linalg.norm(end - start)) / (POINTS - 1)
    if lit < CONTRAST * dark or lit <= 0:
        if given.of == "edge_width":
            raise UnknowableError(f"there is no shadow {told}: it is between {dark:.3f} and {lit:.3f} bright")
        return between(0.0, given.min_m, given.max_m, "m", f"no shadow lies {told}, {dark:.3f} to {lit:.3f} bright")
    shade = np.concatenate([[False], light < (dark + lit) / 2, [False]])
    turns = np.flatnonzero(shade[1:] != shade[:-1]).reshape(-1, 2)
    first, last = turns[np.argmax(turns[:, 1] - turns[:, 0])]
    if given.of == "shadow_length":
        length = float(last - first) * step
        message = f"the shadow is {length:.4g} m long {told}, {dark:.3f} in {lit:.3f} of light"
        return between(length, given.min_m, given.max_m, "m", message)
    if last >= POINTS:
        raise UnknowableError(f"the shadow does not end {told}: take a longer line")
    low, high = dark + 0.1 * (lit - dark), dark + 0.9 * (lit - dark)
    before = np.flatnonzero(light[first:last] <= low)
    after = np.flatnonzero(light[last:] >= high)
    if not len(before) or not len(after):
        raise UnknowableError(f"the edge of the shadow is not all on the line {told}: take a longer one")
    width = float(last + after[0] - (first + before[-1])) * step
    return between(width, given.min_m, given.max_m, "m", f"the edge of the shadow is {width:.4g} m wide {told}")


def _around(trajectory: Trajectory, given: Given) -> np.ndarray:
    """(N, 3) the colours within the radius of the place, as the camera sees a disc that faces it."""
    lens = given.lens(trajectory)
    turn = np.arange(16) * 2 * np.pi / 16
    rings = np.concatenate([r * np.stack([np.cos(turn), np.sin(turn)], axis=1) for r in (0.0, 0.5, 1.0)])
    points = np.array(given.place) + given.radius_m * rings @ lens.axes[:, :2].T
    colours = sampled(given.picture(trajectory), lens.pixels(points))
    if not np.isfinite(colours).all():
        raise UnknowableError(f"{_told(given.place)} is not all in the picture of {given.camera}")
    return colours


def _lab(colour: np.ndarray) -> np.ndarray:
    """L*, a*, b* of an sRGB colour (3,), 0 to 1."""
    linear = np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)
    matrix = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
    ratio = matrix @ linear / WHITE
    f = np.where(ratio > (6 / 29) ** 3, np.cbrt(ratio), ratio / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def _told(point: Point | None) -> str:
    return f"({', '.join(f'{v:g}' for v in point or ())})"


LINE = {"camera": "camera", "line": [[-0.2, 0, 0], [1.0, 0, 0]]}
AT = {"camera": "camera", "place": [-0.5, 0.5, 0]}
GOOD = (
    (from_above, {**LINE, "of": "shadow_length", "min_m": 0.49, "max_m": 0.51}),
    # Linear light goes from 4 to 72 %: 10 to 90 % of it lie between 0.25 and 0.94 of the way in grey values.
    (lambda: from_above(edge_m=0.2), {**LINE, "of": "edge_width", "min_m": 0.12, "max_m": 0.16}),
    (from_above, {**AT, "of": "colour", "colour": "#c8281e"}),
    (from_above, {**AT, "place": [-0.5, -0.5, 0], "of": "brightness", "min_share": 0.7, "max_share": 0.75}),
)
BAD = (
    (lambda: from_above(shadow_m=0.3), {**LINE, "of": "shadow_length", "min_m": 0.4}),
    (lambda: from_above(shadow_m=0.0), {**LINE, "of": "shadow_length", "min_m": 0.1}),
    (lambda: from_above(edge_m=0.2), {**LINE, "of": "edge_width", "max_m": 0.05}),
    (from_above, {**AT, "of": "colour", "colour": "#1e28c8"}),
    (from_above, {**AT, "of": "brightness", "min_share": 0.5}),
)
