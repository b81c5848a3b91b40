"""Tell the picture which objects a finding is about."""

import re

from ...model.finding import Finding

_QUOTED = re.compile(r"`([A-Za-z0-9_-]+)`")


def flagged(findings: tuple[Finding, ...], names: list[str]) -> dict[str, str]:
    """The worst severity of the findings that name each object."""
    known = set(names)
    worst: dict[str, str] = {}
    for finding in findings:
        if finding.severity == "info":
            continue
        told = {*_QUOTED.findall(finding.message), finding.message.partition(" ")[0]} & known
        for name in told:
            worst[name] = "error" if "error" in (finding.severity, worst.get(name)) else "warning"
    return worst
