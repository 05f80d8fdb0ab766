"""Makes what the package is bound by: the extension module tartan._tartan, from the headers in include/tartan, and
tartan/_requests.py, from ask/session/requests.def. setup.py and CMake run it; run by itself, it writes both beside
itself; with --c SOURCE REQUESTS, the source of the module in C, and that, into these files.

The headers and libraries are those of this source tree and of the folder that TARTAN_BUILD names (build, unless it is
set); with TARTAN_INSTALLED=1 pkg-config says where they are."""
import os
import re
import subprocess
import sys

import cffi

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.path.dirname(HERE)
HEADERS = os.path.join(SOURCE, "include", "tartan")
LIBRARIES = ["tartan", "tartan-runtime", "tartan-growth", "tartan-mesh", "tartan-draw", "tartan-store"]

# What C calls of Python, and the interface by which frames of data take rows without copying them.
CALLED = """
extern "Python" bool tartan_python_go_on(void *, double, double);
extern "Python" void tartan_python_report(void *, const tartan_diagnostic *);
extern "Python" tartan_status tartan_python_evaluate(void *, unsigned, const tartan_sentence *, size_t, tartan_score *,
                                                     tartan_error *);
extern "Python" void tartan_python_free_schema(struct ArrowSchema *);
extern "Python" void tartan_python_free_array(struct ArrowArray *);
extern "Python" int tartan_python_get_schema(struct ArrowArrayStream *, struct ArrowSchema *);
extern "Python" int tartan_python_get_next(struct ArrowArrayStream *, struct ArrowArray *);
extern "Python" const char *tartan_python_last_error(struct ArrowArrayStream *);
extern "Python" void tartan_python_free_stream(struct ArrowArrayStream *);
void tartan_python_drop_stream(void *);
void *calloc(size_t, size_t);
"""

# https://arrow.apache.org/docs/format/CDataInterface.html: the layout is the interface.
ARROW = """
struct ArrowSchema {
    const char *format, *name, *metadata;
    int64_t flags, n_children;
    struct ArrowSchema **children, *dictionary;
    void (*release)(struct ArrowSchema *);
    void *private_data;
};
struct ArrowArray {
    int64_t length, null_count, offset, n_buffers, n_children;
    const void **buffers;
    struct ArrowArray **children, *dictionary;
    void (*release)(struct ArrowArray *);
    void *private_data;
};
struct ArrowArrayStream {
    int (*get_schema)(struct ArrowArrayStream *, struct ArrowSchema *);
    int (*get_next)(struct ArrowArrayStream *, struct ArrowArray *);
    const char *(*get_last_error)(struct ArrowArrayStream *);
    void (*release)(struct ArrowArrayStream *);
    void *private_data;
};
"""

SOURCE_TEXT = """
#include <stdlib.h>
#include <tartan/tartan.h>
""" + ARROW + """
/* The destructor of a capsule: a stream that nobody took is released here. */
static void tartan_python_drop_stream(void *capsule)
{
    struct ArrowArrayStream *stream = PyCapsule_GetPointer((PyObject *)capsule, "arrow_array_stream");
    if (stream && stream->release)
        stream->release(stream);
    free(stream);
}
"""


def read(*names):
    with open(os.path.join(*names), encoding="utf-8") as file:
        return file.read()


def declarations():
    """The headers' declarations as cffi reads them, in the order in which tartan.h needs them."""
    done, text = set(), []

    def add(name):
        if name in done:
            return
        done.add(name)
        header = read(HEADERS, name)
        for used in re.findall(r'^#include "(\w+\.h)"', header, re.M):
            add(used)
        text.append(header)

    add("tartan.h")
    joined = "".join(text)
    joined = re.sub(r"/\*.*?\*/", "", joined, flags=re.S)
    joined = re.sub(r"#define TARTAN_SIZED\(NAME\)(.*\\\n)*.*\n", "", joined)
    joined = re.sub(r"^TARTAN_SIZED\((\w+)\)", r"\1 \1_init(void);", joined, flags=re.M)
    joined = re.sub(r"#ifdef __cplusplus\n.*?#endif", "", joined, flags=re.S)
    joined = re.sub(r"#if defined\(__GNUC__\).*?#endif", "", joined, flags=re.S)
    joined = re.sub(r"^#define (TARTAN_\w+) (?:\d+u?|U?INT\d+_M(?:AX|IN))$", r"#define \1 ...", joined, flags=re.M)
    joined = re.sub(r"^#(?!define \w+ \.\.\.$).*$", "", joined, flags=re.M)
    return re.sub(r"\[TARTAN_\w+\]", "[...]", joined).replace("TARTAN_API ", "")


