#!/usr/bin/env bash
# Needs the parts: draw mesh store
# What is installed serves a program elsewhere: by pkg-config and by CMake, shared and static; and it can be removed again.
set -euo pipefail
build=$(dirname "$TARTAN")
scratch=$(mktemp -d)
manifest=$build/install_manifest.txt
[ ! -e "$manifest" ] || cp "$manifest" "$scratch/manifest" # of an install that the user made
finish() {
    rm -f "$manifest"
    [ ! -e "$scratch/manifest" ] || mv "$scratch/manifest" "$manifest"
    rm -rf "$scratch"
}
trap finish EXIT
fail() {
    echo "$1"
    exit 1
}

prefix=$scratch/prefix
mkdir -p "$prefix/share/man/man1" # what was there before stays
touch "$prefix/share/man/man1/other.1"
cmake --install "$build" --prefix "$prefix" >/dev/null
libdir=$(dirname "$(find "$prefix" -name libtartan.a)")
export PKG_CONFIG_PATH=$libdir/pkgconfig LD_LIBRARY_PATH=$libdir
stdlib=$(pkg-config --variable=stdlibdir tartan)
[ -e "$stdlib/lahave.plan" ] || fail "pkg-config does not know where the standard library lies: $stdlib"
version=$(pkg-config --modversion tartan)
[ "$(pkg-config --modversion tartan-runtime)" = "$version" ] || fail 'the two libraries are of different versions'
case $("$prefix/bin/tartan" --version) in
*"$version"*) ;;
*) fail "the binary is not of version $version" ;;
esac
grep -q "define TARTAN_VERSION \"$version\"" "$prefix/include/tartan/base.h" || fail "the header is not of version $version"
[ -e "$libdir/libtartan.so.0.3" ] || fail 'the shared library has no versioned name'

# Only the public interface is visible, and what the libraries call of one another.
libraries=$(cd "$libdir" && ls libtartan*.so)
for library in $libraries; do
    other=$(nm -D --defined-only "$libdir/$library" | awk '{print $3}' |
        grep -vE '^tartan_[a-z_]*@@TARTAN_0\.3$|^tn_[A-Za-z0-9_.]*@@TARTAN_PRIVATE$|^TARTAN_|^_(init|fini)$|^__' || true)
    [ -z "$other" ] || fail "$library exports more than tartan_*: $other"
done

# Together they export exactly what the header declares, the runtime all but compiling; an addition or a loss shows in the list.
grep -hoE 'tartan_[a-z_]+\(' <<<"$(sed -n '/^TARTAN_API/,/;/p' "$prefix"/include/tartan/*.h)" | tr -d '(' | sort >"$scratch/declared"
exported() {
    for library in "$@"; do
        nm -D --defined-only "$libdir/$library"
    done | awk '$3 ~ /^tartan_/ {sub("@.*", "", $3); print $3}' | sort
}
exported $libraries >"$scratch/exported"
cmp "$scratch/declared" "$scratch/exported" || fail "the header and the libraries differ: $(comm -3 "$scratch/declared" "$scratch/exported")"
diff -u tests/cli/install/exported "$scratch/exported" || fail 'the libraries export other functions than tests/cli/install/exported says'
while read -r name; do
    grep -q "\`$name\`" docs/c-interface.md || fail "docs/c-interface.md does not name $name"
done <"$scratch/exported"
grep -oE '`tartan_[a-z_]+`' docs/c-interface.md | tr -d '`' | grep -vE '^tartan_(status|error|watch)$' | sort -u | comm -23 - "$scratch/exported" >"$scratch/gone"
[ ! -s "$scratch/gone" ] || fail "docs/c-interface.md names $(cat "$scratch/gone")"

