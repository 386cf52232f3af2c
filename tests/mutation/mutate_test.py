#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of mutate.py on synthetic sources and on the product's; nothing is built."""
import argparse, collections, json, pathlib, random, subprocess, sys, tempfile, unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import mutate  # noqa: E402

mutate.say = lambda *words: None

FUNCTION = "int f(int a, int b, Kind kind) {{\n    {}\n}}\n"
ENUMS = {"Kind": ["first", "second", "third"]}


def made(statement, path="shared/x.cpp", rounds=20, around=FUNCTION):
    """operator -> possible edits of a statement"""
    text, found = around.format(statement), collections.defaultdict(set)
    for seed in range(rounds):
        source, rng = mutate.Source(path, text, ENUMS), random.Random(seed)
        for i in range(source.count):
            for what in mutate.edits_of(source, i, rng) if i not in source.dead else ():
                edit = mutate.edit_of(source, i, *what)
                found[edit.operator].add(mutate.applied(edit, text).replace(around.format("\0").split("\0")[0], "").strip("}\n "))
    return found


class Operators(unittest.TestCase):
    def expect(self, operator, statement, *becomes, **options):
        self.assertEqual(made(statement, **options)[operator], set(becomes), statement)

    def test_what_they_make(self):
        glsl = {"path": "shaders/lib/x.glsl"}
        self.expect("operator", "return a < b;", "return a > b;", "return a <= b;")
        self.expect("operator", "return a + b * a;", "return a - b * a;", "return a + b / a;")
        self.expect("operator", "return a && b;", "return a || b;")
        self.expect("operator", "a += b;", "a -= b;")
        self.expect("operator", 'text = "a" + name;')  # strings cannot be subtracted
        self.expect("constant", "return 2u;", "return 1u;", "return 3u;")
        self.expect("constant", "return 0;", "return 1;")
        self.expect("constant", "return 0.5f;", "return 0.505f;", "return 0.495f;")
        self.expect("constant", "return true;", "return false;")
        self.expect("function", "return std::min(a, b);", "return std::max(a, b);")
        self.expect("swizzle", "return v.xyz;", "return v.yxy;", **glsl)
        self.expect("swizzle", "v.x = a;", **glsl)  # GLSL cannot assign to a conditional expression
        self.expect("enumerator", "return kind == Kind::second;", "return kind == Kind::first;", "return kind == Kind::third;")
        self.expect("dropped", "++a; go(b); return a;", "; go(b); return a;", "++a; ; return a;")
        self.expect("dropped", "int c = a; std::vector<int> d(a); auto e = go(b); EACH(c) { go(b) } return c;")
        self.expect("early return", "go(b);", "return {}; go(b);")
        self.expect("early return", "go(b);", "return vec3(0); go(b);", **glsl, around="vec3 f(float x) {{ {} }}")
        self.expect("early return", "go(b);", "return; go(b);", around="void X::f(int x) const {{ {} }}")
        self.expect("condition", "if (go(a)) return b;", "if (!(go(a))) return b;")
        self.expect("condition", "if (const auto c = go(a)) return c;")
        self.expect("argument", "go(a, b);", "go(b, a);", "go(a);", rounds=60)

    def test_what_no_test_can_notice_is_left_alone(self):
        for text in ("// a < b + 1", "/* a < b */", "#define X (a < 1)", '"a < 1";', 'R"(a < b)";', "static_assert(a < 1);", "assert(a < 1);",
                     'throw Error(fmt::format("{}", a + 1));', "fail(a + 1, b);", "std::array<int, 3> c;", "enum class K { a = 1, b };"):
            self.assertEqual({k: v for k, v in made(text).items() if k != "early return"}, {}, text)


