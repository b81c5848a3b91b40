"""Ranking by meaning, where the `semantic` extra is installed (`make test-semantic` installs it and runs these)."""

import importlib.util
import uuid
from pathlib import Path

import pytest

pytest.importorskip("lancedb")
pytest.importorskip("sentence_transformers")

from worldwright.retrieve import tools
from worldwright.retrieve.index import open_index
from worldwright.retrieve.semantic import preparing, ranker, store
from worldwright.retrieve.semantic.windows import CHARACTERS, digest, windows

pytestmark = pytest.mark.slow
_SPEC = importlib.util.spec_from_file_location("quality", Path(__file__).with_name("quality.py"))
quality = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(quality)


@pytest.fixture(scope="module", autouse=True)
def prepared():
    ranker.BACKGROUND.adopt(ranker.wait(), open_index())


def test_hybrid_beats_either_ranking_alone_and_reaches_its_goal():
    rows = quality.questions("test")
    full, near, both = (quality.measure(rows, name)[0] for name in ("full_text", "vectors", "hybrid"))
    assert both.recall_at_5 >= 0.90
    assert both.ndcg_at_10 > max(full.ndcg_at_10, near.ndcg_at_10)
    assert both.mrr > near.mrr and both.recall_at_5 >= full.recall_at_5


def test_what_is_embedded_is_never_embedded_again():
    assert preparing.missing(open_index()) == {}
    assert preparing.prepare() == 0


def test_a_new_text_costs_only_itself(tmp_path, monkeypatch):
    page = tmp_path / "notes.md"
    once = uuid.uuid4().hex  # what was ever embedded on this machine is never embedded again
    page.write_text(f"# Squeaky hinges\n\nOil the squeaky hinge of the garden gate.\n\nNote {once}.\n")
    monkeypatch.setenv("WORLDWRIGHT_SOURCES", str(tmp_path))
    assert len(preparing.missing(open_index())) == 1
    ranker.BACKGROUND.adopt(ranker.wait(), open_index())
    assert (
        tools.search("lubricate the noisy hinges of a garden door", ranking="vectors", k=1).hits[0].path == "notes.md"
    )


def test_two_builders_do_not_build_twice():
    with store.building() as mine, store.building() as other:
        assert mine and not other


def test_windows_cover_a_long_piece():
    piece = max(open_index().every(), key=lambda p: len(p.text) if p.part == "manual" else 0)
    cut = windows(piece)
    assert 1 < len(cut) <= 6 and all(len(text) < CHARACTERS + 250 for text in cut)
    assert len({digest(text) for text in cut}) == len(cut)


def test_a_damaged_store_is_made_anew(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path))
    folder = store.folder() / "windows.lance"
    folder.mkdir(parents=True)
    (folder / "_versions").write_text("nonsense")
    assert store.known() == {}
