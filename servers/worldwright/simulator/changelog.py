"""Mine the changelog that ships with the installed simulator for what changed between versions.

Every entry of a "Breaking changes" box is kept with its migration advice, and so is every other entry that removes,
renames or deprecates something. The rows are found by any name they mention, old or new.
"""

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from ..model.frozen import Frozen
from . import installed
from .cache import cached_json
from .rst import plain

_VERSION = re.compile(r"^Version (\d+(?:\.\d+)+)\s*(?:\((.*)\))?")
_ENTRY = re.compile(r"^( *)(?:\d+|#)\.\s+\S")
_CHANGES = re.compile(r"\b(?:[Rr]emov(?:ed|es)|[Rr]enam(?:ed|es)|[Dd]eprecat(?:ed|es)|no longer)\b")
_ARROW = re.compile(r"``([^`]+)``\s*→\s*(?::ref:`([^`<]+?)(?:<[^>]*>)?`|``([^`]+)``)")
_RENAMED = re.compile(
    r"(?:[Rr]enamed(?: the)? ``([^`]+)``|``([^`]+)``[^.`]{0,60}? renamed)(?: \w+){0,4}? to"
    r"\s+(?::ref:`([^`<]+?)(?:<[^>]*>)?`|``([^`]+)``)"
)
_REPLACE = re.compile(r"[Rr]eplace(?: \w+){0,3} ``([^`]+)`` with ``([^`]+)``")
_GONE = re.compile(
    r"[Rr]emoved?\b.*?(?:\.\s|\.$|$)|(?:^|(?<=\.\s))(?:(?!\.\s).)*?\b(?:has|have|was|were|is|are)\s+(?:been\s+)?removed\b",
    re.DOTALL,
)
_INSTEAD = re.compile(
    r"superseded|in favou?r of|replaced|instead|no longer|from the|in ``|is now|are now|, which|using "
)


class Change(Frozen):
    """One row of the table."""

    version: str
    date: str = ""
    section: str = ""
    """The part of the changelog, e.g. `Deformables`."""
    breaking: bool
    text: str
    """The change itself."""
    migration: str = ""
    """The changelog's advice."""
    names: tuple[str, ...] = ()
    """Every symbol, element, attribute or word in code type that the entry mentions."""
    removed: tuple[str, ...] = ()
    """Names in a sentence that says something was removed."""
    renamed: dict[str, str] = {}
    """Old name -> new name."""
    lines: tuple[int, int] = (1, 1)
    """First and last line in `doc/changelog.rst`."""

    @property
    def citation(self) -> str:
        """The place that the row comes from."""
        anchor = "version-" + self.version.replace(".", "-")
        return f"mujoco-{installed.version()}/doc/changelog.rst#{anchor}:L{self.lines[0]}-L{self.lines[1]}"

    def weight(self, name: str) -> int:
        """How much this row says about `name`: 3 renames it, 2 removes it, 1 mentions it, 0 does not."""
        wanted = _bare(name)
        if any(_bare(old) == wanted for old in self.renamed):
            return 3
        if any(wanted in _forms(gone) for gone in self.removed):
            return 2
        return int(any(wanted in _forms(known) for known in self.names))


@cache
def load() -> tuple[Change, ...]:
    """Every row, newest version first; empty when this build ships no changelog."""
    path = installed.manual_folder() / "changelog.rst"
    if not path.is_file():
        return ()
    rows = cached_json(
        "changes",
        installed.fingerprint() + Path(__file__).read_text(encoding="utf-8"),
        lambda: [row.model_dump(mode="json") for row in mine(path.read_text(encoding="utf-8", errors="replace"))],
    )
    sequences = ("lines", "names", "removed")  # JSON has lists; validating 200 rows again would cost more than reading
    return tuple(Change.model_construct(**{**row, **{key: tuple(row[key]) for key in sequences}}) for row in rows)


def find(name: str) -> list[Change]:
    """Rows about a name (old or new), the weightiest first, then the newest."""
    scored = [(row.weight(name), row) for row in load()]
    return [row for weight, row in sorted((s for s in scored if s[0]), key=lambda s: (s[0] < 2, not s[1].breaking))]


def advice(name: str) -> str:
    """One line on what became of a name; empty when the changelog tells of no change."""
    for row in find(name):
        weight = row.weight(name)
        if weight == 3:
            new = next(new for old, new in row.renamed.items() if _bare(old) == _bare(name))
            verb = "changed" if _bare(new) == _bare(name) else "renamed"
            return f"{verb} to `{new}` in {row.version}"
        if weight == 2:
            what = row.migration or row.text
            first = " ".join(what.split())
            return f"removed in {row.version}: {first[:240].rstrip()}{'…' if len(first) > 240 else ''}"
    return ""


