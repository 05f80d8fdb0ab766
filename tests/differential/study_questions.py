"""Every question about a study of growth against every other: its measures worked out of its mesh, its goals out of its measures."""
import functools
import math
import os
import sys

from file_questions import keeps_its_meaning, loads, says_json
from growth_questions import SystemSubject, by_reference, formats, meat, meshes, of_module, read_obj, same_bytes
from program import Wrong, same
from study_reader import Study, value_of

TESTS = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
NAMES = {"V": "vertices", "E": "edges", "F": "faces", "soft_boundary_nodes": "soft-boundary"}


class StudySubject(SystemSubject):
    limits = []

    @functools.cached_property
    def study(self):
        return Study(self.text)

    @property
    def rules(self):
        with open(os.path.join(self.folder, "a.hemls"), encoding="utf-8") as file:
            return file.read()

    @property
    def forces(self):
        """The last gravity counts."""
        gravities = [force for force in self.study.forces if force[0] == "gravity"]
        return [force for force in self.study.forces if force[0] != "gravity"] + gravities[-1:]

    def options_of_reference(self):
        """KeyError where the reference knows less."""
        study, oracle = self.study, sys.modules["ref"]
        settings, modes = study.settings, {wall[-1] for wall in study.walls}
        if "use" in settings or any(wall[0] == "mesh" for wall in study.walls) or len(modes) > 1 or any(f[0] != "gravity" and f[3] == 0 for f in study.forces):
            raise KeyError("use")
        forces = {"attractor": oracle.Attractor, "repeller": oracle.Repeller, "gravity": oracle.Gravity}
        walls = {"plane": lambda w: oracle.Plane(w[1], w[2]), "sphere": lambda w: oracle.Sphere(w[1], w[2], w[3]), "box": lambda w: oracle.Box(w[1], w[2], w[3])}
        scale = settings.get("scale", [1.5] * 3)
        if len(set(scale)) > 1 or len(study.walls) > 1 or any(wall[0] == "plane" and wall[3] for wall in study.walls):
            raise KeyError("scale")
        return {"scale": scale[0], "start": settings.get("start", [0.0] * 3), "start_length": settings.get("start-length", 1.0), "seed": int(settings.get("seed", 1)),
                "fixed_center": "fixed-centre" in study.flags, "fixed_perimeter": "fixed-perimeter" in study.flags, "facing": "facing" in study.flags,
                "mirror": "mirror" in study.flags, "branch_angle": settings.get("branch-angle"), "branch_length": settings.get("branch-length", -1.0),
                "env": [forces[f[0]](*f[1:]) for f in self.forces], "walls": [walls[w[0]](w) for w in study.walls], "wall_mode": (modes or {"slide"}).pop()}


@functools.lru_cache(maxsize=1)
def terms():
    sys.path.insert(0, TESTS)
    return __import__("terms")


def measures_of(stats):
    found = {**stats["fitness"], **stats["measures"], **{name: stats[name] for name in "VEF"}}
    return {NAMES.get(name, name): value for name, value in found.items()}


# ---- measures and goals

def measured(subject):
    """Measures are those of the mesh, by their definitions."""
    for stats, vertices, _, faces in subject.steps:
        said, known = measures_of(stats), terms()
        goals = {name for name, *_ in subject.study.goals}
        if not faces:
            continue
        points = [[vertices[i] for i in face] for face in faces]
        low, high = ([end(v[k] for v in vertices) for k in range(3)] for end in (min, max))
        size = max(high[k] - low[k] for k in range(3))
        if not size < 1e6:
            return
        ways = {tuple(sorted(e)) for face in faces for e in zip(face, face[1:] + face[:1])}
        lengths = [math.dist(vertices[a], vertices[b]) for a, b in ways]
        mean = sum(lengths) / len(lengths)
        own = {"size": high[0] - low[0] + high[1] - low[1], "undulation": high[2] - low[2], "width": high[0] - low[0], "depth": high[1] - low[1],
               "height": high[2] - low[2], "smoothness": sum(abs(vertices[a][2] - vertices[b][2]) for a, b in ways), "subdivisions": len(vertices) / len(ways),
               "area": sum(known.norm(known.normal_of(p)) / 2 for p in points), "span": known.span(vertices)}
        if mean > 1e-9 * size:
            own["edge-spread"] = math.sqrt(sum((x - mean) ** 2 for x in lengths) / len(lengths)) / mean
        if stats["E"] == len(ways):
            for name, want in own.items():
                if name in said and name not in goals and not near_edge(name, vertices, low, high) and not abs(said[name] - want) <= 1e-6 * max(1, abs(want)):
                    raise Wrong(f"{name} of step {stats['step']}", said[name], want)


def near_edge(name, vertices, low, high):
    """Of the term `span`, does rounding decide which vertices are on the ground?"""
    edge = low[2] + (high[2] - low[2]) / 100
    return name == "span" and any(abs(v[2] - edge) < 1e-9 * max(1, high[2] - low[2]) for v in vertices)


def goals(subject):
    """A goal has the value of its expression; nothing is lacking where what is required holds, and only then."""
    study = subject.study
    if "use" in study.settings:
        return
    for stats, *_ in subject.steps:
        known = {name: value for name, value in measures_of(stats).items() if name not in {n for n, e, *_ in study.goals if e is not None}}
        for name, expression, *_ in study.goals:
            if expression is None:
                continue
            try:
                want, got = value_of(expression, known), stats["fitness"].get(name, math.nan)
            except KeyError:
                continue
            got = math.nan if got is None else got
            none = got != got and (want != want or math.isinf(want))
            if not none and want != got and not abs(got - want) <= 1e-9 * max(1, abs(want)) and not fragile(expression, known):
                raise Wrong(f"goal {name} of step {stats['step']}", got, want)
        requirements(study, stats, known)


