"""Evidence: files of the run are changed between its steps, or after it was accepted, and every hash is made to fit."""

import json
import shutil
from pathlib import Path
from typing import Any

from . import forging
from .attack import Touch, Trick

TRUE = (("min_m: 0.55", "min_m: 0.28"), ("about 0.6 m", "about 0.29 m"))
"""What the world really does; the lie comes later."""


def proved(value: Any) -> Any:
    """An `expect.json` in which everything holds."""
    for objective in value["objectives"]:
        objective["status"] = "proved"
        for expectation in objective["expectations"]:
            expectation |= {"status": "holds", "measured": 0.6, "margin": 0.05}
    return value


def clean(value: Any) -> Any:
    """A `scan.json` or `interventions.json` without findings."""
    return {**value, "anomalies": []}


def cleaned(run: Path) -> None:
    """Both reports of the scan, and the journal."""
    for name in ("scan", "interventions"):
        forging.edited(forging.folder_of(run) / f"{name}.json", clean)
    forging.rewrite(run)


def trick(name: str, does: str, moment: str, touch: Touch, **more: Any) -> Trick:
    return Trick(name, "evidence", does, touch={moment: touch}, **more)  # type: ignore[dict-item]


def linked(run: Path) -> None:
    """The measurements become a link to a forged file elsewhere in the run."""
    path = forging.folder_of(run) / "expect.json"
    path.rename(run / "expect.json")
    path.symlink_to(run / "expect.json")
    forging.edited(run / "expect.json", proved)


def forgotten(run: Path) -> None:
    """Nothing is left of the journal but the approval."""
    forging.edited(forging.folder_of(run) / "expect.json", proved)
    lines = (run / "journal.jsonl").read_text(encoding="utf-8").splitlines(keepends=True)
    (run / "journal.jsonl").write_text("".join(line for line in lines if '"approve"' in line), encoding="utf-8")


def unchained(run: Path) -> None:
    """The journal is written as an older version would have, without a chain and without hashes."""
    forging.edited(forging.folder_of(run) / "expect.json", proved)
    lines = [json.loads(line) for line in (run / "journal.jsonl").read_text(encoding="utf-8").splitlines()]
    kept = [{k: v for k, v in line.items() if k not in ("chain", "reports", "result_sha256")} for line in lines]
    (run / "journal.jsonl").write_text("".join(json.dumps(line) + "\n" for line in kept), encoding="utf-8")


def planted_proof(run: Path) -> None:
    """The folder of the proof run is there already, with the forged recording as its evidence."""
    evidence = forging.folder_of(run)
    folder = run / "proof" / evidence.name
    folder.mkdir(parents=True)
    for name in ("simulation.py", "plan.md", "journal.jsonl"):
        shutil.copy(run / name, folder / name)
    shutil.copytree(evidence, folder / "evidence" / evidence.name)


def stretch(run: Path) -> None:
    forging.recording(forging.rows("state", forging.stretched))(run)


def linted_for_another(run: Path) -> None:
    """The program is exchanged after its lint, and the lint's report and line are made to be about the new one."""
    from worldwright.model.evidence.journal import Journal

    old = forging.folder_of(run)
    path = run / "simulation.py"
    text = path.read_text(encoding="utf-8")
    path.write_text(
        text.replace(
            "    return spec\n",
            "    for g in (spec.geom('ground'), spec.geom('crate')):\n        g.friction[0] = 0.19\n    return spec\n",
        ),
        encoding="utf-8",
    )
    new = forging.folder_of(run)
    shutil.copytree(old, new)
    key = json.loads((old / "key.json").read_bytes())
    key["program_sha256"] = forging.sha256(path.read_text(encoding="utf-8"))
    (new / "key.json").write_text(json.dumps(key), encoding="utf-8")
    shutil.rmtree(new / "source", ignore_errors=True)
    last = [e for e in Journal(run / "journal.jsonl").entries() if e.get("action") == "lint"][-1]
    line = {**{k: v for k, v in last.items() if k != "chain"}, "key": new.name, "program_sha256": key["program_sha256"]}
    Journal(run / "journal.jsonl").append(line)


