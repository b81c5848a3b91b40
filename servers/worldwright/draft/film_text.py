"""Write a first `film.py`: the place that the plan's words name, light from the side, the event in one composed shot and a close one.

It reckons its shots from the recording, so it holds for any plan, whatever comes to move, and is seen as soon as the claims hold.
It is meant to be changed: the places to do so are marked. Nobody's own film is written over.
"""

from worldkit.filming.sets import names

from ..model.plan.committed import Plan
from .python_text import plain

TITLE_LENGTH, WIDTH = 68, 118

TEXT = '''"""A first film of "{title}", drafted from its plan: change it (skill `film`).

See it move, small, within seconds: `worldwright stage frames RUN --show moving`; each shot larger: `--show shots`.
"""

from worldkit.filming import Film, hero


def film(film: Film) -> None:
    """Where it is, the light, the shots."""
    recorded = film.recorded
    # CHANGE from where it is seen, degrees from +x and above the floor: the motion goes across, and nothing stands before it.
    side, up = hero.view(recorded, lowest_deg=8)

    # CHANGE the place: this is what the plan's words name. Others, as film.set("park", facing_deg=side, hour="dusk"):
{sets}
    film.usual_set(facing_deg=side)
{light}
    # One shot holds the whole event. CHANGE the lens, or write its camera: follow("ball", …), still((x, y, z), "ball").
    event, end, speed = recorded.event(), hero.settled(recorded), hero.pace(recorded)
    whole = hero.composed(recorded, (side, up), lens_mm=70)
    # CHANGE when to go near, recorded s, and how large it is then; a cut is worth it where either shot lasts two seconds.
    cut = event - 0.8
    if min(cut, end - cut) < 2.0 * speed:
        film.shot(whole, until=end, speed=speed)
    else:
        film.shot(whole, until=cut, speed=speed)
        film.shot(hero.close(recorded, (side, up), large=0.3, lens_mm=85), until=end, speed=speed)
'''
OUTDOORS = """
    # CHANGE the light: from the side it models what moves; from behind, at side + 130, it rims it, and darkens it.
    # Or an hour, which sets all: film.mood("golden_hour").
    film.light(azimuth_deg=side + 95, elevation_deg=35)
"""
AS_IT_IS = """
    # CHANGE the light: {why}. Best from behind or the side:
    # film.light(azimuth_deg=side + 95, elevation_deg=30)
"""
STATED, OF_THE_ROOM = "the plan states its own, which stays", "the set's window and lamps give it"


def film_text(plan: Plan) -> str:
    """The text of a first `film.py` for a plan."""
    title = plain(plan.title).replace("\\", "/").replace('"', "'")[:TITLE_LENGTH].strip() or "a world"
    shown = plan.visualization
    if shown.setting == "outdoor" and not shown.light:
        light = OUTDOORS
    else:
        light = AS_IT_IS.format(why=STATED if shown.light else OF_THE_ROOM)
    return TEXT.format(title=title, sets=_lines(names()), light=light)


def _lines(words: tuple[str, ...]) -> str:
    """Words in comments of a function's body, as many as fit into a line."""
    lines = [""]
    for word in words:
        if len(lines[-1]) + len(word) > WIDTH - 8:
            lines.append("")
        lines[-1] += f"{word}, " if word != words[-1] else word
    return "\n".join(f"    # {line.strip()}" for line in lines)