class Drawn(unittest.TestCase):
    FILES = {"shared/a/a.cpp": FUNCTION.format("if (a < b && a > 1) go(a, b);\n    go(a + 1, b);\n    return a;"),
             "shared/a/a.h": "constexpr double most = 0.5;\ninline int g(int x) {\n    return x + 1;\n}\n",
             "shaders/lib/a.glsl": "#ifndef A_GLSL\n#define A_GLSL\n#extension X : require\n\nfloat f(float x) { return 2.0 * x; }\n#endif\n"}

    def test_a_seed_always_draws_the_same_and_none_overlaps(self):
        edits, again = (mutate.draw(self.FILES, 6, 3) for _ in range(2))
        self.assertEqual([e.__dict__ for e in edits], [e.__dict__ for e in again])
        self.assertEqual({e.file.rpartition("/")[0] for e in edits}, {"shared/a", "shaders/lib"})
        ranges = sorted((e.file, e.start, e.end) for e in edits)
        self.assertTrue(all(a[0] != b[0] or a[2] < b[1] for a, b in zip(ranges, ranges[1:])))

    def test_only_changed_lines(self):
        edits = mutate.draw(self.FILES, 9, 1, {"shared/a/a.h": {3}})
        self.assertEqual({(e.file, *e.lines) for e in edits}, {("shared/a/a.h", 3, 3)})

    def test_the_switch_compiles(self):
        edits = mutate.draw(self.FILES, 8, 1)
        text = "".join(mutate.switched(n, self.FILES[n], [e for e in edits if e.file == n]) for n in ("shared/a/a.h", "shared/a/a.cpp"))
        text = "bool DIPTYCH_MUTANT(unsigned);\nstruct Kind {};\nint go(int, int = 0);\n" + text.replace("#include", "//")
        done = subprocess.run(["c++", "-std=c++20", "-fsyntax-only", "-x", "c++", "-"], input=text, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, text + done.stderr)

    def test_in_shaders_the_switch_stands_below_the_extensions(self):
        edits = [e for e in mutate.draw(self.FILES, 8, 2) if e.file.endswith(".glsl")]
        lines = mutate.switched("shaders/lib/a.glsl", self.FILES["shaders/lib/a.glsl"], edits).split("\n")
        self.assertEqual(lines[4], '#include "tests/mutation/mutant.h"')
        self.assertIn("DIPTYCH_MUTANT(", lines[5])

    def test_errors_name_the_edits_that_are_left_out(self):
        edits = mutate.draw(self.FILES, 6, 3)
        edit = next(e for e in edits if e.file == "shared/a/a.h")
        place = f"/t/shared/a/a.h:{edit.lines[0] + 1}:7: "
        declared = f"/t/shared/a/a.h:{edit.lines[0]}:7: note: 'f' declared here"
        for said in (place + "error: no", "/t/b.cpp:1:1: error: no\n" + place + "note: here", "/t/b.cpp:1:1: error: no\n" + declared, f"ERROR: {place[:-3]} 'x' :  no",
                     place + "  in 'constexpr' expansion of 'format(\"{}\")'\n/t/b.h:1:1: error: no"):
            self.assertIn(edit.number, mutate.blamed(said, edits, pathlib.Path("/t")), said)
        for said in (place + "warning: no", "/t/b.cpp:1:1: error: no\n/t/b.cpp:2:1: warning: no\n" + place + "note: here"):
            self.assertEqual(mutate.blamed(said, edits, pathlib.Path("/t")), set(), said)

    def test_where_modules_become_known_there_is_what_sets_the_switch(self):
        for old, _ in mutate.SETTERS:
            self.assertTrue(any(old in p.read_text(encoding="utf-8") for p in mutate.ROOT.glob("shared/vulkan/*.cpp")), old)


class Runs(unittest.TestCase):
    """Two suites: the first reaches edits 1 and 2 and detects 1; the second reaches all and times out at 3."""
    SCRIPT = 'echo "$DIPTYCH_MUTANT" >> tried; test "$DIPTYCH_MUTANT" != {} || {}'

    def test_each_edit_is_tried_by_what_comes_by_and_results_stay(self):
        with tempfile.TemporaryDirectory() as name:
            work, options = pathlib.Path(name), argparse.Namespace(copy=None, jobs=1)
            run = mutate.Run(work, options)
            run.plan, run.edits = {"number": 4}, mutate.draw(Drawn.FILES, 4, 3)
            for at, (kind, reached, script) in enumerate((("unit", [1, 2], (1, "false")), ("probe", [1, 2, 3], (3, "sleep 60")))):
                run.suites[kind] = {"name": kind, "kind": kind, "command": ["sh", "-c", self.SCRIPT.format(*script)], "folder": name,
                                    "environment": {}, "seconds": -2.9, "reached": reached}
            for edit in run.edits:
                run.attempt(edit, run.suites.values())
            again = mutate.Run(work, options)
            self.assertEqual([e.by for e in again.wanted()], ["unit", "survived", "probe", "survived"])
            self.assertEqual((work / "tried").read_text().split(), ["1", "2", "2", "3"])
            self.assertEqual(again.edits[2].test, "probe (late)")
            self.assertEqual(json.loads((work / "results.json").read_text())["edits"][1]["tried"], ["unit", "probe"])
            again.attempt(again.edits[1], again.suites.values())  # continues only with other suites
            self.assertEqual(len((work / "tried").read_text().split()), 4)


if __name__ == "__main__":
    unittest.main()
