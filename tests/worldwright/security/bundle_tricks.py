"""The bundle: an accepted world's file, its facts or its recorded inputs are forged, and the folder is sealed anew.

Whoever wrote it vouches for it here (`anybody`), so only what is proved again can refuse.
"""

import json
import zipfile
from pathlib import Path
from typing import Any

from worldwright.model.evidence.run import sha256_file

from . import forging
from .attack import Touch, Trick
from .evidence_tricks import TRUE
from .input_tricks import declared

BREEZE = (*TRUE, declared("force", "a breeze of 1 N along +X"))
FARTHER = (
    ("min_m: 0.55", "min_m: 0.3"),
    ("about 0.6 m", "about 0.3 m"),
    declared("force", "a breeze of 1 N along +X"),
)
"""It does so in the breeze alone."""
BLOWS = "data.body('crate').xfrc_applied[0] = 1."
FAR = {"measured": 0.61, "margin": 0.33}
FORCE_X = 3
"""Entry of the force along x in an answer of the breeze: three of the joint come first."""


def boasting(touch: Touch) -> Touch:
    """The same, and the stamp says that the crate came 0.61 m far."""

    def told(value: Any) -> Any:
        for expectation in value["predicate"]["expectations"]:
            expectation |= FAR
        return value

    def boast(run: Path) -> None:
        touch(run)
        forging.resealed(run, told)

    return boast


def changed_text(old: bytes, new: bytes) -> Touch:
    """The text of the world's file is changed."""

    def touch(run: Path) -> None:
        path = run / "accepted" / "world.mjz"
        with zipfile.ZipFile(path) as archive:
            files = {name: archive.read(name) for name in archive.namelist()}
        assert old in files["model.xml"]
        files["model.xml"] = files["model.xml"].replace(old, new, 1)
        with zipfile.ZipFile(path, "w") as archive:
            for name, content in files.items():
                archive.writestr(name, content)
        facts(world_sha256=sha256_file(path))(run)

    return touch


def outside(run: Path) -> None:
    """The world takes a steep floor from a file outside of its archive."""
    (run.parent / "floor.xml").write_text(
        "<mujoco><worldbody><geom type='plane' size='0 0 1' quat='.985 0 .174 0' pos='0 0 .001'/></worldbody></mujoco>"
    )
    text = f'<include file="{run.parent / "floor.xml"}"/></mujoco>'
    changed_text(b"</mujoco>", text.encode())(run)


def facts(**changes: Any) -> Touch:
    """Facts of the program are changed."""

    def touch(run: Path) -> None:
        forging.edited(run / "accepted" / "world" / "program.json", lambda value: {**value, **changes})
        forging.resealed(run)

    return touch


def damaged(name: str, content: bytes) -> Touch:
    """A file beside the world is damaged."""

    def touch(run: Path) -> None:
        (run / "accepted" / "world" / name).write_bytes(content)
        forging.resealed(run)

    return touch


def opened(run: Path) -> None:
    """Everything may be written, and a gale is."""
    path = run / "accepted" / "world" / "inputs.json"
    path.write_text(
        json.dumps([{"kind": "force", "bodies": ["crate"]}, {"kind": "parameter", "bodies": ["opt.gravity"]}])
    )
    edited_rows("inputs", step=[0], entry=[FORCE_X], value=[10.1])(run)


def edited_rows(name: str, **columns: list[Any]) -> Touch:
    """The recorded inputs become these rows."""

    def touch(run: Path) -> None:
        forging.table(run / "accepted" / "world" / f"{name}.arrows", name, **columns)
        forging.resealed(run)

    return touch


def without_inputs(run: Path) -> None:
    """The recorded inputs are taken away, so that nothing drives the world."""
    for path in (run / "accepted" / "world").glob("*.arrows"):
        path.unlink()
    forging.resealed(run)


def another_kind(run: Path) -> None:
    """The stamp says that more was proved than was."""

    def told(value: Any) -> Any:
        value["predicate"]["proof"]["channels"] = dict.fromkeys(("motion", "inputs", "pictures", "medium"), "exact")
        return value

    forging.resealed(run, told)


def calm(run: Path) -> None:
    """The program that is kept sends nothing; the stream, the motion and every picture are those of the breeze."""
    _blows(run, "= 0.")
    forging.resealed(run, key="stranger")


def lull(run: Path) -> None:
    """The program that is kept sends a little less, and the stamp is said to be of another machine, whose motion may differ."""
    _blows(run, "= .8")
    forging.resealed(run, another_processor, key="stranger")


