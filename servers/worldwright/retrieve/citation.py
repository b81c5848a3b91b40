"""Citations: `package-version/path#anchor:Lfirst-Llast`, and the passage one opens."""

import re
from dataclasses import dataclass
from difflib import get_close_matches

from ..model.errors import NotFoundError
from . import corpus
from .answers import Passage
from .index import Index

_FORM = re.compile(
    r"^(?:(?P<root>(?:mujoco|worldwright)-[\w.+]+|[\w-]+-local)/)?(?P<path>[^#]+?)(?:#(?P<anchor>[^#]*?))?(?::?L(?P<first>\d+)(?:-L?(?P<last>\d+))?)?$"
)
PAGE = 200
"""Lines shown when a citation names a whole document."""
MAX_CHARACTERS = 15_000


@dataclass(frozen=True)
class Citation:
    """A parsed citation; only the path is required."""

    root: str
    path: str
    anchor: str
    first: int | None
    last: int | None


def parse(text: str) -> Citation:
    """Take a citation apart."""
    match = _FORM.match(text.strip())
    if match is None:
        raise NotFoundError(
            f"'{text}' is not a citation",
            next_move="give package-version/path#anchor:Lfirst-Llast, as `search` prints it",
        )
    first, last = match["first"], match["last"]
    start = int(first) if first else None
    return Citation(
        match["root"] or "",
        match["path"].strip("/ "),
        (match["anchor"] or "").rstrip(":"),
        start,
        int(last) if last else start,
    )


def read(index: Index, text: str, around: int = 0) -> Passage:
    """Open a citation.

    Args:
        index: the full-text index, for anchors without line numbers.
        text: the citation; without lines the anchor's pieces are shown, without an anchor the file from its start.
        around: lines of context before and after.

    Raises:
        NotFoundError: no such document, anchor or line; the nearest ones are listed.
    """
    wanted = parse(text)
    document = _document(wanted)
    lines = document.read().splitlines()
    note = ""
    if wanted.root and wanted.root != document.root:
        note = f"{wanted.root} was cited; {document.root} is installed, opened by its anchor"
    first, last, title = wanted.first, wanted.last, ""
    pieces = index.at(document.root, document.path, wanted.anchor) if wanted.anchor else []
    if wanted.anchor and not pieces:
        pieces = [p for p in index.labelled(wanted.anchor) if (p.root, p.path) == (document.root, document.path)]
    inside = [p for p in pieces if first is not None and p.first <= first <= p.last]
    if pieces:
        title = (inside or pieces)[0].title
    if first is None or (note and pieces):
        if wanted.anchor and not pieces:
            raise _no_anchor(index, document, wanted.anchor)
        run = _together(pieces)
        first, last = (run[0].first, run[-1].last) if run else (1, min(len(lines), PAGE))
    if first > len(lines) or first < 1:
        raise NotFoundError(
            f"{document.key} has {len(lines)} lines, not {first}", place=text, next_move="search again, then cite a hit"
        )
    first, last = max(1, first - around), min(len(lines), max(first, last or first) + around)
    shown: list[str] = []
    size = 0
    for number in range(first, last + 1):
        size += len(lines[number - 1]) + 1
        if size > MAX_CHARACTERS and shown:
            break
        shown.append(lines[number - 1][:2000])
    end = first + len(shown) - 1
    following = "" if end >= len(lines) else f"{document.key}:L{end + 1}-L{min(len(lines), end + PAGE)}"
    anchor = f"#{wanted.anchor}" if wanted.anchor else ""
    return Passage(
        citation=f"{document.key}{anchor}:L{first}-L{end}",
        title=title,
        content="\n".join(shown),
        first=first,
        last=end,
        lines=len(lines),
        next=following,
        note=note,
    )


def _document(wanted: Citation) -> corpus.Document:
    """The document of the corpus that is meant (nothing else on disk can be opened)."""
    found = corpus.documents()
    package = wanted.root.split("-")[0]
    for document in found:
        same_package = not package or document.root.startswith(package + "-")
        if same_package and wanted.path in (document.path, document.path.removeprefix("doc/")):
            return document
    package_of = wanted.path.removesuffix(".py") + "/__init__.py"  # a module that has become a package
    near = [d.path for d in found if d.path == package_of]
    near += get_close_matches(wanted.path, [d.path for d in found if d.path not in near], n=3, cutoff=0.4)
    raise NotFoundError(
        f"there is no document '{wanted.path}' in the corpus",
        place=f"{wanted.root}/{wanted.path}" if wanted.root else wanted.path,
        next_move=f"nearest: {', '.join(near)}" if near else "use `search`, and cite a hit",
    )


def _no_anchor(index: Index, document: corpus.Document, anchor: str) -> NotFoundError:
    elsewhere = [piece.citation for piece in index.labelled(anchor)[:3]]
    hint = f"it stands in {', '.join(elsewhere)}" if elsewhere else f"use `search` for '{anchor.replace('-', ' ')}'"
    return NotFoundError(f"{document.key} has no anchor '{anchor}'", place=document.key, next_move=hint)


def _together(pieces: list) -> list:
    """The first run of pieces that follow each other."""
    run = pieces[:1]
    for piece in pieces[1:]:
        if piece.first > run[-1].last + 3:
            break
        run.append(piece)
    return run
