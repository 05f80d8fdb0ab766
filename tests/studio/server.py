#!/usr/bin/env python3
"""The studio's server lets in whom it should and nobody else, keeps to its folder, and ends in order: server.py TARTAN

Each function is a case; the name of one, or of several, behind TARTAN runs those alone."""
import functools
import json
import os
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from client import Closed, Server, Window, ask, connect, get, until, upgrade

PLAN = """schema s { zone room = a | b }
rule two allow W019 = neighbour(tray(a), tray(a))
library all using s { trays 1..3 }
"""


class Failed(Exception):
    pass


CASES = {}


def case(run):
    CASES[run.__name__] = run
    return run


def equal(got, wanted, what):
    if got != wanted:
        raise Failed("%s: %r, not %r" % (what, got, wanted))


def true(good, what):
    if not good:
        raise Failed(what)


class Folder:
    """Files to be served, with what lies outside of them."""

    def __enter__(self):
        self.top = tempfile.mkdtemp()
        self.path = os.path.join(self.top, "served")
        os.makedirs(os.path.join(self.path, "deep", "er"))
        self.write("one.plan", PLAN)
        self.write("deep/er/two.plan", PLAN)
        with open(os.path.join(self.top, "outside.plan"), "w", encoding="utf-8") as file:
            file.write(PLAN)
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.top)

    def at(self, name):
        return os.path.join(self.path, name)

    def write(self, name, text):
        with open(self.at(name), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, name):
        with open(self.at(name), encoding="utf-8") as file:
            return file.read()


def served(*words, **how):
    """Runs a case with a folder and its server, which is to end at Ctrl-C with 0, and say nothing wrong."""

    def around(does):
        @functools.wraps(does)
        def run(program):
            with Folder() as folder:
                server = Server(program, "--no-open", *words, folder.path, **how)
                try:
                    does(server, folder)
                except BaseException:
                    server.process.kill()
                    raise
                code, said = server.end()
                equal(code, 0, "Ctrl-C")
                true("error" not in said and "Sanitizer" not in said, "it said: " + said)

        return case(run)

    return around


# ---- who is let in


@served()
def answers_the_page(server, folder):
    status, headers, body = get(server)
    equal(status, 200, "the page")
    true(b"<html" in body, "the page is no page")
    policy = headers["content-security-policy"]
    for part in ("default-src 'none'", "script-src 'self' 'wasm-unsafe-eval'", "style-src 'self'", "connect-src 'self'", "worker-src 'self'",
                 "img-src data: blob:", "frame-ancestors 'none'", "base-uri 'none'", "form-action 'none'"):
        true(part in policy.split("; "), "the policy lacks " + part)
    for name, value in (("x-content-type-options", "nosniff"), ("referrer-policy", "no-referrer"), ("cache-control", "no-store")):
        equal(headers[name], value, name)
    true(server.token.encode() not in body, "the page holds the token")
    status, packed, body = get(server, more="Accept-Encoding: gzip, deflate, br\r\n")
    equal(status, 200, "the page, packed")
    true("content-encoding" not in packed or body[:2] == b"\x1f\x8b", "it is not packed as it says")


