"""Names that differ from an existing one by spelling alone: the one kind of rename that needs no judgement."""

from collections.abc import Iterable


def respelled(name: str, known: Iterable[str]) -> str | None:
    """The one known name that is the same but for case and underscores (`time_step`, `timestep`), or None."""
    found = {other for other in known if plain(other) == plain(name) and other != name}
    return found.pop() if len(found) == 1 else None


def plain(name: str) -> str:
    """Lower case, without underscores and hyphens."""
    return name.replace("_", "").replace("-", "").lower()
