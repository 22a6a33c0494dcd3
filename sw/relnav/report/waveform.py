# SPDX-License-Identifier: Apache-2.0
"""A logic waveform drawn from the simulation's FST (or VCD): one frame from its last beats to its results."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from .style import CORE, DOUBLE, GOOD, INK, MUTED, PAPER, Picture, figure, png

BEFORE, AFTER = 16, 14  # clock cycles drawn before the last beat and after the last event
LONGEST = 260

READY = ("q_ready", "pose_ready", "all_ready")
STATE_NAMES = {0: "IDLE", 1: "LOAD", 2: "COMPUTE", 3: "DONE", 4: "VERIFY"}

# label, colour, names looked for (the first that exists, nearest to the top); state is drawn by name
ROWS: tuple[tuple[str, str, tuple[str, ...]], ...] = (
    ("clk", MUTED, ("clk",)),
    ("s_axis_tvalid", DOUBLE, ("s_axis_tvalid",)),
    ("s_axis_tready", DOUBLE, ("s_axis_tready",)),
    ("s_axis_tlast", DOUBLE, ("s_axis_tlast",)),
    ("state", INK, ("state",)),
    ("pair_valid", PAPER, ("pair_valid",)),  # raw moments leave the Gram array
    ("centred_valid", PAPER, ("centred_valid",)),
    ("item_valid", PAPER, ("item_valid",)),  # lane floats enter the solve engine
    ("engine.run", PAPER, ("run",)),
    ("chosen", PAPER, ("chosen",)),  # the turn is
    ("write_valid", PAPER, ("write_valid",)),  # of a result word
    ("q_ready", CORE, ("q_ready",)),
    ("pose_ready", CORE, ("pose_ready",)),
    ("all_ready", CORE, ("all_ready",)),
    ("irq", GOOD, ("irq",)),
)


@dataclass(frozen=True)
class Trace:
    """A signal's changes.

    Args:
        label, colour: to draw it. times, values: in the file's time units; None is unknown. bits: width.
    """

    label: str
    colour: str
    times: list[int]
    values: list[int | None]
    bits: int

    def at(self, time: int) -> int | None:
        """The value at a time."""
        k = bisect_right(self.times, time) - 1
        return self.values[k] if k >= 0 else None

    def rise(self, after: int) -> int | None:
        """When the signal next becomes 1 after a time."""
        changes = zip(self.times, self.values, strict=True)
        return next((time for time, value in changes if time > after and value == 1), None)


def waveform_figure(path: Path) -> Picture:
    """The last complete frame of a simulation; without a usable file, a picture that says what is missing."""
    title = "Logic waveform"
    if not path.is_file():
        note = f"Not drawn: no waveform at {path.name}. An RTL backend writes it."
        return Picture("fig07_waveform", title, note, "7", None)
    try:
        traces = read_traces(path)
        start, end, period = _window(traces)
    except Exception as error:  # a waveform is a picture, not a result: its absence is told, never fatal
        return Picture("fig07_waveform", title, f"Not drawn: {path.name}: {error}", "7", None)
    return Picture("fig07_waveform", title, _caption(traces), "7", _draw(traces, start, end, period))


def read_traces(path: Path) -> dict[str, Trace]:
    """The signals of ``ROWS`` that the file holds, by label.

    Raises:
        ValueError: no clock or no stream in it.
    """
    import pywellen

    by_name: dict[str, list[Any]] = {}
    for variable in pywellen.Waveform(str(path)).all_vars():
        by_name.setdefault(variable.name.split(" ")[0], []).append(variable)
    traces: dict[str, Trace] = {}
    for label, colour, names in ROWS:
        found = next((by_name[name] for name in names if name in by_name), None)
        if found:
            variable = min(found, key=lambda v: (v.full_name.count("."), v.full_name))
            changes = list(variable.signal)
            times = [int(time) for time, _ in changes]
            values = [value if isinstance(value, int) else None for _, value in changes]  # text: x or z
            traces[label] = Trace(label, colour, times, values, int(variable.bitwidth or 1))
    if missing := {"clk", "s_axis_tvalid", "s_axis_tlast"} - traces.keys():
        raise ValueError(f"no signal {', '.join(sorted(missing))}")
    return traces


def _window(traces: dict[str, Trace]) -> tuple[int, int, int]:
    """Time of the cycle count's zero (the last beat), end of the picture, clock period."""
    clock = traces["clk"]
    rising = [t for t, v in zip(clock.times, clock.values, strict=True) if v == 1]
    if len(rising) < 3:
        raise ValueError("no running clock")
    period = int(np.median(np.diff(rising)))
    beats = _last_beats(traces, rising)
    if not beats:
        raise ValueError("no frame was streamed")
    for zero in reversed(beats):  # the newest frame that also got its results
        ready = [traces[name].rise(zero) for name in (*READY, "irq") if name in traces]
        known = [time for time in ready if time is not None and time - zero < LONGEST * period]
        if known:
            return zero, max(known) + AFTER * period, period
    return beats[-1], beats[-1] + 120 * period, period


