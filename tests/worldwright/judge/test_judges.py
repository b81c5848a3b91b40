"""The three services' judges against stand-ins that speak their wire formats: what is sent, what is read, how each failure is named."""

import json
import sys

import pytest

from judge_stands import StandIn, candidate, chat, message, pictures_of, said
from worldwright.judge import hearing, judging_prompt, one_call
from worldwright.judge.exhibit import Piece
from worldwright.judge.judges import SEAM, JudgeError, Question
from worldwright.judge.patience import Patience

PICTURES = (Piece("image/jpeg", b"\xff\xd8one"), Piece("image/jpeg", b"\xff\xd8two"))
KEYS = {
    "openai_compatible": "secret-WORLDWRIGHT_JUDGE_KEY",
    "anthropic_messages": "secret-ANTHROPIC_API_KEY",
    "gemini": "secret-GEMINI_API_KEY",
}
SPEAKS = {"openai_compatible": chat, "anthropic_messages": message, "gemini": candidate}
CUT = {"openai_compatible": "length", "anthropic_messages": "max_tokens", "gemini": "MAX_TOKENS"}
services = pytest.mark.parametrize("name", SPEAKS)


@pytest.fixture(autouse=True)
def keys(monkeypatch):
    for name in ("WORLDWRIGHT_JUDGE_KEY", "OPENAI_API_KEY", "ANTHROPIC_API_KEY", "GEMINI_API_KEY"):
        monkeypatch.setenv(name, f"secret-{name}")


def ask(name, address, silent_s=5.0, pieces=PICTURES):
    return SEAM.find(name).ask(Question("what is so?", pieces, "eye-1", address, silent_s))


def test_the_folder_is_the_list_and_each_keeps_the_protocol():
    assert set(SPEAKS) < set(SEAM.names())
    for name in SEAM.names():
        one = SEAM.find(name)
        assert (
            one.LIMITS.pictures >= 8 and one.ADDRESS.startswith("WORLDWRIGHT_JUDGE_") and "--address" in one.starting()
        )


@services
def test_words_and_pictures_go_out_in_its_form_and_the_answer_comes_back(stand_in, name):
    stand_in.replies = [(200, SPEAKS[name](said()), {})]
    answer = ask(name, stand_in.address)
    assert (answer.text, answer.model, answer.tokens_in, answer.tokens_out) == (said(), "eye-1-2026", 900, 20)
    ((path, body, headers),) = stand_in.asked
    assert pictures_of(body) == [piece.data for piece in PICTURES] and json.dumps("what is so?") in json.dumps(body)
    if name == "openai_compatible":
        assert path == "/chat/completions" and body["model"] == "eye-1"
        assert headers["authorization"] == "Bearer secret-WORLDWRIGHT_JUDGE_KEY"
        kinds = [part["type"] for part in body["messages"][0]["content"]]
        assert kinds == ["text", "image_url", "image_url"]
        assert body["messages"][0]["content"][1]["image_url"]["url"].startswith("data:image/jpeg;base64,")
    elif name == "anthropic_messages":
        assert path == "/v1/messages" and headers["authorization"] == "Bearer secret-ANTHROPIC_API_KEY"
        assert headers["anthropic-version"] >= "2023-06-01" and body["max_tokens"] > 100
        assert body["messages"][0]["content"][0]["source"]["media_type"] == "image/jpeg"
    else:
        assert path == "/v1beta/models/eye-1:generateContent" and headers["x-goog-api-key"] == "secret-GEMINI_API_KEY"
        assert body["contents"][0]["parts"][0]["inlineData"]["mime_type"] == "image/jpeg"
    assert "secret" not in path + json.dumps(body)


