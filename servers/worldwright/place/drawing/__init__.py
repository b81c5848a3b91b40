"""A labelled picture of a layout: from above and from the side, on one scale, with what is wrong marked."""

from .sheet import sheet

__all__ = ["sheet"]
