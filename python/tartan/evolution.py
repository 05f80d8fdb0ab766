"""Grammars through which genomes are mapped, and the evolution of sentences by a fitness of one's own."""
from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Any, List, Optional, Sequence, Union

from tartan._call import Watch, call, failure, lib, made, no_option, own, said, text
from tartan._tartan import ffi
from tartan._types import Progress
from tartan.errors import Error

__all__ = ["Evolution", "Generation", "Grammar", "Individual", "Mapping"]


@dataclass(frozen=True)
class Mapping:
    """What a genome is mapped to. reason: why there is no sentence, or ""."""

    valid: bool
    sentence: str
    reason: str
    used: int
    depth: int
    wraps: int


class Grammar:
    """The grammar of a file."""

    def __init__(self, file):
        self.file = file
        self._handle = made("tartan_grammar", lib.tartan_grammar_free, [], lib.tartan_grammar_new, file._module)
        self._mapper = made("tartan_mapper", lib.tartan_mapper_free, [self._handle], lib.tartan_mapper_new, self._handle)
        self._lock = threading.Lock()

    def map(self, codons: Sequence[int], *, wraps: Optional[int] = None, max_depth=None,
            max_steps: Optional[int] = None) -> Mapping:
        """What a genome, a list of whole numbers, is mapped to."""
        options = ffi.new("tartan_map_options *", lib.tartan_map_options_init())
        call(lib.tartan_map_options_of, self._handle, options)
        for option, value in (("wraps", wraps), ("max_depth", max_depth), ("max_steps", max_steps)):
            if value is not None:
                setattr(options, option, value)
        found = ffi.new("tartan_mapping *", lib.tartan_mapping_init())
        with self._lock:
            call(lib.tartan_map, self._mapper, ffi.new("uint64_t[]", list(codons)), len(codons), options, found)
            return Mapping(found.valid, _sentence(found.sentence, found.sentence_size), text(found.reason_text),
                           found.used, found.depth, found.wraps)

    def invert(self, sentence: str, max_depth=0, progress: Progress = None) -> List[int]:
        """A genome that is mapped to the sentence."""
        encoded, room, count = sentence.encode(), ffi.new("uint64_t **"), ffi.new("size_t *")
        call(lib.tartan_invert, self._handle, encoded, len(encoded), max_depth, Watch(progress), room, count)
        try:
            return list(room[0][0:count[0]])
        finally:
            lib.tartan_bytes_free(room[0])

    def derivations(self, depth: int) -> int:
        """How many derivations there are of at most `depth` levels; or, if the grammar has loops, of exactly so many
        codons."""
        return int(said(lib.tartan_grammar_derivations, self._handle, depth, ffi.new("bool *")))


def _sentence(start, size):
    return bytes(ffi.buffer(start, size)).decode("utf-8", "replace") if size else ""


@dataclass(frozen=True)
class Individual:
    """A member of a generation. scores: one of each objective, lower is better; infinite if it has none."""

    id: int
    parents: tuple
    codons: list
    sentence: str
    depth: int
    scores: tuple


class Generation:
    """Sentences that are to be scored: set `scores`, one number each, or one list of numbers each with several
    objectives; lower is better, and None says that a sentence cannot be scored."""

    def __init__(self, number, sentences):
        self.number = number
        self.sentences = sentences
        self.scores = None

    def __repr__(self):
        return f"Generation({self.number}, {len(self.sentences)} sentences)"


_CHOICES = {
    "selection": {"tournament": lib.TARTAN_SELECT_TOURNAMENT, "truncation": lib.TARTAN_SELECT_TRUNCATION,
                  "roulette": lib.TARTAN_SELECT_ROULETTE, "nsga2": lib.TARTAN_SELECT_NSGA2},
    "initialisation": {"random": lib.TARTAN_INITIALISE_RANDOM, "ramped": lib.TARTAN_INITIALISE_RAMPED,
                       "grow": lib.TARTAN_INITIALISE_GROW, "pi_grow": lib.TARTAN_INITIALISE_PI_GROW},
    "crossover": {"one_point": lib.TARTAN_CROSS_ONE_POINT, "fixed_one_point": lib.TARTAN_CROSS_FIXED_ONE_POINT,
                  "two_point": lib.TARTAN_CROSS_TWO_POINT, "fixed_two_point": lib.TARTAN_CROSS_FIXED_TWO_POINT,
                  "subtree": lib.TARTAN_CROSS_SUBTREE},
    "mutation": {"codons": lib.TARTAN_MUTATE_CODONS, "genome": lib.TARTAN_MUTATE_GENOME,
                 "subtree": lib.TARTAN_MUTATE_SUBTREE},
}
_NUMBERS = {"codons", "depth_low", "depth_high", "tail", "tournament", "truncation", "crossover_rate", "mutation_rate",
            "points_anywhere", "codon_limit", "max_codons", "tree_depth", "elites", "no_elites", "steady_state",
            "keep_copies", "islands", "migrants", "migrate_every"}


