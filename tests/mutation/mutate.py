#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes small edits of the product, C++ and GLSL, and says which test notices each.

    mutate.py WORK [FOLDER...] [--number 120] [--seed 1] [--since REV] [--kinds unit,probe] [--copy DIR] [--all]

All edits stand in one build of a clone of what is committed (WORK/copy; --copy: a clone, built in DIR/build), each as
`DIPTYCH_MUTANT(n) ? edited : original` (mutant.h). What the compiler refuses, such as an edit of what must be constant, is left
out; another takes its place. Then each suite of ctest is run without an edit: how long it takes, and which edits' places it
comes by. Those suites alone try an edit: of unit tests first, then of probes, then the others, the quickest first, until one
fails or is late. What survives is compiled once more, alone: where object files or modules are the original's, it is equivalent.
WORK/results.json has all that is known, and the same command goes on from there; with --all, tests that can wait (longer.txt)
try what survived. An edit may remove or overwrite files that it should not: whoever runs this should be able to write little else.
"""
import argparse, collections, concurrent.futures, contextlib, functools, json, os, pathlib, random, re, shutil
import signal, subprocess, sys, threading, time

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("compare", "deferred", "forward_plus", "shaders/lib", "shaders/pass", "shared")
GLSL = (".glsl", ".vert", ".frag", ".comp")
KINDS = ("unit", "probe", "image", "tool")
SPARE = 1.4  # candidates drawn per wanted edit: some do not compile
M = "\0"  # the switch, in Edit.switched
INCLUDE = '#include "tests/mutation/mutant.h"\n'
say = functools.partial(print, flush=True)
# Calls that pass a module to Vulkan or strip it, and their replacements that set the switch.
SETTERS = (("vkCreateShaderModule(", "diptychCreateShaderModule("),
           ("Specializer(module, value, outputs)", "Specializer(diptychModule(module), value, outputs)"))
TOKEN = re.compile(r"""(?P<skip>//[^\n]*|/\*.*?\*/|\#(?:\\\n|[^\n])*|\s+)
  |(?P<string>(?:u8|[uUL])?R"(?P<d>[^(\s]*)\(.*?\)(?P=d)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+')
  |(?P<number>\.?\d(?:[eE][+-]|['\w.])*)|(?P<name>[A-Za-z_]\w*)
  |(?P<op><=>|<<=|>>=|\.\.\.|->|::|\+\+|--|&&|\|\||\^\^|[-+*/%&|^<>=!]=|<<|>>|.)""", re.X | re.S)
ASSIGN = {op + "=" for op in ("", *"+-*/%&|^", "<<", ">>")}
# Binary operators, from weakest to strongest binding; they end an operand's expression.
LEVELS = [{"||", "^^"}, {"&&"}, {"&", "|", "^"}, {"==", "!="}, {"<", "<=", ">", ">="}, {"<<", ">>"}, {"+", "-"}, {"*", "/", "%"}]
CHAIN = ASSIGN.union(*LEVELS)
WORDS = set("""return else do throw case default goto delete new if for while switch break continue using const auto static struct
    class public private try catch constexpr""".split())
TYPES = {"class", "struct", "namespace", "enum", "union"}
TO_SEMICOLON = set("throw static_assert assert using typedef namespace concept friend extern requires".split())
IN_BRACKETS = re.compile(r"layout|alignas|decltype|sizeof|noexcept|CONTRACT_\w+|(?i:.*(?:error|warn|fail|refuse|problem|print).*)")
TURNED = {"<": "> <=", "<=": "< >=", ">": "< >=", ">=": "> <=", "==": "!=", "!=": "==", "+": "-", "-": "+", "*": "/", "/": "*",
          "&&": "||", "||": "&&", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
NAMES = dict(pair.split("/") for pair in """min/max fmin/fmax floor/ceil sin/cos any/all any_of/all_of front/back true/false
    lower_bound/upper_bound min_element/max_element lessThan/lessThanEqual greaterThan/greaterThanEqual""".split())
NAMES.update({other: name for name, other in NAMES.items()})
# GLSL functions whose arguments may be swapped: others seldom take arguments of one type.
ALIKE = re.compile(r"[iu]?vec\d|mix|pow|atan|clamp|(smooth)?step|(cross|reflect)\w*")
NEXT = str.maketrans("xyzwrgba", "yxyzgrgb")  # components


class Source:
    """A file's tokens: text, kind, span, matching and enclosing brackets. `dead`: tokens that no edit may touch."""

    def __init__(self, path, text, enums):
        self.path, self.text, self.enums, self.glsl = path, text, enums, path.endswith(GLSL)
        found = [m for m in TOKEN.finditer(text) if not m["skip"]]
        self.count, self.at, self.spans = len(found), [m[0] for m in found] + ["", ""], [m.span() for m in found]
        self.kind = ["string" if m["string"] else m.lastgroup for m in found] + ["", ""]
        self.match, self.inside, self.dead, stack, angles = {}, [], set(), [], []
        for i, t in enumerate(self.at):
            if t in (")", "]", "}") and stack:
                self.match[i] = stack.pop()
                self.match[self.match[i]] = i
            self.inside.append(stack[-1] if stack else -1)
            if t in ("(", "[", "{"):
                stack.append(i)
        for i, t in enumerate(self.at[:-2]):
            end = i
            if t == "<" and (self.at[i - 1] == "template" or not self.space(i) and self.kind[i - 1] == "name"):
                angles.append(i)
            elif t in (">", ">>") and not self.space(i):
                for _ in t[:len(angles)]:
                    self.dead.update(range(angles.pop(), i + 1))
            elif t == ";":
                angles.clear()
            elif t in TO_SEMICOLON or t in ("case", "enum"):
                while self.at[end] not in (":" if t == "case" else ";", "{", "}", ""):
                    end = max(end, self.match.get(end, end)) + 1
                end = self.match.get(end, end) if t == "enum" else end
            elif t == "operator":
                end = i + 2
            elif self.at[i + 1] == "(" and IN_BRACKETS.fullmatch(t):
                end = self.match.get(i + 1, i)
            self.dead.update(range(i, end + (end > i)))

    def line(self, position):
        return self.text.count("\n", 0, position) + 1

    def span(self, first, last):
        return self.spans[first][0], self.spans[last][1]

    def space(self, i):
        return self.text[self.spans[i][0] - 1].isspace()

    def group(self, i):
        """Whether braces are part of an expression, as in Point{1, 2}."""
        return self.at[i] == "{" and (not self.space(i) or self.at[i - 1] in ("=", "return", ",", "("))

    def ends(self, i, stops):
        """Whether an expression ends here. clang-format puts spaces on both sides of binary operators only."""
        t = self.at[i]
        return t in (",", ";", "?", ":", "(", "[", "{", "}", ")", "]", "") or t in WORDS or (
            t in stops and i not in self.dead and (t in ASSIGN or self.space(i) and self.text[self.spans[i][1]].isspace()))

    def region(self, i, stops):
        """First and last token of the expression around token i, ended by operators of `stops`; None if it has a body."""
        first = last = i
        while first > 0:
            t, before = self.at[first - 1], self.match.get(first - 1, 0)
            if t == "]" or t == ")" and self.kind[first] == "op" or t == "}" and self.group(before):
                first = before
            elif self.ends(first - 1, stops):
                break
            else:
                first -= 1
        while not self.ends(last + 1, stops) or self.at[last + 1] in ("(", "[") or self.group(last + 1):
            last = self.match.get(last + 1, last + 1)
        lambdas = any(self.at[k] == "{" and not self.group(k) or self.at[k] == "[" and self.kind[k - 1] != "name"
                      and self.at[k - 1] not in (")", "]") for k in range(first, last + 2))
        return None if lambdas else (first, last)

    @functools.cache
    def head(self, brace):
        """The tokens of the statement before a brace, within the same brackets."""
        i = brace
        while i > 0 and self.at[i - 1] not in (";", "{", "(", "[") and (self.at[i - 1] != "}" or self.group(self.match.get(i - 1, 0))):
            i = self.match.get(i - 1, i - 1) if self.at[i - 1] in (")", "]", "}") else i - 1
        return self.at[i:brace]

    def body(self, i):
        """The head of the function whose body has token i; None outside functions and in lambdas."""
        brace = self.inside[i]
        while brace >= 0:
            words = self.head(brace)
            if self.at[brace] != "{" or self.group(brace) or "[" in words or words[-1:] not in ([")"], ["const"]) and TYPES & set(words):
                return None
            if "(" in words and words[0] not in WORDS - {"const", "static", "auto", "constexpr"}:
                return words
            brace = self.inside[brace]
        return None

    def declares(self, first, last):
        """Whether a type stands before a name."""
        return any(self.kind[k + 1] == "name" and (self.kind[k] == "name" or self.at[k] in (">", "&", "*", "&&") and not self.space(k))
                   for k in range(first, last))


# Operators yield (name, first position, end, replacement, how it is switched if it is no expression).
def number(text, rng):
    """The number off by one, or by 1 %."""
    if whole := re.fullmatch(r"(0x[\da-f]+|\d+)([ulz]*)", text.replace("'", ""), re.I):
        value = int(whole[1], 16 if "x" in whole[1].lower() else 10)
        return f"{value + (rng.choice((1, -1)) if value else 1)}{whole[2]}"
    part = re.fullmatch(r"(\d*\.?\d*(?:e[+-]?\d+)?)(f?)", text.replace("'", ""), re.I)
    new = part and f"{float(part[1]) * rng.choice((1.01, 0.99)) or 0.01:.9g}"
    return new and new + ".0" * new.isdigit() + part[2]


def of_token(source, i, rng):
    """Yields the operator's name, the token's replacement, and the region to switch."""
    t, before, after = source.at[i], source.at[i - 1], i + 1
    if t in TURNED and source.ends(i, {t}):
        stops = set() if t in ASSIGN else ASSIGN.union(*LEVELS[:next(k for k, level in enumerate(LEVELS) if t in level)])
        region = source.region(i, stops)
        if region and not (t in ("+", "+=") and "string" in source.kind[region[0]:region[1] + 1]):
            yield "operator", rng.choice(TURNED[t].split()), region
    if source.kind[i] == "number" and not (before == "=" and source.at[i - 2] in (")", "const", "override", "noexcept")):
        yield "constant", number(t, rng), (i, i)
    while after in source.dead:
        after += 1
    if t in ("true", "false"):
        yield "constant", NAMES[t], (i, i)
    elif t in NAMES and source.at[after] == "(" and (source.kind[i - 1] != "name" or before in WORDS):
        yield "function", NAMES[t], source.region(i, CHAIN)
    if before == "." and source.at[i + 1] != "(" and re.fullmatch("[xyzw]{1,4}|[rgba]{1,4}", t):
        yield "swizzle", t.translate(NEXT), source.region(i, CHAIN)
    values = source.enums.get(source.at[i - 2], []) if before == "::" else []
    if t in values and len(values) > 1:
        at = values.index(t)
        yield "enumerator", rng.choice(values[max(at - 1, 0):at] + values[at + 1:at + 2]), source.region(i, CHAIN)


def of_call(source, i, rng):
    """Swaps two adjacent arguments, or drops the last one."""
    name, close, text = source.at[i], source.match.get(i + 1, 0), source.text
    cuts = [k for k in range(i + 2, close) if source.at[k] == "," and source.inside[k] == i + 1 and k not in source.dead]
    region = source.region(i, CHAIN) if cuts and source.kind[i] == "name" and source.at[i + 1] == "(" else None
    if (region is None or name in {*WORDS, *NAMES, "dot"} or name.isupper() or source.body(i) is None or source.declares(i + 2, close - 1)
            or source.at[i - 1] not in WORDS and source.declares(i - 1, i) or source.glsl and not ALIKE.fullmatch(name)):
        return
    (start, end), at = source.span(*region), rng.randrange(len(cuts))
    (a, b), (c, d) = [source.span(k + 1, last - 1) for k, last in zip([i + 1, *cuts], [*cuts, close])][at:at + 2]
    drops = at + 1 == len(cuts) and not source.glsl and rng.random() < 0.3
    yield "argument", start, end, text[start:b] + text[d:end] if drops else text[start:a] + text[c:d] + text[b:c] + text[a:b] + text[d:end]


def of_statement(source, i, rng):
    """Drops a statement, or returns before it."""
    before, brace, end, words = source.at[i - 1], source.match.get(i - 1, 0), i, source.body(i)
    begins = before in (";", "{", "}") and source.at[source.inside[i]] == "{" and not source.group(brace) and not source.group(i - 1)
    control = before == "else" or before == ")" and source.at[brace - 1] in ("if", "for", "while")
    if words is None or not (begins or control) or source.kind[i] != "name" and source.at[i] not in ("++", "--"):
        return
    while source.at[end] not in (";", "}", ")", "]", "") and (source.at[end] != "{" or source.group(end)):
        end = max(end, source.match.get(end, end)) + 1
    does = [k for k in range(i, end) if source.inside[k] == source.inside[i] and source.at[k] in ASSIGN | {"(", "++", "--"}]
    if source.at[i] not in WORDS and source.at[end] == ";" and does and not source.declares(i, does[0]):
        start, end = source.span(i, end)
        yield "dropped", start, end, ";", f"{{ if (!{M}) {source.text[start:end]} }}"
    at = words.index("(")
    none = at == 1 or {"void", "explicit", "~", words[at - 1]} & {*words[:at - 1]}  # a constructor's name stands twice
    what = "return; " if none else f"return {words[at - 2]}(0); " if source.glsl else "return {}; "
    known = words[at - 2].islower() if source.glsl else not {"auto", "&"} & {*words[:at]}
    if begins and known and source.at[i] not in ("case", "default", "else") and rng.random() < 0.25:
        start = source.spans[i][0]
        yield "early return", start, start, what, f"if ({M}) {what}"


def edits_of(source, i, rng):
    """All edits that are possible at a token."""
    text, close = source.text, source.match.get(i + 1, 0)
    for name, new, region in of_token(source, i, rng):
        if region and new and not (source.glsl and source.at[region[1] + 1] in ASSIGN):
            (start, end), (a, b) = source.span(*region), source.spans[i]
            yield name, start, end, text[start:a] + new + text[b:end]
    yield from of_call(source, i, rng)
    yield from of_statement(source, i, rng)
    if source.at[i] == "if" and close > i + 2 and not any(
            source.at[k] in ASSIGN | {";"} and source.inside[k] == i + 1 for k in range(i + 2, close)):
        start, end = source.span(i + 2, close - 1)
        yield "condition", start, end, f"!({text[start:end]})", f"({M} != bool({text[start:end]}))"


def constness(source, i):
    """Replacements of `constexpr` around token i: a switched value is computed at run time."""
    changes, brace = [], i
    while brace >= 0:
        outer, head = source.inside[brace], source.head(brace)
        for k in range(brace - len(head), brace):
            if source.at[k] == ("const" if source.glsl and outer < 0 else "constexpr") and source.at[k - 1] != "if":
                function = brace != i and not source.group(brace) and "=" not in head
                member = outer >= 0 and TYPES - {"namespace"} & set(source.head(outer))
                changes.append((*source.spans[k], "" if source.glsl else "inline" if function else "inline const" if member else "const"))
        brace = outer
    return changes


def edit_of(source, i, operator, start, end, new, how=None):
    how = how or f"({M} ? ({' '.join(new.split())}) : ({source.text[start:end]}))"
    return argparse.Namespace(file=source.path, operator=operator, start=start, end=end, old=source.text[start:end], new=new, switched=how,
                              const=constness(source, i), lines=[source.line(start), source.line(end)], by=None, test=None, tried=[])


def applied(edit, text):
    return text[:edit.start] + edit.new + text[edit.end:]


def draw(files, count, seed, changed=None):
    """Draws edits from each folder in turn: a random edit of a random line. No two overlap."""
    rng, enums, folders, edits = random.Random(seed), {}, collections.defaultdict(list), []
    for text in files.values():
        for name, values in re.findall(r"\benum (?:class )?(\w+)[^{;()]*\{([^{}]*)\}", re.sub(r"//[^\n]*", "", text)):
            enums[name] = re.findall(r"(?:^|,)\s*(\w+)", values)
    for path in sorted(files):
        source, lines = Source(path, files[path], enums), collections.defaultdict(list)
        for i, (start, _) in enumerate(source.spans):
            line = source.line(start)
            if i not in source.dead and (changed is None or line in changed.get(path, ())):
                lines[line] += [(i, what) for what in edits_of(source, i, rng)
                                if source.text[what[1]:what[2]] != what[3] and not re.search("//|/[*]", source.text[what[1]:what[2]])]
        folders[path.rpartition("/")[0]] += [(source, found) for found in lines.values() if found]
    names = sorted(folders)
    rng.shuffle(names)
    while len(edits) < count and (names := [name for name in names if folders[name]]):
        for name in names:
            source, found = folders[name].pop(rng.randrange(len(folders[name])))
            i, what = rng.choice(found)
            edit = edit_of(source, i, *what)
            if len(edits) < count and not any(e.file == edit.file and e.start <= edit.end and edit.start <= e.end for e in edits):
                edits.append(edit)
                edit.number = len(edits)
    return edits


def switched(path, text, edits):
    """The file's text with all its edits, each behind its switch, and an include of the switch."""
    changes = {(e.start, e.end): e.switched.replace(M, f"DIPTYCH_MUTANT({e.number}u)") for e in edits}
    changes.update({(start, end): new for e in edits for start, end, new in e.const})
    # Shaders: inserted after extensions and unconditional includes.
    at = re.match(r"((//.*|#(ifndef|define) \w+_GLSL|#(version|extension|include) .*)?\n)*", text).end() if path.endswith(GLSL) else 0
    for (start, end), new in sorted(changes.items(), reverse=True):
        text = text[:start] + new + text[end:]
    return text[:at] + INCLUDE + text[at:]


def blamed(said, edits, tree):
    """The edits on lines named by compiler errors, or by the notes of an error that names none."""
    places = {(e.file, line + 1): e.number for e in edits for line in range(e.lines[0], e.lines[1] + 1)}
    bad, unexplained = set(), False
    for path, line, text in re.findall(r"^(?:ERROR: )?([^\s:]+):(\d+):(.*)$", said, re.M):
        file, error = os.path.relpath(tree / "build" / path, tree), "error: " in text or "' : " in text
        below = range(int(line), int(line) + (12 if "declared here" in text else 1))  # in the function declared there
        edit = next((places[file, at] for at in below if (file, at) in places), None)
        if error or "expansion of" in text or "note: " in text and unexplained:  # an error's context stands above it
            bad |= {edit} - {None}
        if "note: " not in text or edit:
            unexplained = error and edit is None and "compilation terminated" not in text
    return bad


def call(*command, may_fail=False, **options):
    done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", **options)
    if done.returncode and not may_fail:
        raise SystemExit(f"{' '.join(map(str, command))}: {done.stdout.strip()[-3000:]}")
    return done if may_fail else done.stdout


class Run:
    def __init__(self, work, options):
        self.work, self.options, self.file, self.tree = work, options, work / "results.json", (options.copy or work / "copy").resolve()
        self.lock, self.locks = threading.Lock(), collections.defaultdict(threading.Lock)
        saved = json.loads(self.file.read_text(encoding="utf-8")) if self.file.exists() else {}
        self.plan, self.suites = saved.get("plan"), saved.get("suites", {})
        self.edits = [argparse.Namespace(**e) for e in saved.get("edits", [])]

    def save(self):
        with self.lock:
            state = {"plan": self.plan, "suites": self.suites, "edits": [e.__dict__ for e in self.edits]}
            self.file.with_suffix(".new").write_text(json.dumps(state, indent=1), encoding="utf-8")
            self.file.with_suffix(".new").replace(self.file)

    def git(self, *arguments):
        return call("git", "-C", self.tree, *arguments)

    def wanted(self):
        return [e for e in self.edits if e.by != "compiler"][:self.plan["number"]]

    def clone(self):
        if not self.tree.exists():
            call("git", "clone", "-q", ROOT, self.tree)
        mark = self.tree / ".git" / "mutants"  # this program may overwrite a clone with this mark
        if not mark.exists() and self.git("status", "--porcelain", "-uno"):
            raise SystemExit(f"{self.tree} has changes that are not committed: give a clone without any")
        mark.touch()
        if not (self.tree / "build" / "build.ninja").exists():
            call("cmake", "-S", self.tree, "-B", self.tree / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release")

    def draw(self):
        """Reads the clone's sources; draws the edits, if none are known."""
        o, changed, name = self.options, collections.defaultdict(set), ""
        plan = {"number": o.number, "seed": o.seed, "paths": o.paths, "since": o.since, "commit": self.git("rev-parse", "HEAD").strip()}
        if self.plan not in (None, plan):
            raise SystemExit(f"{self.file}: it is of another run, {self.plan}: the same arguments and commit, or another folder")
        names = [n for n in self.git("ls-files", *(o.paths or FOLDERS)).split() if n.endswith((".cpp", ".h", *GLSL))]
        self.plan, self.files = plan, {n: self.git("show", f"HEAD:{n}") for n in names if "/example/" not in n}
        for line in self.git("diff", "-U0", "--no-prefix", o.since, "HEAD").split("\n") if o.since else ():
            name = line[4:] if line.startswith("+++ ") else name
            if hunk := re.match(r"@@ \S+ \+(\d+)(?:,(\d+))? @@", line):
                changed[name].update(range(int(hunk[1]), int(hunk[1]) + int(hunk[2] or 1)))
        self.edits = self.edits or draw(self.files, int(o.number * SPARE) + 1, o.seed, changed if o.since else None)
        self.save()

    def put(self):
        """Writes only the files that change, so that builds are incremental."""
        edits = [e for e in self.edits if e.by != "compiler"]
        wanted = {n: switched(n, self.files[n], [e for e in edits if e.file == n]) for n in {e.file for e in edits}}
        for old, new in SETTERS:
            for name in self.git("grep", "-l", "-F", old, "HEAD", "--", "*.cpp").replace("HEAD:", "").split():
                text = wanted.get(name) or INCLUDE + self.git("show", f"HEAD:{name}")
                wanted[name] = re.sub(r"\b" + re.escape(old), new, text)  # not __wrap_..., which the linker knows
        for name in self.git("diff", "--name-only").split():
            wanted.setdefault(name, self.git("show", f"HEAD:{name}"))
        for name, text in wanted.items():
            if (self.tree / name).read_text(encoding="utf-8") != text:
                (self.tree / name).write_text(text, encoding="utf-8")
        return edits

    def compile(self):
        while True:
            edits = self.put()
            done = call("ninja", "-C", self.tree / "build", f"-j{self.options.jobs}", "-k", "0",
                        *(f"{kind}_tests" for kind in self.options.kinds.split(",")), may_fail=True)
            if done.returncode == 0:
                return
            bad = blamed(done.stdout, edits, self.tree)
            if not bad:
                raise SystemExit("the copy does not build, and no error names an edit:\n" + done.stdout[-4000:])
            for edit in edits:
                edit.by = "compiler" if edit.number in bad else edit.by
            say(f"left out, as they do not compile: {' '.join(map(str, sorted(bad)))}")
            self.save()

    def start(self, suite, limit, **environment):
        """Runs a suite; returns the tests that failed, and seconds."""
        folder, begun, code = self.work / "tmp" / str(threading.get_ident()), time.monotonic(), "late"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        with self.locks[suite["name"]], open(folder / "said", "w") as said:
            # A mutant may request all memory or disk.
            process = subprocess.Popen(["sh", "-c", 'ulimit -d 8000000; ulimit -f 8000000; exec "$@"', "sh", *suite["command"]], stdout=said, stderr=said,
                                       cwd=suite["folder"], start_new_session=True,
                                       env={**os.environ, "TMPDIR": str(folder), **suite["environment"], **environment})
            with contextlib.suppress(subprocess.TimeoutExpired):
                code = process.wait(limit)
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        text = (folder / "said").read_text(encoding="utf-8", errors="replace")
        failed = re.findall(r"^\[  FAILED  \] ([\w/]+\.[\w/]+)", text, re.M) or re.findall(r"^\[ RUN      \] (\S+)$", text, re.M)[-1:]
        return [] if code == 0 else sorted(set(failed)) or [f"({code})"], time.monotonic() - begun

    def record(self, suite):
        """Records the edits that a suite reaches without any edit, and its time. Skips suites that fail."""
        reached = self.work / "tmp" / f"{suite['name'].replace('/', '-')}.reached"
        for _ in range(3):
            reached.write_bytes(bytes(1 << 16))
            failed, suite["seconds"] = self.start(suite, suite["limit"], DIPTYCH_MUTANT="0", DIPTYCH_REACHED=str(reached))
            if not failed:
                break
            say(f"fails without an edit and is left out: {suite['name']} {' '.join(failed)}")
            suite["command"] = [w + "-" * ("-" not in w[2:]) + "".join(f":{f}" for f in failed)
                                if re.match(r"(--gtest_filter=)?[\w/]+\.[*]", w) else w for w in suite["command"]]
        suite["reached"] = [] if failed else [n for n, byte in enumerate(reached.read_bytes()) if byte]
        self.suites[suite["name"]] = suite
        self.save()

    def known(self):
        """The ctest suites that this run may use, in the order of use."""
        new = []
        every, kinds = self.options.all, self.options.kinds.split(",")
        tier = {} if every else {"DIPTYCH_TIER": "default"}
        for test in json.loads(call("ctest", "--test-dir", self.tree / "build", "--show-only=json-v1",
                                    env={**os.environ, "DIPTYCH_TESTS": ".", **tier}))["tests"]:  # one suite each
            has = {p["name"]: p["value"] for p in test["properties"]}
            kind = next((k for k in KINDS if k in has.get("LABELS", ())), None)
            if kind in kinds and "FIXTURES_REQUIRED" not in has and (every or "longer" not in has["LABELS"]):
                new.append({"name": test["name"] + "+" * every, "kind": kind, "command": test["command"], "folder": has["WORKING_DIRECTORY"],
                            "environment": dict(v.split("=", 1) for v in has.get("ENVIRONMENT", ())), "limit": has.get("TIMEOUT", 1800)})
        (self.work / "tmp").mkdir(exist_ok=True)
        self.each(self.record, [s for s in new if s["name"] not in self.suites])
        return sorted((self.suites[s["name"]] for s in new), key=lambda s: (min(KINDS.index(s["kind"]), 2), s["seconds"]))

    def each(self, work, things):
        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            list(pool.map(work, things))

    def attempt(self, edit, suites):
        by = "survived"
        for suite in suites:
            if edit.number in suite["reached"] and suite["name"] not in edit.tried:
                failed, _ = self.start(suite, 15 + 5 * suite["seconds"], DIPTYCH_MUTANT=str(edit.number), GTEST_FAIL_FAST="1")
                if failed:
                    by, edit.test = suite["kind"], f"{suite['name']} {failed[0]}"
                    break
                edit.tried.append(suite["name"])
        edit.by = by
        self.save()
        say(f"{edit.number} {edit.file}:{edit.lines[0]} {edit.operator}: {by} {edit.test or f'by {len(edit.tried)} suites'}",
            *(f"\n- {edit.old}\n+ {edit.new}" for _ in range(by == "survived")))

    def equivalent(self, edit):
        """Whether object code or modules equal the original's. WORK/alone is a clone without other edits."""
        alone, build, result = self.work / "alone", self.tree / "build", self.work / "tmp" / "result"
        if not alone.exists():
            call("git", "clone", "-q", self.tree, alone)
        if edit.file.endswith(GLSL):
            targets = [str(d.relative_to(build))[:-2] for d in build.rglob("*.spv.d") if f"/{edit.file}" in d.read_text()]
        else:
            known = re.findall(r"^(\S+): #deps.*\n((?:    .*\n)*)", call("ninja", "-C", build, "-t", "deps"), re.M)
            targets = [target for target, names in known if f"/{edit.file}\n" in names]
        targets = sorted(target for target in targets if not target.startswith("tests/"))
        for target in targets[:1 if edit.file.endswith(".cpp") else None]:
            command, compiled = call("ninja", "-C", build, "-t", "commands", "-s", target).strip().split("\n")[-1], set()
            command = command.replace(str(build / target), str(result)).replace(target, str(result))
            if edit.file.endswith(".cpp"):
                command = re.sub(r" -c \S+", f" -c {self.tree / edit.file}", command)
            command = re.sub(re.escape(str(self.tree)) + r"\b(?!/build)", str(alone), command)
            for text in (applied(edit, self.files[edit.file]), self.files[edit.file]):
                (alone / edit.file).write_text(text, encoding="utf-8")
                call("sh", "-c", command, cwd=build)
                compiled.add(result.read_bytes())
            if len(compiled) == 2:
                return False
        return bool(targets)

    def go(self):
        self.clone()
        self.draw()
        self.compile()
        suites = self.known()
        say(f"built; {len(suites)} suites are known")
        self.each(lambda edit: self.attempt(edit, suites), [e for e in self.wanted() if e.by in (None, "survived")])
        for edit in self.wanted():
            if edit.by == "survived" and self.equivalent(edit):
                edit.by = "equivalent"
        self.save()
        heads, rows = ("edits", *KINDS, "survived", "equivalent"), collections.defaultdict(collections.Counter)
        for edit in self.wanted():
            for row in (edit.file.rpartition("/")[0], "~all"):
                rows[row].update(("edits", edit.by))
        say(f"\n| folder | {' | '.join(heads)} |\n|{'---|' * (1 + len(heads))}")
        for name, row in sorted(rows.items()):
            say(f"| {name.strip('~')} | " + " | ".join(str(row[h] or "") for h in heads) + " |")
        say(f"\nleft out, as they do not compile: {sum(e.by == 'compiler' for e in self.edits)}")


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("paths", nargs="*")
    for name, default in (("number", 120), ("seed", 1), ("since", ""), ("kinds", ",".join(KINDS)), ("jobs", os.cpu_count())):
        parser.add_argument(f"--{name}", type=type(default), default=default)
    parser.add_argument("--copy", type=pathlib.Path)
    parser.add_argument("--all", action="store_true")
    options = parser.parse_args(arguments)
    options.work.mkdir(parents=True, exist_ok=True)
    Run(options.work.resolve(), options).go()


if __name__ == "__main__":
    main(sys.argv[1:])
