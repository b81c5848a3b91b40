"""What every server of meshes and pictures is asked, and what is said of each way in which it makes none; stand-ins on the loopback."""

import base64
import json
from collections.abc import Iterator
from pathlib import Path

import pytest

from stub_servers import BOX, StandIn, said, stand_in
from worldwright.intake import web_calls
from worldwright.intake.gradio_session import MOST_BEATS
from worldwright.intake.minters import SEAM, meshy, triposr
from worldwright.intake.orders import Order, Price
from worldwright.intake.painters import google_images, openai_images
from worldwright.intake.web_calls import MintError, Server

PNG = b"\x89PNG\r\n\x1a\n picture"
KEY = "sk-secret-0123456789"


@pytest.fixture
def there(monkeypatch: pytest.MonkeyPatch) -> Iterator[StandIn]:
    monkeypatch.setattr(web_calls, "PAUSE_S", 0.0)
    monkeypatch.setattr(web_calls, "MOST_PAUSE_S", 0.0)
    with stand_in() as made:
        yield made


@pytest.fixture
def order(tmp_path: Path) -> Order:
    return Order(tmp_path / "work.ordered")


def keyed(there: StandIn) -> Server:
    return Server(there.address, "start it", KEY)


def failing(code: str, action) -> MintError:
    """The error of an action; it names the next move, and no key."""
    with pytest.raises(MintError) as told:
        action()
    assert told.value.code == code and told.value.next_move and KEY not in str(told.value)
    assert all(text.isprintable() for text in (told.value.cause, told.value.place, told.value.next_move))
    return told.value


# -- Gradio ------------------------------------------------------------------------------------------------------------
PARTS = {1: "image", 2: "gallery", 3: "state", 4: "slider", 5: "radio", 6: "model3d"}
VALUES = {4: 7.5, 5: "stochastic"}


def gradio(there: StandIn, answers: dict[str, list], inputs: dict[str, list[int]], prefix: str = "/gradio_api") -> None:
    """An app with functions; each is answered by the next of the events."""
    rows = [{"id": k, "api_name": name, "inputs": inputs.get(name, [])} for k, name in enumerate(answers)]
    parts = [{"id": k, "type": kind, "props": {"value": VALUES.get(k)}} for k, kind in PARTS.items()]
    there.replies |= {
        "/config": [said({"api_prefix": prefix, "dependencies": rows, "components": parts})],
        f"{prefix}/upload": [said(["/tmp/gradio/ab/picture.png"])],
        f"{prefix}/queue/join": [said({"event_id": "e"})],
        f"{prefix}/queue/data": [stream(*events) for events in answers.values()],
        f"{prefix}/file=/tmp/gradio/sample.glb": [(200, BOX, {})],
    }


def stream(*events: dict) -> tuple[int, bytes, dict[str, str]]:
    return 200, "".join(f"data: {json.dumps(one)}\n\n" for one in events).encode(), {}


def done(*data: object) -> list[dict]:
    events = [{"msg": "estimation", "event_id": "e"}, {"msg": "heartbeat"}, {"msg": "process_starts", "event_id": "e"}]
    return [*events, {"msg": "process_completed", "event_id": "e", "success": True, "output": {"data": list(data)}}]


GLB = {"path": "/tmp/gradio/sample.glb", "url": "http://elsewhere.invalid/sample.glb"}


@pytest.mark.parametrize("prefix", ["/gradio_api", ""])  # Gradio 5 and later; 4
def test_trellis_is_asked_step_by_step_with_what_the_app_itself_begins_with(there, order, prefix) -> None:
    cut = {"path": "/tmp/gradio/cut.png", "url": "x"}
    answers = {"start_session": done(), "preprocess_image": done(cut), "image_to_3d": done(None, {"video": GLB})}
    heard: list[str] = []
    order.hears = heard.append
    gradio(
        there,
        {**answers, "extract_glb": done(GLB, GLB)},
        {"preprocess_image": [1], "image_to_3d": [1, 2, 3, 4, 5]},
        prefix,
    )
    assert SEAM.find("trellis").mint(PNG, Server(there.address, "start it"), order) == BOX
    asked = there.json(f"{prefix}/queue/join")
    assert [one["fn_index"] for one in asked] == [0, 1, 2, 3] and len({one["session_hash"] for one in asked}) == 1
    assert asked[1]["data"][0]["path"] == "/tmp/gradio/ab/picture.png"
    (image, gallery, state, slider, radio) = asked[2]["data"]
    assert image["path"] == cut["path"] and (gallery, state, slider, radio) == (None, None, 7.5, "stochastic")
    assert heard and PNG in next(body for _, path, body, _ in there.asked if path == f"{prefix}/upload")


