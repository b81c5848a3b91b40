"""Ways out of the sandbox, one small function each. This file is run inside it; it imports nothing of ours.

A function that returns got out; one that raises an OSError saying "not allowed, not there, not visible" did not. Every
attempt is chosen so that it harms nothing where it succeeds: signal 0, the value a setting has already, a file made
for the test. `W` describes the world outside, for real: paths, process numbers, ports somebody listens on.
"""

import ctypes
import errno
import json
import mmap
import os
import resource
import signal
import socket
import struct
import sys
from pathlib import Path

ATTEMPTS = {}
MARK = "OUTCOMES "
"""Begins the line of the log that tells them."""
BARRED = {
    getattr(errno, name)
    for name in [
        "EPERM",
        "EACCES",
        "EROFS",
        "ENOENT",
        "ENOSYS",
        "ESRCH",
        "ENETUNREACH",
        "EXDEV",
        "ENOTDIR",
        "EAFNOSUPPORT",
        "ENXIO",
    ]
}
libc = ctypes.CDLL(None, use_errno=True)
X86 = os.uname().machine == "x86_64"
W: dict = {}


class NotFeasible(Exception):
    """This kernel or this world has no such door, open or shut."""


def attempt(function):
    ATTEMPTS[function.__name__] = function
    return function


def ok(result):
    if result < 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
    return result


def syscall(x86, arm, *arguments):
    return ok(libc.syscall(x86 if X86 else arm, *arguments))


# Writing what lies outside.


@attempt
def write_absolute():
    Path(W["outside"], "written").write_text("x")


@attempt
def write_relative():
    Path(os.path.relpath(W["outside"])).joinpath("written").write_text("x")


@attempt
def write_beside_the_out_folder():
    Path(W["out"]).parent.joinpath("written").write_text("x")


@attempt
def write_through_a_symlink():
    os.symlink(W["victim"], "link")
    Path("link").write_text("overwritten")


@attempt
def write_through_a_symlinked_folder():
    os.symlink(W["outside"], "folder")
    Path("folder/written").write_text("x")


@attempt
def write_through_a_hard_link():
    os.link(W["victim"], "hard")
    Path("hard").write_text("overwritten")


@attempt
def move_a_file_in():
    os.rename(W["victim"], "mine")


@attempt
def move_a_file_out():
    Path("own").write_text("x")
    os.rename("own", W["outside"] + "/written")


@attempt
def link_a_file_out():
    Path("own-link").write_text("x")
    os.link("own-link", W["outside"] + "/written")


@attempt
def symlink_outside():
    os.symlink("/", W["outside"] + "/written")


@attempt
def delete_outside():
    os.unlink(W["victim"])


@attempt
def make_a_folder_outside():
    os.mkdir(W["outside"] + "/written")


@attempt
def remove_a_folder_outside():
    os.rmdir(W["outside"] + "/empty")


@attempt
def truncate_outside():
    os.truncate(W["victim"], 0)


@attempt
def truncate_by_opening_to_read():
    os.close(os.open(W["victim"], os.O_RDONLY | os.O_TRUNC))


@attempt
def append_to_the_journal():
    with open(W["journal"], "a") as stream:
        stream.write("{}\n")


@attempt
def overwrite_the_plan():
    open(W["plan"], "r+").close()


@attempt
def overwrite_the_program():
    open(W["program"], "r+").close()


@attempt
def overwrite_the_snapshot():
    open(__file__, "r+").close()


@attempt
def overwrite_earlier_evidence():
    open(W["evidence"], "r+").close()


@attempt
def plant_evidence():
    os.mkdir(Path(W["evidence"]).parent / "stills")


@attempt
def overwrite_the_job_specification():
    open(Path(W["out"]).parent / "spec.json", "r+").close()


@attempt
def overwrite_the_job_state():
    open(Path(W["out"]).parent / "state.json", "r+").close()


@attempt
def unlock_the_job():
    open(Path(W["out"]).parent / "lock", "r+").close()


@attempt
def overwrite_worldkit():
    open(W["worldkit"], "r+").close()


@attempt
def plant_a_start_up_hook():
    Path(W["packages"], "worldwright-escape-test.pth").write_text("")


