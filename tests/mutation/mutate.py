#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes small edits of the product, C++ and GLSL, and says which test notices each.

    mutate.py WORK                     120 edits, in each folder of the product in turn; --number, --seed
    mutate.py WORK shared/shadow ...   in these folders or files; --since REV: in lines that differ from REV
    mutate.py WORK --kinds unit,probe  by these tests alone
    mutate.py WORK --all               goes on with what survived: by suites with the label `all`, too
    mutate.py WORK --again             goes on with what survived, at the commit that is HEAD now
    mutate.py WORK --report            the table and the survivors; builds and runs nothing

All edits stand in one build of a clone of what is committed (WORK/copy; --copy DIR: a clone that has been built in
DIR/build), each as `DIPTYCH_MUTANT(n) ? edited : original` (mutant.h). What the compiler refuses, such as an edit of what
must be constant, is left out; another takes its place. Then each suite of ctest is run without an edit: how long it
takes, and which edits' places it comes by. Those suites alone try an edit: of unit tests first, then of probes, then the
others, the quickest first, until one fails or is late. What survives is compiled once more, alone: where object files or
modules are the original's, it is equivalent. WORK/results.json has all that is known; the next run goes on from there.
"""
import argparse
import bisect
import collections
import concurrent.futures
import difflib
import json
import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import threading
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("compare", "deferred", "forward_plus", "shaders/lib", "shaders/pass", "shared")
GLSL = (".glsl", ".vert", ".frag", ".comp")
KINDS = ("unit", "probe", "image", "tool")
SPARE = 1.4  # drawn for one that is wanted: some do not compile
M = "\0"     # the switch, in Edit.switched


class Stop(Exception):
    """Why the program ends, in words."""


# --- sources ----------------------------------------------------------------------------------------------

TOKEN = re.compile(r'''(?P<skip>//[^\n]*|/\*.*?\*/|\#(?:\\\n|[^\n])*|\s+)
  |(?P<string>(?:u8|[uUL])?R"(?P<d>[^(\s]*)\(.*?\)(?P=d)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+')
  |(?P<number>\.?\d(?:[eE][+-]|['\w.])*)|(?P<name>[A-Za-z_]\w*)
  |(?P<op><=>|<<=|>>=|\.\.\.|->|::|\+\+|--|&&|\|\||\^\^|[-+*/%&|^<>=!]=|<<|>>|.)''', re.X | re.S)
Token = collections.namedtuple("Token", "kind text start end")

ASSIGN = {op + "=" for op in ("", *"+-*/%&|^", "<<", ">>")}
# Binary operators, by how little they bind.
LEVELS = [{"||", "^^"}, {"&&"}, {"&", "|", "^"}, {"==", "!="}, {"<", "<=", ">", ">="}, {"<<", ">>"}, {"+", "-"}, {"*", "/", "%"}]
BINARY = set().union(*LEVELS)
WORDS = set("""return else do throw case default goto delete new if for while switch break continue using const auto static struct
    class public private try catch constexpr""".split())
TO_SEMICOLON = set("throw static_assert assert using typedef namespace concept friend extern requires".split())
IN_BRACKETS = re.compile(r"layout|alignas|decltype|sizeof|noexcept|CONTRACT_\w+|(?i:.*(?:error|warn|fail|refuse|problem|print).*)")
TURNED = {"<": "> <=", "<=": "< >=", ">": "< >=", ">=": "> <=", "==": "!=", "!=": "==", "+": "-", "-": "+", "*": "/", "/": "*",
          "&&": "||", "||": "&&", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
NAMES = dict(pair.split("/") for pair in """min/max fmin/fmax floor/ceil sin/cos any/all any_of/all_of front/back
    lower_bound/upper_bound min_element/max_element lessThan/lessThanEqual greaterThan/greaterThanEqual""".split())
NAMES.update({other: name for name, other in NAMES.items()})
NEXT = dict(zip("xyzwrgba", "yxyzgrgb"))  # components


class Source:
    """The tokens of a file; which brackets match, which they are inside, and which tokens no edit touches."""

    def __init__(self, path, text, enums):
        self.path, self.text, self.enums, self.glsl = path, text, enums, path.endswith(GLSL)
        self.tokens = [Token("string" if m["string"] else m.lastgroup, m[0], *m.span()) for m in TOKEN.finditer(text) if not m["skip"]]
        self.lines = [0] + [m.end() for m in re.finditer("\n", text)]
        self.match, self.inside, self.dead, self.heads, stack, angles = {}, [], set(), {}, [], []
        for i, t in enumerate(self.tokens):
            if t.text in (")", "]", "}") and stack:
                self.match[i], self.match[stack[-1]] = stack[-1], i
                stack.pop()
            self.inside.append(stack[-1] if stack else -1)
            if t.text in ("(", "[", "{"):
                stack.append(i)
        for i, t in enumerate(self.tokens):
            end = i
            if t.text == "<" and (self.at(i - 1) == "template" or not self.space(i) and self.kind(i - 1) == "name"):
                angles.append(i)
            elif t.text in (">", ">>") and not self.space(i):
                for _ in t.text[:len(angles)]:
                    self.dead.update(range(angles.pop(), i + 1))
            elif t.text == ";":
                angles.clear()
            elif t.text in TO_SEMICOLON or t.text in ("case", "enum"):
                while self.at(end) not in (":" if t.text == "case" else ";", "{", "}", ""):
                    end = max(end, self.match.get(end, end)) + 1
                end = self.match.get(end, end) if t.text == "enum" else end
            elif t.text == "operator":
                end = i + 2
            elif self.at(i + 1) == "(" and IN_BRACKETS.fullmatch(t.text):
                end = self.match.get(i + 1, i)
            self.dead.update(range(i, end + (end > i)))

    def at(self, i):
        return self.tokens[i].text if 0 <= i < len(self.tokens) else ""

    def kind(self, i):
        return self.tokens[i].kind if 0 <= i < len(self.tokens) else ""

    def line(self, position):
        return bisect.bisect_right(self.lines, position)

    def span(self, first, last):
        return self.tokens[first].start, self.tokens[last].end

    def space(self, i):
        return self.text[self.tokens[i].start - 1].isspace()

    def binary(self, i):
        """As clang-format sets them, with a space on both sides; of templates and pointers none has."""
        return self.space(i) and self.text[self.tokens[i].end].isspace()

    def group(self, i):
        """Whether braces are part of an expression, as in Point{1, 2}."""
        return self.at(i) == "{" and (not self.space(i) or self.at(i - 1) in ("=", "return", ",", "("))

    def ends(self, i, stops):
        text = self.at(i)
        return text in (",", ";", "?", ":", "(", "[", "{", "}", ")", "]") or text in WORDS or (
            text in stops and i not in self.dead and (text not in BINARY or self.binary(i)))

    def region(self, i, stops):
        """The first and last token of the expression around token i that operators of `stops` end; None: it has a body."""
        first = last = i
        while first > 0:
            text, before = self.at(first - 1), self.match.get(first - 1, 0)
            if text in (")", "]") and not (text == ")" and self.kind(first) != "op") or text == "}" and self.group(before):
                first = before
            elif self.ends(first - 1, stops):
                break
            else:
                first -= 1
        while last + 1 < len(self.tokens):
            if self.at(last + 1) in ("(", "[") or self.group(last + 1):
                last = self.match.get(last + 1, last + 1)
            elif self.ends(last + 1, stops):
                break
            else:
                last += 1
        lambdas = any(self.at(k) == "{" and not self.group(k) or self.at(k) == "[" and self.kind(k - 1) != "name"
                      and self.at(k - 1) not in (")", "]") for k in range(first, last + 2))
        return None if lambdas else (first, last)

    def statement(self, i):
        """The first token of the statement that token i is in, within the same brackets."""
        while i > 0 and self.at(i - 1) not in (";", "{", "(", "["):
            if self.at(i - 1) == "}" and not self.group(self.match.get(i - 1, 0)):
                break
            i = self.match.get(i - 1, i - 1) if self.at(i - 1) in (")", "]", "}") else i - 1
        return i

    def head(self, brace):
        if brace not in self.heads:
            self.heads[brace] = [self.at(k) for k in range(self.statement(brace), brace)]
        return self.heads[brace]

    def body(self, i):
        """What stands before the body of the function that token i is in; None: it is in none, or in a lambda's."""
        brace = self.inside[i]
        while brace >= 0:
            words = self.head(brace)
            if self.at(brace) != "{" or self.group(brace) or "[" in words or words[-1:] not in ([")"], ["const"]) and set(words) & {
                    "class", "struct", "namespace", "enum", "union"}:
                return None
            if "(" in words and words[0] not in WORDS - {"const", "static", "auto", "constexpr"}:
                return words
            brace = self.inside[brace]
        return None

    def declares(self, first, last):
        """Whether a type stands before a name."""
        return any(self.kind(k + 1) == "name" and (self.kind(k) == "name" or self.at(k) in (">", "&", "*", "&&") and not self.space(k))
                   for k in range(first, last))

    def begins(self, i):
        """Whether a statement of a function's block begins with token i."""
        return (self.kind(i) == "name" or self.at(i) in ("++", "--")) and self.at(i - 1) in (";", "{", "}") and not self.group(
            self.match.get(i - 1, 0)) and not self.group(i - 1) and self.at(self.inside[i]) == "{" and self.body(i) is not None