def touching_the_wall(columns: dict[str, Any]) -> dict[str, Any]:
    """One contact of each row is said to be that of the crate and the wall."""
    seen: set[int] = set()
    for index, row in enumerate(columns["row"]):
        if row > 60 and row not in seen:
            seen.add(row)
            columns["geom1"][index], columns["geom2"][index] = 1, 2
    return columns


def fast(columns: dict[str, Any]) -> dict[str, Any]:
    return {**columns, "linvel": [[5.0 if i == 0 else v for i, v in enumerate(row)] for row in columns["linvel"]]}


def boast(value: Any) -> Any:
    """A stamp that claims more than its plan."""
    for objective in value["predicate"]["objectives"]:
        objective["claim"] = "The crate slides 6 km."
    return value


def boast_by_number(value: Any) -> Any:
    for expectation in value["predicate"]["expectations"]:
        expectation |= {"measured": 6000.0, "margin": 5999.0}
    return value


def more_objectives(value: Any) -> Any:
    first = value["predicate"]["objectives"][0]
    value["predicate"]["objectives"].append({**first, "index": 1, "claim": "The crate slides 6 km."})
    return value


def forged_pictures(run: Path) -> None:
    for path in (run / "accepted" / "stills").glob("*.png"):
        path.write_bytes(b"a picture of another world")
    forging.resealed(run)


def forged_measurements(run: Path) -> None:
    forging.edited(
        run / "accepted" / "evidence" / "expect.json",
        lambda v: {**proved(v), "objectives": [{**o, "claim": "The crate slides 6 km."} for o in v["objectives"]]},
    )
    forging.resealed(run)


def another_world(run: Path) -> None:
    """The world's file that is accepted becomes a slippery one."""
    import zipfile

    path = run / "accepted" / "world.mjz"
    with zipfile.ZipFile(path) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    files["model.xml"] = files["model.xml"].replace(b"0.40000000000000002", b"0.19").replace(b"0.4", b"0.19")
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    forging.resealed(run)


def own_key_known(run: Path) -> None:
    forging.resealed(run, boast, key="stranger")
    public = (run / "accepted" / "stamp.pub").read_bytes()
    for folder in (run, run / "accepted", run.parent):
        (folder / "known_keys").mkdir(exist_ok=True) if folder == run.parent else None
        if folder != run.parent:
            (folder / "known_keys").write_bytes(public)


def nested(run: Path) -> None:
    shutil.copytree(run / "accepted", run / "accepted" / "accepted")


def beside_another_plan(run: Path) -> None:
    plan = run / "accepted" / "plan.md"
    plan.write_text(plan.read_text(encoding="utf-8").replace("min_m: 0.28", "min_m: 0.55"), encoding="utf-8")
    forging.resealed(run)


def other_elsewhere(value: Any) -> Any:
    """Stamped on another machine, so that only a tolerance is asked for."""
    value["predicate"]["cpu"] = "another processor"
    return boast(value)


def planted_stamp(run: Path) -> None:
    """A stamp stands there already, before anything was accepted: that of an honest copy, with another claim."""
    from worldwright.stamp import tools as stamp

    honest = run.parent / "honest" / run.name
    shutil.copytree(run, honest)
    stamp.accept(str(honest), timeout_s=60)
    shutil.copytree(honest / "accepted", run / "accepted")
    forging.resealed(run, boast, key="stranger")
    shutil.copy(honest / "journal.jsonl", run / "journal.jsonl")


def stretched_motion(run: Path) -> None:
    """The stamp vouches for a recording that was stretched, its motion and its numbers."""
    from worldengine.recording import stored
    from worldwright.stamp import digest

    evidence = forging.folder_of(run)
    stretch(run)
    recording = evidence / "physics" / "trajectory"
    sha256 = stored.digest(stored.open(recording))
    (run / "accepted" / digest.NAME).write_text(digest.motion(recording).model_dump_json() + "\n", encoding="utf-8")

    def told(value: Any) -> Any:
        value["predicate"]["proof"]["trajectory_sha256"] = sha256
        for expectation in value["predicate"]["expectations"]:
            expectation |= {"measured": 0.61, "margin": 0.33}
        return value

    forging.resealed(run, told)


