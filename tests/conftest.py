"""Before anything imports the simulator: which OpenGL it draws with is decided at its import."""

import os

os.environ.setdefault("MUJOCO_GL", "egl")

from hypothesis import HealthCheck, settings

# How fast a machine draws examples is no property of what is tested. CI judges a commit by the same examples each time;
# people's runs keep looking for new ones.
settings.register_profile(
    "worldwright",
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
    derandomize="WORLDWRIGHT_SAME_EXAMPLES" in os.environ,
)
settings.load_profile("worldwright")
