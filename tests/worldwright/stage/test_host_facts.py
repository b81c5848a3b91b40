"""A confined program does not learn which machine it runs on: no hardware address, no serial number, no boot, no host's name."""

import json
import sys
from pathlib import Path

import pytest

from worldwright.stage import confined
from worldwright.stage.sandbox import host_facts, landlock

LOOK = """
import json, os, pathlib, sys
def read(path):
    try:
        return path.read_text().strip()
    except OSError:
        return ""
seen = {str(p): read(p) for name in ("net", "dmi", "block") for p in pathlib.Path("/sys/class", name).glob("*/*") if p.is_file()}
direct = {path: read(pathlib.Path(path)) for path in json.loads(sys.argv[2])}
json.dump({"classes": seen, "direct": direct, "node": os.uname().nodename}, open(sys.argv[1], "w"))
"""


def test_what_tells_one_machine_from_another_is_hidden() -> None:
    addresses = [str(path.resolve() / "address") for path in Path("/sys/class/net").glob("*")]
    asked = [*addresses, *host_facts.BOOT]
    assert any(Path(path).read_text().strip() for path in asked if Path(path).is_file())
    call = [sys.executable, "-I", "-S", "-c", LOOK, "{out}/seen.json", json.dumps(asked)]
    done = confined.run(call, wanted=("seen.json",))
    if done.level not in ("bubblewrap", "landlock"):
        pytest.skip(f"no level confines here: {done.status}")
    seen = json.loads(done.files["seen.json"])
    assert seen["classes"] == {} and not any(seen["direct"].values()), seen
    if done.level == "bubblewrap":
        assert seen["node"] == host_facts.HOST_NAME


@pytest.fixture
def kernel(tmp_path: Path) -> Path:
    """A part of /sys: a network device on a bus, a virtual one, and two graphics cards."""
    bus = tmp_path / "devices" / "pci0000:00"
    for folder in (bus / "0000:00:03.0/virtio2/net/eth0", tmp_path / "devices/virtual/net/lo", bus / "0000:00:02.0/drm/card0",
                   bus / "0000:00:05.0/virtio4/drm/card1", tmp_path / "class/net", tmp_path / "class/drm"):  # fmt: skip
        folder.mkdir(parents=True)
    (tmp_path / "class/net/eth0").symlink_to(bus / "0000:00:03.0/virtio2/net/eth0")
    (tmp_path / "class/net/lo").symlink_to(tmp_path / "devices/virtual/net/lo")
    for card, device in (("card0", bus / "0000:00:02.0"), ("card1", bus / "0000:00:05.0/virtio4")):
        (tmp_path / "class/drm" / card).symlink_to(device / "drm" / card)
        (device / "drm" / card / "device").symlink_to(device)
    return tmp_path


def test_the_folders_of_the_devices_themselves_are_hidden_wherever_they_are(kernel: Path) -> None:
    found = {path.relative_to(kernel).as_posix() for path in host_facts.folders(kernel)}
    assert found == {"class/net", "devices/virtual/net", "devices/pci0000:00/0000:00:03.0/virtio2/net"}


def test_where_nothing_can_be_hidden_only_processors_and_graphics_are_named(kernel: Path) -> None:
    found = {path.relative_to(kernel).as_posix() for path in host_facts.graphics(kernel)}
    bus = "devices/pci0000:00"
    cards = {f"{bus}/0000:00:02.0", f"{bus}/0000:00:05.0", f"{bus}/0000:00:05.0/virtio4"}
    assert found == {"dev/char", "devices/system", "class/drm"} | cards


def test_no_rule_of_landlock_reaches_a_network_device() -> None:
    from worldwright.stage.sandbox.confinement import Confinement

    here = Path(__file__).parent
    wanted = Confinement(out=here, reads=(), scratch=here, cpu_s=1, file_bytes=1, memory_bytes=1)
    ruled = [path.resolve() for path, _ in landlock._rules(wanted)]
    devices = [path.resolve() for path in Path("/sys/class/net").glob("*")]
    assert not any(device.is_relative_to(path) for device in devices for path in ruled if path != Path("/"))
