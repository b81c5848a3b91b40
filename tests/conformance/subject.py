"""A server with the tools that the conformance suite calls, exposed by the very code that exposes ours.

The suite looks for tools of fixed names. A server that has none of them passes or fails without having been tried, so
what our servers can do (text, pictures, errors, progress) is tried here. Started as `python subject.py PORT`.
"""

import sys
from typing import Any

from worldwright import expose
from worldwright.model.errors import NotFoundError
from worldwright.model.frozen import Frozen
from worldwright.model.picture import Illustrated, Picture
from worldwright.model.progress import Progress, silent

PIXEL = bytes.fromhex(
    "89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c4890000000d49444154789c6360f8cf50"
    "0f0003860180efd0e9540000000049454e44ae426082"
)


class Words(Frozen):
    """A short answer."""

    words: str


def test_simple_text() -> Words:
    """Say something."""
    return Words(words="This is a simple text response for testing.")


def test_image_content() -> Illustrated:
    """Show something."""
    return Illustrated(Words(words="look"), (Picture(PIXEL, "one pixel"),))


def test_error_handling() -> Words:
    """Refuse."""
    raise NotFoundError("This tool intentionally returns an error for testing", next_move="none")


def test_tool_with_progress(progress: Progress = silent) -> Words:  # noqa: PT028 - a tool, called so by the suite
    """Tell how far it is."""
    for done in (0, 50, 100):
        progress(done, 100, f"{done} of 100")
    return Words(words="done")


TOOLS: tuple[Any, ...] = (test_simple_text, test_image_content, test_error_handling, test_tool_with_progress)

if __name__ == "__main__":
    expose.tools = lambda _: TOOLS
    expose.serve("lint", "http", port=int(sys.argv[1]))
