"""A policy takes many robots at once, gives each what it would alone, and whatever is none of its kind is named."""

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import packaged_dogs
from packaged_dogs import message
from worldkit.robots import onnx_graph, policies

REAL = [
    pytest.param(path, rows, id=path.stem)
    for place in Path(__file__).parents
    for name, rows in (("go1", (48, 12)), ("t1", (85, 23)), ("g1", (103, 29)))
    if (path := place / f"shared/data/policies/playground/{name}_policy.onnx").is_file()
]
"""Published policies, where this machine has them."""


def test_many_rows_are_taken_at_once_each_as_if_it_were_alone(tmp_path):
    walk = policies.opened(packaged_dogs.policy(tmp_path / "walk.onnx", 6, 2), observation=6, action=2)
    rows = np.arange(24.0).reshape(4, 6)
    assert np.allclose(walk(rows), 0.01 * rows.sum(axis=1)[:, None]) and walk(rows).dtype == float
    assert np.allclose(walk(rows), np.concatenate([walk(row[None]) for row in rows]), rtol=1e-5)
    assert walk.sha256 == hashlib.sha256((tmp_path / "walk.onnx").read_bytes()).hexdigest()


if REAL:

    @pytest.mark.parametrize(("path", "rows"), REAL)
    def test_a_published_policy_is_read_and_freed(path, rows):
        walk = policies.opened(path, observation=rows[0], action=rows[1])
        shown = np.random.default_rng(0).normal(size=(24, rows[0]))
        assert np.allclose(walk(shown), np.concatenate([walk(row[None]) for row in shown]), rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize(
    ("made", "code"),
    [
        ({"outputs": 3}, "wrong_shape"),
        ({"inputs": 7}, "wrong_shape"),
        ({"operator": "Balance", "domain": "ai.maker"}, "custom_operator"),
        ({"operator": "Balance"}, "unreadable"),
    ],
    ids=["action", "observation", "custom", "unknown"],
)
def test_a_policy_of_another_kind_is_named(tmp_path, made, code):
    path = packaged_dogs.policy(tmp_path / "walk.onnx", **{"inputs": 6, "outputs": 2, **made})
    with pytest.raises(policies.PolicyError) as told:
        policies.opened(path, observation=6, action=2)
    assert told.value.code == code and told.value.place == "walk.onnx" and told.value.next_move
    assert code != "custom_operator" or "ai.maker.Balance" in told.value.cause


def test_a_file_that_is_cut_or_another_or_none_is_named(tmp_path):
    path = packaged_dogs.policy(tmp_path / "walk.onnx", 6, 2)
    data = path.read_bytes()
    for content, code in ((data[:-9], "unreadable"), (b"", "unreadable"), (b"\xff" * 40, "unreadable"), (data, "")):
        path.write_bytes(content)
        with pytest.raises(policies.PolicyError) as told:
            policies.opened(path, observation=6, action=2, sha256="" if code else "0" * 64)
        assert told.value.code == (code or "other_file")
    with pytest.raises(policies.PolicyError, match="cannot be read"):
        policies.opened(tmp_path / "none.onnx", observation=6, action=2)


def _nested(graph: bytes, levels: int) -> tuple[int, bytes]:
    """An attribute's field that holds a graph, within as many of a standard node's."""
    for _ in range(levels):
        graph = message((1, message((4, b"If"), (5, message((6, graph))))))
    return (6, graph)


@pytest.mark.parametrize(
    ("within", "code"),
    [
        (_nested(message((1, message((4, b"Balance"), (7, b"ai.maker")))), 2), "custom_operator"),
        (_nested(message((5, message((8, b"w"), (14, 1)))), 2), "external_weights"),
        (_nested(b"", 800), ""),
        ((5, message((13, message((1, b"location"), (2, b"w.bin"))), (14, 1))), "external_weights"),
        ((11, message((15, message((1, message((14, 1))))))), "external_weights"),
    ],
    ids=["operator", "tensor", "deep", "attribute", "sparse"],
)
def test_what_a_policy_holds_deeper_is_looked_at(tmp_path, within, code):
    path = packaged_dogs.policy(tmp_path / "walk.onnx", 6, 2, within=(within,))
    if not code:
        assert policies.checked(path) == path.read_bytes()
        return
    with pytest.raises(policies.PolicyError) as told:
        policies.checked(path)
    assert told.value.code == code and told.value.next_move


@pytest.mark.parametrize(
    ("tensor", "says"),
    [
        (message((8, b"w"), (1 << 29 | 14, 1)), "no number of a field's"),
        (message((8, b"w"), (1 << 29 | 13, b"")), "no number of a field's"),
        (message((8, b"w")) + b"\xf0\x80\x00\x01", "longer than it is"),
        (message((8, b"w"), (14, 1 << 64)), "longer than it is"),
        (message((8, b"w"), (17, 1)), "none of a tensor's"),
    ],
    ids=["location", "data", "padded", "too_large", "unknown"],
)
def test_a_field_that_a_runtime_would_read_otherwise_is_refused(tmp_path, tensor, says):
    path = packaged_dogs.policy(tmp_path / "walk.onnx", 6, 2, within=((5, tensor),))
    with pytest.raises(policies.PolicyError, match=says) as told:
        policies.checked(path)
    assert told.value.code == "unreadable"


def test_the_runtime_writes_nothing_down_of_this_machine(tmp_path):
    path = packaged_dogs.policy(tmp_path / "walk.onnx", 6, 2)
    code = f"from pathlib import Path; from worldkit.robots.policies import opened; opened(Path({str(path)!r}), observation=6, action=2)"
    home = {"HOME": str(tmp_path / "home"), "XDG_CACHE_HOME": str(tmp_path / "home/cache")}
    subprocess.run([sys.executable, "-c", code], check=True, env={**os.environ, **home, "ORT_DISABLE_TELEMETRY": "0"})
    assert not (tmp_path / "home").exists()


def test_what_is_no_number_and_what_has_no_rows_is_refused(tmp_path):
    walk = policies.opened(packaged_dogs.policy(tmp_path / "w.onnx", 6, 2), observation=6, action=2)
    with pytest.raises(policies.PolicyError) as told:
        walk(np.full((1, 6), np.nan))
    assert told.value.code == "not_finite"
    with pytest.raises(policies.PolicyError) as told:
        walk(np.zeros(6))
    assert told.value.code == "wrong_shape"


def test_the_rest_of_a_file_stays_as_it_is(tmp_path):
    data = packaged_dogs.policy(tmp_path / "w.onnx", 6, 2).read_bytes()
    freed = onnx_graph.freed(data)
    assert onnx_graph.operators(freed) == onnx_graph.operators(data) == (("", "MatMul"),)
    assert freed != data and onnx_graph.freed(freed) == freed and freed.count(b"rows") == 2
