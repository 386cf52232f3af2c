#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of mutate.py on synthetic sources and on the product's; nothing is built."""
import argparse, collections, pathlib, random, subprocess, sys, tempfile, unittest

sys.dont_write_bytecode = True
import mutate  # noqa: E402

mutate.say = lambda *words: None
FUNCTION = "int f(int a, int b, Kind kind) {{\n    {}\n}}\n"
FILES = {"shared/a/a.cpp": FUNCTION.format("if (a < b && a > 1) go(a, b);\n    go(a + 1, b);\n    return a;"),
         "shared/a/a.h": "constexpr double most = 0.5;\ninline int g(int x) {\n    return x + 1;\n}\n",
         "shaders/lib/a.glsl": "#ifndef A_GLSL\n#define A_GLSL\n#extension X : require\n\n"
                               "float f(float x) { return 2.0 * x; }\n#endif\n"}


def made(statement, path="shared/x.cpp", rounds=20, around=FUNCTION):
    """operator -> possible edits of a statement"""
    text, found, begin = around.format(statement), collections.defaultdict(set), around.format("\0").index("\0")
    for seed in range(rounds):
        source = mutate.Source(path, text, {"Kind": ["first", "second", "third"]}, random.Random(seed))
        for i in {*range(len(source.line))} - source.dead:
            for operator, start, end, new, *_ in source.edits(i):
                found[operator].add((text[begin:start] + new + text[end:]).strip("}\n "))
    return found


class Operators(unittest.TestCase):
    def expect(self, operator, statement, *becomes, **options):
        self.assertEqual(made(statement, **options)[operator], set(becomes), statement)

    def test_what_they_make(self):
        glsl = {"path": "shaders/lib/x.glsl"}
        self.expect("operator", "return a < b;", "return a > b;", "return a <= b;")
        self.expect("operator", "return a + b * a;", "return a - b * a;", "return a + b / a;")
        self.expect("operator", "a += b && a;", "a -= b && a;", "a += b || a;")
        self.expect("operator", 'text = "a" + name;')  # strings cannot be subtracted
        self.expect("constant", "go(2u, true);", "go(1u, true);", "go(3u, true);", "go(2u, false);")
        self.expect("constant", "return 0;", "return 1;")
        self.expect("constant", "return 0.5f;", "return 0.505f;", "return 0.495f;")
        self.expect("function", "return std::min(a, b);", "return std::max(a, b);")
        self.expect("swizzle", "v.x = v.xyz;", "v.x = v.yxy;", **glsl)  # GLSL cannot assign to ?:
        self.expect("enumerator", "go(Kind::second);", "go(Kind::first);", "go(Kind::third);")
        self.expect("dropped", "++a; go(b); return a;", "; go(b); return a;", "++a; ; return a;")
        self.expect("dropped", "int c = a; std::vector<int> d(a); auto e = go(b); EACH(c) { go(b) } return c;")
        self.expect("early return", "go(b);", "return {}; go(b);")
        self.expect("early return", "go(b);", "return vec3(0); go(b);", **glsl, around="vec3 f(float x) {{ {} }}")
        self.expect("early return", "go(b);", "return; go(b);", around="void X::f(int x) const {{ {} }}")
        self.expect("condition", "if (go(a)) return b;", "if (!(go(a))) return b;")
        self.expect("condition", "if (const auto c = go(a)) return c;")
        self.expect("argument", "go(a, b);", "go(b, a);", "go(a);", rounds=60)

    def test_what_no_test_can_notice_is_left_alone(self):
        for text in ("// a < b + 1", "/* a < b */", "#define X (a < 1)", '"a < 1";', 'R"(a < b)";',
                     "static_assert(a < 1);", "assert(a < 1);", 'throw Error(fmt::format("{}", a + 1));',
                     "fail(a + 1, b);", "std::array<int, 3> c;", "enum class K { a = 1, b };"):
            self.assertLessEqual({*made(text)}, {"early return"}, text)


