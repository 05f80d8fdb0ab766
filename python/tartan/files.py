"""Rule files: compiled, tested, asked."""
from __future__ import annotations

import collections.abc
import json
import os
import threading
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, TYPE_CHECKING

from tartan import _html, answers
from tartan._call import Report, Watch, call, lib, made, name, path as path_for_call, taken, text, texts
from tartan._tartan import ffi
from tartan._types import Path, Progress
from tartan.errors import Error
from tartan.libraries import Library, Rule

if TYPE_CHECKING:
    from tartan.answers import Answer
    from tartan.errors import Diagnostic
    from tartan.evolution import Grammar
    from tartan.houses import HouseLibrary
    from tartan.meshes import Mesh
    from tartan.models import Model
    from tartan.surfaces import Surface

__all__ = ["File", "Test", "Tests", "stdlib"]


def stdlib() -> Dict[str, str]:
    """The files of the standard library: their texts by their names."""
    return {text(lib.tartan_stdlib_name(i)): _stdlib_text(text(lib.tartan_stdlib_name(i)))
            for i in range(lib.tartan_stdlib_count())}


def _from_stdlib(of):
    """The name and the text of the file of the standard library that is called so, without an extension."""
    found = next((file for file in stdlib() if os.path.splitext(file)[0] == of), None)
    return (None, None) if found is None else (found, _stdlib_text(found))


def _stdlib_text(of):
    return text(lib.tartan_stdlib_text(name(of), ffi.NULL))


