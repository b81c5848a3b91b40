"""Every kind of document is cut along its structure, and every piece opens at its own lines."""

import itertools
import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldwright.retrieve import (
    c_chunks,
    corpus,
    forum_chunks,
    introspect_chunks,
    markdown_chunks,
    python_chunks,
    rst_chunks,
    rule_chunks,
    tools,
    xml_chunks,
    yaml_chunks,
)
from worldwright.retrieve.index import open_index

HEADER = """
//---------------------------------- Ray casting ----------------------------------

// Intersect a ray with all geoms;
// return distance.
MJAPI mjtNum mj_ray(const mjModel* m, const mjData* d,
                    const mjtNum pnt[3]);

typedef enum mjtThing {      // kinds of thing
  mjTHING_A = 0,             // the first
} mjtThing;

typedef struct mjOne_ {      // one
  int size;                  // its size
} mjOne;

int later(int x) {
  return x + 1;
}
"""


def test_a_header_is_cut_into_its_declarations():
    found = {chunk.anchor: chunk for chunk in c_chunks.chunks(HEADER)}
    assert set(found) == {"mj_ray", "mjtThing", "mjOne", "later"}
    assert "return distance" in found["mj_ray"].text and "pnt[3]" in found["mj_ray"].text
    assert found["mj_ray"].title == "Ray casting > mj_ray"
    assert (found["later"].start, found["later"].end) == (17, 19)


def test_python_is_cut_into_its_definitions():
    text = '"""A module."""\n\ndef add(a: int,\n        b: int) -> int:\n    """Sum."""\n    return a + b\n\nclass Box:\n    """A box."""\n\n    def open(self):\n        """Open it."""\n\n    def _hidden(self):\n        """No."""\n'
    found = {chunk.anchor: chunk for chunk in python_chunks.chunks(text, "pack.module")}
    assert set(found) == {"module", "add", "Box", "Box.open"}
    assert found["add"].text == "def add(a: int, b: int) -> int:\nSum."
    shown = {chunk.anchor: chunk for chunk in python_chunks.chunks(text, "pack.module", source=True)}
    assert "return a + b" in shown["add"].text


def test_the_engine_describes_itself():
    found = {d.path: {c.anchor: c for c in d.chunks()} for d in corpus.documents() if d.path.startswith("introspect/")}
    ray = found["introspect/functions.py"]["mj_ray"]
    assert ray.text.startswith("mjtNum mj_ray(const mjModel* m, const mjData* d, const mjtNum[3] pnt")
    assert "mjGEOM_BOX = " in found["introspect/enums.py"]["mjtGeom"].text
    assert "timestep: mjtNum" in found["introspect/structs.py"]["mjOption"].text


def test_markdown_is_cut_at_its_headings_but_not_inside_a_fence():
    text = "---\nname: x\n---\n# Top\n\nWords.\n\n## One ##\n\n````markdown\n# Not one\n```yaml\n# nor this\n```\n````\n\n### Deep\nx\n\n## Two\ny\n"
    found = [(chunk.anchor, chunk.title, chunk.start, chunk.end) for chunk in markdown_chunks.chunks(text)]
    assert found == [
        ("top", "", 1, 3),
        ("top", "Top", 4, 7),
        ("one", "Top > One", 8, 16),
        ("deep", "Top > One > Deep", 17, 19),
        ("two", "Top > Two", 20, 21),
    ]


def test_a_forum_thread_is_cut_into_its_posts():
    line = '{"number": 7, "title": "NaN", "url": "u", "posts": [{"body": "why"}, {"body": "so", "answer": true}, {"body": ""}]}'
    found = list(forum_chunks.chunks(f"not json\n[]\n{line}\n"))
    assert [(c.anchor, c.start, c.text.split(":")[0]) for c in found] == [
        ("thread-7", 3, "question"),
        ("thread-7", 3, "accepted answer"),
    ]


def test_a_large_model_is_cut_at_the_children_of_its_root():
    text = "<mujoco>\n" + "".join(f'  <body name="b{n}">\n    <geom/>\n  </body>\n' for n in range(400)) + "</mujoco>\n"
    found = list(xml_chunks.chunks(text, "model"))
    assert len(found) > 3 and found[0].start == 1 and found[-1].end == text.count("\n")
    assert all(a.end + 1 == b.start for a, b in itertools.pairwise(found))


def test_every_part_has_pieces_and_they_open():
    index = open_index()
    pieces = list(index.every())
    assert set(corpus.PARTS) - {"sources"} <= {piece.part for piece in pieces}
    for piece in random.Random(0).sample(pieces, 150):
        passage = tools.read(piece.citation)
        assert passage.content.strip()
        whole = passage.citation == piece.citation
        assert whole or (passage.next and passage.citation.rpartition("-")[0] == piece.citation.rpartition("-")[0])


@settings(max_examples=60, deadline=None)
@given(st.text(alphabet="ab(){};/*\n\"'<>:-=.#_ \t0", max_size=400))
def test_no_text_breaks_a_cutter(text):
    lines = max(1, text.count("\n") + 1)
    for found in (
        c_chunks.chunks(text),
        python_chunks.chunks(text, "m", source=True),
        introspect_chunks.chunks(text, "m"),
        xml_chunks.chunks(text, "m"),
        yaml_chunks.chunks(text),
        forum_chunks.chunks(text),
        rst_chunks.chunks(text),
        markdown_chunks.chunks(text),
        rule_chunks.chunks(text, "m"),
    ):
        for chunk in found:
            assert 1 <= chunk.start <= chunk.end <= lines


@pytest.mark.parametrize("name", ["retrieve", "stage"])
def test_a_citation_of_something_read_for_a_run_is_journaled(tmp_path, name):
    import json

    run = tmp_path / name
    run.mkdir()
    (run / "plan.md").write_text("# A plan\n")
    tools.read("doc/XMLreference.rst#body-geom-friction", run=str(run))
    tools.symbol("mj_ray", run=str(run))
    entries = [json.loads(line) for line in (run / "journal.jsonl").read_text().splitlines()]
    assert [e["action"] for e in entries] == ["cite", "cite"]
    assert "body-geom-friction" in entries[0]["citation"] and entries[1]["symbol"] == "mj_ray"
