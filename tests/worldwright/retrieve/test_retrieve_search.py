"""Real questions find their place in the manual; citations open; damage is repaired."""

import json
import math
import shutil
import threading

import numpy as np
import pytest
from click.testing import CliRunner
from hypothesis import given, settings
from hypothesis import strategies as st

from worldwright import cli, expose
from worldwright.model import call_time
from worldwright.model.errors import NotFoundError
from worldwright.retrieve import corpus, index, lexical, tools
from worldwright.simulator import cache

QUESTIONS = [
    ("sliding friction of a geom", {"body-geom-friction", "sliding-rolling-spinning-down"}),
    ("how do I make a conveyor belt", {"body-geom-surfacevel"}),
    ("fast objects pass through thin walls", {"CTunneling", "option-flag-speculative", "coSpeculative"}),
    ("what are the arguments of mj_ray", {"mj_ray"}),
    ("what replaced the composite cable", {"version-4-0-0"}),
    ("set the initial velocity with a keyframe", {"keyframe-key-qvel", "keyframe", "keyframe-key"}),
    ("restitution: how bouncy is a contact", {"CRestitution"}),
    ("energy is always zero", {"option-flag-energy"}),
    ("which geoms collide: contype conaffinity", {"body-geom-contype", "collision-filtering-bitmasks"}),
    ("attach a model to a spec with a prefix", {"body-attach-prefix", "3-sub-model-composition-attachments"}),
    ("simulation diverges, NaN in qacc", {"Divergence", "siErrorRecovery"}),
    ("headless rendering without a display", {"2-headless-contexts-on-linux-mujoco-gl"}),
    ("a spring that yields and stays bent", {"body-joint-springyield", "tendon-spatial-springyield"}),
    (
        "buoyancy and drag in a fluid",
        {"viscous-drag", "body-geom-fluidcoef", "summary", "flEllipsoid", "flInertia", "buoyancy"},
    ),
    ("size of a box geom, half sizes", {"body-geom-size", "geom-dimensions-reference"}),
    ("damping of a hinge joint", {"body-joint-damping"}),
    ("control between mj_step1 and mj_step2", {"stepping-pipeline-mj-step-vs-mj-step1-mj-step2", "mj_step1"}),
    ("number of samples of the offscreen buffer, anti-aliasing", {"visual-quality-offsamples"}),
    ("WL115", {"WL115"}),
    ("cam_orthographic", {"version-3-5-0"}),
]


def anchors(question, k=5):
    return [hit.citation.split("#")[1].rsplit(":", 1)[0] for hit in tools.search(question, k=k).hits]


@pytest.mark.parametrize(("question", "gold"), QUESTIONS, ids=[q for q, _ in QUESTIONS])
def test_the_answer_is_among_the_first_five(question, gold):
    assert gold & set(anchors(question))


def test_every_hit_can_be_opened_and_holds_its_own_words():
    for question, _ in QUESTIONS:
        for hit in tools.search(question, k=3).hits:
            passage = tools.read(hit.citation)
            assert passage.citation == hit.citation
            assert passage.content.strip() and hit.path in hit.citation


def test_json_has_the_promised_shape():
    result = CliRunner().invoke(cli.main, ["retrieve", "search", "friction of a geom", "-k", "10", "--format", "json"])
    assert result.exit_code == 0
    hits = json.loads(result.stdout)["hits"]
    assert len(hits) == 10
    assert {"citation", "path", "text", "score"} <= set(hits[0])
    assert not hits[0]["path"].startswith("/") and hits == sorted(hits, key=lambda hit: -hit["score"])


def test_parts_can_be_searched_alone():
    assert all("changelog.rst" in hit.path for hit in tools.search("flex elasticity", part="changelog").hits)
    assert all("skills/" in hit.path for hit in tools.search("attach", part="skills").hits)


@settings(max_examples=80, deadline=None)
@given(st.text(max_size=80))
def test_any_question_is_answered(question):
    result = tools.search(question, k=3)
    assert len(result.hits) <= 3 and result.text() is not None


@pytest.mark.parametrize(
    "question", ['"', "AND OR NOT", "NEAR(a b)", "*", "a" * 100_000, "", "title:x", "-", "mj_step*"]
)
def test_query_syntax_is_only_words(question):
    tools.search(question)


def test_results_stay_small():
    for question in ("the model", "elasticity flex rod young shear bending twist plugin cable composite migration"):
        assert len(expose.to_json(tools.search(question, k=25))) < 25_000
    assert len(expose.to_json(tools.read("doc/XMLreference.rst"))) < 20_000
    assert len(expose.to_json(tools.breaking_changes("all", k=30))) < 20_000


