"""Acceptance and its proof: what is stamped can be proven again, and nothing else is ever stamped."""

import contextlib
import json
import os
import shutil
import signal
import stat
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

from worldwright.lint.compiled import fetch, planned
from worldwright.model import call_time
from worldwright.model.errors import CallOverError, GateError
from worldwright.model.evidence.journal import Journal
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.model.plan.committed import Plan
from worldwright.model.plan.plan_text import read_plan
from worldwright.stage import tools as stage
from worldwright.stamp import (
    acceptance,
    bundle,
    departures,
    digest,
    private,
    proof,
    redrawn,
    repeats,
    signing,
    taken,
    verification,
)
from worldwright.stamp import tools as stamp
from worldwright.stamp.proof import Proved
from worldwright.stamp.state import State
from worldwright.stamp.statement import Statement
from worldwright.stamp.strip import BEGIN, END, strip

Copy = Callable[[Path], Path]
Prepare = Callable[[Path], None]


def tree(folder: Path) -> dict[str, str]:
    return {name: sha256_file(folder / name) for name in bundle.files_in(folder)}


def test_the_accepted_folder_is_complete_and_checks_out(accepted: Path) -> None:
    folder = accepted / "accepted"
    assert {
        "SHA256SUMS", "stamp.json", "simulation.py", "plan.md", "prompt.md", "motion.json",
        "evidence/expect.json", "evidence/physics.json", "stills/overview.png", "video/side.mp4",
    } <= set(bundle.files_in(folder))  # fmt: skip
    statement = Statement.model_validate_json((folder / "stamp.json").read_bytes())
    assert statement.type == "https://in-toto.io/Statement/v1"
    assert json.loads((folder / "stamp.json").read_text())["predicateType"].startswith("urn:worldwright:")
    assert statement.digest_of("plan.md") == sha256_file(accepted / "plan.md")
    assert statement.predicate.proof.sandbox
    assert [o.status for o in statement.predicate.objectives] == ["proved", "visual_only"]
    assert bundle.damage(folder, statement) == []
    command = ["sha256sum", "--check", "--quiet", "SHA256SUMS"]
    check = subprocess.run(command, cwd=folder, capture_output=True, check=False)
    assert check.returncode == 0, check.stdout
    assert stamp.status(str(accepted)).state == "accepted"
    assert not list(accepted.glob(f"{bundle.PREFIX}*"))
    assert not (accepted / "proof").exists()


def test_accepting_twice_answers_from_the_stamp(accepted: Path) -> None:
    before = tree(accepted / "accepted")
    again = stamp.accept(str(accepted))
    assert (again.ok, again.already) == (True, True)
    assert tree(accepted / "accepted") == before


def test_verify_proves_it_again_and_touches_nothing(accepted: Path) -> None:
    before = tree(accepted)
    result = stamp.verify(str(accepted), timeout_s=60)
    assert result.ok, result.text()
    assert (result.state, result.mode) == ("proved", "bitwise")
    assert tree(accepted) == before


def test_a_verification_works_outside_of_the_run_where_nobody_else_may_look(accepted: Path) -> None:
    """So nobody can plant there what it would find."""
    folder = accepted / "accepted"
    scratch = verification._scratch(folder, "0" * 64, verification._here(folder), False)
    assert not scratch.resolve().is_relative_to(accepted.resolve())
    assert stat.S_IMODE(scratch.stat().st_mode) == 0o700


def test_verify_works_in_a_fresh_clone(accepted: Path, tmp_path: Path) -> None:
    """Only what version control keeps: no evidence, no jobs, a read-only accepted folder, found by its own path."""
    clone = tmp_path / "clone"
    shutil.copytree(accepted / "accepted", clone / "accepted")
    for path in (clone / "accepted").rglob("*"):
        path.chmod(0o555 if path.is_dir() else 0o444)
    (clone / "accepted").chmod(0o555)
    for name in (clone / "accepted", clone):
        result = stamp.verify(str(name), timeout_s=60)
        assert result.ok, result.text()
    (clone / "accepted").chmod(0o755)


