#!/usr/bin/env python3
"""Holds the sources to their structure: structure.py CHECKOUT COMPILER [INCLUDE FLAGS...]

The table of folders in docs/internals.md says which folder may include from which. This reads every #include and every tartan_folder() and
fails on an arrow that the table does not list (what the rows of a .def file name counts as an arrow, too), on a circle of folders, of
headers or of files, on a folder with too many files, on what has strayed into the root, on a type defined in two places, on a source file that does not say what it is, on
arrays that are grown by hand, and on headers that can't be included together. `--table` prints the rows that the includes ask for."""
import collections, os, re, subprocess, sys, tempfile

TOP = ("grammar", "compiler", "runtime", "driver", "ask", "api", "lsp", "studio", "cli", "mpi")
FILES_MAX = 40
# What stands at the root, besides the folders above: what a test or a trial wrote there is not kept.
ROOT = set(""".ci .clang-format .clang-tidy .gitignore CHANGELOG.md CMakeLists.txt CMakePresets.json CONTRIBUTING.md LICENSE Makefile README.md bench
cmake docs editors examples include packages.txt python stdlib tests tools wasm""".split())

# What is still wrong. Each line goes when its reason does; an exception that is not needed any more fails too.
ARROWS_UP = set()
CIRCLES = set()

problems = []


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def sources(root):
    for top in TOP:
        for folder, inside, names in os.walk(os.path.join(root, top)):
            inside[:] = [name for name in inside if name != "node_modules"]
            for name in sorted(names):
                if re.search(r"\.(c|h|cc|l|y|def)$", name):
                    yield os.path.relpath(os.path.join(folder, name), root)


def home(file):
    """The folder that a file belongs to: a notation's lexer and parser are a part of the notation's folder of the compiler."""
    folder = os.path.dirname(file)
    return "compiler/" + re.sub(r"\..*", "", os.path.basename(file)) if folder == "grammar" else folder


def includes(root, file):
    """The files of ours that a file includes; those that are generated lie beside it."""
    for name in re.findall(r'^\s*#\s*include\s+"([^"]+)"', read(os.path.join(root, file)), re.M):
        for path in (name, os.path.join(os.path.dirname(file), name)):
            if os.path.exists(os.path.join(root, path)):
                yield os.path.normpath(path)
                break


def definitions(root, files):
    """name -> the file that defines it, of functions and objects that others may use."""
    found = {}
    for file in files:
        if file.endswith((".c", ".cc")):
            text = re.sub(r"^#.*(?:\\\n.*)*|^static\b", "", read(os.path.join(root, file)), flags=re.M)
            for name in re.findall(r"^(?:[a-z][\w *]*[ *])(tn_\w+)\([^;{}]*\)\s*\{|^(?:[a-z][\w *]*[ *])(tn_\w+)(?:\[[^;={}]*\])* =", text, re.M):
                found[name[0] or name[1]] = file
    return found


def rows(text):
    """The rows of a .def file: (macro, its arguments)."""
    for match in re.finditer(r"^(\w+)\(", re.sub(r"/\*.*?\*/", "", text, flags=re.S), re.M):
        depth, arguments, at = 1, [""], match.end()
        plain = match.string
        while at < len(plain) and depth:
            piece = re.compile(r'"(?:\\.|[^"\\])*"|.', re.S).match(plain, at).group()
            at += len(piece)
            depth += (piece == "(") - (piece == ")")
            if piece == "," and depth == 1:
                arguments.append("")
            elif depth:
                arguments[-1] += piece
        yield match.group(1), [argument.strip() for argument in arguments]


def taken(root, file, defined):
    """The files that define what a file names by the rows of a .def file: tn_command_##NAME for each COMMAND(new)."""
    text = read(os.path.join(root, file))
    tables = [other for other in includes(root, file) if other.endswith(".def")]
    macros = collections.defaultdict(list)
    for name, parameters, body in re.findall(r"^\s*#\s*define (\w+)\(([^)]*)\)((?:.*\\\n)*.*)$", text, re.M) if tables else ():
        parameters = [parameter.strip() for parameter in parameters.split(",")]
        for before, parameter, behind in re.findall(r"\b(\w+)\s*##\s*(\w+)(?:\s*##\s*(\w+))?", body):
            if parameter in parameters:
                macros[name].append((before, parameters.index(parameter), behind))
    for other in tables:
        table_text = read(os.path.join(root, other))
        same = dict(re.findall(r"^#define (\w+) (\w+)$", table_text, re.M))  # a row's macro that is another one unless it is defined
        for macro, arguments in rows(table_text):
            for before, index, behind in macros.get(macro) or macros.get(same.get(macro), ()):
                name = before + arguments[index] + behind if index < len(arguments) else None
                if name in defined and defined[name] != file:
                    yield defined[name]


