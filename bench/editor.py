#!/usr/bin/env python3
"""How long an editor waits: drives `tartan lsp` over its protocol on a rule file, with an edit before every question.

usage: editor.py TARTAN FILE.plan ROUNDS

Prints a row a question: the median and the worst of the rounds, in milliseconds.
"""
import json
import subprocess
import sys
import time


class Client:
    def __init__(self, tartan):
        self.process = subprocess.Popen([tartan, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.requests = 0

    def send(self, **message):
        text = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(text) + text)
        self.process.stdin.flush()

    def receive(self):
        size = 0
        while (line := self.process.stdout.readline()) != b"\r\n":
            if not line:
                sys.exit("the server is gone")
            if line.lower().startswith(b"content-length:"):
                size = int(line.split(b":")[1])
        return json.loads(self.process.stdout.read(size))

    def ask(self, method, params):
        self.requests += 1
        self.send(id=self.requests, method=method, params=params)
        while (message := self.receive()).get("id") != self.requests:
            pass
        if "error" in message:
            sys.exit("%s: %s" % (method, message["error"]["message"]))

    def published(self, version):
        while True:
            message = self.receive()
            if message.get("method") == "textDocument/publishDiagnostics" and message["params"]["version"] == version:
                return


def main():
    tartan, path, rounds = sys.argv[1], sys.argv[2], int(sys.argv[3])
    text = open(path).read()
    lines = text.split("\n")
    middle = next(i for i, line in enumerate(lines) if i >= len(lines) // 2 and line.startswith("rule "))
    document = {"textDocument": {"uri": "file:///bench/rules.plan"}}
    name = {**document, "position": {"line": middle, "character": 6}}
    body = {**document, "position": {"line": middle, "character": len(lines[middle])}}
    everything = {"start": {"line": 0, "character": 0}, "end": {"line": len(lines), "character": 0}}
    questions = [
        ("diagnostics", None, None), ("hover", "hover", name), ("completion", "completion", body),
        ("definition", "definition", name), ("references", "references", {**name, "context": {"includeDeclaration": True}}),
        ("highlights", "documentHighlight", name), ("rename", "rename", {**name, "newName": "renamed"}),
        ("outline", "documentSymbol", document), ("formatting", "formatting", {**document, "options": {"tabSize": 2, "insertSpaces": True}}),
        ("quick fixes", "codeAction", {**document, "range": everything, "context": {"diagnostics": []}}),
    ]
    client, version = Client(tartan), 1
    client.ask("initialize", {})
    client.send(method="textDocument/didOpen", params={"textDocument": {**document["textDocument"], "languageId": "plan", "version": 1, "text": text}})
    client.published(1)

    def edit():
        nonlocal version
        version += 1
        end = {"line": len(lines), "character": 0}
        client.send(method="textDocument/didChange", params={
            "textDocument": {**document["textDocument"], "version": version},
            "contentChanges": [{"range": {"start": end, "end": end}, "text": "# typed\n"}]})

    def row(what, times):
        times.sort()
        print("%-30s %8.1f %8.1f" % (what, times[len(times) // 2] * 1000, times[-1] * 1000))

    for what, method, params in questions:
        times = []
        for _ in range(rounds):
            start = time.perf_counter()
            edit()
            if method:
                client.ask("textDocument/" + method, params)
            else:
                client.published(version)
            times.append(time.perf_counter() - start)
        row(what, times)
    client.ask("shutdown", None)
    client.send(method="exit")
    sys.exit(client.process.wait())


if __name__ == "__main__":
    main()