def renamed(name: str) -> str | None:
    """The bare new name, if the changelog says that this one was renamed and nothing else changed."""
    for row in find(name):
        for old, new in row.renamed.items():
            if _bare(old) == _bare(name) and re.fullmatch(r"[\w.]+", new) and re.fullmatch(r"[\w.]+", old):
                return new.rsplit(".", 1)[-1]
    return None


def mine(text: str) -> Iterator[Change]:
    """The rows of a changelog, in its order."""
    lines = text.splitlines()
    for version, date, section, breaking, start, end in _entries(lines):
        raw = "\n".join(lines[start:end]).rstrip()
        if not breaking and not _CHANGES.search(raw):
            continue
        head, _, tail = raw.partition("**Migration:**")
        head = re.sub(r"^\s*(?:\d+|#)\.\s+", "", head)
        renamed = _renamed(raw)
        removed = {n for match in _GONE.finditer(head) for n in _names(_INSTEAD.split(match[0])[0])}
        yield Change(
            version=version,
            date=date,
            section=section,
            breaking=breaking,
            text=plain(_dedent(head)).strip(),
            migration=plain(_dedent(tail)).strip(),
            names=tuple(sorted(_names(raw))),
            removed=tuple(sorted(removed)),
            renamed=renamed,
            lines=(start + 1, start + 1 + raw.count("\n")),
        )


def _entries(lines: list[str]) -> Iterator[tuple[str, str, str, bool, int, int]]:
    """Version, date, section, whether in a breaking box, first line index, end index (exclusive) of each entry."""
    version = date = section = ""
    box = -1  # indentation of the open "Breaking" box
    start, depth, in_box = -1, 0, False
    for index, line in enumerate([*lines, "Version end"]):
        indent = len(line) - len(line.lstrip())
        under = lines[index + 1] if index + 1 < len(lines) else ""
        heading = bool(line.strip()) and indent == 0 and re.fullmatch(r"([-^=~])\1{2,}", under.strip() or ".")
        opens = re.match(r"^( *)\.\. admonition:: *(.*)", line)
        entry = _ENTRY.match(line)
        leaves_box = box >= 0 and line.strip() and indent <= box
        closes = heading or opens or line == "Version end" or (entry and indent <= depth) or (leaves_box and in_box)
        if start >= 0 and closes:
            yield version, date, section, in_box, start, index
            start = -1
        if leaves_box:
            box = -1
        if heading:
            if match := _VERSION.match(line):
                version, date, section = match[1], match[2] or "", ""
            else:
                section = line.strip()
        elif opens:
            box = indent if opens[2].startswith("Breaking") else -1
        elif entry and start < 0:
            start, depth, in_box = index, indent, box >= 0
        elif box >= 0 and start < 0 and line.strip() and indent > box and not line.strip().startswith(":"):
            start, depth, in_box = index, indent, True  # the text of this box is not numbered


def _names(text: str) -> set[str]:
    found = {m.strip() for m in re.findall(r"``([^`]+)``", text)}
    found |= {m.strip() for m in re.findall(r":(?:ref|at|el):`([^`<]+?)\s*(?:<[^>]*>)?`", text)}
    return {name for name in found if name and len(name) < 80}


def _renamed(text: str) -> dict[str, str]:
    renames: dict[str, str] = {}
    for pattern in (_ARROW, _RENAMED, _REPLACE):
        for match in pattern.finditer(text):
            parts = [" ".join(part.split()) for part in match.groups() if part]
            if len(parts) == 2 and parts[0] != parts[1]:
                renames.setdefault(parts[0], parts[1])
    return renames


def _bare(name: str) -> str:
    """A name without its package, brackets and arguments: the word that identifies it."""
    name = name.strip().strip("<>/ ").removeprefix("mujoco.")
    name = re.split(r"[(\s=\[]", name)[0]
    return re.split(r"[./]|::|->", name)[-1].lower()


@cache
def _forms(name: str) -> frozenset[str]:
    """The words by which a mention can be found: `mjData.qM` by `qm`, `<equality><flexvert>` by both elements."""
    words = re.findall(r"[A-Za-z_]\w*", name)
    if re.fullmatch(r"[\w.:/]+(?:\(.*\))?", name) or len(words) > 4:
        return frozenset({_bare(name)})
    return frozenset({_bare(name), *(word.lower() for word in words)})


def _dedent(text: str) -> str:
    """Lines without the list item's indentation."""
    lines = text.splitlines()
    rest = [len(line) - len(line.lstrip()) for line in lines[1:] if line.strip()]
    cut = min(rest, default=0)
    return "\n".join([lines[0].strip() if lines else "", *(line[cut:] for line in lines[1:])])
