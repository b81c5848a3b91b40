"""The border between the author's process and the engine's: an author that dies, hangs, lies or floods stops nothing but itself."""

import contextlib
import ctypes
import inspect
import json
import os
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import ClassVar

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor
from worldengine.inputs import author_link
from worldengine.inputs.author_link import Distant, Local
from worldengine.inputs.ports import Ports
from worldengine.inputs.replies import Answers
from worldengine.recording import stored
from worldkit import channel, program
from worldkit.channel import AUTHOR, ENGINE, Channel, PeerError
from worldkit.mirror import Mirror
from worldkit.speaking import EDIT, message_bytes

ROWS = (("force", frozenset({"ball"})), ("parameter", frozenset({"ball.body_mass"})))


def world() -> mujoco.MjSpec:
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.3))
    return spec


def run(out: Path, control, **settings) -> int:
    arguments = ["--pass", "physics", "--out", str(out)]
    return program.main(world, control, duration=0.05, argv=arguments, **settings)


@pytest.fixture
def ends():
    """(engine's end, author's end) of a channel in this process, both closed afterwards."""
    one, other = channel.pair()
    pair = Channel(one, ENGINE), Channel(other, AUTHOR)
    yield pair
    pair[0].close()
    while (
        Liar.living
    ):  # one that still listened would read what the next test's author is sent, by the same file number
        Liar.living.pop().join(30)
    pair[1].close()


class Liar:
    """An author's end that says what it wants: answers are made by `act(message address)`."""

    living: ClassVar[list[threading.Thread]] = []

    def __init__(self, end: Channel, act) -> None:
        self.end, self.act = end, act
        thread = threading.Thread(target=self.live, daemon=True)
        self.living.append(thread)
        thread.start()

    def live(self) -> None:
        hello = self.end.greeting()
        self.end.map()
        self.end.greet({"ready": True})
        turn = 1
        with contextlib.suppress(OSError, ValueError):  # the test is over, and its ends are closed
            while self.end.next(turn):
                self.act(self.end.base + hello["message_at"])
                self.end.post(turn)
                turn += 1


def asked(ends, act):
    """(model, data, voice, answers) of a world whose author is a liar."""
    model = world().compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    Liar(ends[1], act)
    ports = Ports(model, ROWS)
    return model, data, Distant(model, data, ports, ends[0]), Answers(model, data, ports)


def question(voice, answers) -> None:
    answers.shown(voice.ask())
    voice.go()
    voice.hear()
    answers.read(voice.message)
    answers.push()
    answers.edit()


def number(message: int, at: int, value: float) -> None:
    ctypes.c_double.from_address(message + 8 + 8 * at).value = value


def test_the_author_is_shown_everything_the_engine_holds_bit_for_bit(tmp_path):
    spec = world()
    ball(spec, "other", (0.05, 0, 0.55))
    model = spec.compile()
    theirs, mine = mujoco.MjData(model), mujoco.MjData(model)
    for _ in range(400):
        mujoco.mj_step(model, theirs)
    mujoco.mj_step1(model, theirs)
    one, other = Mirror(model, theirs), Mirror(model, mine)
    memory = ctypes.create_string_buffer(one.size)
    one.send(ctypes.addressof(memory))
    other.receive(ctypes.addressof(memory))
    assert theirs.ncon > 0 and mine.ncon == theirs.ncon and mine.time == theirs.time
    arrays = [n for n in dir(theirs) if not n.startswith("_") and isinstance(getattr(theirs, n), np.ndarray)]
    assert len(arrays) > 100
    assert [n for n in arrays if getattr(theirs, n).tobytes() != getattr(mine, n).tobytes()] == []
    np.testing.assert_array_equal(theirs.contact.dist, mine.contact.dist)
    mujoco.mj_step2(model, theirs)
    mujoco.mj_step2(model, mine)  # and may go on from there
    assert theirs.qpos.tobytes() == mine.qpos.tobytes()


