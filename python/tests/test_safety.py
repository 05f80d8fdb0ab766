"""Misuse is an exception and never a crash; objects are freed in any order; long calls end, and let others run."""
import gc
import os
import random
import subprocess
import sys
import threading
import time
import unittest
import weakref

import tartan
from support import BOXES, boxes
from tartan import _arrays

#: A count that takes far longer than a test waits.
LONG = """schema s { w = 1m | 2m | 3m  use = a | b | c | d }
rule x = quantity(tray(a), n = 7) and quantity(tray(b), n = 9) and occurrences(tray(c) beside tray(d), n = 5)
library l using s { trays 1..60 require x require sum(w of tray(a)) = sum(w of tray(b)) }
measure m = sum(w)
"""


class Misuse(unittest.TestCase):
    def test_arguments(self):
        file = boxes()
        rows = file.library("rows")
        plan = rows[0]
        wrong = [
            (TypeError, lambda: tartan.File()), (TypeError, lambda: tartan.File("x", text="y")),
            (ValueError, lambda: tartan.File("a\0b.plan")), (tartan.Error, lambda: tartan.File(text="x", name="a.nonsense")),
            (tartan.Error, lambda: tartan.File("/")), (TypeError, lambda: file.library(5)),
            (tartan.Error, lambda: file.library("rose")), (TypeError, lambda: rows["3"]), (TypeError, lambda: rows[1.5]),
            (IndexError, lambda: rows[10**30]), (OverflowError, lambda: rows.count(length=-1)),
            (OverflowError, lambda: rows.sample(-1)), (OverflowError, lambda: rows.sample(3, seed=-1)),
            (OverflowError, lambda: rows.sample(2**70)), (TypeError, lambda: rows.sample("3")),
            (tartan.Error, lambda: rows.rank("nonsense")), (IndexError, lambda: rows.rank([99])),
            (TypeError, lambda: rows.rank(5)), (tartan.Error, lambda: rows.measure("lonk", plan)),
            (TypeError, lambda: rows.measure(None, plan)), (tartan.Error, lambda: rows.best(3, least="lonk")),
            (tartan.Error, lambda: rows.front(least="long")), (tartan.Error, lambda: rows.complete("| |")),
            (tartan.Error, lambda: rows.distribution("lonk")), (tartan.Error, lambda: file.surface()),
            (tartan.Error, lambda: file.mesh()), (tartan.Error, lambda: file.place()), (tartan.Error, lambda: file.grammar()),
            (tartan.Error, lambda: tartan.Evolution(file)), (tartan.Error, lambda: file.houses()),
            (tartan.Error, lambda: tartan.diff(rows, tartan.File(text="schema s { w = 1m }\nlibrary l using s { trays 1 }\n",
                                                                 name="s.plan").library())),
            (ValueError, lambda: rows.sample(3).draw(captions=["one"])), (TypeError, lambda: rows.where(5)),
            (TypeError, lambda: file.ask("count", library={1, 2})), (tartan.Error, lambda: file.ask("count", library=5)),
            (tartan.Error, lambda: tartan.Plans.of(rows.schema, [plan]).match("pair")),
            (IndexError, lambda: rows.sample(3)[3]), (IndexError, lambda: plan[1]),
            (ValueError, lambda: tartan.Mesh.of([("a", "b", "c")], [])),
            (TypeError, lambda: tartan.Evolution(tartan.File("arithmetic"), seeds=[5])),
            (TypeError, lambda: tartan.File("arithmetic").grammar().map(["a"])),
            (OverflowError, lambda: tartan.File("arithmetic").grammar().map([2**64])),
        ]
        for i, (kind, call) in enumerate(wrong):
            with self.subTest(number=i), self.assertRaises(kind):
                call()

    def test_messages(self):
        with self.assertRaises(tartan.Error) as raised:
            boxes().library("rows").measure("lonk", "8' - hall")
        self.assertIn("long", raised.exception.help)
        self.assertIn("lonk", str(raised.exception))
        with self.assertRaises(tartan.Error) as raised:
            boxes().library("rows").plan("8' - hell")
        self.assertEqual(raised.exception.column, 6)


class Freed(unittest.TestCase):
    def test_any_order(self):
        for seed in range(60):
            file = boxes()
            rows = file.library("rows")
            after = boxes(BOXES.replace("1..3", "1..2")).library("rows")
            difference = tartan.diff(rows, after)
            objects = [file, rows, after, difference, difference.removed, rows[3], rows[3][0], iter(rows), rows[:5],
                       rows.sample(3), file.rules["pair"], rows.where("tray(lid)"), rows.schema]
            del file, rows, after, difference
            random.Random(seed).shuffle(objects)
            while objects:
                last = objects.pop()
                str(last)
                gc.collect()

    def test_alone(self):
        """What is left of an object works."""
        removed = tartan.diff(boxes(BOXES.replace("require hall", "")).library("rows"), boxes().library("rows")).removed
        gc.collect()
        self.assertGreater(removed.count(), 0)
        self.assertEqual(len(list(removed)), removed.count())
        plans = iter(boxes().library("rows"))
        gc.collect()
        self.assertEqual(str(next(plans)), "8' - hall")
        tray = boxes().library("rows")[0][0]
        gc.collect()
        self.assertEqual(tray.use, "hall")

    def test_nothing_is_kept(self):
        file = boxes()
        rows = file.library("rows")
        rows.distribution("long")
        rows.sample(3).match("pair")
        gone = [weakref.ref(file), weakref.ref(rows)]
        del file, rows
        gc.collect()
        self.assertEqual([one() for one in gone], [None, None])


