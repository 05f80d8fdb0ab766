#!/usr/bin/env bash
# report of a kit: one page with nothing from elsewhere, the same each time, with every part, rule and model; what cannot be placed is said.
name=kit_report
. "$(dirname "$0")/golden.bash"

# The words of a page, a line for each row; pictures are left out, and what another version of Tartan changes.
cat >"$scratch/words.py" <<'PYTHON'
import html, re, sys

page = re.sub(r"<style>.*?</style>", "", open(sys.argv[1], encoding="utf-8").read(), flags=re.S)
page = re.sub(r"<svg.*?</svg>", "[picture]", page, flags=re.S)
words = html.unescape(re.sub(r"<[^>]*>", "", re.sub(r"</t[dh]>", " | ", page)))
words = re.sub(r"rules [0-9a-f]{16}, seed (\d+), .*", r"rules HASH, seed \1, VERSION", words)
print("\n".join(line.rstrip() for line in words.splitlines() if line.strip()))
PYTHON
words() {
    python3 "$scratch/words.py" "$1"
}

cat >"$scratch/odd.kit" <<'KIT'
# Names and texts that HTML would read as its own.
unit 10 x 10 x 10 turns 24;
connector peg joins hole turns 2;
connector hole joins peg turns 2;
part "p<1>" "says \"<script>alert(1)</script>\" & more" {
  fill 20 x 20 x 20;
  fill 20 x 20 x 20 at (20, 0, 0);
  peg right at (30, -10, 0);
  hole left at (-10, -10, 0);
  mass 2; price 0.25;
}
part "block" "joins nothing" { fill 20 x 20 x 20; }
rule row at peg = "p<1>" in 4;
model line "a row of <three> & \"no more\"" {
  inside box(120, 20, 20) at (60, 0, 0);
  start peg right at (0, 10, 0) by row;
  require elements = 3, components = 2;
}
model high { inside box(20, 20, 20); start peg right at (0, 10, 0) by row; }
model many { inside box(100000, 20, 20); start peg right at (0, 10, 0) by row; require fill = 1; }
KIT
golden words "tartan report $scratch/odd.kit --part-limit 50 -o $scratch/odd.html; words $scratch/odd.html"
echo "Init -> 'Place(3001)'" >"$scratch/s.pcfg"
golden wrong "
    tartan report $scratch/odd.kit --sample 3
    tartan report $scratch/odd.kit --seed 4294967296
    tartan report $scratch/odd.kit -o $scratch/none/page.html
    tartan report rows.plan -o $scratch/x --part-limit 3
    tartan report $scratch/s.pcfg -o $scratch/x"

"$TARTAN" report bricks -o "$scratch/a.html"
"$TARTAN" report bricks -o "$scratch/folder"
"$TARTAN" report bricks >"$scratch/b.html"
cmp -s "$scratch/a.html" "$scratch/b.html" || fail 'the same report has other bytes'
cmp -s "$scratch/a.html" "$scratch/folder/index.html" || fail 'a page in a folder has other bytes'
python3 - "$scratch/a.html" "$scratch/odd.html" <<'PYTHON' || fail 'the page is not as it should be'
import html.parser, re, sys, xml.dom.minidom

for path, parts in ((sys.argv[1], 35), (sys.argv[2], 2)):
    page = open(path, encoding="utf-8").read()
    assert not re.search(r'(src|href)="(?!#)|url\((?!#)', page), "something comes from elsewhere"
    assert "<script" not in page
    open_tags = []

    class Checker(html.parser.HTMLParser):
        def handle_starttag(self, tag, attrs):
            if tag not in ("meta", "br"):
                open_tags.append(tag)

        def handle_endtag(self, tag):
            assert open_tags.pop() == tag, tag

    Checker().feed(page)
    assert not open_tags, open_tags
    for picture in re.findall(r"<svg.*?</svg>", page, re.S):
        xml.dom.minidom.parseString(picture)
    ids = re.findall(r'\bid="([^"]*)"', page)
    assert len(ids) == len(set(ids)), "an id twice"
    for target in re.findall(r'href="#([^"]*)"', page):
        assert target in ids, target
    cards = re.findall(r'<section class="card" id="part-\d+">(.*?)</section>', page, re.S)
    assert len(cards) == parts, len(cards)
    assert all("<svg" in card for card in cards), "a part has no picture"
PYTHON

# Fewer pictures than parts.
"$TARTAN" report bricks --pictures 3 -o "$scratch/few.html"
is 'pictures' "$(grep -c '<svg' "$scratch/few.html")" 3
finish
