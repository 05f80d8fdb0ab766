"""What a question is asked about."""
import os

from program import answer, read_json


class Subject:
    """A file, or a part of it (a library, a surface, a design), with the answers that several questions need. Kinds have classes of
    their own below this one. The folder has what lies beside the file, and takes what questions write."""

    def __init__(self, path, folder, part=None, tree=None):
        self.path, self.folder, self.part = path, folder, part
        self.tree = tree                         # its derivation tree, where it is known
        self.options = []                        # that name the part
        with open(path, encoding="utf-8") as file:
            self.text = file.read()

    def ask(self, command, *more, file=None):
        return answer(command, file or self.path, *more, *self.options)

    def json(self, command, *more, file=None):
        return read_json(command, self.ask(command, *more, "--json", file=file))

    def file(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path
