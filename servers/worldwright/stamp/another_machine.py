"""What differs between the environment that a world was stamped in and this one."""

from collections.abc import Iterator

from ..model.evidence import environment
from ..model.evidence.reports import Environment
from . import processor


def differences(stamped: Environment, cpu: str, here: Environment) -> Iterator[str]:
    """What differs between the stamped environment and this one, one line each."""
    for name in ("python", "machine"):
        if getattr(stamped, name) != getattr(here, name):
            yield f"{name}: {getattr(here, name)} (stamped {getattr(stamped, name)})"
    for name in environment.PACKAGES:  # what films are made with does not move a body
        then, now = stamped.packages.get(name, "absent"), here.packages.get(name, "absent")
        if then != now:
            yield f"{name}: {now} (stamped {then})"
    for name in ("simulator", "worldkit", "catalog"):
        then, now = getattr(stamped, f"{name}_sha256"), getattr(here, f"{name}_sha256")
        if then != now:
            yield f"{name}: sha256 {now[:16]} (stamped {then[:16]})"
    if cpu and cpu != processor.cpu():
        yield f"processor: {processor.cpu()} (stamped {cpu})"
