"""What was accepted before is kept, compared with what stands, and brought back whole; nothing that it replaces is lost."""

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner

from worldkit.files import write_atomic
from worldwright import accepted_versions
from worldwright.model.errors import GateError, NotFoundError
from worldwright.model.evidence.run import Run
from worldwright.stamp import bundle, keyring, scope, signing, small_form, versions
from worldwright.stamp.state import State
from worldwright.stamp.statement import Statement
from worldwright.stamp.steps import steps

Copy = Callable[[Path], Path]


def accepted_anew(run: Run, helper: str = "") -> str:
    """Accept another program and plan in place of what stands, as far as files go; returns the name of the version before.

    With `helper` the program imports a module of that name, whose file lies beside it.
    """
    before = versions.known(run)[-1]
    run.plan.write_text(run.plan.read_text() + "\nRevised.\n")
    run.program.write_text((f"import {helper}\n" if helper else "# revised\n") + run.program.read_text())
    run.log("code", "lint", ok=True)
    run.log("user", "approve")
    draft = bundle.draft_folder(run)
    shutil.copytree(run.accepted, draft, dirs_exist_ok=True)
    for path in (run.plan, run.program, *run.folder.glob(f"{helper}.py")):
        write_atomic(draft / path.name, path.read_bytes())
    (draft / "stills").rename(draft / "video" / "old")
    said, state = before.statement, State(run)
    assert state.key
    source = said.predicate.source.model_copy(
        update={"key": state.key.key, "program_sha256": state.program_sha256, "plan_sha256": state.plan_sha256}
    )
    worse = [o.model_copy(update={"status": "refuted"} if o.index == 0 else {}) for o in said.predicate.objectives]
    measured = [
        row.model_copy(update={"measured": 2 * (row.measured or 0) + 1}) if n == 0 else row
        for n, row in enumerate(said.predicate.expectations)
    ]
    told = {
        "source": source,
        "objectives": tuple(worse),
        "expectations": tuple(measured),
        "accepted_at": "2126-01-01T00:00:00+00:00",
    }
    for name in bundle.UNLISTED:
        (draft / name).unlink()
    predicate = said.predicate.model_copy(update=told)
    statement = Statement(subject=bundle.subjects(draft), predicate=predicate)
    stamp_sha256 = bundle.seal(draft, statement)
    signing.sign(draft, bundle.STAMP, keyring.own())
    bundle.publish(draft, run.accepted, versions.aside(run))
    run.log("stamp", "accept", key=state.key.key, stamp_sha256=stamp_sha256)
    return before.name


def test_two_versions_are_compared_and_the_older_comes_back(accepted: Path, copy: Copy) -> None:
    run = Run(copy(accepted))
    first = (run.plan.read_bytes(), run.program.read_bytes())
    name = accepted_anew(run)
    assert steps(State(run))["accept"].holds
    older, standing = versions.known(run)
    assert older.name == name and older.folder.parent.name == "earlier" and standing.folder == run.accepted
    told = CliRunner().invoke(accepted_versions.command, [str(run.folder), name])
    assert told.exit_code == 0, told.output
    for word in ("plan.md is another one", "proved, now refuted", "measures", "bit for bit", "stills/"):
        assert word in told.output, (word, told.output)
    back = CliRunner().invoke(accepted_versions.command, [str(run.folder), "--restore", name])
    assert back.exit_code == 0, back.output
    state = State(run)
    assert (run.plan.read_bytes(), run.program.read_bytes()) == first
    assert steps(state)["accept"].holds and steps(state)["approve"].holds and not list(scope.refusals(state))
    assert [v.name for v in versions.known(run)] == [standing.name, name]
    assert not list(run.folder.glob("earlier/replaced-*")), "it was accepted as it stood"


def test_what_is_not_accepted_yet_is_kept_when_a_version_comes_back(accepted: Path, copy: Copy) -> None:
    run = Run(copy(accepted))
    (standing,) = versions.known(run)
    run.program.write_text("# half done\n")
    (run.folder / "film.py").write_text("# a film\n")
    versions.restore(run, standing.name[:6])
    assert steps(State(run))["accept"].holds and not (run.folder / "film.py").exists()
    (kept,) = run.folder.glob("earlier/replaced-*")
    assert (kept / "simulation.py").read_text() == "# half done\n" and (kept / "film.py").is_file()


