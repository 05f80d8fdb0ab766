"""How long a run of Vladislavleva-4 takes, in processor time: ponyge.py TARTAN [PONYGE2]

Population 500, 50 generations, 1,024 points, the functions of PonyGE2's own grammar for it (sin, exp, tanh, logarithms, roots). PONYGE2 is a
folder with PonyGE2: then that makes the same number of generations with the same data, and the ratio is printed. It is skipped where the folder
or NumPy is missing. Both write their results to files, as users have them. Medians of three runs, one thread.
"""
import os
import random
import resource
import statistics
import subprocess
import sys
import tempfile

GRAMMAR = """<e> ::= <e>+<e> | <e>-<e> | <e>*<e> | pdiv(<e>,<e>) | psqrt(<e>) | np.sin(<e>) | np.tanh(<e>) | np.exp(<e>) | plog(<e>)
  | <v> | <v> | <v> | <v> | <v> | <d><d>.<d><d>
<v> ::= %s
<d> ::= GE_RANGE:10
"""
STUDY = """evolution {
  grammar "functions.bnf"
  fit "train.txt"
  population 500
  generations 50
  depth 1..10
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


def write_data(path, points, low, high):
    draw = random.Random(4)
    with open(path, "w") as out:
        print("\t".join(["x0", "x1", "x2", "x3", "x4", "response"]), file=out)
        for _ in range(points):
            x = [draw.uniform(low, high) for _ in range(5)]
            print("\t".join(f"{v:.12g}" for v in x + [10 / (5 + sum((v - 3) ** 2 for v in x))]), file=out)


def ponyge_command(folder, data, seed):
    return [sys.executable, "ponyge.py", "--grammar_file", "supervised_learning/Vladislavleva4.bnf", "--fitness_function",
            "supervised_learning.regression", "--dataset_train", data, "--population_size", "500", "--generations", "50",
            "--max_tree_depth", "17", "--random_seed", str(seed), "--silent"]


def main():
    tartan, peer = os.path.abspath(sys.argv[1]), sys.argv[2] if len(sys.argv) > 2 else None
    with tempfile.TemporaryDirectory() as folder:
        write_data(f"{folder}/train.txt", 1024, 0.05, 6.05)
        with open(f"{folder}/functions.bnf", "w") as out:
            out.write(GRAMMAR % " | ".join(f"x[:, {i}]" for i in range(5)))
        times = []
        for seed in range(3):
            with open(f"{folder}/{seed}.study", "w") as out:
                out.write(STUDY % seed)
            times.append(processor_time([tartan, "evolve", f"{seed}.study", "--threads", "1"], folder))
        own = statistics.median(times)
        print(f"Vladislavleva-4, Tartan   {own:8.2f} s")
        try:
            import numpy  # noqa: F401
        except ImportError:
            peer = None
        if not peer:
            print("Vladislavleva-4, PonyGE2  not here")
            return
        times = [processor_time(ponyge_command(peer, f"{folder}/train.txt", seed), os.path.join(peer, "src")) for seed in range(3)]
        print(f"Vladislavleva-4, PonyGE2  {statistics.median(times):8.2f} s, {statistics.median(times) / own:.1f} times as long")


if __name__ == "__main__":
    main()