# --- operators: (name, first position, end, what stands there then, how that is switched) -------------------

def number(text, rng):
    """Off by one, or by 1 %."""
    if whole := re.fullmatch(r"(0[xX][\da-fA-F']+|[\d']+)([uUlLzZ]*)", text):
        value = int(whole[1].replace("'", ""), 16 if whole[1][1:2] in ("x", "X") else 10)
        return f"{value + (rng.choice((1, -1)) if value else 1)}{whole[2]}"
    if part := re.fullmatch(r"(\d[\d']*\.?\d*(?:[eE][+-]?\d+)?|\.\d+)([fFlL]?)", text):
        new = f"{float(part[1].replace(chr(39), '')) * rng.choice((1.01, 0.99)) or 0.01:.9g}"
        return new + ".0" * new.isdigit() + part[2]
    return None


def turned(source, i, rng):
    """Of one token: the operator's name, what takes its place, and the region that is switched."""
    text, before, after = source.at(i), source.at(i - 1), i + 1
    if text in TURNED and source.binary(i):
        stops = set() if text in ASSIGN else ASSIGN.union(*LEVELS[:next(k for k, level in enumerate(LEVELS) if text in level)])
        region = source.region(i, stops)
        if region and not (text in ("+", "+=") and any(source.kind(k) == "string" for k in range(region[0], region[1] + 1))):
            yield "operator", rng.choice(TURNED[text].split()), region
    if source.kind(i) == "number" and not (before == "=" and source.at(i - 2) in (")", "const", "override", "noexcept")):
        yield "constant", number(text, rng), (i, i)
    if text in ("true", "false"):
        yield "constant", "false" if text == "true" else "true", (i, i)
    while after in source.dead:
        after += 1
    chain = ASSIGN | BINARY
    if text in NAMES and source.at(after) == "(" and (source.kind(i - 1) != "name" or before in WORDS):
        yield "function", NAMES[text], source.region(i, chain)
    if before == "." and source.at(i + 1) != "(" and re.fullmatch("[xyzw]{1,4}|[rgba]{1,4}", text):
        new = "".join(NEXT[c] for c in text) if len(set(text)) == 1 else text[1] + text[0] + text[2:]
        yield "swizzle", new if new != text else text[-1] + text[1:-1] + text[0], source.region(i, chain)
    values = source.enums.get(source.at(i - 2), []) if before == "::" else []
    if text in values and len(values) > 1:
        at = values.index(text)
        yield "enumerator", rng.choice(values[max(at - 1, 0):at] + values[at + 1:at + 2]), source.region(i, chain)


