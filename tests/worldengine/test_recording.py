"""The recording on disk: its identity, its columns, and what is left of it after a crash."""

import json
import os
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import mujoco
import numpy as np
import pyarrow as pa
import pytest

from small_worlds import ball, empty, floor, heap, record
from worldengine.recording import stored
from worldengine.recording.stored import RecordingError

SERVERS = Path(__file__).parents[2] / "servers"


def test_the_hash_repeats_and_does_not_depend_on_batches(tmp_path):
    recordings = [record(heap(), tmp_path / str(rows), 150, batch_rows=rows) for rows in (None, 1, 7, 64)]
    assert len({r.sha256 for r in recordings}) == 1
    assert all(stored.digest(r) == r.sha256 for r in recordings)
    for other in recordings[1:]:
        assert np.array_equal(recordings[0].contacts.force, other.contacts.force)
        assert np.array_equal(recordings[0].contacts.row, other.contacts.row)
    other = record(heap(bodies=11), tmp_path / "other", 150)
    assert other.sha256 != recordings[0].sha256


def test_the_files_are_plain_arrow_streams_that_say_what_they_hold(tmp_path):
    record(heap(), tmp_path / "t", 20)
    with pa.ipc.open_stream(tmp_path / "t" / "state.arrows") as reader:
        table = reader.read_all()
    field = table.schema.field("pos")
    assert field.metadata[b"unit"] == b"m"
    assert field.metadata[b"shape"] == b"12,3"
    assert table.num_rows == 21
    assert json.loads((tmp_path / "t" / "complete.json").read_text())["rows"] == 21


def test_columns_of_one_batch_are_views_into_the_file(tmp_path):
    recording = record(heap(), tmp_path / "t", 20, batch_rows=1000)
    assert not recording.pos.flags.owndata
    assert not recording.pos.flags.writeable
    assert not record(heap(), tmp_path / "u", 20, batch_rows=5).pos.flags.writeable


def test_a_world_in_which_nothing_can_break_loads_nothing_that_breaks(tmp_path, monkeypatch):
    for name in ("worldkit.breaking", "worldkit.breaking.letting_go"):
        monkeypatch.setitem(sys.modules, name, None)  # it cannot be imported
    assert len(record(heap(), tmp_path / "t", 3)) == 4


def test_contacts_are_mapped_and_not_unpacked_into_memory(tmp_path):
    """Of what many bodies do to each other the table is as large as the state."""
    record(heap(), tmp_path / "t", 50, batch_rows=1000)
    before = pa.total_allocated_bytes()
    contacts = stored.open(tmp_path / "t").contacts
    assert len(contacts) and contacts.force.any()
    assert pa.total_allocated_bytes() == before


def test_an_empty_world_records(tmp_path):
    recording = record(empty(), tmp_path / "t", 10)
    assert recording.pos.shape == (11, 0, 3)
    assert recording.ctrl.shape == (11, 0)
    assert len(recording.contacts) == 0
    assert recording.contacts.force.shape == (0, 3)
    assert stored.digest(recording) == recording.sha256


def machine():
    """A crane of everything: motor with activation, sensors, an equality, a mocap body, a yielding spring."""
    return mujoco.MjModel.from_xml_string("""
    <mujoco><option timestep="0.002"/><worldbody>
      <body name="arm" pos="0 0 1"><joint name="hinge" axis="0 1 0" stiffness="50" springyield="2"/>
        <geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.03"/>
        <body name="rod" pos="0.5 0 0"><joint name="elbow" axis="0 1 0"/>
          <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02"/></body></body>
      <body name="hand" mocap="true" pos="0 2 1"><geom size="0.05" contype="0" conaffinity="0"/></body>
      <body name="load" pos="0 2 0.8"><freejoint/><geom size="0.05"/></body>
    </worldbody>
    <equality><weld name="grip" body1="hand" body2="load"/>
      <joint name="gear" joint1="hinge" joint2="elbow" active="false"/></equality>
    <actuator><general name="motor" joint="hinge" dyntype="filter" dynprm="0.1" gainprm="3"/></actuator>
    <sensor><jointpos name="angle" joint="hinge"/><framelinacc name="acc" objtype="body" objname="rod"/></sensor>
    </mujoco>""")


