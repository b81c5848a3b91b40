"""What is made of other things has another signature; what is made of the same has the same wherever it lies."""

import functools
import importlib
import runpy
import sys
from dataclasses import dataclass

import numpy as np
import pytest

from worldkit import sculpt
from worldkit.sculpt import brushes, minting, signatures
from worldkit.sculpt.signatures import signature

LONG = [np.linspace(0.0, 1.0, 6000).reshape(-1, 3) for _ in range(2)]
LONG[1][1000] += 0.5  # where numpy's own words leave numbers out


class Fur:
    def __init__(self, tone):
        self.tone = tone

    def __call__(self, points, normals):
        return np.full(points.shape, 0.5) * self.tone[0, 0]


@dataclass
class Coat:
    tone: np.ndarray

    def paint(self, points, normals):
        return np.full(points.shape, self.tone[0, 0])


def by_keyword(tone):
    def paint(points, normals, *, tone=tone):
        return np.full(points.shape, tone[0, 0])

    return paint


def in_a_global(value):
    return eval("lambda p, n: MASK(p)", {"MASK": value, "__name__": "somewhere"})


def attributed(tone):
    def paint(points, normals):
        return np.full(points.shape, 0.1)

    paint.tone = tone
    return paint


def blank(points, normals, tone):
    return np.full(points.shape, tone[0, 0])


WAYS = {
    "keyword": by_keyword,
    "callable": Fur,
    "partial": lambda tone: functools.partial(blank, tone=tone),
    "method": lambda tone: Coat(tone).paint,
    "dataclass": lambda tone: Coat(tone),
    "global object": lambda tone: in_a_global(Fur(tone)),
    "global partial": lambda tone: in_a_global(functools.partial(blank, tone=tone)),
    "global mask": lambda tone: in_a_global(brushes.within(sculpt.sphere(float(tone.sum())))),
    "attribute": attributed,
    "objects": lambda tone: np.array([tone, None], dtype=object),
}


@pytest.mark.parametrize("way", WAYS)
def test_other_numbers_anywhere_in_it_make_it_another_thing(way):
    first, second, again = (signature(WAYS[way](tone)) for tone in (LONG[0], LONG[1], LONG[0].copy()))
    assert first and first != second and first == again


def test_a_class_of_another_text_is_another_thing():
    words = "class Dye:\n    def __call__(self, p, n):\n        return p * {}\n"
    made = []
    for number in (0.25, 0.5, 0.25):
        held = {"__name__": "an author's"}
        exec(words.format(number), held)
        made.append(signature(held["Dye"]()))
    assert made[0] and made[0] != made[1] and made[0] == made[2]


def test_a_function_that_remembers_is_told_by_what_it_does():
    made = []
    for number in (0.25, 0.5, 0.25):
        held = {"__name__": "an author's"}
        exec(f"import functools\n@functools.cache\ndef tone():\n    return {number}\n", held)
        made.append(signature(held["tone"]))
    assert made[0] and made[0] != made[1] and made[0] == made[2]


def test_which_of_two_things_comes_again_is_told():
    a, b = Fur(LONG[0]), Fur(LONG[1])
    assert signature([a, b, a]) != signature([a, b, b])


def test_what_nobody_can_take_apart_is_made_anew_and_named_by_what_it_came_out_as(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDKIT_SCULPT_CACHE", str(tmp_path / "kept"))
    minting._memory.clear()
    tones, held = [0.2, 0.8, 0.8], (number for number in range(3))

    def paint(points, normals):
        assert held is not None
        return np.full(points.shape, tones[0])

    assert signature(paint) == ""
    made = []
    for _ in range(3):
        made.append(sculpt.made(sculpt.sphere(0.1), paint=paint, cells=16, texels=64))
        tones.pop(0)
    assert made[0].signature != made[1].signature == made[2].signature and made[1] is not made[2]
    assert not minting._memory and not (tmp_path / "kept").exists()
    strange = sculpt.Shape(sculpt.sphere(0.1).measure, np.full(3, -0.1), np.full(3, 0.1), "")
    assert strange.translate(0.1).recipe == "" and sculpt.made(strange, cells=16).signature


def test_a_file_beside_it_is_the_same_wherever_the_folder_lies_and_another_with_another_content(tmp_path, monkeypatch):
    text = "import dyes\nfrom pathlib import Path\nTABLE = Path(__file__).parent / 'tone.txt'\n"
    text += "def paint(p, n):\n    return p * dyes.A * len(TABLE.name) * len(__file__)\n"
    made = {}
    for name, tone, dye in (("a", "1", "A = 1"), ("b", "1", "A = 1"), ("c", "2", "A = 1"), ("d", "1", "A = 2")):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "tone.txt").write_text(tone)
        (folder / "dyes.py").write_text(dye)
        (folder / "paints.py").write_text(text)
        with monkeypatch.context() as here:
            here.syspath_prepend(str(folder))
            sys.modules.pop("dyes", None)  # each folder stands for a process of its own
            made[name] = signature(runpy.run_path(str(folder / "paints.py"))["paint"])
    assert made["a"] == made["b"] and len({*made.values()}) == 3