def argument(source, i, rng):
    """Of a call: an argument and the next in each other's place, or the last one dropped."""
    name, close = source.at(i), source.match.get(i + 1, 0)
    if (source.kind(i) != "name" or source.at(i + 1) != "(" or name in WORDS or name in NAMES or name.isupper() or source.body(i) is None
            or source.kind(i - 1) == "name" and source.at(i - 1) not in WORDS or source.declares(i - 1, i) or source.declares(i + 2, close - 1)):
        return
    cuts = [k for k in range(i + 2, close) if source.at(k) == "," and source.inside[k] == i + 1 and k not in source.dead]
    region, text = source.region(i, ASSIGN | BINARY), source.text
    if not cuts or region is None:
        return
    (start, end), at = source.span(*region), rng.randrange(len(cuts))
    a, b = source.span(([i + 1] + cuts)[at] + 1, cuts[at] - 1)
    c, d = source.span(cuts[at] + 1, (cuts + [close])[at + 1] - 1)
    swap = text[start:a] + text[c:d] + text[b:c] + text[a:b] + text[d:end]
    yield "argument", start, end, text[start:b] + text[d:end] if at + 1 == len(cuts) and rng.random() < 0.3 else swap


def statement(source, i, rng):
    """Dropped, or not come to: an early return."""
    control = source.at(i - 1) == "else" or source.at(i - 1) == ")" and source.at(source.match.get(i - 1, 0) - 1) in ("if", "for", "while")
    begins, end = source.begins(i), i
    if not begins and not (control and source.kind(i) == "name"):
        return
    while source.at(end) not in (";", "}", ")", "]", ""):
        end = max(end, source.match.get(end, end)) + 1
    top = [k for k in range(i, end) if source.inside[k] == source.inside[i]]
    does = [k for k in top if source.at(k) in ASSIGN | {"(", "++", "--"}]
    if source.at(i) not in WORDS and source.at(end) == ";" and does and not source.declares(
            i, next((k for k in top if source.at(k) in ASSIGN | {"(", "["}), end)):
        start, end = source.span(i, end)
        yield "dropped", start, end, ";", f"{{ if (!{M}) {source.text[start:end]} }}"
    if not begins or source.at(i) in ("case", "default", "else") or rng.random() < 0.75:
        return
    words = source.body(i)
    name = words.index("(") - 1
    while name > 1 and words[name - 1] in ("::", "~"):
        name -= 1 + (words[name - 1] == "::")
    kind = [w for w in words[:max(name, 0)] if w not in ("inline", "static", "constexpr", "virtual", "explicit", "std", "::")] or ["void"]
    what = "return; " if kind == ["void"] else "return {}; "
    if source.glsl and kind != ["void"]:
        what = f"return {kind[-1]}(0); "
    if not (source.glsl and re.search("[A-Z]", kind[-1]) or kind[-1] == "&" or "auto" in kind):
        start = source.tokens[i].start
        yield "early return", start, start, what, f"if ({M}) {what}"


