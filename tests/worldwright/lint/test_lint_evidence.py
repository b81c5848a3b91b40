"""What the rules warn of does happen in the installed simulator: errors, warnings, silent no-ops, wrong physics."""

import contextlib
import math
import re
import warnings

import mujoco
import pytest

from worldwright.lint import engine
from worldwright.lint.case import Case
from worldwright.lint.harm import Argued, Measured, Raises, Warns, executed, model_of

RULES = engine.all_rules()


def source(case):
    return case.source if isinstance(case, Case) else case[0] if isinstance(case, tuple) else case


def cases(kind):
    for rule in RULES:
        evidence = rule.EVIDENCE
        if not isinstance(evidence, Raises) or (kind == "GOOD" and not evidence.good):
            continue
        for index, case in enumerate(getattr(rule, kind)):
            if kind == "GOOD" or index not in evidence.without:
                yield pytest.param(rule, source(case), id=f"{rule.code}-{rule.name}-{index}")


def run(text):
    """Run a case as far as it goes: a model is compiled and stepped, a program is executed and its world built."""
    if text.lstrip().startswith("<") or "def build" in text:
        model = model_of(text)
        mujoco.mj_step(model, mujoco.MjData(model))
    else:
        executed(text)


@pytest.mark.parametrize(("rule", "text"), [*cases("BAD")])
def test_bad_cases_fail(rule, text):
    with pytest.raises((Exception, RecursionError), match=rule.EVIDENCE.match or None):
        run(text)


@pytest.mark.parametrize(("rule", "text"), [*cases("GOOD")])
def test_good_cases_run(rule, text):
    run(text)


@pytest.mark.parametrize("rule", [r for r in RULES if isinstance(r.EVIDENCE, Warns)], ids=lambda r: r.code)
def test_bad_cases_make_the_engine_warn(rule):
    def said(text):
        with warnings.catch_warnings(record=True) as found:
            warnings.simplefilter("always")
            run(text)
        return [str(w.message) for w in found if re.search(rule.EVIDENCE.match, str(w.message))]

    assert all(said(source(case)) for case in rule.BAD)
    assert not any(said(source(case)) for case in rule.GOOD)


@pytest.mark.parametrize("rule", [r for r in RULES if isinstance(r.EVIDENCE, Measured)], ids=lambda r: r.code)
def test_the_harm_is_measured(rule):
    evidence = rule.EVIDENCE

    def number(kind, which):
        case = source(getattr(rule, kind)[which]) if isinstance(which, int) else which
        with contextlib.redirect_stdout(None), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return evidence.measure(case)

    bad, good = number("BAD", evidence.bad), number("GOOD", evidence.good)
    assert math.isfinite(good)
    assert not abs(bad - good) <= evidence.apart, f"{evidence.claim}: {bad} and {good} {evidence.unit}"
    assert evidence.apart > 0 and evidence.claim and not evidence.claim.endswith(".")


def test_no_rule_is_without_evidence_or_a_reason():
    for rule in RULES:
        if isinstance(rule.EVIDENCE, Argued):
            assert len(rule.EVIDENCE.reason.split()) >= 8, f"{rule.name}: say why no run can show the harm"
    argued = [rule.code for rule in RULES if isinstance(rule.EVIDENCE, Argued)]
    names = {"WL103", "WL104", "WL105", "WL101", "WL102"}
    assert not names & set(argued)
    assert len(argued) < len(RULES) / 2
