"""What frames take to be drawn, and what the next one is expected to take."""

CALMER = 0.8
"""After a dear frame the next ones are expected to take this share of it, and this share of that, …"""


class Pace:
    """What frames take for each sample a pixel, s: the `dearest` of a level, and the `recent` ones, by which the next is judged."""

    def __init__(self, level: float = 0.0, dearest: float = 0.0, recent: float = 0.0) -> None:
        self.level, self.dearest, self.recent = level, dearest, recent

    def expected(self, samples: float, first: bool, stills: float) -> float:
        """Seconds of a frame; if it is the `first` of its shot at this level, as many as the dearest, or as it and its `stills`."""
        return samples * (max(self.dearest, (1 + stills) * self.recent) if first else self.recent)

    def doubt(self, samples: float, took: float, stills: float) -> None:
        """Learn from a frame with which the renderer got ready: others take no longer, whatever an earlier process found."""
        each = took / samples
        self.dearest, self.recent = min(self.dearest, each), min(self.recent, each / (1 + stills))

    def add(self, samples: float, took: float, stills: float) -> None:
        """Learn what a frame and its `stills`, which were drawn with it and take as long as so many more, took, s."""
        each = took / samples
        self.dearest = max(each, self.dearest) if samples == self.level else each
        self.level, self.recent = samples, max(each / (1 + stills), CALMER * self.recent)
