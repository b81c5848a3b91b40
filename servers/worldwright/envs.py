"""Accepted worlds as Gymnasium environments: importing this module registers `worldwright/RUN-v0` (extra `gym`).

>>> import gymnasium, worldwright.envs  # doctest: +SKIP
>>> env = gymnasium.make("worldwright/RUN-v0", run="runs/mine", render_mode="rgb_array")  # doctest: +SKIP
>>> many = gymnasium.make_vec("worldwright/RUN-v0", num_envs=64, run="runs/mine", reward=False)  # doctest: +SKIP

`make_vec` steps its copies in MuJoCo's batch only where nothing is judged: `reward=False` (`worldwright.ends.gymnasium_batch`).
What an action, an observation and a reward are: `worldwright.ends.gymnasium_world.World`.
"""

import gymnasium

ID = "worldwright/RUN-v0"

if ID not in gymnasium.registry:
    gymnasium.register(
        ID,
        entry_point="worldwright.ends.gymnasium_world:World",
        vector_entry_point="worldwright.ends.gymnasium_batch:worlds",
    )
