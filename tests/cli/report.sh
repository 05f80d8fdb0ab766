#!/usr/bin/env bash
# report: one page with nothing from elsewhere, the same each time, with every clause and plan; nothing else is left behind.
name=report
. "$(dirname "$0")/golden.bash"

golden no_folder 'tartan report rows.plan'
golden not_a_folder "tartan report rows.plan -o rows.plan/x"
golden no_library "printf 'schema s { w = 1m }' >$scratch/s.plan; tartan report $scratch/s.plan -o $scratch/none"
"$TARTAN" report "$files/rows.plan" -o "$scratch/a" --sample 5 --seed 2
"$TARTAN" report "$files/rows.plan" -o "$scratch/b" --sample 5 --seed 2 --threads 1
cmp -s "$scratch/a/index.html" "$scratch/b/index.html" || fail 'the same report has other bytes'
is 'files in the folder' "$(ls -A "$scratch/a")" index.html
python3 - "$scratch/a/index.html" <<'PYTHON' || fail 'the page is not as it should be'
import base64, html.parser, re, sys, xml.dom.minidom

page = open(sys.argv[1], encoding="utf-8").read()
assert not re.search(r'(src|href)="(?!data:)', page), "something comes from elsewhere"
open_tags = []


class Checker(html.parser.HTMLParser):
    def handle_starttag(self, tag, attrs):
        if tag == "img":
            kind, data = dict(attrs)["src"].split(",", 1)
            assert kind == "data:image/svg+xml;base64"
            xml.dom.minidom.parseString(base64.b64decode(data))
        elif tag not in ("meta", "input", "option"):
            open_tags.append(tag)

    def handle_endtag(self, tag):
        if tag != "option":
            assert open_tags.pop() == tag, tag


Checker().feed(page)
assert not open_tags, open_tags
assert page.count('<div class="plan kept"') == 5
assert page.count('class="rule"') >= 2
PYTHON
finish
