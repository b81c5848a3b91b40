"""Surveyed roads (OpenCRG) as ground to drive on: read from a file, laid out as height fields, and a line to follow on them.

from worldkit import roads, vehicles

ROAD = roads.read("roads/course.crg")  # beside the program
roads.add(spec, ROAD, name="road", pos=(0, 0, 0))
course = vehicles.Course(ROAD.lane(left_m=-1.5), closed=ROAD.closed)
"""

from .crg_file import RoadFileError
from .road_surface import Road, read
from .road_tiles import add, box

__all__ = ["Road", "RoadFileError", "add", "box", "read"]
