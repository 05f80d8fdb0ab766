#!/usr/bin/env python3
"""Holds a documentation site to its links: site.py TARTAN FOLDER

Every link and picture leads to a file of the folder, and every anchor to an element; pages need no script to be read; each code has a page; each
link that opens a file in the playground has a file that passes `tartan check`."""
import base64
import glob
import html.parser
import json
import os
import re
import subprocess
import sys
import tempfile
import urllib.parse
import zlib

SOURCE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.ids, self.links, self.scripts, self.words = set(), [], [], 0
        with open(path, encoding="utf-8") as file:
            self.feed(file.read())

    def handle_starttag(self, tag, attributes):
        found = dict(attributes)
        if "id" in found:
            self.ids.add(found["id"])
        if tag in ("a", "link") and "href" in found:
            self.links.append(found["href"])
        if tag in ("img", "script") and "src" in found:
            self.links.append(found["src"])
        if tag == "script":
            self.scripts.append(found.get("src"))

    def handle_data(self, data):
        self.words += len(data.split())


def opened(fragment):
    """The files of a link into the playground, as studio/page/src/link.ts unpacks them."""
    letters = fragment[len("t1."):]
    return json.loads(zlib.decompress(base64.urlsafe_b64decode(letters + "=" * (-len(letters) % 4)), -15))


def checked(tartan, linked):
    """What `tartan check` says of the file that a link opens; "" if it passes."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in linked["files"].items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        done = subprocess.run([tartan, "check", linked["open"]], cwd=folder, capture_output=True, text=True)
        return done.stdout + done.stderr if done.returncode else ""


def main():
    tartan, folder = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    paths = [path for path in glob.glob(folder + "/**/*.html", recursive=True) if not os.path.relpath(path, folder).startswith("play/")]
    pages = {path: Page(path) for path in paths}
    wrong, tries = [], 0
    for path, page in pages.items():
        name = os.path.relpath(path, folder)
        if page.words < 10:
            wrong.append(f"{name} says nothing")
        if any(script is None for script in page.scripts):
            wrong.append(f"{name} has a script in it")
        for link in page.links:
            if re.match(r"[a-z]+:", link):
                continue
            target, _, anchor = link.partition("#")
            whole = os.path.normpath(os.path.join(os.path.dirname(path), urllib.parse.unquote(target))) if target else path
            if anchor.startswith("t1."):
                tries += 1
                said = checked(tartan, opened(anchor))
                if said:
                    wrong.append(f"{name}: what a link opens in the playground does not pass: {said}")
            elif anchor and whole in pages and urllib.parse.unquote(anchor) not in pages[whole].ids:
                wrong.append(f"{name}: {link} names no place of that page")
            if not os.path.isfile(whole):
                wrong.append(f"{name}: {link} leads nowhere")
    with open(os.path.join(SOURCE, "runtime", "base", "codes.def"), encoding="utf-8") as table:
        for kind, number in re.findall(r"^(ERROR|WARNING)\((\d+),", table.read(), re.M):
            code = ("E%04d" if kind == "ERROR" else "W%03d") % int(number)
            if not os.path.exists(f"{folder}/errors/{code}.html"):
                wrong.append(f"{code} has no page")
    if os.path.isdir(folder + "/play") and tries < 20:
        wrong.append(f"only {tries} files can be tried")
    print("\n".join(wrong) if wrong else f"{len(pages)} pages, {sum(len(page.links) for page in pages.values())} links, {tries} files to try")
    sys.exit(bool(wrong))


main()
