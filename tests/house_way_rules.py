#!/usr/bin/env python3
"""Each rule about ways through houses by two houses that differ by a millimetre: house_way_rules.py TARTAN

One has people go about in it, the other has not. A form has one tray, or two; its cells are clear from 100 mm inside their outer walls."""
import os
import subprocess
import sys
import tempfile

tartan = sys.argv[1]
failures, asked = [], 0

FORM = """schema row {{ width role length = {width}  zone body role band = space({deep})  zone wing role band = {wing} }}
form f of row {{
  {storeys}
  spine body
  wall 200mm
  partition 100mm
  floor 300mm
  roof 200mm
  option wing storeys = 1
  function room at {room}
  function hall at {hall}
  opening door wide {door} high {high} passage {words}
  opening wide-door wide 1m high {high} passage sliding
  {more}
  tile things for room {{
    against party
    {things}
  }}
  way {way}
  headroom 2m
}}
library rows using row {{ trays {trays} }}
library all from rows in f {{ }}
"""


def houses(**parts):
    """How many houses such a form has; of each plan one."""
    given = dict(width="3m", deep="4m", wing="none role absent", storeys="storey ground 2.7m", room="cell(any)", hall="cell(wing)", door="900mm", high="2m", words="sliding",
                 more="", things="item shelf back 0..10mm", way="800mm", trays="1")
    with tempfile.TemporaryDirectory() as scratch:
        path = os.path.join(scratch, "form.plan")
        with open(path, "w") as file:
            file.write(FORM.format(**{**given, **parts}))
        done = subprocess.run([tartan, "count", path, "--library", "all"], capture_output=True, text=True)
    if done.returncode != 0:
        return done.stderr
    return int(next(line.split()[1] for line in done.stdout.splitlines() if line.startswith("houses")))


def rule(what, parts, good, bad):
    """The form with `good` has houses, with `bad` none."""
    global asked
    asked += 1
    for more, wanted in ((good, True), (bad, False)):
        found = houses(**{**parts, **more})
        if not isinstance(found, int) or (found > 0) != wanted:
            failures.append(f"{what}, with {more}: {found} houses")


BACK = "face cell(any) outside back = party\n  face cell(any) outside front = wall\n  "
SIDES = dict(more=BACK + "face cell(any) outside left = door\n  face cell(any) outside right = door")          # doors in the middle of both sides
FRONT = dict(more="face cell(any) outside back = party\n  face cell(any) outside front = door\n  face cell(any) outside = wall")

# Clear from 0.1 m to 3.9 m; a square of 800 mm passes the doors from 1.6 m to 2.4 m.
rule("a gap is passed that is exactly as wide as a person", SIDES, dict(things="item a back 0..1.5m item b front 1.5m..front 0"),
     dict(things="item a back 0..1.5m item b front 1.501m..front 0"))
rule("a function may need less", SIDES, dict(things="item a back 0..1.6m item b front 1.6m..front 0", way="800mm\n  way 600mm for room"),
     dict(things="item a back 0..1.6m item b front 1.6m..front 0", way="800mm\n  way 601mm for room"))
rule("what hangs as high as a person is not in the way", SIDES, dict(things="item a up 2m..2.1m"), dict(things="item a up 1.999m..2.1m"))
rule("a person comes in by openings that are as wide", FRONT, dict(things="item a front 600mm..front 0", door="799mm"), dict(things="item a front 600mm..front 0", door="800mm"))
rule("one stands at the door in the middle", FRONT, dict(things="item a left 0..1m, front 500mm..front 0"), dict(things="item a left 0..1.001m, front 500mm..front 0"))
rule("a door may be nearer to an end", FRONT, dict(things="item a left 0..1.55m, front 500mm..front 0", words="sliding near right 500mm"),
     dict(things="item a left 0..1.551m, front 500mm..front 0", words="sliding near right 500mm"))
rule("what is kept free is reached if one touches it", FRONT, dict(things="item a back 0..1.5m keep b back 1.5m..1.51m"),
     dict(things="item a left 0..right 0, back 500mm..1m item c back 1m..1.5m keep b back 400mm..499mm"))