def test_citations_in_every_form():
    whole = tools.read("mujoco-4.0.0/doc/XMLreference.rst#body-geom-friction")
    assert "sliding friction" in whole.content and whole.content.lstrip().startswith(".. _body-geom-friction:")
    assert tools.read("XMLreference.rst#body-geom-friction").content == whole.content
    assert tools.read(whole.citation).content == whole.content
    older = tools.read("mujoco-3.9.0/doc/XMLreference.rst#body-geom-friction:L10-L12")
    assert older.content == whole.content and "3.9.0 was cited" in older.note
    page = tools.read("doc/python.rst")
    assert page.first == 1 and page.next
    assert tools.read(page.next).first == page.last + 1
    assert tools.read("doc/python.rst:L5", around=2).first == 3


@pytest.mark.parametrize(
    "citation",
    [
        "",
        "doc/nothing.rst",
        "doc/XMLreference.rst#no-such-anchor",
        "doc/python.rst:L999999",
        "../../../etc/passwd",
        "/etc/passwd",
        "mujoco-4.0.0/doc/../__init__.py",
    ],
)
def test_what_cannot_be_opened_says_so(citation):
    with pytest.raises(NotFoundError) as caught:
        tools.read(citation)
    assert caught.value.next_move


def test_a_damaged_index_is_built_again(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path))
    path = index.index_path(corpus.fingerprint())
    assert path.parent == tmp_path
    path.write_bytes(b"SQLite format 3\0" + b"x" * 5000)
    index._usable.cache_clear()
    assert tools.search("friction").hits
    assert path.stat().st_size > 1_000_000


def test_many_readers_build_one_index(tmp_path, monkeypatch):
    """One of them builds it when all have asked, and the others wait."""
    ready = index.open_index().path
    monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path))
    monkeypatch.setattr(index, "PATIENCE_S", 300.0)  # however busy the machine is
    answers, built, asked, all_asked, held = [], [], [], threading.Event(), index.held

    def ask(*words):
        asked.append(words)
        if len(asked) == 4:
            all_asked.set()
        return held(*words)

    def build(path, *_):
        assert all_asked.wait(300.0)
        built.append(path)
        shutil.copy(ready, path)  # the whole one, which another test builds

    monkeypatch.setattr(index, "held", ask)
    monkeypatch.setattr(index, "_build", build)
    threads = [threading.Thread(target=lambda: answers.append(anchors("sliding friction", 1))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) == 4 and len({tuple(a) for a in answers}) == 1 and len(built) == 1
    assert len(list(tmp_path.glob("retrieve-*.sqlite"))) == 1 and not list(tmp_path.glob(".retrieve-*"))


def test_who_waits_in_vain_for_another_builder_builds_it_all_the_same(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path))
    built = []
    monkeypatch.setattr(corpus, "fingerprint", lambda: "0" * 64)
    monkeypatch.setattr(corpus, "documents", list)
    monkeypatch.setattr(index, "_build", lambda path, *_: built.append(path))
    with cache.held("retrieve.lock"), call_time.limited(0.2):
        index.open_index()
    assert len(built) == 1


def test_status_counts_what_is_there():
    status = tools.status()
    assert status.pieces["manual"] > 1500 and status.pieces["changelog"] > 500 and status.pieces["rules"] >= 40
    assert status.changes > 150 and "XMLschema.rst" in status.left_out


def test_the_shares_of_the_score_are_those_of_the_definition():
    """BM25F, term by term: an occurrence counts by its field, less in a long field, and less the more there are."""
    said = [
        (["ball"], [], ["ball", "falls", "falls"]),
        ([], ["floor", "ball"], ["falls"]),
        (["floor"], [], ["ball", "rolls"]),
    ]
    stored = {
        term: (np.frombuffer(numbers, np.int32).tolist(), np.frombuffer(part, np.float32).tolist())
        for term, numbers, part in lexical.shares(said)
    }
    assert {term: numbers for term, (numbers, _) in stored.items()} == {
        "ball": [1, 2, 3], "falls": [1, 2], "floor": [2, 3], "rolls": [3],
    }  # fmt: skip
    means = [max(1.0, sum(len(window[n]) for window in said) / 3) for n in range(3)]
    for term, (numbers, part) in stored.items():
        for number, share in zip(numbers, part, strict=True):
            tf = sum(
                row.weight * field.count(term) / (1 - row.length + row.length * len(field) / mean)
                for row, field, mean in zip(lexical.FIELDS, said[number - 1], means, strict=True)
            )
            rare = math.log(1 + (3 - len(numbers) + 0.5) / (len(numbers) + 0.5))
            assert share == pytest.approx(rare * (lexical.SATURATION + 1) * tf / (tf + lexical.SATURATION), rel=1e-5)
    assert list(lexical.shares([])) == []