def test_actuators_sensors_constraints_mocap_and_plastic_state_are_recorded(tmp_path):
    def control(model, data):
        data.ctrl[0] = 0.4
        data.mocap_pos[0, 0] = 0.05 * data.time
        data.eq_active[1] = data.time > 0.1

    recording = record(machine(), tmp_path / "t", 100, control)
    assert recording.ctrl[0, 0] == 0.4
    assert recording.act[0, 0] == 0 and recording.act[-1, 0] > 0
    np.testing.assert_allclose(recording.actuator_force[:, 0], 3 * recording.act[:, 0], rtol=1e-9)
    assert recording.sensordata.shape == (101, 4)
    np.testing.assert_allclose(recording.sensordata[:, 0], recording.qpos[:, 0])
    assert recording.mocap_pos[50, 0, 0] == pytest.approx(0.05 * recording.time[50])
    assert recording.pos[50, recording.body("hand"), 0] == pytest.approx(0.05 * recording.time[50])
    assert recording.eq_active[0].tolist() == [1, 0]
    assert recording.eq_active[-1].tolist() == [1, 1]
    assert np.isnan(recording.eq_residual[0, 1]) and np.isfinite(recording.eq_residual[-1]).all()
    gap = recording.eq_residual[50, 0]
    assert 0 < gap < 0.05
    assert recording.plastic.shape[1] == recording.meta["sizes"]["nplastic"] > 0
    assert [a["bodies"] for a in recording.meta["actuators"]] == [["arm"]]
    assert recording.meta["equalities"][0]["bodies"] == ["hand", "load"]
    facts = {body["name"]: body for body in recording.meta["bodies"]}
    assert facts["hand"]["mocap"] and not facts["hand"]["dynamic"]
    assert facts["rod"]["dynamic"] and facts["rod"]["joints"] == ["hinge"] and facts["rod"]["parent"] == "arm"


def test_fewer_rows_when_asked_and_the_last_always(tmp_path):
    recording = record(heap(), tmp_path / "t", 25, every=10)
    np.testing.assert_allclose(recording.time, (0, 0.01, 0.02, 0.025))


def test_a_second_recording_in_the_same_folder_is_refused(tmp_path):
    record(heap(), tmp_path / "t", 5)
    with pytest.raises(RecordingError, match="already"):
        record(heap(), tmp_path / "t", 5)


CRASHING = """
import sys
sys.path[:0] = [{servers!r}, {here!r}]
from small_worlds import heap, record
def control(model, data):
    if data.time > {slow}:
        import time; time.sleep(0.02)
record(heap(), {folder!r}, 1000000, control)
"""


def test_kill_minus_nine_loses_at_most_the_last_half_second(tmp_path):
    folder = tmp_path / "t"
    code = CRASHING.format(servers=str(SERVERS), here=str(Path(__file__).parents[1]), folder=str(folder), slow=0.3)
    process = subprocess.Popen([sys.executable, "-c", textwrap.dedent(code)], stderr=subprocess.PIPE)
    try:
        size, deadline = 0, time.monotonic() + 60
        while time.monotonic() < deadline:  # wait for the slow part, where only the clock can flush
            time.sleep(0.2)
            state = folder / "state.arrows"
            if state.exists() and len(stored.open(folder)) > 340:
                break
        else:
            pytest.fail("nothing was flushed")
    finally:
        os.kill(process.pid, signal.SIGKILL)
        process.wait()
        process.stderr.close()
    recording = stored.open(folder)
    assert not recording.complete
    rows = len(recording)
    assert rows > 340
    assert np.array_equal(np.round(np.diff(recording.time) / 0.001), np.ones(rows - 1))
    assert recording.contacts.row.max() < rows
    assert len(recording.sha256) == 64
    size = (folder / "state.arrows").stat().st_size
    os.truncate(folder / "state.arrows", size - 1000)  # and even a torn batch costs only itself
    torn = stored.open(folder)
    assert 0 < len(torn) < rows
    assert torn.contacts.row.max() < len(torn)
    assert np.array_equal(torn.pos, recording.pos[: len(torn)])


