"""An asset's `asset.yaml` as one piece: what it is, how large and how heavy, without its list of hulls."""

from collections.abc import Iterator

from .chunk import Chunk

_STOPS = ("collision:", "visual:", "materials:", "inertia:")


def chunks(text: str) -> Iterator[Chunk]:
    """The lines before the geometry."""
    lines = text.splitlines()
    last = next((n for n, line in enumerate(lines) if line.startswith(_STOPS)), len(lines))
    facts = [line for line in lines[:last] if not line.startswith("#")]
    key = next((line.split(":", 1)[1].strip() for line in facts if line.startswith("key:")), "asset")
    if facts:
        yield Chunk(key, f"catalog > {key}", 1, max(1, last), "\n".join(facts), (key,))