# Who has which: a program links the parts that it needs.
has() { # LIBRARY PATTERN
    exported "$1.so" >"$scratch/has"
    grep -E "^tartan_($2)\$" "$scratch/exported" | cmp - "$scratch/has" ||
        fail "$1 lacks a function, or has one too many: $(grep -E "^tartan_($2)\$" "$scratch/exported" | comm -3 - "$scratch/has")"
}
files='mesh_(read|write|smooth|subdivide|decimate)'
has libtartan-growth '(growth|statistics)_[^d].*' # but drawing
has libtartan-mesh "$files"
has libtartan-draw '[a-z]*_draw'
has libtartan-store 'run_.*'
has libtartan '(ask|(compile|format|source|session|tests|coverage|houses?|stdlib)_.*)'
exported libtartan-{growth,mesh,draw,store}.so libtartan.so >"$scratch/parts"
exported libtartan-runtime.so | sort - "$scratch/parts" | cmp - "$scratch/exported" || fail 'libtartan-runtime lacks a function'

# Each needs what it is for, and no more.
needs() {
    objdump -p "$libdir/$1" | awk '/NEEDED/ {print $2}' | grep -oE '^lib(cairo|sqlite3|OpenMesh[A-Za-z]*|stdc\+\+|gmp|xxhash|jansson)' | sort | tr '\n' ' '
}
for library in libtartan-runtime libtartan-growth; do
    [ -z "$(needs $library.so | sed 's/libgmp //; s/libxxhash //')" ] || fail "$library needs $(needs $library.so)"
done

# Manual pages and completion stand where man and the shells look.
for command in $("$prefix/bin/tartan" help | sed -n '/^Commands:/,/^$/s/^  \([a-z-]*\) .*/\1/p'); do
    [ -s "$prefix/share/man/man1/tartan-$command.1" ] || fail "no manual page of $command"
done
for notation in house plans $(sed -nE 's/^[A-Z_]+\(.*, "([^"]+)", "[^"]*"\)$/\1/p' compiler/notations.def); do
    [ -s "$prefix/share/man/man5/tartan-$notation.5" ] || fail "no manual page of the notation $notation"
done
for file in man/man1/tartan.1 bash-completion/completions/tartan zsh/site-functions/_tartan fish/vendor_completions.d/tartan.fish; do
    [ -s "$prefix/share/$file" ] || fail "no share/$file"
done

# The header stands alone, also for C++.
echo '#include <tartan/tartan.h>' >"$scratch/alone.c"
cc -std=c99 -Wall -Wextra -Wpedantic -Werror -I"$prefix/include" -fsyntax-only "$scratch/alone.c"
c++ -x c++ -Wall -Wextra -Wpedantic -Werror -I"$prefix/include" -fsyntax-only "$scratch/alone.c"

# A sanitized library needs a sanitized program.
CC=$(sed -n 's/^CMAKE_C_COMPILER:[^=]*=//p' "$build/CMakeCache.txt")
export CC
read -ra flags <<<"$(sed -n 's/^CMAKE_C_FLAGS:[^=]*=//p' "$build/CMakeCache.txt")"
read -ra by_pkg_config <<<"$(pkg-config --cflags --libs tartan)"
read -ra for_static <<<"$(pkg-config --cflags tartan) $(pkg-config --static --libs tartan | sed -E "s:-l(tartan[a-z-]*):$libdir/lib\\1.a:g")"
cp examples/embed/embed.c examples/embed/narrow.plan "$scratch"
"$CC" "${flags[@]}" "$scratch/embed.c" "${by_pkg_config[@]}" -o "$scratch/shared"
"$CC" "${flags[@]}" "$scratch/embed.c" "${for_static[@]}" -o "$scratch/static"

cat >"$scratch/CMakeLists.txt" <<'LISTS'
cmake_minimum_required(VERSION 3.16)
project(embed C)
find_package(tartan 0.2 REQUIRED)
add_executable(with_cmake embed.c)
target_link_libraries(with_cmake PRIVATE tartan::tartan)
add_executable(with_cmake_static embed.c)
target_link_libraries(with_cmake_static PRIVATE tartan::tartan-static)
LISTS
cmake -S "$scratch" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_FLAGS="${flags[*]}" >/dev/null
cmake --build "$scratch/build" >/dev/null

printf "8' single public - dense:4' open:8' empty | 4' single - - dense:4' open:8' empty | 8' single - - dense:4' open:8' empty\n" >"$scratch/plans"
for program in shared static build/with_cmake build/with_cmake_static; do
    "$scratch/$program" "$scratch/narrow.plan" "$stdlib" <"$scratch/plans" >"$scratch/out.$(basename "$program")"
    cmp "$scratch/out.shared" "$scratch/out.$(basename "$program")"
