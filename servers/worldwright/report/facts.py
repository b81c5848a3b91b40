"""The short texts of a report: its verdict, its numbers, its journal and where everything came from."""

from dataclasses import dataclass
from typing import Any

from ..model.evidence import approval, came, rounding
from ..model.evidence.reports import ExpectationResult
from ..stamp.statement import Proof
from . import film_facts
from .chart import quantity
from .material import Material, acting

QUIET = ("time", "actor", "action", "chain", "seal", "reports", "result_sha256")
"""Fields of a journal line that the page leaves out: it shows them elsewhere, or only machines use them."""
HASHES = ("program_sha256", "plan_sha256")
UNITS = {
    "m_s2": "m/s²",
    "m_s": "m/s",
    "n_m": "N/m",
    "n_s": "N·s",
    "rad_s": "rad/s",
    "deg_s": "°/s",
    "kg": "kg",
    "hz": "Hz",
    "deg": "°",
    "rad": "rad",
    "m": "m",
    "s": "s",
    "n": "N",
    "j": "J",
}
"""The unit that each suffix of a name stands for, longest first."""


@dataclass(frozen=True)
class Fact:
    """A number with its label."""

    value: str
    label: str
    tone: str = ""
    """good, bad or warn."""


@dataclass(frozen=True)
class Event:
    """One line of the journal."""

    time: str
    actor: str
    action: str
    detail: str


def facts(material: Material) -> list[Fact]:
    """The numbers under the title; only those that are known."""
    found = []
    summary = material.physics.summary if material.physics and material.physics.ok else {}
    motion = material.motion
    duration = motion.duration_s if motion else summary.get("final_time")
    if duration:
        found.append(Fact(f"{quantity(duration)}\u202fs", "simulated"))
    step = (motion.time_step if motion else 0) or summary.get("time_step")
    if step and duration:
        count = f"{round(duration / step):,}".replace(",", "\u202f")
        found.append(Fact(count, f"steps of {quantity(step * 1000)}\u202fms"))
    if material.expect:
        objectives = material.expect.objectives
        proved = sum(o.status == "proved" for o in objectives)
        by_eye = sum(o.status == "visual_only" for o in objectives)
        tone = "good" if material.expect.ok else "bad"
        blind = not (material.visual and material.visual.looked)
        label = "claims proved" + (f", {by_eye} {'not looked at' if blind else 'by eye'}" if by_eye else "")
        found.append(Fact(f"{proved}/{len(objectives) - by_eye}", label, tone))
    if material.scan:
        blocking = sum(a.severity == "blocking" for a in material.scan.anomalies)
        looked = sum(c.status != "skipped" for c in material.scan.checks)
        anomalies = len(material.scan.anomalies)
        tone = "bad" if blocking else "warn" if anomalies else "good"
        found.append(Fact(str(anomalies), f"anomalies in {looked} checks", tone))
    ledger = acting(material)
    if ledger is not None:
        undeclared = sum(not entry.declared for entry in ledger)
        declared = ", all declared" if ledger else ""
        label = "undeclared interventions" if undeclared else f"interventions{declared}"
        found.append(Fact(str(undeclared or len(ledger)), label, "bad" if undeclared else "good"))
    if material.causes and material.causes.causes:
        shown = sum(c.outcome == "caused" for c in material.causes.causes)
        found.append(
            Fact(f"{shown}/{len(material.causes.causes)}", "causes shown", "good" if material.causes.ok else "bad")
        )
    depth = summary.get("max_penetration_m")
    if isinstance(depth, int | float):
        found.append(Fact(f"{quantity(depth * 1000)}\u202fmm", "deepest contact"))
    return found


def story(material: Material) -> list[Event]:
    """The journal as readable lines, oldest first."""
    events = []
    seen: dict[str, Any] = {}
    for entry in material.journal:
        rest = {k: v for k, v in entry.items() if k not in QUIET and v not in ("", None, [], {})}
        for name in HASHES:  # every line has them: only changes are shown
            if rest.get(name) == seen.get(name):
                rest.pop(name, None)
            seen[name] = entry.get(name, seen.get(name))
        named = ((key.removesuffix("_sha256").replace("_", " "), _short(value)) for key, value in rest.items())
        detail = ", ".join(f"{name} {value}" for name, value in named)
        events.append(Event(str(entry.get("time", "")), _actor(entry), str(entry.get("action", "")), detail))
    return events


