"""The C interface by ctypes against the command. A crash of the library is one of the process that asks it: c_interface.py LIBTARTAN FILE
LIBRARY RULE, which prints its answers as JSON and reads plan lines from standard input."""
import ctypes
import json
import os
import shutil
import subprocess
import sys

from program import TARTAN, Wrong, environment, read_json, same

ANY_LENGTH = 2**32 - 1
SEED, DRAWN = 7, 5


class Error(ctypes.Structure):
    _fields_ = [("status", ctypes.c_int), ("code", ctypes.c_uint32), ("column", ctypes.c_uint32), ("message", ctypes.c_char * 480),
                ("help", ctypes.c_char * 320)]


class Options(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("name", ctypes.c_char_p), ("max_states", ctypes.c_uint32), ("all_generated", ctypes.c_bool),
                ("trays_min", ctypes.c_uint32), ("trays_max", ctypes.c_uint32)]


class Refusal(Exception):
    pass


class Interface:
    """A library of a file, and a rule of it ("": none)."""

    def __init__(self, path, file, library, rule):
        self.c = ctypes.CDLL(path)
        self.c.tartan_library_schema.restype = self.c.tartan_rules_schema.restype = ctypes.c_void_p
        self.c.tartan_plans_next.restype = ctypes.c_bool
        self.module = self.made("tartan_compile_file", file.encode(), None)
        options = Options(ctypes.sizeof(Options), library.encode())
        self.library = self.made("tartan_library_open", self.module, ctypes.byref(options), None)
        self.schema = ctypes.c_void_p(self.c.tartan_library_schema(self.library))
        self.room = (ctypes.c_uint32 * max(1, self.c.tartan_library_max_trays(self.library)))()
        self.matcher = self.matcher_of(rule) if rule else None

    def call(self, name, *arguments):
        error = Error()
        if getattr(self.c, name)(*arguments, ctypes.byref(error)):
            raise Refusal(f"{name}: {error.message.decode()}")

    def made(self, name, *arguments):
        new = ctypes.c_void_p()
        self.call(name, *arguments, ctypes.byref(new))
        return new

    def text(self, name, *arguments):
        new = self.made(name, *arguments)
        text = ctypes.string_at(new).decode()
        self.c.tartan_text_free(new)
        return text

    def matcher_of(self, rule):
        names = (ctypes.c_char_p * 1)(rule.encode())
        return self.made("tartan_matcher_new", self.made("tartan_rules_new", self.module, names, ctypes.c_size_t(1), None))

    def count(self):
        return self.text("tartan_library_count", self.library, ctypes.c_uint32(ANY_LENGTH))

    def written(self, trays, length):
        return self.text("tartan_plan_write", self.schema, trays, ctypes.c_size_t(length))

    def read(self, line):
        length, size = ctypes.c_size_t(), len(line.encode())
        self.call("tartan_plan_read", self.schema, line.encode(), ctypes.c_size_t(size), self.room, ctypes.c_size_t(len(self.room)), ctypes.byref(length))
        return length.value

    def rank(self, line):
        return self.text("tartan_library_rank", self.library, self.room, ctypes.c_size_t(self.read(line)))

    def unrank(self, rank):
        length = ctypes.c_size_t()
        self.call("tartan_library_unrank", self.library, rank.encode(), self.room, ctypes.byref(length))
        return self.written(self.room, length.value)

    def matches(self, line):
        bits = ctypes.c_uint64()
        self.call("tartan_match", self.matcher, self.room, ctypes.c_size_t(self.read(line)), ctypes.byref(bits))
        return bits.value & 1

    def sample(self):
        plans = self.made("tartan_library_sample", self.library, ctypes.c_uint64(SEED), ctypes.c_uint32(ANY_LENGTH), ctypes.c_size_t(DRAWN))
        trays, length, lines = ctypes.POINTER(ctypes.c_uint32)(), ctypes.c_size_t(), []
        while self.c.tartan_plans_next(plans, ctypes.byref(trays), ctypes.byref(length)):
            lines.append(self.written(trays, length.value))
        return lines


def answers(interface, lines):
    ranks = [interface.rank(line) for line in lines]
    return {"count": interface.count(), "ranks": ranks, "plans": [interface.unrank(rank) for rank in ranks], "sample": interface.sample(),
            "matches": [interface.matches(line) for line in lines] if interface.matcher else []}


# ---- the question

def c_interface(subject):
    path = os.path.join(os.path.dirname(shutil.which(TARTAN) or ""), "libtartan.so")
    lines = [line for line in subject.lines or [] if line][-40:]
    if subject.houses or not lines or not os.path.exists(path) or "\nuse " in "\n" + subject.source.text:
        return
    rule = (subject.rules() or [""])[-1]
    found = asked(path, subject, rule, lines)
    if found is None:
        return
    same("count of the C interface", found["count"], str(subject.total))
    same("ranks of the C interface", found["ranks"], [str(subject.lines.index(line)) for line in lines])
    same("plans of ranks of the C interface", found["plans"], lines)
    # the interface leaves weights out
    same("sample of the C interface", found["sample"], subject.ask("sample", str(DRAWN), "--uniform", "--seed", str(SEED)).split("\n")[:-1])
    if rule:
        listed = set(subject.listed_where(rule))
        same("matches of the C interface", found["matches"], [int(line in listed) for line in lines])


def asked(path, subject, rule, lines):
    """The answers; None where the library is one that no other program can load, or refuses what takes too many states."""
    command = [sys.executable, "-B", os.path.abspath(__file__), path, subject.path, subject.item.name, rule]
    done = subprocess.run(command, input="\n".join(lines), capture_output=True, text=True, encoding="utf-8", timeout=120, env=environment())
    if "runtime does not come first" in done.stderr:
        return None
    if done.returncode:
        raise Wrong("the C interface ends", f"{done.returncode}: {done.stderr[-300:]}", "0")
    return read_json("answers of the C interface", done.stdout)


if __name__ == "__main__":
    print(json.dumps(answers(Interface(*sys.argv[1:5]), sys.stdin.read().split("\n"))))