class File:
    """A rule file, compiled: of any notation, by its path, by the name of a file of the standard library
    ("cottage"), or as a text, whose `name` says the notation.

    set: values for the params of a .plan file, {"lot": "12m"}. folders: where `use "name"` is looked for, instead of the
    standard library. A file that does not compile is an Error, with `diagnostics`; what else there is to say is in
    `diagnostics` here.
    """

    def __init__(self, path: Optional[Path] = None, *, text=None, name: Optional[str] = None, set=None, folders=(),
                 warnings_are_errors=False, progress: Progress = None) -> None:
        if (path is None) == (text is None):
            raise TypeError("a file is given by its path, or as a text")
        self.path = None if path is None else os.fspath(path)
        if self.path is not None and not os.path.exists(self.path):
            name, text = _from_stdlib(os.fsdecode(self.path))
        self.name = name or self.path or "text.plan"
        self.text = text
        self._params = [f"{param}={value}" for param, value in (set or {}).items()]
        self._folders = [os.fsdecode(folder) for folder in folders]
        self._strict = warnings_are_errors
        self._session: Any = None
        self._source: Any = None
        self._shown: Any = None
        self._lock = threading.RLock()
        report = Report()
        self._module = self._compiled("tartan_module", lib.tartan_module_free, report, progress,
                                      lib.tartan_compile_text if text is not None else lib.tartan_compile_file)
        self.diagnostics = report.diagnostics
        self.rules = Rules(self)

    def _compiled(self, kind, free, report, progress, function, *more):
        """What a function compiles of the file, which may say something."""
        options = ffi.new("tartan_compile_options *", lib.tartan_compile_options_init())
        watch = Watch(progress)
        params, kept = texts(self._params)
        folders, also_kept = texts(self._folders)
        options.report, options.report_context = lib.tartan_python_report, report.context
        options.params, options.param_count = params, len(kept)
        options.folders, options.folder_count = folders, len(also_kept)
        options.warnings_are_errors = self._strict
        options.watch = watch.cdata
        try:
            return made(kind, free, [], function, *self._where(function), options, *more)
        except Error as error:
            if watch.raised is not None:
                raise watch.raised from None
            error.diagnostics = tuple(report.diagnostics)
            raise

    def _where(self, function):
        """The arguments that say which file: its path, and its text."""
        whole = path_for_call(self.name)
        if function is lib.tartan_compile_file:
            return (whole,)
        if self.text is None:
            return whole, ffi.NULL, 0
        encoded = self.text.encode()
        return whole, ffi.from_buffer(encoded) if encoded else ffi.new("char[1]"), len(encoded)

    def _narrowed(self, library, wheres, progress=None):
        """The module of the file with further requirements of a library."""
        asked, kept = texts(wheres)
        return self._compiled("tartan_module", lib.tartan_module_free, Report(), progress, lib.tartan_compile_where,
                              name(library), asked, len(kept))

    # ---- what is in it

    def _listed(self, kind):
        count = getattr(lib, f"tartan_module_{kind}_count")(self._module)
        return [text(getattr(lib, f"tartan_module_{kind}_name")(self._module, i)) for i in range(count)]

    def _docs(self, kind):
        doc = getattr(lib, f"tartan_module_{kind}_doc")
        return {of: text(doc(self._module, i)) or None for i, of in enumerate(self._listed(kind))}

    @property
    def libraries(self) -> List[str]:
        """The names of its libraries of plans, those of files that it uses first."""
        return self._listed("library")

    @property
    def house_libraries(self) -> List[str]:
        """The names of its libraries of houses."""
        return self._listed("house_library")

    @property
    def surfaces(self) -> List[str]:
        """The names of its implicit surfaces."""
        return self._listed("surface")

    @property
    def shown(self) -> Answer:
        """All that it has, as the question `schema` answers."""
        if self._shown is None:
            self._shown = self.ask("schema")
        return self._shown

    def _only(self, kind, of, names, own):
        if of is not None:
            return of
        if len(own) == 1:
            return own[0]
        said = f"it has {', '.join(own)}: say which" if own else f"it has no {kind} of its own"
        raise Error(f"{self.name}: {said}", help=f"those of files that it uses are {', '.join(names)}" if names and
                    not own else None)

    def library(self, name: Optional[str] = None, progress: Progress = None) -> Library:
        """A library of plans, by its name; without one, its only one."""
        return Library(self, name if name is not None else self._own_library("library", self.libraries), progress=progress)

    def _own_library(self, kind, names):
        """The name of the only library that stands in the file itself."""
        own = [found.name for found in self.shown.libraries if (found.plans is not None) == (kind == "house_library")]
        return self._only("library of houses" if kind == "house_library" else "library", None, names, own)

    def houses(self, name: Optional[str] = None, progress: Progress = None, max_houses: Optional[int] = None) -> HouseLibrary:
        """A library of houses, by its name; without one, its only one. max_houses: if walks are asked for, the most houses
        that are looked at one by one; 100,000 on one plan, and 5,000 that are drawn of all, unless given."""
        from tartan.houses import HouseLibrary
        of = name if name is not None else self._own_library("house_library", self.house_libraries)
        return HouseLibrary(self, of, progress, max_houses)

    # ---- asking

    def ask(self, question: str, *, progress: Progress = None, **request: Any) -> Any:
        """The answer to any question that `tartan` can be asked (tartan.QUESTIONS), as the page on requests lists them:
        file.ask("count", library="cabins", by="area"). What is said besides is in the answer's `diagnostics`."""
        if question not in answers.QUESTIONS:
            raise Error(f"there is no question `{question}`", help=f"there are {', '.join(answers.QUESTIONS)}")
        report, watch = Report(), Watch(progress)
        with self._lock:
            session = self._opened()
            room = ffi.new("char **")
            try:
                call(lib.tartan_ask, session, name(question), name(json.dumps(request)), watch, lib.tartan_python_report,
                     report.context, room)
            except Error as error:
                error.diagnostics = tuple(report.diagnostics) if len(report.diagnostics) > 1 else ()
                raise
        answer = answers.read(question, taken(room[0]))
        if isinstance(answer, answers.Answer):
            answer.diagnostics = report.diagnostics
        return answer

    def _opened(self):
        if self._session is None:
            self._session = self._compiled("tartan_session", lib.tartan_session_free, Report(), None,
                                           lib.tartan_session_open)
        return self._session

    def test(self, progress: Progress = None) -> Tests:
        """Runs its test blocks."""
        with self._lock:
            if self._source is None:
                self._source = self._compiled("tartan_source", lib.tartan_source_free, Report(), None,
                                              lib.tartan_source_open)
            tests = made("tartan_tests", lib.tartan_tests_free, [self._source], lib.tartan_source_test, self._source, 0,
                         Watch(progress))
            return Tests([_test(tests, i) for i in range(lib.tartan_tests_count(tests))])

    def check(self, progress: Progress = None) -> List[Diagnostic]:
        """What its rules mean that is probably not meant: Diagnostics."""
        return self.ask("check", progress=progress).diagnostics

    def format(self) -> str:
        """Its text in the canonical layout."""
        return self.ask("format").text

    def report(self, library: Optional[str] = None, progress: Progress = None) -> str:
        """A library as one HTML page that needs nothing else."""
        request = {} if library is None else {"library": library}
        return self.ask("report", progress=progress, **request).files[0].text

    # ---- what its notation makes

    def surface(self, *, progress: Progress = None, **options: Any) -> Surface:
        """A surface that grows, as a seed; see Surface."""
        from tartan.surfaces import Surface
        return Surface(self, **options)

    def mesh(self, surface: Optional[str] = None, *, progress: Progress = None, **options: Any) -> Mesh:
        """The mesh of an implicit surface; see tartan.meshes.field."""
        from tartan import meshes
        return meshes.field(self, surface, progress, **options)

    def place(self, *, progress: Progress = None, **options: Any) -> Model:
        """A model of parts, placed; see tartan.models.Model."""
        from tartan.models import Model
        return Model(self, progress, **options)

    def grammar(self) -> Grammar:
        """Its grammar, through which genomes are mapped; see tartan.evolution.Grammar."""
        from tartan.evolution import Grammar
        return Grammar(self)

    def __repr__(self):
        return f"File({self.name!r})"

    def _repr_html_(self):
        rows = [("library", found) for found in self.libraries] + [("houses", found) for found in self.house_libraries]
        rows += [("rule", found) for found in self.rules] + [("surface", found) for found in self.surfaces]
        return _html.table([self.name, ""], rows)