# Between two cupboards is a niche of half a metre, before which a person has to stop.
NICHE = "item a left 0..1m, back 0..1m item c left 1.5m..right 0, back 0..1m keep b left 1m..1.5m, back 0..{}"
rule("what is kept free is reached by touching it, and not from a millimetre away", FRONT, dict(things=NICHE.format("1m")), dict(things=NICHE.format("999mm")))
rule("a leaf is as deep as it is wide", FRONT, dict(things="item a front 901mm..front 900mm", words=""), dict(things="item a front 900mm..front 899mm", words=""))
rule("one of two leaves is half as deep", FRONT, dict(things="item a front 611mm..front 610mm", words="", door="1.22m"), dict(things="item a front 610mm..front 609mm", words="", door="1.22m"))
rule("a leaf has room", FRONT, dict(things="item a left 0..right 0, front 1.7m..front 900mm, up 1.9m..2m item b back 0..900mm", words=""),
     dict(things="item a left 0..1m, front 900mm..front 899mm", words=""))
rule("a leaf that slides takes none", FRONT, dict(things="item a left 0..951mm, front 900mm..front 899mm"), dict(things="item a left 0..951mm, front 900mm..front 899mm", words=""))
rule("a door over 1219.2 mm wide has two leaves", FRONT, dict(things="item a left 0..right 0, front 801mm..front 800mm, up 1.9m..2m", door="1.22m", words=""),
     dict(things="item a left 0..right 0, front 801mm..front 800mm, up 1.9m..2m", door="1.219m", words=""))
rule("nobody comes in from outside above the lowest storey", dict(FRONT, storeys="storey ground 2.7m storey upper 2.7m"),
     dict(room="cell(upper)", hall="cell(ground)", things="item a front 600mm..front 0"), dict(room="cell(ground)", hall="cell(upper)", things="item a front 600mm..front 0"))

# The wing is 1.5 m deep and open to the body; both faces are as long as the tray.
WING = dict(wing="porch(1.5m)", room="cell(body)", more="face cell(any) outside back = party\n  face cell(any) beside cell(any) = open\n  face cell(any) outside left = wide-door\n  "
            "face cell(any) outside = wall", things="item a left 0..right 1m, front 600mm..front 0")
# From the left, clear from 0.1 m to 2.9 m: what is left of the open side is the last metre of it.
rule("an open side to a bare cell is passed anywhere, half a wall from its ends", WING, dict(), dict(things="item a left 0..right 799mm, front 600mm..front 0"))
rule("one to a furnished cell in the middle", dict(WING, more=WING["more"] + "\n  tile seat for hall { item seat up 2m..2.1m }"),
     dict(things="item a left 0..1m, front 600mm..front 0"), dict(things="item a left 0..right 1m, front 600mm..front 0"))
rule("an open side as long as a person and a wall is one", dict(WING, more=WING["more"].replace("left = wide-door", "left = wall") + "\n  face cell(body) outside left = wall"),
     dict(width="999mm", things="item a front 600mm..front 0 keep b front 700mm..front 600mm", way="800mm"),
     dict(width="1m", things="item a front 600mm..front 0 keep b front 700mm..front 600mm", way="800mm"))
rule("of an alcove, with one open side, nothing is asked", dict(WING, more=WING["more"].replace("left = wide-door", "left = wall")),
     dict(things="item a front 600mm..front 0"), dict(things="item a front 600mm..front 0 keep b back 0..1m"))

# Under an open shed, low at the front, that rises 1 in 4 from 1.5 m at the outer side of the wall: at 2 m from there it is 2 m above the floor.
LOW = dict(storeys="storey ground 1.5m", high="1.1m", more="face cell(any) outside back = party\n  face cell(any) outside left = hatch\n  face cell(any) outside = wall\n  "
           "option body roof = shed(front, 1:4, open)")
rule("under an open roof one stands where that is high enough", LOW,
     dict(more=LOW["more"] + "\n  opening hatch wide 850mm high 1.1m passage sliding near front 1.875m"), dict(more=LOW["more"] + "\n  opening hatch wide 850mm high 1.1m passage sliding near front 1.874m"))

# ---- flights: in a cell of 3 m by 6 m between walls; 14 steps of 250 mm, 13 treads; 900 mm wide.
STAIR = """schema row {{ width role length = {width}  zone body role band = space({deep}) }}
form f of row {{
  storey ground {height}
  storey upper 2.7m
  wall 200mm
  partition 100mm
  floor 300mm
  roof 200mm
  {function}
  opening door wide 900mm high 2m passage sliding {near}
  flight steps wide {wide} rise 150mm..200mm {going} {turn}
  face cell(stair) under cell(stair) = steps
  {faces}
  way 800mm
  headroom {headroom}
}}
library rows using row {{ trays {trays} }}
library all from rows in f {{ require cell(stair) {rule} }}
"""


def stairs(**parts):
    given = dict(wide="900mm", going="going 250mm", width="1.1m", deep="5.25m", height="2.8m", near="", turn="", faces="face cell(any) outside = wall", headroom="2m", function="function stair at cell(any)", trays="1", rule="")
    global FORM
    form, FORM = FORM, STAIR
    try:
        return houses(**{**given, **parts})
    finally:
        FORM = form


