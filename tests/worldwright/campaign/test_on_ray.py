"""Ray as the hands of a campaign: what it is asked for, and what becomes of what it raises. Ray itself is not installed here.

`make test-ray` installs it, and runs the last tests on a Ray of this machine: its own, and a cluster of two nodes, which does
twenty-four sweeps of an accepted example.
"""

import contextlib
import json
import os
import signal
import socket
import subprocess
import sys
import time
import types

import pytest

import example_sweeps
import stub_worlds
from stub_worlds import FAILS, MASS
from worldwright.campaign import conducting, on_ray, setting_out
from worldwright.campaign.campaign_file import CampaignError
from worldwright.campaign.campaign_store import Store
from worldwright.campaign.one_world import Task, perform
from worldwright.campaign.world_row import Row


class DiedError(Exception):
    """As Ray says it."""


class StandIn(types.ModuleType):
    """The part of Ray that is used: tasks run when they are waited for; what of a mass is due to die, dies."""

    def __init__(self, dies=(), silent=()):
        super().__init__("ray")
        self.dies, self.silent, self.asked, self.tasks = dict(dies), set(silent), {}, {}
        self.dashboard = ""
        self.shut, self.holds = 0, [{"CPU": 4.0, "memory": 8e9}]

    def is_initialized(self):
        return False

    def init(self, **words):
        self.asked["init"] = words
        if words["address"] == "nobody:1":
            raise ConnectionError("Could not connect to nobody:1\nmore words")
        return types.SimpleNamespace(dashboard_url=self.dashboard)

    def nodes(self):
        dead = {"Alive": False, "Resources": {"CPU": 64.0, "memory": 8e12}}
        return [{"Alive": True, "Resources": each} for each in self.holds] + [dead]

    def remote(self, **words):
        self.asked["remote"] = words

        def decorate(function):
            def submit(task):
                reference = object()
                self.tasks[reference] = (function, task)
                return reference

            return types.SimpleNamespace(remote=submit)

        return decorate

    def wait(self, references, num_returns, timeout):
        ready = [r for r in references if self.mass(r) not in self.silent][:num_returns]
        return ready, [r for r in references if r not in ready]

    def mass(self, reference):
        return self.tasks[reference][1].values[MASS]

    def get(self, reference):
        function, task = self.tasks[reference]
        left = self.dies.get(task.values[MASS], 0)
        if left:
            self.dies[task.values[MASS]] = left - 1
            raise DiedError("The worker died unexpectedly\nlong story")
        return function(task)

    def cancel(self, reference, force):
        assert force
        self.silent.discard(self.mass(reference))
        self.dies[self.mass(reference)] = 1

    def shutdown(self):
        self.shut += 1


@pytest.fixture
def ray(monkeypatch):
    """Has a stand-in for Ray imported."""

    def bring(**words) -> StandIn:
        module = StandIn(**words)
        monkeypatch.setitem(sys.modules, "ray", module)
        monkeypatch.setattr(on_ray, "installed", lambda: True)
        monkeypatch.setenv(on_ray.NICENESS, "1")  # so that it is as before afterwards, whatever is set
        monkeypatch.delenv(on_ray.NICENESS)
        return module

    return bring


@pytest.fixture
def begun(tmp_path, small_plan):
    """Begins a campaign over masses."""

    def begin(values, **words) -> Store:
        (tmp_path / "plan.md").write_text(small_plan, encoding="utf-8")
        file = tmp_path / "c.yaml"
        sweep = {"fields": {MASS: {"values": list(values)}}}
        file.write_text(json.dumps({"plan": "plan.md", "report": False, "sweep": sweep, **words}))
        return setting_out.begun(setting_out.checked(file), file, tmp_path / "campaign", approved=False)

    return begin


def test_where_ray_is_installed_it_does_the_work_and_is_left(begun, ray):
    module, store = ray(), begun([1, 2, FAILS, 3])
    end = conducting.conduct(store, stub_worlds.do, say=lambda said: pytest.fail(said))
    assert end.done == 4 and end.outcomes == {"failed": 1, "held": 3} and module.shut == 1
    assert os.environ[on_ray.NICENESS] == "0", "as our own processes"
    assert module.asked["init"]["address"] == "local" and module.asked["init"]["include_dashboard"] is False
    assert module.asked["remote"]["max_retries"] == 0 and module.asked["remote"]["num_cpus"] == 1


