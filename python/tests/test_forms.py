"""Surfaces, meshes, models, houses and evolutions, each against the command's answer."""
import json
import math
import os
import unittest
from fractions import Fraction

import tartan
from support import WALKED, Folder, command
from tartan import _arrays, meshes

FIELD = """box (-2, -2, -2) .. (2, 2, 2)
surface ball = sqrt(x*x + y*y + z*z) - 1
"""
SQUARE = "A + A + A + A\nA -> A\nAngle 90\n"


class Forms(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Folder().__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.folder.__exit__()

    def path(self, name):
        return os.path.join(self.folder.path, name)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def test_grows(self):
        path = self.folder.write("square.hemls", SQUARE)
        steps = []
        surface = tartan.File(path).surface().grow(5, progress=lambda done, total: steps.append(done))
        mesh = surface.mesh()
        command("grow", path, "--steps", 5, "-o", self.path("square.ply"))
        self.assertEqual(surface.steps, 5)
        read = meshes.read(self.path("square.ply"))
        self.assertEqual(list(memoryview(read.positions).tobytes()), list(memoryview(mesh.positions).tobytes()))
        self.assertEqual(surface.measures["vertices"], len(mesh.positions) if _arrays.numpy else len(mesh.positions) // 3)
        self.assertEqual(sum(surface.sides.values()), surface.measures["faces"])
        self.assertEqual(sum(surface.ages.values()), surface.measures["edges"])
        self.assertIn("<svg", surface._repr_svg_())
        self.assertEqual(surface.restart().steps, 0)
        with self.assertRaisesRegex(TypeError, "did you mean 'angle'"):
            tartan.File(path).surface(angel=3)
        with self.assertRaises(tartan.Error):
            surface.grow(4).grow(2)

    def test_surroundings(self):
        path = self.folder.write("square.hemls", SQUARE)
        pulled = tartan.File(path).surface(forces=[tartan.Force("attractor", (0, 0, 5), 2, 1)],
                                           boundaries=[tartan.Boundary("plane", (0, 0, 1), (0, 0, -1), mode="stop")])
        pulled.grow(3)
        heights = [position for position in memoryview(pulled.mesh().positions).cast("B").cast("d")][2::3]
        self.assertGreater(max(heights), 0.5)
        self.assertLessEqual(max(heights), 1 + 1e-9)
        with self.assertRaises(ValueError):
            tartan.File(path).surface(forces=[tartan.Force("magnet", (0, 0, 5))])

    def test_meshes(self):
        path = self.folder.write("ball.field", FIELD)
        mesh = tartan.File(path).mesh("ball", grid=40)
        command("mesh", path, "--grid", 40, "-o", self.path("ball.stl"))
        mesh.write(self.path("again.stl"))
        self.assertEqual(self.read("again.stl"), self.read("ball.stl"))
        self.assertTrue(mesh.findings.inside and mesh.findings.outside and not mesh.findings.cut)
        for format in ("obj", "ply", "glb", "off"):
            self.assertGreater(len(mesh.file(format)), 1000)
        with self.assertRaises(ValueError):
            mesh.file("doc")
        with self.assertRaises(ValueError):
            mesh.write(self.path("ball.doc"))
        self.assertFalse(os.path.exists(self.path("ball.doc")))
        with self.assertRaises(tartan.Error):
            tartan.File(path).mesh("bell")
        self.assertEqual(mesh._repr_png_()[:4], b"\x89PNG")
        for other in (mesh.subdivided(), mesh.decimated(200), mesh.smoothed(2), mesh.triangulated()):
            self.assertNotEqual(repr(other), "")
        self.assertLess(len(mesh.decimated(200).corners), len(mesh.corners))

    def test_own_mesh(self):
        tetrahedron = tartan.Mesh.of([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
                                     [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])
        self.assertEqual(len(tetrahedron.corners), 12)
        self.assertIn(b"f 1 3 2", tetrahedron.file("obj"))
        with self.assertRaises(tartan.Error):
            tartan.Mesh.of([(0, 0, 0), (1, 0, 0)], [(0, 1, 2)])
        with self.assertRaises(tartan.Error):
            tartan.Mesh.of([(0, 0, math.inf), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])

    @unittest.skipUnless(_arrays.numpy, "numpy is not there")
    def test_no_copies(self):
        mesh = tartan.File(self.folder.write("ball.field", FIELD)).mesh("ball", grid=40)
        from tartan._call import ffi, lib
        count = ffi.new("size_t *")
        address = int(ffi.cast("uintptr_t", lib.tartan_mesh_positions(mesh._handle, count)))
        self.assertEqual(mesh.positions.__array_interface__["data"][0], address)
        self.assertEqual(mesh.positions.shape, (count[0], 3))
        self.assertFalse(mesh.positions.flags.writeable)
        positions, radius = mesh.positions, None
        del mesh
        radius = _arrays.numpy.linalg.norm(positions, axis=1)
        self.assertLess(abs(radius - 1).max(), 0.02)

    def test_places(self):
        for kit in ("brick-wall/wall.kit", "dish/dish.kit"):
            path = os.path.join(os.path.dirname(__file__), "..", "..", "examples", kit)
            if not os.path.exists(path):
                continue
            model = tartan.File(path).place(seed=2)
            command("place", path, "--seed", 2, "-o", self.path("model.ldr"))
            model.write(self.path("again.ldr"))
            lines = [[line for line in self.read(name).split(b"\n") if line.startswith(b"1 ")]
                     for name in ("again.ldr", "model.ldr")]
            self.assertEqual(*lines)
            self.assertEqual(len(model.parts), len(lines[0]))
            self.assertTrue(model.complete)
            self.assertIn("part,", model.list().split("\n")[0])
            with self.assertRaises(TypeError):
                tartan.File(path).place(max_bricks=3)

    def test_genomes(self):
        file = tartan.File("arithmetic")
        grammar = file.grammar()
        said = command("map", "arithmetic", "--random", 20, "--seed", 1)
        sentences = [line for line in said.split("\n") if line and not line.startswith("#")]
        for sentence in sentences[:5]:
            codons = grammar.invert(sentence)
            self.assertEqual(grammar.map(codons).sentence, sentence)
        self.assertFalse(grammar.map([]).valid)
        self.assertEqual(grammar.map([]).reason, "out of codons")
        self.assertGreater(grammar.derivations(3), 1)
        with self.assertRaises(tartan.Error) as raised:
            grammar.invert("x1 +")
        self.assertIsNotNone(raised.exception.column)

    def test_evolves(self):
        file = tartan.File("arithmetic")

        def run():
            evolution = tartan.Evolution(file, population=30, seed=1, generations=6)
            asked = set()
            for generation in evolution:
                self.assertFalse(asked & set(generation.sentences))
                asked |= set(generation.sentences)
                generation.scores = [abs(len(sentence) - 12) for sentence in generation.sentences]
            return evolution

        evolution, again = run(), run()
        self.assertEqual(evolution.done, 6)
        self.assertEqual([member.sentence for member in evolution.members], [member.sentence for member in again.members])
        self.assertEqual(evolution.best.scores, (abs(len(evolution.best.sentence) - 12),))
        self.assertEqual(evolution.save(), again.save())
        with self.assertRaises(tartan.Error):
            for _ in tartan.Evolution(file, population=30, seed=1):
                pass
        with self.assertRaisesRegex(TypeError, "did you mean 'population'"):
            tartan.Evolution(file, popluation=30)
        with self.assertRaises(ValueError):
            tartan.Evolution(file, selection="lottery")
        with self.assertRaises(ZeroDivisionError):
            for generation in tartan.Evolution(file, population=30, seed=1):
                generation.scores = [1 / 0]

    def test_objectives(self):
        evolution = tartan.Evolution(tartan.File("arithmetic"), population=20, seed=2, objectives=2, generations=3)
        for generation in evolution:
            generation.scores = [None if "sqrt" in sentence else [len(sentence), sentence.count("x")]
                                 for sentence in generation.sentences]
        self.assertTrue(evolution.front)
        self.assertTrue(all(member.scores[0] == len(member.sentence) for member in evolution.front))


class Houses(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.houses = tartan.File("cottage").houses()

    def test_numbers(self):
        count = self.houses.count()
        self.assertEqual(count, int(json.loads(command("count", "cottage", "--library", "cottages", "--json"))["houses"]))
        for rank in (0, count // 3, count - 1):
            house = self.houses[rank]
            self.assertEqual(house.rank(), rank)
            self.assertEqual(self.houses[f"#{house.number}"], house)
            self.assertEqual(self.houses.house(str(house)), house)
        self.assertEqual(self.houses[-1].rank(), count - 1)
        plan = self.houses[0].plan
        self.assertEqual(self.houses.count(plan=plan), int(json.loads(command("count", "cottage", "--library", "cottages", "--plan", plan, "--json"))["houses"]))
        with self.assertRaises(IndexError):
            self.houses[count]
        with self.assertRaises(tartan.Error):
            self.houses.house("no house")

    def test_samples(self):
        said = [line for line in command("sample", "cottage", 3, "--library", "cottages", "--seed", 5).split("\n") if line and line[0] != "#"]
        self.assertEqual([str(house) for house in self.houses.sample(3, seed=5)], said)
        self.assertTrue(all(house.rank() >= 0 for house in self.houses.sample(3, seed=5)))

    def test_walks(self):
        plan = "3m space:4m | 4m space:4m | 3m space:4m"
        with Folder() as folder:
            path = folder.write("walked.plan", WALKED)
            houses = tartan.File(path).houses()
            for wish in ("least", "most"):
                for measure in ("far", "exits"):
                    best = houses.best(20, plan=plan, **{wish: measure})
                    wanted = [json.loads(line) for line in command("best", path, 20, "--plan", plan, f"--{wish}", measure, "--library", "near", "--format", "json").splitlines()]
                    self.assertEqual([str(house) for house in best], [house["house"] for house in wanted])
                    self.assertEqual([house.values[0] for house in best], [Fraction(house["value"]) for house in wanted])
                    self.assertGreater(len(best), 5)
            kept = command("enumerate", path, "--library", "near", "--plan", plan).splitlines()
            self.assertEqual(houses.count(plan=plan), len(kept))
            self.assertEqual([str(house) for house in houses.sample(len(kept) + 1, plan=plan)], kept)
            self.assertEqual([house["house"] for house in houses.ask("enumerate", plan=plan).houses], kept)
            self.assertEqual([str(house) for house in houses.sample(4, seed=3)], command("sample", path, 4, "--library", "near", "--seed", 3).splitlines())
            with self.assertRaisesRegex(tartan.Error, "more than 5 on this plan"):
                tartan.File(path).houses(max_houses=5).best(1, plan=plan, least="far")
            with self.assertRaisesRegex(tartan.Error, "how one walks"):
                houses.count()

    def test_files(self):
        house = self.houses.sample(1, seed=9)[0]
        with Folder() as folder:
            for format in ("ifc", "glb", "svg", "json"):
                path = os.path.join(folder.path, f"house.{format}")
                command("house", "cottage", str(house), "-o", path)
                with open(path, "rb") as file:
                    self.assertEqual(file.read(), house.file(format), format)
            house.write(os.path.join(folder.path, "again.pdf"))
        self.assertEqual(sum(len(room.cells) for room in house.rooms), sum(len(room["cells"]) for room in house.data["rooms"]))
        self.assertTrue(all(0 < room.net < room.area for room in house.rooms))
        self.assertGreater(len(house.mesh().corners), 100)
        with self.assertRaises(ValueError):
            house.file("dwg")
        with self.assertRaises(tartan.Error):
            house.file("svg", views=["plan:attic"])

    def test_variants(self):
        house = self.houses.sample(1, seed=9)[0]
        for other in house.variants():
            self.assertNotEqual(other, house)
            self.assertNotEqual(other.change.before, other.change.after)
        self.assertTrue(house.explain().kept)


if __name__ == "__main__":
    unittest.main()
