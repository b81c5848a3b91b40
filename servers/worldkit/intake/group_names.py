"""What the names of a file's groups say of parts that move.

Sweet Home 3D names them so: `sweethome3d_hinge_1` is the pin that `sweethome3d_opening_on_hinge_1` turns about, `sweethome3d_rail_1`
or `sweethome3d_unique_rail` what `sweethome3d_opening_on_rail_1` slides along, and panes and mirrors move with their opening.
"""

import re

MARK = b"sweethome3d_opening_on_"
"""A file with such groups has parts that move, and is read by its groups."""
MOVES = re.compile(r"sweethome3d_(?:opening|window_pane|window_mirror|light)_on_(hinge|rail)_(\d+)")
GUIDES = re.compile(r"sweethome3d_(?:(hinge|rail)_(\d+)|unique_(rail))")


def part_of(name: str) -> str:
    """Which part a group is of: `hinge 1` moves on it, `at hinge 1` is its pin, empty is the rest.

    >>> part_of("sweethome3d_opening_on_hinge_1_door_white"), part_of("sweethome3d_unique_rail_cage"), part_of("frame")
    ('hinge 1', 'at rail', '')
    """
    if found := MOVES.search(name):
        return f"{found[1]} {found[2]}"
    if found := GUIDES.search(name):
        return "at rail" if found[3] else f"at {found[1]} {found[2]}"
    return ""
