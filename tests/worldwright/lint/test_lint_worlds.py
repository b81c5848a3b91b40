"""Worlds are compiled in the sandbox: what comes back is numbers, whatever the program does, in bounded time."""

import json
import textwrap
import time
from pathlib import Path

import pytest

from worldwright.lint import engine, source, tools
from worldwright.lint.case import plan_with
from worldwright.lint.compiled import fetch, planned
from worldwright.lint.observed import observing
from worldwright.lint.program_view import Program
from worldwright.lint.rules.model.acting._twins import changed
from worldwright.model import call_time
from worldwright.model.errors import CallOverError
from worldwright.stage import confined
from worldwright.stage import tools as stage

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
ENDLESS = "while True:\n    pass\n"
BOTTOMLESS = "import sys\nsys.setrecursionlimit(10 ** 9)\ndef f():\n    f()\nf()\n"
LOUD = "while True:\n    print('x' * 10 ** 6)\n"


def written(folder, text, name="simulation.py"):
    path = folder / name
    path.write_text(text)
    return path


def test_a_plain_script_is_run_up_to_its_first_step(tmp_path):
    path = written(tmp_path, SCRIPT, "plain.py")
    assert tools.check_program([path], model=False).findings == ()  # reading alone finds nothing
    report = tools.check_program([path], model=True)
    assert [(f.code, f.line) for f in report.findings] == [("WR127", 6), ("WM120", 7)]
    assert "compiled" in report.worlds[0] and report.worlds[0] in report.text()


def test_a_world_that_the_end_of_a_call_cut_is_no_world_that_takes_too_long(tmp_path):
    """Neither a finding nor a report comes of it: on a machine with less to do the same program is faultless."""
    program = "import mujoco\ndef build():\n    return mujoco.MjSpec()\n"
    for name, text in (("ours.py", program), ("plain.py", SCRIPT), ("model.xml", "<mujoco/>")):
        path = written(tmp_path, text, name)
        with call_time.limited(0.0), pytest.raises(CallOverError, match="that a call may take"):
            tools.check_program([path], model=True)


def test_a_model_file_with_parts_is_compiled_with_all_it_names(tmp_path):
    (tmp_path / "parts").mkdir()
    written(
        tmp_path / "parts", "<mujocoinclude><geom type='box' size='.1 .1 .1' pos='0 0 .05'/></mujocoinclude>", "box.xml"
    )
    text = "<mujoco>\n<worldbody><geom type='plane' size='1 1 1'/>\n<body name='crate'><freejoint/><include file='parts/box.xml'/></body></worldbody></mujoco>"
    report = tools.check_program([written(tmp_path, text, "model.xml")])
    assert [(f.code, f.line) for f in report.findings] == [("WM112", 3)]


@pytest.mark.parametrize(
    ("text", "status"),
    [
        (ENDLESS, "timed_out"),
        ("x = []\nwhile True:\n    x.append(bytes(1 << 24))\n", ("failed", "out_of_memory", "died")),
        ("import os\nos._exit(3)\n", "died"),
        ("import os, signal\nos.kill(os.getpid(), signal.SIGKILL)\n", "died"),
        ("raise SystemExit(3)\n", "failed"),
        (
            BOTTOMLESS,
            ("failed", "died", "timed_out", "out_of_memory"),
        ),
        (LOUD, ("failed", "died", "timed_out")),
        ("x = 1\n", "nothing"),
        ("def build():\n    return 7\n", "failed"),
        ("import mujoco\nmujoco.mj_step(None, None)\n", "failed"),
    ],
)
def test_hostile_programs_end_in_bounded_time(tmp_path, text, status):
    began = time.monotonic()
    ends_by_itself = text not in (ENDLESS, BOTTOMLESS, LOUD)  # the others would burn all the time that they get
    outcome = fetch.world(written(tmp_path, text), wall_s=3.0 if ends_by_itself else 1.0)
    assert outcome.status in ((status,) if isinstance(status, str) else status)
    assert time.monotonic() - began < 60
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