done
grep -q '^corridor matches 8' "$scratch/out.shared" || fail 'the program did not match the plan'
grep -qE '^[0-9]+ plans, three of them:$' "$scratch/out.shared" || fail 'the program did not count the library'

# So does the program of the page.
sed -n '/^```c$/,/^```$/p' docs/c-interface.md | sed '/^```/d' >"$scratch/count.c"
"$CC" "${flags[@]}" -std=c99 -Wall -Wextra -Wpedantic "$scratch/count.c" "${by_pkg_config[@]}" -o "$scratch/count"
[ "$("$scratch/count" "$scratch/narrow.plan" "$stdlib")" = "$(sed -n 's/ plans, three of them:/ plans/p' "$scratch/out.shared")" ] ||
    fail 'the program of docs/c-interface.md counts otherwise'

# The programs of the other examples: a surface with its mesh and picture, and a run that is saved and goes on.
for name in growth evolution; do
    "$CC" "${flags[@]}" -std=c99 -Wall -Wextra -Wpedantic "examples/embed-$name/$name.c" "${by_pkg_config[@]}" -lm -o "$scratch/$name"
done
"$scratch/growth" examples/embed-growth/dome.study "$scratch/dome.obj" "$scratch/dome.svg" >"$scratch/dome" 2>/dev/null
grep -q '^step 5: 1089 vertices, 2112 edges, 1024 faces$' "$scratch/dome" || fail 'embed-growth grew another surface'
[ "$(grep -c '^f ' "$scratch/dome.obj")" = 1024 ] || fail 'embed-growth wrote another mesh'
grep -q '<svg' "$scratch/dome.svg" || fail 'embed-growth drew nothing'
"$scratch/evolution" examples/embed-evolution/sums.bnf 137 >"$scratch/sums"
[ "$(tail -1 "$scratch/sums" | sed 's/.* //' | tr + '\n' | awk '{s += $1} END {print s}')" = 137 ] || fail "embed-evolution found no sum: $(tail -1 "$scratch/sums")"
grep -q '^saved: [0-9]* bytes$' "$scratch/sums" || fail 'embed-evolution saved nothing'

"$CC" "${flags[@]}" -std=c99 -Wall -Wextra -Wpedantic examples/embed-houses/houses.c "${by_pkg_config[@]}" -o "$scratch/houses"
"$scratch/houses" examples/embed-houses/cottages.plan "$stdlib" "$scratch/cottage" >"$scratch/cottages"
grep -q '^[0-9]* houses$' "$scratch/cottages" || fail 'embed-houses counted nothing'
grep -q '^IFC' <<<"$(sed -n 's/^FILE_SCHEMA((.\(IFC4\).*/\1/p' "$scratch/cottage.ifc")" || fail 'embed-houses wrote no building model'
[ -s "$scratch/cottage.glb" ] && grep -q '<svg' "$scratch/cottage.svg" || fail 'embed-houses wrote no mesh, or drew nothing'

# The runtime alone runs a module.
"$prefix/bin/tartan" build "$scratch/narrow.plan" -o "$scratch/narrow.tnb"
cat >"$scratch/load.c" <<'PROGRAM'
#include <stdio.h>
#include <tartan/tartan.h>

int main(int argc, char **argv)
{
    tartan_error error;
    tartan_module *module;
    tartan_library *library;
    char *count;
    if (argc != 2 || tartan_module_load_file(argv[1], &module, &error) != TARTAN_OK ||
        tartan_library_open(module, NULL, NULL, &library, &error) != TARTAN_OK ||
        tartan_library_count(library, TARTAN_ANY_LENGTH, &count, &error) != TARTAN_OK)
        return 1;
    printf("%s plans, three of them:\n", count);
    tartan_text_free(count);
    tartan_library_free(library);
    tartan_module_free(module);
    return 0;
}
PROGRAM
read -ra runtime <<<"$(pkg-config --cflags --libs tartan-runtime)"
"$CC" "${flags[@]}" "$scratch/load.c" "${runtime[@]}" -o "$scratch/load"
[ "$("$scratch/load" "$scratch/narrow.tnb")" = "$(grep plans, "$scratch/out.shared")" ] || fail 'the runtime counts otherwise'

