"""Light, sky and air as a film tells them: what is left out, and how far fog reaches up."""

import numpy as np
import pytest

from worldengine.film.treatment import PLAIN, Treatments
from worldkit.errors import ProgramError
from worldkit.filming import Film, Recorded
from worldkit.filming.drawn_only import rgb
from worldkit.filming.moods import MOODS


def film() -> Film:
    return Film(Recorded.rehearsal({"ball": np.zeros((10, 3))}, duration=1.0))


def treated(told: Film):
    return Treatments(told.description()[0]["air"]).at(0.0)


def test_clouds_alone_are_those_of_the_sky_that_was_told_or_of_noon() -> None:
    alone = film()
    alone.sky(clouds=0.4)
    assert treated(alone).sky_clouds == 0.4 and treated(alone).sky_zenith == rgb(MOODS["noon"]["sky"]["zenith"])
    golden = film()
    golden.mood("golden_hour")
    golden.sky(clouds=0.9)
    assert treated(golden).sky_clouds == 0.9 and treated(golden).sky_zenith == rgb("#5f86b8")
    assert treated(golden).sky_glow == MOODS["golden_hour"]["sky"]["glow"]
    stated = film()
    stated.recorded.light = {"sky": "overcast"}
    stated.sky(clouds=0.7)
    assert treated(stated).sky_zenith == rgb(MOODS["overcast"]["sky"]["zenith"])


def test_a_whole_sky_leaves_nothing_of_another_and_half_of_one_is_refused() -> None:
    told = film()
    told.set("studio")
    assert treated(told).sky_indoors == 1
    told.sky(zenith="#3f74c8", horizon="#bcd6f2")
    assert treated(told).sky_indoors == 0 and treated(told).sky_clouds == 0
    with pytest.raises(ProgramError, match="zenith and its horizon"):
        told.sky(zenith="#3f74c8")


def test_fog_without_a_height_leaves_the_sky_its_colour_unless_it_is_thick() -> None:
    def hidden(visibility_m: float, elevation_deg: float, **more: float) -> float:
        told = film()
        told.fog(visibility_m=visibility_m, **more)
        air = treated(told)
        return float(1 - np.exp(-air.fog_density * air.fog_over_m / np.sin(np.radians(elevation_deg))))

    assert hidden(400, 30) < 0.15 < hidden(400, 60) + 0.15 and hidden(400, 2) > 0.85
    assert hidden(30, 60) > 0.99 and hidden(100, 30) > 0.5
    assert hidden(400, 30, height_m=60) > 0.5  # a height that is told counts as before
    assert PLAIN.fog_over_m > 0
