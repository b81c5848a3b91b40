"""Lint reports for machines: SARIF 2.1 for code-scanning services, and annotations for GitHub workflows.

Source: OASIS, Static Analysis Results Interchange Format (SARIF) 2.1.0; GitHub, workflow commands.
"""

import json
import re
from collections.abc import Sequence
from pathlib import Path, PurePath
from typing import Any
from urllib.parse import quote

from ..model.finding import Finding

SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
LEVELS = {"error": "error", "warning": "warning", "info": "note"}
COMMANDS = {"error": "error", "warning": "warning", "info": "notice"}
SUPPRESSED = re.compile(r" \(suppressed: (?P<reason>.*)\)$")


def sarif(findings: Sequence[Finding]) -> str:
    """A SARIF log with one run: its rules and findings; a finding that a comment answers for is a suppression."""
    from .. import __version__
    from . import engine

    known = {rule.code: rule for rule in engine.all_rules()}
    codes = sorted({finding.code for finding in findings})
    rules: list[dict[str, Any]] = []
    for code in codes:
        rule = known.get(code)
        entry: dict[str, Any] = {"id": code, "name": next(f.name for f in findings if f.code == code)}
        if rule is not None:
            entry |= {
                "shortDescription": {"text": rule.summary},
                "help": {"text": rule.doc},
                "defaultConfiguration": {"level": LEVELS[rule.SEVERITY]},
            }
        rules.append(entry)
    driver = {
        "name": "worldwright-lint",
        "version": __version__,
        "informationUri": "https://github.com/worldwright/worldwright",
        "rules": rules,
    }
    results = [_result(finding, codes.index(finding.code)) for finding in findings]
    run = {"tool": {"driver": driver}, "columnKind": "unicodeCodePoints", "results": results}
    return json.dumps({"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}, indent=2, ensure_ascii=False)


def _result(finding: Finding, index: int) -> dict[str, Any]:
    match = SUPPRESSED.search(finding.message)
    said = finding.message + (f". Fix: {finding.fix}" if finding.fix else "")
    result: dict[str, Any] = {
        "ruleId": finding.code,
        "ruleIndex": index,
        "level": LEVELS[finding.severity],
        "message": {"text": said},
    }
    if finding.file:
        place: dict[str, Any] = {"artifactLocation": {"uri": _uri(finding.file)}}
        if finding.line:
            place["region"] = {"startLine": finding.line}
            if finding.column:
                place["region"]["startColumn"] = finding.column
        result["locations"] = [{"physicalLocation": place}]
    if match:
        result["suppressions"] = [{"kind": "inSource", "justification": match["reason"]}]
    return result


def _uri(file: str) -> str:
    """Relative paths as they are, absolute ones as file URIs."""
    path = PurePath(file)
    return path.as_uri() if path.is_absolute() else quote(path.as_posix())


def github(findings: Sequence[Finding]) -> str:
    """One workflow command per finding, which shows at its line in a pull request."""
    return "\n".join(_command(finding) for finding in findings)


def _command(finding: Finding) -> str:
    properties = {
        "file": _shown(finding.file),
        "line": finding.line,
        "col": finding.column,
        "title": f"{finding.code} {finding.name}",
    }
    words = ",".join(f"{key}={_property(str(value))}" for key, value in properties.items() if value)
    message = finding.message + (f"\nfix: {finding.fix}" if finding.fix else "")
    return f"::{COMMANDS[finding.severity]} {words}::{_data(message)}"


def _shown(file: str) -> str:
    """GitHub wants paths from the repository's root, where workflows run."""
    try:
        return Path(file).resolve().relative_to(Path.cwd()).as_posix()
    except ValueError:
        return file


def _data(text: str) -> str:
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
