"""Works out the terms of goals from a mesh file by their definitions (docs/growth.md): terms.py TARGET.obj STATS.json ...

Nothing is shared with the engine: areas and volumes are summed over triangles, angles are arc cosines, light is a matter of rays, and the
distance to a mesh is that of the nearest of all points of its triangles.
"""
import json
import math
import random
import sys


def read(path):
    vertices, faces = [], []
    with open(path) as lines:
        for line in lines:
            words = line.split()
            if words[:1] == ["v"]:
                vertices.append(tuple(map(float, words[1:4])))
            elif words[:1] == ["f"]:
                faces.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return vertices, faces


def sub(a, b): return (a[0] - b[0], a[1] - b[1], a[2] - b[2])
def add(a, b): return (a[0] + b[0], a[1] + b[1], a[2] + b[2])
def scale(a, f): return (a[0] * f, a[1] * f, a[2] * f)
def dot(a, b): return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
def cross(a, b): return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
def norm(a): return math.sqrt(dot(a, a))


def middle(points):
    return scale((sum(p[0] for p in points), sum(p[1] for p in points), sum(p[2] for p in points)), 1 / len(points))


def fan(points):
    m = middle(points)
    return [(m, a, b) for a, b in zip(points, points[1:] + points[:1])]


def normal_of(points):
    total = (0, 0, 0)
    for a, b, c in fan(points):
        total = add(total, cross(sub(b, a), sub(c, a)))
    return total


def off_plane(points):
    """The largest distance of a corner from the face's plane, over its size: twice the largest distance of a corner from the middle."""
    m, n = middle(points), normal_of(points)
    reach = max(norm(sub(p, m)) for p in points)
    return max(abs(dot(sub(p, m), n)) for p in points) / norm(n) / (2 * reach) if len(points) > 3 and norm(n) and reach else 0


def angle(at, one, other):
    u, v = sub(one, at), sub(other, at)
    return math.degrees(math.acos(max(-1, min(1, dot(u, v) / (norm(u) * norm(v))))))


def span(vertices):
    low, high = min(v[2] for v in vertices), max(v[2] for v in vertices)
    ground = [v for v in vertices if v[2] <= low + (high - low) / 100]
    return max(min(math.hypot(v[0] - g[0], v[1] - g[1]) for g in ground) for v in vertices)


def to_segment(p, a, b):
    along = sub(b, a)
    t = max(0, min(1, dot(sub(p, a), along) / dot(along, along)))
    return norm(sub(p, add(a, scale(along, t))))


def to_triangle(p, a, b, c):
    n = cross(sub(b, a), sub(c, a))
    foot = sub(p, scale(n, dot(sub(p, a), n) / dot(n, n)))
    if all(dot(cross(sub(j, i), sub(foot, i)), n) >= 0 for i, j in ((a, b), (b, c), (c, a))):
        return norm(sub(p, foot))
    return min(to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a))


def hits(p, towards, a, b, c):
    u, v = sub(b, a), sub(c, a)
    h = cross(towards, v)
    det = dot(u, h)
    if abs(det) < 1e-12:
        return False
    s = sub(p, a)
    q = cross(s, u)
    x, y, t = dot(s, h) / det, dot(towards, q) / det, dot(v, q) / det
    return x >= 0 and y >= 0 and x + y <= 1 and t > 1e-7


def sunlit(faces, towards, draw, rays=400):
    triangles = [t for face in faces for t in fan(face)]
    areas = [norm(cross(sub(b, a), sub(c, a))) for a, b, c in triangles]
    lit = 0
    for a, b, c in draw.choices(triangles, areas, k=rays):
        u, v = sorted((draw.random(), draw.random()))
        p = add(add(scale(a, u), scale(b, v - u)), scale(c, 1 - v))
        lit += not any(hits(p, towards, *t) for t in triangles)
    return lit / rays


def terms(path, target):
    vertices, indices = read(path)
    faces = [[vertices[i] for i in face] for face in indices]
    low = [min(v[k] for v in vertices) for k in range(3)]
    high = [max(v[k] for v in vertices) for k in range(3)]
    edges = {tuple(sorted(e)) for face in indices for e in zip(face, face[1:] + face[:1])}
    lengths = [norm(sub(vertices[a], vertices[b])) for a, b in edges]
    mean = sum(lengths) / len(lengths)
    spread = math.sqrt(sum((x - mean) ** 2 for x in lengths) / len(lengths)) / mean
    planarity = [off_plane(face) for face in faces]
    volume = sum(cross(sub(b, a), sub(c, a))[2] / 2 * ((a[2] + b[2] + c[2]) / 3 - low[2]) for f in faces for a, b, c in fan(f))
    hull, hull_faces = target
    distances = [min(to_triangle(v, *(hull[i] for i in f)) for f in hull_faces) for v in vertices]
    return {
        "size": high[0] - low[0] + high[1] - low[1],
        "undulation": high[2] - low[2],
        "smoothness": sum(abs(vertices[a][2] - vertices[b][2]) for a, b in edges),
        "subdivisions": len(vertices) / len(edges),
        "width": high[0] - low[0],
        "depth": high[1] - low[1],
        "height": high[2] - low[2],
        "area": sum(norm(normal_of(f)) / 2 for f in faces),
        "volume": abs(volume),
        "planarity": sum(planarity) / len(planarity),
        "worst-planarity": max(planarity),
        "edge-spread": spread,
        "smallest-angle": min(angle(f[i], f[i - 1], f[(i + 1) % len(f)]) for f in faces for i in range(len(f))),
        "span": span(vertices),
        "distance-to": sum(distances) / len(distances),
        "sunlit": sunlit(faces, (1, -0.5, 0.4), random.Random(len(vertices))),
    }


def main():
    target, failed, bent = read(sys.argv[1]), 0, 0
    for path in sys.argv[2:]:
        with open(path) as source:
            last = json.load(source)[-1]
        said = {**last["fitness"], **last["measures"]}
        for name, own in terms(path.replace(".json", ".obj"), target).items():
            near = 0.08 if name == "sunlit" else 1e-6 * max(1, abs(own))
            bent += name == "planarity" and own > 1e-3
            if abs(said[name] - own) > near:
                print(f"terms: {path}: {name} is {said[name]!r}, by its definition {own!r}", file=sys.stderr)
                failed += 1
    if bent < 3:
        print("terms: too few surfaces are bent for this to test anything", file=sys.stderr)
        failed += 1
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