@pytest.mark.parametrize("look", [fetch.world, observing.observe])
def test_what_a_process_told_is_not_read_beyond_a_size(tmp_path, monkeypatch, look):
    """Parsed it would take many times as much memory of the server, which nothing limits."""
    told = {"failure": "ValueError", "message": "no", "line": 1, "lines": [1], "pad": ""}
    for size, status in ((100, {"failed"}), (5 << 20, {"died", "cannot"})):
        content = json.dumps({**told, "pad": "x" * size}).encode()
        done = confined.Confined("ended", files={"outcome.json": content, "end.json": content})
        monkeypatch.setattr(stage, "run_confined", lambda *_, _done=done, **__: _done)
        assert look(written(tmp_path, SCRIPT, "told.py")).status in status


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


def test_a_plain_script_is_not_at_fault_for_a_package_that_is_not_here(tmp_path):
    needs = written(tmp_path, "import not_installed_anywhere\n\n" + SCRIPT, "plain.py")
    (found,) = tools.check_program([needs], model=True).findings
    assert (found.code, found.severity, found.line) == ("WM101", "info", 1)
    assert "not_installed_anywhere" in found.message and "cannot be built" not in found.message


def test_a_program_may_have_modules_and_data_beside_it(tmp_path):
    """Its world is built with both; what links out of the folder, or is a job's that may end at any moment, is not there."""
    written(tmp_path, "HEIGHTS = [1.0, 2.0]\n", "shapes.py")
    (tmp_path / "data").mkdir()
    written(tmp_path / "data", "0.25\n", "size.txt")
    (tmp_path / "secret.txt").symlink_to("/etc/passwd")
    (tmp_path / "jobs" / "stills-1").mkdir(parents=True)
    written(tmp_path / "jobs" / "stills-1", "", "shaders")
    text = """
        import os
        from pathlib import Path
        import mujoco
        import pydantic
        import shapes
        here = Path(__file__).parent
        assert not (here / "secret.txt").exists()
        assert not (here / "jobs").exists()
        def build():
            spec = mujoco.MjSpec()
            for height in shapes.HEIGHTS:
                spec.worldbody.add_geom(size=(float((here / "data" / "size.txt").read_text()), 0, 0), pos=(0, 0, height))
            return spec
    """
    outcome = fetch.world(written(tmp_path, textwrap.dedent(text)))
    assert (outcome.status, outcome.message) == ("compiled", "")
    assert outcome.arrays["geom_size"][:, 0].tolist() == [0.25, 0.25]


def test_no_comment_answers_for_what_acts_against_the_plan(tmp_path):
    text, plan = changed("spec.geom('crate').friction[0] = spec.geom('ground').friction[0] = 0.05")
    text = "".join(f"{line}  # worldwright: ignore[WM160] never mind\n" for line in text.splitlines())
    found, _ = engine.check_program_file(written(tmp_path, text), plan_with(plan), contract=True)
    assert {f.severity for f in found if f.code == "WM160"} == {"error"}


FALLING = """
import mujoco
from worldkit import program

def build():
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=(0, 0, 1))
    for i in range(COUNT):
        body = spec.worldbody.add_body(name=f"b{i}", pos=(0.01 * (i % 3), 0, 0.2 + 0.15 * i))
        body.add_freejoint()
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 0.1, 0.05))
    return spec

program.main(build, duration=SECONDS)
"""


def rehearsed(tmp_path, count, seconds):
    text = FALLING.replace("COUNT", str(count)).replace("SECONDS", str(seconds))
    outcome = fetch.world(written(tmp_path, text))
    assert outcome.status == "compiled", outcome
    return outcome


def test_the_first_steps_tell_what_the_physics_will_cost(tmp_path):
    """The price is what the steps taken cost, times all that there are. How long they took is the machine's affair."""
    short, long = (rehearsed(tmp_path, 1, seconds) for seconds in (10.0, 100.0))
    told, longer = short.texts["rehearsed"], long.texts["rehearsed"]
    assert longer["steps"] == 10 * told["steps"]
    assert 0 < told["taken"] < told["steps"] and told["seconds"] > 0
    assert short.pass_s == told["seconds"] * told["steps"] / told["taken"]
    found, said = engine.check_program_file(tmp_path / "simulation.py", None)
    assert "by its first steps the physics takes about" in said, (found, said)


def test_what_cannot_take_a_step_has_no_price_and_is_a_world_all_the_same(tmp_path):
    outcome = rehearsed(tmp_path, 1, "float('nan')")
    assert outcome.pass_s is None
    outcome = fetch.world(written(tmp_path, FALLING.replace("COUNT", "1").replace(", duration=SECONDS", "")))
    assert outcome.status == "compiled" and outcome.pass_s is None


