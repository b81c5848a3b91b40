"""What an accepted folder says of its proof: forged inputs or kinds of proof, sealed anew, are refused by name."""

import dataclasses
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mujoco
import pyarrow as pa
import pytest

from small_worlds import heap, record
from worldengine.recording.columns import TABLES, arrow_schema
from worldwright.gallery.worlds import EXAMPLES
from worldwright.model.evidence.reports import LintReport, PassResult
from worldwright.model.evidence.run import Run
from worldwright.stamp import bundle, exactness, verification
from worldwright.stamp import tools as stamp
from worldwright.stamp.kept import Kept
from worldwright.stamp.proof import Proved
from worldwright.stamp.statement import Statement
from worldwright.stamp.verification import static

Copy = Callable[[Path], Path]


def table(path: Path, name: str, **columns: list[Any]) -> None:
    """Write one of a recording's tables; columns that are left out are zero."""
    schema = arrow_schema(TABLES[name])
    rows = len(next(iter(columns.values())))
    arrays = [pa.array(columns.get(f.name, [0] * rows), f.type) for f in schema]
    with pa.OSFile(str(path), "wb") as sink, pa.ipc.new_stream(sink, schema) as writer:
        writer.write_batch(pa.RecordBatch.from_arrays(arrays, schema=schema))


def sealed(run: Path) -> None:
    """Seal the accepted folder again as it stands, with nobody's signature."""
    folder = run / "accepted"
    for name in ("stamp.dsse.json", "stamp.pub"):
        (folder / name).unlink(missing_ok=True)
    statement = Statement.model_validate_json((folder / bundle.STAMP).read_bytes())
    bundle.seal(folder, statement.model_copy(update={"subject": bundle.subjects(folder)}))
    (run / "journal.jsonl").unlink()


@pytest.mark.parametrize(
    ("name", "columns", "says"),
    [
        ("inputs", {"step": [0], "entry": [-5], "value": [1.0]}, "row 0 (step 0): its entry is none of"),
        ("inputs", {"step": [1 << 30], "entry": [0], "value": [1.0]}, "row 0 (step 1073741824): its step is none of"),
        ("edits", {"array": ["opt.gravity"], "index": [2], "value": [-1.0]}, "no declared parameter: opt.gravity"),
    ],
)
def test_a_forged_stream_is_refused_by_file_row_and_cause(
    accepted: Path, copy: Copy, name: str, columns: dict[str, list[Any]], says: str
) -> None:
    run = copy(accepted)
    table(run / "accepted" / bundle.WORLD / f"{name}.arrows", name, **columns)
    sealed(run)
    found = stamp.verify(str(run), anybody=True)
    assert not found.ok and found.state == "refuted"
    (failed,) = [c for c in found.checks if not c.ok]
    assert failed.name == "run" and says in failed.detail and f"{name}.arrows" in failed.detail


def test_the_stamp_says_of_which_kind_each_proof_is(accepted: Path) -> None:
    stamped = Statement.model_validate_json((accepted / "accepted" / bundle.STAMP).read_bytes())
    assert stamped.predicate_type == "urn:worldwright:acceptance:v2"
    assert stamped.predicate.proof.channels == {"motion": "exact", "pictures": "tolerance"}
    assert stamped.predicate.proof.marks == ()
    (recording,) = (accepted / "evidence").glob("*/physics/trajectory")
    again = {"trajectory_sha256": stamped.predicate.proof.trajectory_sha256}
    proved = Proved(Run(accepted), PassResult(stage="physics", ok=True, summary=again), LintReport(), recording)
    (said,) = verification._kinds(stamped, proved, asked=False)
    assert said.ok and said.detail == "motion exact, pictures tolerance"
    elsewhere = dataclasses.replace(proved, physics=PassResult(stage="physics", ok=True))
    (said,) = verification._kinds(stamped, elsewhere, asked=False)
    assert said.ok and said.detail == "motion tolerance, pictures tolerance"
    for lie in ({"channels": {"motion": "exact", "pictures": "exact"}}, {"marks": ("it was signed twice",)}):
        proof = stamped.predicate.proof.model_copy(update=lie)
        forged = stamped.model_copy(update={"predicate": stamped.predicate.model_copy(update={"proof": proof})})
        (said,) = verification._kinds(forged, proved, asked=False)
        assert not said.ok and "another kind of proof than there is: motion exact" in said.detail


def test_worlds_that_sleep_or_search_their_contacts_are_marked(tmp_path: Path) -> None:
    def proved(name: str, flags: int, control: Any = None) -> Proved:
        spec = heap(4, integrator="DISCRETE")
        spec.option.enableflags |= flags
        record(spec, tmp_path / name, 3, control)
        return Proved(Run(tmp_path), PassResult(stage="physics", ok=True), LintReport(), tmp_path / name)

    def push(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        data.xfrc_applied[1, 2] = 1.0

    sleep, ipc = int(mujoco.mjtEnableBit.mjENBL_SLEEP), int(mujoco.mjtEnableBit.mjENBL_IPC)
    assert exactness.marks(proved("plain", 0)) == ()
    assert exactness.marks(proved("sleeps", sleep)) == ("sleep",)
    assert exactness.marks(proved("ipc", ipc)) == ("ipc",)
    assert exactness.channels(proved("quiet", 0), ()) == {"motion": "exact"}
    pushed = exactness.channels(proved("pushed", 0, push), ())
    assert pushed == {"motion": "exact", "inputs": "law re-run"}
    assert exactness.told(pushed, (), exact=True, asked=True) == "motion exact, inputs law re-run"
    assert exactness.told(pushed, (), exact=True, asked=False) == "motion exact, inputs as recorded"
    assert exactness.told(pushed, ("sleep",), exact=False, asked=True).startswith(
        "motion tolerance, inputs law re-run; bodies"
    )


def test_sentences_of_earlier_stamps_mean_the_same_however_they_are_worded_now() -> None:
    earlier = ("bodies may sleep: in other words", "barrier contact (ipc): so", "engine plugins: so", "signed twice")
    assert exactness.coded(earlier) == ("sleep", "ipc", "plugin", "signed twice")
    assert exactness.coded(exactness.LIMITS) == tuple(exactness.LIMITS)


def test_an_older_stamp_is_read_and_a_newer_one_is_refused_by_its_version(copy: Copy) -> None:
    example = EXAMPLES.resolve() / "box-slides-to-rest"
    kept = Kept.read(example / bundle.STAMP, Statement)
    assert kept.value is not None and kept.value.first and kept.value.predicate.proof.channels == {}
    assert all(c.ok for c in static(Run(example), example))
    folder = copy(example)
    path = folder / bundle.STAMP
    path.write_bytes(path.read_bytes().replace(b"acceptance:v1", b"acceptance:v9"))
    (said,) = static(Run(folder), folder)
    assert not said.ok and "predicateType" in said.detail and "acceptance:v2" in said.detail
