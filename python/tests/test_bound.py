"""Each function of the C interface is called by the package, or stands here with what does its work."""
import os
import re
import unittest

import tartan
from tartan._tartan import lib

#: What the package does without, and why.
UNBOUND = {
    "analysis": "the question `check`",
    "best": "the question `best`, which Ctrl-C ends",
    "completions": "the question `complete`, which Ctrl-C ends",
    "coverage": "the question `coverage`",
    "derivation": "the question `map`, with a picture",
    "distribution": "the question `count`, which Ctrl-C ends",
    "explain": "the question `explain`",
    "explanation": "the question `explain`",
    "format": "the question `format`",
    "front": "the question `pareto`, which Ctrl-C ends",
    "near": "the question `explain`, with `nearest`",
    "run": "the questions `runs` and `individual`",
}
ALONE = {
    "tartan_evolution_generation": "the numbers of a generation are those of its members",
    "tartan_evolution_restore": "a study that is resumed is a run: the question `evolve`",
    "tartan_mapper_nodes": "the question `map`",
    "tartan_match": "tartan_match_any of one plan",
    "tartan_match_all": "a rule at a time: tartan_match_any",
    "tartan_matcher_free": "as tartan_match",
    "tartan_matcher_new": "as tartan_match",
    "tartan_module_bytes": "a file is compiled each time",
    "tartan_module_has_grammar": "what needs one says that there is none",
    "tartan_module_has_growth": "what needs one says that there is none",
    "tartan_module_has_places": "what needs one says that there is none",
    "tartan_module_load": "a file is compiled each time",
    "tartan_module_load_file": "tartan_compile_file refuses modules; they are for programs without a compiler",
    "tartan_plans_next": "tartan_plans_take, many at a time",
    "tartan_rules_count": "a Rule is one",
    "tartan_rules_name": "a Rule is one",
    "tartan_rules_words": "a Rule is one",
    "tartan_session_take_bytes": "bytes in answers are decoded",
    "tartan_source_module": "the file has its own",
    "tartan_source_cover": "the question `coverage`",
    "tartan_source_report": "the question `report`",
    "tartan_tests_failed": "counted from the cases",
}


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def package():
    """All that the package is written in."""
    folder = os.path.dirname(tartan.__file__)
    return "\n".join(read(os.path.join(folder, name))
                     for name in sorted(os.listdir(folder)) if name.endswith(".py"))


class Bound(unittest.TestCase):
    def test_every_function(self):
        text = package()
        kinds = set(re.findall(r"tartan_module_\{kind\}_(\w+)", text))
        called = set(re.findall(r"\btartan_\w+", text))
        called |= {f"tartan_module_{kind}_{what}" for kind in ("rule", "library", "house_library", "surface")
                   for what in kinds | {"doc"}}
        functions = {name for name in dir(lib) if name.startswith("tartan_") and not name.startswith("tartan_python_")}
        missing = {name for name in functions - called if not name.endswith("_init") and name not in ALONE and
                   name.split("_")[1] not in UNBOUND}
        self.assertEqual(missing, set())
        self.assertEqual({name for name in ALONE if name in called or name not in functions}, set(), "these are called, or gone")

    def test_questions(self):
        """Each question has a type of answer that can be read."""
        from tartan import _requests
        for request, answers, _ in _requests.QUESTIONS.values():
            self.assertIn(request, _requests.MESSAGES)
            self.assertTrue(all(answer in _requests.MESSAGES for answer in answers))


if __name__ == "__main__":
    unittest.main()
