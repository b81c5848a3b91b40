"""A seam is a folder of modules that all define what one protocol names: renderers, solvers, sources of assets.

The folder is the list: a file (or a folder, where one is not enough) is an entry by its name, and nothing else has to name
it. Third parties add entries through the entry-point group that has the folder's dotted name. An entry is loaded
when it is used, so that listing them all costs nothing.
"""

import importlib
import importlib.util
import pkgutil
import sys
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, Generic, TypeVar, cast

from . import listings
from .errors import SeamError

P = TypeVar("P")


class Seam(Generic[P]):
    """The entries of one folder.

    Args:
        package: the folder's dotted name, e.g. `worldengine.film.renderers`.
        protocol: what each of its modules defines; its members are looked for, and their docstrings say what they mean.
        what: one entry in a word, for messages, e.g. `renderer`.
    """

    def __init__(self, package: str, protocol: Any, what: str) -> None:
        self.package, self.protocol, self.what = package, protocol, what

    def names(self) -> tuple[str, ...]:
        """Every entry's name, sorted; none is loaded."""
        return tuple(sorted(self._modules()))

    def find(self, name: str) -> P:
        """The entry of this name.

        Raises:
            SeamError: there is none, which lists those that there are; or it does not define what the protocol names.
        """
        module = importlib.import_module(self._module(name))
        if not (module.__doc__ or "").strip():
            raise self._malformed(module, "it needs a docstring, which is its documentation")
        for member in self.members():
            if not hasattr(module, member):
                raise self._malformed(module, f"it must define {member}")
        return cast(P, module)

    def members(self) -> tuple[str, ...]:
        """The names that the protocol requires, in its order."""
        own = {**self.protocol.__annotations__, **vars(self.protocol)}
        return tuple(name for name in own if not name.startswith("_"))

    def files(self, name: str) -> tuple[Path, ...]:
        """The files that an entry consists of, sorted: all below its folder where it has one. It is not loaded."""
        spec = importlib.util.find_spec(self._module(name))
        if spec is None or spec.origin is None:
            raise SeamError(f"the {self.what} {name} has no file", self.package, "give it one")
        path = Path(spec.origin)
        if path.name != "__init__.py":
            return (path,)
        return tuple(sorted(map(Path, listings.files(str(path.parent)))))

    def _modules(self) -> dict[str, str]:
        """The dotted name of each entry's module; an entry of the folder cannot be replaced from outside."""
        own = [info.name for info in pkgutil.iter_modules(importlib.import_module(self.package).__path__)]
        return {
            **_foreign(self.package),
            **{name: f"{self.package}.{name}" for name in own if not name.startswith("_")},
        }

    def _module(self, name: str) -> str:
        own = f"{self.package}.{name}"
        if (
            own in sys.modules and name.isidentifier() and not name.startswith("_")
        ):  # the folder need not be listed anew
            return own
        known = self._modules()
        if name not in known:
            raise SeamError(
                f"there is no {self.what} {name!r}",
                self.package,
                f"name one of: {', '.join(sorted(known)) or '(none)'}",
            )
        return known[name]

    def _malformed(self, module: ModuleType, message: str) -> SeamError:
        return SeamError(message, f"{module.__file__}:1", f"see the protocol in {self.package}")


@cache
def _foreign(package: str) -> dict[str, str]:
    """Modules of third parties by name: a running process has one installation."""
    from importlib.metadata import entry_points  # half of what a pass would otherwise load before the simulator

    return {point.name: point.value for point in entry_points(group=package)}
