#!/usr/bin/env bash
# Needs the parts: mesh store
# Files that change while they are read: the old content or an error, never a mix without a word. Each reader of plans, genomes and places; and
# those that read a file at one go: rules, modules, meshes.
# Slow under sanitizers.
name=changing
. "$(dirname "$0")/golden.bash"
shapes=$(cd "$here/../../bench" && pwd)/ten.plan
"$TARTAN" sample "$shapes" 300000 >"$scratch/whole.txt"
"$TARTAN" sample "$shapes" 60000 --format csv >"$scratch/whole.csv"
"$TARTAN" sample "$shapes" 60000 --format bin >"$scratch/whole.bin"
"$TARTAN" sample "$shapes" 60000 -o "$scratch/whole.sqlite"
python3 - "$TARTAN" "$shapes" "$scratch" <<'PYTHON' || fail 'see above'
import os, shutil, subprocess, sys, time
tartan, rules, scratch = sys.argv[1:]
wrong = []

def answers(path, threads):
    """What match says of the file: it is stopped before the last plans are read, as its reader has not taken what it wrote."""
    return subprocess.Popen([tartan, "match", rules, path, "--format", "names", "--threads", str(threads)],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, bufsize=0)

def shorten(path):
    os.truncate(path, os.path.getsize(path) * 3 // 4)

def lengthen(path):
    with open(path, "ab") as out:
        out.write(b"\n" * 100)

def rewrite(path):
    size = os.path.getsize(path)
    with open(path, "r+b") as out:
        out.seek(size - 2000)
        out.write(b"#" * 1000)

def replace(path):
    shutil.copy(path, path + ".new")
    shorten(path + ".new")
    os.rename(path + ".new", path)

for kind in "txt", "csv", "bin", "sqlite":
    whole = subprocess.run([tartan, "match", rules, f"{scratch}/whole.{kind}", "--format", "names"], stdout=subprocess.PIPE, check=True).stdout
    for change in shorten, lengthen, rewrite, replace:
        for threads in 1, 3:
            path = f"{scratch}/part.{kind}"
            shutil.copy(f"{scratch}/whole.{kind}", path)
            run = answers(path, threads)
            first = run.stdout.read(1)  # it has opened the file, and waits for its answers to be read
            time.sleep(0.05)
            change(path)
            rest, said = run.communicate()
            if first + rest == whole and run.returncode == 0:
                continue  # the old content
            if run.returncode == 0 or b"error[E" not in said:
                wrong.append(f"{kind}, {change.__name__}, {threads} threads: exit {run.returncode}, {said[-200:]}")
            elif change is replace:
                wrong.append(f"{kind}: another file of the same name is an error: {said[-200:]}")

print("\n".join(wrong))
sys.exit(1 if wrong else 0)
PYTHON

# Lines of genomes and of places, whose answers wait to be read.
stdlib=$(cd "$here/../../stdlib" && pwd)
seq -f '%g 1 2 3' 400000 >"$scratch/genomes"
seq -f '%g 1 2' 400000 >"$scratch/places"
for lines in "map $stdlib/words.bnf --genomes $scratch/genomes" "mesh $stdlib/primitives.field --points $scratch/places"; do
    file=${lines##* }
    cp "$file" "$scratch/kept"
    for change in shorten overwrite; do
        cp "$scratch/kept" "$file"
        rm -f "$scratch/go"
        mkfifo "$scratch/go"
        # shellcheck disable=SC2086
        "$TARTAN" $lines >"$scratch/go" 2>"$scratch/err" &
        {
            head -c 1 >/dev/null
            case $change in
            shorten) truncate -s 3000000 "$file" ;;
            overwrite) printf '8' | dd of="$file" conv=notrunc bs=1 seek=3500000 2>/dev/null ;;
            esac
            cat >/dev/null
        } <"$scratch/go"
        code=0
        wait $! || code=$?
        is "exit of $lines, $change" $code 3
        grep -q 'E0901.*was changed while it was read' "$scratch/err" || fail "$lines, $change: $(tail -n 1 "$scratch/err")"
    done
done

# What is read at one go: changed by the very process, right after its first look at it.
cat >"$scratch/meddle.c" <<'CODE'
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <stdio.h>
#include <unistd.h>
#include <sys/stat.h>
ssize_t read(int file, void *bytes, size_t size)
{
    static int done;
    ssize_t (*next)(int, void *, size_t) = (ssize_t (*)(int, void *, size_t))dlsym(RTLD_NEXT, "read");
    ssize_t got = next(file, bytes, size);
    struct stat read, known;
    const char *path = getenv("MEDDLE"), *how = getenv("MEDDLE_HOW");
    if (done || !path || fstat(file, &read) != 0 || stat(path, &known) != 0 || read.st_ino != known.st_ino || got <= 0)
        return got;
    done = 1;
    usleep(20000); /* so that the time of the change is another */
    int out = open(path, O_WRONLY);
    if (strcmp(how, "shorten") == 0 && ftruncate(out, known.st_size / 2) != 0)
        abort();
    if (strcmp(how, "overwrite") == 0 && pwrite(out, "0000", 4, known.st_size - 10) != 4)
        abort();
    close(out);
    if (strcmp(how, "replace") == 0) {
        char other[4096];
        snprintf(other, sizeof other, "%s.other", path);
        rename(other, path);
    }
    return got;
}
CODE
if ! nm -D "$TARTAN" | grep -q '__[at]san_init' && cc -shared -fPIC -w -o "$scratch/meddle.so" "$scratch/meddle.c"; then
    { cat "$files/sheds.plan"; for i in $(seq 4000); do echo "# a line that makes the file longer than one look, $i"; done; } >"$scratch/rules.plan"
    "$TARTAN" build "$scratch/rules.plan" -o "$scratch/rules.tnb"
    "$TARTAN" grow "$stdlib/square.hemls" -n 7 -o "$scratch/wall.obj"
    "$TARTAN" grow "$stdlib/square.hemls" -n 7 -o "$scratch/wall.stl"
    for mesh in obj stl; do
        printf 'rules "square"\nsteps 3\nboundary mesh "wall.%s"\n' $mesh >"$scratch/$mesh.study"
    done
    for run in "rules.plan count $scratch/rules.plan -l any-sheds" "rules.tnb count $scratch/rules.tnb -l any-sheds" \
        "wall.obj grow $scratch/obj.study" "wall.stl grow $scratch/stl.study"; do
        file=$scratch/${run%% *}
        cp "$file" "$scratch/kept"
        # shellcheck disable=SC2086
        "$TARTAN" ${run#* } >"$scratch/whole" 2>"$scratch/whole.err" || fail "$run: $(cat "$scratch/whole.err")"
        for how in shorten overwrite replace; do
            cp "$scratch/kept" "$file"
            cp "$scratch/kept" "$file.other"
            code=0
            # shellcheck disable=SC2086
            MEDDLE=$file MEDDLE_HOW=$how ASAN_OPTIONS="${ASAN_OPTIONS:-}:verify_asan_link_order=0" \
                LD_PRELOAD=$scratch/meddle.so "$TARTAN" ${run#* } >"$scratch/out" 2>"$scratch/err" || code=$?
            if [ $how = replace ]; then
                [ $code = 0 ] && cmp -s "$scratch/whole" "$scratch/out" || fail "$run, $how: exit $code, $(tail -n 2 "$scratch/err")"
            else
                [ $code = 3 ] && grep -q 'was changed while it was read' "$scratch/err" || fail "$run, $how: exit $code, $(tail -n 2 "$scratch/err")"
            fi
        done
        cp "$scratch/kept" "$file"
    done
fi
finish
