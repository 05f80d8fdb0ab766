"""Every question about a grammar of genomes against every other, and against a mapper in Python (genome_reader.py)."""
import functools
import itertools
import os
import random
import re
import xml.etree.ElementTree as xml

from file_questions import content, keeps_its_meaning, loads, says_json
from genome_reader import Grammar, Mapped, NotValid, derivations, sentences
from program import Wrong, answer, json_lines, read_json, run, same
from subject import Subject

GENOMES = 40
STEPS = ["--max-steps", "3000"]
LISTED = 300             # sentences that are listed here
LARGEST = 2**64 - 1


class GenomeSubject(Subject):
    @functools.cached_property
    def grammar(self):
        return Grammar(self.text)

    @property
    def anywhere(self):
        return self.grammar.settings.get("mapping") == "position-independent"

    @functools.cached_property
    def genomes(self):
        chosen = random.Random(self.text)
        size = lambda: chosen.choice([1, 2, 3, 5, 8, 13, 30])
        return [[chosen.choice([chosen.randint(0, 9), chosen.randint(0, 10**6), LARGEST]) for _ in range(size())] for _ in range(GENOMES)]

    def file_of_genomes(self):
        return self.file("asked.genomes", "".join(" ".join(map(str, genome)) + "\n" for genome in self.genomes))

    @functools.cached_property
    def mapped(self):
        return json_lines("map", answer("map", self.path, "--genomes", self.file_of_genomes(), "--format", "json", *STEPS))

    def as_text(self, genome):
        return " ".join(map(str, genome))


