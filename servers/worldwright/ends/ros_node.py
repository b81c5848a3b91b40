"""One node of a ROS 2 network, spoken over DDS without a ROS installation (extra `ros`: Eclipse Cyclone DDS, rosbags).

Names, types, qualities and discovery are as ROS 2 Jazzy has them: topics under `rt/`, types as `pkg::msg::dds_::Name_` with
their hash in the endpoints' USER_DATA, XCDR1, reliable and the last 10 unless said otherwise, and the node with its endpoints
in `ros_discovery_info`, by which `ros2 node list` and `ros2 topic info` know it. What a peer sends is read by Cyclone, which
drops what is no message of the type; who sent it is told by the peer's own discovery.

Without an `interface` it is on the loopback interface alone, and finds its peers by asking the first ports of the domain
there: a peer of Fast DDS needs nothing for that, one of Cyclone `ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST`. DDS knows no
token: on another interface whoever reaches it may drive.
"""

import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any
from xml.sax.saxutils import quoteattr

from ..model.errors import NotFoundError
from .ros_types import INSTALL, Types, UnreadableError, sample

LOOPBACK = "127.0.0.1"
MOST_DOMAIN = 232
MOST_PARTICIPANTS = 32
"""Peers on the loopback interface are looked for at so many ports,"""
ASKS_S = 1
"""again and again, as a peer that asks only by multicast is not heard there."""
MOST_NODES = 10_000
BLOCKS_MS = 1
"""A reader that takes nothing holds up a writer for so long, and then misses a message."""
DEPTH, MOST_TAKEN = 10, 64
INFO_TOPIC, INFO = "ros_discovery_info", "rmw_dds_common/msg/ParticipantEntitiesInfo"
NODE_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,254}")


@dataclass(frozen=True)
class Sender:
    """Who sent a message: a participant, which is a process of theirs in nearly all cases."""

    participant: str
    node: str
    """Its node by name, as far as it told; empty where it told nothing."""


@dataclass
class Publisher:
    """Of one topic."""

    topic: str
    kind: str
    _types: Types
    _writer: Any
    _struct: Any
    missed: int = 0
    """Messages that were not sent, as a reader that wants each had not taken those before."""

    def send(self, message: dict[str, Any]) -> bool:
        """Publish a message; whether it was sent."""
        from cyclonedds.core import DDSException

        try:
            self._writer.write(sample(self._struct, self._types.encode(self.kind, message)))
        except DDSException:
            self.missed += 1
            return False
        return True

    def acknowledged(self, seconds: float) -> bool:
        """Wait until every reader that wants all of them has what was sent; whether it came to that."""
        return bool(self._writer.wait_for_acks(int(seconds * 1e9)))

    @property
    def heard(self) -> bool:
        """Whether anybody listens."""
        return bool(self._writer.get_publication_matched_status().current_count)


@dataclass
class _Subscription:
    topic: str
    kind: str
    take: Callable[[Any, Sender], object]
    reader: Any
    senders: dict[int, Sender] = field(default_factory=dict)


