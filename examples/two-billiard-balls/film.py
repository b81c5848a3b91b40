"""Two balls on a table by night: both in one picture as they come, the blow slowly from the cloth, both again as they part."""

from worldkit.filming import Film, follow, still


def film(film: Film) -> None:
    film.set("living_room", facing_deg=-60, hour="night")
    film.lamp("pool lamp", (0, 0, 1.75), strength=1.6, colour="#ffdfae", radius=0.12, aim=(0, 0, 0.78), seen=False)
    film.grade(contrast=1.1, vignette=0.3)
    blow = film.recorded.event()
    both = ["cue_ball", "object_ball"]
    x, y, z = film.recorded.position("object_ball", blow)
    film.shot(follow(both, azimuth_deg=-66, elevation_deg=16, room=1.25, lens_mm=40), until=blow - 0.06, speed=0.6)
    film.shot(
        still((x + 0.16, y - 0.46, z + 0.09), (x, y, z), lens_mm=42, focus="object_ball", aperture=11),
        until=blow + 0.12,
        speed=0.08,
    )
    film.shot(follow(both, azimuth_deg=-62, elevation_deg=22, room=1.25, lens_mm=40), until=film.recorded.duration)
