#!/usr/bin/env python3
"""Compares the command as WebAssembly with the native one, byte by byte: same.py NATIVE WASM [--times]

Standard output, errors, the exit code, and files that are written ("@"). What needs a part that WebAssembly's lacks (E0907) is not asked.
Then what only WebAssembly's can get wrong: numbers of more than 32 bits where sizes have 32, pipes that are closed early, no memory left."""
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
import threading

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
EXAMPLES = os.path.join(SOURCE, 'examples')
ENVIRONMENT = {**os.environ, 'TARTAN_PATH': os.path.join(SOURCE, 'stdlib'), 'NO_COLOR': '1'}

ASKED = [
    ['--version'],
    ['check', 'lahave-houses'],
    ['count', 'lahave-houses', '--json'],
    ['count', 'cottage', '--library', 'cottages', '--json'],
    ['count', 'cottage', '--library', 'cottages', '--clauses'],
    ['count', 'terrace', '--by', 'floor-area', '--json'],
    ['count', 'row-houses', '--library', 'row-houses'],
    ['count', 'bricks', '--parts', '2', '--json'],
    ['sample', 'lahave-houses', '2000', '--seed', '5'],
    ['sample', 'cottage', '3', '--library', 'cottages', '--seed', '7'],
    ['enumerate', 'lahave-houses', '--limit', '1000', '--format', 'csv'],
    ['explain', 'lahave-houses', '#5000000000', '--full'],
    ['match', 'lahave', '@plans', '--rule', 'great-space', '--format', 'bits'],
    ['match', 'lahave', '@plans', '--format', 'json'],
    ['best', 'terrace', '5', '--most', 'floor-area'],
    ['grow', 'square', '-n', '7', '-o', '@.obj'],
    ['grow', os.path.join(EXAMPLES, 'growing-surfaces/shell.study'), '-o', '@.ply'],
    ['mesh', 'primitives', '--grid', '30', '-o', '@.obj'],
    ['mesh', os.path.join(EXAMPLES, 'implicit-surfaces/facade.field'), '--grid', '30', '-o', '@.glb'],
    ['mesh', 'table', '-o', '@.obj'],
    ['place', os.path.join(EXAMPLES, 'gatehouse/gatehouse.kit'), '-o', '@.ldr'],
    ['house', 'cottage', '#3', '--library', 'cottages', '-o', '@.ifc'],
    ['house', 'cottage', '#3', '--library', 'cottages', '-o', '@.obj'],
    ['house', 'cottage', '#3', '--library', 'cottages', '-o', '@.dxf'],
    ['map', 'genr8', '--random', '20', '--seed', '5'],
    ['draw', 'lahave', '--rule', 'great-space', '-o', '@.svg'],
    ['draw', 'lahave-houses', '--sample', '6', '--seed', '3', '-o', '@.svg'],
    ['sample', 'lahave-houses', '5000000000'],
    ['count', 'lahave-houses', '--max-states', '4294967297'],
    ['mesh', 'primitives', '--grid', '30', '--max-triangles', '4294967297', '-o', '@.obj'],
]


def run(command, file):
    """(exit code, output, errors, what was written), and the seconds of processor time"""
    command = [word.replace('@plans', os.path.dirname(file) + '/plans').replace('@', file) for word in command]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, env=ENVIRONMENT, timeout=600, stdin=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    written = b''
    for word in command:
        if word.startswith(file) and os.path.exists(word):
            with open(word, 'rb') as f:
                written = f.read()
            os.remove(word)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return (done.returncode, done.stdout, done.stderr.replace(file.encode(), b'@'), written), spent