class RosNode:
    """A node that publishes and listens, from its making until `close`; all calls are of one thread.

    Args:
        name: of the node.
        domain: `ROS_DOMAIN_ID`.
        interface: address or name of another interface than loopback.

    Attributes:
        unreadable: messages that were none of their type.

    Raises:
        NotFoundError: the extra `ros` is not installed, the name or the domain is none, or there is no such interface.
    """

    def __init__(self, name: str = "worldwright", domain: int = 0, interface: str = "") -> None:
        check(name, domain)
        try:
            from cyclonedds.core import DDSException, WaitSet
            from cyclonedds.domain import Domain, DomainParticipant
            from cyclonedds.qos import Policy, Qos
        except ImportError as cause:
            raise NotFoundError("cyclonedds is not installed", place="extra `ros`", next_move=INSTALL) from cause
        self.name, self.types, self.unreadable = name, Types(), 0
        try:
            self._domain = Domain(domain, _configuration(interface))
            self._participant = DomainParticipant(domain, Qos(Policy.Userdata(b"enclave=/;")))
        except DDSException as cause:
            raise NotFoundError(
                f"domain {domain} cannot be joined on {interface or LOOPBACK}: {str(cause)[:200]}",
                next_move="name an interface of this machine, and another domain than one that this process is in",
            ) from cause
        self._waits = WaitSet(self._participant)
        self._publishers: list[Publisher] = []
        self._subscriptions: list[_Subscription] = []
        self._nodes: dict[bytes, str] = {}
        self._info = self._writer(INFO_TOPIC, INFO, latched=True, depth=1)
        self._infos = self._reader(INFO_TOPIC, INFO, latched=True, depth=100)

    def publisher(self, topic: str, kind: str, latched: bool = False, depth: int = DEPTH) -> Publisher:
        """A publisher of a topic (`/odom`).

        Args:
            topic, kind: its name and type.
            latched: whoever comes later gets the last `depth` messages (transient local).
            depth: so many messages wait for a reader.
        """
        made = self._writer(f"rt{topic}", kind, latched, depth)
        self._publishers.append(made)
        return made

    def subscribe(self, topic: str, kind: str, take: Callable[[Any, Sender], object]) -> None:
        """Give each message of a topic, its fields as attributes, to `take`, with its sender."""
        reader = self._reader(f"rt{topic}", kind)
        self._subscriptions.append(_Subscription(topic, kind, take, reader))

    def announce(self) -> None:
        """Tell the network what this node publishes and hears; call it after the last `publisher` and `subscribe`."""
        gids = [[{"data": entity.guid.bytes} for entity in some] for some in (
            [one.reader for one in self._subscriptions], [one._writer for one in self._publishers]
        )]  # fmt: skip
        node = {"node_namespace": "/", "node_name": self.name, "reader_gid_seq": gids[0], "writer_gid_seq": gids[1]}
        self._info.send({"gid": {"data": self._participant.guid.bytes}, "node_entities_info_seq": [node]})

    def spin(self, seconds: float) -> None:
        """Hand out what has come, waiting so long for the first of it."""
        self._waits.wait(max(int(seconds * 1e9), 0))
        self._meet()
        for one in self._subscriptions:
            for taken in one.reader.take(MOST_TAKEN):
                if not taken.sample_info.valid_data:
                    continue
                try:
                    message = self.types.decode(one.kind, taken.cdr)
                except UnreadableError:
                    self.unreadable += 1
                    continue
                one.take(message, self._sender(one, taken.sample_info.publication_handle))

    def present(self) -> set[str]:
        """The participants that publish what this node hears."""
        found = set[str]()
        for one in self._subscriptions:
            handles = one.reader.get_matched_publications()
            one.senders = {handle: self._sender(one, handle) for handle in handles}
            found.update(sender.participant for sender in one.senders.values())
        return found

    def _sender(self, one: _Subscription, handle: int) -> Sender:
        if handle not in one.senders:
            told = None
            with suppress(Exception):  # it is gone already, and its last words are here
                told = one.reader.get_matched_publication_data(handle)
            if told is None:
                return Sender(f"gone-{handle}", "")
            participant = told.participant_key.hex
            one.senders[handle] = Sender(participant, self._nodes.get(told.key.bytes, ""))
        return one.senders[handle]

    def _meet(self) -> None:
        """Learn the names of nodes."""
        for taken in self._infos.take(MOST_TAKEN):
            if not taken.sample_info.valid_data:
                continue
            with suppress(UnreadableError):
                if len(self._nodes) > MOST_NODES:  # whoever comes and goes fills no memory
                    self._nodes.clear()
                for node in self.types.decode(INFO, taken.cdr).node_entities_info_seq:
                    name = f"{node.node_namespace.rstrip('/')}/{node.node_name}"
                    for gid in node.writer_gid_seq:
                        self._nodes[bytes(gid.data)] = name
                for one in self._subscriptions:
                    one.senders.clear()

    def _writer(self, topic: str, kind: str, latched: bool, depth: int) -> Publisher:
        from cyclonedds.pub import DataWriter

        struct = self.types.dds(kind)
        writer = DataWriter(self._participant, self._topic(topic, struct), self._qualities(kind, latched, depth))
        return Publisher(topic.removeprefix("rt"), kind, self.types, writer, struct)

    def _reader(self, topic: str, kind: str, latched: bool = False, depth: int = DEPTH) -> Any:
        from cyclonedds.core import InstanceState, ReadCondition, SampleState, ViewState
        from cyclonedds.sub import DataReader

        struct = self.types.dds(kind)
        reader = DataReader(self._participant, self._topic(topic, struct), self._qualities(kind, latched, depth))
        self._waits.attach(ReadCondition(reader, ViewState.Any | InstanceState.Any | SampleState.NotRead))
        return reader

    def _topic(self, topic: str, struct: Any) -> Any:
        from cyclonedds.core import DDSException
        from cyclonedds.topic import Topic

        try:
            return Topic(self._participant, topic, struct)
        except DDSException as cause:  # as where a body and a command give one topic two types
            raise NotFoundError(
                f"{topic} cannot be a topic of {struct.__idl_typename__}: {str(cause)[:200]}",
                next_move="give the body or the command that it is named after another name",
            ) from cause

    def _qualities(self, kind: str, latched: bool, depth: int) -> Any:
        from cyclonedds.qos import Policy, Qos
        from cyclonedds.util import duration

        return Qos(
            Policy.Reliability.Reliable(duration(milliseconds=BLOCKS_MS)),
            Policy.Durability.TransientLocal if latched else Policy.Durability.Volatile,
            Policy.History.KeepLast(depth),
            Policy.DataRepresentation(use_cdrv0_representation=True),
            Policy.Userdata(f"typehash={self.types.hash(kind)};".encode()),
        )

    def close(self) -> None:
        """Leave the network."""
        for entity in self._entities():
            entity.__del__()  # the package's own way: a child that outlives the domain is deleted with it

    def _entities(self) -> Iterator[Any]:
        yield from (self._waits, self._participant, self._domain)


