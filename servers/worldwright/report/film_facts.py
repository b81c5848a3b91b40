"""What the report says of the author's film: what is drawn only, what runs fast, what is rolled over, and the author's words."""

from typing import Any


def rows(film: dict[str, Any]) -> list[tuple[str, str]]:
    """The rows of its table, (name, value), from what the video pass says of it; a value is empty where there is nothing."""
    looks = (f"{name} as {look}" for name, look in film.get("looks", {}).items())
    hidden = (f"{what} for {seconds:g} s" for what, seconds in film.get("hidden", {}).items())
    return [
        ("drawn only, not simulated", ", ".join(film.get("drawn_only", ())) or "nothing"),
        ("looks of its own", ", ".join(looks)),
        ("hidden by what is drawn", ", ".join(hidden)),
        ("the author's words in the picture, no evidence", "; ".join(quoted(film))),
        ("shots", "; ".join(_shot(shot) for shot in film.get("shots", ()))),
        ("recorded seconds in a second of film", "; ".join(_pace(row) for row in film.get("time_map", ()))),
    ]


def quoted(film: dict[str, Any]) -> list[str]:
    """The film's captions, word for word, each in quotation marks."""
    return [f"“{text}”" for text in film.get("captions", ())]


def _shot(shot: dict[str, Any]) -> str:
    leapt = shot.get("leap_s") or 0.0
    leap = f", {abs(leapt):g} s {'after' if leapt > 0 else 'back before'} the end of the shot before" if leapt else ""
    rolled = f", camera rolled by {shot['rolled_deg']:g}°" if shot.get("rolled_deg") else ""
    return f"{shot['from_s']:g} to {shot['to_s']:g} s at {shot['speed']:g} × speed{leap}{rolled}"


def _pace(row: dict[str, float]) -> str:
    back = f", going back {row['back_s']:g} s by cuts" if row.get("back_s") else ""
    return f"{row['pace']:g} from {row['film_s']:g} to {row['film_s'] + row['seconds']:g} s{back}"
