"""Before anything imports the simulator: which OpenGL it draws with is decided at its import."""

import os

os.environ.setdefault("MUJOCO_GL", "egl")
