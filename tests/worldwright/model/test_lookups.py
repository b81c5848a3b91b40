"""An unknown simulator name is looked up before the program runs again."""

from worldwright.model.evidence.lookups import owed

LINT = {"action": "lint", "codes": ["WL101", "WL300"], "unknown": ["WL101"]}
CRASH = {"action": "stage", "ok": False, "message": "AttributeError: module 'mujoco' has no attribute 'mj_fly'"}
CITE = {"action": "cite", "symbol": "mj_step"}


def test_an_unknown_name_is_owed_until_something_is_read():
    assert owed([]) == ""
    assert "WL101" in owed([LINT])
    assert "WL300" not in owed([LINT])
    assert "mj_fly" in owed([CITE, CRASH])
    assert owed([LINT, {"action": "lint", "ok": True}]) != ""
    assert owed([LINT, CRASH, CITE]) == ""


def test_other_failures_owe_nothing():
    assert (
        owed(
            [
                {"action": "lint", "codes": ["WL300"], "unknown": []},
                {"action": "stage", "ok": False, "message": "timed out"},
            ]
        )
        == ""
    )
    assert owed([{"action": "lint", "unknown": "WL101"}, {"action": "stage"}]) == ""