def _blows(run: Path, force: str) -> None:
    """The program that is kept sends another force."""
    path = run / "accepted" / "simulation.py"
    text = path.read_text(encoding="utf-8")
    assert BLOWS in text
    path.write_text(text.replace(BLOWS, BLOWS.replace("= 1.", force)), encoding="utf-8")


def another_processor(value: Any) -> Any:
    """The stamp names a processor that is not this one."""
    value["predicate"]["cpu"] = "another processor"
    return value


def bundle(name: str, does: str, touch: Touch, refused_by: str, **more: Any) -> Trick:
    more = {"plan": TRUE, **more}
    return Trick(name, "bundle", does, touch={"accepted": touch}, anybody=True, refused_by=refused_by, **more)


def driven(name: str, does: str, touch: Touch, refused_by: str) -> Trick:
    return bundle(name, does, touch, refused_by, plan=BREEZE, control=BLOWS)


TRICKS = (
    bundle(
        "world_includes_a_file_outside",
        "The world's file includes a steep floor that lies beside the run.",
        boasting(outside),
        "run",
    ),
    bundle(
        "world_with_another_gravity",
        "The world's file has half the gravity, and everything that knew its hash is told.",
        boasting(changed_text(b"<option ", b'<option gravity="0 0 -4.71" ')),
        "acts",
    ),
    bundle("facts_drawn_only", "The facts say that the crate is only drawn.", facts(visual_only=["crate"]), "facts"),
    bundle("facts_longer", "The facts say that the world runs for ten seconds.", facts(duration=10.0), "facts"),
    bundle("facts_nobody_moves", "The facts say that nothing should move.", facts(movers=[]), "facts"),
    bundle(
        "facts_no_number", "The facts say that the world runs for no number.", facts(duration=float("nan")), "facts"
    ),
    bundle("facts_cut_off", "The facts are cut off.", damaged("program.json", b'{"duration": 1.0, "fps"'), "facts"),
    bundle(
        "inputs_opened",
        "The inputs that may be written are more than the plan's, and a gale is recorded.",
        opened,
        "facts",
    ),
    bundle("inputs_no_list", "The list of inputs is no list.", damaged("inputs.json", b"NaN"), "facts"),
    bundle(
        "gravity_edited_by_row",
        "An edit of gravity is recorded in a world that takes no input.",
        edited_rows("edits", step=[0], array=["opt.gravity"], index=[2], value=[-4.7]),
        "run",
    ),
    bundle(
        "entry_from_the_end",
        "A recorded input has an entry that counts from the end.",
        edited_rows("inputs", step=[0], entry=[-1], value=[10.1]),
        "run",
    ),
    driven(
        "breeze_becomes_a_gale",
        "The recorded breeze is ten times as strong.",
        edited_rows("inputs", step=[0], entry=[FORCE_X], value=[10.1]),
        "trajectory",
    ),
    driven(
        "breeze_edits_gravity",
        "Beside the breeze, an edit of gravity is recorded.",
        edited_rows("edits", step=[0], array=["opt.gravity"], index=[2], value=[-4.7]),
        "run",
    ),
    driven(
        "breeze_is_never_due",
        "The breeze is recorded for steps that never come, before those that do.",
        edited_rows("inputs", step=[1 << 20, 0], entry=[FORCE_X, FORCE_X], value=[1.0, 10.1]),
        "run",
    ),
    driven(
        "breeze_of_no_number",
        "The recorded breeze is no number.",
        edited_rows("inputs", step=[0], entry=[FORCE_X], value=[float("nan")]),
        "run",
    ),
    driven("breeze_taken_away", "The recorded breeze is taken away.", without_inputs, "trajectory"),
    driven(
        "breeze_cut_off", "The recorded breeze is cut off.", damaged("inputs.arrows", b"\xff\xff\xff\xff\x10"), "run"
    ),
    bundle(
        "stream_that_the_program_would_not_send",
        "The recorded breeze is as declared; the program that is kept would send none, and the crate would stop short.",
        calm,
        "law",
        plan=FARTHER,
        control=BLOWS,
    ),
    bundle(
        "stream_of_a_false_processor",
        "As that, with a program that would stop the crate 2 mm short, and a stamp that says it is of another processor.",
        lull,
        "law",
        plan=FARTHER,
        control=BLOWS,
    ),
    bundle("kinds_of_proof", "The stamp says that a medium was proved exactly, too.", another_kind, "kinds"),
)
