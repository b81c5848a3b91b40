"""What making a shape changes or reads beside it is the same whether the shape is kept of an earlier run or not."""

import functools
import importlib
import itertools
import os
import pathlib
import random
import subprocess
import sys
import types
from pathlib import Path

import numpy as np
import pytest

from worldkit import sculpt
from worldkit.sculpt import minting

pytestmark = pytest.mark.usefixtures("kept")

BALL = sculpt.sphere(0.1)
SMALL = {"cells": 16, "texels": 64}


class Counter:
    def __init__(self):
        self.count = 0

    def __call__(self):
        self.count += 1
        return self.count / 10


def module_of(folder, sys_path, name="draws"):
    (folder / f"{name}.py").write_text(
        "import random\nRNG = random.Random(3)\n\n\ndef draw():\n    return RNG.random()\n"
    )
    sys_path(str(folder))
    importlib.invalidate_caches()
    sys.modules.pop(name, None)
    return importlib.import_module(name)


DRAWS = {
    "generator": lambda *_: np.random.default_rng(3).random,
    "generator of old": lambda *_: np.random.RandomState(3).random,
    "generator of Python": lambda *_: random.Random(3).random,
    "bits": lambda *_: functools.partial(lambda bits: np.random.Generator(bits).random(), np.random.PCG64(3)),
    "iterator": lambda *_: functools.partial(lambda turns: next(turns) / 10, itertools.count(1)),
    "own": lambda *_: Counter(),
    "module": lambda *given: functools.partial(lambda draws: draws.draw(), module_of(*given)),
}


@pytest.mark.parametrize("way", DRAWS)
def test_what_is_drawn_after_a_shape_is_the_same_in_the_next_run(tmp_path, monkeypatch, way):
    def run() -> tuple[bytes, float, bytes, str]:
        minting._memory.clear()
        draw = DRAWS[way](tmp_path, monkeypatch.syspath_prepend)
        first = sculpt.made(BALL, paint=lambda p, n: np.full(p.shape, draw()), **SMALL)
        place = draw()
        second = sculpt.made(BALL, paint=lambda p, n: np.full(p.shape, draw()) * 0.9, **SMALL)
        return first.picture.tobytes(), place, second.picture.tobytes(), first.signature

    first, again = run(), run()
    assert first == again and first[0] != first[2]


READERS = {
    "opened": "with open('tone') as file:\n        tone = file.read()",
    "by its path": "tone = pathlib.Path('to' + 'ne').read_text()",
    "by numpy": "tone = np.loadtxt('tone')",
    "under another name": "tone = grab('tone')",
    "by a helper": "tone = helper()",
    "of the machine": "import os\n    tone = os.environ['TONE']",
}


@pytest.mark.parametrize("way", READERS)
def test_what_a_paint_reads_when_it_is_called_is_read_each_time(tmp_path, monkeypatch, kept, way):
    monkeypatch.chdir(tmp_path)
    held = {"__name__": "an author's", "np": np, "pathlib": pathlib, "grab": np.genfromtxt}
    exec("def helper():\n    return pathlib.Path('tone').read_text()\n", held)
    exec(f"def paint(p, n):\n    {READERS[way]}\n    return np.full(p.shape, float(tone))\n", held)
    brightest = []
    for tone in ("0.2", "0.8"):
        Path("tone").write_text(tone)
        monkeypatch.setenv("TONE", tone)
        brightest.append(int(sculpt.made(BALL, paint=held["paint"], **SMALL).picture.max()))
    assert brightest == [51, 204] and not list(kept.glob("*.npz"))


WRITERS = {
    "global": "global LAST\n    LAST = 7",
    "no global": "global FIRST\n    del FIRST",
    "of a module": "notes.LAST = 7",
    "of a module under another name": "own = notes\n    own.LAST = 7",
    "no more of a module": "del notes.FIRST",
}


@pytest.mark.parametrize("way", WRITERS)
def test_what_a_paint_only_writes_is_written_in_every_run(tmp_path, kept, way):
    (tmp_path / "notes_of_paints.py").touch()

    def run() -> tuple[str, list[str]]:
        minting._memory.clear()
        notes = sys.modules["notes_of_paints"] = types.ModuleType("notes_of_paints")
        notes.__file__, notes.FIRST = str(tmp_path / "notes_of_paints.py"), 3
        held = {"__name__": "an author's", "notes": notes, "FIRST": 3}
        exec(f"def paint(p, n):\n    {WRITERS[way]}\n    return 0.5 + 0 * p\n", held)
        made = sculpt.made(BALL, paint=held["paint"], **SMALL)
        return made.signature, [*sorted({*held, *vars(notes)} & {"FIRST", "LAST"}), *vars(notes)]

    first, again = run(), run()
    sys.modules.pop("notes_of_paints")
    assert first == again and not list(kept.glob("*.npz"))


def test_what_a_function_around_a_paint_counts_is_counted_in_every_run():
    def run() -> int:
        minting._memory.clear()
        last = 0

        def paint(points, normals):
            nonlocal last
            last = 7
            return np.full(points.shape, 0.5)

        sculpt.made(BALL, paint=paint, **SMALL)
        return last

    assert (run(), run()) == (7, 7)


def test_a_paint_that_only_sets_what_is_its_own_is_kept(kept):
    class Stripes:
        def __init__(self, width):
            self.width = width
            self.tones = [self.width * k for k in range(3)]

        def __call__(self, points, normals):
            tone = 0.0

            def darker():
                nonlocal tone
                tone += self.width

            darker()
            return np.full(points.shape, tone)

    sculpt.made(BALL, paint=Stripes(0.1), **SMALL)
    assert len(list(kept.glob("*.npz"))) == 1


NAMES = """\
import sys

import numpy as np

from worldkit import sculpt


def plain(p, n):
    return 0.5 + 0 * p


def reading(p, n):
    return np.loadtxt("tone") + 0 * p


def writing(p, n):
    global LAST
    LAST = 0.5
    return LAST + 0 * p


PAINTS = {"bare": None, "plain": plain, "reading": reading, "writing": writing}
for name in sys.argv[1:]:
    print(name, sculpt.made(sculpt.sphere(0.1), paint=PAINTS[name], cells=16, texels=64).signature)
"""


def test_a_shape_has_one_name_in_every_process_whatever_is_kept_and_whatever_was_made_before_it(tmp_path):
    (tmp_path / "names.py").write_text(NAMES)
    (tmp_path / "tone").write_text("0.25")
    order, found = ["bare", "plain", "reading", "writing"], []
    for turn, words in (("there", order), ("there", order), ("back", order[::-1]), ("back", order[::-1])):
        cache = {**os.environ, "WORLDKIT_SCULPT_CACHE": str(tmp_path / turn)}
        call = [sys.executable, "names.py", *words]
        ended = subprocess.run(call, cwd=tmp_path, env=cache, capture_output=True, text=True, check=True)
        found.append(dict(line.split() for line in ended.stdout.splitlines()))
        assert len(list((tmp_path / turn).glob("*.npz"))) == 2
    assert found[0] == found[1] == found[2] == found[3] and len({*found[0].values()}) == 4
