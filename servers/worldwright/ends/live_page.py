"""The page from which a live world is driven, and the stream behind it: one small server, on the loopback interface.

    GET /         the page: keys, gamepad, sliders, picture, readings
    GET /stream   a WebSocket: text messages are JSON with a `kind`, binary ones are JPEG pictures

The world tells `world` (commands with bounds and units, cameras, who you are) at first, then `state` twenty times a second,
`seats` when they change, `refused` with cause and next move, `ended`. What it understands: `seats`; and `camera` (of who drives, or of
anybody where nobody does), `pictures` (on or off). A page of another origin is refused, and so is a name that a foreign page's server could give this machine. Where the
server listens beyond the loopback interface, everything needs its token.
"""

import asyncio
import contextlib
import http
import ipaddress
import json
import re
import secrets
import threading
import time
import urllib.parse
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..model.errors import NotFoundError
from .seats import MOST_SEATS, Refusal, Seat, Seats

if TYPE_CHECKING:
    from websockets.asyncio.server import Server, ServerConnection
    from websockets.http11 import Request, Response

    from .chase_pictures import PictureThread
    from .live_world import LiveWorld

PAGE = Path(__file__).with_name("live_page.html")
STATES_HZ = 20.0
MOST_MESSAGE = 4096
MOST_WAITING = 1 << 18
"""Bytes that a peer has not taken yet, above which it gets no further picture."""
MOST_BEHIND_S = 5.0
"""A peer that has taken nothing for so long is cut off: its pings wait behind what it does not read, and would never tell."""
FAREWELL_S = 3.0
FLOOD, FULL, POLICY = 1008, 1013, 1008
LOCAL = ("127.0.0.1", "localhost", "[::1]")