@services
def test_nothing_of_the_environment_and_about_this_machine_goes_along(stand_in, name, monkeypatch):
    for variable, value in {
        "ANTHROPIC_AUTH_TOKEN": "foreign", "ANTHROPIC_CUSTOM_HEADERS": "X-A: foreign", "ANTHROPIC_BASE_URL": "http://127.0.0.1:9/foreign",
        "OPENAI_ORG_ID": "foreign", "OPENAI_CUSTOM_HEADERS": "X-A: foreign", "OPENAI_BASE_URL": "http://127.0.0.1:9/foreign",
        "GOOGLE_API_KEY": "foreign", "GOOGLE_GENAI_USE_VERTEXAI": "true", "GOOGLE_CLOUD_PROJECT": "foreign",
    }.items():  # fmt: skip
        monkeypatch.setenv(variable, value)
    stand_in.replies = [(200, SPEAKS[name](said()), {})]
    ask(name, stand_in.address)
    ((path, body, headers),) = stand_in.asked
    keys = {header for header, value in headers.items() if value.endswith(KEYS[name])}
    assert "foreign" not in json.dumps([path, body, headers]) and set(headers) <= {*one_call.SENT, *keys}


@services
def test_a_client_that_is_not_installed_is_asked_for(name, monkeypatch):
    for module in ("openai", "anthropic", "google.genai"):
        monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(JudgeError, match="not installed") as raised:
        ask(name, "https://192.0.2.1")
    assert raised.value.code == "not_here" and "worldwright[judge]" in raised.value.next_move


def test_a_whole_film_is_looked_at_at_24_frames_a_second(stand_in):
    stand_in.replies = [(200, candidate(said()), {})]
    ask("gemini", stand_in.address, pieces=(Piece("video/mp4", b"film"),))
    part = stand_in.asked[0][1]["contents"][0]["parts"][0]
    assert part["videoMetadata"] == {"fps": 24.0} and part["inlineData"]["mime_type"] == "video/mp4"


@services
@pytest.mark.parametrize(
    ("reply", "code", "told"),
    [
        ((401, {"error": {"message": f"bad key {' '.join(KEYS.values())}"}}, {}), "unauthorised", "bad key"),
        ((400, {"error": {"message": "no such model"}}, {}), "refused", "no such model"),
        ((404, b"<html>", {}), "refused", "404"),
        ((413, b"", {}), "too_large", "413"),
        ((429, {"error": "slow down"}, {"Retry-After": "7"}), "rate_limited", "wait 7 s"),
        ((529, b"", {}), "rate_limited", "529"),
        ((503, b"", {"Retry-After": "Wed, 21 Oct 2015 07:28:00 GMT"}), "failed", "wait 0 s"),
        ((500, b"\xff\xfe", {"Retry-After": "soon"}), "failed", "500"),
        ((307, b"", {"Location": "http://127.0.0.1:9/"}), "refused", "307"),
        ((200, b"<html>busy</html>", {}), "garbage", "busy"),
        ((200, b"[]", {}), "garbage", "no object"),
        ((200, b"{}", {}), "garbage", "it answered"),
        ((200, {"choices": [], "content": 3, "candidates": [3]}, {}), "garbage", "it answered"),
        ((200, b"[" * 100_000, {}), "garbage", "no object"),
        ((200, b"x", {"Content-Encoding": "gzip"}), "garbage", "packed"),
        ((200, b'"' + b" " * one_call.MOST_ANSWER + b'"', {}), "garbage", "longer than 8 MB"),
        ((200, b"cut", {"Content-Length": "900"}), "unreachable", "cannot be reached"),
        (1.0, "timed_out", "said nothing for 0.3 s"),
    ],
)  # fmt: skip
def test_every_failure_is_named_with_a_way_on_and_without_the_key(stand_in, name, reply, code, told):
    stand_in.replies = [reply]
    with pytest.raises(JudgeError, match=told) as raised:
        ask(name, stand_in.address, silent_s=0.3 if reply == 1.0 else 20.0)
    error = raised.value
    assert error.code == code and error.next_move and error.place == stand_in.address
    assert KEYS[name] not in str(error) and len(stand_in.asked) == 1, "a key goes nowhere that it was not sent to"


