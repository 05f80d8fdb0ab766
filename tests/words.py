#!/usr/bin/env python3
"""Holds what knows words to their table: words.py TARTAN FOLDER [ROWS]. With ROWS it asks about .plan alone, and of
these rows, too.

The folder's files are laid out and have each word in each of its meanings. Of every word in them this asks: does the formatter
put no blank before its parenthesis, do editors offer it there and say its sentence, and is it suggested where it is misspelled? Says
what does not follow the table. What is made from the table, `tools/words --check` compares."""
import json, os, re, shutil, subprocess, sys, tempfile
from importlib.machinery import SourceFileLoader

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
words = SourceFileLoader("words", os.path.join(ROOT, "tools/words")).load_module()
UNTOLD = {"flag", "i", "least"}  # misspelled, the first is a value of its field; of the next it is said what the age is called; of `at` what follows it


class Server:
    """The language server, with one document open."""

    def __init__(self, tartan, path, text):
        self.process = subprocess.Popen([tartan, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.document, self.text, self.number = {"uri": "file://" + os.path.abspath(path)}, text, 0
        self.ask("initialize", {"capabilities": {}})
        self.send(method="initialized", params={})
        self.send(method="textDocument/didOpen", params={"textDocument": dict(self.document, languageId=path.rsplit(".", 1)[1], version=1, text=text)})

    def send(self, **message):
        body = json.dumps(dict(message, jsonrpc="2.0")).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))
        self.process.stdin.flush()

    def ask(self, method, params):
        self.number += 1
        self.send(id=self.number, method=method, params=params)
        while True:
            size = int(self.process.stdout.readline().split(b":")[1])
            self.process.stdout.readline()
            body = json.loads(self.process.stdout.read(size))
            if body.get("id") == self.number:
                return body.get("result")

    def at(self, what, offset):
        before = self.text[:offset]
        position = {"line": before.count("\n"), "character": offset - before.rfind("\n") - 1}
        return self.ask("textDocument/" + what, {"textDocument": self.document, "position": position})

    def close(self):
        self.ask("shutdown", None)
        self.send(method="exit")
        return self.process.wait(60)


def run(tartan, *arguments, text=None):
    done = subprocess.run([tartan, *arguments], input=text, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8")
    return done.stdout, done.stderr


def occurrences(text, known):
    """The places of words in a text, comments and texts in quotes left out."""
    for found in re.finditer(r"#[^\n]*|(?<![0-9/ ])\"[^\"\n]*\"|(?<= )\"[^\"\n]*\"|[A-Za-z_][\w-]*", text):
        if found.group() in known:
            yield found.start(), found.group()


def consistent(table):
    """A keyword has to be read where it may stand."""
    top = {"RULES", "OPENING", "WALK", "LATER"}
    by_place = any(table.reads.values())
    for row in table.words:
        name, is_read = row.token == "NAME", bool(row.read) if by_place else row.token != "NAME"
        if not row.places or name != (row.use in ("NAMED", "VALUE")) or name == is_read:
            yield "the row of `%s` says two things" % row.text
        for place in row.places if row.read else ():
            read = table.reads[place]
            if read and not row.read & (top if "RULES" in read else read):
                yield "`%s` may stand in %s, and the lexer does not read it there" % (row.text, place)


def laid_out(tartan, notation, text):
    return run(tartan, "fmt", "--notation", notation, "-", text=text)[0]


def layout(tartan, notation, text, places, table):
    for offset, word in places:
        end = offset + len(word)
        if text[end:end + 1] == "(" and any(row.use in ("CALL", "SPELLING") for row in table.rows(word)):
            if laid_out(tartan, notation, text[:end] + " " + text[end:]) != text:
                yield "fmt leaves the blank in `%s (`" % word


def editors(tartan, path, text, places, table, seen):
    """seen: row -> the places of its word that editors take for it. Names of the author's may be the same as a row's word that is a
    name to the lexer: there editors tell what the author's is."""
    server = Server(tartan, path, text)
    for offset, word in places:
        said = ((server.at("hover", offset) or {}).get("contents") or {}).get("value", "")
        offered = {one["label"]: one.get("detail") for one in server.at("completion", offset)}
        for row in table.rows(word):
            if said == "`%s`: %s" % (word, row.sentence):
                seen.setdefault(row, []).append((path, text, offset))
                if row.use != "SPELLING" and word not in offered:
                    line = text[:offset].count("\n") + 1
                    yield "%s:%d:%d: editors do not offer `%s`" % (path, line, offset - text.rfind("\n", 0, offset), word)
            elif row.token == "NAME" and offered.get(word) == row.sentence:
                seen.setdefault(row, []).append((path, text, offset))
    if server.close() != 0:
        yield "the language server fails"


def slip(word, known):
    """The word misspelled: two of its letters swapped, or one too many if they are alike, the word is short or another word comes of it."""
    swapped = word[:-2] + word[:-3:-1]
    return swapped if len(word) > 3 and swapped not in known | {word} else word + word[-1]


def suggested(tartan, scratch, seen):
    known = {row.text for row in seen}
    for row, places in seen.items():
        if row.token == "NAME" or row.text in UNTOLD:
            continue
        for path, text, offset in places:
            wrong = os.path.join(scratch, os.path.basename(path))
            with open(wrong, "w", encoding="utf-8") as file:
                file.write(text[:offset] + slip(row.text, known) + text[offset + len(row.text):])
            said = run(tartan, "check", "--no-analysis", wrong)[1]
            with open(wrong, "w", encoding="utf-8") as file:
                file.write(text)
            if "did you mean `%s`?" % row.text in said:
                break
        else:
            yield "`%s` is not suggested for `%s` (%s)" % (row.text, slip(row.text, known), ", ".join(sorted(row.places)))


def follows(tartan, notation, table, folder):
    paths = [os.path.join(folder, name) for name in sorted(os.listdir(folder)) if name.endswith("." + notation)]
    wrong, seen = list(consistent(table)), {}
    for path in paths:
        text = words.read(path)
        if laid_out(tartan, notation, text) != text:
            wrong.append("%s is not laid out" % path)
        places = list(occurrences(text, {row.text for row in table.words}))
        wrong += layout(tartan, notation, text, places, table)
        wrong += editors(tartan, path, text, places, table, seen)
    wrong += ["nobody says what `%s` of .%s is, or no file has it (%s)" % (row.text, notation, ", ".join(sorted(row.places)))
              for row in table.words if row not in seen and row.use != "SPELLING"]
    if wrong:
        return wrong
    with tempfile.TemporaryDirectory() as scratch:
        for path in paths:
            shutil.copy(path, scratch)
        return list(suggested(tartan, scratch, seen))


def main(tartan, folder, rows=None):
    wrong = []
    for name, path, _, _ in words.NOTATIONS:
        texts = [words.read(os.path.join(ROOT, path))] + ([words.read(rows)] if rows and name == "plan" else [])
        if name == "plan" or not rows:
            wrong += follows(tartan, name, words.Table(texts), folder)
    print("\n".join(wrong))
    sys.exit(bool(wrong))


if __name__ == "__main__":
    main(*sys.argv[1:])