def test_damage_and_foreign_folders_are_named(tmp_path):
    with pytest.raises(RecordingError, match="not a recording"):
        stored.open(tmp_path)
    folder = tmp_path / "t"
    record(heap(), folder, 100, batch_rows=10)
    with pytest.raises(RecordingError, match="no body 'bell'"):
        stored.open(folder).body("bell")
    with pytest.raises(AttributeError, match="no column 'speed'"):
        stored.open(folder).speed  # noqa: B018
    os.truncate(folder / "state.arrows", 2000)
    with pytest.raises(RecordingError, match="damaged"):
        stored.open(folder)
    meta = json.loads((folder / "meta.json").read_text())
    (folder / "meta.json").write_text(json.dumps({**meta, "schema": 99}))
    with pytest.raises(RecordingError, match="schema 99"):
        stored.open(folder)
    (folder / "meta.json").write_text("[1")
    with pytest.raises(RecordingError, match="not a recording"):
        stored.open(folder)


@pytest.mark.skipif(sys.platform == "win32", reason="needs a file size limit")
def test_a_full_disk_ends_in_an_error_that_says_so(tmp_path):
    code = f"""
    import resource, signal, sys
    sys.path[:0] = [{str(SERVERS)!r}, {str(Path(__file__).parents[1])!r}]
    from small_worlds import heap, record
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (3_000_000, 3_000_000))
    record(heap(), {str(tmp_path / "t")!r}, 20000)
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1
    assert "the recording cannot be written" in done.stderr
    assert len(stored.open(tmp_path / "t")) > 10


def test_contacts_of_a_flex_have_no_geom(tmp_path):
    spec = mujoco.MjSpec.from_string("""
    <mujoco><option timestep="0.001"/><worldbody><geom name="ground" type="plane" size="0 0 1"/>
      <flexcomp name="cloth" type="grid" count="4 4 1" spacing="0.1 0.1 0.1" pos="0 0 0.05" dim="2" mass="0.2"
        radius="0.01">
        <edge equality="true"/></flexcomp></worldbody></mujoco>""")
    recording = record(spec, tmp_path / "t", 200)
    assert (recording.contacts.geom2 == -1).any() or (recording.contacts.geom1 == -1).any()
    assert recording.eq_residual.shape == (201, 1)


def test_pyramids_without_friction_and_floors_that_stay(tmp_path):
    spec = empty()
    spec.option.cone = mujoco.mjtCone.mjCONE_PYRAMIDAL
    floor(spec)
    ball(spec, "ball", (0, 0, 0.0999), mass=3.0, condim=1)
    recording = record(spec, tmp_path / "t", 500)
    assert recording.contacts.force[-1] == pytest.approx((0, 0, 3 * 9.81), rel=1e-6)


def test_a_contact_without_force_is_recorded_under_pyramidal_cones(tmp_path):
    spec = empty()
    spec.option.cone = mujoco.mjtCone.mjCONE_PYRAMIDAL
    floor(spec)
    ball(spec, "ball", (0, 0, 0.15), gap=0.1)  # seen from afar: a contact that has no place among the forces
    recording = record(spec, tmp_path / "t", 100)
    assert (recording.contacts.depth_m < 0).any()
    far = recording.contacts.depth_m < -0.01
    np.testing.assert_array_equal(recording.contacts.force[far], 0)


def test_a_recording_is_read_without_the_import_that_takes_longer(tmp_path):
    record(heap(), tmp_path, 20)
    code = "import sys; from worldengine.recording import stored; r = stored.open(sys.argv[1]); r.qpos[:], r.contacts"
    code += "; print(stored.digest(r), 'pyarrow.compute' in sys.modules)"
    path = os.pathsep.join(path for path in sys.path if path)
    call = [sys.executable, "-c", code, str(tmp_path)]
    done = subprocess.run(call, capture_output=True, text=True, env={**os.environ, "PYTHONPATH": path})
    assert done.stdout.split() == [stored.digest(stored.open(tmp_path)), "False"], done.stderr
