"""Worlds are compiled in the sandbox: what comes back is numbers, whatever the program does, in bounded time."""

import time
from pathlib import Path

import pytest

from worldwright.lint import engine, source, tools
from worldwright.lint.compiled import fetch
from worldwright.lint.program import Program

EXAMPLES = Path(__file__).parents[3] / "examples"
SCRIPT = """\
import mujoco

XML = '''
<mujoco>
  <worldbody>
    <geom type="plane" size="5 5 .1" contype="2" conaffinity="4"/>
    <body name="ball" pos="0 0 1">
      <freejoint/>
      <geom size=".1"/>
    </body>
  </worldbody>
</mujoco>
'''
model = mujoco.MjModel.from_xml_string(XML)
data = mujoco.MjData(model)
while True:
    mujoco.mj_step(model, data)
"""


def written(folder, text, name="simulation.py"):
    path = folder / name
    path.write_text(text)
    return path


def test_a_plain_script_is_run_up_to_its_first_step(tmp_path):
    path = written(tmp_path, SCRIPT, "plain.py")
    assert tools.check_program([path]).findings == ()  # reading alone finds nothing
    report = tools.check_program([path], model=True)
    assert [(f.code, f.line) for f in report.findings] == [("WM120", 7)]
    assert "compiled" in report.worlds[0] and report.worlds[0] in report.text()


def test_a_model_file_with_parts_is_compiled_with_all_it_names(tmp_path):
    (tmp_path / "parts").mkdir()
    written(
        tmp_path / "parts", "<mujocoinclude><geom type='box' size='.1 .1 .1' pos='0 0 .05'/></mujocoinclude>", "box.xml"
    )
    text = "<mujoco>\n<worldbody><geom type='plane' size='1 1 1'/>\n<body name='crate'><freejoint/><include file='parts/box.xml'/></body></worldbody></mujoco>"
    report = tools.check_program([written(tmp_path, text, "model.xml")])
    assert [(f.code, f.line) for f in report.findings] == [("WM112", 3)]


@pytest.mark.parametrize("program", sorted(EXAMPLES.glob("*/simulation.py")), ids=lambda path: path.parent.name)
def test_the_worlds_of_the_examples_are_clean(program):
    from worldwright.model.plan_text import read_plan

    found, said = engine.check_program_file(program, read_plan(program.parent / "plan.md").plan, True)
    assert found == [] and "compiled" in said


@pytest.mark.parametrize(
    ("text", "status"),
    [
        ("while True:\n    pass\n", "timed_out"),
        ("x = []\nwhile True:\n    x.append(bytes(1 << 24))\n", ("failed", "out_of_memory", "died")),
        ("import os\nos._exit(3)\n", "died"),
        ("import os, signal\nos.kill(os.getpid(), signal.SIGKILL)\n", "died"),
        ("raise SystemExit(3)\n", "failed"),
        (
            "import sys\nsys.setrecursionlimit(10 ** 9)\ndef f():\n    f()\nf()\n",
            ("failed", "died", "timed_out", "out_of_memory"),
        ),
        ("while True:\n    print('x' * 10 ** 6)\n", ("failed", "died", "timed_out")),
        ("x = 1\n", "nothing"),
        ("def build():\n    return 7\n", "failed"),
        ("import mujoco\nmujoco.mj_step(None, None)\n", "failed"),
    ],
)
def test_hostile_programs_end_in_bounded_time(tmp_path, text, status):
    began = time.monotonic()
    outcome = fetch.world(written(tmp_path, text), wall_s=3.0)
    assert outcome.status in ((status,) if isinstance(status, str) else status)
    assert time.monotonic() - began < 10
    found = engine.check_world(Program(source.parse(text)), outcome)
    assert [f.code for f in found] == ([] if outcome.status == "nothing" else ["WM101"])


def test_nothing_is_written_or_read_outside_the_sandbox(tmp_path):
    secret = written(tmp_path, "secret", "secret.txt")
    target = tmp_path / "escaped.txt"
    text = f"import mujoco\nopen({str(target)!r}, 'w').write('x')\ndef build():\n    return mujoco.MjSpec()\n"
    assert fetch.world(written(tmp_path, text, "writes.py")).status == "failed"
    assert not target.exists()
    text = f"raise ValueError(open({str(secret)!r}).read())\n"
    assert "secret" not in fetch.world(written(tmp_path, text, "reads.py")).message.replace("secret.txt", "")


def test_a_forged_outcome_is_not_followed_out_of_the_folder(tmp_path):
    text = (
        "import os, sys\nout = sys.path and os.getcwd()\n"
        "os.symlink('/etc/passwd', out + '/facts.npz')\nos.symlink('/etc/passwd', out + '/outcome.json')\nos._exit(0)\n"
    )
    outcome = fetch.world(written(tmp_path, text))
    assert outcome.status == "died" and not outcome.arrays and "root:" not in outcome.message


def test_without_a_sandbox_nothing_is_built(tmp_path, monkeypatch):
    from worldwright.stage import sandbox

    monkeypatch.delenv("WORLDWRIGHT_SANDBOX", raising=False)
    monkeypatch.setattr(sandbox, "level", lambda: "rlimits")
    report = tools.check_program([written(tmp_path, SCRIPT)], model=True)
    assert report.findings == () and "no sandbox" in report.worlds[0]


def test_a_failing_build_is_told_with_its_line(tmp_path):
    text = "import mujoco\nfrom worldkit import program\n\n\ndef build():\n    return mujoco.MjSpec().compile(3)\n\n\nif __name__ == '__main__':\n    program.main(build, duration=1.0)\n"
    found = tools.check_program([written(tmp_path, text)]).findings
    assert [(f.code, f.line) for f in found if f.code == "WM101"] == [("WM101", 6)]


def test_a_model_file_answers_for_a_finding_in_a_comment(tmp_path):
    text = (
        "<mujoco><worldbody><geom type='plane' size='1 1 1'/>\n{0}\n"
        "<body name='crate'><freejoint/><geom size='.1'/></body></worldbody></mujoco>"
    )
    plain, answered = "", "<!-- worldwright: ignore[WM112] a press fit -->"
    found = tools.check_program([written(tmp_path, text.format(plain), "a.xml")]).findings
    assert [(f.code, f.severity) for f in found] == [("WM112", "error")]
    report = tools.check_program([written(tmp_path, text.format(answered), "b.xml")])
    assert report.ok and [(f.code, f.severity) for f in report.findings] == [("WM112", "info")]
    assert "a press fit" in report.findings[0].message
