"""Checks slices: slices.py FILE.cli LAYERS WALLS

Reads the lines of each layer of a CLI file. All are closed; none crosses itself or another; outer ones run counter-clockwise and those of
holes clockwise, by how many other lines are around them. There are so many layers, and in all so many lines.
"""
import sys


def read(path):
    layers = []
    for line in open(path):
        if line.startswith("$$LAYER/"):
            layers.append((float(line[8:]), []))
        elif line.startswith("$$POLYLINE/"):
            words = line[11:].split(",")
            numbers = [float(word) for word in words[3:]]
            points = list(zip(numbers[0::2], numbers[1::2]))
            assert len(points) == int(words[2]) and points[0] == points[-1], f"a line that is not closed at {points[0]}"
            layers[-1][1].append((int(words[1]), points[:-1]))
    return layers


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def sign(number):
    return (number > 0) - (number < 0)


def cross(a, b, c, d):
    return sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 and sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0


def check_crossings(lines, size):
    cells = {}
    for line, (_, points) in enumerate(lines):
        for i, a in enumerate(points):
            b = points[(i + 1) % len(points)]
            for x in range(int(min(a[0], b[0]) // size), int(max(a[0], b[0]) // size) + 1):
                for y in range(int(min(a[1], b[1]) // size), int(max(a[1], b[1]) // size) + 1):
                    cells.setdefault((x, y), set()).add((line, i))
    for sides in cells.values():
        sides = [(lines[line][1][i], lines[line][1][(i + 1) % len(lines[line][1])]) for line, i in sides]
        for k, (a, b) in enumerate(sides):
            for c, d in sides[:k]:
                assert not cross(a, b, c, d), f"lines cross near {a}"


def inside(point, points):
    count = False
    for i, a in enumerate(points):
        b = points[i - 1]
        if (a[1] > point[1]) != (b[1] > point[1]) and point[0] < (b[0] - a[0]) * (point[1] - a[1]) / (b[1] - a[1]) + a[0]:
            count = not count
    return count


def check_turns(lines):
    for k, (direction, points) in enumerate(lines):
        around = sum(inside(points[0], other) for i, (_, other) in enumerate(lines) if i != k)
        area = sum(points[i - 1][0] * p[1] - points[i - 1][1] * p[0] for i, p in enumerate(points))
        assert (area > 0) == (direction == 1) == (around % 2 == 0), f"a line turns the wrong way at {points[0]}"


layers = read(sys.argv[1])
for height, lines in layers:
    check_crossings(lines, 0.25)
    check_turns(lines)
counts = (len(layers), sum(len(lines) for _, lines in layers))
assert counts == (int(sys.argv[2]), int(sys.argv[3])), f"{counts[0]} layers with {counts[1]} lines"
