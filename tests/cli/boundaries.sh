#!/usr/bin/env bash
# Boundaries that are meshes: one without an inside is warned of, one that is made of a field bounds two rooms, and a wrong line of an OBJ
# file is named by its number.
# Needs the parts: mesh store
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failed=0
fail() { echo "boundaries: $*" >&2; failed=1; }

# ---- meshes without an inside: open ones, and edges of three faces
printf 'v -2 -2 0.5\nv 2 -2 0.5\nv 2 2 0.5\nv -2 2 0.5\nf 1 2 3 4\n' > open.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 2 5\n' > fins.obj
printf 'v -2 -2 -2\nv 2 -2 -2\nv 0 2 -2\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' > closed.obj
for mesh in open fins closed; do
  printf 'rules "square"\nsteps 1\nfitness height target 1\nboundary mesh "%s.obj" inside\n' "$mesh" > "$mesh.study"
  "$TARTAN" grow "$mesh.study" > /dev/null 2> err.txt || fail "$mesh is not grown in: $(cat err.txt)"
  if [ "$mesh" = closed ]; then
    grep -q W170 err.txt && fail "warns of a closed mesh"
  else
    grep -q "^$mesh.study:4:1: warning\[W170\].*nothing is inside" err.txt || fail "does not warn of $mesh: $(cat err.txt)"
  fi
  sed 's/ inside//' "$mesh.study" > outside.study
  "$TARTAN" grow outside.study 2>&1 | grep -q W170 && fail "warns of $mesh outside of it"
done
printf 'evolution {\n grammar "genr8-quads"\n grow "open.study"\n population 4\n generations 0\n}\n' > bred.study
"$TARTAN" evolve bred.study > /dev/null 2> err.txt || fail "does not breed in an open mesh: $(cat err.txt)"
grep -q 'warning\[W170\].*open.obj' err.txt || fail "breeding does not warn of an open mesh"

# ---- lines of OBJ files: the number of the first that is wrong; what is right is read, however it is written
says() { # LINE WORDS: of the file's text on standard input
  cat > wrong.obj
  printf 'rules "square"\nboundary mesh "wrong.obj"\n' > wrong.study
  "$TARTAN" grow wrong.study > /dev/null 2> err.txt && fail "takes an OBJ file with a wrong line $1"
  grep -q "line $1 of [^ ]*wrong.obj .*$2" err.txt || fail "does not name line $1 ($2): $(cat err.txt)"
}
printf 'v 0 0 0\nv 1 0 0\nf 1 2 9\n' | says 3 'vertex 9, and the file has 2'
printf '# a\nv 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n' | says 3 'without three numbers'
printf 'v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n' | says 2 'without three numbers'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 nan\nf 1 2 3\n' | says 3 'without three numbers'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n' | says 4 '`0`, which is no vertex'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 two 3\n' | says 4 '`two`, which is no vertex'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n' | says 4 '`-4`, which is no vertex'
printf 'o it\r\nvt 0 0\r\nvn 0 0 1\r\n v 0 0 0\r\nv 1 0 0 1.0\r\nv\t0 1 0\r\nf 1/1/1 2//1 3/1\r\nf -1 -2 -3 # back\r\nv 5 5 5\r\nusemtl f\r\n' > right.obj
printf 'rules "square"\nboundary mesh "right.obj"\n' > right.study
"$TARTAN" grow right.study > /dev/null 2> err.txt || fail "an OBJ file is not read: $(cat err.txt)"
exit "$failed"
