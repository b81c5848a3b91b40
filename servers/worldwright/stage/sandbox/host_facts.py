"""What the kernel describes to a confined program, and what it tells of this very machine, on which no world depends.

Of /sys a program sees the processors and of each graphics card the facts that choose its driver, no more: the disks' and
USB devices' serial numbers, network addresses, a card's own number and its screens' (`vpd`, `unique_id`, `edid`) lie beside
them. A card's driver itself may still answer with a number when it is asked. Source: the kernel's sysfs-rules.rst, libdrm's
xf86drm.c, proc(5).
"""

from collections.abc import Iterator
from pathlib import Path

PROCESSORS = "devices/system"
LINKS = ("dev/char", "class/drm")
"""Folders of links, whose targets are there or not."""
CARD = (
    *("uevent", "dev", "device", "vendor", "class", "revision", "config", "subsystem", "driver", "boot_vga"),
    *("subsystem_vendor", "subsystem_device", "numa_node", "local_cpus", "local_cpulist"),
)
"""Files and links that describe a card's kind and place, in the folder of its device and in that of its node."""
EMPTY = ("/proc/sys/kernel/random/boot_id", "/proc/cmdline")
"""Files that are read as empty: the boot's number, and how it was started (disks' names among it)."""
BARE = ("/proc/bus", "/proc/scsi")
"""Folders that are empty: input devices' numbers, the disks."""
HOST_NAME = "worldwright"


def readable(root: Path = Path("/sys")) -> Iterator[Path]:
    """All that may be read of /sys: folders, files and links, none inside another."""
    yield from (root / name for name in (PROCESSORS, *LINKS) if (root / name).is_dir())
    folders: dict[Path, None] = {}
    for link in sorted((root / "class" / "drm").glob("*")):
        node, device = link.resolve(), (link / "device").resolve()
        if device / "drm" != node.parent:
            continue  # a screen's connection, whose device is its card
        # A virtual card's own parent is what says which bus it is on.
        above = (device.parent,) if device.name.startswith("virtio") else ()
        folders |= dict.fromkeys((*above, device, node))
    for folder in folders:
        yield from (path for name in CARD if (path := folder / name).is_symlink() or path.is_file())
