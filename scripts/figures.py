# SPDX-License-Identifier: Apache-2.0
"""Block diagrams and state machines of the data sheets, as SVG into docs/images.

python scripts/figures.py
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from html import escape
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
IMAGES = ROOT / "docs/images"

INK, EDGE, FAINT = "#222", "#546e7a", "#607d8b"
FILL = {"data": "#e3f2fd", "bus": "#fff8e1", "trust": "#fce4ec", "state": "#e8f5e9", "none": "#fff"}
FONT = "DejaVu Sans, Verdana, sans-serif"
HEAD = 7  # length of an arrow's head

Point = tuple[float, float]


@dataclass
class Drawing:
    """Boxes, arrows and words on white; coordinates in pixels, y downwards."""

    width: int
    height: int
    title: str
    parts: list[str] = field(default_factory=list)

    def text(
        self, x: float, y: float, words: str, size: float = 11, anchor: str = "middle", bold: bool = False
    ) -> None:
        """Words around, from or up to a place."""
        weight = ' font-weight="bold"' if bold else ""
        colour = INK if size >= 12 or bold else FAINT
        self.parts.append(
            f'<text x="{x:g}" y="{y:g}" font-size="{size:g}" text-anchor="{anchor}" fill="{colour}"{weight}>'
            f"{escape(words)}</text>"
        )

    def box(
        self, x: float, y: float, w: float, h: float, name: str, words: Sequence[str] = (), kind: str = "data"
    ) -> None:
        """A module: its name, and lines of what it does."""
        self.parts.append(
            f'<rect x="{x:g}" y="{y:g}" width="{w:g}" height="{h:g}" '
            f'rx="{h / 2 if kind == "state" else 5:g}" fill="{FILL[kind]}" stroke="{EDGE}"/>'
        )
        lines = 1 + len(words)
        top = y + h / 2 - 7 * (lines - 1) + 4
        self.text(x + w / 2, top, name, 12, bold=True)
        for number, line in enumerate(words, 1):
            self.text(x + w / 2, top + 14 * number, line)

    def line(self, *points: Point, dashed: bool = True) -> None:
        """Straight from point to point."""
        path = "M" + " L".join(f"{x:g},{y:g}" for x, y in points)
        style = ' stroke-dasharray="4 3"' if dashed else ""
        self.parts.append(f'<path d="{path}" fill="none" stroke="{INK}"{style}/>')

    def arrow(self, *points: Point, both: bool = False, dashed: bool = False) -> None:
        """A line with a head at its end, or at both ends."""
        self.line(*points, dashed=dashed)
        ends = [(points[-2], points[-1])] + ([(points[1], points[0])] if both else [])
        for (x0, y0), (x1, y1) in ends:
            length = max(abs(x1 - x0), abs(y1 - y0), 1e-9)
            dx, dy = HEAD * (x1 - x0) / length, HEAD * (y1 - y0) / length
            corner = [(x1, y1), (x1 - dx - dy / 2, y1 - dy + dx / 2), (x1 - dx + dy / 2, y1 - dy - dx / 2)]
            shape = " ".join(f"{x:g},{y:g}" for x, y in corner)
            self.parts.append(f'<polygon points="{shape}" fill="{INK}"/>')

    def svg(self) -> str:
        """The file."""
        return "\n".join(
            [
                f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {self.height}" '
                f'width="{self.width}" height="{self.height}" font-family="{FONT}">',
                f"<title>{escape(self.title)}</title>",
                '<rect width="100%" height="100%" fill="#fff"/>',
                *self.parts,
                "</svg>\n",
            ]
        )


def frame(core: str, top: str) -> Drawing:
    """What both cores have: buses, loader, result memory, registers, states; the middle is free."""
    d = Drawing(1000, 372, f"Block diagram of {top}")
    d.parts.append(
        f'<rect x="86" y="14" width="836" height="344" rx="8" fill="none" stroke="{FAINT}" '
        'stroke-dasharray="6 4"/>'
    )
    d.text(98, 32, top, 13, "start", bold=True)
    for x, kind, words in (
        (560, "bus", "bus"),
        (620, "data", "data path"),
        (712, "trust", "states and protections"),
    ):
        d.parts.append(f'<rect x="{x}" y="22" width="12" height="12" fill="{FILL[kind]}" stroke="{EDGE}"/>')
        d.text(x + 18, 32, words, 11, "start")
    d.box(106, 116, 118, 76, "frame_loader", ("stream or push", "frames, weights"), "bus")
    d.box(660, 116, 102, 76, "result_store", ("2 banks,", "compares twice"), "bus")
    d.box(780, 116, 130, 76, f"{core}_registers", ("AXI4-Lite",), "bus")
    d.arrow((10, 154), (106, 154))
    d.text(12, 132, "s_axis_*", 11, "start")
    d.text(12, 146, "64 bits", 11, "start")
    d.arrow((910, 140), (988, 140), both=True)
    d.text(988, 118, "s_axil_*", 11, "end")
    d.text(988, 132, "32 bits", 11, "end")
    d.arrow((910, 172), (988, 172))
    d.text(988, 187, "irq", 11, "end")
    d.arrow((762, 154), (780, 154))
    d.arrow((845, 116), (845, 54), (165, 54), (165, 116))
    d.text(505, 48, "pushed beats, configuration")
    d.box(
        106,
        288,
        656,
        54,
        "frame_state",
        ("IDLE, loading, COMPUTE, VERIFY, DONE; watchdog, cycle counters",),
        "trust",
    )
    d.box(
        786,
        280,
        128,
        70,
        "core_upsets",
        ("votes, twins, parity,", "residue, second pass", "-> UPSET"),
        "trust",
    )
    d.arrow((786, 315), (762, 315))
    d.arrow((845, 192), (845, 240), (700, 240), (700, 288), both=True)
    d.text(776, 234, "status, soft reset")
    d.arrow((165, 192), (165, 288), both=True)
    return d


def oltae() -> str:
    """Block diagram of oltae_top."""
    d = frame("oltae", "oltae_top")
    d.box(246, 116, 116, 76, "gram_array", ("7 systolic lanes", "28 exact sums"))
    d.box(384, 100, 118, 108, "moment_stream", ("centring, exact", "butterfly", "normaliser:", "35 bits"))
    d.box(524, 116, 114, 76, "solve_engine", ("4 lanes, program", "reciprocal"))
    for x0, x1 in ((224, 246), (362, 384), (502, 524), (638, 660)):
        d.arrow((x0, 154), (x1, 154))
    d.box(246, 222, 116, 48, "moment_check", ("mod 65537",), "trust")
    d.arrow((304, 192), (304, 222))
    d.box(384, 222, 118, 48, "value_feeder", ("W, m, n",))
    d.arrow((443, 222), (443, 208))
    d.arrow((362, 180), (373, 180), (373, 246), (384, 246))
    d.arrow((581, 116), (581, 78), (304, 78), (304, 116))
    d.text(443, 72, "redrain: low limbs, second pass")
    d.arrow((581, 192), (581, 288), both=True)
    return d.svg()


def ivisnav() -> str:
    """Block diagram of ivisnav_top."""
    d = frame("ivisnav", "ivisnav_top")
    d.box(246, 100, 132, 108, "gram_ring", ("operand ring of", "7 lanes", "28 exact sums", "range_bits"))
    d.box(
        420,
        100,
        200,
        108,
        "rates_engine",
        ("rates_program, 6 rates_lane", "float_divide", "residual_unit: exact b - A x", "rates_monitor"),
    )
    for x0, x1 in ((224, 246), (378, 420), (620, 660)):
        d.arrow((x0, 154), (x1, 154))
    d.box(246, 226, 132, 48, "moment_check", ("mod 65537",), "trust")
    d.arrow((312, 208), (312, 226))
    d.box(420, 226, 94, 48, "frame_scale", ("powers of 2",))
    d.box(526, 226, 94, 48, "output_scale", ("binary32",))
    d.arrow((467, 226), (467, 208), both=True)
    d.arrow((573, 208), (573, 226), both=True)
    d.arrow((520, 100), (520, 78), (312, 78), (312, 100))
    d.text(416, 72, "redrain: second pass")
    d.arrow((520, 208), (520, 288), both=True)
    return d.svg()


def states(loading: str, refusals: str) -> str:
    """State machine of both cores; the second state has two names."""
    d = Drawing(960, 250, "State machine")
    y, h, w = 96, 44, 106
    xs = [20, 216, 412, 608, 804]
    names = ("IDLE", loading, "COMPUTE", "VERIFY", "DONE")
    for x, name, code in zip(xs, names, (0, 1, 2, 4, 3), strict=True):
        d.box(x, y, w, h, name, kind="state")
        d.text(x + w / 2, y + h + 13, f"STATE = {code}", 10)
    for x, words in zip(xs[:-1], ("first beat", "last beat", "all results", "the same again"), strict=True):
        d.arrow((x + w, y + h / 2), (x + 196, y + h / 2))
        d.text(x + w + 45, y + h / 2 - 7, words, 10)
    d.arrow((857, y), (857, 26), (73, 26), (73, y))
    d.text(465, 20, "ACKNOWLEDGE", 10)
    d.arrow((830, y), (830, 58), (269, 58), (269, y))
    d.text(550, 52, "first beat of the next frame", 10)
    # the ways back to IDLE
    bottom, low = y + h + 18, 200
    d.arrow((661, bottom), (661, low), (60, low), (60, bottom), dashed=True)
    for x, words in ((269, "bad frame"), (465, refusals), (661, "a difference: UPSET")):
        if x < 661:
            d.line((x, bottom), (x, low))
        d.text(x + 5, low - 8, words, 10, "start")
    d.text(
        60,
        low + 18,
        "dashed: no results, flags say why; soft reset, watchdog and an upset lead here from anywhere",
        10,
        "start",
    )
    return d.svg()


FIGURES: dict[str, Callable[[], str]] = {
    "block_oltae": oltae,
    "block_ivisnav": ivisnav,
    "states_oltae": partial(states, "LOAD", "rank-deficient"),
    "states_ivisnav": partial(states, "SEND_DATA", "no solution"),
}


def main() -> int:
    """Write what has changed."""
    for name, draw in FIGURES.items():
        file, text = IMAGES / f"{name}.svg", draw()
        if not file.is_file() or file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")
            print(f"{file.relative_to(ROOT)} written, {len(text)} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
