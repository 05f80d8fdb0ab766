"""Plans and libraries, each call against the command's answer."""
import itertools
import sys
import unittest
from fractions import Fraction

import tartan
from support import BOXES, EDITED, WEIGHED, Folder, answered, boxes, command


class Plans(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Folder().__enter__()
        cls.path = cls.folder.write("boxes.plan", BOXES)
        cls.file = tartan.File(cls.path)
        cls.rows = cls.file.library("rows")
        cls.all = command("enumerate", cls.path, "--library", "rows").split("\n")[:-1]

    @classmethod
    def tearDownClass(cls):
        cls.folder.__exit__()

    def test_counts(self):
        said = answered("count", self.path, "--library", "rows")
        self.assertEqual(self.rows.count(), int(said["kept"]))
        self.assertEqual(len(self.rows), int(said["kept"]))
        for row in said["by_length"]:
            self.assertEqual(self.rows.count(length=row["length"]), int(row["kept"]))
        self.assertEqual(self.rows.hash, said["hash"])
        self.assertEqual((self.rows.min_trays, self.rows.max_trays), (1, 3))
        self.assertTrue(self.rows)

    def test_ranks(self):
        self.assertEqual([str(plan) for plan in self.rows], self.all)
        for rank, line in enumerate(self.all):
            self.assertEqual(str(self.rows[rank]), line)
            self.assertEqual(self.rows.rank(line), rank)
            self.assertEqual(self.rows[rank].rank, rank)
            self.assertIn(line, self.rows)
        self.assertEqual(self.rows[-1], self.rows[len(self.all) - 1])
        self.assertNotIn("8' lid hall | 8' lid hall", self.rows)
        self.assertNotIn("8' lid nonsense", self.rows)
        with self.assertRaises(IndexError):
            self.rows[len(self.all)]
        with self.assertRaises(IndexError):
            self.rows[-len(self.all) - 1]
        with self.assertRaises(tartan.Error):
            self.rows.rank("8' lid hall | 8' lid hall")
        with self.assertRaises(ValueError):
            self.rows.index("8' - bed")

    def test_slices(self):
        for part in (slice(0, 5), slice(3, None), slice(None, -4), slice(5, 2), slice(None, None, 7), slice(9, 2, -3),
                     slice(1000, 2000)):
            self.assertEqual([str(plan) for plan in self.rows[part]], self.all[part])
            self.assertEqual([str(plan) for plan in self.rows[part].plans()], self.all[part])
            self.assertEqual(len(self.rows[part]), len(self.all[part]))
            self.assertEqual([str(plan) for plan in self.rows[part][1:3]], self.all[part][1:3])

    def test_many_digits(self):
        street = tartan.File(text="schema s { w = 1m | 2m | 3m }\nlibrary l using s { trays 100 }\n", name="s.plan").library()
        self.assertEqual(street.count(), 3**100)
        self.assertEqual(street.rank(street[10**40]), 10**40)
        self.assertEqual(street[3**100 - 1].rank, 3**100 - 1)
        with self.assertRaises(OverflowError):
            len(street)
        self.assertEqual(sum(1 for _ in itertools.islice(street[10**45:], 5)), 5)

    def test_trays(self):
        plan = self.rows.plan("8' lid hall | 12' - bed")
        first, second = plan
        self.assertEqual((first.width.text, first.lid, first.use), ("8'", True, "hall"))
        self.assertEqual((second["width"].metres, second.lid, second.use), (3.6576, False, "bed"))
        self.assertEqual(second.width.nanometres, 3657600000)
        self.assertEqual(repr(first.width), 'Length("8\'")')
        self.assertLess(first.width, second.width)
        self.assertEqual(len(plan), 2)
        self.assertEqual(dict(first), {"width": first.width, "lid": True, "use": "hall"})
        with self.assertRaises(AttributeError):
            first.depth
        with self.assertRaises(KeyError):
            first["depth"]
        with self.assertRaises(IndexError):
            tartan.Plan(plan.schema, [99])

    def test_zones(self):
        plan = tartan.File(text="schema z { zone body = open(4') | dense(8') | none }\nlibrary l using z { trays 1 }\n",
                           name="z.plan").library()
        values = [tray.body for (tray,) in plan]
        self.assertEqual([value.name for value in values], ["open", "dense", "none"])
        self.assertEqual([value.depth.text if value.depth else None for value in values], ["4'", "8'", None])

    def test_samples(self):
        for seed in (0, 7):
            said = command("sample", self.path, "--library", "rows", "9", "--seed", seed).split("\n")[:-1]
            self.assertEqual([str(plan) for plan in self.rows.sample(9, seed=seed)], said)
        self.assertEqual(len(self.rows.sample(10**6)), len(self.all))
        self.assertEqual(len(self.rows.sample(0)), 0)

    def test_weights(self):
        with Folder() as folder:
            path = folder.write("weighed.plan", WEIGHED)
            said = command("sample", path, "--library", "rows", "20", "--seed", "3").split("\n")[:-1]
            rows = tartan.File(path).library("rows")
            self.assertEqual([str(plan) for plan in rows.sample(20, seed=3)], said)
            said = command("sample", path, "--library", "rows", "20", "--seed", "3", "--uniform").split("\n")[:-1]
            self.assertEqual([str(plan) for plan in rows.sample(20, seed=3, uniform=True)], said)

    def test_clauses(self):
        said = answered("count", self.path, "--library", "rows")
        self.assertEqual([(clause.name, clause.prunes) for clause in self.rows.clauses], [("pair", True), ("hall", False)])
        self.assertEqual(self.rows.clauses[0].only, int(said["rules"][0]["only"]))

    def test_explains(self):
        explained = self.rows.explain("8' lid hall | 12' lid bed")
        self.assertFalse(explained.kept)
        self.assertEqual(explained.clauses[0].why.parts[0].text, "tray(lid)")
        self.assertEqual(explained.clauses[0].why.line, 2)
        self.assertEqual({self.rows.rank(near.plan) for near in explained.nearest}, {near.rank for near in explained.nearest})
        self.assertIsNone(explained.preference)
        with self.assertRaises(AttributeError):
            explained.nonsense

    def test_measures(self):
        said = answered("count", self.path, "--library", "rows", "--by", "long")
        spread = self.rows.distribution("long")
        self.assertEqual(list(spread), [(Fraction(row["value"]), int(row["plans"])) for row in said["distribution"]])
        self.assertEqual(spread.mean, Fraction(said["mean"]))
        self.assertEqual(spread.quartiles, [Fraction(one) for one in said["quartiles"]])
        self.assertEqual(spread.unit, "ft")
        self.assertEqual(sum(spread.counts), len(self.all))
        sample = self.rows.sample(20, seed=1)
        for plan, third in zip(sample, sample.measure("third")["third"]):
            exact = self.rows.measure("third", plan)
            self.assertEqual(third, float(exact))
            self.assertEqual(exact, Fraction(sum(tray.width.nanometres for tray in plan), 914400000))
        with self.assertRaises(tartan.Error) as raised:
            sample.measure("lonk")
        self.assertIn("long", raised.exception.help)

    def test_best(self):
        said = command("best", self.path, "--library", "rows", "--most", "halls", "--then-least", "long").split("\n")[:-1]
        best = self.rows.best(10, most="halls", then_least="long")
        self.assertEqual([str(plan) for plan in best], [line for line in said if not line.startswith("#")])
        self.assertEqual(best[0].values, [3, 24])
        self.assertEqual([self.rows[plan.rank] for plan in best], best)
        front = self.rows.front(least="long", most="halls")
        said = answered("pareto", self.path, "--library", "rows", "--least", "long", "--most", "halls")
        self.assertEqual([str(plan) for plan in front], [point["plan"] for point in said["points"]])
        self.assertEqual(front.counts, [int(point["plans"]) for point in said["points"]])
        with self.assertRaises(TypeError):
            self.rows.best(3, smallest="long")

    def test_completes(self):
        said = answered("complete", self.path, "--library", "rows", "8' lid | ...")
        found = self.rows.complete("8' lid | ...")
        self.assertEqual(found.plans, int(said["plans"]))
        self.assertEqual(found.trays[0]["use"], {name: int(count) for name, count in said["trays"][0]["use"].items()})

    def test_where(self):
        narrowed = self.rows.where("quantity(tray(lid), n = 1)", "quantity(tray(bed), n = 0)")
        wanted = [line for line in self.all if line.count("lid") == 1 and "bed" not in line]
        self.assertEqual([str(plan) for plan in narrowed], wanted)
        self.assertEqual(narrowed.where("tray(width 12')").count(), sum("12'" in line for line in wanted))
        self.assertEqual(sum(narrowed.distribution("long").counts), len(wanted))
        self.assertEqual(narrowed.of_lengths(2, 2).count(), sum(line.count("|") == 1 for line in wanted))
        with self.assertRaises(tartan.Error) as raised:
            self.rows.where("quantity(tray(lit), n = 1)")
        self.assertTrue(raised.exception.diagnostics)

    def test_matches(self):
        rule = self.file.rules["pair"]
        self.assertTrue(rule.match("8' lid hall | 12' lid bed"))
        self.assertFalse(rule.match("8' lid hall"))
        plans = boxes().library("lids").sample(50, seed=2)
        self.assertEqual(list(plans.match("pair")), ["lid" in str(plan[0]) and "lid" in str(plan[-1]) and len(plan) == 2
                                                     for plan in plans])
        self.assertEqual(set(self.file.rules), {"pair", "hall"})
        self.assertEqual(self.file.rules["pair"].doc, "two lids")
        with self.assertRaises(KeyError):
            self.file.rules["pears"]

    def test_differences(self):
        after = boxes(EDITED).library("rows")
        found = tartan.diff(self.rows, after)
        self.assertEqual(found.removed.count(), 0)
        self.assertEqual(found.kept.count(), len(self.all))
        self.assertEqual([str(plan) for plan in found.added],
                         [str(plan) for plan in after if str(plan) not in set(self.all)])
        self.assertEqual([(clause.name, clause.change, clause.adds) for clause in found.clauses],
                         [("pair", "removed", found.added.count())])

    def test_files(self):
        self.assertEqual(self.file.libraries, ["rows", "lids"])
        self.assertEqual(self.rows.doc, "no two lids")
        with self.assertRaises(tartan.Error):
            self.file.library()
        with self.assertRaises(tartan.Error):
            self.file.library("rose")
        tests = self.file.test()
        self.assertEqual((tests.passed, tests.failed), (2, 0))
        self.assertEqual({case.subject for case in tests.cases}, {"pair"})
        self.assertEqual(tartan.File(text="schema s { w = 1m }\nparam most = 2m in 1m..4m\nlibrary l using s { trays 1..9 "
                                     "require sum(w) <= most }\n", name="p.plan", set={"most": "3m"}).library().count(), 3)
        self.assertIn("rows", self.file.report("rows"))

    def test_diagnostics(self):
        with self.assertRaises(tartan.Error) as raised:
            tartan.File(text="schema s { w = 1m }\nrule x = trai(w)\nrule y = tray(q)\n", name="wrong.plan")
        said = raised.exception.diagnostics
        self.assertEqual([(one.severity, one.line) for one in said], [("error", 2), ("error", 3)])
        self.assertIn("tray", said[0].help)
        warned = tartan.File(text="schema s { w = 1m }\nrule x = tray(w 1m) and tray(w 1m)\nrule y = tray(w 1m)\n", name="w.plan")
        self.assertTrue(any(one.severity == "warning" for one in warned.check()))
        with self.assertRaises(tartan.Error) as raised:
            tartan.File("/no/such/file.plan")
        self.assertEqual(raised.exception.kind, "io")

    def test_asks(self):
        for question in ("schema", "settings"):
            self.assertIsInstance(self.file.ask(question), tartan.Answer)
        self.assertEqual(self.file.ask("count", library="rows").kept, len(self.all))
        with self.assertRaises(tartan.Error):
            self.file.ask("cuont")
        with self.assertRaises(tartan.Error):
            self.file.ask("count", librery="rows")


class Shown(unittest.TestCase):
    def test_pictures(self):
        rows = boxes().library("rows")
        for shown in (rows, rows[3], rows[:4], rows.sample(3), rows.file.rules["pair"], rows.distribution("long")):
            self.assertIn("<svg", shown._repr_svg_())
        self.assertEqual(rows.sample(3).draw("pdf")[:4], b"%PDF")
        self.assertEqual(rows[3].draw("png")[:4], b"\x89PNG")
        self.assertIn(b"\nA-ANNO-TTLB\n", rows.sample(3).draw("dxf", profile="us"))
        for shown in (rows, rows.sample(40), rows.sample(40).measure("long"), rows.front(least="long", most="halls"),
                      rows.file, rows.file.test(), rows.explain(rows[0])):
            self.assertIn("<table>", shown._repr_html_())
        with self.assertRaises(ValueError):
            rows[3].draw("gif")


if __name__ == "__main__":
    sys.exit(unittest.main())
