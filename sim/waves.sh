#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Open GTKWave on the last waveform of a core (oltae_top or ivisnav_top), with its saved layout.
# Where there is no screen or no GTKWave: make sure that the file is there and say how to open it.
set -u
cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
core=${1:-oltae_top}
folder=build/waves

# the last one written: a Verilator without lz4 and zlib headers writes VCD
newest() {
    local found="" file
    for file in "$folder/$core.fst" "$folder/$core.vcd"; do
        if [ -f "$file" ] && { [ -z "$found" ] || [ "$file" -nt "$found" ]; }; then found=$file; fi
    done
    echo "$found"
}

wave=$(newest)
if [ -z "$wave" ]; then
    echo "waves: no waveform yet; simulating one"
    .venv/bin/python -m sim.waves "$core" || exit 1
    wave=$(newest)
fi
[ -n "$wave" ] || { echo "waves: no waveform was written" >&2; exit 1; }
# opened at the last frame; the layout as saved shows the beginning
layout=$(.venv/bin/python -m sim.waves "$core" "$wave") || layout=sim/$core.gtkw

if ! command -v gtkwave >/dev/null 2>&1; then
    echo "waves: $wave is written; GTKWave is not installed here (Debian package gtkwave). Open it with: gtkwave $wave $layout"
elif [ -z "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    echo "waves: $wave is written; there is no screen here. On one with a screen: gtkwave $wave $layout"
else
    exec gtkwave "$wave" "$layout"
fi
