"""`Clouds`: the points of an author's law as steam, smoke or dust: where it lies is what was simulated, how it looks is said here."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ..errors import ProgramError
from . import drawn_only
from .film_bounds import FAR_M, MOST_EMITTERS
from .plain_refusals import line
from .recorded import Recorded
from .smoke import Smoke

Array = np.ndarray
OfAge = Callable[[Array], Any]
AGES = 1024
"""So many ages, evenly spread over the recording, are asked of a function."""


class Clouds(Smoke):
    """The clouds of a film of `recorded`."""

    def __init__(self, recorded: Recorded) -> None:
        super().__init__(recorded)
        self._clouds: list[tuple[dict[str, Any], OfAge, OfAge, int]] = []

    def cloud(
        self,
        name: str,
        *,
        of: str,
        diameter: tuple[float, float] | OfAge = (0.02, 0.12),
        opacity: float | OfAge = 0.4,
        life: float = 2.0,
        colour: str = "#ffffff",
    ) -> None:
        """Draw the points of a law as soft, uneven vapour in place of the balls that show them: steam, smoke, mist, dust.

        Each point is a puff of wisps that turn as it goes. It is where the recording says, and is seen from when it begins to move:
        until then it waits. What is simulated needs no mark in the picture; the statement says of which law it is.

        Args:
            name: as the statement has it.
            of: the law, or the body of balls that shows it.
            diameter: m, of a puff that sets out and of one at the end of its life; or a function of ages (N,), s, since it set out.
            opacity: how much of what is behind its middle a young one hides, 0 to 1, which fades until the end of its life; or such a
                function, and then no life ends.
            life: s from when a point begins to move until it is seen no more.
            colour: in white light.

        Raises:
            ProgramError: there is no such law, or no body of balls shows it, or it is a cloud already; a number is none that it may have.
        """
        laws = self.recorded.shows
        body = next((shown for law, shown in laws.items() if of in (law, shown)), "")
        taken = {told["of"] for told, *_ in self._clouds}
        if body not in self.recorded.bodies or body in taken or len(taken) >= MOST_EMITTERS:
            known = ", ".join(law for law, shown in laws.items() if shown in self.recorded.bodies) or "(none)"
            raise ProgramError(
                f"the cloud {name!r} is of {of!r}, which is no law that a body of balls shows, or is another's",
                "film.py",
                f"name one of: {known}; balls are made by moved_shapes.grains",
            )
        if not isinstance(name, str) or not 0 < len(name) <= 60 or not 0 < life <= FAR_M:
            raise ProgramError(f"the cloud {name!r} has a name and a life above 0 s, not {life}", "film.py", "life=2.0")
        wide, opaque = _grows(name, diameter, life), _fades(name, opacity, life)
        self._clouds.append(({"name": name, "of": body, "rgb": drawn_only.rgb(colour)}, wide, opaque, line()))

    def _clouded(self, arrays: dict[str, Array]) -> list[dict[str, Any]]:
        """The clouds as JSON, what they are at each age into `arrays`."""
        found = []
        ages = np.linspace(0.0, self.recorded.duration, AGES)
        for number, (told, wide, opaque, self.line) in enumerate(self._clouds):  # noqa: B020 (a refusal names the line)
            asked = [np.broadcast_to(np.asarray(ask(ages), float), ages.shape) for ask in (wide, opaque)]
            if not (
                np.isfinite(asked).all() and np.min(asked) >= 0 and asked[0].max() <= FAR_M and asked[1].max() <= 1
            ):
                raise ProgramError(
                    f"the cloud {told['name']!r} has a diameter below 0 m, or an opacity that is none of 0 to 1, at some age",
                    "film.py",
                    "check how they are reckoned",
                )
            arrays[f"cloud{number}"] = np.stack([ages, *asked]).astype("f4")
            found.append(told | {"ages": f"cloud{number}"})
        return found


def _grows(name: str, diameter: Any, life: float) -> OfAge:
    if callable(diameter):
        return diameter
    if len(diameter) != 2 or not 0 < min(diameter) <= max(diameter) <= FAR_M:
        raise ProgramError(f"the cloud {name!r} has the diameters {diameter}", "film.py", "diameter=(0.02, 0.12)")
    young, old = map(float, diameter)
    return lambda age: young + (old - young) * np.sqrt(np.clip(age / life, 0.0, 1.0))


def _fades(name: str, opacity: Any, life: float) -> OfAge:
    if callable(opacity):
        return opacity
    if not 0 < opacity <= 1:
        raise ProgramError(f"a puff of the cloud {name!r} hides {opacity}", "film.py", "opacity=0.4: from 0 to 1")

    def faded(age: Array) -> Array:
        share = np.clip(age / life, 0.0, 1.0)
        return np.asarray(opacity * np.clip(share / 0.03, 0.0, 1.0) * (1.0 - share) ** 1.3)

    return faded
