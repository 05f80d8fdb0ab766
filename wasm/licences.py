#!/usr/bin/env python3
"""Writes the licences of what a build for WebAssembly links in: licences.py OUT TARTAN-LICENSE SOURCES EMCC

They are read from the sources that the build was made of, and from emscripten's own folder."""
import os
import subprocess
import sys

out, own, sources, emcc = sys.argv[1:]
emscripten = subprocess.run(['em-config', 'EMSCRIPTEN_ROOT'], capture_output=True, text=True, check=True,
                            env={**os.environ, 'PATH': os.path.dirname(emcc) + ':' + os.environ['PATH']}).stdout.strip()


def first(*paths):
    """The first of the files that is there."""
    for path in paths:
        if os.path.exists(path):
            return path
    sys.exit(f'licences.py: there is none of {", ".join(paths)}')


DOC = '/usr/share/doc/emscripten'
parts = [
    ('Tartan', 'what this is', [own]),
    ("mini-gmp, of GMP", 'numbers of any size, under the LGPL (version 3 or later) or the GPL (version 2 or later), as you like; '
     'its sources are in the Debian source package gmp, unchanged, and wasm/gmp.c says how they are compiled',
     [f'{sources}/gmp/COPYING.LESSERv3', f'{sources}/gmp/COPYINGv2', f'{sources}/gmp/COPYINGv3']),
    ('Jansson', 'JSON', [f'{sources}/jansson/LICENSE']),
    ('xxHash', 'hashes', [f'{sources}/xxhash/LICENSE']),
    ('Zstandard', 'compression', [f'{sources}/libzstd/LICENSE']),
    ("emscripten's library", 'the C library (of musl) and what starts the engines',
     [first(f'{DOC}/copyright', f'{emscripten}/LICENSE')]),
]
with open(out + '.new', 'w', encoding='utf-8') as f:
    f.write("What these engines are made of, and its licences.\n\n")
    for name, what, _ in parts:
        f.write(f'- {name}: {what}\n')
    for name, _, files in parts:
        for path in files:
            f.write(f'\n\n{"=" * 100}\n{name}\n{"=" * 100}\n\n')
            with open(path, encoding='utf-8') as licence:
                f.write(licence.read())
os.replace(out + '.new', out)