@attempt
def write_into_tmp():
    Path("/tmp", W["name"]).write_text("x")


@attempt
def write_into_var_tmp():
    Path("/var/tmp", W["name"]).write_text("x")


@attempt
def write_into_etc():
    Path("/etc", W["name"]).write_text("x")


@attempt
def write_into_usr():
    Path("/usr", W["name"]).write_text("x")


@attempt
def change_a_mode():
    os.chmod(W["victim"], 0o644)


@attempt
def change_a_mode_by_descriptor():
    os.fchmod(os.open(sys.executable, os.O_RDONLY), os.stat(sys.executable).st_mode & 0o7777)


@attempt
def change_an_owner():
    os.chown(W["victim"], os.getuid(), os.getgid())


@attempt
def change_a_time():
    os.utime(W["victim"])


@attempt
def set_an_attribute():
    os.setxattr(W["victim"], "user.escape", b"x")


@attempt
def make_a_pipe_outside():
    os.mkfifo(W["outside"] + "/written")


@attempt
def make_a_device():
    os.mknod("null", 0o020666, os.makedev(1, 3))


# Reading what lies outside.


@attempt
def read_a_secret():
    return Path(W["secret"]).read_text()


@attempt
def list_the_home_folder():
    return os.listdir(W["home"])


@attempt
def list_the_real_home_folder():
    names = set(os.listdir(W["real_home"]))  # the way to an interpreter in there may show, and nothing else
    if names < set(W["real_names"]):
        raise PermissionError(errno.ENOENT, "only what leads to the interpreter is there")
    return names


@attempt
def read_through_a_symlink():
    os.symlink(W["secret"], "peek")
    return Path("peek").read_text()


@attempt
def read_through_a_hard_link():
    os.link(W["secret"], "peek-hard")
    return Path("peek-hard").read_text()


@attempt
def read_through_proc_self_root():
    return Path("/proc/self/root" + W["secret"]).read_text()


@attempt
def read_through_proc_self_cwd():
    return Path("/proc/self/cwd", os.path.relpath(W["secret"])).read_text()


@attempt
def read_through_the_servers_root():
    same_process()
    return Path(f"/proc/{W['pid']}/root{W['secret']}").read_text()


@attempt
def read_through_an_inherited_descriptor():
    for name in os.listdir("/proc/self/fd"):
        target = os.readlink(f"/proc/self/fd/{name}") if os.path.lexists(f"/proc/self/fd/{name}") else ""
        if int(name) > 2 and target.startswith("/") and not target.startswith(("/proc", W["out"], "/dev/null")):
            return target
    raise PermissionError(errno.EPERM, "no descriptor was inherited")


@attempt
def read_by_file_handle():
    handle = ctypes.create_string_buffer(struct.pack("Ii", 8, 1) + bytes(128))
    syscall(304, 265, os.open("/", os.O_RDONLY), handle, 0)


@attempt
def read_etc_shadow():
    return Path("/etc/shadow").read_text()


@attempt
def read_anothers_environment():
    same_process()
    return Path(f"/proc/{W['pid']}/environ").read_bytes()


@attempt
def read_a_secret_variable():
    if any("WORLDWRIGHT_TEST_SECRET" in name for name in os.environ):
        return "seen"
    if b"WORLDWRIGHT_TEST_SECRET" in Path("/proc/self/environ").read_bytes():
        return "seen"
    raise PermissionError(errno.EPERM, "the environment holds nothing of the user's")


@attempt
def watch_a_folder():
    watch = ok(libc.inotify_init1(0))
    ok(libc.inotify_add_watch(watch, W["outside"].encode(), 0xFFF))


@attempt
def read_the_disk():
    return open(W["disk"], "rb").read(1)


@attempt
def read_memory_of_the_machine():
    return open("/dev/mem", "rb").read(1)


@attempt
def read_the_kernel_log():
    return open("/dev/kmsg", "rb", buffering=0).fileno()


@attempt
def read_the_kernel_log_by_call():
    ok(libc.klogctl(10, None, 0))


# Talking to others.


@attempt
def tcp():
    socket.create_connection(("127.0.0.1", W["tcp"]), timeout=2)


