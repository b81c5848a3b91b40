"""A server makes a mesh of a picture: what it answers is taken in once, and what it refuses is said; stand-ins on the loopback."""

import base64
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest

from stub_servers import BOX, StandIn, said, stand_in
from worldwright.intake import of_pictures, of_words
from worldwright.intake.minters import hunyuan3d, meshy
from worldwright.intake.refusing import IntakeFailedError
from worldwright.intake.web_calls import MintError
from worldwright.model.errors import NotFoundError

THERE = "/generate"


@pytest.fixture
def there() -> Iterator[StandIn]:
    with stand_in() as made:
        yield made


@pytest.fixture
def picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("WORLDWRIGHT_ASSETS", str(tmp_path / "own"))
    monkeypatch.setattr(of_pictures, "data_root", lambda: tmp_path / "data")
    monkeypatch.setattr(of_words, "data_root", lambda: tmp_path / "data")
    drawn = np.full((64, 64, 3), 235, np.uint8)
    drawn[14:50, 24:40] = (30, 60, 160)
    cv2.imwrite(str(tmp_path / "Tall Box.png"), drawn)
    return tmp_path / "Tall Box.png"


def test_a_mesh_is_made_once_of_what_was_cut_out_and_taken_in_at_its_height(there: StandIn, picture: Path) -> None:
    there.replies[THERE] = [(200, BOX, {})]
    told = of_pictures.mint(picture, 0.5, address=there.address, material="wood").data
    (asked,) = there.json(THERE)
    sent = cv2.imdecode(np.frombuffer(base64.b64decode(asked["image"]), np.uint8), cv2.IMREAD_UNCHANGED)
    assert sent.shape == (64, 64, 4) and sent[30, 32, 3] == 255 and sent[2, 2, 3] == 0 and asked["type"] == "glb"
    assert told.key == "tall_box" and told.extents_m == pytest.approx((0.2, 0.2, 0.5), abs=1e-3) and told.stands
    assert any("licence is not stated" in line for line in told.mended)
    again = of_pictures.mint(picture, 1.0, key="taller", address=there.address, material="wood").data
    assert again.extents_m[2] == pytest.approx(1.0) and len(there.asked) == 1, "the same picture is not made twice"