def test_the_world_of_an_archive_is_compiled_once_in_a_row(tmp_path, monkeypatch):
    """By its content, and from a copy of the very bytes that were hashed; a failure, or a missing price, is tried again."""
    seen = []

    def compiled(path, _is_mjcf, _wall_s, lasting_s):
        seen.append((path.read_bytes(), lasting_s))
        assert path.parent != tmp_path
        texts = {} if b"unpriced" in seen[-1][0] else {"rehearsed": {"taken": 1, "seconds": 1.0, "steps": 2}}
        return fetch.Outcome("died" if b"broken" in seen[-1][0] else "compiled", texts=texts)

    monkeypatch.setattr(fetch, "_compiled", compiled)
    monkeypatch.setattr(fetch, "_KEPT", {})
    (one, same, other, broken) = (tmp_path / f"{name}.mjz" for name in ("one", "same", "other", "broken"))
    for path, content in ((one, b"a"), (same, b"a"), (other, b"b"), (broken, b"broken")):
        path.write_bytes(content)
    first = fetch.world(one, is_mjcf=True, lasting_s=0.5)
    assert fetch.world(same, is_mjcf=True) is first is fetch.world(one, is_mjcf=True, lasting_s=0.5)
    assert fetch.world(one, is_mjcf=True, lasting_s=1.0) is not first
    for path in (other, broken, broken, other, one):
        fetch.world(path, is_mjcf=True)
    assert seen == [(b"a", 0.5), (b"a", 1.0), (b"b", None), (b"broken", None), (b"broken", None), (b"a", None)]
    other.write_bytes(b"unpriced")
    for _ in range(2):
        fetch.world(other, is_mjcf=True, lasting_s=0.5)
    assert seen[-2:] == [(b"unpriced", 0.5)] * 2


SLOW_S = 0.004
LAW = f'''
import time

class Slow:
    """A law that does nothing, slowly."""

    name, shown_by, bodies = "slow", "", ("b0", "world")

    def start(self, model, data):
        self.asked = 0

    def step(self, model, data, seconds):
        assert abs(seconds - 4 * model.opt.timestep) < 1e-12
        time.sleep({SLOW_S})
        return np.zeros((2, 6))
'''


def test_what_a_law_takes_is_in_the_price(tmp_path):
    text = FALLING.replace("COUNT", "1").replace("SECONDS", "10.0, control_every=4, laws=[Slow()]")
    text = text.replace("\ndef build", f"\nimport numpy as np\n{LAW}\n\ndef build", 1)
    outcome = fetch.world(written(tmp_path, text))
    steps = outcome.texts["rehearsed"]["steps"]
    assert outcome.pass_s > 0.8 * SLOW_S * steps / 4


def test_the_price_of_a_world_with_laws_is_asked_of_its_program_where_the_world_is_there_as_a_file(
    tmp_path, monkeypatch
):
    priced = []

    def world(path, *, is_mjcf=False, **more):
        priced.append((Path(path).name, is_mjcf))
        told = {"taken": 1, "seconds": 40.0 if not is_mjcf else 1.0, "steps": 2}
        return fetch.Outcome("nothing" if path.name == "none" else "compiled", texts={"rehearsed": told}, arrays={})

    monkeypatch.setattr(fetch, "world", world)
    monkeypatch.setattr(engine, "check_world", lambda *_: [])
    monkeypatch.setattr(planned, "beside", lambda plan, text, made, wall_s: (made(), None))
    program = written(tmp_path, FALLING.replace("COUNT", "1").replace("SECONDS", "1.0"))
    plan = plan_with({})
    bundle = (tmp_path / "world.mjz", 1.0)
    said = engine.check_program_file(program, plan, bundle=bundle)[1]
    assert "by its first steps the physics takes about 2 s" in said and priced == [("world.mjz", True)]
    monkeypatch.setattr(engine, "law_rows", lambda _: iter(["slow"]))
    said = engine.check_program_file(program, plan, bundle=bundle)[1]
    assert "by its first steps and its laws the physics takes about 80 s" in said and priced[2:] == [
        ("simulation.py", False)
    ]
