#!/usr/bin/env python3
"""Makes random files from the grammars and asks every question against every other.

    search.py KIND [--seeds N] [--first K] [--seconds S] [--jobs N] [--out FOLDER] [FILE ...]

KIND is one of those in kinds.py. TARTAN names the command that is searched. A seed gives the same files, questions and small cases with any --jobs; --seconds only decides
how many seeds are tried. The first files in which the answers to a question differ are made smaller for as long as they do; the small cases
are printed, and written to --out. With FILEs, all questions are asked of these. Ends with 1 if there was a difference."""
import argparse
import collections
import glob
import os
import random
import shutil
import sys
import tempfile
import time
from multiprocessing import Pool

from file_questions import checks
from kinds import KINDS
from maker import Maker
from mend import errors, mended
from program import Refused, Wrong
from shrink import shrunk
from tree import Text

SHARE = .3               # of the questions are asked of each random file: more files find more than more questions do
SHOWN = 1                # file of each difference is made smaller, which takes longer than to find more


class Result:
    """What came of one seed."""

    def __init__(self, seed):
        self.seed, self.asked, self.accepted, self.refused, self.differ = seed, 0, False, [], []
        self.took = 0                            # seconds of processor time until a difference was found, or all was asked


def asked_of(kind, path, chosen=None):
    """(question, part or None) for all questions about a file; with `chosen`, a random number generator, for some of them."""
    if is_refused(path):
        return [(checks, None)]
    always, more = kind.questions(path)
    return always + [a for a in more if chosen is None or chosen.random() < SHARE]


def is_refused(path):
    try:
        return bool(errors(path))
    except Wrong:                                # as `checks` says, too
        return True


def ask(question, subject):
    """None, or how the answers differ. A refusal that is no limit is a difference, since the file is accepted."""
    try:
        question(subject)
    except Wrong as wrong:
        return wrong
    except Refused as refused:
        if not refused.limit:
            return Wrong(f"{question.__name__} is refused, {refused}", refused, "an answer: check accepts the file")
        return refused
    return None


def ask_all(kind, path, folder, result, tree=None, chosen=None):
    """(question, part, Wrong) of those that differ."""
    found, subjects = [], {}
    for question, part in asked_of(kind, path, chosen):
        if part not in subjects:
            subjects[part] = kind.subject(path, folder, part, tree)
        result.asked += 1
        outcome = ask(question, subjects[part])
        if isinstance(outcome, Wrong):
            found.append((question, part, outcome))
        elif outcome:
            result.refused.append(str(outcome))
    return found


def one_seed(job):
    """What pool and parent share: no trees."""
    name, seed = job
    with tempfile.TemporaryDirectory() as folder:
        return tried(KINDS[name], seed, folder)[0]


def path_in(folder, kind):
    return os.path.join(folder, "a" + kind.suffix)


def tried(kind, seed, folder):
    """(result, tree, [(question, part, Wrong)] that differ) of a seed."""
    maker = Maker(kind.grammar, kind.notation, random.Random(f"{kind.name} {seed}"))
    result, began, path = Result(seed), sum(os.times()[:4]), path_in(folder, kind)
    for name, text in kind.beside(maker.random).items():
        write(os.path.join(folder, name), text)
    try:
        tree, left = mended(maker, kind.make_file(maker), path)
    except Wrong as wrong:
        tree, found = maker.last, [(checks, None, wrong)]
    else:
        if left:
            result.refused.append(left[0]["code"])
            return result, tree, []
        result.accepted = True
        found = ask_all(kind, path, folder, result, tree, maker.random)
    result.took = sum(os.times()[:4]) - began
    result.differ = sorted({wrong.question for _, _, wrong in found})
    return result, tree, found


