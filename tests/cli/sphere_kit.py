"""Writes a kit whose space is what the published program's ball of radius 8 leaves free of whole stud cells (2 x 3 x 2): sphere_kit.py SEARCH"""
import sys

free = {(x, y, z) for x in range(-8, 8) for y in range(-8, 8) for z in range(-8, 8) if x * x + y * y + z * z <= 49}
rows = {}
for x in range(-9, 9, 2):
    for y in range(-9, 9, 3):
        for z in range(-9, 9, 2):
            if all((x + i, y + j, z + k) in free for i in range(2) for j in range(3) for k in range(2)):
                rows.setdefault((y, z), []).append(x)
assert sum(map(len, rows.values())) == 77
boxes = ["box(%d, 24, 20) at (%d, %d, %d)" % (20 * len(xs), 10 * (xs[0] + xs[-1] + 2) // 2, -8 * (y + 3), 10 * z + 10) for (y, z), xs in rows.items()]
print('use "bricks";\nspace ball = %s;\nrule all at stud, tube = 3001 | 3003 | 3004 | 3005;' % "\n  or ".join(boxes))
print("model ball { inside ball; start stud at (0, 0, 0) by all; require components = 1, fill = 1; minimize elements; search %s; }" % sys.argv[1])
