#!/usr/bin/env bash
# Bring what wheels do not carry: installs what is missing when root, names the command otherwise.
#   software OpenGL (EGL, OSMesa): rendering without a display       bubblewrap: the strongest sandbox level (optional)
#   LLVM 17 or newer: final films are traced 3 to 5 times as fast (optional)
# With `harness` also what the harnesses need:
#   npm: brings them       ripgrep: OpenCode does not start without it       socat: Claude Code confines its shell with it
# With `suites` also what all that CI runs needs: those, make and git, Chromium, in which the live page is driven (optional), and Fast
# DDS with a compiler, another vendor's end of a ROS 2 network (optional).
set -euo pipefail

missing=()
need() { ldconfig -p | grep -q "$1" || missing+=("$2"); }
need_program() { command -v "$1" >/dev/null || missing+=("$2"); }
need libEGL.so.1 libegl1
need libEGL_mesa.so.0 libegl-mesa0
need libGL.so.1 libgl1
need libOSMesa.so libosmesa6
ldconfig -p | grep -qE 'libLLVM(-|\.so\.)(1[7-9]|2[0-9])' || missing+=(libllvm19)
need_program bwrap bubblewrap
if [ "${1:-}" = suites ]; then
  need_program make make
  need_program git git
  command -v chromium-browser >/dev/null || need_program chromium chromium
  need_program g++ g++
  [ -f /usr/include/fastdds/dds/domain/DomainParticipant.hpp ] || missing+=(libfastrtps-dev)
fi
if [ "${1:-}" = suites ] || [ "${1:-}" = harness ]; then
  need_program npm npm
  need_program rg ripgrep
  need_program socat socat
fi
"${PYTHON:-python3}" -c 'import ensurepip, venv' 2>/dev/null || missing+=(python3-venv)
[ ${#missing[@]} -eq 0 ] && exit 0
if [ "${missing[*]}" = libllvm19 ] && { [ "$(id -u)" -ne 0 ] || ! command -v apt-get >/dev/null; }; then
  echo "Final films would be traced 3 to 5 times as fast with LLVM 17 or newer (Debian: apt-get install libllvm19)"
  exit 0
fi

if ! command -v apt-get >/dev/null; then
  echo "Missing: ${missing[*]} (Debian names). Install their counterparts with this system's package manager." >&2
  exit 1
fi
if [ "$(id -u)" -ne 0 ]; then
  echo "Missing system packages. Run once:  sudo apt-get install -y ${missing[*]}" >&2
  exit 1
fi
echo "Installing ${missing[*]} ..."
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq
for package in "${missing[@]}"; do
  # libosmesa6 has left the newest distributions; EGL alone is enough there. Older ones have no libllvm19.
  apt-get install -y -qq --no-install-recommends "$package" >/dev/null || {
    case "$package" in libosmesa6 | bubblewrap | libllvm19 | chromium | g++ | libfastrtps-dev) ;; *) exit 1 ;; esac
    echo "$package is not available here; going on without it"
  }
done