@attempt
def tcp_over_ipv6():
    socket.create_connection(("::1", W["tcp"]), timeout=2)


@attempt
def tcp_to_the_world():
    socket.create_connection(("192.0.2.1", 80), timeout=2)


@attempt
def listen():
    socket.socket().bind(("127.0.0.1", 0))


@attempt
def udp():
    socket.socket(socket.AF_INET, socket.SOCK_DGRAM).sendto(b"x", ("127.0.0.1", W["udp"]))


@attempt
def unix_socket():
    socket.socket(socket.AF_UNIX).connect(W["unix"])


@attempt
def unix_datagram():
    socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM).sendto(b"x", W["unix"])


@attempt
def abstract_socket():
    socket.socket(socket.AF_UNIX).connect("\0" + W["name"])


@attempt
def raw_socket():
    socket.socket(socket.AF_INET, socket.SOCK_RAW, socket.IPPROTO_ICMP)


@attempt
def packet_socket():
    socket.socket(socket.AF_PACKET, socket.SOCK_RAW, 0)


@attempt
def netlink():
    socket.socket(socket.AF_NETLINK, socket.SOCK_RAW, 0)


@attempt
def virtual_machine_socket():
    socket.socket(40, socket.SOCK_STREAM)


@attempt
def a_pair_of_another_family():
    socket.socketpair(30, socket.SOCK_STREAM)  # AF_TIPC


@attempt
def system_v_shared_memory():
    ok(libc.shmget(0x77, 4096, 0o1600))


@attempt
def message_queue():
    ok(libc.mq_open(b"/" + W["name"].encode(), os.O_CREAT | os.O_RDWR, 0o600, None))


@attempt
def the_hosts_shared_memory():
    if Path("/dev/shm", W["name"]).exists():
        return Path("/dev/shm", W["name"]).read_bytes()
    raise PermissionError(errno.ENOENT, "not visible")


# Reaching other processes.


def same_process():
    """Another process of this number, in a namespace of our own, is not the one we are after."""
    try:
        start = Path(f"/proc/{W['pid']}/stat").read_text().rpartition(")")[2].split()[19]
    except OSError:
        return
    if start != W["start"]:
        raise ProcessLookupError(errno.ESRCH, "not visible")


@attempt
def signal_the_server():
    same_process()
    os.kill(W["pid"], 0)


@attempt
def signal_the_supervisor():
    if W["supervisor"] == 1:
        raise ProcessLookupError(errno.ESRCH, "the first process here is bubblewrap's, not the supervisor")
    os.kill(W["supervisor"], 0)


@attempt
def signal_by_thread():
    same_process()
    syscall(234, 131, W["pid"], W["pid"], 0)


@attempt
def signal_by_queue():
    same_process()
    information = ctypes.create_string_buffer(struct.pack("iii", 0, 0, -1) + bytes(128))
    syscall(129, 138, W["pid"], 0, information)


@attempt
def signal_by_descriptor():
    same_process()
    signal.pidfd_send_signal(os.pidfd_open(W["pid"]), 0)


@attempt
def trace_the_server():
    same_process()
    ok(libc.ptrace(0x4206, W["pid"], None, None))


@attempt
def read_the_servers_memory():
    same_process()
    open(f"/proc/{W['pid']}/mem", "rb").close()


@attempt
def read_the_servers_memory_by_call():
    same_process()
    buffer = ctypes.create_string_buffer(8)
    vector = struct.pack("QQ", ctypes.addressof(buffer), 8)
    syscall(310, 270, W["pid"], vector, 1, vector, 1, 0)


@attempt
def steal_a_descriptor():
    same_process()
    syscall(438, 438, os.pidfd_open(W["pid"]), 1, 0)


@attempt
def slow_the_server_down():
    same_process()
    os.setpriority(os.PRIO_PROCESS, W["pid"], 0)


@attempt
def pin_the_server():
    same_process()
    os.sched_setaffinity(W["pid"], os.sched_getaffinity(W["pid"]))


@attempt
def limit_the_server():
    same_process()
    resource.prlimit(W["pid"], resource.RLIMIT_CORE, resource.prlimit(W["pid"], resource.RLIMIT_CORE))


