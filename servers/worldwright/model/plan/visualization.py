"""How a plan has its world shown: place, light, sky and lamps of stills and film, and what is filmed.

A `film.py` may light it otherwise; then its statement and the report list that.
"""

from collections.abc import Mapping
from typing import Any, Literal

from pydantic import Field, field_validator, model_validator

from ..frozen import Frozen

Sky = Literal["clear", "overcast", "dusk", "night"]
HEX = r"^#[0-9a-fA-F]{6}$"


class Sun(Frozen):
    """The light that casts the shadows: the sun, the moon, or in a studio or a room the strongest lamp."""

    azimuth: float | None = Field(None, ge=-360, le=360)
    """Where it stands, degrees counter-clockwise from +x: shadows fall the other way."""
    elevation: float | None = Field(None, ge=1, le=90)
    """Its height, degrees: at 8 shadows are seven times as long as things are high, and a clear sky reddens."""
    colour: str | None = Field(None, pattern=HEX)
    """Of its light; None: as the sky has it at this height."""
    strength: float | None = Field(None, ge=0, le=10)
    """1 is bright sun; None: as the sky has it."""


MOST_LAMPS = 8
"""So many lamps the preview shows, those of every copy of an object counted."""


class PlannedLamp(Frozen):
    """A lamp, a candle, a fire: light all around from a point that nothing opaque surrounds."""

    name: str = Field(min_length=1, max_length=40)
    on: str | None = None
    """The object that carries it; None: the world."""
    at: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Metres from the middle of that object along its own axes, or in the world."""
    colour: str = Field("#ffd9a8", pattern=HEX)
    strength: float = Field(1.0, gt=0, le=1000)
    """Of what it gives a white surface at one metre; the sun gives about 3, a candle 0.05 to 0.2."""


class Visualization(Frozen):
    """Section `visualization`: how the world is shown."""

    mode: Literal["headless", "viewer"] = "headless"
    setting: Literal["studio", "room", "outdoor", "dark"] = "studio"
    """The sky, floor and light around the world."""
    floor: str | None = None
    """Look of the ground, e.g. `wood_planks`; None: the setting's own."""
    sky: Sky | None = None
    """In a studio or outdoors: what is around the world instead of the setting's own surroundings; outdoors with a `sun`, clear."""
    sun: Sun | None = None
    lamps: tuple[PlannedLamp, ...] = Field((), max_length=MOST_LAMPS)

    @model_validator(mode="after")
    def _lit(self) -> "Visualization":
        if self.sky and self.setting in ("room", "dark"):
            raise ValueError(f"`setting: {self.setting}` shows no sky: remove `sky`, or take `setting: outdoor`")
        if len({lamp.name for lamp in self.lamps}) < len(self.lamps):
            raise ValueError("two of the `lamps` have the same name")
        return self

    def hung(self, families: Mapping[str, tuple[str, ...]]) -> list[tuple[str, PlannedLamp, str]]:
        """Every lamp with its name and its object's (empty: the world's), where each copy of an object carries one of its own.

        Raises:
            ValueError: they are too many, or two have the same name.
        """
        found = []
        for lamp in self.lamps:
            if copied := families.get(lamp.on or "", ()):
                found += [(f"{lamp.name}_{number}", lamp, name) for number, name in enumerate(copied, 1)]
            else:
                found.append((lamp.name, lamp, lamp.on or ""))
        names = [name for name, _, _ in found]
        if len(names) > MOST_LAMPS:
            raise ValueError(
                f"the copies that carry `lamps` make {len(names)} of them, and at most {MOST_LAMPS} are shown"
            )
        if twice := [name for name in names if names.count(name) > 1]:
            raise ValueError(f"two of the `lamps` have the same name, {twice[0]!r}, as each copy's lamp has its number")
        return found

    @property
    def light(self) -> dict[str, Any]:
        """What is stated of light and sky, by the words of `worldkit.lights.treated`."""
        return stated(self.sky or ("clear" if self.sun and self.setting == "outdoor" else None), self.sun)


class RecordingMode(Frozen):
    """Section `recording_mode`: what is filmed."""

    mode: Literal["cameras", "none"] = "cameras"
    fps: int = Field(24, ge=1, le=240)
    size: tuple[int, int] = (1280, 720)
    """Width and height in pixels, both even."""

    @field_validator("size")
    @classmethod
    def _even(cls, value: tuple[int, int]) -> tuple[int, int]:
        if not all(16 <= side <= 4096 and side % 2 == 0 for side in value):
            raise ValueError(f"width and height must be even and between 16 and 4096 pixels, got {value}")
        return value


def stated(sky: Sky | None, sun: Sun | None) -> dict[str, Any]:
    """What is stated, by the words of `worldkit.lights.treated`."""
    told: dict[str, Any] = {"sky": sky} if sky else {}
    for name, word in (
        ("azimuth", "azimuth_deg"),
        ("elevation", "elevation_deg"),
        ("colour", "colour"),
        ("strength", "strength"),
    ):
        value = getattr(sun, name, None)
        if value is not None:
            told[word] = value
    return told