def provenance(material: Material) -> dict[str, list[tuple[str, str]]]:
    """Where everything came from: tables of (name, value) by heading."""
    tables: dict[str, list[tuple[str, str]]] = {}
    if material.stamp:
        proof, source = material.stamp.predicate.proof, material.stamp.predicate.source
        tables["Stamp"] = [
            ("stamp", material.stamp_sha256),
            ("trajectory", proof.trajectory_sha256),
            ("program as run", source.program_sha256),
            ("program accepted", material.stamp.digest_of("simulation.py")),
            ("plan", source.plan_sha256),
            ("proof run", _proof_run(proof)),
            ("described by", _word(material.stamp.predicate.described_by, material.stamp.predicate.description_came)),
            ("reviewed by", _word(material.stamp.predicate.reviewer, material.stamp.predicate.review_came)),
            ("not looked at", ", ".join(f"objective {i}" for i in material.stamp.not_looked_at)),
            ("drawn by the program, not simulated", ", ".join(material.stamp.predicate.drawn_only)),
            ("signature", material.signer),
            ("journal", material.stamp.predicate.journal_seal),
            (
                "approved",
                (
                    f"{_word(material.stamp.predicate.approval.told, material.stamp.predicate.approval.came)}, "
                    f"{material.stamp.predicate.approval.time}"
                ),
            ),
        ]
        tables["Files"] = [(s.name, s.digest.sha256) for s in material.stamp.subject]
    elif material.physics:
        tables["Evidence"] = [
            ("key", material.status.key),
            ("trajectory", str(material.physics.summary.get("trajectory_sha256", ""))),
            ("physics pass", f"{material.physics.wall_s:.1f} s in the {material.physics.sandbox or 'unknown'} sandbox"),
        ]
    if material.physics and (rounded := rounding.told(material.physics.summary)):
        tables["World"] = [("its file", rounded)]
    if material.film:
        tables["Film"] = film_facts.rows(material.film)
    if material.handed_in:
        own = material.handed_in
        tables["Handed in, no evidence"] = [
            (own.name, own.sha256),
            ("length", f"{own.seconds:g} s at {own.size[0]}x{own.size[1]}"),
        ]
    if material.environment:
        packages: dict[str, Any] = material.environment.get("packages", {})
        film: dict[str, Any] = material.environment.get("film") or {}
        rest = {k: v for k, v in material.environment.items() if k not in ("packages", "film") and v}
        rest |= {"film": film["sha256"], "renderer": f"{film['renderer']} ({film['version']})"} if film else {}
        tables["Environment"] = [
            *((name.replace("_sha256", ""), str(value)) for name, value in rest.items()),
            *((name, str(version)) for name, version in sorted(packages.items())),
        ]
    return {name: [(k, v) for k, v in rows if v] for name, rows in tables.items()}


def _actor(entry: dict[str, Any]) -> str:
    """Who did what a line of the journal tells: nobody, where a plan was approved in auto mode."""
    actor = str(entry.get("actor", ""))
    return approval.who(actor, auto=True) if entry.get("action") == "approve" and entry.get("auto") else actor


def _word(name: str, said: str) -> str:
    """The name that an approval or a review gives, and the way it was sent."""
    return f"{name} ({came.told(said)})" if name and said else name


def strength(result: ExpectationResult) -> float:
    """How far an expectation is from its threshold, 0 to 1, relative to the larger of the two numbers."""
    if result.margin is None or result.measured is None:
        return 0.0
    scale = max(abs(result.measured), abs(result.measured - result.margin), abs(result.measured + result.margin))
    return min(1.0, abs(result.margin) / scale) if scale > 0 else 0.0


def arguments(result: ExpectationResult) -> str:
    """An expectation's arguments as one line, units after their numbers."""
    return ", ".join(_named(name, value) for name, value in result.arguments.items())


def _named(name: str, value: Any) -> str:
    """`min_m: 1.5` as `min 1.5 m`; a window as `window 0.1 to 0.3 s`."""
    unit = next((suffix for suffix in UNITS if name.endswith(f"_{suffix}")), "")
    label = name.removesuffix(f"_{unit}").replace("_", " ") if unit else name.replace("_", " ")
    numbers = isinstance(value, list | tuple) and len(value) == 2 and all(isinstance(v, int | float) for v in value)
    shown = f"{_short(value[0])} to {_short(value[1])}" if numbers else _short(value)
    return f"{label} {shown}\u202f{UNITS[unit]}" if unit else f"{label} {shown.replace('_', ' ')}"


def _short(value: Any) -> str:
    """A value in a few characters: hashes cut, lists joined, numbers rounded."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return quantity(value)
    if isinstance(value, list | tuple):
        return " ".join(_short(v) for v in value[:8]) + (" …" if len(value) > 8 else "")
    if isinstance(value, dict):
        return " ".join(f"{k}={_short(v)}" for k, v in list(value.items())[:6])
    text = str(value)
    if len(text) == 64 and all(c in "0123456789abcdef" for c in text):
        return text[:12]
    return text if len(text) <= 160 else text[:160] + "…"


def _proof_run(proof: Proof) -> str:
    when = f", begun {proof.began}" if proof.began else ""
    key = f", evidence key {proof.key}" if proof.key else ""
    earlier = ": an earlier call's than the one that stamped it" if proof.earlier else ""
    return f"{proof.wall_s:.1f} s in the {proof.sandbox or 'unknown'} sandbox{when}{key}{earlier}"
