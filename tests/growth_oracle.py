#!/usr/bin/env python3
"""Holds `tartan grow` to the slow independent reference: growth_oracle.py ORACLES/growth [RANDOM_SYSTEMS]

Every fixture at 1 and 4 threads, and random rewrite systems that are grown in both: counts, labels, ages and every edge the
same, positions and fitness to 1e-7. A random system is followed as long as rounding decides nothing in the reference (a face
without area, a distance on the border of two quanta): there two right answers differ. TARTAN is the binary.
"""
import json, math, os, random, subprocess, sys, tempfile

FOLDER = sys.argv[1]
sys.path.insert(0, FOLDER)
import ref

TARTAN = os.environ["TARTAN"]
SCRATCH = tempfile.mkdtemp()


def study(options, steps):
    """Options of the reference as a study."""
    o = ref.Options(**{k: v for k, v in options.items() if k not in ("env", "walls")})
    lines = ['rules "rules.hemls"', "steps %d" % steps, "scale " + " ".join("%.17g" % (o.scale * a) for a in o.axis_scale),
             "start " + " ".join("%.17g" % x for x in o.start), "start-length %.17g" % o.start_length, "seed %d" % o.seed]
    lines += [name for flag, name in ((o.fixed_center, "fixed-centre"), (o.fixed_perimeter, "fixed-perimeter"), (o.facing, "facing"),
                                      (o.mirror, "mirror")) if flag]
    if o.branch_angle is not None:
        lines.append("branch-angle %.17g" % o.branch_angle)
    if o.branch_length >= 0:
        lines.append("branch-length %.17g" % o.branch_length)
    three = lambda v: " ".join("%.17g" % x for x in v)
    for e in options.get("env", []):
        lines.append("gravity " + three(e[1]) if e[0] == "gravity" else
                     "%s at %s strength %.17g exponent %.17g" % (e[0], three(e[1]), e[2], e[3]))
    for w in options.get("walls", []):
        shape = {"plane": lambda: "plane at %s normal %s" % (three(w[1]), three(w[2])),
                 "box": lambda: "box from %s to %s" % (three(w[1]), three(w[2])),
                 "sphere": lambda: "sphere at %s radius %.17g" % (three(w[1]), w[2])}[w[0]]()
        if len(w) > 3 and w[0] != "plane":
            shape += " inside" if w[3] else " outside"
        lines.append("boundary %s %s" % (shape, o.wall_mode))
    return "\n".join(lines) + "\n"


def grow(text, options, steps, threads):
    """Per step: (statistics, vertices, edges)."""
    path = os.path.join(SCRATCH, "s.study")
    open(os.path.join(SCRATCH, "rules.hemls"), "w").write(text + "\n")
    open(path, "w").write(study(options, steps))
    done = subprocess.run([TARTAN, "grow", path, "--stats", "json", "--threads", str(threads), "--each-step", "--lines", "-o",
                           os.path.join(SCRATCH, "s.obj")], capture_output=True, text=True)
    if done.returncode not in (0, 4):
        raise SystemExit("%s\n%s\n%s" % (text, study(options, steps), done.stderr))
    stats, out = json.loads(done.stdout), []
    for k, s in enumerate(stats):
        vertices, lines, faces = [], [], []
        for line in open(os.path.join(SCRATCH, "s-%03d.obj" % k)):
            word, *rest = line.split()
            if word == "v":
                vertices.append([float(x) for x in rest])
            elif word in "lf":
                (lines if word == "l" else faces).append([int(x) - 1 for x in rest])
        check_mesh(vertices, lines, faces)
        out.append((s, vertices, lines))
    return out


def check_mesh(vertices, lines, faces):
    """Closed loops, one orientation, Euler's number of a disc."""
    darts = set()
    for f in faces:
        assert len(f) >= 3
        for a, b in zip(f, f[1:] + f[:1]):
            assert (a, b) not in darts, "an edge is used twice in one direction"
            darts.add((a, b))
    edges = {frozenset(l) for l in lines}
    assert edges >= {frozenset(d) for d in darts}
    assert len(vertices) - len(lines) + len(faces) == 1


def near(a, b, scale):
    return all(abs(x - y) <= 1e-7 * scale for p, q in zip(a, b) for x, y in zip(p, q))


def fixtures():
    bad = 0
    for f in json.load(open(os.path.join(FOLDER, "fixtures.json")))["fixtures"]:
        for threads in (1, 4):
            what = None
            for k, (s, vertices, lines) in enumerate(grow(f["text"], f["options"], f["steps"], threads)):
                e = f["expect"][k]
                for ours, theirs in (("V", "V"), ("E", "E"), ("F", "F"), ("labels", "labels"), ("ages", "label_age"), ("face_sides", "face_sides")):
                    if s[ours] != e[theirs]:
                        what = what or "step %d: %s %s instead of %s" % (k, ours, s[ours], e[theirs])
                for term, value in s["fitness"].items():
                    if abs(value - e["fitness"][term]) > 1e-7 * max(1, abs(e["fitness"][term])):
                        what = what or "step %d: %s is %r instead of %r" % (k, term, value, e["fitness"][term])
                if "edges" in e and lines != [x[:2] for x in e["edges"]]:
                    what = what or "step %d: other edges" % k
                if "positions" in e and not near(vertices, e["positions"], max(1, max(abs(c) for p in e["positions"] for c in p))):
                    what = what or "step %d: other positions" % k
            if what:
                bad += 1
                print("%s, %d threads: %s" % (f["name"], threads, what))
    return bad