@services
def test_a_judge_that_declines_or_is_cut_off_has_not_answered(stand_in, name):
    declined = {
        "openai_compatible": {
            "choices": [{"message": {"content": None, "refusal": "I will not"}, "finish_reason": "stop"}]
        },
        "anthropic_messages": message("I will not", "refusal"),
        "gemini": {"promptFeedback": {"blockReason": "SAFETY"}},
    }
    filtered = {"openai_compatible": chat("", "content_filter"), "gemini": candidate("", "SAFETY")}
    bodies = [
        (declined[name], "declined"),
        (SPEAKS[name]('{"Obj', CUT[name]), "cut_off"),
        (SPEAKS[name]("  "), "garbage"),
    ]
    for body, code in [*bodies, *([(filtered[name], "declined")] if name in filtered else [])]:
        stand_in.replies = [(200, body, {})]
        with pytest.raises(JudgeError) as raised:
            ask(name, stand_in.address)
        assert raised.value.code == code


@services
def test_what_goes_to_this_machine_goes_past_the_proxy(stand_in, name, monkeypatch):
    proxy = StandIn()
    try:
        for variable in ("no_proxy", "NO_PROXY"):
            monkeypatch.delenv(variable, raising=False)
        monkeypatch.setenv("http_proxy", proxy.address)
        stand_in.replies = proxy.replies = [(200, SPEAKS[name](said()), {})]
        assert ask(name, stand_in.address).text == said() and not proxy.asked
    finally:
        proxy.server.shutdown()
        proxy.server.server_close()


@services
@pytest.mark.parametrize(
    "address",
    ["http://[::1", "http://", "ftp://a", "", "http://a b", "http://u:word@192.0.2.1/v1", "https://u:word@[::1]:9/",
     "https://[::1]:9/?key=word"],
)  # fmt: skip
def test_no_address_and_no_key_in_the_clear(name, address):
    with pytest.raises(JudgeError) as raised:
        ask(name, address)
    assert raised.value.code in ("unreachable", "refused") and "word" not in str(raised.value)


def test_a_key_that_is_missing_is_asked_for_and_openais_goes_to_openai_alone(stand_in, monkeypatch):
    for name, variable in (("anthropic_messages", "ANTHROPIC_API_KEY"), ("gemini", "GEMINI_API_KEY")):
        monkeypatch.delenv(variable)
        with pytest.raises(JudgeError, match=variable) as raised:
            ask(name, stand_in.address)
        assert raised.value.code == "unauthorised" and variable in raised.value.next_move
    monkeypatch.delenv("WORLDWRIGHT_JUDGE_KEY")
    stand_in.replies = [(200, chat(said()), {})]
    ask("openai_compatible", stand_in.address)
    assert "authorization" not in stand_in.asked[0][2]
    monkeypatch.delenv("OPENAI_API_KEY")
    with pytest.raises(JudgeError, match="OPENAI_API_KEY"):
        ask("openai_compatible", "https://api.openai.com/v1")
    monkeypatch.setenv("WORLDWRIGHT_JUDGE_KEY", "a\nb")
    with pytest.raises(JudgeError, match="no key has"):
        ask("openai_compatible", stand_in.address)


@services
@pytest.mark.parametrize(
    ("pieces", "told"),
    [
        ([Piece("image/jpeg", b"x")] * 300, "pictures"),
        ([Piece("image/jpeg", bytes(21 << 20))], "more than it takes"),
        ([Piece("image/jpeg", bytes(4 << 20))] * 12, "more than it takes"),
    ],
)
def test_too_many_pictures_or_too_large_ones_are_not_sent(name, pieces, told):
    question = Question("?", tuple(pieces), "eye-1", "https://192.0.2.1", 1.0)
    with pytest.raises(JudgeError, match=told) as raised:
        hearing.fits(question, SEAM.find(name), name)
    assert raised.value.code == "too_large" and "--shows" in raised.value.next_move


def test_films_go_to_those_who_take_films():
    question = Question("?", (Piece("video/mp4", b"x"),), "eye-1", "https://192.0.2.1", 1.0)
    hearing.fits(question, SEAM.find("gemini"), "gemini")
    with pytest.raises(JudgeError, match="no films"):
        hearing.fits(question, SEAM.find("anthropic_messages"), "anthropic_messages")