@pytest.mark.parametrize(
    "name",
    [
        "simulation.py",
        "plan.md",
        "prompt.md",
        "stamp.json",
        "motion.json",
        "video/side.mp4",
        "trajectory.npz",
        "world.mjz",
        "SHA256SUMS",
        "evidence/expect.json",
    ],
)
def test_one_changed_byte_is_refused_without_running_anything(accepted: Path, copy: Copy, name: str) -> None:
    folder = copy(accepted)
    path = folder / "accepted" / name
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(bytes(data))
    result = stamp.verify(str(folder))
    assert (result.ok, result.state) == (False, "refuted")
    assert not any(check.name == "trajectory" for check in result.checks)
    assert stamp.status(str(folder)).state == "open"


def test_a_file_smuggled_in_is_refused(accepted: Path, copy: Copy) -> None:
    folder = copy(accepted)
    (folder / "accepted" / "extra.txt").write_text("hello")
    assert "extra.txt is not in the stamp" in stamp.verify(str(folder)).text()


def test_another_program_under_a_resealed_stamp_is_refuted_by_its_run(accepted: Path, copy: Copy) -> None:
    """Somebody who can rewrite every hash still cannot make another program move the same way."""
    folder = copy(accepted)
    inner = folder / "accepted"
    program = (inner / "simulation.py").read_text(encoding="utf-8")
    moved = program.replace("pos=(0.0, 0.0, 0.5)", "pos=(0.0, 0.0, 0.4999)")
    assert moved != program
    (inner / "simulation.py").write_text(moved, encoding="utf-8")
    statement = Statement.model_validate_json((inner / "stamp.json").read_bytes())
    bundle.seal(inner, statement.model_copy(update={"subject": bundle.subjects(inner)}))
    for signature in ("stamp.dsse.json", "stamp.pub"):  # left standing, it refutes the folder before the run
        (inner / signature).unlink()
    (folder / "journal.jsonl").unlink()
    result = stamp.verify(str(folder), timeout_s=60, rebuild=True)
    assert not result.ok
    failed = {check.name for check in result.checks if not check.ok}
    assert failed & {"trajectory", "run", "law"}, result.text()


def without_film(folder: Path) -> None:
    """Let the plan film nothing, which saves a pass."""
    plan = folder / "plan.md"
    plan.write_text(plan.read_text(encoding="utf-8").replace("mode: cameras", "mode: none"), encoding="utf-8")


def test_instrumentation_is_taken_out_of_what_is_accepted(planned: Path, copy: Copy, prepare: Prepare) -> None:
    folder = copy(planned)
    without_film(folder)
    program = folder / "simulation.py"
    source = program.read_text(encoding="utf-8")
    watched = source.replace(
        'if __name__ == "__main__":', f'{BEGIN}\nNOTE = "for the reviewer"\n{END}\n\n\nif __name__ == "__main__":'
    )
    program.write_text(watched, encoding="utf-8")
    prepare(folder)
    while (result := stamp.accept(str(folder), timeout_s=60)).state == "proving":
        pass  # a busy machine needs more than one call
    assert result.stripped_lines == 3
    kept = (folder / "accepted" / "simulation.py").read_text(encoding="utf-8")
    assert "instrumentation" not in kept
    assert kept.replace("\n", "") == source.replace("\n", "")
    assert program.read_text(encoding="utf-8") == watched
    assert stamp.status(str(folder)).state == "accepted"


def test_instrumentation_that_changes_the_motion_is_refused(planned: Path, copy: Copy, prepare: Prepare) -> None:
    folder = copy(planned)
    without_film(folder)
    program = folder / "simulation.py"
    source = program.read_text(encoding="utf-8")
    air = "medium: {density: 0, viscosity: 1, source: made up for a test}"
    plan = folder / "plan.md"
    plan.write_text(plan.read_text(encoding="utf-8").replace("inferred:", f"{air}\ninferred:", 1), encoding="utf-8")
    lines = ("spec.option.viscosity = 1", BEGIN, "spec.option.viscosity = 1.0009", END, "return spec")
    push = "\n".join(f"    {line}" for line in lines)
    pushed = source.replace("    return spec", push)
    program.write_text(pushed, encoding="utf-8")
    prepare(folder)
    with pytest.raises(GateError, match=r"another world .* opt\.viscosity differs by"):
        stamp.accept(str(folder), timeout_s=60)
    assert not (folder / "accepted").exists()


