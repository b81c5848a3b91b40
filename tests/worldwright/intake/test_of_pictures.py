"""A server makes a mesh of a picture: what it answers is taken in once, and what it refuses is said; stand-ins on the loopback."""

import base64
import json
import threading
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path

import cv2
import numpy as np
import pytest
import trimesh

from worldwright.intake import of_pictures
from worldwright.intake.minters import MintError, hunyuan3d
from worldwright.intake.refusing import IntakeFailedError
from worldwright.model.errors import NotFoundError

BOX = trimesh.creation.box((0.4, 1.0, 0.4)).export(file_type="glb")


class StandIn:
    """Answers each POST by the next of its replies: (status, body, headers)."""

    def __init__(self) -> None:
        self.replies: list[tuple[int, bytes, dict[str, str]]] = []
        self.asked: list[tuple[str, dict]] = []
        held = self

        class Handler(BaseHTTPRequestHandler):
            def do_POST(self) -> None:
                body = self.rfile.read(int(self.headers["Content-Length"]))
                held.asked.append((self.path, json.loads(body)))
                status, content, headers = held.replies.pop(0)
                self.send_response(status)
                for name, value in {"Content-Length": str(len(content)), **headers}.items():
                    self.send_header(name, value)
                self.end_headers()
                self.wfile.write(content)

            def log_message(self, *_: object) -> None:
                pass

        self.server = HTTPServer(("127.0.0.1", 0), Handler)
        self.address = f"http://127.0.0.1:{self.server.server_port}"
        threading.Thread(target=self.server.serve_forever, daemon=True).start()


@pytest.fixture
def stand_in() -> Iterator[StandIn]:
    made = StandIn()
    yield made
    made.server.shutdown()
    made.server.server_close()


@pytest.fixture
def picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("WORLDWRIGHT_ASSETS", str(tmp_path / "own"))
    monkeypatch.setattr(of_pictures, "data_root", lambda: tmp_path / "data")
    cv2.imwrite(str(tmp_path / "Tall Box.png"), np.full((8, 8, 3), 200, np.uint8))
    return tmp_path / "Tall Box.png"


def test_a_mesh_is_made_once_and_taken_in_at_its_height(stand_in: StandIn, picture: Path) -> None:
    stand_in.replies = [(200, BOX, {})]
    told = of_pictures.mint(picture, 0.5, address=stand_in.address, material="wood").data
    ((path, asked),) = stand_in.asked
    assert path == "/generate" and base64.b64decode(asked["image"]) == picture.read_bytes() and asked["type"] == "glb"
    assert told.key == "tall_box" and told.extents_m == pytest.approx((0.2, 0.2, 0.5), abs=1e-3) and told.stands
    assert any("licence is not stated" in line for line in told.mended)
    again = of_pictures.mint(picture, 1.0, key="taller", address=stand_in.address, material="wood").data
    assert again.extents_m[2] == pytest.approx(1.0) and len(stand_in.asked) == 1, "the same picture is not made twice"


@pytest.mark.parametrize(
    ("reply", "code", "said"),
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
def test_what_makes_no_mesh_is_said_by_a_code_and_nothing_is_kept(
    stand_in, picture, tmp_path, reply, code, said
) -> None:
    stand_in.replies = [reply]
    with pytest.raises(MintError, match=said) as told:
        of_pictures.mint(picture, 0.5, address=stand_in.address)
    assert told.value.code == code and told.value.next_move and not (tmp_path / "data").exists()
    assert code != "rate_limited" or "30 s" in told.value.next_move


def test_a_forged_mesh_is_refused_by_the_intake(stand_in: StandIn, picture: Path, tmp_path: Path) -> None:
    stand_in.replies = [(200, BOX[: len(BOX) // 2], {})]
    with pytest.raises(IntakeFailedError) as told:
        of_pictures.mint(picture, 0.5, address=stand_in.address)
    assert told.value.code == "truncated" and not list((tmp_path / "own").glob("*"))
    assert not list((tmp_path / "data/minted").iterdir()), "it is asked for anew"


def test_without_a_server_or_a_picture_the_way_on_is_told(picture: Path, monkeypatch) -> None:
    monkeypatch.delenv(hunyuan3d.variable(), raising=False)
    with pytest.raises(NotFoundError, match="no hunyuan3d server") as told:
        of_pictures.mint(picture, 0.5)
    assert "api_server" in told.value.next_move and "sculpt" in told.value.next_move
    with pytest.raises(NotFoundError, match="no kind of server") as unknown:
        of_pictures.mint(picture, 0.5, server="nothing")
    assert "hunyuan3d" in unknown.value.next_move
    for address in ("file:///etc/passwd", "http://127.0.0.1:9"):
        with pytest.raises(MintError) as refused:
            of_pictures.mint(picture, 0.5, address=address)
        assert refused.value.code == "unreachable"
    picture.write_bytes(b"no picture")
    with pytest.raises(IntakeFailedError, match="no PNG"):
        of_pictures.mint(picture, 0.5, address="http://127.0.0.1:9")


@pytest.mark.parametrize("address", ["http://[::1", "http://", "http://a:b", "ftp://a", ""])
def test_what_is_no_address_is_said(address: str) -> None:
    with pytest.raises(MintError, match="no address") as told:
        hunyuan3d.mint(b"", address)
    assert told.value.code == "unreachable" and told.value.next_move