def test_the_dashboard_is_opened_and_named_where_it_is_asked_for(begun, ray):
    said, store, module = [], begun([1], dashboard=True), ray()
    module.dashboard = "127.0.0.1:8265"
    conducting.conduct(store, stub_worlds.do, say=said.append)
    assert module.asked["init"]["include_dashboard"] is True
    assert said == ["Ray's dashboard: http://127.0.0.1:8265"]


def test_a_cluster_is_asked_by_its_address_and_for_what_worlds_took(begun, ray):
    module = ray()
    store = begun([1], address="10.0.0.1:6379", workers=3)
    took = conducting.Count()
    for seconds, cpu in ((10.0, 3.0), (10.0, 18.0)):
        took.add(Row(world="0" * 16, number=0, outcome="held", seconds=seconds, cpu_seconds=cpu, memory_mb=1000))
    tasks = conducting.crew_of(store.begun.campaign, stub_worlds.do, took, print)
    assert module.asked["init"]["address"] == "10.0.0.1:6379" and "num_cpus" not in module.asked["init"]
    assert tasks.free() == 2 and module.asked["remote"]["num_cpus"] == 2
    assert module.asked["remote"]["memory"] == (1000 + on_ray.SPARE_MB) * 2**20
    on_ray.Tasks(None, stub_worlds.do, memory_mb=1e6)
    assert module.asked["remote"]["memory"] == 4e9, (
        "never more than half of what the cluster has, or it would wait for ever"
    )
    assert on_ray.Tasks(None, stub_worlds.do).free() == 3, "a processor is left to Ray"
    assert on_ray.Tasks(None, stub_worlds.do, cores=0.2).free() == 3 and module.asked["remote"]["num_cpus"] == 1
    assert on_ray.Tasks(None, stub_worlds.do, cores=90).free() == 1 and module.asked["remote"]["num_cpus"] == 4


@pytest.mark.parametrize(
    ("holds", "fits"),
    [
        ([{"CPU": 4.0, "memory": 64e9}] * 2, 8),
        ([{"CPU": 4.0, "memory": 9e9}] * 2, 4),
        ([{"CPU": 4.0, "memory": 7e9}, {"memory": 64e9}], 2),
        ([{"CPU": 4.0}], 4),
        ([{"CPU": 0.5, "memory": 1e9}], 1),
    ],
)
def test_no_more_is_handed_out_than_the_nodes_hold_at_once(ray, holds, fits):
    ray().holds = holds
    wanted = 4e9 / 2**20 - on_ray.SPARE_MB
    assert on_ray.Tasks(50, stub_worlds.do, memory_mb=wanted).free() == fits


def test_a_dead_worker_is_tried_again_and_in_the_end_given_up(begun, ray):
    ray(dies={2.0: 1, 3.0: 9})
    store = begun([1, 2, 3], per_world={"begun": 2})
    end = conducting.conduct(store, stub_worlds.do)
    rows = {row.values[MASS]: row for row in store.rows()}
    assert end.outcomes == {"gave_up": 1, "held": 2}
    assert rows[3.0].cause.kind == "worker_died" and "DiedError: The worker died unexpectedly" in rows[3.0].cause.said
    assert "long story" not in rows[3.0].cause.said


def test_a_task_without_end_is_given_up(begun, ray, monkeypatch):
    monkeypatch.setattr(conducting, "GRACE_S", 0.0)
    ray(silent=[2.0])
    end = conducting.conduct(begun([1, 2], per_world={"seconds": 0.2}), stub_worlds.do)
    assert end.outcomes == {"gave_up": 1, "held": 1} and end.causes == {"over_time": 1}
    assert end.seconds >= 1 + 0.2


