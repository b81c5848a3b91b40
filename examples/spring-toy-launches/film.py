"""A toy on a wooden floor in a living room: pressed and let go slowly, then its whole flight, then a child's view of the bounces."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    film.set("living_room", facing_deg=-55)
    film.light(azimuth_deg=-145, elevation_deg=28, colour="#ffdcaa", strength=1.1, softness_deg=2)
    film.grade(contrast=1.08, saturation=1.08, vignette=0.25)
    end = film.recorded.duration
    film.hold(still((0.26, -0.3, 0.1), (0, 0, 0.06), lens_mm=50, focus="head", aperture=11), 0.7)
    film.shot(still((0.26, -0.3, 0.1), (0, 0, 0.06), lens_mm=50, focus="head", aperture=11), until=0.05, speed=0.04)
    film.shot(still((0.5, -0.72, 0.17), (0, 0, 0.23), lens_mm=42, focus="head", aperture=8), until=0.9, speed=0.4)
    film.shot(still((0.4, -0.52, 0.1), (0, 0, 0.11), lens_mm=45, focus="head", aperture=8), until=end)