@pytest.mark.parametrize(
    "name",
    ["video/side.mp4", "stills/overview.png", "physics/trajectory/state.arrows", "physics/trajectory/contacts.arrows"],
)
def test_an_edited_byte_of_the_evidence_is_refused(reviewed: Path, copy: Copy, name: str) -> None:
    folder = copy(reviewed)
    path = Run(folder).evidence(stamp.status(str(folder)).key) / name
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(bytes(data))
    with pytest.raises(GateError) as caught:
        stamp.accept(str(folder))
    assert f"{name} is not what the {name.split('/')[0]} pass wrote" in caught.value.cause
    assert "again" in caught.value.next_move
    assert not (folder / "accepted").exists()


def rewritten(folder: Path, name: str, edit: Callable[[str], str]) -> None:
    """Change a report of the evidence, and let a whole new journal vouch for it, as one who writes the run folder can."""
    run = Run(folder)
    path = run.evidence(stamp.status(str(folder)).key) / name
    before, text = sha256_file(path), path.read_text()
    assert edit(text) != text
    path.write_text(edit(text))
    entries = [{k: v for k, v in e.items() if k != "chain"} for e in Journal(run.journal).entries()]
    run.journal.unlink()
    for entry in json.loads(json.dumps(entries).replace(before, sha256_file(path))):
        Journal(run.journal).append(entry)


@pytest.mark.parametrize("name", ["measured", "margin"])
def test_a_report_written_by_hand_is_measured_again(reviewed: Path, copy: Copy, name: str) -> None:
    folder = copy(reviewed)
    rewritten(folder, "expect.json", lambda text: text.replace(": ", ":").replace(f'"{name}":', f'"{name}":9', 1))
    with pytest.raises(GateError, match="in the proof run"):
        stamp.accept(str(folder), timeout_s=60)
    assert not (folder / "accepted").exists()


