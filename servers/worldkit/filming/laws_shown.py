"""Points and sums of an author's laws, as a film reads them by name."""

from collections.abc import Mapping

import numpy as np

from ..errors import ProgramError

SUMS = ("mass", "energy", "stored", "volume")


class Laws:
    """Those of a recording; `arrays` are from `worldengine.recording.law_channels`."""

    def __init__(self, arrays: Mapping[str, np.ndarray]) -> None:
        self.names: tuple[str, ...] = tuple(str(name) for name in arrays.get("law_names", ()))
        self.grains: tuple[str, ...] = tuple(str(name) for name in arrays.get("law_grains", ()))
        """Bodies of many balls that show the points of one."""
        self.shown_by: tuple[str, ...] = tuple(str(name) for name in arrays.get("law_shown_by", ()))
        """What shows each of `names`: a body, or a flex, which is none."""
        self._arrays = arrays

    def recorded(self, number: int) -> tuple[np.ndarray, np.ndarray]:
        """Of a law: the times (F,), s, and its points at each, (F, P, 3), m."""
        return self._arrays[f"law{number}_time"], self._arrays[f"law{number}_points"]

    def points(self, law: str, at: "float | np.ndarray") -> np.ndarray:
        """See `Recorded.points`."""
        times, places = self.recorded(self.number(law))
        wanted = np.atleast_1d(np.asarray(at, dtype=float))
        after = np.clip(np.searchsorted(times, wanted), 1, max(len(times) - 1, 1))
        before, after = after - 1, np.minimum(after, len(times) - 1)
        share = (wanted - times[before]) / np.maximum(times[after] - times[before], 1e-12)
        share = np.clip(share, 0.0, 1.0)[:, None, None]
        found = places[before] * (1.0 - share) + places[after] * share
        return np.asarray(found if np.ndim(at) else found[0])

    def told(self, law: str, what: str, at: "float | np.ndarray") -> np.ndarray:
        """See `Recorded.told`."""
        number = self.number(law)
        if what not in SUMS or f"law{number}_{what}" not in self._arrays:
            raise ProgramError(f"{law!r} tells no {what!r}", "film.py", f"ask a law for one of: {', '.join(SUMS)}")
        return np.asarray(np.interp(at, self._arrays[f"law{number}_at"], self._arrays[f"law{number}_{what}"]))

    def __contains__(self, name: object) -> bool:
        """Whether something is the name of a law, or of what shows one."""
        return name in self.names or name in self.shown_by

    def middle(self, name: str, at: "float | np.ndarray") -> np.ndarray:
        """The mean of the points at some recorded times: (3,), or (N, 3), m."""
        return np.asarray(self.points(name, at).mean(axis=-2))

    def radius(self, name: str) -> float:
        """Half the diagonal of the box around the points, where that is largest, m."""
        places = self._arrays[f"law{self.number(name)}_points"]
        if not places.size:
            return 0.0
        return float(np.linalg.norm(np.ptp(places, axis=1), axis=-1).max()) / 2

    def number(self, law: str) -> int:
        """The number of a law, by its name or by that of what shows it.

        Raises:
            ProgramError: there is none.
        """
        if law in self.names:
            return self.names.index(law)
        if law in self.shown_by:
            return self.shown_by.index(law)
        known = ", ".join(dict.fromkeys([*self.names, *self.shown_by])) or "(none)"
        raise ProgramError(f"no law is called {law!r}, and none is shown by it", "film.py", f"name one of: {known}")