def test_addresses_of_the_engine_are_not_shown():
    model = world().compile()
    data = mujoco.MjData(model)
    mirror = Mirror(model, data)
    for _ in range(300):
        mujoco.mj_step(model, data)
    memory = ctypes.create_string_buffer(mirror.size)
    mirror.send(ctypes.addressof(memory))
    places = {int(value) >> 24 for value in (mirror.buffer, data._address)}
    words = np.frombuffer(memory.raw[: mirror.size // 8 * 8], np.uint64) >> np.uint64(24)
    assert not places & set(words.tolist())


def test_an_honest_answer_is_applied(ends):
    model, data, voice, answers = asked(ends, lambda message: number(message, 0, 7.0))
    question(voice, answers)
    assert data.qfrc_applied[0] == 7.0
    assert model.body_mass[1] == 1.0


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf")])
def test_what_is_no_number_is_refused(value, ends):
    _, data, voice, answers = asked(ends, lambda message: number(message, 1, value))
    with pytest.raises(PeerError, match="not finite"):
        question(voice, answers)
    assert not data.qfrc_applied.any()


@pytest.mark.parametrize(
    ("edit", "says"),
    [
        ((9, 1, 2.0), "not declared"), ((-1, 1, 2.0), "not declared"), ((0, 0, 2.0), "not declared"),
        ((0, 99, 2.0), "not declared"), ((0, -1, 2.0), "not declared"), ((0, 1, float("nan")), "not declared"),
    ],
)  # fmt: skip
def test_a_parameter_that_is_not_declared_is_refused(edit, says, ends):
    model = world().compile()
    width = Ports(model, ROWS).width

    def act(message: int) -> None:
        ctypes.c_uint64.from_address(message).value = 1
        told = np.array([edit], np.dtype(EDIT)).tobytes()
        ctypes.memmove(message + 8 + 8 * width, told, len(told))

    live, _, voice, answers = asked(ends, act)
    with pytest.raises(PeerError, match=says):
        question(voice, answers)
    assert live.body_mass.tolist() == model.body_mass.tolist()


def test_more_parameters_than_there_is_room_for_are_refused(ends):
    def act(message: int) -> None:
        ctypes.c_uint64.from_address(message).value = 1 << 40

    _, _, voice, answers = asked(ends, act)
    with pytest.raises(PeerError, match="too many"):
        question(voice, answers)


def test_a_silent_author_is_named_with_the_time(ends, monkeypatch):
    monkeypatch.setattr(author_link, "ANSWER_S", 0.3)
    heard = threading.Event()
    _, _, voice, answers = asked(ends, lambda message: heard.wait(30))
    with pytest.raises(PeerError, match=r"the author's process does not answer \(t = 0"):
        question(voice, answers)
    heard.set()


def test_one_that_floods_the_pipe_is_named_too(ends, monkeypatch):
    monkeypatch.setattr(author_link, "ANSWER_S", 0.3)
    stop = []

    def flood(message: int) -> None:
        while not stop:
            try:
                os.write(ends[1]._write, b"." * 4096)
            except OSError:
                time.sleep(0.001)

    _, _, voice, answers = asked(ends, flood)
    with pytest.raises(PeerError, match="does not answer"):
        question(voice, answers)
    stop.append(True)


def test_one_that_takes_a_turn_too_many_is_refused(ends):
    def act(message: int) -> None:
        ends[1]._words[channel.TURN[AUTHOR]] = 1 << 60
        seen.wait(30)

    seen = threading.Event()
    _, _, voice, answers = asked(ends, act)
    with pytest.raises(PeerError, match="not its own"):
        question(voice, answers)
    seen.set()


@pytest.mark.skipif(not hasattr(os, "memfd_create"), reason="needs a memory file that can be sealed")
def test_the_memory_cannot_be_taken_away(ends):
    asked(ends, lambda message: None)
    with pytest.raises(OSError, match="not permitted"):
        os.ftruncate(ends[1]._memory, 0)


def test_an_author_that_dies_is_named_and_the_recording_kept(tmp_path, capfd):
    def control(model, data):
        if data.time > 0.0195:
            os._exit(3)

    child = os.fork()
    if child == 0:  # the author is this very process
        run(tmp_path, control)
        os._exit(0)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 3
    deadline = time.monotonic() + 60
    while not (tmp_path / "error.json").exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    facts = json.loads((tmp_path / "error.json").read_text())
    assert facts["code"] == "author" and "has ended" in facts["message"]
    assert len(stored.open(tmp_path / "trajectory")) == 20


def test_what_goes_nowhere_is_told_once_with_its_line(tmp_path, capfd):
    def control(model, data):
        data.xfrc_applied[1, 0] = 1.0
        data.qvel[0] = 9.0
        model.body_mass[1] = 100.0

    assert run(tmp_path, control, inputs=("force:ball",)) == 0
    said = capfd.readouterr().err
    lines = Path(__file__).read_text().splitlines()
    for name, text in (("data.qvel", "data.qvel[0] = 9.0"), ("model.body_mass", "model.body_mass[1] = 100.0")):
        number = next(n for n, line in enumerate(lines, 1) if line.strip() == text)
        assert f"test_two_processes.py:{number}: control writes {name}, which is no declared input" in said
    assert said.count("no declared input") == 2
    recording = stored.open(tmp_path / "trajectory")
    assert set(recording.interventions.kind) == {"force"}
    assert recording.linvel[-1, 0, 0] == pytest.approx(0.05, rel=1e-3)


def test_a_program_without_control_is_not_running_while_its_world_does(tmp_path):
    source = tmp_path / "simulation.py"
    source.write_text(
        "import mujoco, os\nfrom worldkit import program\n"
        "def build():\n    spec = mujoco.MjSpec()\n    spec.worldbody.add_geom(size=(1, 0, 0))\n    return spec\n"
        "program.main(build, duration=0.01)\nprint('ended', os.getpid())\n"
    )
    call = [sys.executable, str(source), "--pass", "build", "--out", str(tmp_path / "out")]
    environment = os.environ | {"PYTHONPATH": str(Path(program.__file__).parents[1])}
    done = subprocess.run(call, capture_output=True, text=True, check=True, env=environment, timeout=60)
    assert "ended" in done.stdout
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == ["program.json", "result.json", "world.mjz"]


def test_a_spring_that_begins_wound_is_in_the_ledger(tmp_path):
    def sprung(position: float) -> mujoco.MjSpec:
        spec = empty(gravity=-9.81)
        body = spec.worldbody.add_body(name="door", pos=(0, 0, 1))
        body.add_joint(name="hinge", type=mujoco.mjtJoint.mjJNT_HINGE, axis=(0, 0, 1), stiffness=(2.0, 0, 0))
        body.add_geom(size=(0.1, 0, 0), pos=(0.3, 0, 0), mass=1.0)
        spec.add_key(name="start", qpos=[position])
        return spec

    def told(name: str, position: float, *more: str):
        arguments = ["--pass", "physics", "--out", str(tmp_path / name), *more]
        assert program.main(lambda: sprung(position), duration=0.01, argv=arguments) == 0
        table = stored.open(tmp_path / name / "trajectory").interventions
        return list(zip(table.kind, table.target, table.time, table.value, table.work_j, strict=True))

    ((kind, target, time_s, value, work),) = told("wound", 0.5)
    assert (kind, target, time_s) == ("pose", "door/hinge", 0.0)
    assert value == pytest.approx((0, 0, 0, 0, 0, 0.5)) and work == pytest.approx(0.5 * 2.0 * 0.5**2)
    assert told("slack", 0.0) == [] and told("undone", 0.5, "--without", "pose:door") == []


FLEX = """<mujoco><worldbody><body name="cloth_9"><freejoint/><geom size=".1"/></body>
  <body name="post" pos="0 0 1"><flexcomp name="cloth" type="grid" count="3 3 1" spacing=".1 .1 .1" dim="2" radius=".01">
  <pin id="0"/><edge equality="true"/></flexcomp></body></worldbody></mujoco>"""


def test_a_flex_declared_opens_its_points_and_nothing_that_is_only_called_like_one():
    model = mujoco.MjSpec.from_string(FLEX).compile()
    points = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, f"cloth_{i}") for i in range(1, 9)]
    opened = Ports(model, (("force", frozenset({"cloth"})),)).entries["xfrc_applied"]
    assert opened == sorted(6 * b + i for b in points for i in range(3))


