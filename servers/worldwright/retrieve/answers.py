"""What the retrieve server answers."""

from ..model.frozen import Frozen
from ..simulator.changelog import Change


class Hit(Frozen):
    """One piece of the corpus that bears on a question."""

    citation: str
    """Stable name that `read` opens, e.g. `mujoco-4.0.0/doc/XMLreference.rst#body-geom-friction:L2957-L2965`."""
    path: str
    """File, relative to the package it comes from."""
    title: str
    """Headings above it."""
    text: str
    """Its text, or the part around the best match."""
    score: float
    """Larger is better; comparable within one answer only."""


class SearchResult(Frozen):
    """Hits, best first."""

    question: str
    hits: tuple[Hit, ...] = ()
    ranking: str = "full_text"
    """How they were ranked: `hybrid` once the model of meanings is loaded."""
    note: str = ""

    @property
    def ok(self) -> bool:
        """Whether something was found."""
        return bool(self.hits)

    def text(self) -> str:
        """Citations with excerpts."""
        if not self.hits:
            return self.note or "nothing found"
        parts = []
        for number, hit in enumerate(self.hits, 1):
            body = "\n".join("    " + line for line in hit.text.splitlines()[:12])
            parts.append(f"{number}. {hit.citation}\n   {hit.title}\n{body}")
        return "\n\n".join(parts)


class Passage(Frozen):
    """An opened citation."""

    citation: str
    title: str = ""
    content: str = ""
    """The lines as they stand in the file."""
    first: int = 1
    last: int = 1
    lines: int = 1
    """How many lines the file has."""
    next: str = ""
    """Citation of what follows, when there is more."""
    note: str = ""

    def text(self) -> str:
        """The passage as a person reads it."""
        note = f"\n({self.note})" if self.note else ""
        more = f"\n… next: {self.next}" if self.next else ""
        return f"{self.citation}  {self.title}\n\n{self.content}{more}{note}"


class Definition(Frozen):
    """One thing a name stands for in the installed build."""

    kind: str
    """function, class, method, field, enum, enum value, constant, module, element or attribute."""
    name: str
    signature: str = ""
    documentation: str = ""
    members: tuple[str, ...] = ()
    """Names that a class, enum, module or element contains."""
    citations: tuple[str, ...] = ()


class SymbolAnswer(Frozen):
    """The answer about a name in the installed build."""

    symbol: str
    version: str
    exists: bool
    definitions: tuple[Definition, ...] = ()
    nearest: tuple[str, ...] = ()
    changes: tuple[Change, ...] = ()
    """Changelog entries that rename, remove or reshape it."""

    @property
    def ok(self) -> bool:
        """Whether the name exists."""
        return self.exists

    def text(self) -> str:
        """Signature, documentation, and what became of it."""
        ours = self.exists and all(one.name.startswith("worldkit.") for one in self.definitions)
        where = "worldkit" if ours else f"MuJoCo {self.version}" + ("" if self.exists else ", nor in worldkit")
        lines = [f"{self.symbol}: {'exists' if self.exists else 'does not exist'} in {where}"]
        for one in self.definitions:
            lines += ["", f"{one.kind} {one.name}"]
            lines += [f"    {line}" for line in one.signature.splitlines()]
            lines += [f"    {line}" for line in one.documentation.splitlines()]
            if one.members:
                lines.append("    holds: " + ", ".join(one.members))
            lines += [f"    see {citation}" for citation in one.citations]
        if self.nearest:
            lines += ["", "nearest: " + ", ".join(self.nearest)]
        for change in self.changes:
            lines += ["", *_change(change)]
        return "\n".join(lines)


class ChangeRow(Change):
    """A row with its citation."""

    cited: str


class ChangeTable(Frozen):
    """Rows of the breaking-changes table."""

    name: str
    changes: tuple[ChangeRow, ...] = ()
    total: int = 0
    """How many rows match; the first are shown."""

    def text(self) -> str:
        """One block a row."""
        if not self.changes:
            return f"the changelog does not mention `{self.name}`"
        blocks = ["\n".join(_change(change)) for change in self.changes]
        more = f"\n\n… {self.total - len(self.changes)} more" if self.total > len(self.changes) else ""
        return "\n\n".join(blocks) + more


class AssetHit(Frozen):
    """A catalog entry."""

    key: str
    category: str
    description: str
    extents_m: tuple[float, float, float]
    """Full extents, m, at its usual height."""
    height_m: float
    mass_kg: float | None = None
    """None of an offer, which is weighed when it is taken in."""
    thumbnail: str = ""
    score: float = 0.0
    source: str = ""
    """Which source delivers it: `recipes`, `own_folder`, `mesh_files` …"""
    licence: str = ""
    creator: str = ""
    taken_in: bool = True
    """False of what a packaged library offers: `next_move` makes it an asset, which a plan can name."""
    chosen: bool = False
    """Of an offer: whether its picture was looked at, and shows what its name says."""
    next_move: str = ""

    def text(self) -> str:
        """One line."""
        weight = "" if self.mass_kg is None else f", {self.mass_kg:.3g} kg"
        more = f"; an offer, take it in: {self.next_move}" if self.next_move else ""
        return f"{self.key:16} {self.height_m:g} m high{weight}  {self.category}: {self.description}{more}"