@served()
def refuses_requests(server, folder):
    for host in ("", "evil.example:%d" % server.port, "127.0.0.1.example:%d" % server.port, "127.0.0.1", "127.0.0.1:%d" % (server.port + 1),
                 "localhost:%d" % server.port, server.host + "0", "0.0.0.0:%d" % server.port):
        status, headers, _ = get(server, host=host)
        true(status in (400, 421) if not host else status == 421, "the host %r: %d" % (host, status))
        true("content-security-policy" in headers or status == 400, "a refusal without a policy")
    equal(get(server, more="Host: %s\r\n" % server.host)[0], 421, "two hosts")
    for path in ("/index.html", "/../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "//etc/passwd", "/one.plan", "/" + "0" * 32, "/" + server.token,
                 "/" + "a" * 3000):
        true(get(server, path)[0] in (400, 403, 404, 414), "the path %s" % path[:60])
    for method in ("POST", "PUT", "HEAD", "DELETE", "OPTIONS", "PATCH", "CONNECT", "NONSENSE"):
        status, _, body = get(server, method=method)
        true(status in (0, 400, 403, 404, 405), "%s: %d" % (method, status))
        true(b"Tartan" not in body, "%s got the page" % method)
    equal(get(server, method="POST", more="Content-Length: 5\r\n", path="/")[0], 405, "POST")
    true(ask(server.port, b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03" + bytes(100) + b"\r\n\r\n")[0] in (0, 400, 403), "TLS")
    true(ask(server.port, b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n")[0] in (0, 400, 403, 404, 405, 421), "HTTP/2")
    equal(get(server)[0], 200, "the page after all that")


@served()
def lets_in(server, folder):
    window = Window(server)
    equal(window.protocol, "tartan.1", "the protocol that was chosen")
    window.close()
    if socket.has_ipv6:
        try:
            connect(server.port, socket.AF_INET6).close()
        except OSError:
            return  # this machine has no IPv6
        six = "[::1]:%d" % server.port
        equal(get(server, host=six, family=socket.AF_INET6)[0], 200, "::1")
        equal(ask(server.port, upgrade(server, host=six), socket.AF_INET6)[0], 101, "a socket by ::1")


@served()
def refuses_sockets(server, folder):
    good, token, zeros = "http://" + server.host, "token." + server.token, "token." + "0" * 32
    wrong = {
        "no origin": dict(origin=""),
        "the origin null": dict(origin="null"),
        "another origin": dict(origin="http://evil.example"),
        "a longer origin": dict(origin=good + ".example"),
        "another port": dict(origin="http://127.0.0.1:%d" % (server.port + 1)),
        "https": dict(origin="https://" + server.host),
        "the origin localhost": dict(origin="http://localhost:%d" % server.port),
        "no protocol": dict(protocols=""),
        "no token": dict(protocols="tartan.1"),
        "a wrong token": dict(protocols="tartan.1, " + zeros),
        "a short token": dict(protocols="tartan.1, " + token[:-1]),
        "a long token": dict(protocols="tartan.1, " + token + "0"),
        "a token in capitals": dict(protocols="tartan.1, token." + server.token.upper().replace("0", "O")),
        "the token first": dict(protocols=token + ", tartan.1"),
        "the token alone": dict(protocols=token),
        "two tokens": dict(protocols="tartan.1, %s, %s" % (zeros, token)),
        "another protocol": dict(protocols="other, " + token),
        "one more protocol": dict(protocols="tartan.1, %s, other" % token),
        "the page's protocol": dict(protocols="http, " + token),
    }
    for what, lines in wrong.items():
        equal(ask(server.port, upgrade(server, **lines))[0], 403, what)
    rebound = "evil.example:%d" % server.port
    equal(ask(server.port, upgrade(server, host=rebound, origin="http://" + rebound))[0], 421, "a name that points here")
    equal(ask(server.port, upgrade(server, host="[::1]:%d" % server.port, origin=good))[0], 403, "an origin that is not the host")
    true(ask(server.port, upgrade(server).replace(b"websocket", b"h2c"))[0] in (0, 400, 403), "h2c")
    true(ask(server.port, upgrade(server, path="/" + server.token, protocols="tartan.1"))[0] == 403, "the token in the path")
    Window(server).close()


@case
def knows_no_other_address(program):
    with Folder() as folder:
        server = Server(program, "--no-open", folder.path)
        for kind in ("tcp", "tcp6"):
            with open("/proc/%d/net/%s" % (server.process.pid, kind), encoding="ascii") as file:
                for line in file.readlines()[1:]:
                    local, state = line.split()[1], line.split()[3]
                    address, _, port = local.rpartition(":")
                    if state == "0A" and int(port, 16) == server.port:
                        true(address in ("0100007F", "0" * 24 + "01000000"), "it listens on " + address)
        equal(server.end()[0], 0, "the end")


# ---- messages


@served()
def speaks_lsp(server, folder):
    window = Window(server)
    window.begin()
    window.open("one.plan", "rule x = tray(")
    said = window.note("textDocument/publishDiagnostics")
    equal(said["uri"], "file:///one.plan", "whose errors")
    true(len(said["diagnostics"]) > 0, "no error is found")
    window.change("one.plan", PLAN, 2)
    while said["diagnostics"]:
        said = window.note("textDocument/publishDiagnostics")
    window.open("deep/er/user.plan", 'use "../../one.plan"\nlibrary more using s { trays 1..2 }\n')
    equal(window.note("textDocument/publishDiagnostics")["diagnostics"], [], "a file below uses one above")
    window.open("thief.plan", 'use "../outside.plan"\n')
    true("E0101" in json.dumps(window.note("textDocument/publishDiagnostics")), "a file outside is used")
    equal(window.ask("shutdown", None).get("result", 1), None, "shutdown")
    window.tell("exit", None)
    try:
        while True:
            window.message()
    except Closed as closed:
        equal(closed.code, 1000, "exit")


@served()
def refuses_wrong_messages(server, folder):
    window = Window(server)
    for text, code in ((b"{", -32700), (b"", -32700), (b"\xff\xfe", -32700), (b'{"a":"\\u0000"}', -32700), (b"[" * 100000, -32700),
                       (b"[]", -32600), (b"17", -32700), (b'"text"', -32700)):
        window.frame(text)
        answer = window.receive()
        equal((answer["id"], answer["error"]["code"]), (None, code), "the message %r" % text[:20])
    equal(window.ask("tartan/nothing", {})["error"]["code"], -32601, "a question that there is not")
    equal(window.ask("nothing", {})["error"]["code"], -32601, "a method that there is not")
    equal(window.ask("textDocument/hover", {})["error"]["code"], -32002, "before it began")
    for method in ("tartan/read", "tartan/write"):
        equal(window.ask(method, {})["error"]["code"], -32602, method + " of nothing")
        equal(window.ask(method, 17)["error"]["code"], -32602, method + " of a number")
        equal(window.ask(method, {"path": {"a": 1}})["error"]["code"], -32602, method + " of an object")
    equal(window.ask("tartan/write", {"path": "new.plan", "text": "", "hash": 17})["error"]["code"], -32602, "a hash that is none")
    equal(window.ask("tartan/watch", {"paths": "one.plan"})["error"]["code"], -32602, "paths that are none")
    equal(window.ask("tartan/watch", {"paths": [{}] * 257})["error"]["code"], -32602, "too many paths")
    window.tell("$/cancelRequest", {"id": 4711})
    window.frame(b'{"jsonrpc":"2.0","result":17}')
    equal(window.ask("tartan/files", {})["result"]["cut"], False, "after all that")
    window.frame(b"abc", opcode=2)
    try:
        window.message()
        raise Failed("a binary message is taken")
    except Closed as closed:
        equal(closed.code, 1003, "a binary message")


@served()
def takes_pieces(server, folder):
    window = Window(server)
    text = json.dumps({"jsonrpc": "2.0", "id": 1, "method": "tartan/read", "params": {"path": "one.plan"}}).encode()
    for i in range(len(text)):
        window.frame(text[i : i + 1], opcode=1 if i == 0 else 0, last=i == len(text) - 1)
    equal(window.receive()["result"]["text"], PLAN, "a message in pieces")
    window.frame(b"", opcode=9)
    equal(window.read(2), b"\x8a\x00", "ping")


@served()
def refuses_large_messages(server, folder):
    window = Window(server)
    text = "#" + "x" * (3 << 20) + "\n"
    result = window.ask("tartan/write", {"path": "large.plan", "text": text, "hash": None})["result"]
    equal(window.ask("tartan/read", {"path": "large.plan"})["result"]["text"], text, "three megabytes there and back")
    equal(window.ask("tartan/write", {"path": "large.plan", "text": text + "\n", "hash": result["hash"]})["result"]["path"], "large.plan", "again")
    for how in ("at once", "in pieces"):
        other = Window(server)
        try:
            if how == "at once":
                other.frame(b" " * ((4 << 20) + 1))
            else:
                other.frame(b" " * (3 << 20), last=False)
                other.frame(b" " * (3 << 20), opcode=0)
            other.message()
            raise Failed("too large, %s" % how)
        except Closed as closed:
            equal(closed.code, 1009, "too large, %s" % how)
        except (ConnectionResetError, BrokenPipeError):
            pass  # it was closed while that was still being sent
    folder.write("huge.plan", "#" * ((4 << 20) + 1))
    equal(window.ask("tartan/read", {"path": "huge.plan"})["error"]["data"]["code"], "E0804", "a file that is too large")


@served()
def limits_windows(server, folder):
    windows = [Window(server) for _ in range(64)]
    equal(ask(server.port, upgrade(server))[0], 503, "the 65th window")
    equal(get(server)[0], 200, "the page meanwhile")
    equal(windows[63].ask("tartan/files", {})["result"]["cut"], False, "the 64th window")
    for window in windows:
        window.close()
    true(until(lambda: ask(server.port, upgrade(server))[0] == 101), "a window after they were closed")


@served()
def gives_up_a_page_that_does_not_read(server, folder):
    folder.write("large.plan", "#" + "x" * (3 << 20) + "\n")
    window, other = Window(server), Window(server)
    for _ in range(12):
        window.send("tartan/read", {"path": "large.plan"})
    for i in range(20):
        equal(other.ask("tartan/files", {})["result"]["readOnly"], False, "another window meanwhile")
        time.sleep(0.4)
    try:
        for _ in range(12):
            window.message()
        raise Failed("all that was not read is kept")
    except (Closed, ConnectionResetError):
        pass
    other.ask("tartan/files", {})


# ---- questions


def count(window, name, version, subject=""):
    request = {"max_states": 1 << 30} if name == "slow.plan" else {}
    return window.send("tartan/count", {"uri": "file:///" + name, "version": version, "subject": subject, "request": request})


@served()
def answers_questions(server, folder):
    window = Window(server)
    window.begin()
    window.open("one.plan", PLAN)
    answer = window.answer(count(window, "one.plan", 1))["result"]
    equal((answer["version"], answer["uri"]), (1, "file:///one.plan"), "whose answer")
    equal(answer["answer"]["kept"], "14", "the count")
    equal(window.answer(count(window, "one.plan", 2))["error"]["code"], -32801, "of another version")
    window.change("one.plan", PLAN.replace("1..3", "1..2"), 2)
    equal(window.answer(count(window, "one.plan", 2))["result"]["answer"]["kept"], "6", "the count after a change")
    window.open("thief.plan", 'use "../outside.plan"\n' + PLAN)
    true("error" in window.answer(count(window, "thief.plan", 1)), "a question about a file that uses one outside")


SLOW = open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "slow.plan"), encoding="utf-8").read()


@served()
def limits_what_waits(server, folder):
    window = Window(server)
    window.begin()
    window.open("slow.plan", SLOW)
    count(window, "slow.plan", 1)
    try:
        for i in range(8):
            window.open("text%d.plan" % i, "#" + "x" * (3 << 20))
        while True:
            window.message()
    except Closed as closed:
        equal(closed.code, 1008, "more than is answered")
    except (ConnectionResetError, BrokenPipeError):
        pass  # it was closed while that was still being sent


@served()
def hangs_up_on_those_who_say_nothing(server, folder):
    silent = [connect(server.port) for _ in range(100)]
    half = connect(server.port)
    half.sendall(b"GET / HTTP/1.1\r\nHost: ")
    began = time.monotonic()
    equal(get(server)[0], 200, "the page meanwhile")
    for wire in silent + [half]:
        equal(wire.recv(1), b"", "a connection that says nothing")
    true(time.monotonic() - began < 15, "it took %.1f s" % (time.monotonic() - began))


@served()
def ends_questions(server, folder):
    window = Window(server)
    window.begin()
    window.open("slow.plan", SLOW)
    window.open("one.plan", PLAN)
    first = count(window, "slow.plan", 1, "a")
    second = count(window, "one.plan", 1, "b")
    third = count(window, "slow.plan", 1, "a")  # takes the place of the first
    fourth = count(window, "one.plan", 1, "b")  # and this that of the second, which waits
    window.tell("$/cancelRequest", {"id": third})
    answers = {}
    while len(answers) < 4:
        message = window.receive()
        if "id" in message:
            answers[message["id"]] = message
    for number in (first, second, third):
        equal(answers[number].get("error", {}).get("code"), -32800, "question %d" % number)
    true("result" in answers[fourth], "the last question")
    # a socket that is closed ends what is at work for it
    count(window, "slow.plan", 1)
    time.sleep(0.3)
    window.close()


@served()
def says_how_far_it_is(server, folder):
    window = Window(server)
    window.begin()
    window.open("slow.plan", SLOW)
    number = window.send("tartan/count", {"uri": "file:///slow.plan", "version": 1, "workDoneToken": "t", "request": {"max_states": 1 << 24}})
    begin, report = window.note("$/progress"), window.note("$/progress")
    equal([begin["token"], begin["value"]["kind"], report["value"]["kind"]], ["t", "begin", "report"], "the first two words")
    window.tell("$/cancelRequest", {"id": number})
    equal(window.answer(number).get("error", {}).get("code"), -32800, "the question")
    while (kind := window.note("$/progress")["value"]["kind"]) == "report":
        pass
    equal(kind, "end", "the last word")


@case
def limits_memory(program):
    with open(program, "rb") as file:
        if b"__asan_init" in file.read():
            return  # sanitizers take more than there is
    with Folder() as folder:
        server = Server(program, "--no-open", "--memory-limit", "150", folder.path)
        window = Window(server)
        window.begin()
        window.open("slow.plan", SLOW)
        equal(window.answer(count(window, "slow.plan", 1))["error"]["data"]["code"], "E0841", "a question that takes too much")
        equal(window.ask("tartan/files", {})["result"]["readOnly"], False, "the server after it")
        equal(server.end()[0], 0, "the end")


# ---- files


@served()
def lists_files(server, folder):
    folder.write("notes.txt", "")
    os.makedirs(folder.at(".hidden"))
    os.makedirs(folder.at("node_modules"))
    folder.write(".hidden/three.plan", PLAN)
    folder.write("node_modules/four.plan", PLAN)
    os.symlink("one.plan", folder.at("inside.plan"))
    os.symlink("../outside.plan", folder.at("out.plan"))
    os.symlink("..", folder.at("up"))
    os.mkfifo(folder.at("pipe.plan"))
    os.mkdir(folder.at("folder.plan"))
    answer = Window(server).ask("tartan/files", {})["result"]
    equal((answer["folder"], answer["readOnly"], answer["open"], answer["cut"]), (os.path.realpath(folder.path), False, None, False), "the folder")
    equal([(file["path"], file["size"], file["notation"]) for file in answer["files"]],
          [("deep/er/two.plan", len(PLAN), "plan"), ("inside.plan", len(PLAN), "plan"), ("one.plan", len(PLAN), "plan")], "the files")


@served()
def keeps_to_the_folder(server, folder):
    os.symlink("one.plan", folder.at("inside.plan"))
    os.symlink("../outside.plan", folder.at("out.plan"))
    os.symlink(os.path.join(folder.top, "outside.plan"), folder.at("absolute.plan"))
    os.symlink("..", folder.at("up"))
    os.symlink("loop.plan", folder.at("loop.plan"))
    os.symlink("/proc/self/root/etc/hostname", folder.at("magic.plan"))
    os.mkfifo(folder.at("pipe.plan"))
    os.mkdir(folder.at("folder.plan"))
    made = socket.socket(socket.AF_UNIX)
    made.bind(folder.at("socket.plan"))
    window = Window(server)
    equal(window.ask("tartan/read", {"path": "one.plan"})["result"]["text"], PLAN, "a file")
    equal(window.ask("tartan/read", {"path": "deep/er/two.plan"})["result"]["text"], PLAN, "a file in a folder")
    equal(window.ask("tartan/read", {"path": "inside.plan"})["result"]["text"], PLAN, "a link inside")
    outside = os.path.join(folder.top, "outside.plan")
    for path in ("../outside.plan", "deep/../../outside.plan", "deep/../one.plan", "./one.plan", outside, "/one.plan", "up/outside.plan", "out.plan",
                 "absolute.plan", "magic.plan", "loop.plan", "pipe.plan", "socket.plan", "folder.plan", "one.plan/", "", ".", "deep//er/two.plan", "nothing.plan",
                 "a" * 5000 + ".plan", "/etc/passwd", "../" * 40 + "etc/passwd", "notes.txt", "one.plan\n"):
        answer = window.ask("tartan/read", {"path": path})
        true("error" in answer and answer["error"]["message"], "%r can be read" % path[:60])
        answer = window.ask("tartan/write", {"path": path, "text": "", "hash": None})
        if path != "nothing.plan":
            true("error" in answer and answer["error"]["message"], "%r can be written" % path[:60])
    with open(outside, encoding="utf-8") as file:
        equal(file.read(), PLAN, "what lies outside")
    equal(sorted(os.listdir(folder.top)), ["outside.plan", "served"], "beside the folder")
    true(not [name for name in os.listdir(folder.path) if name.startswith(".tartan")], "something is left")
    made.close()


@served()
def writes_with_care(server, folder):
    window = Window(server)
    hash = window.ask("tartan/read", {"path": "one.plan"})["result"]["hash"]
    os.chmod(folder.at("one.plan"), 0o640)
    answer = window.ask("tartan/write", {"path": "one.plan", "text": "# é\n", "hash": hash})
    equal(folder.read("one.plan"), "# é\n", "what is written")
    equal(os.stat(folder.at("one.plan")).st_mode & 0o777, 0o640, "the rights")
    equal(window.ask("tartan/read", {"path": "one.plan"})["result"]["hash"], answer["result"]["hash"], "the hash")
    error = window.ask("tartan/write", {"path": "one.plan", "text": "", "hash": hash})["error"]
    equal((error["code"], error["data"]), (-32803, {"code": "conflict", "hash": answer["result"]["hash"]}), "over a newer one")
    equal(window.ask("tartan/write", {"path": "one.plan", "text": "", "hash": None})["error"]["data"]["code"], "conflict", "over one that is there")
    error = window.ask("tartan/write", {"path": "gone.plan", "text": "", "hash": hash})["error"]
    equal(error["data"], {"code": "conflict", "hash": None}, "over one that is gone")
    equal(folder.read("one.plan"), "# é\n", "after conflicts")
    answer = window.ask("tartan/write", {"path": "deep/new.plan", "text": PLAN, "hash": None})
    equal(folder.read("deep/new.plan"), PLAN, "a new file")
    true("error" in window.ask("tartan/write", {"path": "none/new.plan", "text": PLAN, "hash": None}), "a folder that there is not")
    os.symlink("one.plan", folder.at("link.plan"))
    hash = window.ask("tartan/read", {"path": "link.plan"})["result"]["hash"]
    true("a link" in window.ask("tartan/write", {"path": "link.plan", "text": "", "hash": hash})["error"]["message"], "a link is written")
    true(os.path.islink(folder.at("link.plan")), "the link is gone")
    if os.geteuid() != 0:
        os.chmod(folder.at("deep/new.plan"), 0o444)
        true("error" in window.ask("tartan/write", {"path": "deep/new.plan", "text": "", "hash": answer["result"]["hash"]}), "a file that may not be written")


@served("--read-only")
def writes_nothing_if_told(server, folder):
    before = sorted(os.walk(folder.path))
    window = Window(server)
    equal(window.ask("tartan/files", {})["result"]["readOnly"], True, "read only")
    hash = window.ask("tartan/read", {"path": "one.plan"})["result"]["hash"]
    for path, seen in (("one.plan", hash), ("new.plan", None)):
        true("read only" in window.ask("tartan/write", {"path": path, "text": "", "hash": seen})["error"]["message"], path)
    equal(folder.read("one.plan"), PLAN, "the file")
    equal(sorted(os.walk(folder.path)), before, "the folder")


@served(preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100000, 100000)))
def says_that_a_disk_is_full(server, folder):
    window = Window(server)
    error = window.ask("tartan/write", {"path": "new.plan", "text": "#" + "x" * 200000, "hash": None})["error"]
    equal(error["data"]["code"], "E0902", "a file that is not allowed")
    true("larger than is allowed" in error["message"], error["message"])
    equal(sorted(os.listdir(folder.path)), ["deep", "one.plan"], "what is left of it")


