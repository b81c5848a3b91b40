"""`worldwright live` from its first line to Ctrl-C, and `worldwright drive` on what it leaves."""

import json
import shutil
import signal
import subprocess
import sys

import pytest
from click.testing import CliRunner
from websockets.sync.client import connect

from worldwright import driven_worlds, live
from worldwright.ends import drive_film, driven
from worldwright.model.errors import GateError


@pytest.fixture
def run(roped, tmp_path):
    shutil.copytree(roped.run, tmp_path / "rope", ignore=shutil.ignore_patterns("drives"))
    return tmp_path / "rope"


@pytest.fixture(scope="module")
def driven_run(roped, tmp_path_factory):
    """A run with one drive, and what its command printed: (run, told, heard)."""
    run = tmp_path_factory.mktemp("driven") / "rope"
    shutil.copytree(roped.run, run, ignore=shutil.ignore_patterns("drives"))
    words = [sys.executable, "-m", "worldwright.cli", "live", str(run), "--no-pictures"]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        address = process.stdout.readline().split()[0]
        with connect(address.replace("http", "ws") + "stream?name=Ada") as socket:
            socket.send(json.dumps({"kind": "drive", "n": 0, "values": {"\x1b[2J": 1.0}}))
            number, state = 0, {"time_s": 0.0, "waits": True}
            while state["time_s"] < 0.3:
                number += 1
                socket.send(json.dumps({"kind": "drive", "n": number, "values": {"pull": 0.2}}))
                said = json.loads(socket.recv(timeout=60))
                if said["kind"] == "state":
                    assert said["waits"] or said["time_s"] > 0.0 or number > 1
                    state = said
            process.send_signal(signal.SIGINT)
            while said["kind"] != "ended":
                said = json.loads(socket.recv(timeout=60))
            process.send_signal(signal.SIGINT)  # an impatient hand: what it would lose, nobody signs later
        told, heard = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 0, heard
    return run, told, heard


def test_it_is_driven_from_its_printed_address_until_it_is_interrupted(driven_run):
    run, told, heard = driven_run
    assert "there is no command" in heard and "\x1b" not in heard, "a peer's words move no cursor"
    assert "driven by Ada" in told and "bit for bit" in told and "signed by this machine's key" in told
    (folder,) = driven.listed(run)
    (folder / "physics").rename(folder / "aside")
    with pytest.raises(GateError, match="not proved yet"):
        drive_film.film(folder)
    (folder / "aside").rename(folder / "physics")
    runner = CliRunner()
    assert "Ada" in runner.invoke(driven_worlds.command, ["list", str(run)]).output
    proved = runner.invoke(driven_worlds.command, ["prove", str(run), "--format", "json"])
    assert proved.exit_code == 0 and json.loads(proved.output)["driven_by"][0]["driver"] == "Ada"


@pytest.mark.gl
def test_a_drive_is_filmed(driven_run):
    (folder,) = driven.listed(driven_run[0])
    made, stated = drive_film.film(folder, ("side",))
    assert stated.vouched
    assert [path.name for path in made] == ["side.mp4"] and made[0].stat().st_size > 1000


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["nowhere"], "there is no run"),
        (["--size", "big"], "no size"),
        (["--follow", "cart"], "no body cart"),
        (["--speed", "nan"], "finite"),
    ],
)
def test_what_cannot_be_driven_is_told_with_the_next_move(run, words, said):
    told = CliRunner().invoke(live.command, words if words == ["nowhere"] else [str(run), *words])
    assert told.exit_code == 2 and said in told.output and "next: " in told.output and not (run / "drives").exists()


def test_no_drive_is_told_with_the_known_way_to_one(run):
    told = CliRunner().invoke(driven_worlds.command, ["prove", str(run)])
    assert told.exit_code == 2 and "there is no drive" in told.output and "worldwright live" in told.output