class Fragile(Exception):
    pass


class Careful(ref.Growth):
    """Stops where rounding would decide."""

    def normals(self):
        for o in self.interior_faces():
            P = [self.pos[self.dv[d]] for d in o]
            n, span = (0.0, 0.0, 0.0), 0
            for i in range(len(P)):
                a, b = ref.sub(P[i], P[0]), ref.sub(P[(i + 1) % len(P)], P[0])
                n, span = ref.add(n, ref.cross(a, b)), span + ref.dot(a, a)
            if ref.norm(n) < 1e-9 * span:
                raise Fragile
        return super().normals()

    def frame(self, d0, d1, N):
        H, L, U, length = super().frame(d0, d1, N)
        up = (0.0, 0.0, 0.0)
        for f in (self.df[d0], self.df[d1]):
            if f != self.OUTER:
                up = ref.add(up, N[f])
        if length < 1e-9 * self.o.start_length or ref.norm(ref.sub(up, ref.mul(H, ref.dot(up, H)))) < 1e-6:
            raise Fragile
        return H, L, U, length

    def move(self, x, d):
        """Along a boundary, rounding says whether a vertex meets it."""
        to = ref.add(x, d)
        if any(abs(wall.sd(x)) < 1e-9 and abs(wall.sd(to)) < 1e-9 for wall in self.hard_walls()):
            raise Fragile
        return super().move(x, d)

    def compatible(self, p, q):
        if p.label == q.label and self.df[p.dart] == self.df[q.dart] and self.dv[p.dart] != self.dv[q.dart]:
            way = ref.sub(self.pos[self.dv[q.dart]], self.pos[self.dv[p.dart]])
            far, unit = ref.norm(way), self.o.start_length * abs(self.o.scale) ** self.step_no
            quanta = far / unit * 2.0 ** 20
            fragile = abs(ref.dot(p.dir, q.dir) + math.cos(math.radians(self.ba)) - 1e-9) < 1e-10
            fragile |= abs(quanta - math.floor(quanta) - 0.5) < 1e-6
            fragile |= self.o.branch_length >= 0 and abs(far - self.o.branch_length * unit * (1 + 1e-9)) < 1e-11 * unit
            if self.o.facing:
                fragile |= min(abs(ref.dot(p.dir, way) - 1e-9 * far), abs(ref.dot(q.dir, way) + 1e-9 * far)) < 1e-9 * far + 1e-12
            if fragile:
                raise Fragile
        return super().compatible(p, q)


