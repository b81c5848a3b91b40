"""`worldwright live RUN`: a world at the pace of the wall clock, driven from a browser or over ROS 2."""

import math
import signal
import sys
import threading
import time
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from .ends.ros_live import RosAsked

TICK_S, SHOW_S = 0.2, 5.0


@click.command("live")
@click.argument("run")
@click.option("--speed", type=click.FloatRange(0.01, 100), default=1.0, show_default=True, help="Times real time.")
@click.option(
    "--seconds",
    type=click.FloatRange(min=0.1, max=100_000),
    default=3600.0,
    show_default=True,
    help="Simulated, at most.",
)
@click.option("--at-once", is_flag=True, help="Begin before anybody drives.")
@click.option("--follow", default="", metavar="BODY", help="What the following camera follows; a car, else what moves.")
@click.option("--pictures/--no-pictures", default=True, help="Draw what the page shows.")
@click.option(
    "--look",
    type=click.Choice(["quick", "film"]),
    default="quick",
    show_default=True,
    help="Of the pictures: in plain light, or as the house draws films, at six times the price.",
)
@click.option("--size", default="400x224", show_default=True, help="Of the pictures, pixels.")
@click.option("--port", type=click.IntRange(0, 65535), default=0, help="Of the page; a free one without it.")
@click.option(
    "--host", default="127.0.0.1", show_default=True, help="Interface of the page; another than loopback needs a token."
)
@click.option(
    "--token",
    default="",
    envvar="WORLDWRIGHT_LIVE_TOKEN",
    help="What a peer must know; made up where it is needed and not given. A command line is seen by all users of the machine (`ps`): "
    "the environment variable WORLDWRIGHT_LIVE_TOKEN is read too. It goes over the network as it is (http).",
)
@click.option(
    "--prove/--no-prove",
    default=True,
    help="At the end, drive it again by its stream, and sign what that proves; nobody can sign it later.",
)
@click.option("--ros", is_flag=True, help="On a ROS 2 network, too (extra `ros`): /clock, /odom, /cmd_vel, ….")
@click.option("--ros-domain", type=click.IntRange(0, 232), help="ROS_DOMAIN_ID, else 0, without it.")
@click.option("--ros-node", default="", metavar="NAME", help="Of the node; worldwright without it.")
@click.option(
    "--ros-interface",
    default="",
    metavar="ADDRESS",
    help="Another than loopback: whoever reaches it may drive, without a token.",
)
@click.option("--ros-images", type=click.Choice(["compressed", "raw"]), help="Publish the page's pictures.")
@click.option("--ros-lidar", is_flag=True, help="Publish a ring of 360 distances about what is followed.")
def command(
    run: str,
    speed: float,
    seconds: float,
    at_once: bool,
    follow: str,
    pictures: bool,
    look: str,
    size: str,
    port: int,
    host: str,
    token: str,
    prove: bool,
    ros: bool,
    **more: Any,
) -> None:
    """Drive a world live, from the page that this prints the address of, until it is interrupted.

    Exit status 3: proved, but signed by no key that is known here.

    It is the accepted world, else the one that was recorded last. What drives it is stored at the step where it took effect, and
    kept in RUN/drives, also if the process is killed: scan it, film it, prove it again.
    """
    from .cli import report_errors

    sys.exit(
        report_errors(
            lambda: drive(
                run, speed, seconds, at_once, follow, pictures, look, size, port, host, token, prove, _asked(ros, more)
            )
        )
    )


def _asked(ros: bool, more: dict[str, Any]) -> "RosAsked | None":
    """What is asked of the end that speaks ROS 2; None without it."""
    from .model.errors import NotFoundError

    given = {
        name.removeprefix("ros_"): value
        for name, value in more.items()
        if value is not False and value not in (None, "")
    }
    if not ros:
        if given:
            names = ", ".join(f"--ros-{name}" for name in given)
            raise NotFoundError(f"{names} does nothing without --ros", next_move="add --ros, or leave it out")
        return None
    from .ends.ros_live import RosAsked, own_domain

    return RosAsked(**{"domain": own_domain(), **given} if "domain" not in given else given)