def table(root):
    """folder -> folders that it may use, by the table of docs/internals.md: | `path` | what it holds | `path`, `path` |"""
    rows = {}
    for folder, uses in re.findall(r"^\| `([a-z/]+)/` \|[^|]*\|([^|]*)\|$", read(os.path.join(root, "docs/internals.md")), re.M):
        rows[folder] = {use.rstrip("/") for use in re.findall(r"`([a-z/]+)/`", uses)}
    return rows


def notations(root):
    return re.findall(r'^[A-Z_]+\(([a-z]+), "\.', read(os.path.join(root, "compiler/notations.def")), re.M)


def targets(root):
    """folder -> folders that its CMake target uses."""
    found = {}
    for folder in sorted({file.split("/")[0] for file in sources(root)}):
        path = os.path.join(root, folder, "CMakeLists.txt")
        if not os.path.exists(path):
            continue
        text = re.sub(r"#.*", "", read(path))
        named = {name: words.split() for name, words in re.findall(r"\bset\((\w+) ([^)]*)\)", text)}
        named["notations"] = ["compiler/" + row for row in notations(root)]
        for body in re.findall(r"tartan_folder\(([^()]*(?:\$<[^>]*>)?[^()]*)\)", text):
            words, kept, uses = body.split(), [], False
            for word in words[1:]:
                if word in ("USES", "NEEDS", "EXTRA", "PART"):
                    uses = word == "USES"
                elif uses:
                    name = re.fullmatch(r"\$\{(\w+)\}", word)
                    kept += named[name.group(1)] if name else [word]
            found[words[0]] = set(kept) - {words[0]}
    return found


def circles(graph):
    """The strongly connected parts of more than one node (Tarjan)."""
    sys.setrecursionlimit(10000)
    order, low, stack, found = {}, {}, [], []

    def visit(node):
        order[node] = low[node] = len(order)
        stack.append(node)
        for other in sorted(graph.get(node, ())):
            if other not in order:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], order[other])
        if low[node] == order[node]:
            part = stack[stack.index(node):]
            del stack[stack.index(node):]
            if len(part) > 1:
                found.append(frozenset(part))

    for node in sorted(graph):
        if node not in order:
            visit(node)
    return found


def check_arrows(root, files):
    arrows, graph = collections.defaultdict(set), collections.defaultdict(set)
    by = {}
    for file in files:
        folder = home(file)
        for other in includes(root, file):
            used = os.path.dirname(other)
            if file.endswith((".h", ".def")):
                graph[file].add(other)
            if used != folder and not used.startswith("include/"):
                arrows[folder].add(used)
                by.setdefault((folder, used), file)
    defined = definitions(root, files)
    for file in files:
        for other in taken(root, file, defined) if file.endswith((".c", ".cc")) else ():
            if home(other) != home(file):
                arrows[home(file)].add(home(other))
                by.setdefault((home(file), home(other)), file)
    allowed, made = table(root), targets(root)
    if "--table" in sys.argv:
        for folder in sorted(arrows):
            print("| `%s/` | | %s |" % (folder, ", ".join("`%s/`" % use for use in sorted(arrows[folder])) or "-"))
        sys.exit(0)
    for folder in sorted({home(file) for file in files}):
        if folder not in allowed:
            problems.append("docs/internals.md has no row for %s/" % folder)
    for (folder, used), file in sorted(by.items()):
        if used not in allowed.get(folder, ()) and (folder, used) not in ARROWS_UP:
            problems.append("%s includes from %s/, which the table of docs/internals.md does not allow %s/" % (file, used, folder))
    for folder, uses in sorted(allowed.items()):
        for used in sorted(uses - arrows[folder]):
            problems.append("the table of docs/internals.md lets %s/ use %s/, and nothing there does" % (folder, used))
    for folder, uses in sorted(made.items()):
        arrow_up = {used for other, used in ARROWS_UP if other == folder}
        for used in sorted(uses ^ (allowed.get(folder, set()) | arrow_up)):
            if used in uses:
                problems.append("CMake lets %s use %s, the table of docs/internals.md does not" % (folder, used))
            else:
                problems.append("CMake does not let %s use %s, the table of docs/internals.md does" % (folder, used))
    for arrow in sorted(ARROWS_UP - set(by)):
        problems.append("%s does not include from %s any more: take it out of ARROWS_UP" % arrow)
    found = circles(arrows)
    for circle in found:
        if circle not in CIRCLES:
            problems.append("a circle of folders: " + ", ".join(sorted(circle)))
    for circle in CIRCLES - set(found):
        problems.append("this is no circle any more, take it out of CIRCLES: " + ", ".join(sorted(circle)))
    for circle in circles(graph):
        problems.append("a circle of headers: " + ", ".join(sorted(circle)))
    check_modules(root, files, defined)


