"""What of a piece is embedded: its heading with each part of its words that the model can take in at once."""

import hashlib

from ..index import Piece

CHARACTERS = 900
"""Of one window: with its heading about the 256 tokens the model reads; the rest would be ignored silently."""
OVERLAP = 150
MOST = 6
"""Windows of a piece; a long struct's tail is names, which full text finds better."""
PARTS_LEFT_OUT = frozenset({"api"})
"""Declarations say what the manual's own entries say in better words."""


def windows(piece: Piece) -> list[str]:
    """The texts to embed, at least one unless the piece's part is left out."""
    if piece.part in PARTS_LEFT_OUT:
        return []
    heading = " ".join(f"{piece.title.replace(' > ', ': ')} {piece.anchor.replace('-', ' ')}".split())[-200:]
    text, start = " ".join(piece.text.split()), 0
    cut: list[str] = []
    while start < len(text) and len(cut) < MOST:
        end = min(len(text), start + CHARACTERS)
        if end < len(text) and (space := text.rfind(" ", start + CHARACTERS // 2, end)) > 0:
            end = space
        cut.append(f"{heading}. {text[start:end]}")
        start = end if end == len(text) else end - OVERLAP
    return cut or [heading]


def digest(text: str) -> str:
    """What a vector is stored under: the same words are embedded once, whichever piece or version they stand in."""
    return hashlib.sha256(text.encode()).hexdigest()[:32]