def edits_of(source, i, rng):
    """All that may be done at a token."""
    text = source.text
    for name, new, region in turned(source, i, rng):
        if region and new and not (source.glsl and source.at(region[1] + 1) in ASSIGN):
            (start, end), (a, b) = source.span(*region), source.span(i, i)
            yield name, start, end, text[start:a] + new + text[b:end], None
    for name, start, end, new in argument(source, i, rng):
        yield name, start, end, new, None
    yield from statement(source, i, rng)
    close = source.match.get(i + 1, 0)
    if source.at(i) == "if" and close > i + 2 and not any(
            source.at(k) in ASSIGN | {";"} and source.inside[k] == i + 1 for k in range(i + 2, close)):
        start, end = source.span(i + 2, close - 1)
        yield "condition", start, end, f"!({text[start:end]})", f"({M} != bool({text[start:end]}))"


def constness(source, i):
    """Where `constexpr` stands of what token i is part of, and what takes its place: it is switched at run time."""
    changes, brace = [], i
    while brace >= 0:
        first, outer = source.statement(brace), source.inside[brace]
        for k in range(first, brace):
            if source.glsl and source.at(k) == "const" and outer < 0:
                changes.append((*source.span(k, k), ""))
            if source.at(k) == "constexpr" and source.at(k - 1) != "if":
                function = brace != i and not source.group(brace) and "=" not in source.head(brace)
                member = outer >= 0 and {"class", "struct"} & set(source.head(outer)) and "(" not in source.head(outer)
                changes.append((*source.span(k, k), "inline" if function else "inline const" if member else "const"))
        brace = outer
    return changes


class Edit:
    def __init__(self, saved=None, source=None, i=0, what=None):
        self.by, self.test, self.tried, self.number = None, None, [], 0
        if saved:
            self.__dict__.update(saved)
            return
        self.file, (self.operator, self.start, self.end, self.new, self.switched) = source.path, what
        self.old, self.const = source.text[self.start:self.end], constness(source, i)
        self.switched = self.switched or f"({M} ? ({' '.join(self.new.split())}) : ({self.old}))"
        self.lines = [source.line(self.start), source.line(self.end)]

    def applied(self, text):
        return text[:self.start] + self.new + text[self.end:]