class Rules(collections.abc.Mapping):
    """The rules about plans of a file, by their names, those of files that it uses first."""

    def __init__(self, file):
        self._file = file
        self._docs = file._docs("rule")
        self._made: dict = {}

    def __getitem__(self, of):
        if of not in self._docs:
            raise KeyError(of)
        if of not in self._made:
            self._made[of] = Rule(self._file, of, self._docs[of])
        return self._made[of]

    def __iter__(self):
        return iter(self._docs)

    def __len__(self):
        return len(self._docs)


@dataclass(frozen=True)
class Test:
    """A case of a test block."""

    outcome: str  # "passed", "failed", "todo", "done"
    subject: str
    doc: Optional[str]
    message: Optional[str]  # why it failed
    path: str


_OUTCOMES = {lib.TARTAN_TEST_PASSED: "passed", lib.TARTAN_TEST_FAILED: "failed", lib.TARTAN_TEST_TODO: "todo",
             lib.TARTAN_TEST_DONE: "done"}


def _test(tests, i):
    case = ffi.new("tartan_test_case *", lib.tartan_test_case_init())
    call(lib.tartan_tests_case, tests, i, case)
    return Test(_OUTCOMES[case.outcome], text(case.subject), text(case.doc), text(case.message), text(case.path))


class Tests:
    """How tests came out."""

    def __init__(self, cases):
        self.cases = cases
        self.failed = sum(case.outcome in ("failed", "done") for case in cases)
        self.passed = len(cases) - self.failed

    def __bool__(self):
        return self.failed == 0

    def __repr__(self):
        return f"Tests(passed={self.passed}, failed={self.failed})"

    def _repr_html_(self):
        return _html.table(["", "about", "why"], [(case.outcome, case.subject, case.message or "") for case in self.cases])
