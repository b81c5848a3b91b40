"""What packaged libraries offer is found at once and taken in when asked for; an archive is read bounded and climbs nowhere."""

import zipfile
from pathlib import Path

import pytest
import trimesh

from worldwright.adding_assets import add_asset
from worldwright.intake import libraries
from worldwright.intake.libraries import own_kits, sweethome_furniture
from worldwright.intake.refusing import IntakeFailedError
from worldwright.model.errors import NotFoundError
from worldwright.retrieve.tools import find_asset

HEAD = "# a comment\nname=Scopia catalog\n"


def row(number: int, own: str, **more: str) -> str:
    said = {
        "id": f"Scopia#{own}", "name": "Treasure chest", "tags": "Pirate, Storage", "category": "Miscellaneous",
        "model": f"/scopia/{own}/{own}.obj", "creator": "Scopia", "width": "80", "depth": "50", "height": "40", **more,
    }  # fmt: skip
    return "".join(f"{key}#{number}={value}\n" for key, value in said.items())


def archive(folder: Path, text: str, members: dict[str, bytes]) -> None:
    with zipfile.ZipFile(folder / "Scopia.sh3f", "w", zipfile.ZIP_DEFLATED) as held:
        held.writestr("PluginFurnitureCatalog.properties", HEAD + text)
        for name, content in members.items():
            held.writestr(name, content)


@pytest.fixture
def library(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "furniture"
    folder.mkdir()
    monkeypatch.setenv("WORLDWRIGHT_SWEETHOME", str(folder))
    monkeypatch.setenv("WORLDWRIGHT_ASSETS", str(tmp_path / "own"))
    monkeypatch.setattr(own_kits, "offers", tuple)  # the project's own, which are always offered
    return folder


def test_an_offer_is_found_taken_in_with_its_creator_and_then_an_asset(library: Path, monkeypatch) -> None:
    monkeypatch.setattr(libraries, "chosen", lambda: {"scopia_chest1": "pirate chest"})
    libraries._named.cache_clear()
    obj = trimesh.creation.box((3, 1, 2)).export(file_type="obj").encode()  # in a unit of its own, y up
    turned = "0 0 1 0 1 0 -1 0 0"  # a quarter about y: what was its depth is its width
    archive(
        library,
        row(1, "chest1", modelRotation=turned) + row(2, "broken", width="wide"),
        {"scopia/chest1/chest1.obj": obj},
    )
    (offer,) = libraries.offers().values()
    assert (offer.key, offer.extents, offer.licence) == ("scopia_chest1", (0.5, 0.8, 0.4), "CC-BY-3.0")
    hit = find_asset("treasure chest").assets[0]
    assert (hit.key, hit.taken_in, hit.mass_kg, hit.source) == ("scopia_chest1", False, None, "sweethome_furniture")
    assert "worldwright asset add scopia_chest1" in hit.text()
    told = add_asset(Path("scopia_chest1"), material="oak").data
    assert told.ok and told.extents_m == pytest.approx((0.5, 0.8, 0.4)) and told.collides_as.startswith("a box")
    assert told.mass_kg == pytest.approx(120 * 0.16), "a large thing that is full is hollow inside"
    assert any("hollow inside" in line for line in told.mended) and told.creator == "Scopia"
    hit = find_asset("treasure chest").assets[0]
    assert (hit.key, hit.taken_in, hit.source, hit.licence) == ("scopia_chest1", True, "own_folder", "CC-BY-3.0")
    assert len(find_asset("treasure chest").assets) == 1
    assert hit.category == "pirate chest", "what it was recognised as stays its name"
    assert hit.description == "Pirate chest (Treasure chest, Pirate, Storage chest1)"
    libraries._named.cache_clear()


def test_what_was_looked_at_comes_before_what_was_not_and_under_the_name_it_goes_by(library: Path, monkeypatch) -> None:
    monkeypatch.setattr(libraries, "chosen", lambda: {"scopia_motorbike": "spring rider"})
    libraries._named.cache_clear()
    archive(library, row(1, "motorbike", name="Motorbike", tags="") + row(2, "rider", name="Spring rider", tags=""), {})
    assert [(hit.key, hit.chosen) for hit in find_asset("spring rider").assets] == [
        ("scopia_motorbike", True),
        ("scopia_rider", False),
    ]
    assert find_asset("motorbike").assets[0].description == "Spring rider (Motorbike, motorbike)"
    libraries._named.cache_clear()


def test_the_list_of_the_chosen_is_long_and_calls_no_two_alike() -> None:
    names = libraries.chosen()
    assert len(names) > 150 and len({*names.values()}) == len(names)


def test_what_no_library_offers_is_no_file_either(library: Path) -> None:
    assert libraries.offers() == {}
    with pytest.raises(NotFoundError, match="no library offers it") as told:
        add_asset(Path("scopia_chest1"))
    assert "find-asset" in told.value.next_move
    with pytest.raises(IntakeFailedError) as refused:
        sweethome_furniture.lay("scopia_chest1", library)
    assert "apt-get install" in refused.value.next_move


def test_a_path_that_climbs_out_stays_in(library: Path, tmp_path: Path) -> None:
    laid = tmp_path / "a" / "b" / "laid"
    laid.mkdir(parents=True)
    archive(library, row(1, "up", model="/../../up.obj"), {"../../up.obj": b"v 0 0 0\n", "../../../etc/x.obj": b"no"})
    file, _ = sweethome_furniture.lay("scopia_up", laid)
    assert file == laid / "up.obj" and file.read_bytes() == b"v 0 0 0\n"
    assert {path for path in (tmp_path / "a").rglob("*") if path.is_file()} == {file}


@pytest.mark.parametrize(("limit", "code"), [("MOST_MEMBER", "too_large"), ("MOST_LAID", "too_large")])
def test_a_bomb_is_refused_however_small_it_is_packed(
    library: Path, tmp_path: Path, monkeypatch, limit: str, code: str
) -> None:
    monkeypatch.setattr(sweethome_furniture, limit, 1 << 20)
    members = {"scopia/bomb/bomb.obj": b"v 0 0 0\n", **{f"scopia/bomb/{n}.png": b"\0" * (700 << 10) for n in range(2)}}
    if limit == "MOST_MEMBER":
        members["scopia/bomb/bomb.obj"] = b"\n" * (2 << 20)
    archive(library, row(1, "bomb"), members)
    assert (library / "Scopia.sh3f").stat().st_size < 20_000
    with pytest.raises(IntakeFailedError, match="unpacks to more") as told:
        sweethome_furniture.lay("scopia_bomb", tmp_path)
    assert told.value.code == code


def test_an_archive_that_is_cut_off_offers_nothing_or_says_so(library: Path, tmp_path: Path) -> None:
    archive(library, row(1, "chest1"), {"scopia/chest1/chest1.mtl": b""})
    with pytest.raises(IntakeFailedError, match=r"there is no scopia/chest1/chest1\.obj"):
        sweethome_furniture.lay("scopia_chest1", tmp_path)
    whole = (library / "Scopia.sh3f").read_bytes()
    (library / "Scopia.sh3f").write_bytes(whole[: len(whole) // 2])
    assert libraries.offers() == {}
