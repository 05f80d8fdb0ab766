"""Placing by the C interface, through ctypes, against the command: c_place.py LIBTARTAN FOLDER FILE MODEL prints the LDraw file, or the number
of the error. A crash of the library is one of the process that asks it."""
import ctypes
import os
import re
import shutil
import subprocess
import sys

from c_interface import Error
from program import TARTAN, environment, same


SEED = 5
LIMITS = {"part-limit": 1500, "step-limit": 200000, "frame-limit": 1000, "lookahead-limit": 20000}
OPTIONS = [word for name, value in LIMITS.items() for word in (f"--{name}", str(value))]


class CompileOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("report", ctypes.c_void_p), ("report_context", ctypes.c_void_p), ("folders", ctypes.POINTER(ctypes.c_char_p)),
                ("folder_count", ctypes.c_size_t), ("resolve", ctypes.c_void_p), ("resolve_context", ctypes.c_void_p), ("warnings_are_errors", ctypes.c_bool),
                ("watch", ctypes.c_void_p), ("params", ctypes.c_void_p), ("param_count", ctypes.c_size_t)]


class PlaceOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("seed", ctypes.c_uint32), ("part_limit", ctypes.c_uint64), ("step_limit", ctypes.c_uint64),
                ("frame_limit", ctypes.c_uint64), ("lookahead_limit", ctypes.c_uint64), ("model", ctypes.c_char_p), ("search_limit", ctypes.c_uint64),
                ("threads", ctypes.c_uint32)]


def placed(library, stdlib, file, model):
    c, error = ctypes.CDLL(library), Error()
    folders = (ctypes.c_char_p * 1)(stdlib.encode())
    compiling = CompileOptions(ctypes.sizeof(CompileOptions), folders=folders, folder_count=1)
    placing = PlaceOptions(ctypes.sizeof(PlaceOptions), model=model.encode() or None, seed=SEED,
                           **{name.replace("-", "_"): value for name, value in LIMITS.items()})
    module, placement, text, size = ctypes.c_void_p(), ctypes.c_void_p(), ctypes.c_void_p(), ctypes.c_size_t()
    failed = c.tartan_compile_file(file.encode(), ctypes.byref(compiling), ctypes.byref(module), ctypes.byref(error)) or \
        c.tartan_place(module, ctypes.byref(placing), None, ctypes.byref(placement), ctypes.byref(error)) or \
        c.tartan_placement_ldraw(placement, ctypes.byref(text), ctypes.byref(size), ctypes.byref(error))
    return f"E{error.code:04}" if failed else ctypes.string_at(text, size.value).decode()


def library():
    """(libtartan, standard library) beside the command; None where the command is one that no other program can load."""
    folder = os.path.dirname(shutil.which(TARTAN) or "")
    path = os.path.join(folder, "libtartan.so")
    return (path, os.path.join(folder, "stdlib")) if os.path.exists(path) else None


def placed_by_interface(subject):
    """The interface places what the command does, or refuses by the same number."""
    if not library() or getattr(subject, "searched", False):
        return
    done = subprocess.run([sys.executable, "-B", os.path.abspath(__file__), *library(), subject.path, subject.part or ""], capture_output=True, text=True,
                          encoding="utf-8", timeout=120, env=environment())
    if "runtime does not come first" in done.stderr:
        return
    same("the C interface ends with", (done.returncode, done.stderr[-300:]), (0, ""))
    said, text = subject.ends_in()
    if said == "limit":
        return
    if text is None:
        same("the C interface refuses", done.stdout.strip(), said)
    else:
        same("parts placed by the C interface", re.findall("^1 .*$", done.stdout, re.M), re.findall("^1 .*$", text, re.M))


if __name__ == "__main__":
    sys.stdout.write(placed(*sys.argv[1:5]))
