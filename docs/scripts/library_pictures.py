"""Pictures of docs/library.md, drawn from what the library's examples have written.

library_pictures.py FOLDER: the folder holds a file NAME.out of each example NAME in native/examples. Called by
`./motus docs library`.
"""

import csv
import struct
import sys
import zlib
from pathlib import Path

PICTURES = Path(__file__).resolve().parents[1] / "pictures"
WIDTH, HEIGHT, MARGIN = 640, 320, 24
COLOURS = ("#1b6ca8", "#d1495b", "#2e8b57", "#edae49", "#7a4fa3", "#555555")


def columns(path):
    """A table as a dictionary: the numbers of each column by its name."""
    with path.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def chart(path, lines, is_to_scale=True):
    """Writes an SVG with lines, each (name, horizontal numbers, vertical numbers); names that are not empty make the legend."""
    across, up = ([value for line in lines for value in line[axis]] for axis in (1, 2))
    left, bottom = min(across), min(up)
    scale_x, scale_y = (WIDTH - 2 * MARGIN) / (max(across) - left), (HEIGHT - 2 * MARGIN) / (max(up) - bottom)
    if is_to_scale:
        scale_x = scale_y = min(scale_x, scale_y)
    parts = []
    named = list(dict.fromkeys(name for name, _, _ in lines if name))
    for name, horizontal, vertical in lines:
        colour = COLOURS[named.index(name) % len(COLOURS)] if name else "#bbbbbb"
        points = " ".join(
            f"{MARGIN + scale_x * (x - left):.1f},{HEIGHT - MARGIN - scale_y * (y - bottom):.1f}" for x, y in zip(horizontal, vertical)
        )
        parts.append(f'<polyline fill="none" stroke="{colour}" stroke-width="{1.6 if name else 0.8}" points="{points}"/>')
    for place, name in enumerate(named):
        colour = COLOURS[place % len(COLOURS)]
        parts.append(f'<text x="{WIDTH - MARGIN}" y="{MARGIN + 16 * place}" text-anchor="end" fill="{colour}">{name}</text>')
    frame = f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="13">'
    background = '<rect width="100%" height="100%" fill="white"/>'
    path.write_text("\n".join((frame, background, *parts, "</svg>")) + "\n", encoding="utf-8")


def camera_on_path(table):
    """The flight from above, each fourth frame with the camera's own X axis, which shortens where the camera banks."""
    lines = []
    for frame in range(0, len(table["x"]), 4):
        w, x, y, z = (table[f"rotation_{axis}"][frame] for axis in "wxyz")
        ends = [
            (table["x"][frame] + 2 * side * (1 - 2 * (y * y + z * z)), table["y"][frame] + 2 * side * 2 * (x * y + w * z))
            for side in (-1, 1)
        ]
        lines.append(("", *zip(*ends)))
    return [*lines, ("camera from above", table["x"], table["y"])]


def reach_and_look(table):
    """The arm from the front, each eighth frame."""
    arms = [
        ("", (0.2, table["elbow_x"][frame], table["hand_x"][frame]), (1.4, table["elbow_z"][frame], table["hand_z"][frame]))
        for frame in range(0, len(table["time"]), 8)
    ]
    return [*arms, *((name, table[f"{name}_x"], table[f"{name}_z"]) for name in ("ball", "elbow", "hand"))]


def double_pendulum(table):
    """The way of both bobs."""
    return [("second bob", table["x2"], table["z2"]), ("first bob", table["x1"], table["z1"])]


def follow_through(table):
    """The signal and what follows it, over time."""
    return [(name, table["time"], table[name]) for name in ("signal", "overshooting", "smooth", "anticipating")]


def hexapod(table):
    """The heights of the feet on one side, over time."""
    return [(f"foot {leg}", table["time"], table[f"z{leg}"]) for leg in (1, 3, 5)]


def write_png(path, picture):
    """Writes a binary PGM of 256 greys as PNG."""
    header, pixels = picture.split(b" 255\n", 1)
    width, height = map(int, header.split()[1:])
    lines = b"".join(b"\0" + pixels[row * width : (row + 1) * width] for row in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b""))


def main(folder):
    """Draws all pictures."""
    for lines_of in (camera_on_path, reach_and_look, double_pendulum, follow_through, hexapod):
        name = lines_of.__name__
        chart(
            PICTURES / f"library_{name}.svg",
            lines_of(columns(folder / f"{name}.out")),
            is_to_scale=lines_of not in {follow_through, hexapod},
        )
    write_png(PICTURES / "library_snowfall.png", (folder / "snowfall.out").read_bytes())


main(Path(sys.argv[1]))