def functions(text):
    """The names of the functions that the declarations declare."""
    return sorted(set(re.findall(r"\b(tartan_\w+)\([^;()]*(?:\([^;()]*\)[^;()]*)*\);", re.sub(r"typedef [^;{]*;", "", text))))


def requests():
    """The questions and messages of requests.def, as the text of a Python module."""
    text = read(SOURCE, "ask", "session", "requests.def").split("/* ---- what questions", 1)[1]
    messages, questions = {}, {}
    string = r'"((?:[^"\\]|\\.)*)"'
    for kind, inside in re.findall(r"^TN_(\w+)\((.*?)\)$", text, re.M | re.S):
        words = [word.strip() for word in re.split(r'\s*,\s*(?=(?:[^"]*"[^"]*")*[^"]*$)', inside)]
        doc = words[-1].strip('"')
        if kind in ("MESSAGE", "TUPLE", "LISTING"):
            messages[words[0]] = (kind.lower(), doc, [])
        elif kind == "FIELD":
            messages[words[0]][2].append((words[3], words[1].lower(), words[2].lower(), None, doc))
        elif kind == "NUMBER":
            messages[words[0]][2].append((words[2], words[1].lower(), "count", None, doc))
        elif kind == "CHOICE":
            messages[words[0]][2].append((words[1], "defaulted", "text", None, doc))
        elif kind == "OF":
            messages[words[0]][2].append((words[4], words[1].lower(), words[2].lower(), words[3], doc))
        elif kind in ("QUESTION", "RUN_QUESTION"):
            questions[words[0]] = (words[1], tuple(words[2].strip('"').split()), doc)
    lines = ['"""Made by build_tartan.py from ask/session/requests.def: what questions are asked and answered with."""']
    lines.append("MESSAGES = {")
    lines += [f"    {name!r}: {(kind, doc, tuple(members))!r}," for name, (kind, doc, members) in messages.items()]
    lines += ["}", "QUESTIONS = {"]
    lines += [f"    {name!r}: {question!r}," for name, question in questions.items()]
    return "\n".join(lines + ["}", ""])


def write_requests(path):
    text = requests()
    if not os.path.exists(path) or read(path) != text:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)


def flags():
    """Where headers and libraries are, for the compiler."""
    if os.environ.get("TARTAN_INSTALLED") == "1":
        said = subprocess.run(["pkg-config", "--cflags", "--libs", "tartan"], check=True, capture_output=True, text=True)
        words = said.stdout.split()
        return {"include_dirs": [word[2:] for word in words if word.startswith("-I")],
                "library_dirs": [word[2:] for word in words if word.startswith("-L")],
                "libraries": LIBRARIES}
    build = os.path.join(SOURCE, os.environ.get("TARTAN_BUILD", "build"))
    rpath = os.environ.get("TARTAN_RPATH", build)
    return {"include_dirs": [os.path.join(SOURCE, "include")], "library_dirs": [build], "libraries": LIBRARIES,
            "extra_link_args": [f"-Wl,-rpath,{rpath}"] if rpath else []}


BY_HAND = sys.argv[1:2] != ["--c"]
write_requests(os.path.join(HERE, "tartan", "_requests.py") if BY_HAND else sys.argv[3])
ffi = cffi.FFI()
ffi.cdef(declarations() + ARROW + CALLED)
ffi.set_source("tartan._tartan", SOURCE_TEXT, py_limited_api=True, define_macros=[("Py_LIMITED_API", "0x03090000")],
               extra_compile_args=["-O2", "-w"], **flags())

if __name__ == "__main__":
    if BY_HAND:
        ffi.compile(HERE)
    else:
        ffi.emit_c_code(sys.argv[2])
