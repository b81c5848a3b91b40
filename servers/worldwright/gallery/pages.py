"""Write two pages that show all worlds: the README's table of posters, and an index of the built worlds."""

from html import escape
from pathlib import Path

from worldkit.files import write_atomic

from ..model.evidence import handed_in
from ..model.evidence.run import Run
from ..model.plan.plan_text import read_plan
from ..stamp.poster import NAME as POSTER
from . import worlds

README = Path("README.md")
BEGIN, END = "<!-- worlds: written by `worldwright gallery` -->", "<!-- /worlds -->"
ROW = 3
"""So many posters stand beside each other."""

STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 72rem; padding: 0 1rem; color: #1c1c1c; }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(20rem, 1fr)); gap: 2rem; }
video, img { width: 100%; border-radius: .4rem; background: #eee; } h2 { font-size: 1.05rem; margin: .4rem 0; }
p { margin: .3rem 0; } .quiet { color: #666; font-size: .9rem; }
"""


def table(root: Path = Path()) -> str:
    """The README's table of the posters of the worlds under `root`; empty without any."""
    found = [path for path in sorted((root / worlds.EXAMPLES).glob("*/plan.md")) if path.with_name(POSTER).is_file()]
    cells = []
    for path in found:
        title = escape(_title(path), quote=True)
        folder = path.parent.relative_to(root).as_posix()
        cells.append(f'<a href="{folder}"><img src="{folder}/{POSTER}" width="270" alt="{title}"></a>')
    return "\n".join("\n".join(cells[i : i + ROW]) for i in range(0, len(cells), ROW))


def write_table(root: Path = Path()) -> bool:
    """Put the table into the README, between its marks; returns whether anything changed."""
    path = root / README
    text = path.read_text(encoding="utf-8")
    head, begin, rest = text.partition(BEGIN)
    _, end, tail = rest.partition(END)
    if not (begin and end):
        return False
    shown = table(root)
    new = head + begin + ("\n" + shown if shown else "") + "\n" + end + tail
    if new != text:
        write_atomic(path, new)
    return new != text


def write_index(slugs: list[str]) -> Path:
    """Write the index of the built worlds: the first film of each, its claims, and its report."""
    cards = "\n".join(_card(slug) for slug in slugs)
    page = (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>Worlds</title><style>{STYLE}</style>'
        f"<h1>Accepted worlds</h1><main>\n{cards}\n</main></html>\n"
    )
    path = worlds.BUILT / "index.html"
    write_atomic(path, page)
    return path


def _card(slug: str) -> str:
    run = Run(worlds.BUILT / slug)
    plan = read_plan(run.plan).plan
    order = [camera.name for camera in plan.cameras()]
    films = sorted(
        run.folder.glob("evidence/*/video/*.mp4"),
        key=lambda p: (-p.parents[1].stat().st_mtime, order.index(p.stem) if p.stem in order else len(order)),
    )
    poster = f"{slug}/{POSTER}" if (run.folder / POSTER).is_file() else ""
    shown = f'<img src="{poster}" alt="">' if poster else ""
    if films:
        film = films[0].relative_to(worlds.BUILT.resolve()).as_posix()
        shown = f'<video src="{film}" poster="{poster}" controls loop muted preload="metadata"></video>'
    claims = "".join(f"<p>{escape(objective.claim)}</p>" for objective in plan.objectives)
    shown += _handed_in(slug, run)
    report = f'<p class="quiet"><a href="{slug}/report.html">report</a></p>' if run.report.is_file() else ""
    return f"<article>{shown}<h2>{escape(plan.title or slug)}</h2>{claims}{report}</article>"


def _handed_in(slug: str, run: Run) -> str:
    """The author's own film, marked as such; empty where none was handed in, or none that can be shown."""
    try:
        film = handed_in.of(run.folder)
    except handed_in.HandedInError:
        return ""
    if film is None:
        return ""
    return (
        f'<video src="{slug}/{film.name}" controls loop muted preload="metadata"></video>'
        '<p class="quiet">the author\'s own film, handed in: no evidence</p>'
    )


def _title(plan: Path) -> str:
    return read_plan(plan).plan.title or plan.parent.name.replace("-", " ")
