"""The table: published figures as anchor rows, the judged folders as rows of their own, with all that they rest on.

A row of a judged folder is computed from its votes each time; nothing of it is typed. It is withheld while a film is undecided,
and marked where its judge has not been found fit.
"""

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path

from worldkit.files import write_atomic

from ..model.errors import NotFoundError, WorldwrightError
from ..model.evidence.run import Run
from ..model.frozen import Frozen
from ..model.storage import writing
from . import anchor_rows, calibration, eighty, staging_audit, tally
from .ballot import Decided, TieError
from .calibration import Calibrated
from .judges import JudgeError
from .staging_audit import Staging
from .tally import Group, Share, Tally
from .verdict_record import FilmRecord, Protocol, Records

NAMES = ("scores.md", "scores.csv", "scores.html")
COLUMNS = ("system", "source", "category", "n", "metric", "passed", "share", "low_95", "high_95")


class Own(Frozen):
    """One judged folder."""

    name: str
    protocol: Protocol
    tally: Tally | None = None
    """None while films are undecided."""
    undecided: dict[str, str] = {}
    """By scenario, why."""
    beyond: tuple[str, ...] = ()
    """Judged films of none of the set's scenarios, which do not count."""
    failing: dict[str, tuple[str, ...]] = {}
    """By scenario, the fields that were denied."""
    calibrated: Calibrated | None = None
    staging: Staging | None = None
    not_audited: dict[str, str] = {}
    """By run, why its staging could not be told."""
    models: tuple[str, ...] = ()
    """As the judge named itself in its answers."""
    tokens: tuple[int, int] = (0, 0)
    cost_usd: float | None = None

    @property
    def remark(self) -> str:
        """What stands beside its figures."""
        if self.calibrated is None:
            return "judge not calibrated"
        return "" if self.calibrated.fit else "judge UNFIT"

    @property
    def claimed(self) -> str:
        """How claimed outcomes came about, with how many runs that is not told of; why stands with each of them below."""
        told = [self.staging.text()] if self.staging else []
        told += [f"{len(self.not_audited)} runs not audited"] if self.not_audited else []
        return "; ".join(told) or "no film of a run"


class Report(Frozen):
    """All of it."""

    own: tuple[Own, ...] = ()

    @property
    def ok(self) -> bool:
        """Whether every judged folder has its row."""
        return all(one.tally is not None for one in self.own)

    def text(self) -> str:
        """As Markdown."""
        return markdown(self)


def of(records: Records, everything: bool = True) -> Own:
    """One judged folder, counted.

    Args:
        everything: the set's eighty scenarios are the denominator; else only the films that were given.
    """
    entered, set_of = records.entered(), {one.id: one.category for one in eighty.prompts()}
    found = {one.id: one for one in records.all() if entered is None or one.id in entered.ids}
    beyond = tuple(id for id in found if id not in set_of) if everything else ()
    found = {id: one for id, one in found.items() if id not in beyond}
    decided: dict[str, Decided] = {}
    # A hearing that was killed while it entered its films wrote of some only that they are there.
    undecided = {
        id: "it was entered and never heard"
        for id in (entered.ids if entered else ())
        if id not in found and (id in set_of or not everything)
    }
    for id, record in found.items():
        try:
            decided[id] = record.decided()
        except (TieError, JudgeError) as cause:
            undecided[id] = cause.cause
    asked = set_of if everything else {id: set_of.get(id) or record.category for id, record in found.items()}
    staging, blind = _staging(record for record in found.values() if record.run)
    votes = [vote for record in found.values() for vote in record.votes]
    costs = [vote.cost_usd for vote in votes if vote.cost_usd is not None]
    planted = records.calibration
    return Own(
        name=records.folder.name,
        protocol=records.protocol(),
        tally=None if undecided or not found else tally.tally(asked, decided),
        undecided=undecided
        if found
        else {"(all)": "no film of the set was judged" if beyond else "no film was judged yet"},
        beyond=beyond,
        failing={
            id: no
            for id, one in decided.items()
            if (no := tuple(name for name, held in one.fields.items() if not held))
        },
        calibrated=_calibrated(planted, records.protocol()),
        staging=staging,
        not_audited=blind,
        models=tuple(sorted({vote.model for vote in votes if vote.model})),
        tokens=(sum(vote.tokens_in or 0 for vote in votes), sum(vote.tokens_out or 0 for vote in votes)),
        cost_usd=sum(costs) if costs else None,
    )