@attempt
def outlive_the_supervisor():
    ok(libc.prctl(1, 0, 0, 0, 0))


# Asking the kernel for more.


@attempt
def raise_a_limit():
    try:
        resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
    except ValueError as barred:
        raise PermissionError(errno.EPERM, str(barred)) from barred


@attempt
def drop_the_token():
    try:
        resource.setrlimit(resource.RLIMIT_MSGQUEUE, (1, 1))
    except ValueError as barred:
        raise PermissionError(errno.EPERM, str(barred)) from barred


@attempt
def drop_the_token_with_an_odd_pointer():
    page = 0x1_0000_0000  # its low half is zero
    libc.mmap.restype = ctypes.c_void_p
    at = libc.mmap(ctypes.c_void_p(page), ctypes.c_size_t(4096), 3, 0x100022, -1, ctypes.c_long(0))
    if at != page:
        raise NotFeasible("no memory there")
    ctypes.memmove(page, struct.pack("QQ", 1, 1), 16)
    ok(libc.syscall(302 if X86 else 261, 0, 12, ctypes.c_void_p(page), None))


@attempt
def mount_something():
    ok(libc.mount(b"none", W["outside"].encode(), b"no-such-file-system", 0, None))


@attempt
def mount_the_new_way():
    syscall(430, 430, b"tmpfs", 0)


@attempt
def unmount_something():
    ok(libc.umount2(W["outside"].encode(), 0))


@attempt
def change_the_root():
    os.chroot("/")


@attempt
def pivot_the_root():
    syscall(155, 41, b".", b".")


@attempt
def new_user_namespace():
    ok(libc.unshare(0x10000000))


@attempt
def new_network_namespace():
    ok(libc.unshare(0x40000000))


@attempt
def new_namespace_by_clone():
    child = syscall(56, 220, 0x10000000 | signal.SIGCHLD, 0, 0, 0, 0)
    if child == 0:
        os._exit(0)


@attempt
def new_namespace_by_clone3():
    arguments = struct.pack("8Q", 0x10000000, 0, 0, 0, signal.SIGCHLD, 0, 0, 0)
    if syscall(435, 435, arguments, 64) == 0:
        os._exit(0)


@attempt
def join_the_first_namespace():
    ok(libc.setns(os.open("/proc/self/ns/user", os.O_RDONLY), 0))


@attempt
def keyring():
    syscall(250, 219, 0, -3, 1)


@attempt
def add_a_key():
    syscall(248, 217, b"user", b"escape", b"x", 1, -2)


@attempt
def load_a_kernel_program():
    attributes = ctypes.create_string_buffer(struct.pack("IIII", 2, 4, 8, 1) + bytes(112))
    syscall(321, 280, 0, attributes, 128)


@attempt
def count_kernel_events():
    attributes = ctypes.create_string_buffer(struct.pack("IIQ", 1, 112, 0) + bytes(96))
    syscall(298, 241, attributes, 0, -1, -1, 0)


@attempt
def handle_faults():
    syscall(323, 282, 0)


@attempt
def queue_of_calls():
    syscall(425, 425, 1, ctypes.create_string_buffer(120))


@attempt
def run_from_memory():
    handle = os.memfd_create("program")
    os.write(handle, Path("/bin/true").read_bytes())
    os.execve(handle, ["true"], {})


@attempt
def run_by_descriptor():
    syscall(322, 281, os.open("/bin/true", os.O_RDONLY), b"", None, None, 0x1000)


@attempt
def become_root():
    os.setuid(0)


@attempt
def become_nobody():
    os.setuid(65534)


@attempt
def run_a_set_user_program():
    for name in ("/usr/bin/su", "/usr/bin/passwd", "/usr/bin/mount"):
        if os.path.exists(name) and os.stat(name).st_mode & 0o4000:
            if libc.prctl(39, 0, 0, 0, 0) == 1:  # PR_GET_NO_NEW_PRIVS
                raise PermissionError(errno.EPERM, "programs run from here gain no privileges")
            return name
    raise NotFeasible("this machine has none")


