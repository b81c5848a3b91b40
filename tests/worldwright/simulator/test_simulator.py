"""The tables of the installed simulator agree with the simulator itself."""

import json

import mujoco
import pytest

from worldwright.simulator import cache, changelog, installed, mjcf, rst, symbols


def test_every_public_name_is_in_the_table():
    table = symbols.load()
    assert table.version == mujoco.__version__ == installed.version()
    for name in dir(mujoco):
        if not name.startswith("_"):
            assert table.top(name), name
    for name in dir(mujoco.MjData):
        if not name.startswith("_"):
            assert table.member("MjData", name), name
    assert table.member("mjtGeom", "mjGEOM_BOX")["value"] == int(mujoco.mjtGeom.mjGEOM_BOX)


def test_parameters_and_results_are_those_of_the_bindings():
    table = symbols.load()
    entry = table.member("MjsBody", "add_geom")
    assert {"type", "size", "friction", "surfacevel"} <= set(entry["parameters"])
    assert table.class_name(entry["returns"]) == "MjsGeom"
    assert table.class_name(table.member("MjSpec", "worldbody")["returns"]) == "MjsBody"
    assert table.class_name(table.member("MjData", "body")["returns"]) == "_MjDataBodyViews"
    assert "parameters" not in table.member("MjsBody", "add_freejoint")  # it takes **kwargs: nothing can be said


def test_nearest_names():
    table = symbols.load()
    assert "mj_step" in table.nearest("mj_stepp")
    assert table.nearest("time_step", "MjOption") == ["timestep"]


def test_the_schema_accepts_what_the_engine_accepts():
    """Every attribute of a saved model is in the schema."""
    from xml.etree import ElementTree

    spec = mujoco.MjSpec()
    body = spec.worldbody.add_body(name="b", gravcomp=1)
    body.add_freejoint(name="j")
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[1, 1, 1], surfacevel=[1, 0, 0, 0, 0, 0], name="g")
    body.add_camera(name="c", fovy=30)
    spec.compile()
    schema = mjcf.load()
    stack = [(ElementTree.fromstring(spec.to_xml()), schema.root)]
    while stack:
        tag, element = stack.pop()
        assert set(tag.attrib) <= element.attributes
        for child in tag:
            inside = element.child(child.tag)
            assert inside is not None, child.tag
            stack.append((child, inside))


def test_keywords_and_anchors():
    assert "implicitfast" in mjcf.keywords()["option-integrator"]
    assert mjcf.anchors()[("geom", "surfacevel")][0] == "body-geom-surfacevel"


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("composite", "removed in 4.0.0"),
        ("flexvert", "removed in 4.0.0"),
        ("mju_rayFlex", "renamed to `mj_rayFlex` in 3.5.0"),
        ("mjp_getResourceProvider", "renamed to `mjp_findProvider` in 3.16.0"),
        ("camera/orthographic", "renamed to `camera/projection` in 3.5.0"),
        ("efc_diagApprox", "renamed to `efc_diagA` in 3.10.0"),
        ("mjWARN_VGEOMFULL", "removed in 3.7.0"),
        ("mjData.qM", "removed in 3.11.0"),
        ("mj_step", ""),
        ("no_such_thing", ""),
    ],
)
def test_the_changelog_says_what_became_of_a_name(name, says):
    advice = changelog.advice(name)
    assert advice.startswith(says) and bool(advice) == bool(says)


def test_names_the_changelog_calls_renamed_are_indeed_gone_or_still_there_for_a_reason():
    """The table's new names exist where they are Python's to see."""
    table = symbols.load()
    new = [n for row in changelog.load() if row.breaking for n in row.renamed.values() if n.startswith("mj_")]
    known = [n for n in new if table.top(n.split("(")[0])]
    assert len(known) >= 2
    assert len(changelog.load()) > 150 and sum(row.breaking for row in changelog.load()) > 100


def test_rows_point_at_their_lines():
    lines = (installed.manual_folder() / "changelog.rst").read_text(encoding="utf-8").splitlines()
    row = changelog.find("flexvert")[0]
    assert row.version == "4.0.0" and row.breaking and "Removed ``flexvert``" in lines[row.lines[0] - 1]
    assert "discrete" in row.migration and row.migration.startswith("Use continuum")


def test_plain_text_keeps_words_and_drops_markup():
    text = "1. :commit:`89d` Added :ref:`speculative<option-flag-speculative>` and ``x`` |br| `a <http://b>`__ |-| s"
    assert rst.plain(text) == "1. Added speculative and `x`\na  s"
    assert rst.plain(".. image:: a.png\n   :width: 3\n\nText") == "Text"


def test_the_cache_survives_damage_and_read_only_places(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path))
    built = []
    make = lambda: built.append(1) or {"a": 1}  # noqa: E731
    assert cache.cached_json("t", "k", make) == cache.cached_json("t", "k", make) == {"a": 1}
    assert len(built) == 1
    next(tmp_path.glob("t-*.json")).write_text('{"a": ')
    assert cache.cached_json("t", "k", make) == {"a": 1} and len(built) == 2
    monkeypatch.setenv("WORLDWRIGHT_CACHE", "/proc/nowhere")
    assert cache.cached_json("t", "k", make) == {"a": 1}
    for number in range(9):
        monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path))
        cache.cached_json("t", f"k{number}", make)
    assert len(list(tmp_path.glob("t-*.json"))) <= cache.KEPT
    json.loads(next(tmp_path.glob("t-*.json")).read_text())


def test_a_lock_has_one_holder_and_its_wait_an_end(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path))
    with cache.held("lock") as mine, cache.held("lock", 0.1) as other, cache.held("another") as free:
        assert (mine, other, free) == (True, False, True)
    with cache.held("lock") as again:
        assert again


def test_what_cannot_be_locked_stops_nobody(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path))
    (tmp_path / "folder").mkdir()
    with cache.held("folder") as mine:
        assert mine

    def without_locks(*_):
        raise OSError(37, "no locks available")

    monkeypatch.setattr("fcntl.flock", without_locks)
    with cache.held("lock") as mine, cache.held("lock") as other:
        assert mine and other