def test_an_answer_has_room_for_what_is_declared_and_no_more():
    assert message_bytes(3, edits=False) == 64
    assert message_bytes(3, edits=True) > 64
    model = world().compile()
    assert Ports(model, ()).width == 0 and not Ports(model, ())
    assert Ports(model, (("force", frozenset({"nobody"})),)).width == 0
    assert Ports(model, (("force", frozenset({"ball"})),)).entries == {
        "qfrc_applied": [0, 1, 2],
        "xfrc_applied": [6, 7, 8],
    }


def derived(model, data):
    data.xpos[1, 2] = 5.0
    data.qacc[0] = 3.0
    data.qfrc_bias[:] = 0.0
    data.qacc_warmstart.fill(1.0)
    spin = data.cvel
    spin[1, 0] = 2.0
    data.time = 0.0
    data.contact.friction[:] = 0.01


def asking(model, data):
    mujoco.mj_forward(model, data)
    mujoco.mj_subtreeVel(model, data)
    mujoco.mj_rnePostConstraint(model, data)
    data.xfrc_applied[1, 0] = 1e-3 * data.xpos[1, 2]


def late_and_by_another_name(model, data):
    if 0.0205 < data.time < 0.0215:  # in one step of fifty
        setattr(data, "xpos", data.xpos + 1.0)  # noqa: B010


def both(model, data):
    mujoco.mj_forward(model, data)
    data.xipos[1, 0] = 9.0


@pytest.mark.parametrize(
    ("control", "told"),
    [
        (derived, {"xpos", "qacc", "qfrc_bias", "qacc_warmstart", "cvel", "time", "contact"}),
        (asking, set()),
        (both, {"xipos"}),
        (late_and_by_another_name, {"xpos"}),
    ],
)
def test_what_the_engine_derives_is_written_in_vain_and_told_by_array(control, told, tmp_path):
    """A program that calls the engine changes what derives, too: then only what its text writes is named."""
    text = "import mujoco\n" + inspect.getsource(control)
    source = tmp_path / "simulation.py"
    source.write_text(text)
    names = {}
    exec(compile(text, str(source), "exec"), names)
    model = world().compile()
    data = mujoco.MjData(model)
    data.qpos[2] = 0.1
    ports = Ports(model, ROWS)
    mujoco.mj_step1(model, data)
    voice = Local(model, data, ports, names[control.__name__])
    for _ in range(50):
        voice.ask()
        voice.hear()
        mujoco.mj_step(model, data)
        mujoco.mj_step1(model, data)
    assert voice.strays == [f"data.{name}" for name in dict.fromkeys(n.removeprefix("data.") for n in voice.strays)]
    assert {name.removeprefix("data.") for name in voice.strays} == told
