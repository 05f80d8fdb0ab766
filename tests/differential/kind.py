"""A kind of files that is searched: what files are made of, and what they are asked."""
import functools
import os

from grammar import read_grammar

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


class Kind:
    """Each kind is an instance of a class of its own below this one, and a row of kinds.py."""
    name = None
    grammar_file = None              # below grammar/
    suffix = None                    # of its files
    notation = None                  # what is known of it beside its grammar (maker.Notation)
    literals = {}                    # texts of tokens that are always written the same, where the grammar file does not say so
    not_reached = {}                 # productions that no file has, and why

    @functools.cached_property
    def grammar(self):
        grammar = read_grammar(os.path.join(ROOT, "grammar", self.grammar_file))
        grammar.literals.update(self.literals)
        return grammar

    def make_file(self, maker):
        """A random derivation tree of a whole file."""
        raise NotImplementedError(self.name)

    def beside(self, random):
        """Name and text of each file that lies beside the one that is searched, for it to name."""
        return {}

    def subject(self, path, folder, part, tree):
        """What questions are given."""
        raise NotImplementedError(self.name)

    def questions(self, path):
        """(question, part or None) of a file that `check` accepts: those that are always asked, and those of which some are."""
        raise NotImplementedError(self.name)
