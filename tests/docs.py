#!/usr/bin/env python3
"""Runs the examples of Markdown pages: docs.py [--update] [--lacking] PAGE...

A ```console block holds commands (lines that start with "$ ") and under each what it prints, standard output and errors
together; a line "..." stands for any number of lines. A block of a notation's language (```plan; compiler/notations.def) is a rule file: it must
pass `tartan check`, and one whose first line is "# NAME.plan" ("// NAME.hemls") is there under that name for the commands below it. Each page runs in a copy of its own
folder. Links to files of the repository must lead somewhere. TARTAN is the binary. --update writes what is printed now into the pages.
--lacking is for a build that lacks parts: an example that needs one is passed over, and so is one behind it in its page that names a file
which that would have made. How many were is printed.
"""
import fnmatch, os, re, shutil, subprocess, sys, tempfile

TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "compiler", "notations.def")
LANGUAGES = set(re.findall(r'^[A-Z_]+\(\w+, "\.(\w+)"', open(TABLE).read(), re.M))
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.S | re.M)


def run(command, folder):
    path = os.path.dirname(os.path.abspath(os.environ["TARTAN"])) + os.pathsep + os.environ["PATH"]
    done = subprocess.run(["bash", "-c", command], cwd=folder, env=dict(os.environ, PATH=path, NO_COLOR="1", LC_ALL="C.UTF-8"),
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=300)
    return done.returncode, done.stdout.decode("utf-8", "replace")


def steps(block):
    """Yields (command, expected) of a console block."""
    command, expected = None, []
    for line in block.splitlines(keepends=True):
        if line.startswith("$ "):
            if command is not None:
                yield command, "".join(expected)
            command, expected = line[2:].rstrip("\n"), []
        else:
            expected.append(line)
    if command is not None:
        yield command, "".join(expected)


def agrees(expected, printed):
    pattern = "".join(r"(?:.*\n)*" if line == "...\n" else re.escape(line) for line in expected.splitlines(keepends=True))
    return re.fullmatch(pattern, printed) is not None


def complain(page, command, expected, printed):
    print("%s: $ %s\n--- the page says\n%s--- it prints\n%s---" % (page, command, expected, printed))


class Lacking:
    """What a build without some parts cannot show: examples that need one, and what needs a file that these would have made."""

    ABSENT = "was built without the part `", "no process can be started"

    def __init__(self, allowed):
        self.allowed, self.passed = allowed, 0
        self.begin("")

    def begin(self, folder):
        """A page is independent of others."""
        self.folder, self.stems, self.missing = folder, set(), set()

    def passes(self, command, expected, printed):
        """Is the example passed over that printed this and should have printed that?"""
        read, made = names_of(command)
        if not self.allowed or not (any(text in printed for text in self.ABSENT) or self.needs(command) or
                                    any(name in expected + printed for name in self.missing)):
            return False
        self.missing |= {name for name in read | made if not os.path.exists(os.path.join(self.folder, name))}
        self.stems |= {stem(name) for name in read | made}
        self.passed += 1
        return True

    def agreed(self, command):
        """What a command makes of files that are not there is not what it should be, though it says nothing."""
        if self.needs(command):
            self.missing |= names_of(command)[1]

    def needs(self, command):
        folders = {word for word in command.split() if os.path.isdir(os.path.join(self.folder, word))}
        return any(self.lacks(name) for name in names_of(command)[0] | folders)

    def lacks(self, name):
        """Would an example that was passed over have made this file? What is made of a.study without a name is a.run; a folder may be
        there and lack files."""
        path = os.path.join(self.folder, name)
        found = os.path.exists(path) and not os.path.isdir(path)
        return name in self.missing or not found and (stem(name) in self.stems or any(fnmatch.fnmatch(other, name) for other in self.missing))


def stem(name):
    return name.split("/")[0].split(".")[0]


def names_of(command):
    """The words of a command that look like the name of a file, of several, or of a folder: those that it reads, and those that it makes."""
    words = re.findall(r"[^\s\"'<>=|;&]+", command)
    made = {after.rstrip("/") for option, after in zip(words, words[1:]) if option in ("-o", "--run")} | set(re.findall(r">\s*([^\s;&|]+)", command))
    return {word.rstrip("/") for word in words if re.fullmatch(r"[\w%*?-][\w.%*?/-]*(\.[A-Za-z]\w*|/)", word)} - made, made


def console(page, block, folder, update, lacking):
    """Returns (the block as it should be, number of failures)."""
    out, failures = "", 0
    for command, expected in steps(block):
        _, printed = run(command, folder)
        if not agrees(expected, printed):
            if lacking.passes(command, expected, printed):
                pass
            elif update:
                expected = printed
            else:
                complain(page, command, expected, printed)
                failures += 1
        else:
            lacking.agreed(command)
        out += "$ " + command + "\n" + expected
    return out, failures


def rules(page, kind, block, folder):
    named = re.match(r"(?:#|//) (\S+\.%s)\n" % kind, block)
    name = named.group(1) if named else "block." + kind
    with open(os.path.join(folder, name), "w") as file:
        file.write(block)
    code, printed = run("tartan check " + name, folder)
    if code != 0:
        complain(page, "tartan check " + name, "", block + printed)
    return code != 0


def links(page, text):
    """How many links to files, or to headings of pages, lead nowhere."""
    failures = 0
    for path, heading in re.findall(r"\]\(([^)#\s:]*)(?:#([^)\s]*))?\)", re.sub(r"^```.*?^```$", "", text, flags=re.S | re.M)):
        target = os.path.normpath(os.path.join(os.path.dirname(page), path)) if path else page
        there = os.path.exists(target)
        if there and heading and target.endswith(".md"):
            found = re.findall(r"^#+ (.*)$", open(target).read(), re.M)
            there = heading in [re.sub(r"[^\w\- ]", "", h.strip().lower()).replace(" ", "-") for h in found]
        if not there:
            print("%s: the link to %s leads nowhere" % (page, path + ("#" + heading if heading else "")))
            failures += 1
    return failures


def check(page, update, lacking):
    text = open(page).read()
    failures = links(page, text)
    with tempfile.TemporaryDirectory() as top:
        folder = os.path.join(top, "here")
        if "examples" in page.split(os.sep):
            shutil.copytree(os.path.dirname(page), folder)
        else:
            os.mkdir(folder)
        lacking.begin(folder)

        def one(match):
            nonlocal failures
            kind, block = match.groups()
            if kind == "console":
                block, failed = console(page, block, folder, update, lacking)
                failures += failed
            elif kind in LANGUAGES:
                failures += rules(page, kind, block, folder)
            return "```%s\n%s```" % (kind, block)

        new = BLOCK.sub(one, text)
    if update and new != text:
        open(page, "w").write(new)
    return failures


def main(words):
    update, lacking = "--update" in words, Lacking("--lacking" in words)
    pages = [word for word in words if word not in ("--update", "--lacking")]
    if not pages or "TARTAN" not in os.environ:
        sys.exit(__doc__)
    failures = sum(check(page, update, lacking) for page in pages)
    if lacking.passed:
        print("%d examples need parts that this build lacks, or what these make" % lacking.passed)
    if failures:
        sys.exit("%d examples do not do what their page says" % failures)


if __name__ == "__main__":
    main(sys.argv[1:])
