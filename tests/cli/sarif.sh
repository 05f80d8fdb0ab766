#!/usr/bin/env bash
# check --sarif: a SARIF 2.1.0 log with the properties that the standard requires, for every wrong file of tests/diagnostics.
# Slow under sanitizers.
name=sarif
. "$(dirname "$0")/golden.bash"

cat >"$scratch/validate.py" <<'PY'
"""What SARIF 2.1.0 (OASIS, sections 3.13 to 3.58) requires of the objects that are written here."""
import json, sys


def region(r):
    assert all(isinstance(r[k], int) and r[k] >= 1 for k in ("startLine", "startColumn", "endLine", "endColumn")), r
    assert (r["startLine"], r["startColumn"]) <= (r["endLine"], r["endColumn"]), r


def location(place):
    physical = place["physicalLocation"]
    uri = physical["artifactLocation"]["uri"]
    assert uri and all(33 <= ord(c) < 127 and c not in '<>"{}|\\^`' for c in uri), uri
    region(physical["region"])


def check_result(result, ids):
    assert result["message"]["text"]
    assert result["level"] in ("none", "note", "warning", "error")
    assert ids[result["ruleIndex"]] == result["ruleId"]
    assert len(result.get("locations", [])) <= 1
    for place in result.get("locations", []):
        location(place)
    for place in result.get("relatedLocations", []):
        location(place)
        assert place["message"]["text"]
    for fix in result.get("fixes", []):
        assert fix["description"]["text"] and len(fix["artifactChanges"]) >= 1
        for change in fix["artifactChanges"]:
            assert change["artifactLocation"]["uri"] and len(change["replacements"]) >= 1
            for replacement in change["replacements"]:
                region(replacement["deletedRegion"])
                assert isinstance(replacement["insertedContent"]["text"], str)


def check(path):
    log = json.load(open(path, encoding="utf-8"))
    assert set(log) == {"$schema", "version", "runs"} and log["version"] == "2.1.0"
    assert log["$schema"].endswith("sarif-2.1.0.json")
    [run] = log["runs"]
    driver = run["tool"]["driver"]
    assert driver["name"] == "tartan" and driver["version"]
    assert run["columnKind"] in ("utf16CodeUnits", "unicodeCodePoints")
    ids = [rule["id"] for rule in driver["rules"]]
    assert len(set(ids)) == len(ids)
    for rule in driver["rules"]:
        assert rule["help"]["text"].startswith(rule["id"] + ": " + rule["shortDescription"]["text"])
        assert rule["shortDescription"]["text"] and rule["defaultConfiguration"]["level"] in ("error", "warning")
    for result in run["results"]:
        check_result(result, ids)
    marks = [result["partialFingerprints"]["tartanLine/v1"] for result in run["results"] if result.get("locations")]
    assert len(set(marks)) == len(marks)
    print(len(run["results"]), len(ids))


for path in sys.argv[1:]:
    try:
        check(path)
    except Exception as wrong:
        sys.exit(f"{path}: {wrong!r}")
PY
valid() { python3 "$scratch/validate.py" "$@" || fail "these are not all valid: $*"; }

cp tests/diagnostics/* "$scratch" 2>/dev/null || true
(cd "$scratch" && "$TARTAN" check ./*.plan --sarif all.sarif >/dev/null 2>&1) || true
counted=$(valid "$scratch/all.sarif")
[ "${counted% *}" -gt 300 ] || fail "only $counted findings and codes"
for file in "$scratch"/*.hemls "$scratch"/*.bnf "$scratch"/*.field "$scratch"/*.solid; do
    "$TARTAN" check "$file" --sarif "$file.sarif" >/dev/null 2>&1 || true
done
valid "$scratch"/*.{hemls,bnf,field,solid}.sarif >/dev/null

# A line more above does not change what a finding is known by; another line text does.
marks() { python3 -c 'import json, sys
for result in json.load(open(sys.argv[1]))["runs"][0]["results"]:
    print(result["ruleId"], result["partialFingerprints"]["tartanLine/v1"])' "$1"; }
printf 'schema s { w = 1m | 2m }\nrule a = tray(3m)\nrule b = tray(3m)\nrule a = tray(1m)\n' >"$scratch/before.plan"
{ printf '# a line more\n'; cat "$scratch/before.plan"; } >"$scratch/after.plan"
sed 's/rule b = tray(3m)/rule b = tray(4m)/' "$scratch/before.plan" >"$scratch/other.plan"
for file in before after other; do
    "$TARTAN" check "$scratch/$file.plan" --sarif "$scratch/$file.sarif" >/dev/null 2>&1 || true
    marks "$scratch/$file.sarif" >"$scratch/$file.marks"
done
cmp -s "$scratch/before.marks" "$scratch/after.marks" || fail "findings are not known again after an edit above: $(diff "$scratch/before.marks" "$scratch/after.marks")"
is 'changed marks' "$(comm -3 <(sort "$scratch/before.marks") <(sort "$scratch/other.marks") | wc -l)" 2

printf 'schema s "\303\251t\303\251" { w = 1m | 2m }  rule a = tray(3m)\n' >"$scratch/a b\303\251.plan"
printf 'schema s "\303\251t\303\251" { w = 1m | 2m }  rule a = tray(3m)\n' >"$scratch/accents.plan"
golden accents "cd $scratch && tartan check accents.plan --sarif - 2>/dev/null | sed 's/\"version\": \"[0-9.]*\"/\"version\": ...\"/'"
golden good 'tartan check sheds.plan --no-analysis --sarif - | tail -n 4'
golden nowhere "tartan check sheds.plan --no-analysis --sarif $scratch/none/log"
finish