def test_a_version_that_was_changed_does_not_come_back(accepted: Path, copy: Copy) -> None:
    run = Run(copy(accepted))
    name = accepted_anew(run)
    (run.folder / "earlier" / name / "plan.md").write_text("another plan")
    with pytest.raises(GateError, match="not as it was stamped"):
        versions.restore(run, name)
    with pytest.raises(NotFoundError):
        versions.find(run, "nothing")


def test_what_stood_and_is_not_whole_is_kept_beside_the_versions(accepted: Path, copy: Copy) -> None:
    """An edit of an accepted file may be somebody's work: it goes aside under another name, as a version it does not count."""
    run = Run(copy(accepted))
    plan = run.accepted / "plan.md"
    plan.write_text(plan.read_text() + "\nBy hand.\n")
    name = accepted_anew(run)
    (kept,) = run.folder.glob("earlier/*")
    assert kept.name.startswith("damaged-") and (kept / "plan.md").read_text().endswith("By hand.\n")
    assert name not in {version.name for version in versions.known(run)} and len(versions.known(run)) == 1
    with pytest.raises(NotFoundError):
        versions.restore(run, name)


def test_of_a_small_form_what_another_version_replaces_is_kept(accepted: Path, copy: Copy, tmp_path: Path) -> None:
    """Its files lie in the run folder itself, and nowhere else."""
    run = Run(copy(accepted))
    name = accepted_anew(run)
    small = Run(tmp_path / "small")
    small_form.write(run, small.folder)
    shutil.copytree(run.folder / "earlier", small.folder / "earlier")
    before = {path.name: path.read_bytes() for path in (small.plan, small.program)}
    versions.restore(small, name)
    (kept,) = small.folder.glob("earlier/replaced-*")
    assert small.plan.read_bytes() != before["plan.md"]
    assert {found: (kept / found).read_bytes() for found in before} == before


def test_the_prompt_comes_back_with_its_version(accepted: Path, copy: Copy) -> None:
    run = Run(copy(accepted))
    (standing,) = versions.known(run)
    first = run.prompt.read_bytes()
    run.prompt.write_text("Drop two balls.\n")
    versions.restore(run, standing.name)
    (kept,) = run.folder.glob("earlier/replaced-*")
    assert run.prompt.read_bytes() == first and (kept / "prompt.md").read_text() == "Drop two balls.\n"


def test_a_helper_module_edited_since_acceptance_and_the_reason_of_a_block_are_kept(accepted: Path, copy: Copy) -> None:
    run = Run(copy(accepted))
    (run.folder / "shapes.py").write_text("# a shape\n")
    older = accepted_anew(run, "shapes")
    (run.folder / "shapes.py").write_text("# half a shape\n")
    run.blocked.write_text("{}")
    versions.restore(run, older)
    (kept,) = run.folder.glob("earlier/replaced-*")
    assert (kept / "shapes.py").read_text() == "# half a shape\n" and (kept / run.blocked.name).read_text() == "{}"
    assert not (run.folder / "shapes.py").exists() and not run.blocked.exists()


def test_a_version_that_was_never_accepted_here_or_whose_signature_is_broken_does_not_come_back(
    accepted: Path, copy: Copy
) -> None:
    run = Run(copy(accepted))
    (standing,) = versions.known(run)
    lines = run.journal.read_text().splitlines(keepends=True)
    run.journal.write_text("".join(line for line in lines if '"accept"' not in line))
    with pytest.raises(GateError, match="was not accepted in this run"):
        versions.restore(run, standing.name)
    run.journal.write_text("".join(lines))
    (run.accepted / signing.ENVELOPE).write_text("{}")
    with pytest.raises(GateError, match="signature that does not hold"):
        versions.restore(run, standing.name)


def test_a_version_that_nobody_known_signed_comes_back_only_when_anybody_may_have(accepted: Path, copy: Copy) -> None:
    """A journal has no secret: a line for a stamp can be added by whoever lays the stamp there."""
    run = Run(copy(accepted))
    name = accepted_anew(run)
    for signed in (signing.ENVELOPE, signing.PUBLIC):
        (run.folder / "earlier" / name / signed).unlink(missing_ok=True)
    before = run.plan.read_bytes()
    refused = CliRunner().invoke(accepted_versions.command, [str(run.folder), "--restore", name])
    assert refused.exit_code == 2 and run.plan.read_bytes() == before
    assert "is UNSIGNED" in refused.output and f"--restore {name} --anybody" in refused.output
    back = CliRunner().invoke(accepted_versions.command, [str(run.folder), "--restore", name, "--anybody"])
    assert back.exit_code == 0 and run.plan.read_bytes() != before