@attempt
def capabilities():
    words = dict(line.split(":\t") for line in Path("/proc/self/status").read_text().splitlines() if ":\t" in line)
    if int(words["CapEff"], 16) | int(words["CapPrm"], 16):
        return words["CapEff"]
    raise PermissionError(errno.EPERM, "none left")


@attempt
def set_capabilities():
    ok(libc.capset(struct.pack("Ii", 0x20080522, 0), struct.pack("6I", *[0] * 6)))


@attempt
def set_a_kernel_setting():
    path = Path("/proc/sys/kernel/core_pattern")
    path.write_text(path.read_text())


@attempt
def open_a_kernel_setting():
    os.close(os.open("/proc/sys/vm/overcommit_memory", os.O_WRONLY))


@attempt
def magic_key():
    os.close(os.open("/proc/sysrq-trigger", os.O_WRONLY))


@attempt
def write_below_sys():
    os.close(os.open("/sys/power/state", os.O_WRONLY))


@attempt
def write_a_control_group():
    for name in ("/sys/fs/cgroup/cgroup.procs", "/sys/fs/cgroup/pids/cgroup.procs"):
        if os.path.exists(name):
            os.close(os.open(name, os.O_WRONLY))
            return name
    raise PermissionError(errno.ENOENT, "not visible")


@attempt
def load_a_module():
    syscall(175, 105, b"", 0, b"")


@attempt
def restart_the_machine():
    syscall(169, 142, 0, 0, 0, 0)  # the right is asked for before the magic numbers, which are wrong


@attempt
def set_the_clock():
    syscall(227, 112, 0, struct.pack("qq", -1, -1))


@attempt
def name_the_machine():
    name = os.uname().nodename.encode()
    ok(libc.sethostname(name, len(name)))


@attempt
def swap():
    ok(libc.swapon(W["victim"].encode(), 0))


@attempt
def quota():
    syscall(179, 60, 0x800001 << 8, None, 0, None)


@attempt
def ports():
    if not X86:
        raise NotFeasible("an x86 matter")
    ok(libc.ioperm(0x80, 1, 1))


@attempt
def another_personality():
    ok(libc.personality(0x0040000))


@attempt
def the_other_calling_convention():
    if not X86:
        raise NotFeasible("an x86 matter")
    ok(libc.syscall(0x40000000 + 41, 2, 1, 0))


@attempt
def a_call_newer_than_we_know():
    ok(libc.syscall(467, -1, b"", 0, None, 0))


@attempt
def the_old_calling_convention():
    if not X86:
        raise NotFeasible("an x86 matter")
    # mov eax, 20 (getpid for 32 bits); int 0x80; ret
    code = mmap.mmap(-1, 4096, prot=mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC)
    code.write(b"\xb8\x14\x00\x00\x00\xcd\x80\xc3")
    call = ctypes.CFUNCTYPE(ctypes.c_int)(ctypes.addressof(ctypes.c_char.from_buffer(code)))
    return call()  # the filter ends the process


@attempt
def type_into_the_terminal():
    import fcntl

    fcntl.ioctl(0, 0x5412, b"x")


@attempt
def open_the_terminal():
    os.close(os.open("/dev/tty", os.O_RDWR))


def run(name):
    """One attempt in a process of its own, so that one that is killed spoils no other."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        signal.alarm(8)
        try:
            said = f"GOT OUT: {ATTEMPTS[name]()!r}"
        except NotFeasible as why:
            said = f"not feasible: {why}"
        except OSError as barred:
            said = f"{'barred' if barred.errno in BARRED else 'GOT OUT'}: {barred}"
        except Exception as odd:
            said = f"ERROR: {type(odd).__name__}: {odd}"
        os.write(write, said.encode()[:4000])
        os._exit(0)
    os.close(write)
    with os.fdopen(read, "rb") as stream:
        said = stream.read().decode()
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    return said or (f"barred: ended by signal {-status}" if status == -31 else f"ERROR: ended with {status}")


def main(world):
    W.update(world, out=os.getcwd(), supervisor=os.getppid())
    outcomes = {name: run(name) for name in ATTEMPTS}
    print(f"\n{MARK}{json.dumps(outcomes)}", flush=True)