def _last_beats(traces: dict[str, Trace], rising: list[int]) -> list[int]:
    """Clock edges at which a frame's last beat is accepted."""
    last, valid, ready = traces["s_axis_tlast"], traces["s_axis_tvalid"], traces.get("s_axis_tready")
    beats: list[int] = []
    for k, (time, value) in enumerate(zip(last.times, last.values, strict=True)):
        if value != 1:
            continue
        until = last.times[k + 1] if k + 1 < len(last.times) else time + 1
        edges = rising[bisect_right(rising, time) : bisect_left(rising, until) + 1]
        # an edge samples what stood just before it
        wires = [last, valid, *([ready] if ready else [])]
        beats += [edge for edge in edges if all(wire.at(edge - 1) == 1 for wire in wires)]
    return beats


def _draw(traces: dict[str, Trace], zero: int, end: int, period: int) -> bytes:
    begin = zero - BEFORE * period
    shown = [traces[label] for label, _, _ in ROWS if label in traces]
    drawn = figure(10.0, 0.55 + 0.31 * len(shown))
    axes = drawn.subplots()
    for row, trace in enumerate(reversed(shown)):
        level = float(row)
        if trace.bits == 1:
            _draw_bit(axes, trace, level, begin, end, zero, period)
        else:
            _draw_bus(axes, trace, level, begin, end, zero, period)
    axes.axvline(0.0, color=MUTED, linewidth=0.8, linestyle="--")
    for row, trace in enumerate(reversed(shown)):
        rise = trace.rise(zero) if trace.label in READY else None
        if rise is not None:
            cycles, inside = (rise - zero) / period, rise <= end
            text = f"{cycles:.0f}" if inside else f"{cycles:.0f} →"
            axes.annotate(
                text, (cycles if inside else (end - zero) / period, row + 0.3),
                xytext=(-4, 0), textcoords="offset points",
                ha="right", va="center", fontsize=8.5, color=CORE, fontweight="bold",
            )  # fmt: skip
    labels = [trace.label for trace in reversed(shown)]
    axes.set_yticks(np.arange(len(shown)) + 0.3, labels, family="DejaVu Sans Mono", fontsize=8.5)
    axes.tick_params(axis="y", length=0, labelcolor=INK)
    axes.set(xlim=(-BEFORE, (end - zero) / period), ylim=(-0.35, len(shown) - 0.1))
    axes.set_xlabel("clock cycles after the last beat was accepted")
    axes.spines["left"].set_visible(False)
    axes.grid(True, axis="x")
    axes.grid(False, axis="y")
    return png(drawn)


def _segments(trace: Trace, begin: int, end: int) -> list[tuple[int, int, int | None]]:
    """(from, to, value) over the window."""
    inside = [t for t in trace.times if begin < t < end]
    edges = [begin, *inside, end]
    return [(a, b, trace.at(a)) for a, b in pairwise(edges)]


def _draw_bit(axes: Any, trace: Trace, level: float, begin: int, end: int, zero: int, period: int) -> None:
    xs: list[float] = []
    ys: list[float] = []
    for start, stop, value in _segments(trace, begin, end):
        height = level + (0.0 if value == 0 else 0.6 if value == 1 else 0.3)
        xs += [(start - zero) / period, (stop - zero) / period]
        ys += [height, height]
        if value == 1 and trace.label != "clk":
            axes.fill_between(xs[-2:], level, height, color=trace.colour, alpha=0.13, linewidth=0)
    axes.plot(xs, ys, color=trace.colour, linewidth=0.6 if trace.label == "clk" else 1.2)


def _draw_bus(axes: Any, trace: Trace, level: float, begin: int, end: int, zero: int, period: int) -> None:
    for start, stop, value in _segments(trace, begin, end):
        left, right = (start - zero) / period, (stop - zero) / period
        slant = min(0.5, (right - left) / 4)
        xs = [left, left + slant, right - slant, right, right - slant, left + slant]
        ys = [level + y for y in (0.3, 0.6, 0.6, 0.3, 0.0, 0.0)]
        axes.fill(xs, ys, facecolor="#f1f3f5", edgecolor=trace.colour, linewidth=1.0)
        name = "?" if value is None else STATE_NAMES.get(value, str(value))
        if right - left > 0.9 * len(name):
            middle = ((left + right) / 2, level + 0.29)
            axes.text(*middle, name, ha="center", va="center", fontsize=8.5, clip_on=True)


def _caption(traces: dict[str, Trace]) -> str:
    absent = [label for label, _, _ in ROWS if label not in traces]
    text = (
        "One frame through the RTL, drawn from the simulation's waveform file: the stream's last beats, the "
        "state by name, and when each result is there (bold: cycles after the last beat)."
    )
    return text + (f" Not in the file: {', '.join(absent)}." if absent else "")
