"""The filters' verdicts, for both architectures, by running their instructions here."""

import errno
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from worldwright.stage.sandbox import seccomp, syscalls

MACHINES = list(syscalls.AUDIT)
REFUSED, MISSING = seccomp.refuse(), seccomp.refuse(errno.ENOSYS)


def verdict(program: bytes, machine: str, number: int, *arguments: int, audit: int | None = None) -> int:
    """What classic BPF decides about one call."""
    words = [word & (1 << 64) - 1 for word in (*arguments, *[0] * (6 - len(arguments)))]
    data = struct.pack("<IIQ6Q", number, audit or syscalls.AUDIT[machine], 0, *words)
    steps = [struct.unpack_from("HBBI", program, at) for at in range(0, len(program), 8)]
    at, held = 0, 0
    while True:
        code, true, false, k = steps[at]
        at += 1
        if code == seccomp.LOAD:
            held = struct.unpack_from("<I", data, k)[0]
        elif code == seccomp.AND:
            held &= k
        elif code == seccomp.RETURN:
            return k
        else:
            holds = {seccomp.EQUAL: held == k, seccomp.GREATER: held > k, seccomp.AT_LEAST: held >= k}[code]
            at += true if holds else false


@pytest.fixture(params=MACHINES)
def machine(request, monkeypatch):
    monkeypatch.setattr(seccomp, "architecture", lambda: request.param)
    return request.param


def number(name: str, machine: str) -> int:
    found = syscalls.number(name, machine)
    assert found is not None
    return found


def test_every_forbidden_call_is_refused_and_reading_is_not(machine):
    program = seccomp.denial()
    for name in seccomp.FORBIDDEN:
        known = syscalls.number(name, machine)
        assert known is None or verdict(program, machine, known) == REFUSED, name
    for allowed in ({"x86_64": 0, "aarch64": 63}[machine], {"x86_64": 9, "aarch64": 222}[machine]):  # read, mmap
        assert verdict(program, machine, allowed) == seccomp.ALLOW


def test_arguments_decide(machine):
    program = seccomp.denial()

    def said(name: str, *arguments: int) -> int:
        return verdict(program, machine, number(name, machine), *arguments)

    assert said("socketpair", 1) == seccomp.ALLOW
    assert said("socketpair", 2) == REFUSED
    assert said("clone", 0x003D0F00) == seccomp.ALLOW  # a thread
    assert said("clone", 0x10000011) == REFUSED  # in a new user namespace
    assert said("ioctl", 1, 0x5412) == REFUSED
    assert said("ioctl", 1, 0x5401) == seccomp.ALLOW
    assert said("prlimit64", 0, 7, 0, 0x7000) == seccomp.ALLOW
    assert said("prlimit64", 0, 7, 0x7FFF_0000_1000, 0) == REFUSED
    assert said("prlimit64", 0, 7, 0x1_0000_0000, 0) == REFUSED
    assert said("setpriority", 0, 0, 5) == seccomp.ALLOW
    assert said("setpriority", 0, 99, 5) == REFUSED
    assert said("clone3") == said("openat2") == MISSING


def test_foreign_conventions_and_newer_calls(machine):
    program = seccomp.denial()
    assert verdict(program, machine, 0, audit=0x40000003) == seccomp.KILL
    assert verdict(program, machine, syscalls.NEWEST + 1) == MISSING
    if machine == "x86_64":
        assert verdict(program, machine, 0x40000000 + 41) == MISSING


def test_what_an_older_landlock_leaves_open_is_closed_here(machine):
    old = seccomp.denial(landlock_abi=2, own_pid=77)
    assert verdict(old, machine, number("kill", machine), 77, 9) == seccomp.ALLOW
    assert verdict(old, machine, number("kill", machine), 78, 0) == REFUSED
    assert verdict(old, machine, number("kill", machine), -1, 9) == REFUSED
    assert verdict(old, machine, number("pidfd_send_signal", machine)) == REFUSED
    assert verdict(old, machine, number("truncate", machine)) == REFUSED
    assert verdict(old, machine, number("openat", machine), 0, 0, 0o1000) == REFUSED
    assert verdict(old, machine, number("openat", machine), 0, 0, 0o1101) == seccomp.ALLOW
    new = seccomp.denial(landlock_abi=7)
    assert verdict(new, machine, number("kill", machine), 78, 0) == seccomp.ALLOW  # Landlock's to judge


def test_births_are_asked_for_and_nothing_else_is(machine):
    program = seccomp.births()
    assert verdict(program, machine, number("clone", machine)) == seccomp.NOTIFY
    assert verdict(program, machine, number("clone3", machine)) == MISSING
    assert verdict(program, machine, number("socket", machine)) == seccomp.ALLOW


@given(st.sampled_from(MACHINES), st.integers(0, 2**32 - 1), st.lists(st.integers(0, 2**64 - 1), max_size=6))
def test_every_call_gets_one_of_the_verdicts(machine, called, arguments):
    rules = [(name, REFUSED) for name in seccomp.FORBIDDEN]
    program = seccomp.assemble([*rules, seccomp.When("ioctl", 1, 0xFF, 3)], machine)
    assert verdict(program, machine, called, *arguments) in (seccomp.ALLOW, REFUSED, MISSING, seccomp.KILL)
