"""The report's table of a film has the author's words as the author's, leaps, rolls and the time map."""

from worldwright.report import film_facts


def test_what_a_film_shows_otherwise_than_it_was_stands_in_the_report():
    shot = {"from_s": 1.0, "to_s": 1.5, "speed": 1.0}
    rows = dict(
        film_facts.rows(
            {
                "captions": ["The ball leaps by itself"],
                "shots": [shot, shot | {"leap_s": 0.4, "rolled_deg": 180.0}],
                "time_map": [{"film_s": 0.0, "seconds": 2.0, "pace": 3.0}],
            }
        )
    )
    back = film_facts.rows(
        {
            "shots": [shot, shot | {"leap_s": -0.4}],
            "time_map": [{"film_s": 0.0, "seconds": 1.0, "pace": -1.5, "back_s": 2.0}],
        }
    )
    assert rows["the author's words in the picture, no evidence"] == "“The ball leaps by itself”"
    assert rows["shots"].endswith("speed, 0.4 s after the end of the shot before, camera rolled by 180°")
    assert dict(back)["shots"].endswith("speed, 0.4 s back before the end of the shot before")
    assert dict(back)["recorded seconds in a second of film"] == "-1.5 from 0 to 1 s, going back 2 s by cuts"
    assert rows["recorded seconds in a second of film"] == "3 from 0 to 2 s"
    assert rows["drawn only, not simulated"] == "nothing"
