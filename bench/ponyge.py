"""How long runs of grammatical evolution take, in processor time, beside programs in Python: ponyge.py TARTAN

Three problems, each with a population of 500 and 50 generations: a text to match; Vladislavleva-4 with 1,024 lines of data and the functions
of PonyGE2's own grammar for it (sin, exp, tanh, logarithms, roots); and the problem MAX, whose sentences grow as long as the depth allows.
Medians of three seeds, one thread. Whole commands are timed: Tartan writes its database, statistics and pictures, too.

PonyGE2 runs where the environment's TARTAN_PONYGE2 names its folder. ge_peer.py, written for this bench, is plain grammatical evolution in
Python with NumPy, and runs everywhere; what needs NumPy is left out, with a word, where that is missing.
"""
import json
import os
import random
import resource
import statistics
import subprocess
import sys
import tempfile

SEEDS, GENERATIONS = range(3), 50

LETTERS = """<text> ::= <letter> | <letter><text>
<letter> ::= <small> | <small> | <large> | " "
<small> ::= e | t | a | o | i | n | s | h | r | d | l | c | u | m | w | f | g | y | p | b | v | k | j | x | q | z
<large> ::= E | T | A | O | I | N | S | H | R | D | L | C | U | M | W | F | G | Y | P | B | V | K | J | X | Q | Z
"""
FUNCTIONS = """<e> ::= <e>+<e> | <e>-<e> | <e>*<e> | pdiv(<e>,<e>) | psqrt(<e>) | np.sin(<e>) | np.tanh(<e>) | np.exp(<e>) | plog(<e>)
  | <v> | <v> | <v> | <v> | <v> | <d><d>.<d><d>
<v> ::= x[:, 0] | x[:, 1] | x[:, 2] | x[:, 3] | x[:, 4]
<d> ::= GE_RANGE:10
"""
SUMS = """<e> ::= (<e>+<e>) | (<e>*<e>) | (<e>+<e>) | (<e>*<e>) | 0.5 | x[:, 0]
"""
STUDY = """evolution {
  grammar "own.bnf"
  %s
  population 500
  generations %d
  depth 2..10
  max-depth 17
  seed %d
}
"""


def processor_time(command, folder):
    """Seconds that the command and its children computed."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def write_vladislavleva(path):
    draw = random.Random(4)
    with open(path, "w") as out:
        print("\t".join(["x0", "x1", "x2", "x3", "x4", "response"]), file=out)
        for _ in range(1024):
            x = [draw.uniform(0.05, 6.05) for _ in range(5)]
            print("\t".join(f"{v:.12g}" for v in x + [10 / (5 + sum((v - 3) ** 2 for v in x))]), file=out)


def write_max(path):
    with open(path, "w") as out:
        print("x0\tresponse", file=out)
        for i in range(1, 17):
            print(f"{i / 16:.12g}\t65536", file=out)


# name, grammar, data's writer or None, PonyGE2's own parameters for it
PROBLEMS = [
    ("a text to match", LETTERS, None, ["--grammar_file", "letter.bnf", "--fitness_function", "string_match", "--target", "Hello world"]),
    ("Vladislavleva-4", FUNCTIONS, write_vladislavleva, ["--grammar_file", "supervised_learning/Vladislavleva4.bnf", "--fitness_function",
                                                         "supervised_learning.regression", "--dataset_train"]),
    ("MAX", SUMS, write_max, None),
]


def has_numpy():
    return subprocess.run([sys.executable, "-c", "import numpy"], stderr=subprocess.DEVNULL).returncode == 0


def commands(tartan, folder, problem, seed):
    """(who, command or why not, folder)"""
    name, grammar, writer, parameters = problem
    data = f"{folder}/train.txt"
    with open(f"{folder}/own.bnf", "w") as out:
        out.write(grammar)
    with open(f"{folder}/{seed}.study", "w") as out:
        out.write(STUDY % ('fit "train.txt"' if writer else 'match "Hello world"', GENERATIONS, seed))
    with open(f"{folder}/problem.json", "w") as out:
        json.dump({"grammar": grammar, **({"data": data} if writer else {"match": "Hello world"})}, out)
    if writer:
        writer(data)
    yield "Tartan", [tartan, "evolve", f"{seed}.study", "--threads", "1"], folder
    missing = "NumPy is not here" if not has_numpy() else None
    peer = os.path.join(os.path.dirname(os.path.abspath(__file__)), "ge_peer.py")
    yield "ge_peer.py", missing if writer and missing else [sys.executable, peer, "problem.json", str(GENERATIONS), str(seed)], folder
    pony = os.environ.get("TARTAN_PONYGE2")
    if not parameters:
        yield "PonyGE2", "it has no such problem", folder
    elif not pony or missing:
        yield "PonyGE2", missing or "TARTAN_PONYGE2 does not say where it is", folder
    else:
        yield "PonyGE2", [sys.executable, "ponyge.py", *parameters, *([data] if writer else []), "--population_size", "500", "--generations",
                          str(GENERATIONS), "--max_tree_depth", "17", "--random_seed", str(seed), "--silent"], os.path.join(pony, "src")


# how many times as long PonyGE2 is to take, at least
ASKED = {"Vladislavleva-4": 16}


def main():
    tartan = os.path.abspath(sys.argv[1])
    print(f"{'500 individuals, 50 generations, whole runs':46} {'s':>8} {'of Tartan':>10} {'asked':>8}")
    for problem in PROBLEMS:
        times, missing = {}, {}
        with tempfile.TemporaryDirectory() as folder:
            for seed in SEEDS:
                for who, command, place in commands(tartan, folder, problem, seed):
                    if isinstance(command, str):
                        missing[who] = command
                    else:
                        times.setdefault(who, []).append(processor_time(command, place))
        own = statistics.median(times["Tartan"])
        for who in ("Tartan", "ge_peer.py", "PonyGE2"):
            label = f"  {problem[0]}, {who}"
            asked = f"{ASKED[problem[0]]}x" if who == "PonyGE2" and problem[0] in ASKED else ""
            if who in missing:
                print(f"{label:46} {missing[who]}{asked and '; asked: ' + asked}")
            else:
                time = statistics.median(times[who])
                print(f"{label:46} {time:8.2f} {time / own:9.1f}x {asked:>8}".rstrip())


if __name__ == "__main__":
    main()
