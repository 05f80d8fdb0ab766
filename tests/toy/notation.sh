#!/usr/bin/env bash
# A notation that is one row and one file, with an engine that is its own file and rows, gets all commands: check, build, disasm, fmt,
# the helps and the language server. The modules that it builds are left in the folder $1, for the fuzz targets.
set -euo pipefail
fail() {
    echo "$1"
    exit 1
}
mkdir -p "$1"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
printf '# fruit\napples   3\nuse "more.toy"\n' >all.toy
printf 'pears 4\n' >more.toy
printf 'apples\n' >bad.toy

[ -z "$("$TARTAN" check all.toy all.toy 2>&1)" ] || fail 'check says something of a good file'
if "$TARTAN" check bad.toy 2>said; then fail 'check takes a bad file'; fi
grep -q '^bad.toy:1:1: error\[E0001\]: a line is a name and a number$' said || fail "check says $(cat said)"
printf 'use "moer.toy"\n' >lost.toy
if "$TARTAN" check lost.toy 2>said; then fail 'check takes a file that uses nothing there is'; fi
grep -q 'did you mean `more.toy`?' said || fail "a missing file: $(cat said)"
"$TARTAN" build all.toy -o all.tnb
[ -z "$("$TARTAN" check all.tnb 2>&1)" ] || fail 'check says something of the module'
for file in all.toy all.tnb; do
    "$TARTAN" disasm $file >listing
    grep -q 'more.toy' listing || fail "disasm $file does not list the sources"
    grep -q '^  counter 1  name "apples", start 0, code_begin 6, code_end 12$' listing || fail "disasm $file does not list the counters"
    grep -q '^ *6  COUNT_UP    3' listing || fail "disasm $file does not list the code"
    grep -q 'all.toy:2: apples   3' listing || fail "disasm $file does not show the source beside the code"
done
cp all.tnb "$1"
printf 'plums 0\n' >none.toy
if "$TARTAN" check none.toy 2>said; then fail 'check takes a number that is out of range'; fi
grep -q '^none.toy:1:7: error\[E0005\]: a number is from 1 to 1000000$' said || fail "check says $(cat said)"
if "$TARTAN" fmt --check all.toy 2>/dev/null; then fail 'fmt --check finds nothing'; fi
"$TARTAN" fmt all.toy
printf '# fruit\napples 3\nuse "more.toy"\n' | cmp - all.toy || fail "fmt made $(cat all.toy)"
printf 'plums  5\n' | "$TARTAN" fmt --notation toy - | grep -qx 'plums 5' || fail 'fmt --notation toy'
"$TARTAN" help fmt | grep -q '\.toy)' || fail 'help fmt does not name .toy'
"$TARTAN" help --completion bash | grep -qE "echo '[^']*\btoy'" || fail 'completion does not offer toy'
if "$TARTAN" test all.toy >/dev/null 2>said; then fail 'test takes it'; fi
grep -q 'it lists numbers by their names: `tartan grow` takes it' said || fail "test says $(cat said)"

timeout 60 python3 - "$TARTAN" <<'PYTHON' || fail 'the language server'
import json, subprocess, sys
server = subprocess.Popen([sys.argv[1], "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)

def send(**message):
    body = json.dumps(dict(message, jsonrpc="2.0")).encode()
    server.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))
    server.stdin.flush()

def answer(wanted):
    while True:
        size = int(server.stdout.readline().split(b":")[1])
        server.stdout.readline()
        body = json.loads(server.stdout.read(size))
        if wanted(body):
            return body

document = dict(uri="untitled:1")
send(id=1, method="initialize", params=dict(capabilities={}))
send(method="initialized", params={})
send(method="textDocument/didOpen", params=dict(textDocument=dict(document, languageId="toy", version=1, text="apples 3\npears\n")))
said = answer(lambda body: body.get("method") == "textDocument/publishDiagnostics")["params"]["diagnostics"]
assert [d["range"]["start"]["line"] for d in said] == [1] and said[0]["message"].startswith("a line is a name and a number"), said
send(id=2, method="textDocument/documentSymbol", params=dict(textDocument=document))
symbols = answer(lambda body: body.get("id") == 2)["result"]
assert [s["name"] for s in symbols] == ["apples", "pears"], symbols
send(id=3, method="shutdown")
send(method="exit")
assert server.wait(60) == 0
PYTHON
