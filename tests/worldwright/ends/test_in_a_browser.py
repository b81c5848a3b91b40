"""A person's page: it is opened in a browser, a key drives the world, and pictures are shown."""

import contextlib
import shutil
import time

import pytest

from headless_browser import Browser, installed
from worldwright.ends.chase_pictures import LiveView, PictureThread
from worldwright.ends.live_page import LivePage
from worldwright.ends.live_source import LiveSource
from worldwright.ends.live_world import LiveWorld
from worldwright.ends.seats import Seats

pytestmark = [pytest.mark.gl, pytest.mark.skipif(not installed(), reason="there is no Chromium here")]


def until(true):
    end = time.monotonic() + 60
    while not (found := true()):
        assert time.monotonic() < end, "it never came true"
        time.sleep(0.02)
    return found


def test_a_key_on_the_page_drives_the_world_and_its_pictures_are_shown(roped, tmp_path):
    shutil.copytree(roped.run, tmp_path / "rope", ignore=shutil.ignore_patterns("drives"))
    source = LiveSource.find(tmp_path / "rope")
    world = LiveWorld(source)
    with contextlib.ExitStack() as left:
        left.callback(world.close)
        seats = Seats(["pull"], world.command, world.left, lambda: world.facts.get("time_s", 0.0), world.witness.note)
        view = PictureThread(lambda: LiveView(source), lambda: world.newest)
        left.callback(view.close)
        view.ready.wait(60)
        page = LivePage(world, seats, view)
        left.callback(page.close)
        left.callback(world.close)  # the page tells its end
        browser = Browser(installed(), page.address + "?name=Ada", str(tmp_path / "home"))
        left.callback(browser.close)
        until(lambda: not world.facts["waits"])
        assert "you drive" in browser.value("document.getElementById('who').textContent")
        browser.press("ArrowUp")
        until(lambda: world.facts["commands"]["pull"] > 0.1)
        width = "document.getElementById('picture').naturalWidth"
        until(lambda: browser.value(width) == 400)
        until(lambda: "pull" in browser.value("document.getElementById('commands').textContent"))
    assert view.problem == ""