def test_what_is_under_way_is_cancelled_with_the_campaign(ray):
    module = ray(silent=[1.0])
    tasks = on_ray.Tasks(1, stub_worlds.do)
    one = Task(folder="x", number=0, base=0, values={MASS: 1.0}, world="0" * 16)
    tasks.take(one)
    assert tasks.free() == 0 and list(tasks.ended(0.0)) == []
    assert tasks.drop() == [one] and tasks.free() == 1 and not module.silent


def test_no_cluster_and_no_ray_are_said_with_what_to_do(begun, ray, monkeypatch):
    store = begun([1], address="nobody:1")
    monkeypatch.setattr(on_ray, "installed", lambda: False)
    with pytest.raises(CampaignError, match="pip install ray"):
        conducting.conduct(store, stub_worlds.do)
    ray()
    with pytest.raises(CampaignError, match="nobody:1: Ray does not answer: Could not connect to nobody:1\n"):
        conducting.conduct(store, stub_worlds.do)
    assert not store.driven


if "WORLDWRIGHT_RAY" in os.environ:

    def test_ray_itself_does_the_work(begun):
        store = begun(range(1, 5), hands="ray", workers=2)
        end = conducting.conduct(store, stub_worlds.stub_on_a_node)
        assert end.outcomes == {"held": 4} and set(stub_worlds.paid(store.folder).values()) == {1}
        assert noted(store) == ["0"]

    def noted(store) -> list[str]:
        """The niceness of the workers of each node that did something."""
        return [path.read_text() for path in store.folder.glob("nodes/*")]

    @pytest.fixture
    def cluster(tmp_path):
        """Two nodes of one processor each on this machine; the address of the first."""
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            address = f"127.0.0.1:{free.getsockname()[1]}"
        ray = [sys.executable, "-c", "from ray.scripts.scripts import main; main()", "start", "--block", "--num-cpus=1"]
        ray += ["--object-store-memory=100000000", "--disable-usage-stats", "--node-ip-address=127.0.0.1"]
        head = ["--head", f"--port={address.rpartition(':')[2]}", "--include-dashboard=false"]
        nodes, even = [], os.environ | {on_ray.NICENESS: "0"}
        with (tmp_path / "ray.log").open("wb") as log:
            for words in (head, [f"--address={address}"]):
                node = subprocess.Popen([*ray, *words], stdout=log, stderr=log, start_new_session=True, env=even)
                nodes.append(node)
                until_it_listens(address)
        yield address
        for node in reversed(nodes):
            node.send_signal(signal.SIGTERM)
            with contextlib.suppress(subprocess.TimeoutExpired):
                node.wait(20)
            with contextlib.suppress(OSError):
                os.killpg(node.pid, signal.SIGKILL)
            node.wait()

    def until_it_listens(address):
        host, port = address.split(":")
        for _ in range(600):
            with contextlib.suppress(OSError), socket.create_connection((host, int(port)), 1):
                return
            time.sleep(0.1)
        pytest.fail(f"no Ray listens at {address}")

    def test_two_nodes_give_the_trajectories_that_this_machine_gives(cluster, tmp_path):
        ray = __import__("ray")  # which `make test-ray` installs

        ray.init(address=cluster, log_to_driver=False)
        for _ in range(600):
            if sum(node["Alive"] for node in ray.nodes()) == 2:
                break
            time.sleep(0.1)
        hashes, worlds = {}, max(4, example_sweeps.SWEEPS)
        for hands, where in (("processes", ""), ("ray", cluster)):
            file = example_sweeps.campaign(tmp_path / hands, worlds, hands=hands, address=where, workers=2)
            store = setting_out.begun(setting_out.checked(file), file, tmp_path / hands / "campaign", approved=True)
            end = conducting.conduct(store, perform if hands == "processes" else stub_worlds.on_a_node)
            assert end.outcomes == {"held": worlds}, [row.cause for row in store.rows()]
            hashes[hands] = {row.world: row.trajectory_sha256 for row in store.rows()}
        ray.shutdown()
        assert hashes["ray"] == hashes["processes"] and len(set(hashes["ray"].values())) == worlds
        assert noted(store) == ["0", "0"], "each node did its share"