def drive(
    run: str,
    speed: float,
    seconds: float,
    at_once: bool,
    follow: str,
    pictures: bool,
    look: str,
    size: str,
    port: int,
    host: str,
    token: str,
    prove: bool,
    ros: "RosAsked | None" = None,
) -> int:
    """Serve one drive to its end; returns the exit status."""
    import secrets

    from .ends.chase_pictures import LiveView, PictureThread, followed
    from .ends.driven import finish
    from .ends.live_page import LivePage, loopback
    from .ends.live_source import LiveSource
    from .ends.live_world import LiveWorld
    from .ends.seats import Seats
    from .model.errors import NotFoundError
    from .model.printable import line

    if not (math.isfinite(speed) and math.isfinite(seconds)):
        raise NotFoundError("--speed and --seconds are finite numbers", next_move="give e.g. --speed 0.5")

    try:
        width, height = (int(side) for side in size.split("x"))
        if not (16 <= width <= 4096 and 16 <= height <= 4096):
            raise ValueError
    except ValueError:
        raise NotFoundError(
            f"{size!r} is no size of a picture", next_move="write it as WIDTHxHEIGHT, e.g. 400x224"
        ) from None
    if ros is not None and ros.images != "none" and not pictures:
        raise NotFoundError("there are no pictures to publish", next_move="leave out --no-pictures, or --ros-images")
    source = LiveSource.find(run)
    body = followed(source.model, source, follow)
    world = LiveWorld(source, speed, seconds, waits=not at_once)
    view, page, network = None, None, None

    def note(what: str, more: dict[str, Any]) -> None:
        try:
            world.witness.note(what, more)
        finally:  # a peer chose some of these words
            click.echo(line(f"{what}: " + ", ".join(f"{value}" for value in more.values())), err=True)

    names = [row.name for row in world.commands]
    seats = Seats(names, world.command, world.left, lambda: float(world.facts.get("time_s", 0.0)), note)
    ended = threading.Event()
    before = {number: signal.signal(number, lambda *_: ended.set()) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        try:
            if pictures:
                view = PictureThread(lambda: LiveView(source, (width, height), follow, look), lambda: world.newest)
                view.ready.wait(60)
            known = token or ("" if loopback(host) else secrets.token_urlsafe(16))
            if ros is not None:
                from .ends.ros_live import RosEnd

                network = RosEnd(world, seats, ros, body, view)
            page = LivePage(world, seats, view, host, port, known)
            click.echo(f"{page.address}  drives {', '.join(names)}; end it with Ctrl-C")
            if network is not None:
                click.echo(f"ROS 2: {network.address}")
            _watch(world, ended, network)
        finally:
            if network is not None:
                network.close()
            world.close()
            for part in (page, view):
                if part is not None:
                    part.close()
        said = f"ended: {world.facts.get('ended', 'before its first step')}"
        if not world.folder.is_dir():
            click.echo(f"{said}; nothing was driven, and nothing is kept")
            return 0
        click.echo(f"{said}; kept in {world.folder}")
        if not prove:
            return 0
        click.echo("proving; it is signed only if this ends", err=True)
        found = finish(world.folder, world.witness)
        click.echo(found.text())
        return found.exit_code
    finally:  # only now: a second Ctrl-C would lose the signature for good
        for number, handler in before.items():
            signal.signal(number, handler)


def _watch(world: Any, ended: threading.Event, network: Any = None) -> None:
    """Wait for the end, and show what is late on the way."""
    shown, due, problem = 0, time.monotonic() + SHOW_S, ""
    while not (ended.wait(TICK_S) or world.over):
        facts = world.facts
        if network is not None and network.problem != problem:
            problem = network.problem
            click.echo(problem, err=True)
        if time.monotonic() < due or facts.get("overruns", 0) == shown:
            continue
        shown, due = facts["overruns"], time.monotonic() + SHOW_S
        click.echo(
            f"{facts['time_s']:.1f} s at {facts['factor']:.2f} times real time: {shown} overruns, worst "
            f"{1000 * facts['worst_s']:.0f} ms, {facts['lost_s']:.1f} s lost",
            err=True,
        )
