"""Rules of the observed run: their cases are run under watch, and what plain programs do is seen in the sandbox too."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from worldwright.lint import engine, tools
from worldwright.lint.observed import observing
from worldwright.lint.observed.run_view import Run
from worldwright.stage import sandbox

INSIDE = Path(observing.__file__).parent / "inside"
FORKED = """
import json, os, signal, sys, tempfile
from pathlib import Path
sys.path.insert(0, sys.argv[1])
os.environ['WORLDWRIGHT_OBSERVED_DEBUG'] = '1'
import mujoco, numpy, threading, concurrent.futures
from mujoco import batch
from mujoco.introspect import structs
import watching, engine, lifecycle, made_worlds, makers, owners, packages
folder, found = Path(sys.argv[2]), {}
for name, text in json.load(open(folder / 'cases.json')).items():
    out = folder / name
    out.mkdir()
    (out / 'case.py').write_text(text)
    child = os.fork()
    if child == 0:
        signal.alarm(120)
        os.dup2(os.open(out / 'log', os.O_CREAT | os.O_WRONLY), 2)
        sys.stdout = open(os.devnull, 'w')
        watching.main(str(out / 'case.py'), out, True)
        os._exit(0)
    os.waitpid(child, 0)
"""
SANDBOX = pytest.mark.skipif(sandbox.level() not in sandbox.CONFINING, reason="no level confines here")


def cases():
    for rule in engine.run_rules():
        for kind in ("GOOD", "BAD"):
            for index, text in enumerate(getattr(rule, kind)):
                yield f"{rule.code}-{kind}-{index}", rule, kind, text


@pytest.fixture(scope="module")
def seen(tmp_path_factory):
    """What was seen in each case; each runs in a process of its own."""
    folder = tmp_path_factory.mktemp("cases")
    (folder / "cases.json").write_text(json.dumps({name: text for name, _, _, text in cases()}))
    call = [sys.executable, "-s", "-W", "ignore", "-c", FORKED, str(INSIDE), str(folder)]
    subprocess.run(call, check=True, timeout=900, capture_output=True)
    return folder


def observation(folder):
    """A case's folder as the host would read it."""
    events = (folder / "events.jsonl").read_bytes() if (folder / "events.jsonl").exists() else b""
    end = json.loads((folder / "end.json").read_text()) if (folder / "end.json").exists() else None
    status = "died" if end is None else "failed" if "failure" in end else "ended"
    end = end or {}
    return observing.Observation(
        status,
        tuple(observing._events(events)),
        end.get("failure", "Segmentation fault" if status == "died" else ""),
        end.get("message", ""),
        tuple(end.get("lines", ())),
    )


@pytest.mark.parametrize(("name", "rule", "kind", "text"), [pytest.param(*c, id=c[0]) for c in cases()])
def test_cases(seen, name, rule, kind, text):
    observed = observation(seen / name)
    if observing.NO_PICTURES.search(observed.message):
        pytest.skip("no pictures on this machine")
    assert "Traceback" not in (seen / name / "log").read_text() or observed.status == "died"
    run = Run(observed, text.count("\n") + 1)
    found = list(rule.check(run))
    assert bool(found) == (kind == "BAD"), observed
    for problem in found:
        assert problem.message and not problem.message.endswith(".") and problem.fix
        assert 1 <= problem.line <= text.count("\n") + 1
    if kind == "GOOD":
        assert observed.status == "ended"
        assert [p for other in engine.run_rules() for p in other.check(run)] == []


@SANDBOX
def test_a_plain_script_is_watched_by_default(tmp_path):
    path = tmp_path / "plain.py"
    path.write_text({c[0]: c[3] for c in cases()}["WR103-BAD-0"])
    report = tools.check_program([path])
    assert [f.code for f in report.findings] == ["WR103"]
    assert "run: ended" in report.worlds[0]


@SANDBOX
def test_a_program_that_needs_what_is_not_here_is_not_judged(tmp_path):
    path = tmp_path / "plain.py"
    path.write_text("import mujoco\nimport no_such_package_anywhere\nmujoco.MjModel.nothing()\n")
    report = tools.check_program([path])
    assert [f.code for f in report.findings if f.code.startswith("WR")] == []
    assert "cannot be run here" in report.worlds[0]


@SANDBOX
def test_a_program_that_dies_is_a_finding_and_no_crash_of_ours(tmp_path):
    path = tmp_path / "plain.py"
    path.write_text("import ctypes\nimport mujoco\nctypes.string_at(0)\n")
    report = tools.check_program([path])
    assert [(f.code, f.line) for f in report.findings if f.code.startswith("WR")] == [("WR102", 3)]


LOADING = """import mujoco
import shapes
model = mujoco.MjModel.from_xml_path("world.xml")
data = mujoco.MjData(model)
value = data.qpos[model.joint("b").id] + shapes.NOTHING
open("left.txt", "w").write("done")
"""


@SANDBOX
def test_a_program_finds_what_lies_beside_it_and_writes_nowhere(tmp_path):
    text = '<mujoco><worldbody><body><joint type="ball"/><geom size=".1"/></body><body><joint name="b"/><geom size=".1"/></body></worldbody></mujoco>'
    (tmp_path / "world.xml").write_text(text)
    (tmp_path / "shapes.py").write_text("NOTHING = 0\n")
    (tmp_path / "plain.py").write_text(LOADING)
    report = tools.check_program([tmp_path / "plain.py"])
    assert [(f.code, f.line) for f in report.findings] == [("WR103", 5)]
    assert not (tmp_path / "left.txt").exists()


@SANDBOX
@pytest.mark.parametrize("word", ["import frames\nframes.turned()", "mujoco.MjModel.from_xml_path('not_here.xml')"])
def test_what_is_missing_here_is_no_failure_of_the_program(tmp_path, word):
    (tmp_path / "plain.py").write_text(f"import mujoco\n{word}\n")
    report = tools.check_program([tmp_path / "plain.py"])
    assert report.findings == () and "cannot be run here" in report.worlds[0]


def test_definitions_alone_are_not_run(tmp_path):
    (tmp_path / "plain.py").write_text("import mujoco\ndef build():\n    return mujoco.MjSpec()\n")
    assert tools.check_program([tmp_path / "plain.py"]).worlds == ()


def test_a_program_of_ours_is_never_run_a_second_time(tmp_path, monkeypatch):
    def refused(*_):
        raise AssertionError("it was run under watch")

    monkeypatch.setattr(observing, "observe", refused)
    ours = "import mujoco\nfrom worldkit import program, scene\nprogram.main(lambda: scene.new())\n"
    (tmp_path / "ours.py").write_text(ours)
    for model in (None, True):
        tools.check_program([tmp_path / "ours.py"], model=model)
    (tmp_path / "plain.py").write_text("import mujoco\nprint(mujoco.__version__)\n")
    tools.check_program([tmp_path / "plain.py"], model=False)
    with pytest.raises(AssertionError, match="under watch"):
        tools.check_program([tmp_path / "plain.py"])