class Evolution:
    """A population of genomes, bred by scores that the caller gives:

        for generation in tartan.Evolution(file, population=100, seed=1, generations=50):
            generation.scores = [score(sentence) for sentence in generation.sentences]

    Only sentences that were not scored before are asked about: a step may ask several times, or not at all. Without
    `generations` it goes on until the loop is left. Other options are those of a study: selection, initialisation,
    crossover, mutation, tournament, elites and so on. A step repeats until all of its sentences have scores, so scores
    must depend on the sentences alone.
    """

    def __init__(self, file, *, population=0, seed: int = 1, objectives=1, generations=None, seeds=(), **options: Any) -> None:
        self.file = file
        self.objectives = objectives
        self.generations = generations
        self._scores: dict = {}
        self._asked: list = []
        settings = ffi.new("tartan_evolution_options *", lib.tartan_evolution_options_init())
        if lib.tartan_module_has_study(file._module):
            call(lib.tartan_evolution_options_of, file._module, settings)
        settings.population, settings.seed, settings.objectives = population, seed, objectives
        settings.evaluate = lib.tartan_python_evaluate
        self._self = ffi.new_handle(_Scorer(self))
        settings.context = self._self
        settings.threads, settings.batch = 1, 1 << 20
        kept = [ffi.new("uint64_t[]", list(codons)) for codons in seeds]
        genomes = ffi.new("tartan_genome[]", [{"codons": codons, "count": len(codons)} for codons in kept]) \
            if kept else ffi.NULL
        settings.seeds, settings.seed_count = genomes, len(kept)
        for option, value in options.items():
            self._set(settings, option, value)
        self._handle = made("tartan_evolution", lib.tartan_evolution_free, [self._self], lib.tartan_evolution_new,
                            file._module, settings)

    @staticmethod
    def _set(settings, option, value):
        if option in _CHOICES:
            if value not in _CHOICES[option]:
                raise ValueError(f"{option} is {', '.join(_CHOICES[option])}, not {value!r}")
            value = _CHOICES[option][value]
        elif option not in _NUMBERS:
            named = {"population", "seed", "objectives", "generations", "seeds"}
            raise no_option("an evolution", option, _NUMBERS | set(_CHOICES) | named)
        setattr(settings, option, value)

    def __iter__(self):
        while self.generations is None or self.done < self.generations:
            yield from self._step()

    def _step(self):
        """Makes the next generation; yields what has to be scored for it."""
        self._scores.clear()
        while not self._attempt():
            asked = Generation(self.done, self._asked)
            yield asked
            self._take(asked)

    def _attempt(self):
        """False: sentences are wanting scores. A step that was stopped has changed nothing."""
        self._asked = []
        error = ffi.new("tartan_error *")
        status = lib.tartan_evolution_step(self._handle, ffi.NULL, error)
        if status == lib.TARTAN_STOPPED and self._asked:
            return False
        if status != lib.TARTAN_OK:
            raise failure(error)
        return True

    def _take(self, asked):
        scores = asked.scores
        if scores is None or len(scores) != len(asked.sentences):
            raise Error(f"generation {asked.number} has {len(asked.sentences)} sentences, and "
                        f"{0 if scores is None else len(scores)} scores", help="set `generation.scores` in each turn")
        for sentence, score in zip(asked.sentences, scores):
            numbers = None if score is None else [float(score)] if self.objectives == 1 and not hasattr(score, "__len__") \
                else [float(number) for number in score]
            if numbers is not None and len(numbers) != self.objectives:
                raise Error(f"a score has {len(numbers)} numbers, and there are {self.objectives} objectives")
            self._scores[sentence] = numbers

    @property
    def done(self) -> int:
        """How many generations have been made."""
        return lib.tartan_evolution_done(self._handle)

    @property
    def members(self) -> List[Individual]:
        """The newest generation, the best first."""
        return [self._member(i) for i in range(lib.tartan_evolution_members(self._handle))]

    @property
    def best(self) -> Optional[Individual]:
        """The best member; None before the first generation."""
        return self._member(0) if lib.tartan_evolution_members(self._handle) else None

    @property
    def front(self) -> List[Individual]:
        """With several objectives: the members that no other is better than in all."""
        return [self._member(i) for i in range(lib.tartan_evolution_front(self._handle))]

    def _member(self, i):
        found = ffi.new("tartan_individual *", lib.tartan_individual_init())
        call(lib.tartan_evolution_member, self._handle, i, found)
        parents = tuple(parent for parent in found.parents if parent != lib.TARTAN_NO_PARENT)
        return Individual(found.id, parents, list(found.codons[0:found.codon_count]),
                          _sentence(found.sentence, found.sentence_size), found.depth,
                          tuple(found.objectives[0:self.objectives]))

    def choose(self, places: Sequence[int]) -> None:
        """The parents of the next generation, as a person chose them: places of members."""
        call(lib.tartan_evolution_choose, self._handle, ffi.new("uint32_t[]", list(places)), len(places))

    def save(self) -> bytes:
        """The run so far, as bytes."""
        room, size = ffi.new("void **"), ffi.new("size_t *")
        call(lib.tartan_evolution_save, self._handle, room, size)
        try:
            return bytes(ffi.buffer(room[0], size[0]))
        finally:
            lib.tartan_bytes_free(room[0])

    def __repr__(self):
        return f"Evolution({self.file.name!r}, {self.done} generations)"


class _Scorer:
    """Answers from the scores that are there, and notes the sentences that have none."""

    def __init__(self, evolution):
        import weakref
        self.evolution = weakref.proxy(evolution)

    def answer(self, sentences, count, scores):
        wanting = False
        for i in range(count):
            sentence = _sentence(sentences[i].text, sentences[i].size)
            if sentence not in self.evolution._scores:
                self.evolution._asked.append(sentence)
                wanting = True
                continue
            numbers = self.evolution._scores[sentence]
            if numbers is None:
                scores[i].state = lib.TARTAN_SCORE_FAILED
            else:
                scores[i].objectives[0:len(numbers)] = numbers
        return lib.TARTAN_STOPPED if wanting else lib.TARTAN_OK


@ffi.def_extern(name="tartan_python_evaluate", error=lib.TARTAN_INTERNAL)
def _evaluate(context, thread, sentences, count, scores, error):
    return ffi.from_handle(context).answer(sentences, count, scores)
