"""A confined program does not learn which machine it runs on: no hardware address, no serial number, no boot, no host's name."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from worldwright.stage import confined, sandbox
from worldwright.stage.sandbox import bubblewrap, host_facts, landlock
from worldwright.stage.sandbox.confinement import SYSTEM, Confinement

LOOK = """
import json, os, pathlib, sys
def read(path):
    try:
        return path.read_text(errors="replace").strip()
    except OSError:
        return ""
seen = {str(p): read(p) for name in ("net", "dmi", "block") for p in pathlib.Path("/sys/class", name).glob("*/*") if p.is_file()}
direct = {path: read(pathlib.Path(path)) for path in json.loads(sys.argv[2])}
json.dump({"classes": seen, "direct": direct, "node": os.uname().nodename}, open(sys.argv[1], "w"))
"""


def test_what_tells_one_machine_from_another_is_hidden() -> None:
    addresses = [str(path.resolve() / "address") for path in Path("/sys/class/net").glob("*")]
    serials = [str(path) for name in ("serial", "wwid", "vpd", "edid") for path in Path("/sys/devices").rglob(name)]
    asked = [*addresses, *host_facts.EMPTY, *serials]
    assert any(Path(path).read_text().strip() for path in asked if Path(path).is_file())
    call = [sys.executable, "-I", "-S", "-c", LOOK, "{out}/seen.json", json.dumps(asked)]
    done = confined.run(call, wanted=("seen.json",))
    if done.level not in ("bubblewrap", "landlock"):
        pytest.skip(f"no level confines here: {done.status}")
    seen = json.loads(done.files["seen.json"])
    assert seen["classes"] == {} and not any(seen["direct"].values()), seen
    if done.level == "bubblewrap":
        assert seen["node"] == host_facts.HOST_NAME


TOLD = {"devices/system/cpu": ("online",), "devices/pci0/0000:00:02.0": ("vendor", "uevent"),
        "devices/pci0/0000:00:02.0/drm/card0": ("dev",), "devices/pci0/0000:00:05.0": ("vendor",),
        "devices/pci0/0000:00:05.0/virtio4": ("uevent",), "devices/pci0/0000:00:05.0/virtio4/drm/card1": ("dev",)}  # fmt: skip
KEPT = {"devices/virtual/net/lo": ("address",), "devices/pci0/0000:00:03.0/virtio2/net/eth0": ("address",),
        "devices/pci0/0000:00:04.0": ("vpd",), "devices/pci0/0000:00:04.0/host0/0:0:0:0": ("wwid",),
        "devices/pci0/0000:00:04.0/host0/0:0:0:0/block/sda": ("dev",),
        "devices/pci0/0000:00:04.0/host0/0:0:0:0/block/sda/sda1": ("partition", "uevent"),
        "devices/pci0/0000:00:14.0/usb1/1-1": ("serial",), "devices/virtual/dmi/id": ("product_uuid",),
        "devices/pci0/0000:00:02.0": ("vpd", "unique_id", "serial_number"),
        "devices/pci0/0000:00:02.0/drm/card0/card0-HDMI-A-1": ("edid", "uevent")}  # fmt: skip
LINKED = ("net/lo", "net/eth0", "block/sda", "drm/card0", "drm/card1", "drm/card0-HDMI-A-1")


@pytest.fixture
def kernel(tmp_path: Path) -> Path:
    """A part of /sys: network devices, a disk with a partition, a USB device, two graphics cards and a screen."""
    for folder, names in (*TOLD.items(), *KEPT.items()):
        (tmp_path / folder).mkdir(parents=True, exist_ok=True)
        for name in names:
            (tmp_path / folder / name).write_text(f"{name} of {folder}")
    real = {path.name: path for path in (tmp_path / "devices").rglob("*")}
    for name in (*LINKED, "block/sda1"):
        (tmp_path / "class" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "class" / name).symlink_to(real[name.partition("/")[2]])
    for node, device in (("card0", "0000:00:02.0"), ("card1", "virtio4"), ("card0-HDMI-A-1", "card0")):
        (real[node] / "device").symlink_to(real[device])
    (tmp_path / "bus/pci").mkdir(parents=True)
    (tmp_path / "bus/pci/secret").write_text("secret")
    (real["0000:00:02.0"] / "subsystem").symlink_to("../../../bus/pci")
    return tmp_path


@pytest.mark.parametrize("level", [name for name in sandbox.CONFINING if not sandbox.unusable(name)])
def test_of_a_machine_with_disks_screens_and_usb_a_program_reads_the_processors_and_the_cards_kinds(
    level: str, kernel: Path
) -> None:
    asked = [f"{folder}/{name}" for part in (TOLD, KEPT) for folder, names in part.items() for name in names]
    asked += ["class/drm/card0/device/vendor", "class/net/eth0/address", "bus/pci/secret"]
    script = 'for f; do cat "$f" >/dev/null 2>&1 && echo "$f"; done; readlink devices/pci0/0000:00:02.0/subsystem'
    call = ["sh", "-c", script, "sh", *asked]
    if level == "bubblewrap":
        shown = bubblewrap.as_it_is([*map(Path, SYSTEM), *host_facts.readable(kernel)])
        call = ["bwrap", "--unshare-all", *shown, "--dev", "/dev", "--remount-ro", "/", "--chdir", str(kernel), *call]
        done = subprocess.run(call, capture_output=True, text=True, check=False)
    else:
        rules = [(Path(name), landlock.RUN) for name in SYSTEM] + [
            (Path("/dev/null"), landlock.READ_FILE | landlock.WRITE_FILE)
        ]
        rules += landlock._described(kernel)
        confine = lambda: landlock.restrict(rules)  # noqa: E731
        done = subprocess.run(call, cwd=kernel, preexec_fn=confine, capture_output=True, text=True, check=False)
    assert not done.stderr
    seen = set(done.stdout.split())
    told = {f"{folder}/{name}" for folder, names in TOLD.items() for name in names}
    assert seen == told | {"class/drm/card0/device/vendor", "../../../bus/pci"}


def test_no_rule_of_landlock_reaches_a_network_device() -> None:
    here = Path(__file__).parent
    wanted = Confinement(out=here, reads=(), scratch=here, cpu_s=1, file_bytes=1, memory_bytes=1)
    ruled = [path.resolve() for path, _ in landlock._rules(wanted)]
    devices = [path.resolve() for path in Path("/sys/class/net").glob("*")]
    assert not any(device.is_relative_to(path) for device in devices for path in ruled if path != Path("/"))