def compare(native, wasm, folder, times):
    """How many commands differ."""
    differ = 0
    for words in ASKED:
        many = words[0] in ('count', 'grow') and '--parts' not in words or '--grid' in words
        threads = ['--threads', '1'] if many else []
        here, took = run([native, *words, *threads], folder + '/a')
        there, took_there = run([wasm, *words, *threads], folder + '/a')
        if b'E0907' in there[2]:
            print('passed over, as it needs a part:', ' '.join(words))
            continue
        if times:
            print(f'{" ".join(words)[-70:]:70} {took:6.2f} s native, {took_there:6.2f} s as WebAssembly')
        if here != there:
            differ += 1
            print('differs:', ' '.join(words))
            for what, a, b in zip(('exit code', 'output', 'errors', 'file'), here, there):
                if a != b:
                    print(f'  {what}: {a[:300] if isinstance(a, bytes) else a} native, {b[:300] if isinstance(b, bytes) else b}')
    return differ


def closed_pipes(wasm):
    """What is read in part ends as quietly as the native command."""
    wrong = 0
    for words in ('sample lahave-houses 20000 --seed 5', 'enumerate lahave-houses --limit 20000', 'grow square -n 7 --stats json'):
        done = subprocess.run(['bash', '-c', f'"$0" {words} | head -c 100 >/dev/null; exit ${{PIPESTATUS[0]}}', wasm], env=ENVIRONMENT,
                              capture_output=True, timeout=600)
        if done.returncode != 0 or done.stderr:
            wrong += 1
            print(f'a closed pipe: {words}: {done.returncode}, {done.stderr[:300]}')
    return wrong


def no_memory(wasm):
    """What needs more memory than there is says so."""
    done = subprocess.run([wasm, 'grow', 'square', '-n', '14'], env=ENVIRONMENT, capture_output=True, timeout=600)
    if done.returncode != 4 or b'E0841' not in done.stderr:
        print(f'a surface that is too large: {done.returncode}, {done.stderr[-300:]}')
        return 1
    return 0


def read_message(server):
    """The next message of a server, with its head; b'' if there is none within a minute."""
    waiting = threading.Timer(60, server.kill)
    waiting.start()
    head = server.stdout.readline() + server.stdout.readline()
    size = re.search(rb'Content-Length: (\d+)', head)
    body = server.stdout.read(int(size[1])) if size else b''
    waiting.cancel()
    return head + body


def language_server(native, wasm):
    """It answers, says what is wrong with a text, and ends, as the native one does."""
    text = 'schema s { room = a | b }\nrule x = tray(c)\nrule y = tray(a)\n'
    place = {'textDocument': {'uri': 'file:///a.plan'}, 'position': {'line': 2, 'character': 6}}
    messages = [('initialize', 1, {'capabilities': {}}), ('initialized', None, {}),
                ('textDocument/didOpen', None, {'textDocument': {'uri': 'file:///a.plan', 'languageId': 'plan', 'version': 1, 'text': text}}),
                ('textDocument/hover', 2, place), ('shutdown', 3, None), ('exit', None, None)]
    said = []
    for program in native, wasm:
        server, heard = subprocess.Popen([program, 'lsp'], env=ENVIRONMENT, stdin=subprocess.PIPE, stdout=subprocess.PIPE), b''
        for method, number, params in messages:
            message = {'jsonrpc': '2.0', 'method': method, 'params': params}
            if number:
                message['id'] = number
            body = json.dumps(message).encode()
            server.stdin.write(b'Content-Length: %d\r\n\r\n' % len(body) + body)
            server.stdin.flush()
            if method in ('initialize', 'textDocument/didOpen'):  # what is wrong is said once nothing else is to be done
                heard += read_message(server)
        said.append((heard + server.communicate(timeout=60)[0], server.returncode))
    if said[0] == said[1] and b'publishDiagnostics' in said[1][0]:
        return 0
    print(f'the language server: {said[1]} instead of {said[0]}')
    return 1


def main():
    native, wasm = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        with open(folder + '/plans', 'wb') as f:
            subprocess.run([native, 'sample', 'lahave-houses', '300'], env=ENVIRONMENT, stdout=f, check=True)
        wrong = compare(native, wasm, folder, '--times' in sys.argv) + closed_pipes(wasm) + no_memory(wasm) + language_server(native, wasm)
    if wrong:
        sys.exit(f'{wrong} commands do as WebAssembly what the native ones do not')
    print(f'{len(ASKED)} commands have the same bytes')


if __name__ == '__main__':
    main()