class LivePage:
    """Serves one live world, on a thread of its own, from its making until `close`.

    Args:
        world: the world.
        seats: who drives it and who watches.
        pictures: draws it; None where nothing is drawn.
        host, port: of the interface; port 0 takes a free one.
        token: what a peer must know; empty on the loopback interface only.

    Attributes:
        address: of the page, with the token.

    Raises:
        NotFoundError: the address cannot be listened on, or it is no loopback address and there is no token.
    """

    def __init__(
        self,
        world: "LiveWorld",
        seats: Seats,
        pictures: "PictureThread | None",
        host: str = "127.0.0.1",
        port: int = 0,
        token: str = "",
    ) -> None:
        if not (token or loopback(host)):
            raise NotFoundError(f"{host} is not the loopback interface", next_move="give a token with --token")
        self.world, self.seats, self.pictures, self.token = world, seats, pictures, token
        self._host, self._port = host, port
        self._guests: dict[Seat, _Guest] = {}
        self._tasks: set[asyncio.Task[None]] = set()
        self._loop = asyncio.new_event_loop()
        self._began: threading.Event = threading.Event()
        self._failed: Exception | None = None
        self._thread = threading.Thread(target=self._run, name="page", daemon=True)
        self._thread.start()
        self._began.wait()
        if self._failed is not None:
            raise NotFoundError(
                f"{host}:{port} cannot be listened on: {getattr(self._failed, 'strerror', None) or self._failed}",
                next_move="give another --port, or 0 for a free one, and an address of this machine as --host",
            )
        shown = f"[{host}]" if ":" in host else host
        self.address = f"http://{shown}:{self._port}/" + (f"?token={urllib.parse.quote(token)}" if token else "")

    def _run(self) -> None:
        asyncio.set_event_loop(self._loop)
        try:
            self._loop.run_until_complete(self._serve())
        except asyncio.CancelledError:
            pass
        except Exception as cause:  # whoever waits for the beginning is told, whatever it is
            self._failed = cause
        finally:
            self._began.set()
            self._loop.close()

    async def _serve(self) -> None:
        from websockets.asyncio.server import serve

        self._over, self._newer = asyncio.Event(), asyncio.Event()
        server: Server = await serve(
            self._meet, self._host, self._port, process_request=self._answer, max_size=MOST_MESSAGE,
            max_queue=16, ping_interval=5, ping_timeout=10, compression=None, server_header=None, open_timeout=10, close_timeout=2,
        )  # fmt: skip
        self._port = next(iter(server.sockets)).getsockname()[1]
        if self.pictures is not None:
            self.pictures.made.append(lambda: self._soon(self._newer.set))
        self.world.told.append(lambda: self._soon(self._over.set) if self.world.over else None)
        self._began.set()
        states = asyncio.create_task(self._tell_states())
        pictures = asyncio.create_task(self._send_pictures())
        await self._over.wait()
        states.cancel()
        pictures.cancel()
        await self._all(self._state())
        await asyncio.wait({*self._tasks, asyncio.create_task(asyncio.sleep(0))}, timeout=1.0)
        server.close()
        for _ in range(2):
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(server.wait_closed(), FAREWELL_S)
                break
            for guest in self._guests.values():
                guest.abort()

    def _soon(self, what: Callable[[], object]) -> None:
        with contextlib.suppress(RuntimeError):  # the loop is closed
            self._loop.call_soon_threadsafe(what)

    # -- who may come in ---------------------------------------------------------------------------------------------

    def _answer(self, connection: "ServerConnection", request: "Request") -> "Response | None":
        """The page, or why it is not given; None lets a WebSocket through."""
        path, _, query = request.path.partition("?")
        asked = urllib.parse.parse_qs(query)
        host, origin = request.headers.get("Host", ""), request.headers.get("Origin")
        if not self.token and re.sub(r":\d+$", "", host) not in (*LOCAL, self._host):
            return connection.respond(http.HTTPStatus.FORBIDDEN, f"this machine is not called {host[:80]!r} here\n")
        if origin is not None and origin != f"http://{host}":
            return connection.respond(http.HTTPStatus.FORBIDDEN, "a page of another origin may not come in here\n")
        if self.token and not secrets.compare_digest(asked.get("token", [""])[0].encode(), self.token.encode()):
            return connection.respond(
                http.HTTPStatus.FORBIDDEN, "this needs the token that `worldwright live` printed\n"
            )
        if path == "/stream":
            return None
        if path != "/":
            return connection.respond(http.HTTPStatus.NOT_FOUND, "there are / and /stream\n")
        response = connection.respond(http.HTTPStatus.OK, PAGE.read_text(encoding="utf-8"))
        del response.headers["Content-Type"]
        response.headers["Content-Type"] = "text/html; charset=utf-8"
        response.headers["Content-Security-Policy"] = (
            "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src blob:; connect-src 'self'; "
            "frame-ancestors 'none'"
        )
        response.headers["Cache-Control"] = "no-store"
        response.headers["Referrer-Policy"] = "no-referrer"
        return response

    # -- one peer ----------------------------------------------------------------------------------------------------

    async def _meet(self, connection: "ServerConnection") -> None:
        """Serve one peer until it goes."""
        from websockets.exceptions import ConnectionClosed

        asked = urllib.parse.parse_qs((connection.request.path if connection.request else "").partition("?")[2])
        where = str(connection.remote_address[0]) if connection.remote_address else "?"
        seat = self.seats.sit(asked.get("name", [""])[0], f"browser page, {where}", "watch" in asked)
        if isinstance(seat, Refusal):
            await connection.close(FULL, seat.cause)
            return
        guest = self._guests[seat] = _Guest(connection)
        try:
            await connection.send(json.dumps(self._world()))
            await self._all(self._who())
            self._look()
            async for text in connection:
                if refusal := self._take(seat, guest, text):
                    await connection.send(json.dumps(refusal.told()))
                    if refusal.leave:
                        await connection.close(FLOOD, refusal.cause)
                        break
        except ConnectionClosed:
            pass
        finally:
            del self._guests[seat]
            seat.leave()
            self._look()
            await self._all(self._who())

    def _take(self, seat: Seat, guest: "_Guest", text: str | bytes) -> Refusal | None:
        """A message of one peer: what concerns pictures is the page's, the rest the seat's; all of them count."""
        drove = seat.drives

        def pictures(said: dict[str, Any]) -> None:
            guest.looks = said.get("on") is True
            self._look()

        others = {"pictures": pictures, "camera": lambda said: self._camera(seat, str(said.get("name")))}
        refusal = seat.say(text, others)
        if drove != seat.drives:
            self._later(self._all(self._who()))
        return refusal

    def _camera(self, seat: Seat, name: str) -> Refusal | None:
        """Draw through another camera, for all who look."""
        pictures, driver = self.pictures, self.seats.driver
        if pictures is None:
            return Refusal("there are no pictures", "begin the drive without --no-pictures")
        if driver is not None and driver is not seat:
            return Refusal(f"{driver.name} drives, and chooses the camera", "choose one when nobody drives")
        if name not in pictures.cameras:
            return Refusal(f"there is no camera {name[:40]}", f"name one of: {', '.join(pictures.cameras)}")
        pictures.camera = name
        return None

    def _later(self, work: Any) -> None:
        task = self._loop.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def _look(self) -> None:
        if self.pictures is not None:
            self.pictures.wanted = any(guest.looks for guest in self._guests.values())

    # -- what is told ------------------------------------------------------------------------------------------------

    def _world(self) -> dict[str, Any]:
        pictures = self.pictures
        return {
            "kind": "world", "run": self.world.source.run.name, "speed": self.world.speed, "seats": MOST_SEATS,
            "commands": [row.written() for row in self.world.commands],
            "cameras": list(pictures.cameras) if pictures else [], "no_pictures": pictures.problem if pictures else "off",
        }  # fmt: skip

    def _who(self) -> dict[str, Any]:
        return {"kind": "seats", "here": len(self._guests)}

    def _state(self) -> dict[str, Any]:
        facts, pictures = self.world.facts, self.pictures
        drawn = {"camera": pictures.camera, "no_pictures": pictures.problem} if pictures else {}
        return {"kind": "ended" if "ended" in facts else "state", **facts, **drawn}

    async def _tell_states(self) -> None:
        while True:
            await self._all(self._state())
            await asyncio.sleep(1 / STATES_HZ)

    async def _send_pictures(self) -> None:
        while True:
            await self._newer.wait()
            self._newer.clear()
            assert self.pictures is not None
            picture = self.pictures.jpeg[1]
            for guest in self._guests.values():
                if guest.looks and not guest.behind:
                    self._later(guest.send(picture))

    async def _all(self, told: dict[str, Any]) -> None:
        """Tell everybody; who has not taken what was sent before is left out, holds up nobody, and is cut off in the end."""
        driver = self.seats.driver
        for seat, guest in list(self._guests.items()):
            if guest.stuck(time.monotonic()):
                guest.abort()
            elif not guest.behind:
                you = {"you": "driver" if seat is driver else "watcher", "driver": driver.name if driver else ""}
                self._later(guest.send(json.dumps({**told, **you})))

    def close(self) -> None:
        """Stop serving."""
        self._soon(self._over.set)
        self._thread.join(10)


class _Guest:
    """A peer's connection."""

    def __init__(self, connection: "ServerConnection") -> None:
        self._connection, self.looks = connection, False
        self._since: float | None = None

    @property
    def behind(self) -> bool:
        """Whether it has not yet taken what was sent."""
        return self._connection.transport.get_write_buffer_size() > MOST_WAITING

    def stuck(self, now: float) -> bool:
        """Whether it has been behind since long before now, s of the wall clock; asked again and again."""
        self._since = (now if self._since is None else self._since) if self.behind else None
        return self._since is not None and now - self._since > MOST_BEHIND_S

    def abort(self) -> None:
        """Cut it off, whatever it has not taken."""
        self._connection.transport.abort()

    async def send(self, message: str | bytes) -> None:
        from websockets.exceptions import ConnectionClosed

        with contextlib.suppress(ConnectionClosed):
            await self._connection.send(message)


def loopback(host: str) -> bool:
    """Whether an address is this machine's own, which no other machine reaches."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False
