"""A stand-in for a judge's server, films of a few frames, and a scenario that they are judged by."""

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest

from judge_stands import CRITERIA, StandIn
from worldengine.film.encode import Video
from worldwright.judge.criteria import Scenario


@pytest.fixture
def stand_in() -> Iterator[StandIn]:
    made = StandIn()
    yield made
    made.server.shutdown()
    made.server.server_close()


@pytest.fixture
def film(tmp_path: Path) -> Callable[..., Path]:
    """Writes a film whose frame N is grey of a brightness that tells N; one that is there already is left as it is.

    A film is known by its bits, and an encoder under load need not find the same ones twice.
    """
    written: dict[Path, tuple[int, tuple[int, int]]] = {}

    def write(name: str = "039", frames: int = 12, size: tuple[int, int] = (64, 48)) -> Path:
        path = tmp_path / "films" / f"{name}.mp4"
        path.parent.mkdir(exist_ok=True)
        if written.get(path) == (frames, size):
            return path
        written[path] = frames, size
        with Video(path, *size, 12) as video:
            for number in range(frames):
                video.add(np.full((size[1], size[0], 3), 20 + 200 * number // max(1, frames - 1), np.uint8))
        return path

    return write


@pytest.fixture
def scenario() -> Scenario:
    return Scenario(id="039", category="Interaction Dynamics", criteria=CRITERIA)