def random_system(R):
    """Labels, ages, weights, conditions, contexts, chains, branches nested and in space, paths that leave the line or the
    plane, `~`, forces; every option that a study has and the reference too."""
    labels, timed = R.randint(1, 4), R.random() < 0.4
    edge = lambda age=True: "Edge%d" % R.randrange(labels) + (R.choice(["", "_i", "_i+1", "_i-1"]) if age and timed else "")
    turn = lambda signs: " ".join(R.choice(signs) * R.randint(1, 3))
    tilde = lambda share: "~ " if R.random() < share else ""
    back = {"+": "-", "-": "+", "&": "^", "^": "&", "\\": "/", "/": "\\"}

    def branches():
        if R.random() < 0.25:
            n = R.randint(1, 3)
            both = [edge(), edge(), " ".join("+" * n), " ".join("-" * n)]
            return R.choice(["[ [ %s %s ] %s %s ]", "[ %s %s ] [ %s %s ]"]) % (both[2], both[0], both[3], both[1])
        if R.random() < 0.15:
            return "[ [ [ + %s ] - %s ] & %s %s ]" % (edge(), edge(), turn("+-"), edge())
        return "[ %s %s%s ]" % (turn("+++---&^\\/"), tilde(0.3), edge())

    def successor():
        out = []
        for j in range(R.randint(1, 4)):
            out += [branches() for _ in range(R.choice([0, 0, 1, 2]))]
            kind, drawn = R.random(), tilde(0.15) + edge()
            if kind < 0.15:
                drawn = "+ %s -" % drawn
            elif kind < 0.25:
                way = [R.choice("+-&^\\/") for _ in range(R.randint(1, 2))]
                drawn = " ".join(way + [drawn] + [back[w] for w in reversed(way)])
            elif kind < 0.3:
                drawn = "- %s + + %s -" % (drawn, edge())
            out.append(drawn)
        if R.random() < 0.3:
            out.append("[ %s %s ]" % (turn("+-"), edge()))
        return " ".join(out)

    lines = [" + ".join(tilde(0.2) + edge(False) for _ in range(R.randint(3, 7)))]
    for _ in range(R.randint(1, 5)):
        form = R.choice(["%s"] * 7 + ["%s %s", "%s %s %s", "%s < %s", "%s > %s", "%s < %s > %s"])
        rule = form % tuple(edge(False) for _ in range(form.count("%"))) + " -> " + successor()
        kind = R.random()
        if kind < 0.2:
            rule += " Weight %d" % R.randint(1, 3)
            rule += "".join("\n -> %s Weight %s" % (successor(), R.choice(["0", "1", "2.5", "3"])) for _ in range(R.randint(1, 3)))
        elif kind < 0.25:
            rule += "\n -> " + successor()
        elif kind < 0.45:
            rule += " If i %s %d" % (R.choice("<>="), R.randint(-1, 2))
            rule += "".join("\n -> %s If i %s %d" % (successor(), R.choice("<>="), R.randint(0, 3)) for _ in range(R.choice([0, 0, 1, 2])))
        lines.append(rule)
    # no angle with two multiples up to three that point the same way (72, 120): in the reference rounding decides there which
    # of two such branches comes first
    lines += ["Angle %d" % R.choice([15, 22, 30, 36, 45, 60, 75, 90, 100]), "BranchAngle %d" % R.choice([30, 60, 75, 90, 90, 120, 180])]
    if R.random() < 0.5:
        lines.append("Sync")
    options = {"scale": R.choice([0.8, 1.0, 1.5]), "seed": R.randint(0, 1000)}
    for key, value, share in (("branch_length", R.choice([0.3, 0.6, 1.0]), 0.2), ("facing", True, 0.2), ("mirror", True, 0.1),
                              ("fixed_center", True, 0.2), ("fixed_perimeter", True, 0.2)):
        if R.random() < share:
            options[key] = value
    if R.random() < 0.3:
        place = lambda: [R.uniform(-3, 3) for _ in range(3)]
        options["env"] = [[R.choice(["attractor", "repeller"]), place(), R.uniform(0.1, 1), R.choice([1, 2, 2.5])]
                          for _ in range(R.randint(0, 2))] + [["gravity", [0, 0, R.uniform(-0.3, 0.3)]]]
    if R.random() < 0.25:
        options["wall_mode"] = R.choice(["slide", "stop", "soft"])
        options["walls"] = [R.choice([["plane", [0, 0, R.uniform(-1, 0)], [R.uniform(-0.3, 0.3), R.uniform(-0.3, 0.3), 1]],
                                      ["sphere", [R.uniform(-1, 1), 0.2, R.uniform(-2, 2)], R.uniform(0.3, 1), False],
                                      ["sphere", [0.1, 0.2, 0], R.uniform(2, 4), True],
                                      ["box", [-2.1, -1.9, -1], [2.2, 2.3, 1.5], True]])]
    return "\n".join(lines), options


def surroundings(options):
    """Forces and walls as the reference's own objects."""
    forces = {"attractor": ref.Attractor, "repeller": ref.Repeller, "gravity": ref.Gravity}
    walls = {"plane": ref.Plane, "sphere": ref.Sphere, "box": ref.Box}
    return {**options, "env": [forces[e[0]](*e[1:]) for e in options.get("env", [])],
            "walls": [walls[w[0]](*w[1:]) for w in options.get("walls", [])]}


def random_systems(count):
    bad = steps = joins = 0
    for seed in range(count):
        text, options = random_system(random.Random(seed))
        try:
            g = Careful(ref.parse(text), ref.Options(**surroundings(options)))
        except ref.HemlsError:
            continue
        snapshot = lambda: (g.mesh()[0], [list(e[:2]) for e in g.mesh()[2]], g.histogram())
        expected = [snapshot()]
        try:
            while len(expected) < 6 and len(g.edges) < 300:
                g.step()
                expected.append(snapshot())
        except Fragile:
            pass
        steps += len(expected) - 1
        joins += g.stats.get("joins", 0)
        for k, (s, vertices, lines) in enumerate(grow(text, options, len(expected) - 1, 1 + seed % 4)):
            P, E, labels = expected[k]
            if lines != E or s["labels"] != labels or len(P) != len(vertices) or not near(vertices, P, max(1, max(abs(c) for p in P for c in p))):
                bad += 1
                print("random system %d differs at step %d:\n%s\n%s" % (seed, k, text, options))
                break
    print("%d steps of random systems, %d joins" % (steps, joins))
    return bad


failures = fixtures() + random_systems(int(sys.argv[2]) if len(sys.argv) > 2 else 150)
print("%d differences" % failures)
sys.exit(failures > 0)