@served()
def tells_of_changes(server, folder):
    window, other = Window(server), Window(server)
    hash = window.ask("tartan/read", {"path": "one.plan"})["result"]["hash"]
    equal(window.ask("tartan/watch", {"paths": [{"path": "one.plan", "hash": hash}, {"path": "new.plan", "hash": None}]})["result"], None, "watching")
    true(window.silent(1.5), "a file that is as it was is told of")
    now = window.ask("tartan/write", {"path": "one.plan", "text": "# mine\n", "hash": hash})["result"]["hash"]
    true(window.silent(1.5), "the window's own change is told of")
    newer = other.ask("tartan/write", {"path": "one.plan", "text": "# other\n", "hash": now})["result"]["hash"]
    equal(window.note("tartan/changed"), {"path": "one.plan", "hash": newer}, "another window's change")
    folder.write("new.plan", PLAN)
    equal(window.note("tartan/changed")["path"], "new.plan", "a file that is there now")
    os.remove(folder.at("one.plan"))
    equal(window.note("tartan/changed"), {"path": "one.plan", "hash": None}, "a file that is gone")
    window.ask("tartan/watch", {"paths": []})
    folder.write("one.plan", PLAN)
    true(window.silent(1.5), "what is watched no more is told of")


@served()
def notices_changes_of_what_is_used(server, folder):
    window = Window(server)
    window.begin()
    window.open("user.plan", 'use "one.plan"\nlibrary more using s { trays 1..2 }\n')
    equal(window.note("textDocument/publishDiagnostics")["diagnostics"], [], "what is used")
    equal(window.answer(count(window, "user.plan", 1))["result"]["answer"]["kept"], "6", "the count")
    folder.write("one.plan", PLAN.replace("a | b", "a | b | c"))
    equal(window.note("tartan/changed")["path"], "one.plan", "which is changed")
    equal(window.answer(count(window, "user.plan", 1))["result"]["answer"]["kept"], "12", "the count after it")
    folder.write("one.plan", PLAN.replace("schema s", "schema t"))
    while "E0105" not in json.dumps(window.note("textDocument/publishDiagnostics")):
        pass
    os.remove(folder.at("one.plan"))
    while "E0901" not in json.dumps(window.note("textDocument/publishDiagnostics")):
        pass


