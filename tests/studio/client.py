"""A client of tartan-studio without any library: the server as a process, requests byte by byte, sockets by hand (RFC 6455)."""
import base64
import json
import os
import re
import select
import signal
import socket
import struct
import subprocess
import time

PATIENCE = 30


class Server:
    """The program, which prints its address first."""

    def __init__(self, program, *words, **how):
        self.process = subprocess.Popen([program, "studio", *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **how)
        self.address = self.process.stdout.readline().strip()
        found = re.fullmatch(r"http://(127\.0\.0\.1:(\d+))/#([0-9a-f]{32})", self.address)
        if not found:
            raise AssertionError("it printed no address: %r; %s" % (self.address, self.process.stderr.read()))
        self.host, self.port, self.token = found.group(1), int(found.group(2)), found.group(3)

    def end(self, number=signal.SIGINT):
        self.process.send_signal(number)
        code = self.process.wait(PATIENCE)
        said = self.process.stderr.read()
        self.process.stdout.close()
        self.process.stderr.close()
        return code, said


def connect(port, family=socket.AF_INET):
    address = "127.0.0.1" if family == socket.AF_INET else "::1"
    made = socket.socket(family, socket.SOCK_STREAM)
    made.settimeout(PATIENCE)
    made.connect((address, port))
    return made


def ask(port, request, family=socket.AF_INET):
    """Sends bytes; the status (0: it hung up), the header's lines by name, the body."""
    with connect(port, family) as wire:
        wire.sendall(request)
        got = b""
        try:
            while True:
                more = wire.recv(65536)
                got += more
                head, end, body = got.partition(b"\r\n\r\n")
                length = re.search(rb"(?im)^content-length: *(\d+)", head)
                if not more or (end and (b" 101 " in head[:20] or (length and len(body) >= int(length.group(1))))):
                    break
        except ConnectionResetError:
            pass
    head, _, body = got.partition(b"\r\n\r\n")
    lines = head.decode("latin-1").split("\r\n")
    status = int(lines[0].split(" ")[1]) if lines[0].startswith("HTTP/") else 0
    return status, {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in lines[1:])}, body


def get(server, path="/", host=None, method="GET", more="", family=socket.AF_INET):
    host = server.host if host is None else host
    line = "Host: %s\r\n" % host if host else ""
    return ask(server.port, ("%s %s HTTP/1.1\r\n%s%s\r\n" % (method, path, line, more)).encode(), family)


def upgrade(server, host=None, origin=None, protocols=None, more="", path="/"):
    """The lines that ask for a socket; "" leaves one out."""
    host = server.host if host is None else host
    origin = "http://" + host if origin is None else origin
    protocols = "tartan.1, token." + server.token if protocols is None else protocols
    lines = ["GET %s HTTP/1.1" % path, "Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Version: 13",
             "Sec-WebSocket-Key: " + base64.b64encode(os.urandom(16)).decode()]
    for name, value in (("Host", host), ("Origin", origin), ("Sec-WebSocket-Protocol", protocols)):
        if value:
            lines.append("%s: %s" % (name, value))
    return ("\r\n".join(lines) + "\r\n" + more + "\r\n").encode()


class Closed(Exception):
    """The server closed the socket, with this code (0: without one)."""

    def __init__(self, code):
        super().__init__("closed with %d" % code)
        self.code = code


class Window:
    """A socket of a page, and what it says."""

    def __init__(self, server):
        self.wire = connect(server.port)
        self.wire.sendall(upgrade(server))
        self.bytes = b""
        while b"\r\n\r\n" not in self.bytes:
            more = self.wire.recv(4096)
            if not more:
                raise Closed(0)
            self.bytes += more
        head, _, self.bytes = self.bytes.partition(b"\r\n\r\n")
        if not head.startswith(b"HTTP/1.1 101 "):
            raise Closed(int(head.split(b" ")[1]))
        self.protocol = re.search(rb"(?im)^sec-websocket-protocol: *(\S+)", head).group(1).decode()
        self.next = 0
        self.notes = []
        self.parcels = {}  # messages of bytes, by their numbers

    def close(self):
        self.wire.close()

    # ---- frames

    def frame(self, data, opcode=1, last=True):
        size = len(data)
        head = bytes([opcode | (0x80 if last else 0)])
        if size < 126:
            head += bytes([0x80 | size])
        elif size < 65536:
            head += bytes([0x80 | 126]) + struct.pack(">H", size)
        else:
            head += bytes([0x80 | 127]) + struct.pack(">Q", size)
        self.wire.sendall(head + b"\0\0\0\0" + data)  # a mask of zeros changes nothing

    def read(self, size):
        while len(self.bytes) < size:
            more = self.wire.recv(1 << 16)
            if not more:
                raise Closed(0)
            self.bytes += more
        got, self.bytes = self.bytes[:size], self.bytes[size:]
        return got

    def message(self):
        """The next one that is a text, put together; what comes as bytes before it is kept."""
        whole, binary = b"", False
        while True:
            first, second = self.read(2)
            size = second & 127
            if size == 126:
                (size,) = struct.unpack(">H", self.read(2))
            elif size == 127:
                (size,) = struct.unpack(">Q", self.read(8))
            data = self.read(size)
            if first & 15 == 8:
                raise Closed(struct.unpack(">H", data[:2])[0] if size >= 2 else 0)
            if first & 15 == 9:
                self.frame(data, 10)
                continue
            whole += data
            binary = binary or first & 15 == 2
            if first & 0x80 and binary:
                number, size = struct.unpack_from("<II", whole)
                if number in self.parcels or size != len(whole) - 8:
                    raise AssertionError("bytes %d, of which %d are a file, have number %d" % (len(whole), size, number))
                self.parcels[number] = whole[8:]
                whole, binary = b"", False
            elif first & 0x80:
                return whole

    # ---- messages

    def tell(self, method, params):
        self.frame(json.dumps({"jsonrpc": "2.0", "method": method, "params": params}).encode())

    def send(self, method, params):
        self.next += 1
        self.frame(json.dumps({"jsonrpc": "2.0", "id": self.next, "method": method, "params": params}).encode())
        return self.next

    def receive(self):
        return json.loads(self.message())

    def answer(self, number):
        """To that request; notifications before it are kept."""
        while True:
            message = self.receive()
            if message.get("id") == number and "method" not in message:
                return message
            self.notes.append(message)

    def ask(self, method, params):
        return self.answer(self.send(method, params))

    def note(self, method):
        """The next notification of this method."""
        while True:
            for i, message in enumerate(self.notes):
                if message.get("method") == method:
                    return self.notes.pop(i)["params"]
            self.notes.append(self.receive())

    def silent(self, seconds):
        """Does nothing come for so long?"""
        return not self.bytes and not select.select([self.wire], [], [], seconds)[0]

    def begin(self):
        """As a page begins."""
        self.ask("initialize", {"processId": None, "rootUri": "file:///", "capabilities": {}})
        self.tell("initialized", {})

    def open(self, name, text, version=1):
        self.tell("textDocument/didOpen", {"textDocument": {"uri": "file:///" + name, "languageId": name.rpartition(".")[2], "version": version, "text": text}})

    def change(self, name, text, version):
        self.tell("textDocument/didChange", {"textDocument": {"uri": "file:///" + name, "version": version}, "contentChanges": [{"text": text}]})


def until(condition, seconds=PATIENCE):
    """Waits for it."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.05)
    return False
