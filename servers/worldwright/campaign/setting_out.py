"""How a campaign begins: its file is checked against its plans before a folder is made, and its limits may be changed later."""

import time
from itertools import islice
from pathlib import Path
from typing import Any

from ..model.errors import WorldwrightError
from ..model.evidence import came
from . import points
from .campaign_file import Campaign, CampaignError, read
from .campaign_store import Store
from .plan_fields import path_of

SHOWN = 5
CANCEL_S = 20.0


def checked(file: Path) -> Campaign:
    """The campaign of a file; of a sweep, every field is a number of its plan.

    Raises:
        CampaignError: see `campaign_file.read`; a swept plan that is none is refused here, since no world could be made of it, and
            so are a field that is named twice and a range whose steps are equal once they are written.
    """
    campaign = read(file)
    if campaign.sweep is None:
        return campaign
    from ..model.plan.plan_text import read_plan

    try:
        document = read_plan(file.parent / str(campaign.plan))
    except WorldwrightError as error:
        raise CampaignError(
            f"its plan cannot be swept: {error.cause}", place=error.place, next_move=error.next_move
        ) from error
    named: dict[tuple[str | int, ...], str] = {}
    for name, axis in campaign.sweep.fields.items():
        path = path_of(document, name)
        if path in named:
            raise CampaignError(
                f"`{named[path]}` and `{name}` are one number of the plan: it can be swept once",
                place=str(file),
                next_move="leave one of them",
            )
        named[path] = name
        if places := points.equal_neighbours(axis):
            raise CampaignError(
                f"`{name}`: {axis.steps:,} steps from {axis.start:.17g} to {axis.to:.17g} lie so close that values {places[0]} and "
                f"{places[1]} are both {points.along(axis, places[0]):.17g}, of {points.LAID_DIGITS} digits",
                place=str(file),
                next_move="take fewer steps, or ends further apart",
            )
    return campaign


def limited(campaign: Campaign, workers: int | None, by: str | None, address: str | None) -> Campaign:
    """The campaign with what the command line says in place of its file."""
    told: dict[str, Any] = {"workers": workers, "hands": by, "address": address}
    changes = {name: value for name, value in told.items() if value is not None}
    return campaign.model_copy(update=changes) if changes else campaign


def begun(campaign: Campaign, file: Path, folder: Path | None, approved: bool) -> Store:
    """The folder of a campaign, begun or gone on with; `approved`: whoever calls gives a person's word for all its plans."""
    from ..contract import harnesses

    store = Store(folder or Path("runs") / str(campaign.name))
    store.begin(campaign, file, came.by_command(harnesses.around()) if approved else None)
    return store


def changed(store: Store, workers: int | None, by: str | None, address: str | None) -> Store:
    """The same campaign with other hands."""
    about = store.begun
    store.change(about, about.model_copy(update={"campaign": limited(about.campaign, workers, by, address)}))
    return store


def shown(campaign: Campaign) -> list[str]:
    """How many worlds a campaign would be, and the first of them, one a line."""
    lines = [f"{campaign.name}: {campaign.size:,} worlds, each up to `{campaign.until}`"]
    if campaign.sweep is None:
        return lines + [f"  {given.plan or str(given.prompt)[:100]}" for given in islice(campaign.given, SHOWN)]
    for number in range(min(SHOWN, campaign.size)):
        values = points.at(campaign.sweep, number)
        lines.append("  " + ", ".join(f"{name} {value:g}" for name, value in values.items()))
    return lines


def cancelled(store: Store) -> str:
    """Ask the driver to stop, and wait for it a while; what came of that."""
    if not store.driven:
        if left := _ended(store):
            return f"it is not at work; {left} of its authors that still were are ended, `resume` goes on"
        return "it is not at work"
    store.cancelled.touch()
    ends = time.monotonic() + CANCEL_S
    while store.driven and time.monotonic() < ends:
        time.sleep(0.1)
    if store.driven:
        return "it is still ending what is under way"
    _ended(store)
    return "cancelled; what is done stays, `resume` goes on"


def _ended(store: Store) -> int:
    """End the authors that nobody watches any more, since their worker was killed; how many."""
    from . import world_author

    return sum(world_author.stop(store, world) for world in world_author.worlds(store))
