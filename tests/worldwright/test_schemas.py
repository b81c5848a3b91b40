"""What clients are told about every tool, kept as snapshots: a change of a tool's face is a decision, seen in review.

After such a decision: `pytest tests/worldwright/test_schemas.py --snapshot-update`.
"""

import anyio
import pytest
from jsonschema import Draft202012Validator
from syrupy.extensions.json import JSONSnapshotExtension

from worldwright import expose
from worldwright.schema import plain


@pytest.fixture
def faces(snapshot):
    return snapshot.use_extension(JSONSnapshotExtension)


def listed(server):
    return anyio.run(expose.build_server(server).list_tools)


@pytest.mark.parametrize("server", expose.SERVERS)
def test_the_tools_look_as_they_did(server, faces):
    for tool in listed(server):
        assert tool.model_dump(mode="json", by_alias=True, exclude_none=True) == faces(name=f"{server}.{tool.name}")


@pytest.mark.parametrize("server", expose.SERVERS)
def test_every_schema_is_one(server):
    for tool in listed(server):
        for schema in (tool.input_schema, tool.output_schema):
            if schema is not None:
                Draft202012Validator.check_schema(schema)
        assert all(part.get("description") for part in tool.input_schema.get("properties", {}).values()), tool.name


def test_a_plain_schema_takes_what_the_full_one_took():
    full = {
        "title": "Arguments",
        "type": "object",
        "properties": {
            "title": {"title": "Title", "type": "string"},
            "k": {"anyOf": [{"type": "integer", "minimum": 1}, {"type": "null"}], "default": None, "title": "K"},
            "either": {"anyOf": [{"type": "string"}, {"type": "integer"}, {"type": "null"}], "default": None},
            "n": {"anyOf": [{"type": "integer"}, {"type": "null"}], "title": "N"},
        },
    }
    short = plain(full, optional=True)
    assert short["properties"] == {
        "title": {"type": "string"},
        "k": {"type": "integer", "minimum": 1},
        "either": {"anyOf": [{"type": "string"}, {"type": "integer"}]},
        "n": {"anyOf": [{"type": "integer"}, {"type": "null"}]},
    }
    for given in ({"k": 3, "title": "a"}, {"either": 2}, {"n": None}, {"k": 0}, {"title": 4}, {"either": []}):
        assert Draft202012Validator(short).is_valid(given) == Draft202012Validator(full).is_valid(given)
    assert plain(full)["properties"]["k"]["anyOf"][1] == {"type": "null"}
