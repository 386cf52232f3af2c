#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What mutate.py promises, on a product of one file whose build and tests are made up here."""
import contextlib
import fnmatch
import io
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import mutate  # noqa: E402

SOURCE = "int twice(int x) {\n    return 2 * x;\n}\n// 2 is two\n"
TESTS = "TEST(Twice, OfThreeIsSix) {}\nTEST(Twice, OfNoneIsNone) {}\n"
EDIT = """# a comment
file: shared/twice.cpp
old: |return 2 * x;
new: |return 3 * x;
means: three times
run: unit Twice.*
"""
# Which no test can notice.
COMMENT = EDIT.replace("|return 2 * x;", "|2 is two").replace("|return 3 * x;", "|two")


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name) / "root"
        self.work = pathlib.Path(self.folder.name) / "work"
        self.put("shared/twice.cpp", SOURCE)
        self.put("tests/unit/twice_test.cpp", TESTS)

    def tearDown(self):
        self.folder.cleanup()

    def put(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def edits(self, text):
        self.put("tests/mutation/edits/shared.txt", text)

    def run_with(self, *arguments, make=None):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            code = mutate.main(list(map(str, arguments)), self.root, make)
        return code, out.getvalue()

    def check(self):
        return self.run_with("--check")


class Lists(Folder):
    def test_an_edit_that_applies_once_is_right(self):
        self.edits(EDIT)
        self.assertEqual(self.check(), (0, "1 edits apply\n"))

    def test_a_stale_edit_is_named_with_its_line(self):
        self.edits(EDIT.replace("2 * x", "4 * x"))
        code, said = self.check()
        self.assertEqual(code, 2)
        self.assertIn("shared.txt:2: what stands in `old` occurs 0 times in shared/twice.cpp", said)

    def test_what_occurs_twice_is_refused(self):
        self.edits(EDIT.replace("|return 2 * x;", "|2"))
        code, said = self.check()
        self.assertEqual(code, 2)
        self.assertIn("occurs 2 times", said)

    def test_a_file_that_is_gone_is_named(self):
        self.edits(EDIT.replace("twice.cpp", "thrice.cpp"))
        self.assertIn("there is no shared/thrice.cpp", self.check()[1])

    def test_a_test_that_is_gone_is_named(self):
        self.edits(EDIT.replace("Twice.*", "Twice.OfFourIsEight"))
        self.assertIn("unit has no test Twice.OfFourIsEight", self.check()[1])

    def test_one_edit_twice_is_refused(self):
        self.edits(EDIT + "\n" + EDIT)
        self.assertIn("shared.txt:9: the edit of shared.txt:2 once more", self.check()[1])

    def test_what_is_missing_or_unknown_is_said(self):
        for line, wanted in (("means: three times\n", "no means:"), ("run: unit Twice.*\n", "either run: or"),
                             ("new: |return 3 * x;\n", "no new:")):
            self.edits(EDIT.replace(line, ""))
            self.assertIn(wanted, self.check()[1])
        self.edits(EDIT + "why: not\n")
        self.assertIn("shared.txt:7: not one of", self.check()[1])
        self.edits(EDIT.replace("3 * x", "2 * x"))
        self.assertIn("changes nothing", self.check()[1])
        self.edits(EDIT.replace("|return 3", "return 3"))
        self.assertIn("begins with |", self.check()[1])

    def test_text_of_several_lines_is_one(self):
        self.edits(EDIT.replace("|return 2 * x;", "|    return 2 * x;\n     |}"))
        self.assertEqual(self.check()[0], 0)


class FakeProduct:
    """Builds whatever has a brace at its end; its test calls twice(3) by reading the number."""

    broken = ()

    def __init__(self, root, work, jobs, commit):
        self.copy, self.commit = root, "0000000"
        self.work = work

    def path(self, edit):
        return self.copy / edit.file

    def text(self):
        return (self.copy / "shared/twice.cpp").read_text(encoding="utf-8")

    def build(self, targets):
        return None if self.text().count("{") == self.text().count("}") else "error: a brace"

    def run(self, kind, tests, first=True):
        wrong = [] if "return 2 * x;" in self.text() else ["Twice.OfThreeIsSix"]
        chosen, _, left_out = tests.partition("-")
        return [name for name in [*self.broken, *wrong] if name not in left_out.split(":") and
                any(fnmatch.fnmatchcase(name, pattern) for pattern in chosen.split(":"))]


class Trying(Folder):
    def try_all(self, text, product=FakeProduct):
        self.edits(text)
        code, said = self.run_with(self.work, make=product)
        self.assertEqual((self.root / "shared/twice.cpp").read_text(encoding="utf-8"), SOURCE)
        return code, said

    def test_what_a_test_notices_is_caught_by_it(self):
        code, said = self.try_all(EDIT)
        self.assertEqual(code, 0)
        self.assertIn("three times: caught by unit Twice.OfThreeIsSix", said)

    def test_what_no_test_notices_survived(self):
        code, said = self.try_all(COMMENT)
        self.assertEqual(code, 1)
        self.assertIn("three times: survived", said)

    def test_what_does_not_compile_is_flagged(self):
        code, said = self.try_all(EDIT.replace("|return 3 * x;", "|{ return 2 * x;"))
        self.assertIn("caught by the compiler: replace it", said)

    def test_a_test_that_fails_without_an_edit_catches_nothing(self):
        class Broken(FakeProduct):
            broken = ("Twice.OfNoneIsNone",)

        for named in ("Twice.*", "Twice.OfThreeIsSix"):  # by the edit, and by those that are run at last
            code, said = self.try_all(COMMENT.replace("Twice.*", named), Broken)
            self.assertEqual(code, 1)
            self.assertIn("left out: unit Twice.OfNoneIsNone", said)
            self.assertIn("three times: survived", said)
            (self.work / "results.jsonl").unlink()
            (self.work / "unedited-0000000.json").unlink()

    def test_results_add_up_and_are_tabled(self):
        self.try_all(EDIT)
        equivalent = COMMENT.replace("run: unit Twice.*", "equivalent: a comment")
        equivalent = equivalent.replace("three times", "another comment")
        code, said = self.try_all(EDIT + "\n" + equivalent)
        self.assertNotIn("caught by unit", said)  # not tried again
        table = pathlib.Path(self.folder.name) / "table.md"
        self.assertEqual(self.run_with(self.work, "--table", table)[0], 0)
        text = table.read_text(encoding="utf-8")
        self.assertIn("| shared | 2 | 1 |", text)
        self.assertIn("| twice.cpp | three times | caught by unit Twice.OfThreeIsSix | 0000000 |", text)
        self.assertIn("| twice.cpp | another comment | equivalent: a comment |", text)

    def test_what_other_kinds_may_catch_is_left_for_them(self):
        self.edits(COMMENT)
        code, said = self.run_with(self.work, "--kinds", "unit,probe", make=FakeProduct)
        self.assertIn("three times: not caught by unit, probe", said)
        self.assertFalse((self.work / "results.jsonl").exists())

    def test_a_shard_is_every_nth(self):
        other = EDIT.replace("3 * x", "4 * x").replace("three", "four")
        self.edits(EDIT + "\n" + other)
        self.assertIn("four times", self.run_with("--list", "--shard", "2/2")[1])
        self.assertNotIn("three times", self.run_with("--list", "--shard", "2/2")[1])
        self.assertNotIn("four times", self.run_with("--list", "--only", "three")[1])


if __name__ == "__main__":
    unittest.main()