# Growing, writing a mesh and drawing need no compiler: the parts alone do it.
"$prefix/bin/tartan" build examples/embed-growth/dome.study -o "$scratch/dome.tnb"
cat >"$scratch/parts.c" <<'PROGRAM'
#include <stdio.h>
#include <tartan/tartan.h>

int main(int argc, char **argv)
{
    tartan_error error;
    tartan_module *module;
    tartan_growth *growth;
    tartan_mesh *mesh;
    void *file, *picture;
    size_t file_size, picture_size;
    if (argc != 2 || tartan_module_load_file(argv[1], &module, &error) != TARTAN_OK ||
        tartan_growth_new(module, NULL, &growth, &error) != TARTAN_OK ||
        tartan_growth_grow(growth, 3, NULL, &error) != TARTAN_OK ||
        tartan_growth_mesh(growth, NULL, &mesh, &error) != TARTAN_OK ||
        tartan_mesh_write(mesh, TARTAN_STL, NULL, NULL, &file, &file_size, &error) != TARTAN_OK ||
        tartan_growth_draw(growth, TARTAN_PNG, NULL, NULL, &picture, &picture_size, &error) != TARTAN_OK)
        return 1;
    printf("%zu %d\n", file_size, picture_size > 1000);
    tartan_bytes_free(file);
    tartan_bytes_free(picture);
    tartan_mesh_free(mesh);
    tartan_growth_free(growth);
    tartan_module_free(module);
    return 0;
}
PROGRAM
read -ra parts_alone <<<"$(pkg-config --cflags --libs tartan-growth tartan-mesh tartan-draw)"
[[ " ${parts_alone[*]} " != *' -ltartan '* ]] || fail 'the parts link the compiler'
"$CC" "${flags[@]}" "$scratch/parts.c" "${parts_alone[@]}" -o "$scratch/parts_alone"
[ "$("$scratch/parts_alone" "$scratch/dome.tnb")" = "$((84 + 50 * 2 * 64)) 1" ] || fail 'the parts alone do not grow the surface'

# A run that the command made is read back.
"$prefix/bin/tartan" evolve examples/rule-of-thumb/joists.study -o "$scratch/run" --generations 3 >/dev/null
cat >"$scratch/run.c" <<'PROGRAM'
#include <stdio.h>
#include <tartan/tartan.h>

int main(int argc, char **argv)
{
    tartan_error error;
    tartan_run *run;
    if (argc != 2 || tartan_run_open(argv[1], &run, &error) != TARTAN_OK)
        return 1;
    for (size_t i = 0; i < tartan_run_generations(run); i++) {
        tartan_generation generation = tartan_generation_init();
        if (tartan_run_generation(run, i, &generation, &error) != TARTAN_OK)
            return 1;
        printf("%u,%u,%llu\n", (unsigned)generation.number, (unsigned)generation.scored,
               (unsigned long long)generation.evaluations);
    }
    tartan_run_free(run);
    return 0;
}
PROGRAM
read -ra store <<<"$(pkg-config --cflags --libs tartan-store)"
"$CC" "${flags[@]}" "$scratch/run.c" "${store[@]}" -o "$scratch/read_run"
"$scratch/read_run" "$scratch/run/run.sqlite" >"$scratch/generations"
[ "$(cut -d, -f1 "$scratch/generations" | tr '\n' ' ')" = '0 1 2 3 ' ] || fail "the run has generations $(cat "$scratch/generations")"

# The installed binary finds the stdlib by itself; what was installed goes again.
"$prefix/bin/tartan" check "$scratch/narrow.plan"
cmake -DMANIFEST="$manifest" -P cmake/uninstall.cmake
left=$(cd "$prefix" && find . -type f -o -type l -o -name '*tartan*')
[ "$left" = ./share/man/man1/other.1 ] || fail "uninstalling left: $left"
