from worldkit.matter import Matter, Snow, Source


class Snowfall(Matter):
    """Flakes strewn over a bench: what lies together is a solid that yields, hardens and rubs."""

    name, bodies, shown_by = "snow", ("bench", "world"), "snow"

    def __init__(self, snow_density, snow_mass, fall_speed, spacing=0.014):
        sky = Source(snow_mass, at=(0.0, 0.05, 1.5), starts=0.0, ends=3.8, sides=(1.16, 0.52), speed=fall_speed)
        super().__init__(Snow(snow_density, falls=fall_speed), spacing, poured=[sky])