def check_modules(root, files, defined):
    """A header and the file of its name are one module. No circle of modules goes through headers that other folders include: what a
    folder gives to others can be read from the bottom up. In cli/ there is none at all."""
    graph, public = collections.defaultdict(set), set()
    for file in files:
        module = re.sub(r"\.(c|cc|h)$", "", file)
        for other in [*includes(root, file), *(taken(root, file, defined) if file.endswith((".c", ".cc")) else ())]:
            used = re.sub(r"\.(c|cc|h)$", "", other)
            if used != module:
                graph[module].add(used)
            if home(other) != home(file):
                public.add(used)
    for circle in circles(graph):
        outside = sorted(circle & public)
        if len(outside) >= 2 or min(circle).startswith("cli/"):
            problems.append("a circle of files: " + ", ".join(sorted(circle)) + "; other folders include " + ", ".join(outside))


def check_root(root):
    """A checkout's own list of files, where there is one."""
    done = subprocess.run(["git", "-C", root, "ls-files"], capture_output=True, text=True)
    for name in sorted({line.split("/")[0] for line in done.stdout.splitlines()} - ROOT - set(TOP)):
        problems.append("%s is no file or folder of the root: tests/structure.py lists these" % name)


def check_sizes(files):
    for folder, count in collections.Counter(os.path.dirname(file) for file in files).items():
        if count > FILES_MAX:
            problems.append("%s/ has %d files; at most %d are found at a glance" % (folder, count, FILES_MAX))


def types_of(text):
    """The tn_ types that a file defines: structs, enums and unions with a body, and names of function types."""
    found = set(re.findall(r"^(?:typedef )?(?:struct|enum|union) (tn_\w+) ?\{", text, re.M))
    found |= set(re.findall(r"^\} ?(tn_\w+);", text, re.M))
    found |= set(re.findall(r"^typedef (?!struct|enum|union)[\w *]*?\b(tn_\w+)(?:\(|;)", text, re.M))
    return found


def check_names(root, files):
    places = collections.defaultdict(list)
    for file in files:
        for name in types_of(read(os.path.join(root, file))):
            places[name].append(file)
    for name, where in sorted(places.items()):
        if len(where) > 1:
            problems.append("the type %s is defined in %s" % (name, " and ".join(where)))


def says_what_it_is(root, file):
    """Itself, in a comment at its top; or its own header does, which it includes first."""
    text = read(os.path.join(root, file))
    if text.startswith("/*"):
        return True
    header = re.sub(r"\.\w+$", ".h", file)
    return text.startswith('#include "%s"' % header) and read(os.path.join(root, header)).startswith("/*")


GROWS = ("runtime/base/array.c", "compiler/common/lexical.h")  # the helper itself; flex asks for its own


def check_arrays(root, files):
    for file in files:
        if file not in GROWS and re.search(r"\brealloc\(", read(os.path.join(root, file))):
            problems.append("%s grows an array by hand: runtime/base/array.h does it" % file)


def check_openings(root, files):
    for file in files:
        if file.endswith((".c", ".cc", ".h", ".def")) and not says_what_it_is(root, file):
            problems.append("%s does not say what it is, in a comment at its top" % file)


def check_headers(root, files, compiler, flags):
    """One file that includes all headers compiles: no two of them clash."""
    headers = [file for file in files if file.endswith(".h")]
    with tempfile.TemporaryDirectory() as scratch:
        every = os.path.join(scratch, "every_header.c")
        with open(every, "w", encoding="utf-8") as out:
            out.writelines('#include "%s"\n' % header for header in headers)
        done = subprocess.run([compiler, "-std=c17", "-D_GNU_SOURCE", "-fsyntax-only", "-I", root, *flags, every], capture_output=True, text=True)
    if done.returncode:
        lines = [line for line in done.stderr.splitlines() if "error:" in line]
        problems.extend("all headers in one file: " + line for line in lines[:10])


root, compiler = sys.argv[1], sys.argv[2]
files = list(sources(root))
check_arrows(root, files)
check_root(root)
check_sizes(files)
check_names(root, files)
check_openings(root, files)
check_arrays(root, files)
check_headers(root, files, compiler, [flag for flag in sys.argv[3:] if flag.startswith("-")])
for problem in problems:
    print(problem)
sys.exit(1 if problems else 0)