@served()
def says_that_the_folder_is_gone(server, folder):
    window = Window(server)
    shutil.rmtree(folder.path)
    true("is gone" in window.ask("tartan/files", {})["error"]["message"], "a folder that is gone")
    true("error" in window.ask("tartan/read", {"path": "one.plan"}), "a file of it")
    true("error" in window.ask("tartan/write", {"path": "one.plan", "text": "", "hash": None}), "a file in it")


# ---- the program


@case
def begins_with_a_file(program):
    with Folder() as folder:
        for cwd, word, shown in ((folder.path, "one.plan", "one.plan"), ("/", folder.at("deep/er/two.plan"), "two.plan"), (folder.path, "./deep/er/two.plan", "two.plan")):
            server = Server(program, "--no-open", word, cwd=cwd)
            answer = Window(server).ask("tartan/files", {})["result"]
            equal((answer["open"], shown in [file["path"] for file in answer["files"]]), (shown, True), word)
            equal(server.end()[0], 0, "the end")
        server = Server(program, "--no-open", cwd=folder.path)
        equal(Window(server).ask("tartan/files", {})["result"]["folder"], os.path.realpath(folder.path), "the current folder")
        equal(server.end(signal.SIGTERM)[0], 0, "SIGTERM")


@case
def refuses_to_begin(program):
    def fails(*words):
        done = subprocess.run([program, "studio", "--no-open", *words], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=30)
        return done.returncode, done.stderr

    with Folder() as folder:
        folder.write("notes.txt", "")
        server = Server(program, "--no-open", folder.path)
        code, said = fails("--port", str(server.port), folder.path)
        true(code == 3 and "error[E0909]: the port %d is taken" % server.port in said, "a port that is taken: " + said)
        equal(server.end()[0], 0, "the end")
        code, said = fails(folder.at("nothing"))
        true(code == 3 and "error[E0901]" in said, "a folder that there is not: " + said)
        code, said = fails(folder.at("notes.txt"))
        true(code == 2 and "error[E0904]" in said, "a file of no notation: " + said)
        for words in (("--port", "0"), ("--port", "65536"), ("--port", "x"), ("a", "b"), ("--nothing",)):
            equal(fails(*words)[0], 2, "the words %r" % (words,))
        code, said = fails("--diagnostics=json", folder.at("nothing"))
        equal((code, json.loads(said)[0]["code"]), (3, "E0901"), "in JSON")