def _calibrated(planted: Records, protocol: Protocol) -> Calibrated | None:
    """By the same judge, asked and shown alike; another's calibration says nothing."""
    try:
        same = planted.protocol() == protocol
    except NotFoundError:
        return None
    return calibration.calibrated(planted.all()) if same else None


def _staging(records: Iterable[FilmRecord]) -> tuple[Staging | None, dict[str, str]]:
    found, blind = [], {}
    for record in records:
        try:
            found.append(staging_audit.of_accepted(Run(record.run), record.film_sha256))
        except WorldwrightError as error:
            blind[record.id] = error.cause
    return (staging_audit.together(found) if found else None), blind


def markdown(report: Report) -> str:
    """The report as Markdown."""
    lines = [
        "# Scores",
        "",
        "SA: objects and event are there; PC: every key standard holds; both: everything correct.",
        "",
    ]
    heads = ("system", "n", "SA", "PC", "SA and PC", "claimed outcomes", "remark")
    rows = [
        (g.name, str(g.both.of), g.sa.text(), g.pc.text(), g.both.text(), "not told", "published")
        for g in anchor_rows.systems()
    ]
    for one in report.own:
        if one.tally is None:
            rows.append((one.name, "", "withheld", "withheld", "withheld", "", f"{len(one.undecided)} films undecided"))
            continue
        g = one.tally.overall
        rows.append((one.name, str(g.both.of), g.sa.text(), g.pc.text(), g.both.text(), one.claimed, one.remark))
    lines += _table(heads, rows)
    lines += ["", f"In brackets: Wilson's interval of 95 %. Published: {anchor_rows.CITED}."]
    if report.own:
        lines += [
            (
                "Another judge, exhibit or question is another protocol: between its rows and the published ones only large "
                "differences mean anything."
            ),
        ]
    lines += ["", f"## {anchor_rows.REFERENCE}, published, by category", ""]
    lines += _table(("category", "n", "SA", "PC", "SA and PC"), [_cells(g) for g in anchor_rows.categories()])
    for one in report.own:
        lines += ["", *_own(one)]
    return "\n".join(lines) + "\n"


def _own(one: Own) -> list[str]:
    lines = [
        f"## {_plain(one.name)}",
        "",
        f"Judged by {_plain(one.protocol.text())}; protocol {one.protocol.sha256[:12]}.",
    ]
    if one.models:
        lines.append(f"It names itself {_plain(', '.join(one.models))}.")
    cost = f", {one.cost_usd:.2f} USD by its own word" if one.cost_usd is not None else ""
    lines += [f"Tokens: {one.tokens[0]:,} in, {one.tokens[1]:,} out{cost}.", ""]
    if one.tally is not None:
        lines += _table(("category", "n", "SA", "PC", "SA and PC"), [_cells(g) for g in one.tally.groups])
        lines += ["", f"Key standards that hold: {one.tally.standards.text()} of {one.tally.standards.of} judged."]
        lines += [f"Votes: {one.tally.agreement.text()}."]
        if one.tally.without_film:
            lines += [
                (
                    f"Without a film, and counted as not passed: {len(one.tally.without_film)} "
                    f"({', '.join(one.tally.without_film[:20])}{' …' if len(one.tally.without_film) > 20 else ''})."
                )
            ]
    if one.beyond:
        lines += [
            "",
            f"Of none of the set's scenarios, and not counted (`--given-only` counts them): {', '.join(one.beyond)}.",
            "",
        ]
    if one.undecided:
        lines += [f"Undecided, so that the row is withheld: {len(one.undecided)}", ""]
        lines += _table(("scenario", "why"), [(id, why) for id, why in one.undecided.items()])
    if one.failing:
        lines += ["", "Fields that were denied:", ""]
        lines += _table(("scenario", "fields"), [(id, ", ".join(no)) for id, no in one.failing.items()])
    lines += ["", "### The judge, on films with a planted fault", ""]
    lines += _calibration(one.calibrated)
    if one.staging or one.not_audited:
        lines += ["", "### Staging", ""]
    if one.staging:
        lines += [
            (
                f"Claimed outcomes of {one.staging.worlds} accepted worlds, {one.staging.text()} (by the ledger of "
                "interventions and the causal audit)."
            ),
        ]
    if one.not_audited:
        lines += ["", *_table(("scenario", "not audited"), list(one.not_audited.items()))]
    return lines


