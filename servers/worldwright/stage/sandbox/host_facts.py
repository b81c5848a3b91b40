"""What the kernel tells of this very machine, and no world depends on: hardware addresses, serial numbers, the boot's number.

A class of devices in /sys lists links to folders elsewhere in /sys, each of which lies in a folder of the class's name
(`…/virtio2/net/eth0`), with the facts in it. Source: the kernel's sysfs-rules.rst.
"""

from collections.abc import Iterator
from pathlib import Path

CLASSES = (
    "net",
    "dmi",
    "block",
    "nvme",
    "mem",
    "mmc_host",
    "bluetooth",
    "ieee80211",
    "infiniband",
    "power_supply",
    "tpm",
)
BOOT = ("/proc/sys/kernel/random/boot_id",)
"""Files that are read as empty."""
HOST_NAME = "worldwright"


def folders(root: Path = Path("/sys")) -> Iterator[Path]:
    """The folders with such facts, to be hidden: of the classes, and of their devices."""
    found = []
    for name in CLASSES:
        top = root / "class" / name
        if top.is_dir():
            homes = (link.resolve() for link in top.iterdir())
            found += [top, *(home.parent if home.parent.name == name else home for home in homes if home.is_dir())]
    yield from dict.fromkeys(found)


def graphics(root: Path = Path("/sys")) -> Iterator[Path]:
    """What is left to read where folders can only be named and none hidden: processors, and the graphics devices."""
    for part in ("dev/char", "devices/system", "class/drm"):
        yield root / part
    for card in sorted((root / "class" / "drm").glob("*")):
        device = (card / "device").resolve()
        # A virtual card's own parent is what says which bus it is on.
        yield from (device.parent, device) if device.name.startswith("virtio") else (device,)
