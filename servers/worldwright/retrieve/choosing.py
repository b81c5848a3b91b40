"""From ranked pieces to the hits that are shown: neighbours become one hit, nothing comes twice, few are texts of ours.

Five hits should lead to five different places; three entries that follow each other in the manual are one place.
"""

from dataclasses import dataclass, field

from .index import Index, Piece
from .ranking import OURS_BEST, OURS_MOST, SHOWN, places

LONGEST = 1600
"""Characters of a hit that was put together from neighbours."""
GAP = 3
"""Lines between neighbours at most: labels and blank lines."""
NEAR = 24
"""Pieces at the head of the order that may join each other."""


@dataclass
class Chosen:
    """A hit: a piece, with neighbours that answer too."""

    piece: Piece
    """The best piece; it gives anchor and title."""
    score: float
    together: list[Piece] = field(default_factory=list)
    """All pieces in the order of their lines."""

    @property
    def citation(self) -> str:
        """Stable name that `read` opens."""
        one = self.piece
        return f"{one.root}/{one.path}#{one.anchor}:L{self.together[0].first}-L{self.together[-1].last}"

    @property
    def text(self) -> str:
        """The text of all pieces."""
        return "\n\n".join(piece.text for piece in self.together)

    def touches(self, piece: Piece) -> bool:
        """Whether a piece follows or precedes directly, and is short enough to be shown with these."""
        if (piece.root, piece.path) != (self.piece.root, self.piece.path):
            return False
        size = sum(len(one.text) for one in self.together) + len(piece.text)
        after = 0 < piece.first - self.together[-1].last <= GAP
        before = 0 < self.together[0].first - piece.last <= GAP
        return (after or before) and size <= LONGEST


def choose(index: Index, ranked: list[tuple[int, float]], count: int, part: str = "all") -> list[Chosen]:
    """Choose the hits from ranked pieces, best first.

    Args:
        index: where the pieces lie.
        ranked: (piece number, score), best first.
        count: how many hits.
        part: of the corpus, or `all`.
    """
    where = places(str(index.path))
    if part != "all":
        ranked = [row for row in ranked if where.parts[row[0]] == part]
    found: list[Chosen] = []
    seen: set[str] = set()
    ours = 0
    later: list[tuple[int, float]] = []
    pieces = index.pieces([number for number, _ in ranked[: 4 * count + NEAR]])
    for place, (number, score) in enumerate(ranked):
        if number not in pieces:
            break
        piece = pieces[number]
        if part == "all" and piece.part == "api" and piece.anchor in seen:
            continue  # the declaration of something that a better hit explains
        seen.add(piece.anchor)
        home = next((one for one in found if one.touches(piece)), None) if place < NEAR else None
        if home is not None:
            home.together = sorted([*home.together, piece], key=lambda one: one.first)
            continue
        if part == "all" and where.ours[number] and len(found) < SHOWN:
            theirs = next((near for other, near in ranked[place:] if not where.ours[other]), 0.0)
            if ours >= OURS_MOST and theirs >= OURS_BEST * score:
                later.append((number, score))
                continue
            ours += 1
        if len(found) < count:
            found.append(Chosen(piece, score, [piece]))
    for number, score in later[: count - len(found)]:
        found.append(Chosen(pieces[number], min(score, found[-1].score), [pieces[number]]))
    return found[:count]