def small_case(kind, seed, which):
    """The text of a seed's file made smaller, for as long as the answers to this question differ."""
    indents = kind.notation.indents
    with tempfile.TemporaryDirectory() as folder:
        result, tree, found = tried(kind, seed, folder)
        first = next(f for f in found if f[2].question == which)
        tree, wrong = shrunk(kind.grammar, tree, first[2], lambda smaller: still(kind, smaller, first, folder), indents)
    others = [name for name in result.differ if name != which]
    said = [f"{kind.name}, seed {seed}: {which}", f"answered: {wrong.got[:300]}", f"should be: {wrong.want[:300]}"]
    said += ["of this file also: " + ", ".join(others)] if others else []
    return "".join("# " + line.replace("\n", " ") + "\n" for line in said) + Text(tree, indents).text


def still(kind, tree, first, folder):
    """Wrong where the same question differs of the smaller file, too; else None."""
    question, part, wrong = first
    path = path_in(folder, kind)
    write(path, Text(tree, kind.notation.indents).text)
    try:
        if question is not checks and errors(path):
            return None
        outcome = ask(question, kind.subject(path, folder, part, tree))
    except (Wrong, Refused, KeyError, IndexError):         # another difference, or a file without what is asked about
        return None
    return outcome if isinstance(outcome, Wrong) and outcome.question == wrong.question else None


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


# ---- many seeds

class Tally:
    def __init__(self):
        self.tried = self.accepted = self.asked = self.took = self.differ = 0
        self.refused, self.found = collections.Counter(), collections.Counter()

    def add(self, result):
        self.tried += 1
        self.accepted += result.accepted
        self.asked += result.asked
        self.took += result.took
        self.refused.update(result.refused)
        self.found.update(result.differ)
        self.differ += bool(result.differ)

    def __str__(self):
        said = f"{self.tried} files, {self.accepted} of them accepted, {self.asked} questions, {self.differ} files with a difference"
        refused = ", ".join(f"{code} {n}" for code, n in sorted(self.refused.items()))
        found = ", ".join(f"{question} {n}" for question, n in sorted(self.found.items()))
        return said + (f" ({found})" if found else "") + (f"; refused: {refused}" if refused else "")


def show(options, seed, case):
    print(case, flush=True)
    if options.out:
        write(os.path.join(options.out, f"{options.kind}-{seed}{KINDS[options.kind].suffix}"), case)


def search(options):
    started, tally = time.monotonic(), Tally()
    jobs = ((options.kind, seed) for seed in range(options.first, options.first + options.seeds))
    pool = Pool(options.jobs) if options.jobs > 1 else None
    for result in pool.imap(one_seed, jobs) if pool else map(one_seed, jobs):
        tally.add(result)
        new = [question for question in result.differ if tally.found[question] <= SHOWN]
        if result.differ:
            spent = f"after {time.monotonic() - started:.0f} s ({tally.took:.0f} of processors)"
            print(f"seed {result.seed}, {spent}: {', '.join(result.differ)}", flush=True)
        if new:
            show(options, result.seed, small_case(KINDS[options.kind], result.seed, new[0]))
        if options.seconds and time.monotonic() - started > options.seconds:
            break
    if pool:
        pool.terminate()
    print(f"{options.kind} from seed {options.first}: {tally}; {time.monotonic() - started:.0f} s")
    return sum(tally.found.values())


def check_files(kind, files):
    wrong, asked = 0, 0
    for path in files:
        result = Result(path)
        with tempfile.TemporaryDirectory() as folder:
            for question, part, found in ask_all(kind, copied(kind, path, folder), folder, result):
                print(f"{path}, {part}, {question.__name__}: {found.question}\n  answered: {found.got[:300]}\n  should be: {found.want[:300]}")
                wrong += 1
        asked += result.asked
    print(f"{len(files)} files, {asked} questions, {wrong} differences")
    return wrong


def copied(kind, path, folder):
    """The file in a folder of its own, with what lies beside it: what the kind puts there, and files of the same name but for the ending."""
    for name, text in kind.beside(random.Random(0)).items():
        write(os.path.join(folder, name), text)
    for other in glob.glob(glob.escape(os.path.splitext(path)[0]) + ".*"):
        shutil.copy(other, folder)
    return os.path.join(folder, os.path.basename(path))


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
    sys.exit(1 if (check_files(KINDS[options.kind], options.files) if options.files else search(options)) else 0)


if __name__ == "__main__":
    main()
