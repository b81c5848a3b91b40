"""Every check on its own cases: found where planted, silent where not."""

import pytest

from worldwright.scan.anomalies.engine import CHECKS, ORDER, run_check

CASES = [
    pytest.param(entry, make, good, id=f"{entry.name}-{make().title}")
    for entry in CHECKS.values()
    for good, makers in ((True, entry.GOOD), (False, entry.BAD))
    for make in makers
]


@pytest.mark.parametrize(("entry", "make", "good"), CASES)
def test_the_check_on_its_case(entry, make, good):
    case = make()
    run, anomalies = run_check(entry, case.trajectory, case.context)
    if good:
        assert run.status == "clean", [str(a) for a in anomalies] or run.reason
        return
    assert run.status == "found", run.reason
    if case.severity:
        worst = min(anomalies, key=lambda a: ORDER[a.severity])
        assert worst.severity == case.severity, str(worst)
    for anomaly in anomalies:
        assert anomaly.code == entry.code and anomaly.name == entry.name
        assert anomaly.window_s[0] <= anomaly.window_s[1]
        assert anomaly.message and anomaly.body


# A planted fault of one kind may show in several checks; a GOOD case of one must not block in any other.
@pytest.mark.parametrize(("entry", "make", "good"), [c for c in CASES if c.values[2]])
def test_good_cases_block_nowhere(entry, make, good):
    case = make()
    for other in CHECKS.values():
        _, anomalies = run_check(other, case.trajectory, case.context)
        blocking = [str(a) for a in anomalies if a.severity == "blocking"]
        assert not blocking, blocking


@pytest.mark.parametrize(("name", "severity"), [("unearned_switch", "blocking"), ("absolute_zero", "warn")])
def test_a_check_of_staging_that_fails_blocks(monkeypatch, name, severity):
    entry = next(entry for entry in CHECKS.values() if entry.name == name)

    def fails(*_):
        raise ZeroDivisionError

    monkeypatch.setattr(entry.module, "check", fails)
    case = entry.BAD[0]()
    run, (anomaly,) = run_check(entry, case.trajectory, case.context)
    assert run.status == "skipped" and anomaly.severity == severity


def test_codes_and_documentation():
    assert len(CHECKS) >= 16
    for code, entry in CHECKS.items():
        assert code.startswith("WS") and len(code) == 5
        assert entry.GOOD and entry.BAD
        for heading in ("What it means:", "Formula:", "Threshold:", "Source:"):
            if heading == "Threshold:" and "Severity:" in entry.doc:
                continue
            assert heading in entry.doc, f"{entry.name} does not say {heading}"