WALL = (
    ("- moves: {body: crate, min_m: 0.55}", "- touches: {bodies: [crate, wall]}"),
    (
        "# more objects",
        "- {name: wall, role: stands there, primitive: box, size: [0.1, 1, 0.4], fixed: true, material: wood}",
    ),
    ("  # more rows", "  - {subject: wall, predicate: PLACE-ON-BASE, params: {x: 0.8, y: 0}}"),
    ("scene_objects: [crate]", "scene_objects: [crate, wall]"),
    ("subjects: [crate]", "subjects: [crate, wall]"),
    ("subjects: [crate]", "subjects: [crate, wall]"),
)
BELT = ("spec.geom('ground').surfacevel = (.35, 0, 0, 0, 0, 0)",)
BELT_SPEED = (
    ("min_m: 0.55", "min_m: 0.5"),
    ("# constants", 'constants: {launch_speed: {value: 0.35, unit: m/s, source: "the speed of a hand"}}'),
)

TRICKS = (
    trick(
        "measurements_edited",
        "What was measured is changed by hand.",
        "expected",
        forging.report("expect", proved, journal=False),
    ),
    trick(
        "measurements_edited_with_the_journal",
        "What was measured is changed, and the journal written anew.",
        "expected",
        forging.report("expect", proved, journal=True),
    ),
    trick(
        "measurements_edited_at_last",
        "The same after the review.",
        "reviewed",
        forging.report("expect", proved, journal=False),
        plan=TRUE,
    ),
    trick("measurements_behind_a_link", "What was measured is a link to a forged file.", "expected", linked),
    trick("journal_forgotten", "Nothing is left of the journal but the approval.", "expected", forgotten),
    trick("journal_unchained", "The journal is written as by an older version.", "expected", unchained),
    trick(
        "scan_edited",
        "What the scan found is deleted.",
        "scanned",
        forging.report("scan", clean, journal=False),
        build=BELT,
        plan=BELT_SPEED,
    ),
    trick(
        "scan_edited_with_the_journal",
        "What the scan found is deleted, and the journal written anew.",
        "scanned",
        cleaned,
        build=BELT,
        plan=BELT_SPEED,
    ),
    trick(
        "recording_stretched",
        "The recording is stretched, without its hashes.",
        "simulated",
        lambda run: forging.rows("state", forging.stretched)(forging.folder_of(run) / "physics" / "trajectory"),
    ),
    trick(
        "recording_stretched_with_hashes",
        "The recording is stretched, and every hash made to fit.",
        "simulated",
        stretch,
    ),
    Trick(
        "recording_stretched_with_a_planted_proof",
        "evidence",
        "The recording is stretched, and the proof run's folder planted.",
        touch={"simulated": stretch, "reviewed": planted_proof},
    ),
    trick(
        "contacts_forged",
        "Contacts with a wall are written into the recording, whose hash does not know them.",
        "simulated",
        forging.recording(forging.rows("contacts", touching_the_wall)),
        plan=WALL,
    ),
    trick(
        "speed_forged",
        "The speed is changed in the recording.",
        "simulated",
        forging.recording(forging.rows("state", fast)),
        plan=(("- moves: {body: crate, min_m: 0.55}", "- reaches_speed: {body: crate, min_m_s: 4}"),),
    ),
    trick(
        "plan_changed_after_approval",
        "The plan's claim is lowered after it was approved.",
        "approved",
        lambda run: (run / "plan.md").write_text(
            (run / "plan.md").read_text(encoding="utf-8").replace("min_m: 0.55", "min_m: 0.28"), encoding="utf-8"
        ),
    ),
    trick(
        "plan_changed_after_the_review",
        "The plan's claim is raised after the review.",
        "reviewed",
        lambda run: (run / "plan.md").write_text(
            (run / "plan.md").read_text(encoding="utf-8").replace("min_m: 0.28", "min_m: 0.55"), encoding="utf-8"
        ),
        plan=TRUE,
    ),
    trick(
        "program_changed_after_lint",
        "The program is exchanged after its lint.",
        "linted",
        lambda run: (run / "simulation.py").write_text(
            (run / "simulation.py").read_text(encoding="utf-8").replace("linear=(1.5", "linear=(2.2"), encoding="utf-8"
        ),
    ),
    trick(
        "lint_of_another_program",
        "The program is exchanged, and the lint's report with its line in the journal.",
        "linted",
        linted_for_another,
    ),
    trick(
        "description_forged",
        "The description is changed by hand.",
        "described",
        forging.report(
            "visual", lambda v: {**v, "author": "a person", "summary": "It looks like 6 km."}, journal=False
        ),
        plan=TRUE,
    ),
    trick(
        "review_forged",
        "The review is changed by hand.",
        "reviewed",
        forging.report("review", lambda v: {**v, "reviewer": "a person"}, journal=False),
        plan=TRUE,
    ),
    trick(
        "stamp_planted",
        "A stamp of a stranger's key, with another claim, stands there before the acceptance.",
        "reviewed",
        planted_stamp,
        plan=TRUE,
        boast="6 km",
    ),
    trick(
        "stamp_boasts",
        "The accepted stamp claims more, unsigned.",
        "accepted",
        lambda run: forging.resealed(run, boast),
        plan=TRUE,
    ),
    trick(
        "stamp_boasts_by_a_stranger",
        "The accepted stamp claims more, signed by a stranger.",
        "accepted",
        lambda run: forging.resealed(run, boast, key="stranger"),
        plan=TRUE,
    ),
    trick(
        "stamp_boasts_by_a_key_made_known",
        "The stranger's key lies in the run folder as a known one.",
        "accepted",
        own_key_known,
        plan=TRUE,
    ),
    trick(
        "stamp_boasts_under_the_old_signature",
        "The stamp claims more; the signature is that of the old one.",
        "accepted",
        lambda run: (run / "accepted" / "stamp.json").write_text(
            (run / "accepted" / "stamp.json").read_text(encoding="utf-8").replace("about 0.29 m", "about 6 km"),
            encoding="utf-8",
        ),
        plan=TRUE,
    ),
    trick(
        "anybody_boasts",
        "For whoever may have accepted it: the stamp claims what its plan does not.",
        "accepted",
        lambda run: forging.resealed(run, boast),
        plan=TRUE,
        anybody=True,
        boast="6 km",
    ),
    trick(
        "anybody_boasts_by_number",
        "For whoever: the stamp says it measured 6 km.",
        "accepted",
        lambda run: forging.resealed(run, boast_by_number),
        plan=TRUE,
        anybody=True,
    ),
    trick(
        "anybody_adds_an_objective",
        "For whoever: the stamp has one objective more.",
        "accepted",
        lambda run: forging.resealed(run, more_objectives),
        plan=TRUE,
        anybody=True,
        boast="6 km",
    ),
    trick(
        "anybody_paints",
        "For whoever: the stills are of another world.",
        "accepted",
        forged_pictures,
        plan=TRUE,
        anybody=True,
    ),
    trick(
        "anybody_measures",
        "For whoever: the measurements that are kept claim more.",
        "accepted",
        forged_measurements,
        plan=TRUE,
        anybody=True,
    ),
    trick(
        "anybody_elsewhere",
        "For whoever: the stamp says another machine made it, so that a tolerance is enough.",
        "accepted",
        lambda run: forging.resealed(run, other_elsewhere),
        plan=TRUE,
        anybody=True,
        boast="6 km",
    ),
    trick(
        "anybody_changes_the_plan",
        "For whoever: the plan that is kept claims more.",
        "accepted",
        beside_another_plan,
        plan=TRUE,
        anybody=True,
    ),
    trick(
        "anybody_damages_the_world",
        "For whoever: the world's file is damaged.",
        "accepted",
        another_world,
        plan=TRUE,
        anybody=True,
    ),
    Trick(
        "anybody_stretches_the_motion",
        "evidence",
        "For whoever: the stamp tells of a stretched recording, by its hash, its motion and its numbers.",
        plan=TRUE,
        touch={"accepted": stretched_motion},
        anybody=True,
        refused_by="trajectory",
    ),
    trick("folder_in_a_folder", "The accepted folder holds itself.", "accepted", nested, plan=TRUE),
)
