"""The examples of docs/python.md do what it says."""
import doctest
import os
import re
import sys
import unittest

from support import Folder
from tartan import _arrays

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "docs", "python.md")


@unittest.skipUnless(_arrays.numpy, "the page shows what numpy makes")
class Page(unittest.TestCase):
    def test_examples(self):
        with open(PAGE, encoding="utf-8") as page:
            text = page.read()
        before = os.getcwd()
        with Folder() as folder:
            for name, rules in re.findall(r"^```\w+\n(?=# (\S+\.plan)\n)(.*?)^```$", text, re.S | re.M):
                folder.write(name, rules)
            os.chdir(folder.path)
            try:
                found = doctest.DocTestParser().get_doctest(re.sub(r"^```.*$", "", text, flags=re.M), {}, "docs/python.md", PAGE, 0)
                runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
                runner.run(found, out=sys.stderr.write)
            finally:
                os.chdir(before)
        self.assertGreater(runner.summarize(verbose=False).attempted, 40)
        self.assertEqual(runner.failures, 0)


if __name__ == "__main__":
    unittest.main()