def test_triposr_answers_a_mesh_and_its_failures_are_said(there, order) -> None:
    def ask(generate: list[dict]) -> bytes:
        gradio(there, {"preprocess": done(GLB), "generate": generate}, {})
        return triposr.mint(PNG, Server(there.address, "start it"), order)

    assert ask(done(GLB)) == BOX
    failed = {"msg": "process_completed", "event_id": "e", "success": False, "output": {"error": "no luck today"}}
    assert "no luck today" in failing("refused", lambda: ask([failed])).cause
    assert (
        "went down" in failing("refused", lambda: ask([{"msg": "unexpected_error", "message": "it went down"}])).cause
    )
    assert "heartbeats" in failing("stalled", lambda: ask([{"msg": "heartbeat"}] * (MOST_BEATS + 1))).cause
    failing("unreachable", lambda: ask([{"msg": "estimation", "event_id": "e"}]))
    failing("garbage", lambda: ask(done("no file")))
    failing("garbage", lambda: ask(done(json.loads("[" * 900 + "]" * 900))))
    gradio(there, {"preprocess": done(GLB), "generate": done(GLB)}, {"preprocess": 3, "generate": [[1], {}]})
    assert triposr.mint(PNG, Server(there.address, "start it"), order) == BOX, "what is no list of inputs is none"
    gradio(there, {"something_else": done()}, {})
    error = failing("refused", lambda: triposr.mint(PNG, Server(there.address, "start it"), order))
    assert "something_else" in error.cause and "--server" in error.next_move
    there.replies["/config"] = [said({"detail": "login"}, 401)]
    failing("refused", lambda: triposr.mint(PNG, Server(there.address, "start it"), order))
    there.replies["/config"] = [(200, b"<html>", {})]
    failing("garbage", lambda: triposr.mint(PNG, Server(there.address, "start it"), order))


@pytest.mark.parametrize("prefix", ["80/x", "@elsewhere.invalid", 7], ids=["a port", "a host", "no text"])
def test_an_app_whose_functions_lie_at_no_path_is_refused(there, order, prefix) -> None:
    gradio(there, {"preprocess": done(GLB), "generate": done(GLB)}, {}, prefix)
    failing("garbage", lambda: triposr.mint(PNG, Server(there.address, "start it"), order))


def test_a_file_whose_name_is_no_text_is_asked_for_and_not_found(there, order) -> None:
    gradio(there, {"preprocess": done(GLB), "generate": done({"path": "/tmp/\ud800.glb"})}, {})
    failing("expired", lambda: triposr.mint(PNG, Server(there.address, "start it"), order))


# -- Services that are paid --------------------------------------------------------------------------------------------
HOSTED = {
    "meshy": {
        "begun": {meshy.WORK: said({"result": "0193-ab"})},
        "work": f"{meshy.WORK}/0193-ab",
        "running": said({"status": "IN_PROGRESS", "progress": 40}),
        "failed": said({"status": "FAILED", "task_error": {"message": f"no thing is seen, {KEY}"}}),
        "odd": said({"status": "ODD"}),
        "done": lambda url: said({"status": "SUCCEEDED", "consumed_credits": 35, "model_urls": {"glb": url}}),
        "empty": said({"status": "SUCCEEDED", "model_urls": {}}),
    },
    "tripo": {
        "begun": {
            "/v2/openapi/upload/sts": said({"code": 0, "data": {"image_token": "t"}}),
            "/v2/openapi/task": said({"code": 0, "data": {"task_id": "0193-ab"}}),
        },
        "work": "/v2/openapi/task/0193-ab",
        "running": said({"code": 0, "data": {"status": "running", "progress": 40}}),
        "failed": said({"code": 2008, "message": f"it violates the rules, {KEY}"}, 400),
        "odd": said({"code": 0, "data": {"status": "odd"}}),
        "done": lambda url: said({"code": 0, "data": {"status": "success", "output": {"pbr_model": url}}}),
        "empty": said({"code": 0, "data": {"status": "success", "output": {}}}),
    },
}


@pytest.fixture(params=sorted(HOSTED))
def hosted(request, there: StandIn, order: Order):
    """A service, how it speaks, and a way to have it mint once its work is answered so."""
    speaks = HOSTED[request.param]

    def minted(*replies) -> bytes:
        there.replies |= {path: [reply] for path, reply in speaks["begun"].items()}
        there.replies[speaks["work"]] = list(replies)
        return SEAM.find(request.param).mint(PNG, keyed(there), order)

    return speaks, minted