class LookHit(Frozen):
    """A surface that any object can have as its `look`."""

    name: str
    description: str


class AssetList(Frozen):
    """Catalog entries, best first, and looks for what is built of primitives instead."""

    query: str
    assets: tuple[AssetHit, ...] = ()
    known: tuple[str, ...] = ()
    """Every key, when nothing fits."""
    looks: tuple[LookHit, ...] = ()
    """Looks whose words fit."""
    next_move: str = ""
    """How to come by the thing, when nothing fits."""

    @property
    def ok(self) -> bool:
        """Whether an asset or a look fits."""
        return bool(self.assets)

    def text(self) -> str:
        """One asset a line, then the looks."""
        lines = [asset.text() for asset in self.assets]
        if not lines:
            known = ", ".join(self.known) or "(none)"
            lines = [f"no asset fits '{self.query}' (known: {known})", f"  next: {self.next_move}"]
        if self.looks:
            lines.append("looks: " + "; ".join(f"{look.name} ({look.description})" for look in self.looks))
        return "\n".join(lines)


class RetrieveStatus(Frozen):
    """What is searched, and how."""

    simulator: str
    pieces: dict[str, int]
    """Pieces of text by part of the corpus."""
    documents: int
    left_out: dict[str, str] = {}
    """Files of the manual that are not searched, and why."""
    index: str
    rankings: tuple[str, ...]
    changes: int
    """Rows of the breaking-changes table."""
    assets: int
    sources: tuple[str, ...] = ()
    """The user's own folders and exports."""

    def text(self) -> str:
        """The status as a person reads it."""
        parts = ", ".join(f"{count} of {part}" for part, count in self.pieces.items())
        return (
            f"MuJoCo {self.simulator}: {self.documents} documents, {sum(self.pieces.values())} pieces ({parts}); "
            f"{self.changes} changelog rows; {self.assets} assets\n"
            f"rankings: {', '.join(self.rankings)}; index: {self.index}"
            + "".join(f"\nyours: {root}" for root in self.sources)
        )


def _change(change: Change) -> list[str]:
    head = f"{change.version} {change.section}{' (breaking)' if change.breaking else ''}"
    lines = [head, *(f"    {line}" for line in change.text.splitlines())]
    if change.migration:
        lines += ["    migration:", *(f"      {line}" for line in change.migration.splitlines())]
    if change.renamed:
        lines.append("    renamed: " + ", ".join(f"{old} -> {new}" for old, new in change.renamed.items()))
    lines.append(f"    see {change.citation}")
    return lines


class NearWorld(Frozen):
    """An accepted world that is near to a sentence."""

    slug: str
    title: str
    why: str
    score: float
    """Larger is nearer; comparable within one answer only."""


class SkillToRead(Frozen):
    """A skill that a mechanism asks for."""

    name: str
    why: str


class PageToRead(Frozen):
    """A page, or a case with plan and film, about the very matter of a sentence."""

    path: str
    title: str


class Begun(Frozen):
    """A plan that was begun from an accepted world."""

    run: str
    plan: str
    like: str
    """The world it was begun from."""
    nearest: tuple[NearWorld, ...] = ()
    pages: tuple[PageToRead, ...] = ()
    """About the sentence's very matter: read before the plan's numbers are decided."""
    skills: tuple[SkillToRead, ...] = ()
    to_change: tuple[int, ...] = ()
    """Lines of the plan on which `TO_CHANGE` stands."""
    film: str = ""
    """Where that world's `film.py` lies, as an example of shots at this scale; empty if it has none."""
    next_move: str = ""

    def text(self) -> str:
        """The folder, the nearest worlds, what to read, and the next command."""
        lines = [f"{self.plan}: begun from {self.like}, {len(self.to_change)} places marked TO_CHANGE"]
        lines += ["near:"] + [f"  {near.slug}: {near.why} ({near.score:.2f})" for near in self.nearest]
        lines += ["about this very matter, read first:"] if self.pages else []
        lines += [f"  {one.path}: {one.title}" for one in self.pages]
        lines += ["look up when a field asks:"] + [f"  skills/{one.name}: {one.why}" for one in self.skills]
        lines += [f"its film, to learn from: {self.film}"] if self.film else []
        return "\n".join([*lines, f"next: {self.next_move}"])
