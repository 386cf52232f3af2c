#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Breaks the product on purpose, edit by edit, and says which test notices.

    mutate.py --check            every edit applies to exactly one place; the tests that it names are there
    mutate.py --list             the edits, one a line
    mutate.py WORK               copies what is committed into WORK, builds it, tries every edit in it
    mutate.py WORK --table FILE  writes what WORK/results.jsonl has as a Markdown table; tries nothing

The edits are in edits/, a file a room: edits/shared/scene.txt is of files under shared/scene. Of an edit:

    file: shared/scene/view.cpp
    old: |const double half = camera.ymag;
    new: |const double half = 2 * camera.ymag;
    means: an orthographic camera sees twice too much
    run: unit View.*
    run: image MaterialPictures.*

What follows a | is text as it stands in the file; further lines of it begin with a | of their own, after
spaces. `old` occurs once in its file. `run` says what should notice: unit, probe, image or tool, and a filter
of GoogleTest, the cheapest first. `equivalent: PROOF` in the place of `run` says why no test can notice. #
begins a comment.

Tests are run until one fails. Where none of those that an edit names does, WIDE below is run before the edit
is called survived. What fails without any edit is found and left out. Results are added to
WORK/results.jsonl as they are known; an edit that has one is not tried again.
"""
import argparse
import collections
import fnmatch
import json
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
KINDS = ("unit", "probe", "image", "tool")
KEYS = ("file", "old", "new", "means", "run", "equivalent")

# What is run before an edit is called survived: a push runs more, but nothing that is cheaper.
WIDE = (("probe", "*"), ("unit", "*"),
        ("image", "*/MaterialPictures.*:KnownValues.*:FrameOf.*:Ambient.*:AreaLightPictures.*:LightCells.*:"
                  "LightLists.*:PerObject.*:RecordedBarriers.*:SkippedWork.*:Unlit.*:*/gallery:*/points"),
        ("tool", "Command.*:Baseline.*:Diff*:Strict*:Selection.*:Noise.*:Bench*"))
LONGEST = 1800  # seconds that one run of tests may take; longer is a hang


class Stale(Exception):
    """Something in the lists is wrong; str() begins with the file and the line."""


class Edit:
    def __init__(self, place):
        self.place = place  # list:line
        self.file = self.old = self.new = self.means = self.equivalent = None
        self.runs = []

    @property
    def key(self):
        return json.dumps([self.file, self.old, self.new])

    @property
    def room(self):
        return self.place.split(":")[0].removesuffix(".txt")

    def __str__(self):
        return f"{self.file}: {self.means}"


# --- the lists --------------------------------------------------------------------------------------------

def finished(edit, root):
    for key in ("file", "old", "new", "means"):
        if getattr(edit, key) is None:
            raise Stale(f"{edit.place}: no {key}:")
    if not edit.old or edit.old == edit.new:
        raise Stale(f"{edit.place}: it changes nothing")
    if bool(edit.runs) == (edit.equivalent is not None):
        raise Stale(f"{edit.place}: either run: or equivalent:")
    if not edit.file.startswith(edit.room + "/"):
        raise Stale(f"{edit.place}: {edit.file} is not in {edit.room}")
    path = root / edit.file
    if not path.is_file():
        raise Stale(f"{edit.place}: there is no {edit.file}")
    count = path.read_text(encoding="utf-8").count(edit.old)
    if count != 1:
        raise Stale(f"{edit.place}: what stands in `old` occurs {count} times in {edit.file}")
    return edit


def read_list(path, name, root, stale):
    """The edits of one list; what is wrong is added to `stale`."""
    edits, edit, block = [], None, None

    def end():
        if edit is not None:
            try:
                edits.append(finished(edit, root))
            except Stale as wrong:
                stale.append(str(wrong))

    for number, line in enumerate(path.read_text(encoding="utf-8").split("\n"), 1):
        here = f"{name}:{number}"
        if block and re.match(r" +\|", line):
            setattr(edit, block, getattr(edit, block) + "\n" + line.split("|", 1)[1])
            continue
        block = None
        if not line or line.startswith("#"):
            continue
        key, colon, value = line.partition(":")
        if not colon or key not in KEYS:
            stale.append(f"{here}: not one of {', '.join(KEYS)}: {line}")
            continue
        value = value.removeprefix(" ")
        if key == "file":
            end()
            edit = Edit(here)
        elif edit is None:
            stale.append(f"{here}: a block begins with file:")
            continue
        if key == "run":
            kind, _, tests = value.partition(" ")
            if kind not in KINDS or not tests or " " in tests:
                stale.append(f"{here}: run: KIND FILTER, KIND one of {', '.join(KINDS)}")
            edit.runs.append((kind, tests))
        elif getattr(edit, key) is not None:
            stale.append(f"{here}: {key}: for the second time")
        elif key in ("old", "new"):
            if not value.startswith("|"):
                stale.append(f"{here}: {key}: begins with |")
            block = key
            setattr(edit, key, value[1:])
        elif not value.strip():
            stale.append(f"{here}: {key}: is empty")
        else:
            setattr(edit, key, value)
    end()
    return edits


def tests_of(root):
    """kind -> the names SUITE.TEST in its sources; an instantiated one has more around both"""
    names = {}
    for kind in KINDS:
        text = "".join(p.read_text(encoding="utf-8") for p in sorted((root / "tests" / kind).glob("*.cpp")))
        found = re.findall(r"\b(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+)\s*,\s*(\w+)\s*\)", text)
        names[kind] = {f"{suite}.{test}" for suite, test in found}
    return names


def has_test(names, pattern):
    """Whether a pattern of GoogleTest may match: of PREFIX/SUITE.TEST/PARAMETER, SUITE.TEST is looked at"""
    suite, dot, test = pattern.partition(".")
    wanted = suite.split("/")[-1] + dot + test.split("/")[0] + ("" if dot else "*")
    return any(fnmatch.fnmatchcase(name, wanted) for name in names)


def read_lists(root):
    folder = root / "tests" / "mutation" / "edits"
    stale, edits = [], []
    for path in sorted(folder.rglob("*.txt")):
        edits += read_list(path, path.relative_to(folder).as_posix(), root, stale)
    seen, names = {}, tests_of(root)
    for edit in edits:
        if edit.key in seen:
            stale.append(f"{edit.place}: the edit of {seen[edit.key]} once more")
        seen.setdefault(edit.key, edit.place)
        for kind, tests in edit.runs:
            for pattern in tests.split(":"):
                if not has_test(names[kind], pattern):
                    stale.append(f"{edit.place}: {kind} has no test {pattern}")
    return edits, stale


# --- the copy that is edited ------------------------------------------------------------------------------

class Product:
    """A clone in a folder of its own, the product's sources compiled one by one (sources_alone.cmake)."""

    def __init__(self, root, work, jobs, commit):
        self.root, self.copy, self.jobs = root, work / "copy", jobs
        if not self.copy.exists():
            self._call(["git", "clone", "-q", str(root), str(self.copy)])
        else:
            self._call(["git", "-C", str(self.copy), "checkout", "-q", "--", "."])
            self._call(["git", "-C", str(self.copy), "fetch", "-q", str(root)])
        wanted = self._call(["git", "-C", str(root), "rev-parse", commit]).strip()
        self._call(["git", "-C", str(self.copy), "checkout", "-q", "--detach", wanted])
        self.commit = wanted[:7]
        self.temporary = work / "tmp"
        self.temporary.mkdir(exist_ok=True)
        alone = self.root / "tests" / "mutation" / "sources_alone.cmake"
        if (self.copy / "build" / "build.ninja").exists():
            return
        self._call(["cmake", "-S", str(self.copy), "-B", str(self.copy / "build"), "-G", "Ninja",
                    "-DCMAKE_BUILD_TYPE=Release", "-DDIPTYCH_UNITY=ON", f"-DCMAKE_PROJECT_INCLUDE={alone}"] +
                   (["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if self._has("ccache") else []))

    @staticmethod
    def _has(program):
        return any((pathlib.Path(p) / program).exists() for p in os.environ.get("PATH", "").split(":"))

    @staticmethod
    def _call(command):
        return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout

    def build(self, targets):
        """What the compiler said where it failed; None: built."""
        done = subprocess.run(["ninja", "-C", str(self.copy / "build"), f"-j{self.jobs}", *targets],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
        return done.stdout[-3000:] if done.returncode else None

    def program(self, kind):
        return self.copy / "build" / "tests" / f"{kind}_tests"

    def run(self, kind, tests, first=True):
        """The names of the tests that failed, of the first one alone where that is enough."""
        command = [str(self.program(kind)), f"--gtest_filter={tests}"] + ["--gtest_fail_fast"] * first
        environment = dict(os.environ, TMPDIR=str(self.temporary))
        try:
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                  errors="replace", timeout=LONGEST, cwd=self.temporary, env=environment)
            text, code = done.stdout, done.returncode
        except subprocess.TimeoutExpired as late:
            text, code = (late.stdout or b"").decode(errors="replace"), "hangs"
        failed = re.findall(r"^\[  FAILED  \] ([^\s,]+)(?:, where .*)? \(\d+ ms\)$", text, re.M)
        if "[==========] Running 0 tests" in text and "-" not in tests:
            raise Stale(f"{kind} has no test {tests}")
        if code and not failed:  # a crash or a hang: the one that had begun
            failed = [f"{(re.findall(r'^.. RUN      . (.*)$', text, re.M) or ['?'])[-1]} ({code})"]
        return failed if code else []

    def path(self, edit):
        return self.copy / edit.file


# --- trying -----------------------------------------------------------------------------------------------

def targets_of(edit, kind, quick):
    if quick and kind == "probe" and edit.file.startswith("shaders/"):
        return ["probe_modules"]  # read when the probe runs: nothing to link
    return [f"{kind}_tests"] + ["diptych"] * (kind == "tool")


def without(tests, broken):
    names = ":".join(sorted(broken))
    return tests + (("" if "-" in tests else "-") + (":" if "-" in tests else "") + names if names else "")


def outcome_of(edit, product, broken, kinds):
    """caught by, seconds of building, seconds of testing"""
    building = testing = 0.0
    steps = [(run, True) for run in edit.runs] + [(run, False) for run in WIDE if set(kinds) == set(KINDS)]
    for (kind, tests), named in steps:
        if kind not in kinds:
            continue
        start = time.monotonic()
        said = product.build(targets_of(edit, kind, named))
        building += time.monotonic() - start
        if said is not None:
            return {"by": "compiler", "said": said}, building, testing
        start = time.monotonic()
        failed = product.run(kind, without(tests, broken[kind]))
        testing += time.monotonic() - start
        if failed:
            return {"by": kind, "test": failed[0], "named": named}, building, testing
    return {"by": "nothing"}, building, testing


def find_broken(product, edits, known, kinds):
    """kind -> tests that fail without any edit, of those that these edits name"""
    wanted = collections.defaultdict(set)
    for edit in edits:
        for kind, tests in edit.runs:
            if kind in kinds:
                wanted[kind].add(tests)
    broken = {kind: set(known.get(kind, {}).get("broken", [])) for kind in KINDS}
    for kind in sorted(wanted, key=KINDS.index):
        looked = set(known.get(kind, {}).get("looked", []))
        if not wanted[kind] <= looked:
            together = ":".join(sorted(t for t in wanted[kind] - looked))
            print(f"without an edit: {kind} {together}", flush=True)
            failed = product.run(kind, together, first=False)
            broken[kind] |= set(failed)
            for name in failed:
                print(f"fails without an edit and is left out: {kind} {name}", flush=True)
            known[kind] = {"looked": sorted(looked | wanted[kind]), "broken": sorted(broken[kind])}
    return broken


def words_of(outcome):
    if outcome["by"] == "nothing":
        return "survived"
    if outcome["by"] == "compiler":
        return "caught by the compiler: replace it"
    return f"caught by {outcome['by']} {outcome['test']}" + ("" if outcome["named"] else " (not named)")


def try_edit(edit, product, broken, kinds):
    path = product.path(edit)
    original = path.read_bytes()
    text = original.decode("utf-8")
    if text.count(edit.old) != 1:
        raise Stale(f"{edit.place}: what stands in `old` is not once in {edit.file} of {product.commit}")
    building = testing = 0.0
    while True:
        path.write_bytes(text.replace(edit.old, edit.new).encode("utf-8"))
        try:
            outcome, build_s, test_s = outcome_of(edit, product, broken, kinds)
        finally:
            path.write_bytes(original)
        building, testing = building + build_s, testing + test_s
        if outcome.get("named", True) or not fails_unedited(product, outcome, broken):
            return {"key": edit.key, "commit": product.commit, "build_s": round(building, 1),
                    "test_s": round(testing, 1), **outcome}


def fails_unedited(product, outcome, broken):
    """Tests of WIDE are not run before the edits: one that notices an edit must pass without it."""
    kind, test = outcome["by"], outcome["test"].split(" ")[0]
    if product.build([f"{kind}_tests"]) is not None or not product.run(kind, test):
        return False
    print(f"fails without an edit and is left out: {kind} {test}", flush=True)
    broken[kind].add(test)
    return True


def results_in(path):
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    return {result["key"]: result for result in map(json.loads, lines)}


def try_all(edits, make_product, work, again, kinds):
    work.mkdir(parents=True, exist_ok=True)
    file = work / "results.jsonl"
    done = results_in(file)
    edits = [e for e in edits if any(kind in kinds for kind, _ in e.runs) and (again or e.key not in done)]
    if not edits:
        return 0
    product = make_product()
    said = product.build([f"{kind}_tests" for kind in kinds] + ["diptych"] * ("tool" in kinds))
    if said is not None:
        print(f"{product.commit} does not build without an edit:\n{said}")
        return 2
    known_file = work / f"unedited-{product.commit}.json"
    known = json.loads(known_file.read_text(encoding="utf-8")) if known_file.exists() else {}
    broken = find_broken(product, edits, known, kinds)
    known_file.write_text(json.dumps(known, indent=1), encoding="utf-8")
    survived = 0
    for number, edit in enumerate(edits, 1):
        result = try_edit(edit, product, broken, kinds)
        known_by_all = result["by"] != "nothing" or set(kinds) == set(KINDS)
        if known_by_all:
            with file.open("a", encoding="utf-8") as out:
                out.write(json.dumps(result) + "\n")
            survived += result["by"] == "nothing"
        said = words_of(result) if known_by_all else f"not caught by {', '.join(kinds)}"
        print(f"{number}/{len(edits)} {edit}: {said}"
              f" [{result['build_s']:.0f} s + {result['test_s']:.0f} s]", flush=True)
    return 1 if survived else 0


# --- what is written --------------------------------------------------------------------------------------

def cell(text):
    return text.replace("|", "\\|").replace("\n", " ")


def summary(edits, results):
    rooms = collections.OrderedDict()
    for edit in edits:
        counts = rooms.setdefault(edit.room, collections.Counter())
        counts["edits"] += 1
        if edit.equivalent is not None:
            counts["equivalent"] += 1
        elif edit.key in results:
            counts[results[edit.key]["by"]] += 1
        else:
            counts["not run"] += 1
    heads = ("edits", *KINDS, "compiler", "nothing", "equivalent", "not run")
    lines = ["| room | edits | unit | probe | image | tool | compiler | survived | equivalent | not run |",
             "|---|" + "---|" * len(heads)]
    for room, counts in [*rooms.items(), ("all", sum(rooms.values(), collections.Counter()))]:
        lines.append(f"| {room} | " + " | ".join(str(counts[h] or "") for h in heads) + " |")
    return "\n".join(lines)


def table(edits, results):
    lines = ["# What catches the edits of edits/", "",
             "Written by `mutate.py WORK --table`; each edit was tried at the commit beside it.", "",
             summary(edits, results), ""]
    room = None
    for edit in edits:
        if edit.room != room:
            room = edit.room
            lines += ["", f"## {room}", "", "| file | edit | what notices | at |", "|---|---|---|---|"]
        result = results.get(edit.key)
        said = words_of(result) if result else "not run"
        if edit.equivalent:
            said = f"equivalent: {edit.equivalent}"
        lines.append(f"| {edit.file.removeprefix(room + '/')} | {cell(edit.means)} | {cell(said)} | "
                     f"{result['commit'] if result else ''} |")
    return "\n".join(lines) + "\n"


def words_in(edit):
    return " ".join([edit.place, str(edit), *(f"{kind} {tests}" for kind, tests in edit.runs)])


def main(arguments, root=ROOT, make=Product):
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("work", nargs="?", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--table", type=pathlib.Path)
    parser.add_argument("--only", default="",
                        help="a regular expression: of an edit's list, file, meaning or tests")
    parser.add_argument("--shard", default="1/1", help="I/N: every N-th edit from the I-th on")
    parser.add_argument("--commit", default="HEAD", help="what is copied")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--kinds", default=",".join(KINDS),
                        help="run tests of these alone; what they do not catch is left for a later run")
    parser.add_argument("--again", action="store_true", help="try also what has a result")
    options = parser.parse_args(arguments)

    edits, stale = read_lists(root)
    if stale:
        print("\n".join(stale))
        return 2
    if options.check:
        print(f"{len(edits)} edits apply")
        return 0
    if options.table:
        results = results_in(options.work / "results.jsonl")
        options.table.write_text(table(edits, results), encoding="utf-8")
        return 0
    kinds = tuple(kind for kind in KINDS if kind in options.kinds.split(","))
    first, every = map(int, options.shard.split("/"))
    if not 1 <= first <= every:
        parser.error("--shard I/N, I from 1 to N")
    edits = [edit for edit in edits if re.search(options.only, words_in(edit))][first - 1::every]
    if options.list:
        for edit in edits:
            print(f"{edit.place}: {edit}" + (" (equivalent)" if edit.equivalent else ""))
        return 0
    if options.work is None:
        parser.error("a folder to work in")
    try:
        code = try_all(edits, lambda: make(root, options.work.resolve(), options.jobs, options.commit),
                       options.work, options.again, kinds)
    except Stale as wrong:
        print(wrong)
        return 2
    print("\n" + summary(edits, results_in(options.work / "results.jsonl")))
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