def test_paid_work_is_asked_after_and_fetched_without_the_key_elsewhere(hosted, there, order) -> None:
    speaks, minted = hosted
    with stand_in() as shop:
        shop.replies["/signed.glb"] = [(200, BOX, {})]
        busy = (429, b"", {"Retry-After": "1"})
        assert minted(speaks["running"], busy, speaks["done"](f"{shop.address}/signed.glb?sig=1")) == BOX
    assert all(headers.get("Authorization") == f"Bearer {KEY}" for *_, headers in there.asked)
    assert "Authorization" not in shop.asked[0][3] and order.said in ([], ["it took 35 credits, not 30"])
    assert order.file.read_text() == "0193-ab", "it is forgotten by whoever keeps the mesh"


def test_work_that_was_begun_is_not_paid_again(hosted, there, order) -> None:
    speaks, minted = hosted
    there.replies["/gone.glb"] = [(403, b"expired", {}), (200, BOX, {})]
    ready = speaks["done"](f"{there.address}/gone.glb")
    error = failing("expired", lambda: minted(ready))
    assert "ask again" in error.next_move and order.file.read_text() == "0193-ab"
    begun = len([path for path in there.paths() if path in speaks["begun"]])
    assert minted(ready) == BOX
    assert len([path for path in there.paths() if path in speaks["begun"]]) == begun
    failing("refused", lambda: minted(speaks["failed"]))
    failing("garbage", lambda: minted(speaks["odd"]))
    failing("garbage", lambda: minted(speaks["empty"]))


def test_work_that_tells_of_no_progress_is_given_up_by_count(hosted, there, monkeypatch) -> None:
    speaks, minted = hosted
    monkeypatch.setattr(web_calls, "MOST_SAME", 5)
    failing("stalled", lambda: minted(speaks["running"]))
    assert there.paths().count(speaks["work"]) == 6


def test_a_service_that_begins_nothing_keeps_nothing(hosted, there, order) -> None:
    speaks, _ = hosted
    for reply, code in [
        (said({"message": f"your key {KEY} is wrong"}, 401), "refused"),
        (said({"message": "no credits"}, 402), "refused"),
        ((429, b"", {"Retry-After": "30"}), "rate_limited"),
        ((200, b"[]", {}), "garbage"),
        ((307, b"", {"Location": "http://elsewhere.invalid/work"}), "redirected"),
    ]:
        there.replies |= {path: [reply] for path in speaks["begun"]}
        name = "tripo" if "/v2/openapi/task" in speaks["begun"] else "meshy"
        wanted = "refused" if (name, code) == ("tripo", "garbage") else code
        failing(wanted, lambda name=name: SEAM.find(name).mint(PNG, keyed(there), order))
        assert not order.file.exists()


# -- Pictures of words -------------------------------------------------------------------------------------------------
def test_a_picture_is_painted_in_either_way_of_speaking(there) -> None:
    held = base64.b64encode(PNG).decode()
    there.replies["/v1/images/generations"] = [said({"data": [{"b64_json": held}]})]
    assert openai_images.paint("a mug", openai_images.MODEL, keyed(there)) == PNG
    there.replies["/made.png"] = [(200, PNG, {})]
    there.replies["/v1/images/generations"] = [said({"data": [{"url": f"{there.address}/made.png"}]})]
    assert openai_images.paint("a mug", "dall-e-2", keyed(there)) == PNG
    first, second = there.json("/v1/images/generations")
    assert first["prompt"] == "a mug" and first["quality"] == "medium" and "quality" not in second
    path = "/v1beta/models/gemini-2.5-flash-image:generateContent"
    parts = [{"text": "here it is"}, {"inlineData": {"mimeType": "image/png", "data": held}}]
    there.replies[path] = [said({"candidates": [{"content": {"parts": parts}}]})]
    server = Server(there.address, "start it", KEY, "x-goog-api-key")
    assert google_images.paint("a mug", google_images.MODEL, server) == PNG
    assert {name.lower(): value for name, value in there.asked[-1][3].items()}["x-goog-api-key"] == KEY