def requirements(study, stats, known):
    if not study.requirements or stats.get("lacking") is None:
        return
    try:
        values = [value_of(expression, known) for expression in study.requirements]
        unsure = any(v != v for v in values) or any(fragile(expression, known) for expression in study.requirements)
    except KeyError:
        return
    if not unsure:
        same(f"nothing is lacking, step {stats['step']}", stats["lacking"] == 0, all(values))


def fragile(expression, terms_):
    """Do digits decide a comparison?"""
    if not isinstance(expression, tuple):
        return False
    if expression[0] in ("<", "<=", "=", "!=", ">=", ">", "in"):
        values = [value_of(part, terms_) for part in expression[1:]]
        if any(a != b and abs(a - b) <= 1e-9 * max(abs(a), abs(b)) for a in values for b in values):
            return True
    return any(fragile(part, terms_) for part in expression[1:])


# ---- the same said otherwise

def by_options(subject):
    """Statements as options of the command, in the same words."""
    if not subject.study.settings.get("rules") or "use" in subject.study.settings or "require" in subject.text or "=" in subject.text:
        return
    options = []
    for word, text in subject.study.statements:
        rest = text[len(word):].strip()
        if word in ("rules", "title"):           # a title is of pictures
            continue
        if word in ("fixed-centre", "fixed-perimeter", "facing", "mirror"):
            options.append("--" + word)
        elif word == "distance-to":
            options += ["--distance-to", os.path.join(subject.folder, rest[1:-1])]
        elif word == "boundary" and "mesh" in text:
            return
        elif word == "fitness" and rest == "raw":
            return
        else:
            options += ["--" + word, rest]
    if len({force[0] for force in subject.study.forces}) > 1:
        return                                   # options of one kind after another: their sums are rounded otherwise
    code, data = subject.grown("--lines", *options, file=os.path.join(subject.folder, "a.hemls"))
    same("grown by options", (code, data and meat(data)), (subject.surface[0], subject.surface[1] and meat(subject.surface[1])))


def in_two_files(subject):
    """Statements that another study has, and this one uses."""
    study = subject.study
    if "use" in study.settings:
        return
    texts = [text for _, text in study.statements]
    half = len(texts) // 2
    first = subject.file("half.study", "\n".join(texts[:half]) + "\n")
    second = subject.file("rest.study", f'use "{os.path.basename(first)}"\n' + "\n".join(texts[half:]) + "\n")
    code, data = subject.grown("--lines", file=second)
    same("grown of two files", (code, data and meat(data)), (subject.surface[0], subject.surface[1] and meat(subject.surface[1])))


def twice_as_large(subject):
    """With all lengths doubled every coordinate is doubled, to the last bit."""
    study = subject.study
    broken = any(f[0] != "gravity" and f[3] != int(f[3]) for f in study.forces)
    if "use" in study.settings or broken or any(w[0] == "mesh" for w in study.walls) or study.goals or study.requirements:
        return
    lines = [text for word, text in study.statements if word not in ("start", "start-length", "gravity", "attractor", "repeller", "boundary", "title")]
    three = lambda v: " ".join(repr(2 * c) for c in v)
    lines += [f"start {three(study.settings.get('start', [0.0] * 3))}", f"start-length {2 * study.settings.get('start-length', 1.0)!r}"]
    for force in study.forces:
        lines.append(f"gravity {three(force[1])}" if force[0] == "gravity" else
                     f"{force[0]} at {three(force[1])} strength {force[2] * 2 ** (force[3] + 1)!r} exponent {force[3]!r}")
    for wall in study.walls:
        shape = {"plane": lambda w: f"plane at {three(w[1])} normal {' '.join(map(repr, w[2]))}", "box": lambda w: f"box from {three(w[1])} to {three(w[2])}",
                 "sphere": lambda w: f"sphere at {three(w[1])} radius {2 * w[2]!r}"}[wall[0]](wall)
        side = "" if wall[0] == "plane" else "inside " if wall[3] else "outside "
        lines.append(f"boundary {shape} {side}{wall[4]}")
    code, data = subject.grown("--lines", file=subject.file("twice.study", "\n".join(lines) + "\n"))
    same("twice as large ends with", code, subject.surface[0])
    if data:
        (vertices, edges, faces), (large, *others) = read_obj(subject.surface[1].decode()), read_obj(data.decode())
        same("edges and faces of twice the size", others, [edges, faces])
        same("corners of twice the size", [(a, b) for a, b in zip(large, vertices) if any(abs(p - 2 * q) > 1e-12 * max(1, abs(p)) for p, q in zip(a, b))][:2], [])


def kept_out(subject):
    """No vertex lies inside of the one boundary that is not soft."""
    walls = subject.study.walls
    if len(walls) != 1 or walls[0][-1] == "soft" or walls[0][0] == "mesh" or not subject.surface[1] or "use" in subject.study.settings:
        return
    kind, first, second, inside, _ = walls[0]
    for vertex in read_obj(subject.surface[1].decode())[0]:
        if kind == "plane":
            room = sum((v - p) * n for v, p, n in zip(vertex, first, second))
        elif kind == "sphere":
            room = (math.dist(vertex, first) - second) * (-1 if inside else 1)
        else:
            into = min(min(v - min(a, b), max(a, b) - v) for v, a, b in zip(vertex, first, second))
            room = into if inside else -into
        if room < -1e-9 * max(1, *map(abs, vertex)):
            raise Wrong(f"a vertex is kept out of a {kind}", f"{vertex}, {room}", "0 or more")


QUICK = [meshes, goals, measured, by_reference]
OF_STUDIES = [loads, keeps_its_meaning, says_json, same_bytes, of_module, formats, by_options, in_two_files, twice_as_large, kept_out]
