#!/usr/bin/env python3
"""Holds what commands write with --json to the schema of answers: requests.py TARTAN SCHEMA

An answer follows the schema of its question; and the schema is no blank: an answer with a member less, another member, or a number in
place of digits does not follow it."""
import json
import os
import subprocess
import sys
import tempfile

import jsonschema

import ask_files
import ask_source

tartan = sys.argv[1]
with open(sys.argv[2], encoding="utf-8") as file:
    schema = json.load(file)

HOUSE = ("14'_room:14'_none_|_14'_room:14'_porch:5'_|_14'_room:14'_porch:5'_;_1_gable(9:12)_1_flat_;_living_|_kitchen_porch-deck_|_bedroom_porch-deck_;"
         "_window_window_open_window_window_window_window_window_;_counter.back_bed.right.m")
# The command line's question, and its words; _ is a blank in one of them.
ASKED = {
    "count": [
        "count tests/cli/files/cabins.plan --library cottage-rows", "count lahave-houses", "count lahave-houses --mirror --no-effects --trays 4..5",
        "count lahave-houses --by cost --trays 4..5", "count lahave-houses --by cost --trays 4..5 --bins 6", "count tests/cli/files/cabins.plan --library cottages",
        "count tests/cli/files/cabins.plan --library cottages --clauses --plan #10", "count tests/cli/files/cabins.plan --library cottages --plan #10 --by floor-area",
        "count bricks --parts 2", "count bricks --parts 2 --fixed", "count lahave-houses --by cost --where trays=4 --where trays=5",
    ],
    "explain": [
        "explain terrace #1000", "explain terrace 4m_one_end_left_eaves_-_none --where trays=1", "explain terrace 4m_one_end_left_eaves_-_none --rule step",
        "explain tests/cli/files/cabins.plan #10", "explain tests/cli/files/cabins.plan #10:3", "explain tests/cli/files/cabins.plan #10: --library cottages", "explain table",
    ],
    "rank": [
        "rank terrace 4m_one_end_left_eaves_-_none_|_4m_one_mid_left_eaves_-_none_|_6m_one_mid_right_eaves_-_garden:2m_|_8m_one_mid_left_eaves_passage_"
        "garden:4m_|_8m_one_end_right_eaves_-_none", f"rank tests/cli/files/cabins.plan {HOUSE}", f"rank tests/cli/files/cabins.plan {HOUSE} --of-all",
    ],
    "unrank": ["unrank terrace 1000", "unrank tests/cli/files/cabins.plan #10:3", "unrank tests/cli/files/cabins.plan 77 --library cottages", "unrank lahave-houses 0 --trays 4..4"],
    "settings": ["settings examples/market-hall/market.plan", "settings primitives", "settings bricks --used"],
    "rule_tree": ["rule lahave stranded", "rule terrace step", "rule examples/market-hall/market.plan near-gate"],
    "rule_edit": ["rule lahave stranded --edit wrap --part 3 --by not", "rule lahave stranded --edit wrap --part 30 --by not", "rule lahave lone --edit new"],
    "schema": ["schema terrace", "schema cottage", "schema lahave-houses --used", "schema row-houses"],
    "pareto": ["pareto lahave-houses --trays 4..4 --least cost --most area", "pareto tests/cli/files/cabins.plan --plan #3 --least floor-area --most bedrooms"],
    "complete": [
        "complete terrace ?_|_..._|_?", "complete terrace ?_|_?", "complete terrace ?_|_end", "complete lahave-houses ?_|_great_|_..._|_? --trays 4..4 --least cost",
        "complete tests/cli/files/cabins.plan ..._|_? --library cottages",
    ],
    "diff": ["diff terrace terrace --trays 2..3 --no-measures", "diff lahave-houses lahave-houses --trays 3..4", "diff tests/cli/files/cabins.plan tests/cli/files/cabins.plan --library cottages"],
    "inspect": ["inspect examples/drawn-gate/gate.ldr --kit bricks", "inspect tests/cli/files/loose.ldr --kit bricks"],
    "test": ["test terrace", "test terrace tests/cli/files/cabins.plan --coverage", "test table", "check terrace --test --no-analysis"],
    "grow": ["grow square -n 2", "grow examples/growing-surfaces/draped.study -n 2"],
    "mesh": ["mesh table", "mesh table --cells", "mesh primitives --surface torus --grid 12 --sharp --bounds --thickness --times"],
    "runs": ["runs show RUN", "runs compare RUN RUN"],
    "evolve": ["evolve STUDY -o RUN --resume"],
    "individual": ["runs replay RUN 1", "runs replay RUN 50"],
    "relations": ["check terrace --relations", "check tests/cli/files/cabins.plan --relations --max-states 40", "check tests/cli/files/cabins.plan --relations --examples --max-states 40"],
}
# What commands that lack --json are asked for JSON with.
JSON = {"mesh": ["--stats", "json"], "grow": ["--stats", "json"]}
# Questions whose answers are lists: the command writes a line of JSON for each, which follows the type of a row.
ROWS = {
    "sample": [("found_plan", "sample terrace 3"), ("found_house", "sample tests/cli/files/cabins.plan 2 --library cottages"), ("found_house", "sample tests/cli/files/cabins.plan 2 --plan #10")],
    "enumerate": [("found_building", "enumerate bricks --parts 2 --part 3001 --limit 3"), ("found_plan", "enumerate terrace --from 1000 --limit 3"), ("found_house", "enumerate tests/cli/files/cabins.plan --library cottages --from 77 --limit 2")],
    "match": [("matched_plan", "match terrace PLANS"), ("matched_plan", "match tests/cli/files/cabins.plan HOUSES")],
    "prune": [("pruned_plan", "prune terrace PLANS --dropped -")],
    "map": [("mapped_genome", "map words --random 3 --codons 9"), ("mapped_system", "map genr8 --random 20")],
    "vary": [("varied_house", "vary tests/cli/files/cabins.plan #10:77"), ("varied_house", "vary row-houses #0:0")],
    "best": [
        ("found_plan", "best lahave-houses 3 --trays 4..4 --least cost"), ("found_plan", "best lahave-houses 3 --trays 4..4 --least cost --then-most area"),
        ("best_house", "best tests/cli/files/cabins.plan 2 --library cottages --least floor-area"), ("best_house", "best tests/cli/files/cabins.plan 2 --plan #3 --least floor-area --then-most bedrooms"),
    ],
}
# What is a part of the answer to another question, or of no answer that a command writes as JSON (tests/cli/ask_genomes.sh); ask_files.py has
# those that make files, ask_source.py those about the text.
PARTS = {"coverage": "test", "invert": "map", "change_run": "runs", "breed": "evolve"}
wrong = []


