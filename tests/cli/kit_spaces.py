"""Writes the files of kit_spaces.sh: meshes, height maps and a model whose shapes are known."""
import math
import struct
import sys
import zlib

folder = sys.argv[1]


def write(name, text):
    with open(f"{folder}/{name}", "w", encoding="ascii") as out:
        out.write(text)


def box(size, at=(0, 0, 0), first=1, outwards=True):
    """A box as lines of an OBJ file."""
    corners = [(at[0] + (i & 1) * size[0], at[1] + (i >> 1 & 1) * size[1], at[2] + (i >> 2) * size[2]) for i in range(8)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    lines += ["f " + " ".join(str(first + c) for c in (f if outwards else reversed(f))) for f in faces]
    return "\n".join(lines) + "\n"


def ball(n):
    """A ball of many faces, of radius 1."""
    places, faces = [(0, 0, -1)], []
    for i in range(1, n):
        for j in range(2 * n):
            a, b = math.pi * i / n, math.pi * j / n
            places.append((math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), -math.cos(a)))
    places.append((0, 0, 1))
    ring = lambda i, j: 1 + (i - 1) * 2 * n + j % (2 * n)
    for j in range(2 * n):
        faces.append((0, ring(1, j + 1), ring(1, j)))
        faces.append((len(places) - 1, ring(n - 1, j), ring(n - 1, j + 1)))
        for i in range(1, n - 1):
            faces.append((ring(i, j), ring(i, j + 1), ring(i + 1, j + 1), ring(i + 1, j)))
    return "".join(f"v {x} {y} {z}\n" for x, y, z in places) + "".join(
        "f " + " ".join(str(1 + c) for c in face) + "\n" for face in faces)


write("cube.obj", box((20, 20, 20)))
write("inside_out.obj", box((20, 20, 20), outwards=False))
write("long.obj", box((10, 5, 20)))
write("crossing.obj", box((8, 8, 4), (0, 0, 0)) + box((8, 8, 6), (4, 0, 2), 9))
write("ball.obj", ball(100))
write("flat.pgm", "P2\n# half as high\n3 2\n10\n" + "5 " * 6 + "\n")
steps = [[500] * 200 + [1000] * 200]
write("steps.pgm", "P2 400 1 1000 " + " ".join(map(str, steps[0])) + "\n")
write("two.ldr", "0 two\n1 4 0 -24 0 1 0 0 0 1 0 0 0 1 3003.dat\n0 STEP\n1 14 0 -48 0 1 0 0 0 1 0 0 0 1 3001.dat\n")


def png(name, width, rows, kind, depth, palette=b"", cut=None):
    """A PNG picture; rows are bytes of samples."""
    def chunk(what, data):
        return struct.pack(">I", len(data)) + what + data + struct.pack(">I", zlib.crc32(what + data))

    text = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(rows), depth, kind, 0, 0, 0))
    text += (chunk(b"PLTE", palette) if palette else b"") + chunk(b"IDAT", zlib.compress(b"".join(b"\0" + r for r in rows))) + chunk(b"IEND", b"")
    with open(f"{folder}/{name}", "wb") as out:
        out.write(text[:cut])


HILL = [[0, 40, 90, 200, 255, 13], [7, 99, 180, 230, 120, 60], [255, 254, 128, 127, 3, 0], [30, 60, 90, 120, 150, 180]]
write("grey.pgm", "P2 6 4 255\n" + "\n".join(" ".join(map(str, row)) for row in HILL) + "\n")
png("grey.png", 6, [bytes(row) for row in HILL], 0, 8)
png("rgb.png", 6, [bytes(v for v in row for _ in range(3)) for row in HILL], 2, 8)
png("deep.png", 6, [bytes(v for v in row for _ in range(2)) for row in HILL], 0, 16)
png("deep_rgb.png", 6, [bytes(v for v in row for _ in range(6)) for row in HILL], 2, 16)
png("clear.png", 6, [bytes(b for v in row for b in (255, 255, 255, v)) for row in HILL], 6, 8)
levels = sorted({v for row in HILL for v in row})
png("palette.png", 6, [bytes(levels.index(v) for v in row) for row in HILL], 3, 8, bytes(v for v in levels for _ in range(3)))
png("green.png", 2, [bytes((0, 255, 0, 255, 0, 0))] * 2, 2, 8)
write("luminance.pgm", "P2 2 2 10000\n7152 2126\n7152 2126\n")
png("short.png", 6, [bytes(row) for row in HILL], 0, 8, cut=-30)
png("bare.png", 6, [bytes(row) for row in HILL], 0, 8, cut=20)
png("vast.png", 30000, [b""] * 30000, 0, 8)
png("long.png", 70000, [b""], 0, 8)
png("wrong.png", 6, [bytes(3)] * 4, 0, 8)