def _calibration(found: Calibrated | None) -> list[str]:
    if found is None:
        return ["Not calibrated: `worldwright judge calibrate` shows it films whose faults are known."]
    m = found.matrix
    lines = _table(
        ("", "judge: Yes", "judge: No"),
        [("it is so", str(m.yes_yes), str(m.yes_no)), ("it is not so", str(m.no_yes), str(m.no_no))],
    )
    lines += ["", f"Yes to what is so: {m.sensitivity.text()}; No to what is not: {m.specificity.text()}.", ""]
    lines += _table(
        ("fault", "films", "answered rightly"), [(f, str(s.of), str(s.passed)) for f, s in found.found.items()]
    )
    return [*lines, "", "Fit to judge." if found.fit else f"**Unfit to judge**: {'; '.join(found.unfit)}."]


def csv_text(report: Report) -> str:
    """One line for each system, category and metric."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    published = [(anchor_rows.REFERENCE, g) for g in anchor_rows.categories()]
    for system, group in [
        *((g.name, g.model_copy(update={"name": tally.OVERALL})) for g in anchor_rows.systems()),
        *published,
    ]:
        writer.writerows(_lines(system, "published", group))
    for one in report.own:
        for group in one.tally.groups if one.tally else ():
            writer.writerows(_lines(one.name, one.remark or "judged", group))
    return out.getvalue()


def html(report: Report) -> str:
    """The Markdown as a page; nothing of a name or an answer is read as markup."""
    from markdown_it import MarkdownIt

    reader = MarkdownIt("commonmark", {"html": False}).enable("table").disable(["image", "link", "autolink"])
    body = reader.render(markdown(report))
    return (
        '<!doctype html>\n<html lang="en"><meta charset="utf-8"><title>Scores</title>\n'
        "<style>body{font:15px/1.5 system-ui,sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem}"
        "table{border-collapse:collapse;margin:.5rem 0}td,th{border-bottom:1px solid #bbb;padding:.25rem .7rem;text-align:left}"
        f"</style>\n{body}</html>\n"
    )


def write(report: Report, folder: Path) -> list[Path]:
    """Write Markdown, CSV and HTML; returns the files."""
    texts = dict(zip(NAMES, (markdown(report), csv_text(report), html(report)), strict=True))
    with writing("the report", folder):
        for name, text in texts.items():
            write_atomic(folder / name, text)
    return [folder / name for name in NAMES]


def _lines(system: str, source: str, group: Group) -> Iterable[tuple[object, ...]]:
    metrics: dict[str, Share] = {"SA": group.sa, "PC": group.pc, "SA and PC": group.both}
    for metric, share in metrics.items():
        low, high = share.within
        yield (
            system, source, group.name, share.of, metric, share.passed,
            f"{share.value:.4f}", f"{low:.4f}", f"{high:.4f}",
        )  # fmt: skip


def _cells(group: Group) -> tuple[str, ...]:
    return (group.name, str(group.both.of), group.sa.text(), group.pc.text(), group.both.text())


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    def line(cells: Sequence[str]) -> str:
        return f"| {' | '.join(map(_plain, cells))} |"

    return [line(heads), f"|{'---|' * len(heads)}", *(line(row) for row in rows)]


def _plain(text: str) -> str:
    """A name or an answer on one line, in which nothing is a link, a picture or a cell's end."""
    return " ".join(text.split()).replace("|", "&#124;").replace("<", "&lt;").replace("](", "]&#40;")