def test_a_service_is_paid_only_when_its_price_was_confirmed(there, picture, tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("MESHY_API_KEY", "k")
    for told in (None, 29.0):
        with pytest.raises(MintError, match="30 credits of Meshy") as error:
            of_pictures.mint(picture, 0.5, server="meshy", address=there.address, cut=False, confirm_price=told)
        assert error.value.code == "price" and "--confirm-price 30" in error.value.next_move
    assert not there.asked
    with pytest.raises(MintError, match="404"):
        of_pictures.mint(picture, 0.5, server="meshy", address=there.address, cut=False, confirm_price=30.0)
    assert len(there.asked) == 1 and not list(tmp_path.glob("data/minted/*"))


def test_what_was_paid_is_forgotten_only_when_its_mesh_lies_here(there, picture, tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("MESHY_API_KEY", "k")
    monkeypatch.setattr(of_pictures, "add", lambda file, *_, **__: file.read_bytes())
    there.replies |= {
        meshy.WORK: [said({"result": "0193-ab"})],
        f"{meshy.WORK}/0193-ab": [said({"status": "SUCCEEDED", "model_urls": {"glb": f"{there.address}/a.glb"}})],
        "/a.glb": [(200, b"<html>busy</html>", {}), (200, BOX, {})],
    }
    with pytest.raises(MintError, match="no GLB") as error:
        of_pictures.mint(picture, 0.5, server="meshy", address=there.address, cut=False, confirm_price=30.0)
    (ordered,) = tmp_path.glob("data/minted/*.ordered")
    assert str(ordered) in error.value.next_move
    assert of_pictures.mint(picture, 0.5, server="meshy", address=there.address, cut=False) == BOX
    assert there.paths().count(meshy.WORK) == 1 and [p.suffix for p in ordered.parent.iterdir()] == [".glb"]


def test_a_picture_is_painted_once_when_its_price_was_confirmed(there, picture, tmp_path, monkeypatch) -> None:
    monkeypatch.setenv("OPENAI_API_KEY", "k")
    held = base64.b64encode(picture.read_bytes()).decode()
    there.replies["/v1/images/generations"] = [said({"data": [{"b64_json": held}]})]
    with pytest.raises(MintError, match=r"0\.042 US dollars"):
        of_words.picture("a  red box", tmp_path / "a.png", address=there.address)
    told = of_words.picture("a  red box", tmp_path / "a.png", address=there.address, confirm_price=0.042)
    assert told.anew and (tmp_path / "a.png").read_bytes() == picture.read_bytes() and "asset mint" in told.next_move
    assert not of_words.picture("a red box", tmp_path / "b.png", address=there.address).anew and len(there.asked) == 1
    with pytest.raises(IntakeFailedError, match="already"):
        of_words.picture("a red box", tmp_path / "b.png")
    there.replies["/v1/images/generations"] = [said({"data": [{"b64_json": "QUJD"}]})]
    with pytest.raises(MintError, match="no picture"):
        of_words.picture("a blue box", tmp_path / "c.png", address=there.address, model="own", confirm_price=0.0)
    with pytest.raises(NotFoundError, match="no service"):
        of_words.picture("a box", tmp_path / "c.png", painter="nobody")
    assert not (tmp_path / "c.png").exists() and len(list(tmp_path.glob("data/painted/*"))) == 1


@pytest.mark.parametrize(
    ("reply", "code", "told"),
    [
        ((404, b'{"text": "NETWORK ERROR", "error_code": 1}', {}), "refused", "NETWORK ERROR"),
        ((500, b"\xff\xfe", {}), "refused", "500"),
        ((500, b"cut", {"Content-Length": "900"}), "refused", "500"),
        ((429, b"", {"Retry-After": "30"}), "rate_limited", "too much"),
        ((200, b"<html>busy</html>", {}), "garbage", "busy"),
        ((200, b"", {}), "garbage", "no GLB"),
        ((200, BOX, {"Content-Length": str(len(BOX) + 9)}), "unreachable", "cannot be reached"),
    ],
)
def test_what_makes_no_mesh_is_said_by_a_code_and_nothing_is_kept(there, picture, tmp_path, reply, code, told) -> None:
    there.replies[THERE] = [reply]
    with pytest.raises(MintError, match=told) as error:
        of_pictures.mint(picture, 0.5, address=there.address, cut=False)
    assert error.value.code == code and error.value.next_move and not (tmp_path / "data").exists()
    assert code != "rate_limited" or "30 s" in error.value.next_move


def test_a_forged_mesh_is_refused_by_the_intake(there: StandIn, picture: Path, tmp_path: Path) -> None:
    there.replies[THERE] = [(200, BOX[: len(BOX) // 2], {})]
    with pytest.raises(IntakeFailedError) as told:
        of_pictures.mint(picture, 0.5, address=there.address, cut=False)
    assert told.value.code == "truncated" and not list((tmp_path / "own").glob("*"))
    assert not list((tmp_path / "data/minted").iterdir()), "it is asked for anew"


def test_without_a_server_or_a_picture_the_way_on_is_told(picture: Path, monkeypatch) -> None:
    monkeypatch.delenv(hunyuan3d.TERMS.variable, raising=False)
    with pytest.raises(NotFoundError, match="no hunyuan3d server") as told:
        of_pictures.mint(picture, 0.5)
    assert "api_server" in told.value.next_move and "sculpt" in told.value.next_move
    with pytest.raises(NotFoundError, match="no kind of server") as unknown:
        of_pictures.mint(picture, 0.5, server="nothing")
    assert "hunyuan3d" in unknown.value.next_move
    for address in ("file:///etc/passwd", "http://127.0.0.1:9"):
        with pytest.raises(MintError) as refused:
            of_pictures.mint(picture, 0.5, address=address, cut=False)
        assert refused.value.code == "unreachable"
    picture.write_bytes(b"no picture")
    with pytest.raises(IntakeFailedError, match="no PNG"):
        of_pictures.mint(picture, 0.5, address="http://127.0.0.1:9")
