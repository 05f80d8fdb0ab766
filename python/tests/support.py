"""What the tests share: rule files of their own, and the command that answers are compared with."""
import json
import os
import subprocess
import tempfile

import tartan

#: The command to compare with.
COMMAND = os.environ.get("TARTAN", "tartan")

BOXES = """schema box { width = 8' | 12'  lid = flag  use = hall | bed }
rule pair "two lids" = neighbour(tray(lid), tray(lid))
rule hall "a hall" = tray(hall)
library rows "no two lids" using box { trays 1..3 prune pair require hall }
library lids using box { trays 1..2 require tray(lid) }
measure long = sum(width)
measure halls = quantity(tray(hall))
measure third = sum(width) / 3'
test pair { match [8' lid hall | 12' lid bed] reject [8' - hall] }
"""

#: Houses whose clauses and measures ask for walks: what only single houses, and those on one plan, have a value of.
WALKED = """schema row { width role length = 3m | 4m  zone house role band = space(4m) }
form f of row {
  storey ground 2.7m  wall 200mm  partition 100mm  deck 300mm  roof 200mm  way 800mm
  function first at cell(3m)
  function second at cell(any)
  opening door wide 900mm high 2m passage sliding
  face cell(any) beside cell(any) = door | wall
  face cell(any) outside left = door
  face cell(any) outside = wall
  tile tables for second { item table left 500mm..1.2m, back 500mm..1.2m }
  tile bare for second { }
}
library rows using row { trays 1..3 }
library near from rows in f { require walk(cell(any), to outside) <= 6.95m }
measure far = walk(cell(any), to outside)
measure exits = exits(cell(any))
"""

#: The same without a clause, and with a weight.
EDITED = BOXES.replace(" prune pair", "")
WEIGHED = BOXES.replace("require hall }", "require hall weight tray(bed) 5 }")


def boxes(text=BOXES):
    return tartan.File(text=text, name="boxes.plan")


class Folder:
    """A folder for files of a test."""

    def __enter__(self):
        self._folder = tempfile.TemporaryDirectory()
        self.path = self._folder.name
        return self

    def __exit__(self, *_):
        self._folder.cleanup()

    def write(self, name, text):
        path = os.path.join(self.path, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path


def command(*arguments):
    """What the command writes."""
    done = subprocess.run([COMMAND, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"tartan {' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout


def answered(*arguments):
    """What the command answers as JSON."""
    return json.loads(command(*arguments, "--json"))
