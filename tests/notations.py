#!/usr/bin/env python3
"""Holds what lists notations to the table: notations.py compiler/notations.def editors/vscode TARTAN. Says what is missing."""
import json, os, re, subprocess, sys

ROW = re.compile(r'^[A-Z_]+\((\w+), "(\.\w+)", "(\w*)", "([^"]+)", "([^"]+)", "([^"]+)", "(\w*)", "([^"]*)"\)$', re.M)


def editor(folder, languages):
    package = json.load(open(os.path.join(folder, "package.json")))
    known = {one["id"]: one for one in package["contributes"]["languages"]}
    grammars = {one["language"]: one["path"] for one in package["contributes"]["grammars"]}
    for name in languages:
        if name not in known:
            yield "package.json has no language " + name
        elif known[name]["extensions"] != ["." + name]:
            yield "package.json gives %s other extensions than .%s" % (name, name)
        elif not os.path.exists(os.path.join(folder, known[name]["configuration"])):
            yield "the configuration of %s is not there" % name
        if name not in grammars:
            yield "package.json has no grammar of " + name
        elif not os.path.exists(os.path.join(folder, grammars[name])):
            yield "the grammar of %s is not there" % name
        if "." + name not in package["description"]:
            yield "package.json's description does not name ." + name
    for name in sorted(set(known) - set(languages)):
        yield "package.json has a language that is no notation: " + name


def helps(tartan, rows):
    def said(*words):
        return subprocess.run([tartan, "help", *words], stdout=subprocess.PIPE, check=True).stdout.decode()

    commands = re.findall(r"^  (\w+) ", said(), re.M)
    for name, extension, word, _, takes, page, _, _ in rows:
        for command in ("fmt", "lsp"):
            if not re.search(re.escape(extension) + r"\b", said(command)):
                yield "the help of %s does not name %s" % (command, extension)
        for command in takes.split():
            if command not in commands:
                yield "%s names the command %s, which there is not" % (name, command)
        if not os.path.exists(os.path.join("docs", page)):
            yield "there is no docs/%s, which %s names" % (page, name)


def main(table, folder, tartan):
    text = open(table).read()
    rows = ROW.findall(text)
    written = len(re.findall(r"^(?:FIRST_)?NOTATION\(|^VARIANT\(", text, re.M))
    if not rows or len(rows) != written:
        sys.exit("%d rows of %s are read, %d are written" % (len(rows), table, written))
    languages = [row[1][1:] for row in rows if not row[2]]
    missing = [*editor(folder, languages), *helps(tartan, rows)]
    print("\n".join(missing))
    sys.exit(bool(missing))


if __name__ == "__main__":
    main(*sys.argv[1:])