def test_a_helper_of_a_helper_counts(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(tmp_path))
    (tmp_path / "inks_outer.py").write_text("import inks_inner\n\n\ndef paint(p, n):\n    return p * inks_inner.TONE\n")
    found = []
    for tone in ("1", "22"):
        (tmp_path / "inks_inner.py").write_text(f"TONE = {tone}\n")
        importlib.invalidate_caches()
        for name in ("inks_inner", "inks_outer"):
            sys.modules.pop(name, None)
        outer = importlib.import_module(name)
        found.append(signature(lambda p, n, outer=outer: outer.paint(p, n)))
    assert found[0] and found[0] != found[1]


def test_what_stands_in_a_module_now_counts_and_not_its_text_alone(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(tmp_path))
    name = "inks_set"
    (tmp_path / f"{name}.py").write_text("TONE = 1\nOTHER = 1\n\n\ndef tone():\n    return TONE\n")
    inks = importlib.import_module(name)
    found = []
    for tone, other in ((1, 1), (2, 1), (1, 5)):
        inks.TONE, inks.OTHER = tone, other
        found.append(signature(lambda p, n: p * inks.tone()))
    assert found[0] and found[0] != found[1] and found[0] == found[2], "what is not read does not count"


@pytest.mark.parametrize(
    "words",
    [
        "import inks_late", "from inks_late import TONE", "from inks_box import inks_late", "import inks_box.inks_late as late",
        "from . import inks_late", "if n is None:\n        import inks_late",
    ],
)  # fmt: skip
def test_a_module_that_is_imported_when_it_is_called_makes_it_unknown_before_and_afterwards_and_is_not_run(
    tmp_path, monkeypatch, words
):
    (tmp_path / "inks_box").mkdir()
    monkeypatch.syspath_prepend(str(tmp_path))
    for folder in (tmp_path, tmp_path / "inks_box"):
        (folder / "inks_late.py").write_text("TONE = 1\n")
    around = "inks_around"
    (tmp_path / f"{around}.py").write_text(f"def paint(p, n):\n    {words}\n    return p\n")
    paint = importlib.import_module(around).paint
    assert signature(paint) == "" and "inks_late" not in sys.modules and "inks_box" not in sys.modules
    for late in ("inks_late", "inks_box.inks_late"):
        importlib.import_module(late)
    assert signature(paint) == ""
    for name in [name for name in sys.modules if name.startswith("inks_")]:
        sys.modules.pop(name)


def test_a_word_that_is_the_name_of_a_file_is_a_word(tmp_path, monkeypatch):
    def paint(points, normals, words=("plan.md",)):
        return points * len("plan.md") * len(words[0])

    monkeypatch.chdir(tmp_path)
    before = signature(paint)
    (tmp_path / "plan.md").write_text("a plan")
    assert before and signature(paint) == before


def test_what_a_very_large_file_holds_is_unknown(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(tmp_path))
    large = tmp_path / "table"
    with large.open("wb") as file:
        file.truncate(signatures.MOST_BYTES)
    assert signature(large)
    with large.open("ab") as file:
        file.write(b"more")
    assert signature(large) == ""


def test_a_path_that_no_file_can_have_is_told_by_its_words(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(tmp_path))
    made = {signature(str(tmp_path / name)) for name in ("a" * 300, "b" * 300, "a\0", "\ud800")}
    assert len(made) == 4 and all(made)


def test_an_import_that_fails_makes_it_unknown_and_one_of_a_library_is_known_by_name(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(tmp_path))
    (tmp_path / "inks_broken.py").write_text("raise RuntimeError\n")
    held = {"__name__": "an author's"}
    exec(
        "def broken(p, n):\n    import inks_broken\ndef good(p, n):\n    import scipy.ndimage\n    import nobody\n",
        held,
    )
    assert signature(held["broken"]) == "" and signature(held["good"])