def answers_of(question):
    return jsonschema.Draft202012Validator({"$defs": schema["$defs"], **schema["answers"][question]})


def spoiled(answer):
    """Answers that are not as the schema says."""
    if isinstance(answer, list):
        less = {key: value for key, value in answer[0].items() if not isinstance(value, list)}
        if less == answer[0]:
            del less[next(iter(less))]
        yield from ([bad, *answer[1:]] for bad in (1, less, {**answer[0], "another": 1}))
        return
    yield {**answer, "another": 1}
    for key, value in answer.items():
        if isinstance(value, str) and value.isdigit():
            yield {**answer, key: int(value)}
        if isinstance(value, list) and value and isinstance(value[0], dict) and key != "trays":   # whose keys are the fields of a schema
            yield {**answer, key: [{**value[0], "another": "1"}]}


def answers(line, *options):
    """What the command writes, or None: it refused, which is wrong."""
    done = subprocess.run([tartan, *(word if os.sep in word else word.replace("_", " ") for word in line.split(" ")), *options], capture_output=True, text=True, check=False)
    if done.returncode:
        wrong.append(f"{line}: {done.stderr}")
        return None
    return done.stdout


def check(line, validator, answer):
    less = [{k: v for k, v in answer.items() if k != key} for key in answer] if isinstance(answer, dict) else []
    if less and all(validator.is_valid(bad) for bad in less):
        wrong.append(f"{line}: the schema takes it with any member less")
    wrong.extend(f"{line}: {error.json_path}: {error.message[:200]}" for error in validator.iter_errors(answer))
    wrong.extend(f"{line}: the schema takes {str(bad)[:200]}" for bad in spoiled(answer) if validator.is_valid(bad))


def main():
    jsonschema.Draft202012Validator.check_schema(schema)
    asked = {*ASKED, *ROWS, *PARTS, *ask_files.ASKED, *ask_source.ASKED}
    if set(schema["requests"]) != asked:
        wrong.append(f"questions that are not asked here: {set(schema['requests']) ^ asked}")
    folder = tempfile.mkdtemp(prefix="requests")
    run = os.path.join(folder, "hello.run")
    with open(os.path.join(folder, "hello.study"), "w", encoding="utf-8") as file:
        file.write("evolution {\n  grammar \"words\"\n  match \"hello\"\n  population 20\n  generations 4\n}\n")
    subprocess.run([tartan, "evolve", file.name, "-o", run], capture_output=True, check=True)
    for question, lines in ASKED.items():
        validator = answers_of(question)
        for line in (line.replace("RUN", run).replace("STUDY", file.name) for line in lines):
            said = answers(line, *JSON.get(question, ["--json"]))
            if said:
                check(line, validator, json.loads(said))
    given = {"PLANS": ("unrank", "terrace", "1000"), "HOUSES": ("unrank", "tests/cli/files/cabins.plan", "#10:3")}
    for name, words in given.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(subprocess.run([tartan, *words], capture_output=True, text=True, check=True).stdout)
    for question, lines in ROWS.items():
        lines = [(kind, " ".join(os.path.join(folder, word) if word in given else word for word in line.split(" "))) for kind, line in lines]
        for kind, line in lines:
            said = answers(line, *(["--json"] if question == "vary" else ["--format", "json"]))
            for row in (said or "").splitlines():
                check(line, jsonschema.Draft202012Validator({"$defs": schema["$defs"], "$ref": f"#/$defs/{kind}"}), json.loads(row))
            if said == "":
                wrong.append(f"{line}: nothing was found")
    print("\n".join(wrong) or "fine")


main()