def compared(subject, found, **how):
    same("a line for each genome", len(found), len(subject.genomes))
    for genome, said in zip(subject.genomes, found):
        try:
            want = Mapped(subject.grammar, genome, **how)
        except NotValid:
            same(f"valid, {genome}", said["valid"], False)
            continue
        if not said["valid"] and "long" in said["reason"]:
            continue
        same(f"the sentence of {genome}", (said["valid"], said["phenotype"]), (True, want.sentence))
        same(f"codons, nodes, depth and wraps of {genome}", (said["used_codons"], said["nodes"], said["depth"], said["wraps"]),
             (want.used, want.nodes, want.depth, max(0, want.used - 1) // len(genome)))


def mapping(subject):
    """Genomes are mapped as docs/genome-language.md says."""
    compared(subject, subject.mapped, anywhere=subject.anywhere)


def otherwise(subject):
    """The same with other wraps and depths, and the other order."""
    grammar = subject.grammar
    hows = [(["--wraps", "3"], {"wraps": 3, "anywhere": subject.anywhere}), (["--max-depth", "4"], {"depth": 4, "anywhere": subject.anywhere})]
    if not grammar.genr8 and not grammar.skips:
        hows += [(["--mapping", "position-independent"], {"anywhere": True}), (["--mapping", "leftmost"], {"anywhere": False})]
    for options, how in hows:
        found = json_lines("map", answer("map", subject.path, "--genomes", subject.file_of_genomes(), "--format", "json", *STEPS, *options))
        compared(subject, found, **how)


def one_by_one(subject):
    """A genome by itself, from a file, of a module; random ones twice."""
    text = answer("map", subject.path, "--genomes", subject.file_of_genomes(), *STEPS)
    for genome, said in list(zip(subject.genomes, subject.mapped))[:3]:
        same("a genome by itself", json_lines("map", answer("map", subject.path, "--genome", subject.as_text(genome), "--format", "json", *STEPS)), [said])
    built = os.path.join(subject.folder, "built.tnb")
    answer("build", subject.path, "-o", built)
    same("genomes mapped by a module", answer("map", built, "--genomes", subject.file_of_genomes(), *STEPS), text)
    drawn = [answer("map", subject.path, "--random", "5", "--seed", "3", "--codons", "40", "--format", "json", *STEPS) for _ in range(2)]
    same("random genomes twice", drawn[1], drawn[0])
    json_lines("map --random", drawn[0])


def trees(subject):
    """The leaves of a tree are the sentence; its nodes chose what their codons say; so does the trace."""
    valid = [(g, s) for g, s in zip(subject.genomes, subject.mapped) if s["valid"]]
    for genome, said in valid[:4]:
        drawn = read_json("--tree json", answer("map", subject.path, "--genome", subject.as_text(genome), "--tree", "json", *STEPS))
        leaves, choices = [], []
        for root in drawn:
            follow(root, leaves, choices)
        same("leaves of the tree", (" " if subject.grammar.genr8 else "").join(leaves), said["phenotype"])
        same("choices of the tree", [c for c in choices if int(c[0]) % int(c[1]) != int(c[2])], [])
        traced = answer("map", subject.path, "--genome", subject.as_text(genome), "--trace", *STEPS)
        rows = re.findall(r"^ *(\d+) +(\d+) +(\d+) = (\d+)  ", traced, re.M)
        same("rows of the trace", len(rows), said["used_codons"])
        wrong = [r for i, r in enumerate(rows) if int(r[1]) != genome[i % len(genome)] or int(r[1]) % int(r[2]) != int(r[3])]
        same("rows of the trace that are wrong", wrong, [])
        picture = os.path.join(subject.folder, "tree.svg")
        answer("map", subject.path, "--genome", subject.as_text(genome), "--tree", picture, *STEPS)
        try:
            xml.parse(picture)
        except xml.ParseError as wrong:
            raise Wrong("the picture is XML", wrong, "XML") from None


def follow(node, leaves, choices):
    if "terminal" in node:
        leaves.append(node["terminal"])
    if "edge" in node:
        leaves.append(f"Edge{node['edge']}")
    if node.get("codon") is not None and node.get("modulus") is not None:
        choices.append((node["codon"], node["modulus"], node["choice"]))
    for child in node.get("children", []):
        follow(child, leaves, choices)


def inverted(subject):
    """A genome that is found for a sentence maps to it; for what a genome maps to, one is found."""
    for said in [s for s in subject.mapped if s["valid"]][:8]:
        sentence = said["phenotype"]
        code, out, err = run("map", subject.path, "--invert", sentence, *STEPS)
        if code == 4:
            continue
        same(f"--invert of {sentence!r}, which is a sentence, ends with {err[:120]}", code, 0)
        back = json_lines("map", answer("map", subject.path, "--genome", out.strip(), "--format", "json", "--wraps", "0"))[0] if out.strip() else None
        same("the sentence of the genome that was found", back and back["phenotype"], sentence if back else None)


def belongs(subject):
    """Of a small language, what is a sentence is found, and what is none is not."""
    grammar = subject.grammar
    if grammar.genr8 or not grammar.depth:
        return
    every = sentences(grammar, grammar.depth, LISTED)
    if every is None:
        return
    chosen = random.Random(subject.text)
    asked = sorted(every)[:6] + chosen.sample(sorted(every), min(6, len(every)))
    others = [s[:i] + s[i + 1:] for s in asked for i in range(len(s)) if s[:i] + s[i + 1:] not in every][:8] + [s + "x" for s in asked if s + "x" not in every][:3]
    for sentence, wanted in [(s, 0) for s in asked] + [(s, 1) for s in others]:
        code, out, _ = run("map", subject.path, "--invert", sentence)
        same(f"--invert of {sentence!r} ends with", code, wanted)
        if code == 0 and out.strip():
            back = json_lines("map", answer("map", subject.path, "--genome", out.strip(), "--format", "json"))[0]
            same("the sentence of the genome that was found", back["phenotype"], sentence)


def counted(subject):
    """Derivations are counted by their depth as here, and no sentence is less deep than `check` says."""
    grammar = subject.grammar
    code, _, err = run("check", subject.path, "--figures")
    same("check --figures ends with", code, 0)
    groups = any(item[0] in ("repeat", "maybe") for rule in grammar.rules.values() for items in rule for item in items)
    for levels, number in re.findall(r"derivations of at most (\d+) levels: (\d+)$", err, re.M) if not groups and not grammar.genr8 else []:
        same(f"derivations of at most {levels} levels", int(number), derivations(grammar, int(levels)))
    figures = re.search(r"(\d+) rules? with (\d+) alternatives?", err)
    same("rules and alternatives", tuple(map(int, figures.groups())), (len(grammar.rules), sum(map(len, grammar.rules.values()))))


def limits(subject):
    """A limit of steps makes a genome not valid, and changes no other."""
    found = json_lines("map", answer("map", subject.path, "--genomes", subject.file_of_genomes(), "--format", "json", "--max-steps", "5"))
    for short, whole in zip(found, subject.mapped):
        if short["valid"]:
            same("a genome with less steps", short, whole)


# ---- breeding

def bred(subject):
    """A run is the same with any number of threads and where it was interrupted; its individuals are what their genomes map to, and have the
    score that docs/evolution.md says."""
    chosen, wanted = random.Random(subject.text), random.Random(subject.text).choice(["x+7", "xxy", "7"])
    settings = [chosen.choice(["selection tournament 2", "selection tournament 4", ""]), chosen.choice(["crossover subtree 0.8", "crossover one-point 0.5", ""]),
                chosen.choice(["mutation codons 0.05", ""]), f"seed {chosen.randint(0, 99)}"]
    study = subject.file("bred.study", "evolution {\n  grammar \"%s\"\n  match \"%s\"\n  population 8\n  generations 3\n  %s\n}\n" % (
        os.path.basename(subject.path), wanted, "\n  ".join(settings)))
    runs = [os.path.join(subject.folder, name) for name in ("one.run", "two.run", "three.run")]
    code, _, err = run("evolve", study, "-o", runs[0], "--threads", "1")
    if code == 1 and "--max" not in err and "E12" in err:
        return                                   # a setting that does not go with the grammar
    same("evolve ends with", code, 0)
    answer("evolve", study, "-o", runs[1], "--threads", "4")
    answer("evolve", study, "-o", runs[2], "--generations", "1")
    answer("evolve", study, "-o", runs[2], "--resume", "--generations", "3")
    for name in ("run.sqlite", "stats.csv", "fitness.svg"):
        first = content(os.path.join(runs[0], name))
        same(f"{name} with 4 threads", content(os.path.join(runs[1], name)) == first, True)
        same(f"{name} of a run that was interrupted", content(os.path.join(runs[2], name)) == first, True)
    for number in (0, 3, 9, 12):
        replayed(subject, runs[0], number, wanted)


def replayed(subject, folder, number, wanted):
    code, out, _ = run("runs", "replay", folder, str(number))
    found = re.match(r"# individual \d+[^\n]*?(?:, score (\S+))?\n# genome: ([^\n]*)\n(.*)\n", out, re.S)
    if code or not found:
        return
    genome = [int(codon) for codon in found[2].split()]
    try:
        sentence = Mapped(subject.grammar, genome, anywhere=subject.anywhere).sentence
    except NotValid:
        return
    same(f"individual {number} is what its genome maps to", found[3], sentence)
    if found[1] and sentence.isascii():
        score = sum(1 - (1 / (1 + abs(ord(a) - ord(b))) if a and b else 0) for a, b in itertools.zip_longest(sentence, wanted, fillvalue=""))
        same(f"score of {sentence!r}", abs(float(found[1]) - score) <= 1e-4 * max(1, score), True)


QUICK = [mapping]
OF_GRAMMARS = [loads, keeps_its_meaning, says_json, otherwise, one_by_one, trees, inverted, belongs, counted, limits, bred]
