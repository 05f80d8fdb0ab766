#!/usr/bin/env python3
"""Makes random files from the grammars and asks every question against every other.

    search.py plans|houses [--seeds N] [--first K] [--seconds S] [--jobs N] [--out FOLDER] [FILE ...]

TARTAN names the command that is searched. A seed gives the same files, questions and small cases with any --jobs; --seconds only decides
how many seeds are tried. A file in which two answers differ is made smaller for as long as the same question differs; the small case is
printed, and written to --out. With FILEs, all questions are asked of these. Ends with 1 if there was a difference."""
import argparse
import collections
import os
import random
import sys
import tempfile
import time
from multiprocessing import Pool

import houses
import plans
from by_house_reference import houses_by_reference
from by_reference import plans_by_reference
from grammar import read_grammar
from maker import Maker
from mend import errors, mended
from program import Refused, Wrong
from questions import OF_FILES, OF_LIBRARIES, Subject, checks
from shrink import shrunk
from source import read_source
from tree import Text

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SHARE = .5               # of the questions are asked of each random file: more files find more than more questions do
LATE = {"E1610"}         # of a plan that does not stand up in its form, which is known where plans are gone through: not by `check`
INDENTS = plans.Plans.indents
KINDS = {"plans": plans.make_file, "houses": houses.make_file}
GRAMMAR = read_grammar(os.path.join(ROOT, "grammar", "plan.y"))


class Result:
    """What came of one seed."""

    def __init__(self, seed):
        self.seed, self.asked, self.accepted, self.refused, self.cases = seed, 0, False, [], []
        self.took = 0                            # seconds of processor time until a difference was found, or all was asked


def asked_of(path, chosen=None):
    """(question, library or None) for all questions about a file; with `chosen`, a random number generator, for some of them."""
    libraries = [item.name for item in read_source(path).of("library")]
    asked = [(q, None) for q in OF_FILES] + [(q, name) for name in libraries for q in OF_LIBRARIES]
    if chosen is None:
        return asked
    return [(q, name) for name in libraries for q in (plans_by_reference, houses_by_reference)] + [a for a in asked if chosen.random() < SHARE]


def ask(question, subject):
    """None, or how the answers differ. A refusal that is no limit is a difference, since the file is accepted."""
    try:
        question(subject)
    except Wrong as wrong:
        return wrong
    except Refused as refused:
        if not refused.limit and str(refused) not in LATE:
            return Wrong(f"{question.__name__} is refused, {refused}", refused, "an answer: check accepts the file")
        return refused
    return None


def ask_all(path, folder, result, tree=None, chosen=None):
    """(question, library, Wrong) of those that differ."""
    found, subjects = [], {}
    for question, library in asked_of(path, chosen):
        if library not in subjects:
            subjects[library] = Subject(path, folder, library, tree)
        result.asked += 1
        outcome = ask(question, subjects[library])
        if isinstance(outcome, Wrong):
            found.append((question, library, outcome))
        elif outcome:
            result.refused.append(str(outcome))
    return found


def one_seed(job):
    kind, seed = job
    maker = Maker(GRAMMAR, plans.Plans(), random.Random(f"{kind} {seed}"))
    result, began = Result(seed), sum(os.times()[:4])
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "a.plan")
        tree = KINDS[kind](maker)
        try:
            tree, left = mended(maker, tree, path)
        except Wrong as wrong:
            found = [(checks, None, wrong)]
            tree = maker.last
        else:
            if left:
                result.refused.append(left[0]["code"])
                return result
            result.accepted = True
            found = ask_all(path, folder, result, tree, maker.random)
        result.took = sum(os.times()[:4]) - began
        if found:
            result.cases.append(smallest(kind, seed, tree, found, path))
    return result


def smallest(kind, seed, tree, found, path):
    """(question, text) of the first difference, made smaller."""
    question, library, wrong = found[0]
    tree, wrong = shrunk(GRAMMAR, tree, wrong, lambda smaller: still(smaller, question, library, wrong, path), INDENTS)
    others = sorted({w.question for _, _, w in found} - {wrong.question})
    said = [f"{kind}, seed {seed}: {wrong.question}", f"answered: {wrong.got[:300]}", f"should be: {wrong.want[:300]}"]
    said += ["of this file also: " + ", ".join(others)] if others else []
    comments = "".join("# " + line.replace("\n", " ") + "\n" for line in said)
    return wrong.question, comments + Text(tree, INDENTS).text


def still(tree, question, library, wrong, path):
    """Wrong where the same question differs of the smaller file, too; else None."""
    write(path, Text(tree, INDENTS).text)
    try:
        if question is not checks and errors(path):
            return None
        outcome = ask(question, Subject(path, os.path.dirname(path), library, tree))
    except (Wrong, Refused, KeyError, IndexError):         # another difference, or a file without what is asked about
        return None
    return outcome if isinstance(outcome, Wrong) and outcome.question == wrong.question else None


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


# ---- many seeds

class Tally:
    def __init__(self):
        self.tried = self.accepted = self.asked = self.took = 0
        self.refused, self.found = collections.Counter(), collections.Counter()

    def add(self, result):
        self.tried += 1
        self.accepted += result.accepted
        self.asked += result.asked
        self.took += result.took
        self.refused.update(result.refused)
        self.found.update(question for question, _ in result.cases)

    def __str__(self):
        said = f"{self.tried} files, {self.accepted} of them accepted, {self.asked} questions, {sum(self.found.values())} files with a difference"
        refused = ", ".join(f"{code} {n}" for code, n in sorted(self.refused.items()))
        return said + (f"; refused: {refused}" if refused else "")


def search(options):
    started, tally = time.monotonic(), Tally()
    jobs = ((options.kind, seed) for seed in range(options.first, options.first + options.seeds))
    pool = Pool(options.jobs) if options.jobs > 1 else None
    for result in pool.imap(one_seed, jobs) if pool else map(one_seed, jobs):
        tally.add(result)
        for question, case in result.cases:
            print(f"seed {result.seed}, after {time.monotonic() - started:.0f} s ({tally.took:.0f} of processors): {question}\n{case}", flush=True)
            if options.out:
                write(os.path.join(options.out, f"{options.kind}-{result.seed}.plan"), case)
        if options.seconds and time.monotonic() - started > options.seconds:
            break
    if pool:
        pool.terminate()
    print(f"{options.kind} from seed {options.first}: {tally}; {time.monotonic() - started:.0f} s")
    return sum(tally.found.values())


def check_files(files):
    wrong, asked = 0, 0
    for path in files:
        result = Result(path)
        with tempfile.TemporaryDirectory() as folder:
            for question, library, found in ask_all(path, folder, result):
                print(f"{path}, {library}, {question.__name__}: {found.question}\n  answered: {found.got[:300]}\n  should be: {found.want[:300]}")
                wrong += 1
        asked += result.asked
    print(f"{len(files)} files, {asked} questions, {wrong} differences")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=list(KINDS))
    parser.add_argument("files", nargs="*", metavar="FILE")
    parser.add_argument("--seeds", type=int, default=100, help="how many files (100)")
    parser.add_argument("--first", type=int, default=0, help="the first seed (0)")
    parser.add_argument("--seconds", type=float, help="begin no seed after so many seconds")
    parser.add_argument("--jobs", type=int, default=1, help="so many processes; changes nothing but the time")
    parser.add_argument("--out", help="a folder for the small cases")
    options = parser.parse_args()
    if options.out:
        os.makedirs(options.out, exist_ok=True)
    sys.exit(1 if (check_files(options.files) if options.files else search(options)) else 0)


if __name__ == "__main__":
    main()
