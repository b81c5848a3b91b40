"""SARIF 2.1 by the essentials of its schema, GitHub's workflow commands, and colours for a terminal."""

import json

import jsonschema
import pytest
from click.testing import CliRunner

from worldwright import cli
from worldwright.lint import formats, tools
from worldwright.lint.report import ShownReport
from worldwright.model.finding import Finding

REGION = {
    "type": "object",
    "additionalProperties": False,
    "properties": {"startLine": {"type": "integer", "minimum": 1}, "startColumn": {"type": "integer", "minimum": 1}},
}
MESSAGE = {"type": "object", "required": ["text"], "properties": {"text": {"type": "string", "minLength": 1}}}
LEVEL = {"enum": ["none", "note", "warning", "error"]}
RULE = {
    "type": "object",
    "required": ["id"],
    "additionalProperties": False,
    "properties": {
        "id": {"type": "string"},
        "name": {"type": "string"},
        "shortDescription": MESSAGE,
        "help": MESSAGE,
        "defaultConfiguration": {"type": "object", "properties": {"level": LEVEL}, "additionalProperties": False},
    },
}
RESULT = {
    "type": "object",
    "required": ["message"],
    "additionalProperties": False,
    "properties": {
        "ruleId": {"type": "string"},
        "ruleIndex": {"type": "integer", "minimum": 0},
        "level": LEVEL,
        "message": MESSAGE,
        "locations": {
            "type": "array",
            "items": {
                "type": "object",
                "additionalProperties": False,
                "properties": {
                    "physicalLocation": {
                        "type": "object",
                        "required": ["artifactLocation"],
                        "additionalProperties": False,
                        "properties": {
                            "artifactLocation": {
                                "type": "object",
                                "additionalProperties": False,
                                "properties": {
                                    "uri": {"type": "string", "format": "uri-reference", "pattern": r"^\S+$"}
                                },
                            },
                            "region": REGION,
                        },
                    }
                },
            },
        },
        "suppressions": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["kind"],
                "additionalProperties": False,
                "properties": {"kind": {"enum": ["inSource", "external"]}, "justification": {"type": "string"}},
            },
        },
    },
}
SARIF = {
    "type": "object",
    "required": ["version", "runs"],
    "additionalProperties": False,
    "properties": {
        "$schema": {"type": "string", "format": "uri"},
        "version": {"const": "2.1.0"},
        "runs": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["tool"],
                "additionalProperties": False,
                "properties": {
                    "tool": {
                        "type": "object",
                        "required": ["driver"],
                        "additionalProperties": False,
                        "properties": {
                            "driver": {
                                "type": "object",
                                "required": ["name"],
                                "additionalProperties": False,
                                "properties": {
                                    "name": {"type": "string"},
                                    "version": {"type": "string"},
                                    "informationUri": {"type": "string", "format": "uri"},
                                    "rules": {"type": "array", "uniqueItems": True, "items": RULE},
                                },
                            }
                        },
                    },
                    "columnKind": {"enum": ["utf16CodeUnits", "unicodeCodePoints"]},
                    "results": {"type": "array", "items": RESULT},
                },
            },
        },
    },
}
"""What the OASIS schema of SARIF 2.1.0 says of the properties that are used here."""

FAULTY = "import mujoco\nmujoco.mj_stepp\nmujoco.mj_later  # worldwright: ignore[WL101] planned for 4.1\n"


def invoke(*arguments):
    return CliRunner().invoke(cli.main, ["lint", *map(str, arguments)], catch_exceptions=False)


@pytest.fixture
def program(tmp_path):
    path = tmp_path / "a program.py"
    path.write_text(FAULTY)
    return path


def test_sarif_follows_the_schema(program, tmp_path):
    result = invoke("check-program", program, "--format", "sarif")
    assert result.exit_code == 1
    log = json.loads(result.stdout)
    jsonschema.validate(log, SARIF)
    first, second = log["runs"][0]["results"]
    assert (first["ruleId"], first["level"]) == ("WL101", "error")
    assert first["locations"][0]["physicalLocation"]["region"] == {"startLine": 2, "startColumn": 1}
    assert first["locations"][0]["physicalLocation"]["artifactLocation"]["uri"].endswith("/a%20program.py")
    assert second["suppressions"] == [{"kind": "inSource", "justification": "planned for 4.1"}]
    rules = log["runs"][0]["tool"]["driver"]["rules"]
    assert [rules[r["ruleIndex"]]["id"] for r in (first, second)] == ["WL101", "WL101"]
    clean = tmp_path / "clean.py"
    clean.write_text("x = 1\n")
    done = invoke("check-program", clean, "--format", "sarif")
    assert done.exit_code == 0
    jsonschema.validate(json.loads(done.stdout), SARIF)


def test_the_schema_is_able_to_refuse():
    log = json.loads(formats.sarif([Finding(code="WL101", name="n", severity="error", message="m")]))
    jsonschema.validate(log, SARIF)
    log["runs"][0]["results"][0]["level"] = "info"
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(log, SARIF)


def test_github_commands_are_escaped(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    finding = Finding(
        code="WL101", name="unknown_symbol", severity="warning", message="50 %\nof it", fix="x", file="a,b:c.py", line=3
    )
    said = formats.github([finding])
    assert said == "::warning file=a%2Cb%3Ac.py,line=3,title=WL101 unknown_symbol::50 %25%0Aof it%0Afix: x"
    assert formats.github([finding.model_copy(update={"severity": "info", "line": None})]).startswith("::notice file=")


def test_plans_have_the_formats_too(tmp_path):
    plan = tmp_path / "plan.md"
    plan.write_text("# A plan\n")
    result = invoke("check-plan", plan, "--format", "github")
    assert result.exit_code == 1 and result.stdout.startswith("::error file=")
    jsonschema.validate(json.loads(invoke("check-plan", plan, "--format", "sarif").stdout), SARIF)


def test_colours_change_no_letter(program):
    report = tools.check_program([program])
    assert isinstance(report, ShownReport)
    text = report.rich()
    assert text.plain == report.text()
    assert {str(span.style) for span in text.spans} >= {"bold red", "green"}
