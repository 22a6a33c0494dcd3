# SPDX-License-Identifier: Apache-2.0
"""Timing diagrams: docs/wavedrom/*.json5 to docs/images/wave_*.svg, without a network.

python scripts/wavedrom_svg.py
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SOURCES = ROOT / "docs/wavedrom"
IMAGES = ROOT / "docs/images"
FONT = "DejaVu Sans, Verdana, sans-serif"


def target(source: Path) -> Path:
    """Where the picture of a source lies."""
    return IMAGES / f"wave_{source.stem}.svg"


def used_only(svg: str) -> str:
    """Without the wave shapes and text styles that the picture does not use: nine tenths of it."""
    head, body = svg.split("</defs>", 1)
    shapes = set(re.findall(r'xlink:href="#([^"]+)"', body)) | set(re.findall(r"url\(#([^)]+)\)", body))
    start, *definitions = re.split(r'(?=<g id=")', head.partition("<defs>")[2])
    kept = [
        text for text in definitions if (found := re.match(r'<g id="([^"]+)"', text)) and found[1] in shapes
    ]
    # markers of arrows stand before the shapes, or after the last one
    opening = head.partition("<defs>")[0] + "<defs>" + start
    svg = f"{opening}{''.join(kept)}</defs>{body}"
    classes = set(re.findall(r'class="([^"]+)"', svg))

    def style(found: re.Match[str]) -> str:
        rules = re.findall(r"([^{}]+)\{([^}]*)\}", found[1])
        wanted = [
            (name.strip(), re.sub(r"\s*([:;,])\s*", r"\1", rule).strip())
            for name, rule in rules
            if not name.strip().startswith(".") or name.strip()[1:] in classes
        ]
        return "<style>" + "".join(f"{name}{{{rule}}}" for name, rule in wanted) + "</style>"

    return re.sub(r"<style[^>]*><!\[CDATA\[(.*?)\]\]></style>", style, svg, flags=re.DOTALL)


def render(source: Path) -> str:
    """The picture, on white, so that it can be read on a dark page too."""
    import wavedrom

    svg = used_only(wavedrom.render(source.read_text(encoding="utf-8")).tostring())
    svg = svg.replace("Helvetica", FONT).replace("font-size:11pt", "font-size:9pt")
    # the grid of clocks would hide behind a background that comes later
    svg = re.sub(r"(</style>)", r'\1<rect width="100%" height="100%" fill="#fff"/>', svg, count=1)
    return re.sub(r"(</g>)(?=<g )", "\\1\n", svg) + "\n"


def main() -> int:
    """Write what has changed."""
    for source in sorted(SOURCES.glob("*.json5")):
        text, file = render(source), target(source)
        if not file.is_file() or file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")
            print(f"{file.relative_to(ROOT)} written, {len(text)} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
