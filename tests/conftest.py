"""Before anything imports the simulator: which OpenGL it draws with is decided at its import."""

import os

os.environ.setdefault("MUJOCO_GL", "egl")

from hypothesis import HealthCheck, settings

# How fast a machine draws examples is no property of what is tested.
settings.register_profile("worldwright", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("worldwright")
