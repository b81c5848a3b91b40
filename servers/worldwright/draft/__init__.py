"""From a resolved plan to `simulation.py`, deterministically.

A plan of rigid bodies (primitives, compounds, catalog meshes, URDF and MJCF models), joints, loops, ropes, motors and
initial motion is drafted whole and needs no author. Whatever a plan asks for that cannot be drafted is left as a marked
place (`# AUTHOR:`) saying what belongs there and where the plan says so.
"""

from .program import Draft, draft

__all__ = ["Draft", "draft"]
