"""The page shows every asset and every offer with its picture, and what others wrote is text in it, no markup."""

from pathlib import Path

import pytest

from worldkit import assets
from worldwright.intake import catalog_page, libraries
from worldwright.intake.libraries import Offer, sweethome_furniture

PNG = b"\x89PNG\r\n\x1a\n"
EVIL = "<script>alert(1)</script>"


@pytest.fixture
def offered(monkeypatch: pytest.MonkeyPatch) -> None:
    rows = [
        Offer(
            "lib_a", "Zebra", "toy", EVIL, (0.1, 0.2, 0.3), "CC0-1.0", "Some One", "sweethome_furniture", chosen=True
        ),
        Offer("lib_b", "Ant", "toy", "", (0.1, 0.2, 0.3), "CC-BY-3.0", "", "sweethome_furniture"),
    ]
    monkeypatch.setattr(libraries, "offers", lambda: {row.key: row for row in rows})
    monkeypatch.setattr(sweethome_furniture, "icon", lambda key: PNG if key == "lib_a" else b"<svg/>")


def test_all_of_it_is_on_the_page_and_the_chosen_come_first(offered: None, tmp_path: Path) -> None:
    told = catalog_page.page(tmp_path / "page")
    text = (tmp_path / "page/index.html").read_text(encoding="utf-8")
    assert told.assets == len(assets.keys()) and told.offers == 2 and told.page.endswith("index.html")
    assert all(f"<h2>{key}</h2>" in text for key in assets.keys())  # noqa: SIM118
    assert text.index("<h2>mug</h2>") < text.index("<h2>Zebra</h2>") < text.index("<h2>Ant</h2>")
    assert EVIL not in text and "&lt;script&gt;alert" in text and "by Some One" in text
    assert "worldwright asset add lib_a" in text
    shown = {path.stem for path in (tmp_path / "page/pictures").iterdir()}
    assert {"mug", "lib_a"} <= shown and "lib_b" not in shown, "what is no PNG is not shown"


def test_a_library_that_is_not_there_shows_no_picture() -> None:
    assert sweethome_furniture.icon("scopia_none") == b""