@case
def names_the_package(program):
    with tempfile.TemporaryDirectory() as folder:
        alone = os.path.join(folder, "tartan")
        shutil.copy(program, alone)
        done = subprocess.run([alone, "studio"], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=30)
        true(done.returncode == 1 and "error[E0908]" in done.stderr and "package tartan-studio" in done.stderr, "without the server: " + done.stderr)


@case
def opens_the_browser(program):
    with Folder() as folder:
        tools = os.path.join(folder.top, "tools")
        os.mkdir(tools)
        asked = os.path.join(folder.top, "asked")
        opener = os.path.join(tools, "xdg-open")
        with open(opener, "w", encoding="ascii") as file:
            file.write('#!/bin/sh\nprintf %%s "$1" >%s.part && mv %s.part %s\n' % (asked, asked, asked))
        os.chmod(opener, 0o755)
        paths = dict(os.environ, PATH=tools + ":" + os.environ["PATH"])
        server = Server(program, folder.path, env=paths)
        true(until(lambda: os.path.exists(asked)), "no browser is opened")
        with open(asked, encoding="ascii") as file:
            address = file.read()
        begins = "http://%s/" % server.host
        true(address.startswith(begins) and server.token not in address, "the address that programs can see: " + address)
        path = address[len(begins) - 1 :]
        equal(get(server, path, host="evil.example")[0], 421, "the address from elsewhere")
        status, headers, _ = get(server, path)
        equal((status, headers.get("location")), (303, "/#" + server.token), "where it leads")
        equal(get(server, path)[0], 404, "a second time")
        equal(server.end()[0], 0, "the end")
        with open(opener, "w", encoding="ascii") as file:
            file.write("#!/bin/sh\nexit 3\n")
        server = Server(program, folder.path, env=paths)
        true(server.process.stderr.readline() and "no browser was opened" in server.process.stderr.readline(), "a browser that does not open")
        equal(server.end()[0], 0, "the end")
        server = Server(program, folder.path, env=dict(os.environ, PATH="/nowhere"))
        time.sleep(0.2)
        true("no browser was opened" in server.end()[1], "no browser")


@case
def ends_with_windows(program):
    """Also while something is at work, and with a second Ctrl-C."""
    with Folder() as folder:
        server = Server(program, "--no-open", folder.path)
        windows = [Window(server) for _ in range(8)]
        for window in windows:
            window.begin()
            window.open("slow.plan", SLOW)
            count(window, "slow.plan", 1)
        time.sleep(0.3)
        began = time.monotonic()
        equal(server.end()[0], 0, "Ctrl-C while something is at work")
        true(time.monotonic() - began < 20, "the end took %.1f s" % (time.monotonic() - began))


def main():
    failed = 0
    for name, run in CASES.items():
        if sys.argv[2:] and name not in sys.argv[2:]:
            continue
        try:
            run(os.path.abspath(sys.argv[1]))
        except (Failed, Closed, AssertionError, OSError, LookupError, subprocess.TimeoutExpired) as wrong:
            print("FAILED: %s: %s: %s" % (name, type(wrong).__name__, wrong))
            failed = 1
    sys.exit(failed)


main()