def check(name: str, domain: int) -> None:
    """Refuse what is no name of a node, or no domain, with a `NotFoundError`."""
    if not NODE_NAME.fullmatch(name):
        raise NotFoundError(
            f"{name[:80]!r} is no name of a node",
            next_move="take letters, digits and underscores, not beginning with a digit",
        )
    if not 0 <= domain <= MOST_DOMAIN:
        raise NotFoundError(
            f"{domain} is no domain of ROS 2",
            next_move=f"give one from 0 to {MOST_DOMAIN}, as ROS_DOMAIN_ID has it",
        )


def _configuration(interface: str) -> str:
    """Cyclone's own settings, whatever the environment says (`CYCLONEDDS_URI`)."""
    if interface:
        where = "address" if re.fullmatch(r"[0-9.]+|[0-9a-fA-F:]*:[0-9a-fA-F:.]*", interface) else "name"
        return (
            f"<CycloneDDS><Domain><General><Interfaces><NetworkInterface {where}={quoteattr(interface)}/>"
            "</Interfaces></General></Domain></CycloneDDS>"
        )
    return (
        f'<CycloneDDS><Domain><General><Interfaces><NetworkInterface address="{LOOPBACK}"/></Interfaces>'
        "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
        f"<MaxAutoParticipantIndex>{MOST_PARTICIPANTS}</MaxAutoParticipantIndex><SPDPInterval>{ASKS_S} s</SPDPInterval>"
        f'<Peers><Peer address="{LOOPBACK}"/></Peers></Discovery></Domain></CycloneDDS>'
    )
