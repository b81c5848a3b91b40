"""Turn a resolved plan into `simulation.py`, deterministically.

A plan of rigid bodies (primitives, compounds, catalog meshes, URDF and MJCF models), joints, loops, ropes, motors and
initial motion is drafted completely and needs no author. What cannot be drafted is left as a marked place (`# AUTHOR:`)
that says what belongs there and where the plan asks for it.
"""

from .assembly import Draft, draft

__all__ = ["Draft", "draft"]