def draw(files, count, seed, changed=None):
    """Edits in each folder in turn: of a random line one that it may have. None overlaps another."""
    rng, enums, folders, edits = random.Random(seed), {}, collections.defaultdict(list), []
    for text in files.values():
        for name, values in re.findall(r"\benum (?:class )?(\w+)[^{;()]*\{([^{}]*)\}", re.sub(r"//[^\n]*", "", text)):
            enums[name] = re.findall(r"(?:^|,)\s*(\w+)", values)
    for path in sorted(files):
        source, lines = Source(path, files[path], enums), collections.defaultdict(list)
        for i, token in enumerate(source.tokens):
            line = source.line(token.start)
            if i not in source.dead and (changed is None or line in changed.get(path, ())):
                for what in edits_of(source, i, rng):
                    if not re.search("//|/[*]", source.text[what[1]:what[2]]) and source.text[what[1]:what[2]] != what[3]:
                        lines[line].append((i, what))
        folders[path.rpartition("/")[0]] += [(source, found) for found in lines.values()]
    names = sorted(folders)
    rng.shuffle(names)
    while len(edits) < count and (names := [name for name in names if folders[name]]):
        for name in names:
            source, found = folders[name].pop(rng.randrange(len(folders[name])))
            edit = Edit(None, source, *rng.choice(found))
            if len(edits) < count and not any(e.file == edit.file and e.start <= edit.end and edit.start <= e.end for e in edits):
                edits.append(edit)
                edit.number = len(edits)
    return edits


def switched(path, text, edits):
    """A file with its edits, each switched, and one line more, which has the switch."""
    changes = {(e.start, e.end): e.switched.replace(M, f"DIPTYCH_MUTANT({e.number}u)") for e in edits}
    changes.update({(start, end): new for e in edits for start, end, new in e.const})
    out, at, depth, line_start = text, 0, 0, 0
    for (start, end), new in sorted(changes.items(), reverse=True):
        out = out[:start] + new + out[end:]
    if path.endswith(GLSL):  # below its extensions, and what it includes whatever is defined
        guarded = re.match(r"(?:\s|//[^\n]*)*#ifndef \w+_GLSL", text) is not None
        for line in out[:min(e.start for e in edits)].splitlines(keepends=True):
            line_start += len(line)
            depth += line.startswith("#if") - line.startswith("#endif")
            if re.match("#(extension|include|version)", line) and depth <= guarded:
                at = line_start
    return out[:at] + '#include "tests/mutation/mutant.h"\n' + out[at:]


def blamed(said, edits, tree):
    """The edits on lines that a compiler's errors name, or notes to an error that names none."""
    places = {(e.file, line + 1): e.number for e in edits for line in range(e.lines[0], e.lines[1] + 1)}
    bad, unexplained = set(), False
    for path, line, text in re.findall(r"^(?:ERROR: )?([^\s:]+):(\d+):(.*)$", said, re.M):
        edit, error = places.get((os.path.relpath(tree / "build" / path, tree), int(line))), "error: " in text or "' : " in text
        if error or "note: " in text and unexplained:
            unexplained = edit is None
            bad |= {edit} - {None}
    return bad


# --- a run ------------------------------------------------------------------------------------------------

def call(*command, **options):
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", **options)
    return done.returncode, done.stdout


def must(*command, **options):
    code, said = call(*command, **options)
    if code:
        raise Stop(f"{' '.join(map(str, command))}: {said.strip()[-3000:]}")
    return said