class Drawn(unittest.TestCase):
    def test_a_seed_always_draws_the_same_and_none_overlaps(self):
        edits = mutate.draw(FILES, 6, 3)
        self.assertEqual(edits, mutate.draw(FILES, 6, 3))
        self.assertEqual({e.file.rpartition("/")[0] for e in edits}, {"shared/a", "shaders/lib"})
        ranges = sorted((e.file, e.start, e.end) for e in edits)
        self.assertTrue(all(a[0] != b[0] or a[2] < b[1] for a, b in zip(ranges, ranges[1:])))

    def test_only_changed_lines(self):
        edits = mutate.draw(FILES, 9, 1, {"shared/a/a.h": {3}})
        self.assertEqual({(e.file, *e.lines) for e in edits}, {("shared/a/a.h", 3, 3)})

    def test_the_switch_compiles(self):
        edits, text = mutate.draw(FILES, 8, 1), "bool DIPTYCH_MUTANT(unsigned); struct Kind {}; int go(int, int = 0);"
        for name in ("shared/a/a.h", "shared/a/a.cpp"):
            text += mutate.switched(FILES[name], [e for e in edits if e.file == name]).replace("#include", "//")
        command = ["c++", "-std=c++20", "-fsyntax-only", "-x", "c++", "-"]
        done = subprocess.run(command, input=text, text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, text + done.stderr)

    def test_in_shaders_the_switch_stands_below_the_extensions(self):
        edits = [e for e in mutate.draw(FILES, 8, 2) if e.file.endswith(".glsl")]
        lines = mutate.switched(FILES["shaders/lib/a.glsl"], edits).split("\n")
        self.assertEqual(lines[4], '#include "tests/mutation/mutant.h"')
        self.assertIn("DIPTYCH_MUTANT(", lines[5])

    def test_errors_name_the_edits_that_are_left_out(self):
        edits = mutate.draw(FILES, 6, 3)
        edit = next(e for e in edits if e.file == "shared/a/a.h")
        place, other = f"/t/shared/a/a.h:{edit.lines[0] + 1}:7: ", "/t/b.cpp:1:1: error: no\n"
        declared = f"/t/shared/a/a.h:{edit.lines[0]}:7: note: 'f' declared here"
        for said, bad in ((place + "error: no", True), (other + place + "note: here", True), (other + declared, True),
                          (f"ERROR: {place[:-3]} 'x' :  no", True),
                          (place + "  in 'constexpr' expansion of 'format(\"{}\")'\n" + other, True),
                          (place + "warning: no", False),
                          (other + "/t/b.cpp:2:1: warning: no\n" + place + "note: here", False)):
            self.assertEqual(mutate.blamed(said, edits, pathlib.Path("/t")), {edit.number} if bad else set(), said)
        edit.const = [(0, 0, "const")]
        said = other + f"/t/shared/a/a.h:{edit.lines[1] + 9}:1: note: 'x' was not declared 'constexpr'"
        self.assertEqual(mutate.blamed(said, edits, pathlib.Path("/t")), {edit.number})

    def test_where_modules_become_known_there_is_what_sets_the_switch(self):
        sources = "".join(p.read_text(encoding="utf-8") for p in mutate.ROOT.rglob("shared/vulkan/**/*.cpp"))
        for old in mutate.SETTERS:
            self.assertIn(old, sources)


class Runs(unittest.TestCase):
    """Suites: the first reaches edits 1 and 2, the others 1 to 3. They fail with 1; with 3; with 2 and 4 together."""

    def test_suites_try_what_they_reach_together_and_results_stay(self):
        with tempfile.TemporaryDirectory() as name:
            work, options = pathlib.Path(name), argparse.Namespace(jobs=1, all=False)
            run = mutate.Run(work, options)
            run.plan, run.edits = {"number": 4}, mutate.draw(FILES, 4, 3)
            for kind, reached, fails in (("unit", [1, 2], "*1*) fail A.one"), ("probe", [1, 2, 3], "*3*) sleep 60"),
                                         ("tool", [2, 4], "2,4) fail A.both")):
                script = f'''fail() {{ echo "[  FAILED  ] $1"; exit 1; }}
                    echo "$DIPTYCH_MUTANT/$0" >> tried; case "$DIPTYCH_MUTANT" in {fails};; esac'''
                run.suites[kind] = {"name": kind, "kind": kind, "command": ["sh", "-c", script, "all"],
                                    "environment": {}, "seconds": -2.9, "reached": reached, "passed": None,
                                    "folder": name}
            mutate.filtered = lambda suite, names: {**suite, "command": [*suite["command"][:3], names]}
            for suite in run.suites.values():
                run.attempt(suite, run.edits)
            again = mutate.Run(work, options)
            self.assertEqual([e.by for e in again.edits], ["unit", None, "probe", None])
            tried = ["1,2/all", "/A.one", "1/A.one", "2/A.one", "2/all", "2,3/all", "2/all", "3/all", "2/all",
                     "2,4/all", "/A.both", "2/A.both", "4/A.both", "4/all", "2/all"]
            self.assertEqual((work / "tried").read_text().split(), tried)
            self.assertEqual(again.edits[2].test, "probe (late)")
            self.assertEqual(again.alone_in_suite(again.edits[0]), "A.one")
            tried += ["1/all"]
            for suite in again.suites.values():  # nothing is tried twice
                again.attempt(suite, again.edits)
            self.assertEqual((work / "tried").read_text().split(), tried)


if __name__ == "__main__":
    unittest.main()