def test_facts_that_the_text_does_not_tell_are_refused_before_the_proof_run(
    reviewed: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(acceptance.world_facts, "differ", lambda *_: iter(["program.json says fps 5"]))
    monkeypatch.setattr(acceptance, "prove", lambda *_, **__: pytest.fail("it was run all the same"))
    with pytest.raises(GateError, match=r"otherwise than its text says: program\.json says fps"):
        stamp.accept(str(copy(reviewed)))


def test_a_world_simulated_for_another_time_is_refused(reviewed: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    state = State.find(str(reviewed))
    summary = {"final_time": 1.1 * float(state.plan.simulation_parameters.simulation_duration)}
    with pytest.raises(GateError, match="were simulated, the plan says"):
        repeats.whole(state, SimpleNamespace(physics=SimpleNamespace(summary=summary)))


def test_a_stamp_that_nobody_vouches_for_is_proved_anew(accepted: Path, copy: Copy) -> None:
    folder = copy(accepted)
    (folder / "accepted" / signing.ENVELOPE).unlink()
    again = stamp.accept(str(folder), timeout_s=60)
    assert again.ok and not again.already
    assert signing.check(folder / "accepted", bundle.STAMP).holder == "own"


def test_a_genuine_stamp_says_nothing_of_another_plan(accepted: Path, copy: Copy) -> None:
    folder = copy(accepted)
    (folder / "plan.md").write_text((folder / "plan.md").read_text() + "\n")
    (folder / "journal.jsonl").unlink()
    found = stamp.verify(str(folder), timeout_s=60)
    assert [c.name for c in found.checks if not c.ok] == ["beside"] and not found.ok


def test_an_undeclared_intervention_is_refused(planned: Path, copy: Copy, prepare: Prepare) -> None:
    folder = copy(planned)
    without_film(folder)
    program = folder / "simulation.py"
    source = program.read_text(encoding="utf-8")
    push = "def control(model: mujoco.MjModel, data: mujoco.MjData) -> None:\n    data.xfrc_applied[1, 2] = 0.01\n\n\n"
    source = source.replace('if __name__ == "__main__":', push + 'if __name__ == "__main__":')
    program.write_text(source.replace("program.main(build,", "program.main(build, control,"), encoding="utf-8")
    with contextlib.suppress(AssertionError, GateError):  # the linter or the scan may refuse it first
        prepare(folder)
    with pytest.raises(GateError):
        stamp.accept(str(folder), timeout_s=60)
    assert not (folder / "accepted").exists()


CRASHING = """
import os, sys
from worldwright.stamp import acceptance, redrawn, tools
run, assemble, seen = sys.argv[1], acceptance._assemble, 0
redrawn.glance = lambda *_, **__: ()  # how many pictures it draws is up to chance and time

def armed(*words):
    os.write(1, b"proved\\n")
    for line in sys.stdin:
        child = os.fork()
        if child == 0:
            watch(int(line))
            return assemble(*words)
        if os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 9:
            os.write(1, b"died\\n")
    os._exit(0)

def watch(at):
    def crash(event, _):
        global seen
        if event in ("open", "os.rename", "os.mkdir", "os.remove", "os.rmdir"):
            seen += 1
            if seen == at:
                os._exit(9)

    sys.addaudithook(crash)

acceptance._assemble = armed
try:
    told = [tools.accept(run, timeout_s=60)]
    while not told[-1].ok and len(told) < 5:
        told.append(tools.accept(run, timeout_s=60))
    done = str(seen) if told[-1].ok else repr(told[-1].text())
except Exception as error:
    done = repr(error)
os.write(1, done.encode() + b"\\n")
os._exit(0)
"""
"""Accepts until the world is proved. From there, for each number N that it is told, a process of its own goes on, and dies at
its N-th file operation."""


def test_a_crash_at_any_file_operation_leaves_nothing_or_everything(reviewed: Path, copy: Copy, tmp_path: Path) -> None:
    folder = copy(reviewed)
    call = [sys.executable, "-c", CRASHING, str(folder)]
    # A proof belongs to a folder's path: at the same path, each crash finds the one that was made first.
    state = State.find(str(folder))
    assert state.key is not None
    proof, before = private.proofs(Run(folder), state.key.key), tmp_path / "before"

    def again() -> None:
        for kept, path in ((before / "run", folder), (before / "proof", proof)):
            shutil.rmtree(path, ignore_errors=True)
            shutil.copytree(kept, path)

    with subprocess.Popen(call, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdin and process.stdout

        def crash_at(step: int) -> str:
            process.stdin.write(f"{step}\n")
            process.stdin.flush()
            return process.stdout.readline().strip()

        assert process.stdout.readline().strip() == "proved"
        shutil.copytree(folder, before / "run")
        shutil.copytree(proof, before / "proof")
        total = int(crash_at(0))
        assert total > 40 and (folder / "accepted").exists()
        endings = set()
        for step in sorted({*range(2, total, total // 5), *range(total - 8, total + 1)}):
            again()
            assert crash_at(step) == "died"
            status = stamp.status(str(folder))
            assert status.state == ("accepted" if (folder / "accepted").exists() else "open"), status.text()
            endings.add(status.state)
            assert stamp.accept(str(folder), timeout_s=60).ok
            assert not list(folder.glob(f"{bundle.PREFIX}*"))
            checks = {c.name: c.ok for c in verification.static(Run(folder), folder / "accepted")}
            assert checks == {"checksums": True, "journal": True, "signature": True}
        process.stdin.close()
    assert endings == {"open", "accepted"}


def test_kill_at_a_random_moment_loses_nothing(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    call = f"from worldwright.stamp import tools; tools.accept({str(folder)!r}, timeout_s=60)"
    for delay in (0.4, 0.8):
        process = subprocess.Popen([sys.executable, "-c", call], start_new_session=True, stderr=subprocess.DEVNULL)
        time.sleep(delay)
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        assert stamp.status(str(folder)).state == ("accepted" if (folder / "accepted").exists() else "open")
    assert stamp.accept(str(folder), timeout_s=60).ok
    assert stamp.verify(str(folder), timeout_s=60).ok


def test_two_processes_accept_at_once_and_one_world_results(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    with bundle.only_one(Run(folder)), pytest.raises(GateError, match="another process"):
        stamp.accept(str(folder))
    call = f"from worldwright.stamp import tools; tools.accept({str(folder)!r}, timeout_s=60)"
    both = [subprocess.Popen([sys.executable, "-c", call], stderr=subprocess.PIPE) for _ in range(2)]
    assert 0 in [process.wait() for process in both]
    for process in both:
        process.communicate()
    assert stamp.verify(str(folder), timeout_s=60).ok


def test_a_proof_that_needs_longer_goes_on_by_itself(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    first = stamp.accept(str(folder), timeout_s=0.01)
    assert (first.ok, first.state) == (False, "proving")
    assert "about " in first.under_way and first.under_way in first.text()
    assert not (folder / "accepted").exists()
    assert stamp.accept(str(folder), timeout_s=60).ok


@pytest.mark.parametrize("kind", ["symlink_to", "hardlink_to"])
@pytest.mark.parametrize("name", ["stills/overview.png", "expect.json"])
def test_what_is_no_plain_file_is_not_published(reviewed: Path, copy: Copy, name: str, kind: str) -> None:
    """Its bytes are as they were, so that no hash tells; but it leads out of the run, to a file of the host."""
    run = copy(reviewed)
    path = next((run / "evidence").glob(f"*/{name}"))
    elsewhere = run.parent / "of-the-host"
    path.rename(elsewhere)
    getattr(path, kind)(elsewhere)
    with pytest.raises(GateError, match=r"is no plain file of at most 4 GB"):
        stamp.accept(str(run), timeout_s=60)
    assert not (run / "accepted").exists() and elsewhere.is_file()


def test_another_machine_is_compared_within_a_tolerance(accepted: Path, copy: Copy) -> None:
    """The same world stamped on a machine whose last bits differ: proved by tolerance, and what differs is named."""
    folder = copy(accepted)
    inner = folder / "accepted"
    statement = Statement.model_validate_json((inner / "stamp.json").read_bytes())
    predicate = statement.predicate
    elsewhere = predicate.model_copy(
        update={
            "cpu": "some other processor",
            "proof": predicate.proof.model_copy(update={"trajectory_sha256": "0" * 64}),
        }
    )
    bundle.seal(inner, statement.model_copy(update={"predicate": elsewhere}))
    for other in (inner / "stamp.dsse.json", inner / "stamp.pub", folder / "journal.jsonl"):  # they know this machine's
        other.unlink()
    result = stamp.verify(str(folder), timeout_s=60, anybody=True)
    assert result.ok, result.text()
    assert result.mode == "tolerance" and [c.name for c in result.checks[-2:]] == ["pictures", "words of nobody"]
    assert any("some other processor" in text for text in result.environment_differences)

    motion = digest.Motion.model_validate_json((inner / "motion.json").read_bytes())
    moved = motion.model_dump(mode="json")
    moved["position"][-1][0][0] += 0.05
    (inner / "motion.json").write_text(json.dumps(moved), encoding="utf-8")
    bundle.seal(inner, statement.model_copy(update={"predicate": elsewhere, "subject": bundle.subjects(inner)}))
    result = stamp.verify(str(folder), timeout_s=60, anybody=True)
    assert not result.ok
    assert "outside the tolerance" in result.text()
    assert "ball at 0.500 s" in result.text()
    assert "pictures" not in {check.name for check in result.checks}  # nothing is drawn of what is refuted already


def test_the_file_that_was_simulated_acts_as_its_plan_says(accepted: Path) -> None:
    """A heavier or a more slippery world than the planned one is no planned world, whatever lint once saw of its program."""
    world, plan = accepted / "accepted" / "world.mjz", read_plan(accepted / "accepted" / "plan.md").plan
    assert departures.from_plan(world, plan) == []
    other = plan.model_dump(mode="json")
    other["simulation_parameters"]["masses"] = dict.fromkeys(other["simulation_parameters"]["masses"], 2.5)
    told = departures.from_plan(world, Plan.model_validate(other))
    assert told and "2.5" in told[0]
    assert "acts: every pair" in stamp.verify(str(accepted), timeout_s=60).text()


def test_the_end_of_a_call_tells_nothing_of_a_world_or_its_pictures(
    accepted: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Neither is another world than planned, nor a picture of another one: there was no time to look."""
    run = Run(copy(accepted))
    inside, state = run.accepted, State(run)
    statement = Statement.model_validate_json((inside / "stamp.json").read_bytes())
    proved = Proved(run, state.passes["physics"].value, state.lint.value, state.folder / "physics" / "trajectory")
    for module in (fetch, planned):
        monkeypatch.setattr(module, "_KEPT", {})
    with call_time.limited(0.0):
        for look in (
            lambda: departures.from_plan(inside / "world.mjz", state.plan),
            lambda: list(redrawn.differ(inside, statement, proved)),
            lambda: stage.try_film(run.folder),
        ):
            with pytest.raises(CallOverError, match="that a call may take"):
                look()


def test_an_acceptance_waits_no_longer_than_its_call_lasts(reviewed: Path, copy: Copy) -> None:
    with call_time.limited(call_time.SPARE_S):
        assert stamp.accept(str(copy(reviewed)), timeout_s=1e6).state == "proving"


def test_the_facts_of_a_world_are_held_against_the_accepted_plan(reviewed: Path, copy: Copy) -> None:
    """Somebody edits the run's plan while it is being accepted."""
    state = State(Run(copy(reviewed)))
    stripped = strip((state.program_bytes or b"").decode())
    assert state.plan_bytes
    state.run.plan.write_text("half written")
    acceptance._factual(state, stripped, state.folder / "physics")


def edited_by(monkeypatch: pytest.MonkeyPatch, owner: object, name: str, edit: Callable[[], object]) -> None:
    """Somebody edits right after that step of an acceptance."""
    step = getattr(owner, name)

    def after(*args: object, **named: object) -> object:
        done = step(*args, **named)
        edit()
        return done

    monkeypatch.setattr(owner, name, after)


def test_what_is_published_is_what_was_proved(reviewed: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch) -> None:
    """A helper, a film and the prompt are edited while the proof runs."""
    run = Run(copy(reviewed))
    helper, asked = run.folder / "shapes.py", run.prompt.read_bytes()
    helper.write_text("# a shape")
    read = proof.beside
    monkeypatch.setattr(taken, "beside", lambda folder: {**read(folder), "shapes.py": helper.read_bytes()})

    def edit() -> None:
        helper.write_text("# half a shape")
        (run.folder / "film.py").write_text("# half a film")
        run.prompt.write_text("something else")

    edited_by(monkeypatch, acceptance, "prove", edit)
    assert stamp.accept(str(run.folder), timeout_s=400).ok
    inner = run.accepted
    assert (inner / "shapes.py").read_text() == "# a shape" and not (inner / "film.py").exists()
    assert (inner / "prompt.md").read_bytes() == asked
    predicate = Statement.model_validate_json((inner / "stamp.json").read_bytes()).predicate
    assert predicate.film is None and "film.py" not in predicate.source.materials
    assert predicate.source.materials["prompt.md"].sha256 == sha256_file(inner / "prompt.md")


def test_what_changes_while_the_gates_look_is_refused(
    reviewed: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = Run(copy(reviewed))
    edited_by(monkeypatch, acceptance.gates, "pass_through", lambda: (run.folder / "film.py").write_text("# a film"))
    with pytest.raises(GateError, match=r"film.py changed while the run was being accepted"):
        stamp.accept(str(run.folder), timeout_s=60)
    assert not run.accepted.exists()
