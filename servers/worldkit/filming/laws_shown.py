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
        self._arrays = arrays

    def points(self, law: str, at: "float | np.ndarray") -> np.ndarray:
        """See `Recorded.points`."""
        number = self._number(law)
        times, places = self._arrays[f"law{number}_time"], self._arrays[f"law{number}_points"]
        wanted = np.atleast_1d(np.asarray(at, dtype=float))
        after = np.clip(np.searchsorted(times, wanted), 1, max(len(times) - 1, 1))
        before, after = after - 1, np.minimum(after, len(times) - 1)
        share = (wanted - times[before]) / np.maximum(times[after] - times[before], 1e-12)
        share = np.clip(share, 0.0, 1.0)[:, None, None]
        found = places[before] * (1.0 - share) + places[after] * share
        return np.asarray(found if np.ndim(at) else found[0])

    def told(self, law: str, what: str, at: "float | np.ndarray") -> np.ndarray:
        """See `Recorded.told`."""
        number = self._number(law)
        if what not in SUMS or f"law{number}_{what}" not in self._arrays:
            raise ProgramError(f"{law!r} tells no {what!r}", "film.py", f"ask a law for one of: {', '.join(SUMS)}")
        return np.asarray(np.interp(at, self._arrays[f"law{number}_at"], self._arrays[f"law{number}_{what}"]))

    def _number(self, law: str) -> int:
        if law not in self.names:
            known = ", ".join(self.names) or "(none)"
            raise ProgramError(f"no law is called {law!r}", "film.py", f"name one of: {known}")
        return self.names.index(law)
