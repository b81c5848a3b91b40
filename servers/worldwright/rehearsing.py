"""`worldwright stage rehearse RUN`: how a world would do, before anybody has approved its plan.

It is a tool of `stage`, since it runs a world, and stands here, since the walk that it takes is `stamp`'s.
"""

from typing import Annotated

from pydantic import Field

from .model import call_time
from .model.evidence.run import Run
from .model.progress import Progress, silent
from .stamp.rehearsed_answer import Rehearsed


def rehearse(
    run: Annotated[str, Field(description="The run folder, or its name.")],
    timeout_s: Annotated[float, Field(description="Return after so long; call again.", gt=0)] = 40,
    go_on: Annotated[bool, Field(description="Simulate also what check or lint found wrong in plan or model.")] = False,
    progress: Progress = silent,
) -> Rehearsed:
    """Before approval: check, place, draft, lint, simulate, scan, measure, storyboard, and nothing of it is evidence.

    Answers in one call which objectives would hold and by which margin, all there is to mend, the pictures' paths and the
    cost. What is wrong in plan or model is mended before it is simulated. It works on a copy, `rehearsal/`: change plan.md and
    call again. `running`: call again.
    """
    from .stamp.rehearsal import rehearse as walk

    return walk(Run.find(run), call_time.waiting_s(timeout_s), progress, go_on)


TOOLS = (rehearse,)
