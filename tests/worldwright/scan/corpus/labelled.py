"""Recall and false alarms over a folder of labelled recordings that were written elsewhere.

A case is `NAME.npz`, with `NAME.xml` beside it and `NAME.json`: `kind`, `anomalous`, `body` (a name, a list of names that
may be named, or nothing for the world), `start` and `end` in seconds, `needs_model`. A fault is found when a blocking or
warning finding names one of its bodies in a window that comes within `NEAR_S` of the label's. A false alarm is a
blocking finding on a clean case; its warnings are listed too.
"""

import json
import shutil
import tempfile
import time
from collections import defaultdict
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

from worldwright.model.errors import RecordingError
from worldwright.model.finding import Anomaly
from worldwright.model.recording.trajectory import WORLD_NAMES
from worldwright.model.recording.trajectory_files import read_trajectory
from worldwright.scan.anomalies import engine

NEAR_S = 0.2


class Judged(NamedTuple):
    """What the scanner said of one case."""

    name: str
    label: dict[str, Any]
    findings: tuple[Anomaly, ...]
    right: tuple[Anomaly, ...]
    refused: str
    took_s: float

    @property
    def ok(self) -> bool:
        """A fault was found, a clean case was not blocked."""
        if self.label["anomalous"]:
            return bool(self.right)
        return not self.refused and not any(a.severity == "blocking" for a in self.findings)


def accepted(label: dict[str, Any]) -> set[str]:
    """Bodies whose naming counts; the world's names where the label names none."""
    body = label.get("body") or ()
    found = {body} if isinstance(body, str) else set(body)
    return found or set(WORLD_NAMES)


def judge(path: Path, model: bool) -> Judged:
    """Scan one case, with its model or without."""
    label = json.loads(path.with_suffix(".json").read_text())
    began = time.perf_counter()
    try:
        with tempfile.TemporaryDirectory() as folder:
            alone = path if model else Path(shutil.copy(path, folder))
            report = engine.scan(read_trajectory(alone))
    except RecordingError as refusal:
        return Judged(path.stem, label, (), (), str(refusal), time.perf_counter() - began)
    told = tuple(a for a in report.anomalies if a.severity in ("blocking", "warn"))
    names = accepted(label)
    start, end = label.get("start", 0) or 0, label.get("end", 1e300)
    right = tuple(
        a for a in told if a.body in names and a.window_s[0] <= end + NEAR_S and a.window_s[1] >= start - NEAR_S
    )
    return Judged(path.stem, label, told, right, "", time.perf_counter() - began)


def measure(folder: Path, model: bool = True, verbose: bool = False, only: tuple[str, ...] = ()) -> int:
    """Print what was missed, what was falsely blocked, and a table by kind; 1 when anything is wrong."""
    cases = sorted(path for path in folder.glob("*.npz") if not only or path.stem in only)
    if not model:
        cases = [path for path in cases if not json.loads(path.with_suffix(".json").read_text()).get("needs_model")]
    with ProcessPoolExecutor(2) as pool:
        judged = list(pool.map(judge, cases, [model] * len(cases)))
    kinds: dict[str, list[bool]] = defaultdict(list)
    for one in judged:
        label = one.label
        if label["anomalous"]:
            kinds[label["kind"]].append(one.ok)
        if verbose or not one.ok:
            what = "fault" if label["anomalous"] else "clean"
            print(
                f"{'ok    ' if one.ok else 'WRONG '} {what} {one.name} {label['kind']}: {one.refused or label['body']}"
            )
            for a in one.findings if verbose or label["anomalous"] else ():
                print(
                    f"         {a.severity:8} {a.name} {a.body} {a.window_s[0]:.3f}-{a.window_s[1]:.3f} {a.message[:110]}"
                )
        if not label["anomalous"]:
            for a in one.findings:
                if a.severity == "blocking" or not verbose:
                    print(
                        f"   {one.name} {label['kind']}: {a.severity} {a.name} {a.body} {a.window_s} {a.message[:110]}"
                    )
    for kind, found in sorted(kinds.items()):
        print(f"{kind:34} {sum(found)} of {len(found)}")
    faults = [one for one in judged if one.label["anomalous"]]
    clean = [one for one in judged if not one.label["anomalous"]]
    print(
        f"{'with the model' if model else 'poses alone'}: {sum(o.ok for o in faults)} of {len(faults)} found", end=", "
    )
    print(f"{sum(not o.ok for o in clean)} of {len(clean)} clean blocked", end=", ")
    print(f"{sum(bool(o.findings) for o in clean)} clean with a warning", end="; ")
    took = sorted(one.took_s for one in judged)
    print(f"median {took[len(took) // 2]:.2f} s, longest {took[-1]:.2f} s a case")
    return 0 if all(one.ok for one in judged) else 1
