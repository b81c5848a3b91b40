"""Which assets there are, from whatever source, and which of them this process used."""

import difflib
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

from ..data_folders import catalog_root
from .entry import Asset
from .reading import AssetError
from .sources import SEAM

OWN = "own_folder"
"""The source whose keys give way to those of the catalog, so that no asset of a user's own changes or breaks a project."""

_TAKEN: set[str] = set()


class UnknownAssetError(KeyError):
    """No asset of that key; the message gives the nearest keys and all of them."""

    def __str__(self) -> str:
        return str(self.args[0])


def sources() -> dict[str, str]:
    """The source of each key, by key, sorted; of a key that the user's own folder has too, the catalog's.

    Raises:
        AssetError: two sources of the catalog deliver one key.
    """
    found: dict[str, str] = {}
    for name in sorted(SEAM.names(), key=OWN.__eq__):
        for key in SEAM.find(name).keys():  # noqa: SIM118 - a function of the source, not a mapping
            if key not in found:
                found[key] = name
            elif name != OWN:
                raise AssetError(f"{catalog_root()}: both {found[key]} and {name} deliver {key!r}: rename one of them")
    return dict(sorted(found.items()))


def hidden() -> tuple[str, ...]:
    """Keys of the user's own folder that are not reached, since the catalog has them too: a project comes before a user."""
    known = sources()
    return tuple(key for key in SEAM.find(OWN).keys() if known[key] != OWN)  # noqa: SIM118


def keys() -> tuple[str, ...]:
    """Every asset key, sorted."""
    return tuple(sources())


def find(key: str) -> Asset:
    """The entry `key`.

    Raises:
        UnknownAssetError: no such key; names the nearest ones and all.
        AssetError: what its source has under that key is no asset.
    """
    known = sources()
    if key not in known:
        near = difflib.get_close_matches(key, known, n=3, cutoff=0.5)
        hint = f"did you mean {' or '.join(near)}? " if near else ""
        raise UnknownAssetError(f"no asset {key!r} in {catalog_root()}; {hint}known: {', '.join(known)}")
    take(key)
    stats = tuple((path, s.st_mtime_ns, s.st_size) for path in SEAM.find(known[key]).files(key) for s in (path.stat(),))
    return _read(known[key], key, stats)


def entries() -> Iterator[Asset]:
    """Every entry that can be read, in the order of the keys, none of which is used by that; a broken one hides no other."""
    for key, source in sources().items():
        try:
            stats = tuple(
                (path, s.st_mtime_ns, s.st_size) for path in SEAM.find(source).files(key) for s in (path.stat(),)
            )
            yield _read(source, key, stats)
        except (AssetError, OSError):
            continue


def files(key: str) -> tuple[Path, ...]:
    """Every file that decides what an asset is; none where there is no such key."""
    source = sources().get(key)
    return () if source is None else SEAM.find(source).files(key)


def take(name: str) -> None:
    """Note that an asset, or something else of the catalog's top level, goes into the world that this process builds."""
    _TAKEN.add(name)


def taken() -> tuple[str, ...]:
    """What this process took of the catalog until now, by name, sorted."""
    return tuple(sorted(_TAKEN))


@lru_cache(maxsize=512)
def _read(source: str, key: str, _stats: tuple[tuple[Path, int, int], ...]) -> Asset:
    return SEAM.find(source).find(key)
