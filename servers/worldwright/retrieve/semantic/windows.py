"""The windows of a piece that are embedded: its heading with a few sentences each.

A short window is about one thing, which is what a vector can hold. Indexing time grows with the number of tokens, so of
our own texts, and of pages about something other than the engine, only the beginning of each section is embedded.
"""

import hashlib

from .. import chunk as chunks
from ..chunk import Chunk

HEADING = 100
"""Characters of the heading: with a window about 150 of the 256 word pieces that the model reads."""
MOST = 12
"""Most windows of a piece; the end of a long table is names, which full text finds better."""
BRIEF = 240
"""Characters of a section of which only the beginning is embedded."""
WHOLE = frozenset({"manual", "sources"})
BEGUN = frozenset({"changelog", "skills"})
"""Parts of which each section's beginning is embedded; for the others, full text answers alone."""
ASIDE = (
    "doc/unity",
    "doc/OpenUSD/",
    "doc/studio/",
    "doc/APIreference/",
    "doc/programming/ui",
    "doc/programming/samples",
)
"""Pages about programs around the engine, and bare declarations."""


def windows(chunk: Chunk, part: str, path: str) -> list[str]:
    """The texts to embed; none where full text answers alone."""
    if part not in WHOLE | BEGUN:
        return []
    if part in BEGUN or path.startswith(ASIDE):
        text = " ".join(chunk.text.split())
        return [f"{heading(chunk, part)}. {text[:BRIEF].rsplit(' ', 1)[0] if len(text) > BRIEF else text}"]
    return [f"{heading(chunk, part)}. {cut}" for cut in chunks.windows(chunk.text)[:MOST]]


def heading(chunk: Chunk, part: str) -> str:
    """The innermost headings, and the anchor's words where they add something."""
    named = ": ".join(chunk.title.split(" > ")[-3:])
    anchor = chunk.anchor.replace("-", " ").replace("_", " ")
    if part != "changelog" and anchor.lower() not in named.lower():
        named = f"{named} {anchor}"
    return named[-HEADING:]


def digest(text: str) -> str:
    """The key of a vector: equal texts are embedded once, whichever piece or version they stand in."""
    return hashlib.sha256(text.encode()).hexdigest()[:32]
