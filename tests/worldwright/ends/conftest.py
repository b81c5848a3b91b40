"""An accepted world with one control, laid out as acceptance lays it out, without the walk that leads there."""

import dataclasses
import hashlib
import json
import runpy
from collections.abc import Callable
from pathlib import Path

import pytest

from small_worlds import record
from worldengine.recording import stored
from worldkit import portable, sliding

EXAMPLE = Path(__file__).parents[3] / "examples/slack-rope-pulls-box"
SIZE = (160, 90)
EVERY = 10
"""Steps of 1 ms from one action to the next."""


@dataclasses.dataclass(frozen=True)
class Roped:
    """The run of the roped box, and the recording that it was accepted with."""

    run: Path
    recording: stored.Recording


def sealed(run: Path) -> None:
    """Write the part of a stamp that lists the files."""
    accepted = run / "accepted"
    files = [path for path in accepted.rglob("*") if path.is_file() and path.name != "stamp.json"]
    hashes = {str(path.relative_to(accepted)): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}
    rows = [{"name": name, "digest": {"sha256": digest}} for name, digest in hashes.items()]
    (accepted / "stamp.json").write_text(json.dumps({"subject": rows}))


@pytest.fixture(scope="session")
def seal() -> Callable[[Path], None]:
    return sealed


@pytest.fixture(scope="session")
def roped(tmp_path_factory: pytest.TempPathFactory) -> Roped:
    run = tmp_path_factory.mktemp("roped") / "rope"
    facts = run / "accepted/world"
    facts.mkdir(parents=True)
    for place in (run, run / "accepted"):
        (place / "plan.md").write_bytes((EXAMPLE / "plan.md").read_bytes())
    program = runpy.run_path(str(EXAMPLE / "simulation.py"))
    spec = program["build"]()
    sliding.add_pairs(spec, spec.compile())
    portable.write(spec, run / "accepted/world.mjz")
    said = {"duration": 4.0, "fps": 24, "size": SIZE, "movers": ["box", "trolley"], "visual_only": [], "seed": 0}
    (facts / "program.json").write_text(
        json.dumps({**said, "control": "control", "control_every": EVERY, "latency": 0, "laws": []})
    )
    (facts / "inputs.json").write_text(json.dumps([{"kind": "control", "bodies": ["pull"]}]))
    model = portable.read(run / "accepted/world.mjz")
    rows = (("control", frozenset({"pull"})),)
    recording = record(model, run / "recording", 4000, program["control"], rows=rows, control_every=EVERY)
    (facts / "inputs.arrows").write_bytes((recording.folder / "inputs.arrows").read_bytes())
    sealed(run)
    return Roped(run, recording)
