"""How much of a labelled corpus of programs lint finds: `python tests/worldwright/lint/corpus_measure.py FOLDER`.

FOLDER holds `cases/NAME.py` (or `.xml`) and `labels.json`: per faulty program its `kind`, the `line` of the fault, the `use_line` where
it takes effect and other lines (`also`) that a person would accept. A fault counts as found when a warning or an error
stands within one line of those; as elsewhere when one stands anywhere else in the file, which is for a reader to judge.
Programs without a kind are sound: any warning or error on them is a false alarm.
"""

import argparse
import json
import time
from collections.abc import Iterator
from pathlib import Path

from worldwright.lint import engine
from worldwright.model.finding import Finding

NEAR = 1
"""Lines that a finding may be off."""


def speaking(path: Path, model: bool | None) -> tuple[list[Finding], str, float]:
    """Warnings and errors on one program, how running it went, and the time taken, s."""
    began = time.monotonic()
    found, said = engine.check_program_file(path, None, None, model)
    return [f for f in found if f.severity != "info"], said, time.monotonic() - began


def accepted(label: dict) -> set[int]:
    """Lines on which a finding names the fault."""
    return {line for line in (label.get("line"), label.get("use_line"), *(label.get("also") or ())) if line}


def verdict(label: dict, found: list[Finding]) -> str:
    """`found`, `elsewhere` or `missed`."""
    lines = accepted(label)
    if any(f.line and abs(f.line - line) <= NEAR for f in found for line in lines):
        return "found"
    return "elsewhere" if found else "missed"


def case(folder: Path, name: str) -> Path:
    """The program or MJCF file of a case."""
    script = folder / "cases" / f"{name}.py"
    return script if script.exists() else script.with_suffix(".xml")


def rows(
    folder: Path, only: list[str], model: bool | None
) -> Iterator[tuple[str, dict, str, list[Finding], str, float]]:
    """Each case: name, label, verdict, findings, word about the run, seconds."""
    labels = json.loads((folder / "labels.json").read_text("utf-8"))
    for name, label in labels.items():
        if only and name not in only:
            continue
        found, said, seconds = speaking(case(folder, name), model)
        word = verdict(label, found) if label.get("kind") else "alarm" if found else "quiet"
        yield name, label, word, found, said, seconds


def main() -> None:
    """Print a line a case and the sums."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("folder", type=Path)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--read-only", action="store_true", help="do not run or build anything")
    parser.add_argument("--twins", action="store_true", help="also look at NAME.fixed.py, which is sound")
    wanted = parser.parse_args()
    model = False if wanted.read_only else None
    sums: dict[str, int] = {}
    slowest = total = 0.0
    for name, label, word, found, said, seconds in rows(wanted.folder, wanted.names, model):
        sums[word] = sums.get(word, 0) + 1
        slowest, total = max(slowest, seconds), total + seconds
        codes = ", ".join(f"{f.code}:{f.line}" for f in found)
        print(f"{name} {word:9} {label.get('kind') or 'sound':34} {codes} [{said.partition(': ')[2]}]", flush=True)
        twin = wanted.folder / "cases" / f"{name}.fixed.py"
        if wanted.twins and twin.exists():
            alarms, _, _ = speaking(twin, model)
            sums["twin alarms"] = sums.get("twin alarms", 0) + bool(alarms)
            if alarms:
                print(
                    f"{name} twin alarm: " + ", ".join(f"{f.code}:{f.line} {f.message[:90]}" for f in alarms),
                    flush=True,
                )
    print(sums, f"{total:.0f} s in all, {slowest:.1f} s at most")


if __name__ == "__main__":
    main()
