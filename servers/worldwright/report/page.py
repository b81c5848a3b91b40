"""The page: material in, one self-contained `report.html` out. No request ever leaves it."""

from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.files import write_atomic

from ..model import printable
from ..model.evidence.run import Run
from ..shelf import Entry, failed
from . import chart, media
from .facts import facts
from .material import Material, gather
from .sections import SECTIONS

if TYPE_CHECKING:
    from jinja2 import Environment

TONES = 8
FAILED = "<section><p class='reason'>The section {{ what }}.</p></section>"


def write(run: Run) -> Path:
    """Write the run's report and return its path."""
    write_atomic(run.report, render(gather(run)))
    return run.report


def render(material: Material) -> str:
    """The whole page as HTML.

    No sign in it turns the direction of reading or hides what follows, whoever wrote the words and however, by an entity too: it is
    written out.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined

    environment = Environment(
        loader=PackageLoader("worldwright.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"quantity": chart.quantity, "seconds": _seconds, "clock": _clock, "plain": _plain}
    shared = _context(material)
    sections = [_section(environment, entry, material, shared) for entry in SECTIONS.values()]
    return printable.words(environment.get_template("page.html").render(**shared, sections=sections))


def _section(environment: "Environment", entry: Entry, material: Material, shared: dict[str, Any]) -> str:
    """One section as HTML; one that fails is named in its place."""
    try:
        return environment.get_template(entry.TEMPLATE).render(**shared, **entry.context(material))
    except Exception as defect:  # the page must come out whatever one section holds
        return environment.from_string(FAILED).render(what=failed(entry, defect))


def _context(material: Material) -> dict[str, Any]:
    films = media.videos(material.videos)
    stills = {name: uri for name, path in material.stills.items() if (uri := media.still(path))}
    first = next((name for name in films if not (material.film and name == "film")), None)
    return {
        "m": material,
        "title": (material.plan.title if material.plan else "") or material.run.name,
        "lede": _lede(material),
        "films": films,
        "handed_in": media.handed_in(material.handed_in_path, material.handed_in.sha256)
        if material.handed_in and material.handed_in_path
        else "",
        "stills": stills,
        "strip": media.frames(material.videos[first]) if first else [],
        "charts": _charts(material),
        "layout": media.picture(material.layout) if material.layout else None,
        "facts": facts(material),
    }


def _charts(material: Material) -> dict[str, Any] | None:
    motion = material.motion
    if motion is None:
        return None
    names = [line.name for line in motion.heights]
    tones = {name: i % TONES for i, name in enumerate(names)}
    end = motion.duration_s
    drawn = []
    if motion.heights:
        drawn.append(chart.over_time("Height", "m", motion.heights, end, tones, "of the body's origin above z = 0"))
    if motion.speeds:
        drawn.append(chart.over_time("Speed", "m/s", motion.speeds, end, tones, "of the body's origin"))
    energy = None
    if motion.energies:
        kinds = {line.name: i for i, line in enumerate(motion.energies)}
        energy = chart.over_time("Energy", "J", motion.energies, end, kinds, "of the whole system")
    above, aspect = chart.from_above(motion.paths, tones) if motion.paths else (None, 1.0)
    return {
        "lines": drawn,
        "energy": energy,
        "rows": chart.timeline(motion.contacts, end or 1.0),
        "above": above,
        "aspect": aspect,
        "end": end,
        "ticks": chart.axis(0.0, end or 1.0, 6),
    }


def _lede(material: Material) -> str:
    """The prompt's words, without its heading."""
    lines = [line for line in material.prompt.splitlines() if line.strip() and not line.startswith("#")]
    return " ".join(line.strip().lstrip("> ") for line in lines)[:600]


def _seconds(value: float) -> str:
    """A moment as `1.25 s`."""
    return f"{value:.2f}\u202fs"


def _clock(value: Any) -> str:
    """An ISO time as a person reads it; anything else as it is."""
    try:
        return datetime.fromisoformat(str(value)).strftime("%-d %b %Y, %H:%M:%S")
    except ValueError:
        return str(value)


def _plain(value: Any) -> str:
    """A name without its underscores."""
    return str(value).replace("_", " ")
