"""Precision and recall of the checks over the corpus, as a table.

    python tests/worldwright/scan/corpus/measure.py [--bare] [--poses] [NAME…]
    python tests/worldwright/scan/corpus/measure.py FOLDER [--bare] [-v] [NAME…]

With a folder, the labelled recordings in it are judged instead (see `labelled`).
`--bare` leaves the MJCF away, `--poses` the optional channels too. A fault counts as found when one of its checks
reports it as blocking; a clean world is spoiled by any blocking finding.
"""

import argparse
import sys
import tempfile
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

import clean
import faulty
import labelled
from simulate import World, write

from worldwright.model.errors import RecordingError
from worldwright.model.evidence.reports import ScanReport
from worldwright.model.recording.trajectory_files import read_trajectory
from worldwright.scan.anomalies import engine


def report(world: World, folder: Path, optional: bool = True, model: bool = True) -> ScanReport | RecordingError:
    """What the scanner says of one world."""
    path = write(world, folder, optional, model)
    try:
        return engine.scan(read_trajectory(path))
    except RecordingError as refusal:
        return refusal


def blocking(found: ScanReport | RecordingError) -> set[str]:
    """Names of the checks that block; a refused recording blocks as `recording`."""
    if isinstance(found, RecordingError):
        return {"recording"}
    return {a.name for a in found.anomalies if a.severity == "blocking"}


def warned(found: ScanReport | RecordingError) -> set[str]:
    """Names of the checks that block or warn."""
    return blocking(found) | {a.name for a in getattr(found, "anomalies", ()) if a.severity == "warn"}


def main() -> int:
    """Print the table; 1 when a fault is missed or a clean world spoiled."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--bare", action="store_true")
    parser.add_argument("--poses", action="store_true")
    parser.add_argument("-v", action="store_true")
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    if options.names and Path(options.names[0]).is_dir():
        only = tuple(options.names[1:])
        return labelled.measure(Path(options.names[0]), not options.bare, options.v, only)
    right: Counter[str] = Counter()
    wrong: Counter[str] = Counter()
    missed = []
    with tempfile.TemporaryDirectory() as folder:
        for world in (*clean.worlds(), *faulty.worlds()):
            if options.names and world.name not in options.names:
                continue
            if (options.bare or options.poses) and world.needs_model:
                continue
            if options.poses and world.needs:
                continue
            found = report(world, Path(folder), not options.poses, not (options.bare or options.poses))
            names = blocking(found) if not world.fault or world.name not in faulty.WARNED else warned(found)
            right.update(names & set(world.fault))
            wrong.update(names if not world.fault else ())
            if bool(world.fault) != bool(names & set(world.fault)) or (names and not world.fault):
                missed.append(world.name)
                print(f"{'missed' if world.fault else 'SPOILED':8} {world.name:28} {sorted(names)}", flush=True)
                if options.v or not world.fault:
                    for a in getattr(found, "anomalies", ()):
                        print("            ", a.severity, a.name, a.window_s, a.message[:140])
            elif options.v:
                print(f"ok       {world.name:28} {sorted(names)}", flush=True)
    print(f"{'check':28} found  false")
    for name in sorted({*right, *wrong}):
        print(f"{name:28} {right[name]:5}  {wrong[name]:5}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
