"""The page of a live world in headless Chromium: how many pictures a second it shows while it drives a car, all on this machine.

Chromium opens the page, holds a key, and counts the pictures that it has decoded. World, pictures, page and browser share the
processors, which is how a person at one machine drives.

    python tests/bench/live_page.py [--seconds 8] [--look quick]
"""

import argparse
import os
import sys
import tempfile
import time
from pathlib import Path

from figures import Figure, report
from live_drive import driven

sys.path.insert(0, str(Path(__file__).parents[2] / "servers"))
sys.path.insert(0, str(Path(__file__).parents[1]))

from headless_browser import PATIENCE_S, Browser, installed
from worldwright.ends.chase_pictures import LiveView, PictureThread
from worldwright.ends.live_page import LivePage
from worldwright.ends.live_world import LiveWorld
from worldwright.ends.seats import Seats

GOAL = 15.0
COUNT = "window.n = 0; document.getElementById('picture').addEventListener('load', () => window.n++)"


def main() -> int:
    """Measure, print, and answer the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=8.0)
    parser.add_argument("--look", default="quick")
    options = parser.parse_args()
    name = "pictures a second in headless Chromium"
    if not (program := installed()):
        return report(Figure(name, None, GOAL, "there is no Chromium here", at_least=True))
    with tempfile.TemporaryDirectory() as place, tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as home:
        source = driven(Path(place))
        world = LiveWorld(source, 1.0, 600.0)
        seats = Seats([row.name for row in world.commands], world.command, world.left, lambda: 0.0, world.witness.note)
        view = PictureThread(lambda: LiveView(source, look=options.look), lambda: world.newest)
        view.ready.wait(PATIENCE_S)
        page = LivePage(world, seats, view)
        browser = Browser(program, page.address + "?name=Ada", home)
        try:
            while world.facts.get("time_s", 0.0) < 0.5:
                time.sleep(0.05)
            browser.press("ArrowUp")
            browser.value(COUNT)
            began, at = time.monotonic(), world.facts["time_s"]
            time.sleep(options.seconds)
            shown, passed = browser.value("window.n"), time.monotonic() - began
            driven_s = world.facts["time_s"] - at
            moved = world.facts["commands"]["car.throttle"]
        finally:
            browser.close()
            world.close()
            page.close()
            view.close()
    if not moved > 0:
        print("the key did not reach the world")
        return 1
    if view.problem:
        return report(Figure(name, None, GOAL, view.problem, at_least=True))
    print(
        f"the key gave a throttle of {moved:.2f}; the world kept {driven_s / passed:.3f} of real time; load {os.getloadavg()[0]:.1f}"
    )
    return report(
        Figure(name, shown / passed, GOAL, "1/s", at_least=True),
        Figure("its pace meanwhile, of real time", driven_s / passed, 0.98, at_least=True),
    )


if __name__ == "__main__":
    sys.exit(main())
