"""How a recorded world is filmed: what `film.py`, beside `simulation.py` in a run folder, imports.

    from worldkit.filming import Film, follow, orbit

    def film(film: Film) -> None:
        film.mood("golden_hour")
        film.shot(orbit("marble", azimuth_deg=(-70, -40)), until=1.0)
        film.shot(follow("marble", lens_mm=50), until=1.6, speed=0.25)

The film's author sees the recording and nothing else, and says what is to be shown: the result is a description (numbers,
names, pictures), which the engine's process checks and draws. Bodies stand where the recording says; what is drawn and
not simulated, and every look that is not the world's own, is listed in the statement and the report.

Lengths are metres in the world's frame (z up), angles degrees, recorded times seconds of the recording, film times
seconds of the film.
"""

from .director import Film
from .drawn_only import Surface
from .moods import MOODS
from .recorded import Recorded, Touch
from .viewpoints import Viewpoint, along, follow, orbit, planned, ride, still, wide

__all__ = [
    "MOODS",
    "Film",
    "Recorded",
    "Surface",
    "Touch",
    "Viewpoint",
    "along",
    "follow",
    "orbit",
    "planned",
    "ride",
    "still",
    "wide",
]