class Waiting(unittest.TestCase):
    def test_interrupt(self):
        """Ctrl-C ends a call that would go on for long."""
        code = ("import tartan, signal, os, threading\n"
                f"library = tartan.File(text={LONG!r}, name='long.plan')\n"
                "threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()\n"
                "try:\n    tartan.File('square').surface().grow(60)\n"
                "except KeyboardInterrupt:\n    print('interrupted')\n")
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=100)
        self.assertEqual(done.stdout, "interrupted\n", done.stderr)

    def test_progress(self):
        told = []

        def enough(done, total):
            told.append((done, total))
            if len(told) == 3:
                raise EOFError("enough")

        with self.assertRaises(EOFError):
            tartan.File("square").surface().grow(60, progress=enough)
        self.assertEqual(len(told), 3)

    def test_threads(self):
        """While one thread counts, another runs; and several ask at once what may be asked so."""
        rows = boxes().library("rows")
        wanted = [str(plan) for plan in rows]
        found, errors = [], []

        def ask():
            try:
                for _ in range(20):
                    found.append([str(plan) for plan in rows] == wanted)
                    found.append(rows.ask("count").kept == len(wanted))
                    found.append(rows.rank(wanted[5]) == 5)
                    found.append(bool(rows.file.rules["pair"].match("8' lid hall | 8' lid hall")))
            except BaseException as error:
                errors.append(error)

        threads = [threading.Thread(target=ask) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(errors, [])
        self.assertTrue(all(found) and len(found) == 320)

    def test_others_run(self):
        """Another thread has several turns while one call works: of many calls at least one is long enough."""
        turns = []
        stop = threading.Event()

        def count():
            while not stop.is_set():
                turns.append(True)
                time.sleep(0.0005)

        thread = threading.Thread(target=count)
        thread.start()
        try:
            surface, most = tartan.File("square").surface(), 0
            for _ in range(200):
                before = len(turns)
                surface.grow(9)
                most = max(most, len(turns) - before)
                if most > 3:
                    break
                surface.restart()
        finally:
            stop.set()
            thread.join()
        self.assertGreater(most, 3)

    @unittest.skipUnless(sys.platform == "linux", "memory is limited by Linux's means")
    def test_no_memory(self):
        """Where memory runs out there is an exception, and Python goes on."""
        code = ("import resource, tartan\n"
                "surface = tartan.File('square').surface(threads=1)\nsurface.grow(3)\n"
                "used = int(open('/proc/self/statm').read().split()[0]) * resource.getpagesize()\n"
                "resource.setrlimit(resource.RLIMIT_AS, (used + (48 << 20), -1))\n"
                "try:\n    surface.grow(14)\n"
                "except MemoryError:\n    print('no memory')\n"
                "except tartan.Error as error:\n    print(error.kind)\n"
                "resource.setrlimit(resource.RLIMIT_AS, (-1, -1))\n"
                "print(tartan.File('cottage').library().count() > 0)\n")
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=100)
        self.assertIn(done.stdout, ("no memory\nTrue\n", "limit\nTrue\n"), done.stderr)


class Without(unittest.TestCase):
    def test_numpy(self):
        """All but frames works without numpy, and is the same."""
        code = ("import sys; sys.modules['numpy'] = None\n"
                f"import tartan\nrows = tartan.File(text={BOXES!r}, name='b.plan').library('rows')\n"
                "s = rows.sample(5, seed=3)\n"
                "print([str(p) for p in s], list(s.match('pair')), list(s.measure('long')['long']), list(s.trays))\n"
                "m = tartan.File('square').surface().grow(3).mesh()\n"
                "print(len(m.positions), m.positions[3], list(m.corners[:8]))\n")
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=100)
        rows = boxes().library("rows")
        sample = rows.sample(5, seed=3)
        mesh = tartan.File("square").surface().grow(3).mesh()
        flat = memoryview(mesh.positions).cast("B").cast("d")
        wanted = (f"{[str(plan) for plan in sample]} {[int(one) for one in sample.match('pair')]} "
                  f"{[float(one) for one in sample.measure('long')['long']]} {[int(one) for one in sample.trays]}\n"
                  f"{len(flat)} {flat[3]} {[int(one) for one in mesh.corners[:8]]}\n")
        self.assertEqual(done.stdout, wanted, done.stderr)


if __name__ == "__main__":
    unittest.main()
