#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Sets this checkout up: a .venv with everything from PyPI, and the Debian packages that PyPI does not have.
# Does nothing, quickly and without the network, when all is there. What is missing but not vital is said in one line each.
#
#   scripts/setup.sh           set up what is missing
#   scripts/setup.sh --retry   try the Debian packages again that could not be had before
#   scripts/setup.sh --c       also what tests the C driver on a Cortex-A9 (1.1 GB): its tests are skipped without
#   RELNAV_NO_APT=1            leave Debian's packages alone
set -u
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1

venv=.venv
stamp=$venv/.relnav-setup
tried=$venv/.relnav-apt

say() { printf 'setup: %s\n' "$*"; }
die() { printf 'setup: %s\n' "$*" >&2; exit 2; }
has() { command -v "$1" >/dev/null 2>&1; }
header() { printf '#include <%s>\n' "$1" | c++ -x c++ -E - >/dev/null 2>&1; }

# ------------------------------------------------------------------------------------- Debian packages

root=()
may_apt() {
    [ -z "${RELNAV_NO_APT:-}" ] && has apt-get || return 1
    [ "$(id -u)" = 0 ] && return 0
    root=(sudo -n)
    has sudo && sudo -n true 2>/dev/null
}

updated=no
apt_install() {
    local options=(-o Acquire::Retries=1 -o Acquire::http::Timeout=20 -o Dpkg::Use-Pty=0 -q)
    if [ $updated = no ]; then
        say "apt-get update"
        "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get "${options[@]}" update >/dev/null 2>&1
        updated=yes
    fi
    say "apt-get install $*"
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get "${options[@]}" install -y --no-install-recommends "$@" >/dev/null 2>&1
}

missing_packages() {
    has c++ || echo g++
    has make || echo make
    has perl || echo perl
    has iverilog || echo iverilog
    has gtkwave || echo gtkwave
    has ccache || echo ccache
    if has c++; then
        header lz4.h || echo liblz4-dev
        header zlib.h || echo zlib1g-dev
    fi
}

not_to_be_had=
debian() {
    local wanted package
    wanted=$(missing_packages)
    [ -n "$wanted" ] || return 0
    if [ "$(cat "$tried" 2>/dev/null)" != "$wanted" ] && may_apt; then
        # One at a time only when all together fails: one unknown name must not cost the others.
        # shellcheck disable=SC2086
        apt_install $wanted || for package in $wanted; do apt_install "$package"; done
        wanted=$(missing_packages)
        not_to_be_had=$wanted
    fi
    for package in $wanted; do
        case $package in
        iverilog) say "no Icarus Verilog (Debian package iverilog): simulations run on Verilator only" ;;
        gtkwave) say "no GTKWave (Debian package gtkwave): 'make waves' writes the FST but cannot open it" ;;
        liblz4-dev | zlib1g-dev) say "no $package: Verilator writes waveforms as VCD instead of FST" ;;
        ccache) say "no ccache: Verilator builds take longer" ;;
        *) say "no $package: Verilator cannot build simulations without it" ;;
        esac
    done
}

missing_c_packages() {
    has arm-none-eabi-gcc || echo gcc-arm-none-eabi libnewlib-arm-none-eabi
    has qemu-system-arm || echo qemu-system-arm
    has cppcheck || echo cppcheck
}

c_packages() {
    local wanted
    wanted=$(missing_c_packages)
    # shellcheck disable=SC2086
    [ -n "$wanted" ] && may_apt && apt_install $wanted
    wanted=$(missing_c_packages)
    [ -z "$wanted" ] || die "could not install: ${wanted//$'\n'/ }"
}

# --------------------------------------------------------------------------------------------- Python

find_python() {
    local candidate
    for candidate in ${PYTHON:+"$PYTHON"} python3.11 python3.12 python3.13 python3 python3.14 python; do
        has "$candidate" || continue
        if "$candidate" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
            echo "$candidate"
            return
        fi
    done
}

make_venv() {
    local python
    python=$(find_python)
    [ -n "$python" ] || die "no Python 3.11 or newer found (set PYTHON=/path/to/python3.11)"
    if ! "$python" -c 'import ensurepip' 2>/dev/null && may_apt; then
        apt_install "$("$python" -c 'import sys; print(f"python3.{sys.version_info[1]}-venv")')"
    fi
    say "making $venv with $("$python" --version)"
    "$python" -m venv --clear $venv || die "$python cannot make a virtual environment (Debian package python3-venv)"
}

# cocotb loads libpython into the simulator; Debian's python3 alone does not bring it.
libpython() {
    $venv/bin/python -c 'import sys, find_libpython as f; sys.exit(f.find_libpython() is None)' 2>/dev/null && return
    local package
    package=$($venv/bin/python -c 'import sys; print(f"libpython3.{sys.version_info[1]}")')
    may_apt && apt_install "$package"
    $venv/bin/python -c 'import sys, find_libpython as f; sys.exit(f.find_libpython() is None)' 2>/dev/null ||
        say "no shared libpython for this Python (Debian package $package): simulations cannot start"
}

python_packages() {
    local wanted
    wanted="$(cat pyproject.toml constraints.txt | cksum) $PWD"
    [ "$(cat $stamp 2>/dev/null)" = "$wanted" ] && [ -x $venv/bin/python ] && return 0
    # A virtual environment does not survive a move of the checkout.
    if [ ! -x $venv/bin/python ] || ! $venv/bin/python -c 'import pip' 2>/dev/null ||
        { [ -f $stamp ] && [ "$(cut -d' ' -f3- $stamp)" != "$PWD" ]; }; then
        make_venv
    fi
    say "installing Python packages (a few minutes the first time)"
    local pip=("$venv/bin/python" -m pip --disable-pip-version-check install -qq)
    if ! "${pip[@]}" -c constraints.txt -e '.[sim,dev,synth,formal,package,docs]'; then
        say "the pinned versions could not be installed; trying the newest that pyproject.toml allows"
        "${pip[@]}" -e '.[sim,dev,synth,formal,package,docs]' || die "pip could not install the packages (is the network reachable?)"
    fi
    libpython
    printf '%s\n' "$wanted" >$stamp
}

[ "${1:-}" = --retry ] && rm -f "$tried"
debian
[ "${1:-}" = --c ] && c_packages
python_packages
if [ -n "$not_to_be_had" ]; then printf '%s\n' "$not_to_be_had" >"$tried"; fi
