"""Places models in steps and checks each: kit_steps.py TARTAN BRICKS.kit KIT...

In the order of building every part stands on the ground or joins what stands, and nothing that stands is above it; those for which that is
not so are as many as were warned of. A layer is a step; steps of n parts have n. A model in sub-files has the parts of the plain one."""
import os, re, subprocess, sys, tempfile

from kit_check import cells, read, studs, tubes

tartan, bricks, *kits = sys.argv[1:]


def place(kit, *more):
    done = subprocess.run([tartan, "place", kit, *more], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    warned = {"put in": 0, "joined": 0}
    for word in warned:
        for count in re.findall(r"warning\[W192\]: (\d+) parts? \S+ (?:be )?%s" % word, done.stderr):
            warned[word] += int(count)
    return warned


def sizes(path):
    """Parts of each step."""
    found, count = [], 0
    for line in open(path):
        count += line.startswith("1 ")
        if line.startswith("0 STEP"):
            found.append(count)
            count = 0
    assert count == 0
    return found


def check_order(parts, warned):
    ground = min(p[1] for p in parts)
    filled, pegs, holes, loose, hanging = set(), set(), set(), 0, 0
    for part in parts:
        own = cells(part)
        loose += part[1] != ground and not studs(part) & holes and not tubes(part) & pegs
        high = {}
        for x, y, z in own:
            high[x, z] = max(high.get((x, z), y), y)
        hanging += any((x, z) in high and y > high[x, z] for x, y, z in filled)
        filled |= own
        pegs |= studs(part)
        holes |= tubes(part)
    assert (hanging, loose) == (warned["put in"], warned["joined"]), (hanging, loose, warned)


checked = 0
with tempfile.TemporaryDirectory() as folder:
    plain, stepped, layered, files = (os.path.join(folder, n) for n in ("plain.ldr", "stepped.ldr", "layered.ldr", "files.mpd"))
    for kit in kits:
        place(kit, "-o", plain)
        wanted = sorted(read(plain))
        for size in (1, 3):
            warned = place(kit, "-o", stepped, "--steps", str(size))
            parts = read(stepped)
            assert sorted(parts) == wanted, kit
            check_order(parts, warned)
            assert sizes(stepped)[:-1] == [size] * ((len(parts) - 1) // size), kit
        place(kit, "-o", layered, "--steps", "layer")
        parts, at = read(layered), 0
        for size in sizes(layered):
            assert len({p[1] for p in parts[at : at + size]}) == 1, kit
            at += size
        place(kit, "-o", files)
        sub = [line for line in open(files) if line.startswith("1 ") and not line.endswith(".ldr\n")]
        assert sub == [line for line in open(layered) if line.startswith("1 ")], kit
        said = [subprocess.run([tartan, "inspect", f, "--kit", bricks, "--json"], capture_output=True, text=True) for f in (files, layered)]
        assert said[0].returncode == 0 and said[0].stdout == said[1].stdout, kit
        checked += len(parts)
print("%d parts of %d kits are in order" % (checked, len(kits)))