@pytest.mark.parametrize(
    ("reply", "code"),
    [
        (said({"error": {"message": f"{KEY} was refused by the safety system"}}, 400), "refused"),
        (said({"candidates": [{"content": {"parts": [{"text": "I will not"}]}}], "data": []}), None),
        (said({"promptFeedback": {"blockReason": "SAFETY"}, "data": [3]}), None),
        (said({"candidates": 3, "data": 3}), "garbage"),
        (
            said(
                {"candidates": [{"content": {"parts": [{"inlineData": {"data": "#"}}]}}], "data": [{"b64_json": "#"}]}
            ),
            "garbage",
        ),
        (
            said(
                {"candidates": [{"content": {"parts": [{"inlineData": {"data": "é"}}]}}], "data": [{"b64_json": "é"}]}
            ),
            "garbage",
        ),
        ((200, b"{", {}), "garbage"),
    ],
)
def test_what_paints_nothing_is_said(there, reply, code) -> None:
    there.replies |= {"/v1/images/generations": [reply], "/v1beta/models/m:generateContent": [reply]}
    failing(code or "garbage", lambda: openai_images.paint("a mug", "m", keyed(there)))
    failing(code or "refused", lambda: google_images.paint("a mug", "m", keyed(there)))


def test_what_a_server_says_moves_no_terminal_and_can_be_written(there) -> None:
    there.replies["/v1/images/generations"] = [said({"error": {"message": "no \ud800 luck \x1b[2J"}}, 400)]
    assert "luck" in failing("refused", lambda: openai_images.paint("a mug", "m", keyed(there))).cause
    for url in ("http://[", "http://a\ud800\x1b/x"):
        there.replies["/v1/images/generations"] = [said({"data": [{"url": url}]})]
        failing("unreachable", lambda: openai_images.paint("a mug", "m", keyed(there)))
    failing("garbage", lambda: Server("https://example.invalid", "start it", KEY).download("http://["))


# -- What holds for all ------------------------------------------------------------------------------------------------
def test_an_answer_is_bounded_and_leads_nowhere_else(there, monkeypatch) -> None:
    server = keyed(there)
    monkeypatch.setattr(web_calls, "MOST_ANSWER", 100)
    there.replies["/big"] = [(200, b"x" * 101, {})]
    failing("too_large", lambda: server.download(f"{there.address}/big"))
    there.replies["/cut"] = [(200, b"x", {"Content-Length": "50"})]
    failing("unreachable", lambda: server.download(f"{there.address}/cut"))
    there.replies |= {"/near": [(302, b"", {"Location": "/here"})], "/here": [said({"a": 1})]}
    assert server.get("/near") == {"a": 1}
    with stand_in() as elsewhere:
        there.replies["/far"] = [(302, b"", {"Location": f"{elsewhere.address}/x?key=1"})]
        assert "?" not in str(failing("redirected", lambda: server.get("/far")))
        assert not elsewhere.asked
    secure = Server("https://example.invalid", "start it", KEY)
    failing("garbage", lambda: secure.download("http://example.invalid/a.glb"))
    failing("garbage", lambda: secure.download("file:///etc/passwd"))
    failing("unreachable", lambda: server.download("file:///etc/passwd"))


@pytest.mark.parametrize(
    "address", ["http://[::1", "http://", "http://a:b", "ftp://a", "", "localhost:9", "http://127.0.0.1:9"]
)
def test_what_is_no_address_is_said(address: str) -> None:
    place = failing("unreachable", lambda: Server(address, "start it", KEY).get("/")).place
    assert place.startswith(address[:6].rstrip("/"))


def test_a_price_passes_only_as_it_is() -> None:
    paid, unknown = Price(30.0, "credits", "a list"), Price(None, "credits", "a list")
    Price().confirm(None, "own")
    paid.confirm(30, "meshy")
    unknown.confirm(0, "own model")
    for price, told in [
        (paid, None),
        (paid, 29.0),
        (paid, 31.0),
        (unknown, None),
        (unknown, -1.0),
        (unknown, float("nan")),
    ]:
        failing("price", lambda price=price, told=told: price.confirm(told, "it"))
    assert "--confirm-price 30" in failing("price", lambda: paid.confirm(None, "meshy")).next_move


def test_every_server_says_how_it_is_come_by_and_a_key_is_in_no_word_of_it(monkeypatch) -> None:
    from worldwright.intake import painters

    variables = set()
    for seam in (SEAM, painters.SEAM):
        for name in seam.names():
            terms = seam.find(name).TERMS
            assert (
                terms.variable.startswith("WORLDWRIGHT_")
                and terms.starting
                and bool(terms.address) == bool(terms.key_variable)
            )
            variables.add(terms.variable)
            if terms.key_variable:
                for wrong in ("", "  ", "a\nb"):
                    monkeypatch.setenv(terms.key_variable, wrong)
                    assert (
                        failing("no_key", lambda terms=terms, name=name: terms.server(name)).place == terms.key_variable
                    )
                monkeypatch.setenv(terms.key_variable, KEY)
                assert KEY not in repr(terms.server(name)) and terms.server(name).key == KEY and terms.ready()
    assert len(variables) == len(SEAM.names()) + len(painters.SEAM.names()) == 7