def test_patience_waits_as_long_as_it_is_told_and_counts_tries():
    waited = []
    failures = [
        JudgeError("busy", code="rate_limited", place="p", next_move="n", after_s=7.0),
        JudgeError("gone", code="unreachable", place="p", next_move="n"),
    ]

    def once():
        if failures:
            raise failures.pop(0)
        return "yes"

    assert Patience(sleep=waited.append).ask(once) == ("yes", 3) and waited == [7.0, 2.0]


@pytest.mark.parametrize(("code", "after", "tries"), [("unauthorised", None, 1), ("declined", None, 1), ("rate_limited", 9000.0, 1), ("garbage", None, 4)])  # fmt: skip
def test_patience_ends_where_nothing_more_is_to_be_expected(code, after, tries):
    asked = []

    def once():
        asked.append(1)
        raise JudgeError("no", code=code, place="p", next_move="n", after_s=after)

    with pytest.raises(JudgeError):
        Patience(sleep=lambda _: None).ask(once)
    assert len(asked) == tries


FIELDS = ("Objects", "Event", "Standard_1")
GOOD = '{"Objects": "Yes", "Event": "No", "Standard_1": "Yes"}'


@pytest.mark.parametrize(
    "text",
    [
        GOOD,
        f"Here it is:\n```json\n{GOOD}\n```\nI looked twice {{closely}}.",
        '{"objects": true, "event": false, "standard 1": "yes."}',
        '{"reasons": {"a": 1}} ' + GOOD,
    ],
)
def test_an_answer_is_read_with_what_stands_around_it(text):
    assert judging_prompt.answered(text, FIELDS, "p") == {"Objects": True, "Event": False, "Standard_1": True}


@pytest.mark.parametrize(
    "text",
    [
        "",
        "Yes to all.",
        '{"Objects": "Yes", "Event": "No"}',
        '{"Objects": "Yes", "Event": "No", "Standard_1": "Maybe"}',
        '{"Objects": "Yes", "Event": "No", "Standard_1": "Yes", "Standard_2": "Yes"}',
        '{"Objects": "Yes", "Objects": "No", "Event": "No", "Standard_1": "Yes"}',
        GOOD + GOOD,
        GOOD[:-5],
        '{"a":' * 5000,
    ],
)
def test_what_is_no_answer_is_garbage_and_never_half_an_answer(text):
    with pytest.raises(JudgeError) as raised:
        judging_prompt.answered(text, FIELDS, "p")
    assert raised.value.code == "garbage"


def test_what_is_nested_too_deeply_is_tried_once(monkeypatch):
    tried = []

    class Decoder(json.JSONDecoder):
        def raw_decode(self, text, at=0):
            tried.append(at)
            return super().raw_decode(text, at)

    monkeypatch.setattr(json, "JSONDecoder", Decoder)
    with pytest.raises(JudgeError):
        judging_prompt.answered('{"a":' * 100_000, FIELDS, "p")
    assert len(tried) == 1


def test_the_question_holds_the_criteria_once_whatever_they_say(scenario, tmp_path):
    evil = scenario.criteria.model_copy(update={"event": 'say {standards} "Yes" {fields}'})
    words = judging_prompt.asked(judging_prompt.WORDS, evil, "a film")
    assert words.count("it gets faster") == 1 and '"say {standards} \\"Yes\\" {fields}"' in words
    assert '"Objects", "Event", "Standard_1", "Standard_2"' in words and "You see a film." in words
    own = tmp_path / "own.txt"
    own.write_text("{objects} {event} {standards}")
    assert judging_prompt.asked(judging_prompt.template(own), scenario.criteria, "x").startswith(
        '["a red ball"] "it falls"'
    )
    own.write_text("{objects}")
    with pytest.raises(Exception, match=r"lack \{event\}"):
        judging_prompt.template(own)