def climb(what, parts, good, bad):
    global asked
    asked += 1
    for more, wanted in ((good, True), (bad, False)):
        found = stairs(**{**parts, **more})
        if not isinstance(found, int) or (found > 0) != wanted:
            failures.append(f"{what}, with {more}: {found} houses")


# Without doors nothing is asked but that landings lie free: 900 + 13 · 250 + 900 mm, and 900 mm, between the walls.
climb("a straight flight takes its steps and two landings", {}, dict(), dict(deep="5.249m"))
climb("it is as wide as it is", {}, dict(), dict(width="1.099m"))
# Half turn: 6 treads up and back, a landing of 900 mm: 1500 + 900 + 900 mm by 1800 mm.
climb("a flight with a half turn, too", dict(turn="turn half", width="2m"), dict(deep="3.5m"), dict(deep="3.499m"))
climb("across that it takes twice its width", dict(turn="turn half", deep="3.5m"), dict(width="2m"), dict(width="1.999m"))
# Quarter turn, between walls 3 m apart: 8 treads up with a landing, the corner, 4 treads on: 900 + 2000 + 900 mm by 900 + 1000 + 900 mm.
climb("a quarter turn goes along two walls", dict(turn="turn quarter", deep="3.2m"), dict(width="4m"), dict(width="3.999m"))
# Half turn with wedges: 4 treads up, 3 back, and 6 wedges in two squares: 1000 + 900 + 900 mm; with four wedges, 5 up and 4 back.
climb("wedges in the corners make a half turn shorter", dict(turn="turn half winders 3", width="2m"), dict(deep="3m"), dict(deep="2.999m"))
climb("two in each corner less so", dict(turn="turn half winders 2", width="2m"), dict(deep="3.25m"), dict(deep="3.249m"))
# Quarter turn with three wedges, between walls 3 m apart: 4 treads up, 6 on.
climb("wedges take the place of three treads in a quarter turn", dict(turn="turn quarter winders 3", deep="3.2m"), dict(width="3.5m"), dict(width="3.499m"))
# Spiral: 1.7 m, and before it two landings beside each other, as deep as half of that.
climb("a spiral is a square, with both landings at one side", dict(wide="1.7m", going="", turn="turn spiral", width="1.9m"), dict(deep="2.75m"), dict(deep="2.749m"))
climb("it is as wide as it is, too", dict(wide="1.7m", going="", turn="turn spiral", deep="2.75m"), dict(width="1.9m"), dict(width="1.899m"))
# A landing of 900 mm over an open side: upstairs half a partition stands there, and half a wall at the far side of the hall is no floor.
HALL = dict(trays="2", width="{w} | 4.35m", deep="1.1m", function="function hall at cell({w}) function stair at cell(4.35m)",
            faces="face cell(stair, ground) beside cell(hall) = open\n  face cell(any) beside cell(any) = wall\n  face cell(any) outside = wall")


def beside(width):
    return {**HALL, "width": HALL["width"].format(w=width), "function": HALL["function"].format(w=width)}


climb("a landing reaches over an open side onto a bare floor", {}, beside("950mm"), beside("949mm"))

# Doors at both sides, each of which is below the last two steps if the flight is on its side: 2 m are below the twelfth, which begins 1.5 m from the front.
climb("one passes beside a flight", dict(faces="face cell(any) outside back = door\n  face cell(any) outside front = door\n  face cell(any) outside = wall"),
      dict(width="1.9m"), dict(width="1.899m"))
climb("one stands below steps with headroom", dict(width="1.9m", near="near front 650mm", faces="face cell(any) outside left = door\n  face cell(any) outside right = door\n  "
      "face cell(any) outside = wall"), dict(headroom="2m"), dict(headroom="2.001m"))
# Doors of the upper storey at both sides, over the foot: the hole begins above the third step, 1.5 m from the back.
climb("one walks over the first steps up to the hole", dict(width="1.9m | 2m", trays="3", function="function hall at cell(2m) function stair at cell(1.9m)",
      rule="prune symmetric neighbour(beginning, tray(1.9m)) prune quantity(tray(1.9m), n > 1)",
      faces="face cell(stair, upper) beside cell(hall) = door\n  face cell(any) beside cell(any) = wall\n  face cell(any) outside = wall"),
      dict(near="near back 650mm"), dict(near="near back 651mm"))

print(asked, "rules,", len(failures), "fail")
print(*failures, sep="\n")
sys.exit(bool(failures))
