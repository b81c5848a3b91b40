"""What many walls cost matter: snow on a seat of 21 planks, and of 2,025 tiles, as a multiple of the same snow on one board.

Processor time, so that a machine that does something else says the same; the first question, which compiles and sorts, is left out.
"""

import sys
import time

import mujoco
from figures import Figure, report

from worldkit.matter import Matter, Snow, block

GOAL = 1.3
LONG, WIDE = 0.6, 0.6
QUESTIONS, ASK_S, TRIES = 6, 0.005, 3


class Fallen(Matter):
    """Snow that lies on the board."""

    name, bodies, shown_by = "fallen", ("world",), "fallen"


def board(along: int, across: int) -> mujoco.MjModel:
    """A seat of so many boxes, flush with one another."""
    x, y = LONG / along, WIDE / across
    boxes = "".join(
        f'<geom type="box" size="{x / 2} {y / 2} 0.01" pos="{x * (i + 0.5)} {y * (j + 0.5)} -0.01"/>'
        for i in range(along)
        for j in range(across)
    )
    return mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{boxes}</worldbody></mujoco>")


def cost(along: int, across: int) -> float:
    """us of processor time a point and question: the least of some tries."""
    model = board(along, across)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    law = Fallen(Snow(120.0, falls=1.2), 0.015, begins=[block((0.02, 0.02, 0.003), (LONG - 0.02, WIDE - 0.02, 0.06))])
    law.start(model, data)
    law.step(model, data, ASK_S)
    taken = []
    for _ in range(TRIES):
        began = time.process_time()
        for _ in range(QUESTIONS):
            law.step(model, data, ASK_S)
        taken.append(time.process_time() - began)
    return min(taken) / QUESTIONS / len(law.points) * 1e6


def main() -> int:
    """Measure and print."""
    one = cost(1, 1)
    print(f"one board: {one:.1f} us a point and question")
    figures = [
        Figure(f"snow on {count} boxes / on one", cost(along, across) / one, GOAL)
        for count, along, across in (("21", 1, 21), ("2,025", 45, 45))
    ]
    return report(*figures)


if __name__ == "__main__":
    sys.exit(main())