class Run:
    def __init__(self, work, options, root=ROOT):
        self.work, self.options, self.root, self.file = work, options, root, work / "results.json"
        self.lock, self.locks = threading.Lock(), collections.defaultdict(threading.Lock)
        saved = json.loads(self.file.read_text(encoding="utf-8")) if self.file.exists() else {}
        self.plan, self.commit, self.suites = saved.get("plan"), saved.get("commit"), saved.get("suites", {})
        self.edits, self.tree = [Edit(e) for e in saved.get("edits", [])], (options.copy or work / "copy").resolve()

    @staticmethod
    def say(words):
        print(words, flush=True)

    def save(self):
        with self.lock:
            state = {"plan": self.plan, "commit": self.commit, "suites": self.suites, "edits": [e.__dict__ for e in self.edits]}
            self.file.with_suffix(".new").write_text(json.dumps(state, indent=1), encoding="utf-8")
            self.file.with_suffix(".new").replace(self.file)

    def wanted(self):
        return [e for e in self.edits if e.by != "compiler"][:self.plan["number"]]

    def draw(self):
        """The edits of this run, drawn or known; the sources that they are of."""
        o, head = self.options, must("git", "-C", self.root, "rev-parse", "HEAD").strip()
        plan = {"number": o.number, "seed": o.seed, "paths": o.paths, "since": o.since}
        if self.plan and not (o.all or o.again or o.report) and self.plan != plan:
            raise Stop(f"{self.file}: it is of another run, {self.plan}: the same arguments, or another folder")
        self.plan, self.commit = self.plan or plan, head if o.again else self.commit or head
        if o.again:
            self.suites = {}
            for edit in self.edits:
                edit.tried = []
        names = must("git", "-C", self.root, "ls-tree", "-r", "--name-only", self.commit, "--", *(self.plan["paths"] or FOLDERS)).split()
        names = [n for n in names if re.match("|".join(FOLDERS), n) and "/example/" not in n and n.endswith((".cpp", ".h", *GLSL))]
        self.files = {n: must("git", "-C", self.root, "show", f"{self.commit}:{n}") for n in names}
        changed, name = collections.defaultdict(set), ""
        for line in must("git", "-C", self.root, "diff", "-U0", "--no-prefix", self.plan["since"], self.commit).split("\n") if self.plan["since"] else ():
            name = line[4:] if line.startswith("+++ ") else name
            if hunk := re.match(r"@@ \S+ \+(\d+)(?:,(\d+))? @@", line):
                changed[name].update(range(int(hunk[1]), int(hunk[1]) + int(hunk[2] or 1)))
        self.edits = self.edits or draw(self.files, int(self.plan["number"] * SPARE) + 1, self.plan["seed"], changed if self.plan["since"] else None)
        for edit in self.edits:
            if self.files.get(edit.file, "")[edit.start:edit.end] != edit.old:
                raise Stop(f"{edit.file} has changed since: a new run, in another folder")
        self.save()

    def clone(self):
        if not self.tree.exists():
            must("git", "clone", "-q", self.root, self.tree)
        mark = self.tree / ".git" / "mutants"  # whoever has it may be overwritten
        if not mark.exists() and must("git", "-C", self.tree, "status", "--porcelain", "-uno"):
            raise Stop(f"{self.tree} has changes that are not committed: give a clone without any")
        mark.touch()
        if must("git", "-C", self.tree, "rev-parse", "HEAD").strip() != self.commit:
            must("git", "-C", self.tree, "fetch", "-q", self.root, self.commit)
            must("git", "-C", self.tree, "checkout", "-q", "-f", "--detach", self.commit)
        if not (self.tree / "build" / "build.ninja").exists():
            must("cmake", "-S", self.tree, "-B", self.tree / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release")

    def put(self):
        """Writes the files of the copy that are to differ from those that are there: a build goes on where it ended."""
        by_file, wanted = collections.defaultdict(list), {}
        for edit in self.edits:
            if edit.by != "compiler":
                by_file[edit.file].append(edit)
        original = lambda name: must("git", "-C", self.tree, "show", f"HEAD:{name}")  # noqa: E731
        for name, edits in by_file.items():
            wanted[name] = switched(name, self.files[name], edits)
        for old, new in SETTERS if any(name.endswith(GLSL) for name in by_file) else ():
            for line in must("git", "-C", self.tree, "grep", "-l", "-F", old, "HEAD", "--", "*.cpp").split():
                name = line.removeprefix("HEAD:")
                text = wanted.get(name) or '#include "tests/mutation/mutant.h"\n' + original(name)
                wanted[name] = text.replace(old, new)
        for name in must("git", "-C", self.tree, "diff", "--name-only").split():
            wanted.setdefault(name, original(name))
        for name, text in wanted.items():
            if (self.tree / name).read_text(encoding="utf-8") != text:
                (self.tree / name).write_text(text, encoding="utf-8")

    def compile(self):
        while True:
            self.put()
            code, said = call("ninja", "-C", self.tree / "build", f"-j{self.options.jobs}", "-k", "0",
                              *(f"{kind}_tests" for kind in self.options.kinds.split(",")))
            if code == 0:
                return
            bad = blamed(said, [e for e in self.edits if e.by != "compiler"], self.tree)
            if not bad:
                raise Stop("the copy does not build, and no error names an edit:\n" + said[-4000:])
            for edit in self.edits:
                edit.by = "compiler" if edit.number in bad else edit.by
            self.say(f"left out, as they do not compile: {' '.join(map(str, sorted(bad)))}")
            self.save()

    def start(self, suite, limit, **environment):
        """The tests that failed, and seconds."""
        folder, begun = self.work / "tmp" / str(threading.get_ident()), time.monotonic()
        folder.mkdir(parents=True, exist_ok=True)
        with self.locks[suite["name"]], open(folder / "said", "w+", encoding="utf-8", errors="replace") as said:
            # An edit may well ask for all the memory that there is.
            process = subprocess.Popen(["sh", "-c", 'ulimit -d 8000000; exec "$@"', "sh", *suite["command"]], stdout=said, stderr=said,
                                       cwd=suite["folder"], start_new_session=True,
                                       env={**os.environ, "TMPDIR": str(folder), **suite["environment"], **environment})
            try:
                code = process.wait(limit)
            except subprocess.TimeoutExpired:
                code = "late"
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            process.wait()
            said.seek(0)
            text = said.read()
        failed = re.findall(r"^\[  FAILED  \] ([^\s,]+)", text, re.M) or re.findall(r"^\[ RUN      \] (\S+)$", text, re.M)[-1:]
        return [] if code == 0 else sorted(set(failed)) or [f"({code})"], time.monotonic() - begun

    def record(self, suite):
        """What a suite comes by without an edit, and how long it takes. What fails is left out."""
        reached = self.work / "tmp" / f"{suite['name'].replace('/', '-')}.reached"
        for _ in range(3):
            reached.write_bytes(bytes(1 << 16))
            failed, suite["seconds"] = self.start(suite, suite["limit"], DIPTYCH_MUTANT="0", DIPTYCH_REACHED=str(reached))
            if not failed:
                break
            self.say(f"fails without an edit and is left out: {suite['name']} {' '.join(failed)}")
            suite["command"] = [w + ("" if "-" in w[2:] else "-") + "".join(f":{f}" for f in failed) if w.startswith("--gtest_filter") else w
                                for w in suite["command"]]
        suite["reached"] = [] if failed else [n for n, byte in enumerate(reached.read_bytes()) if byte]
        self.suites[suite["name"]] = suite
        self.save()

    def known(self):
        """The suites of ctest that this run may use, in the order in which they are tried."""
        new = []
        for test in json.loads(must("ctest", "--test-dir", self.tree / "build", "--show-only=json-v1"))["tests"]:
            has = {p["name"]: p["value"] for p in test["properties"]}
            kind = next((k for k in KINDS if k in has.get("LABELS", ())), None)
            if kind in self.options.kinds.split(",") and "FIXTURES_REQUIRED" not in has and (self.options.all or "all" not in has["LABELS"]):
                new.append({"name": test["name"], "kind": kind, "command": test["command"], "folder": has["WORKING_DIRECTORY"],
                            "environment": dict(v.split("=", 1) for v in has.get("ENVIRONMENT", ())), "limit": has.get("TIMEOUT", 1800)})
        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            list(pool.map(self.record, [s for s in new if s["name"] not in self.suites]))
        return sorted((self.suites[s["name"]] for s in new), key=lambda s: (min(KINDS.index(s["kind"]), 2), s["seconds"]))

    def attempt(self, edit, suites):
        edit.by = "survived"
        for suite in suites:
            if edit.number in suite["reached"] and suite["name"] not in edit.tried:
                failed, _ = self.start(suite, 15 + 5 * suite["seconds"], DIPTYCH_MUTANT=str(edit.number), GTEST_FAIL_FAST="1")
                if failed:
                    edit.by, edit.test = suite["kind"], f"{suite['name']} {failed[0]}"
                    break
                edit.tried.append(suite["name"])
        self.save()
        self.say(f"{edit.number} {edit.file}:{edit.lines[0]} {edit.operator}: {edit.by} {edit.test or ''}")

    def equivalent(self, edit):
        """Whether machine code or modules are the original's. WORK/alone is looked into first: edited files as they were."""
        alone, build, result = self.work / "alone", self.tree / "build", self.work / "alone" / "result"
        for name in {e.file for e in self.edits}:
            (alone / name).parent.mkdir(parents=True, exist_ok=True)
            (alone / name).write_text(self.files[name], encoding="utf-8")
        if edit.file.endswith(GLSL):
            targets = [str(d.relative_to(build))[:-2] for d in build.rglob("*.spv.d")
                       if (build / "tests") not in d.parents and f"/{edit.file}" in d.read_text()]
        else:
            known = re.findall(r"^(\S+): #deps.*\n((?:    .*\n)*)", must("ninja", "-C", build, "-t", "deps"), re.M)
            targets = [target for target, names in known if f"/{edit.file}\n" in names and not target.startswith("tests/")]

        def compiled(command, text):
            (alone / edit.file).write_text(text, encoding="utf-8")
            result.unlink(missing_ok=True)
            must("sh", "-c", command, cwd=build)
            return result.read_bytes()
        for target in sorted(targets)[:1 if edit.file.endswith(".cpp") else None]:
            command = must("ninja", "-C", build, "-t", "commands", "-s", target).strip().split("\n")[-1]
            command = command.replace(str(build / target), str(result)).replace(target, str(result)).replace(" -I", f" -I{alone} -I", 1)
            if edit.file.endswith(".cpp"):
                command = re.sub(r" -c \S+", f" -c {alone / edit.file}", command)
            command = command.replace(str(self.tree / edit.file), str(alone / edit.file))
            if compiled(command, self.files[edit.file]) != compiled(command, edit.applied(self.files[edit.file])):
                return False
        return bool(targets)

    def go(self):
        self.draw()
        if not self.options.report:
            begun = time.monotonic()
            self.clone()
            self.compile()
            (self.work / "tmp").mkdir(exist_ok=True)
            built, suites = time.monotonic(), self.known()
            ready = time.monotonic()
            with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
                list(pool.map(lambda e: self.attempt(e, suites), [e for e in self.wanted() if e.by in (None, "survived")]))
            for edit in self.wanted():
                if edit.by == "survived" and self.equivalent(edit):
                    edit.by = "equivalent"
                    self.save()
            self.say(f"seconds: building {built - begun:.0f}, suites without an edit {ready - built:.0f}, edits {time.monotonic() - ready:.0f}")
        self.report()

    def report(self):
        heads, rows = (*KINDS, "survived", "equivalent"), collections.defaultdict(collections.Counter)
        for edit in sorted(self.wanted(), key=lambda e: (e.file, e.start)):
            for row in (edit.file.rpartition("/")[0], "~all"):
                rows[row].update(("edits", edit.by))
            if edit.by == "survived":
                text, reached = self.files[edit.file], any(edit.number in s["reached"] for s in self.suites.values())
                diff = difflib.unified_diff(text.splitlines(), edit.applied(text).splitlines(), n=1, lineterm="")
                print(f"\n{edit.number} {edit.file}: {edit.operator}{'' if reached else '; no test comes by'}", *list(diff)[2:], sep="\n")
        print(f"\n| folder | edits | {' | '.join(heads)} |\n|---|---|{'---|' * len(heads)}")
        for name, row in sorted(rows.items()):
            print(f"| {name.strip('~')} | {row['edits']} | " + " | ".join(str(row[h] or "") for h in heads) + " |")
        print(f"\nleft out, as they do not compile: {sum(e.by == 'compiler' for e in self.edits)}")


# Where modules become known to Vulkan, and what sets the switch there.
SETTERS = (("vkCreateShaderModule(", "diptychCreateShaderModule("), ("Specializer(module, value)", "Specializer(diptychModule(module), value)"))


def main(arguments, root=ROOT):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("paths", nargs="*")
    for name, kind, default in (("number", int, 120), ("seed", int, 1), ("since", str, None), ("kinds", str, ",".join(KINDS)),
                                ("copy", pathlib.Path, None), ("jobs", int, os.cpu_count())):
        parser.add_argument(f"--{name}", type=kind, default=default)
    for name in ("all", "again", "report"):
        parser.add_argument(f"--{name}", action="store_true")
    options = parser.parse_args(arguments)
    options.work.mkdir(parents=True, exist_ok=True)
    try:
        Run(options.work.resolve(), options, root).go()
    except Stop as why:
        print(why)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
