#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes small edits of the product, C++ and GLSL, and says which test notices each.

    mutate.py WORK [FOLDER...] [--number 120] [--seed 1] [--since REV] [--all] [--alone]

All edits stand in one build of a clone of HEAD (WORK/copy, which may be a link), each as
`DIPTYCH_MUTANT(n) ? edited : original` (mutant.h). An edit that does not compile is replaced by another. Each suite
runs once without edits, which gives its time and the edits that it reaches. It then tries these together, and each
alone if a test fails or is late: unit tests first, then probes, then the others, the quickest first. A survivor is
compiled alone; it is equivalent if object files or modules equal the original's. WORK/results.json keeps all results:
the same command resumes. With --all, tests that can wait (longer.txt) try the survivors. With --alone, the suite that
noticed an edit runs whole with it: a TEST that failed alone is listed, as no test that is cheaper notices the edit.
Not seen: an edit that another survivor masks. An edit may delete or overwrite files: run this where little can be
written.
"""
import argparse, collections, concurrent.futures, contextlib, functools, itertools, json, os, pathlib, random, re
import signal, subprocess, tempfile, threading, time

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("compare", "deferred", "forward_plus", "shaders/lib", "shaders/pass", "shared")
GLSL = (".glsl", ".vert", ".frag", ".comp")
OPEN = None, "survived"  # an edit that no suite has noticed
KINDS = {"unit": 0, "probe": 1, "image": 2, "tool": 2}  # label -> order of use
M = "\0"  # the switch, in an edit's `switched`
say = functools.partial(print, flush=True)
# Calls that pass a module to Vulkan or strip it, and their replacements that set the switch.
SETTERS = {"vkCreateShaderModule(": "diptychCreateShaderModule(",
           "Specializer(module, value, outputs)": "Specializer(diptychModule(module), value, outputs)"}
TOKEN = re.compile(r"""(?P<skip>//[^\n]*|/\*.*?\*/|\#(?:\\\n|[^\n])*|\s+)
  |(?P<string>(?:u8|[uUL])?R"(?P<d>[^(\s]*)\(.*?\)(?P=d)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+')
  |(?P<number>\.?\d(?:[eE][+-]|['\w.])*)|(?P<name>[A-Za-z_]\w*)
  |(?P<op><=>|<<=|>>=|\.\.\.|->|::|\+\+|--|&&|\|\||\^\^|[-+*/%&|^<>=!]=|<<|>>|.)""", re.X | re.S)
ASSIGN = {op + "=" for op in ("", *"+-*/%&|^", "<<", ">>")}
# Binary operators, from weakest to strongest binding; they end an operand's expression.
LEVELS = [ASSIGN, *map(set, map(str.split, ("|| ^^", "&&", "& | ^", "== !=", "< <= > >=", "<< >>", "+ -", "* / %")))]
WORDS = set("""return else do throw case default goto delete new if for while switch break continue using const auto
    static struct class public private try catch constexpr""".split())
TYPES = {"class", "struct", "namespace", "enum", "union"}
TO_SEMICOLON = set("throw static_assert assert using typedef namespace concept friend extern requires".split())
IN_BRACKETS = re.compile(r"""layout|alignas|decltype|sizeof|noexcept|CONTRACT_\w+
    |(?i:.*(error|warn|fail|refuse|problem|print).*)""", re.X)
TURNED = {"<": "> <=", "<=": "< >=", ">": "< >=", ">=": "> <=", "==": "!=", "!=": "==", "+": "-", "-": "+", "*": "/",
          "/": "*", "&&": "||", "||": "&&", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*="}
NAMES = dict(order for pair in """min/max fmin/fmax floor/ceil sin/cos any/all any_of/all_of front/back true/false
    lower_bound/upper_bound min_element/max_element lessThan/lessThanEqual greaterThan/greaterThanEqual""".split()
    for order in itertools.permutations(pair.split("/")))
# GLSL functions whose arguments may be swapped: others seldom take arguments of one type.
ALIKE = re.compile(r"[iu]?vec\d|mix|pow|atan|clamp|(smooth)?step|(cross|reflect)\w*")
NEXT = str.maketrans("xyzwrgba", "yxyzgrgb")  # components


class Source:
    """A file's tokens: text, kind, span, matching (or own) and enclosing bracket. `dead`: what no edit may touch."""

    def __init__(self, path, text, enums, rng):
        self.path, self.text, self.enums, self.rng, self.glsl = path, text, enums, rng, path.endswith(GLSL)
        found = [m for m in TOKEN.finditer(text) if m.lastgroup != "skip"]
        self.at, self.kind = [m[0] for m in found] + ["", ""], [m.lastgroup for m in found] + ["", ""]
        self.spans, self.space = [m.span() for m in found], [text[m.start() - 1].isspace() for m in found]
        self.line = [text.count("\n", 0, m.start()) + 1 for m in found]
        self.match, self.inside, self.dead, stack, angles = [*range(len(self.at))], [], set(), [-1], []
        for i, t in enumerate(self.at):
            if t in (")", "]", "}") and stack[1:]:
                self.match[i] = stack.pop()
                self.match[self.match[i]] = i
            self.inside.append(stack[-1])
            if t in ("(", "[", "{"):
                stack.append(i)
        for i, t in enumerate(self.at[:-2]):
            start = end = i
            if t == "<" and (self.at[i - 1] == "template" or not self.space[i] and self.kind[i - 1] == "name"):
                angles.append(i)
            elif t in (">", ">>") and angles and not self.space[i]:
                start, angles = angles[-len(t):][0], angles[:-len(t)]
            elif t in TO_SEMICOLON or t in ("case", "enum"):
                while self.at[end] not in (":" if t == "case" else ";", "{", "}", ""):
                    end = max(end, self.match[end]) + 1
                end = self.match[end] if t == "enum" else end
            elif t == "operator" or self.at[i + 1] == "(" and IN_BRACKETS.fullmatch(t):
                end = self.match[i + 1]
            self.dead.update(range(start, end + (end > start)))

    def span(self, first, last):
        return self.spans[first][0], self.spans[last][1]

    def group(self, i):
        """Whether braces are part of an expression, as in Point{1, 2}."""
        return self.at[i] == "{" and (not self.space[i] or self.at[i - 1] in ("=", "return", ",", "("))

    def ends(self, i, stops):
        """Whether an expression ends here. clang-format puts spaces on both sides of binary operators only."""
        t = self.at[i]
        return t in (",", ";", "?", ":", "(", "[", "{", "}", ")", "]", "") or t in WORDS or t in stops and (
            i not in self.dead and (t in ASSIGN or self.space[i] and self.text[self.spans[i][1]].isspace()))

    def region(self, i, stops=frozenset().union(*LEVELS)):
        """First and last token of the expression around token i, ended by `stops`; None if it has a body."""
        first = last = i
        while (not self.ends(first - 1, stops) or self.at[first - 1] == "]" or self.group(self.match[first - 1])
               or self.at[first - 1] == ")" and self.kind[first] == "op"):
            first = self.match[first - 1]
        while not self.ends(last + 1, stops) or self.at[last + 1] in ("(", "[") or self.group(last + 1):
            last = self.match[last + 1]
        lambdas = any(self.at[k] == "{" and not self.group(k) or self.at[k] == "[" and self.kind[k - 1] != "name"
                      and self.at[k - 1] not in (")", "]") for k in range(first, last + 2))
        return None if lambdas else (first, last)

    @functools.cache
    def head(self, brace):
        """The tokens of the statement before a brace, within the same brackets."""
        i = brace
        while self.at[i - 1] not in ("", *";{([") and (self.at[i - 1] != "}" or self.group(self.match[i - 1])):
            i = self.match[i - 1]
        return self.at[i:brace]

    def body(self, i):
        """The head of the function whose body has token i; None outside functions and in lambdas."""
        brace = self.inside[i]
        words = self.head(brace)
        if (self.at[brace] != "{" or self.group(brace) or "[" in words
                or words[-1:] not in ([")"], ["const"]) and TYPES & set(words)):
            return None
        function = "(" in words and words[0] not in WORDS - {"const", "static", "auto", "constexpr"}
        return words if function else self.body(brace)

    def declares(self, first, last):
        """Whether a type stands before a name."""
        types = (k for k in range(first, last) if self.kind[k + 1] == "name")
        return any(self.kind[k] == "name" or self.at[k] in (">", "&", "*", "&&") and not self.space[k] for k in types)

    def number(self, text):
        """The number off by one, or by 1 %."""
        if whole := re.fullmatch(r"(0x[\da-f]+|\d+)([ulz]*)", text, re.I):
            value = int(whole[1], 16 if "x" in whole[1].lower() else 10)
            return f"{value + (self.rng.choice((1, -1)) if value else 1)}{whole[2]}"
        part = re.fullmatch(r"(\d*\.?\d*(?:e[+-]?\d+)?)(f?)", text, re.I)
        new = part and f"{float(part[1]) * self.rng.choice((1.01, 0.99)) or 0.01:.9g}"
        return new and new + ".0" * new.isdigit() + part[2]

    def of_token(self, i):
        """Yields the operator's name, the token's replacement, and the region to switch."""
        t, before = self.at[i], self.at[i - 1]
        if t in TURNED and self.ends(i, {t}):
            region = self.region(i, set().union(*itertools.takewhile(lambda level: t not in level, LEVELS)))
            if region and not (t in ("+", "+=") and "string" in self.kind[region[0]:region[1] + 1]):
                yield "operator", self.rng.choice(TURNED[t].split()), region
        pure = before == "=" and self.at[i - 2] in (")", "const", "override", "noexcept")
        if t in ("true", "false") or self.kind[i] == "number" and not pure:
            yield "constant", NAMES.get(t) or self.number(t.replace("'", "")), (i, i)
        after = next(k for k in itertools.count(i + 1) if k not in self.dead)
        if t in NAMES and self.at[after] == "(" and (self.kind[i - 1] != "name" or before in WORDS):
            yield "function", NAMES[t], self.region(i)
        if before == "." and self.at[i + 1] != "(" and re.fullmatch("[xyzw]{1,4}|[rgba]{1,4}", t):
            yield "swizzle", t.translate(NEXT), self.region(i)
        values = self.enums.get(self.at[i - 2], []) if before == "::" else []
        if near := [v for k, v in enumerate(values) if t in values[k - 1:k] + values[k + 1:k + 2]]:
            yield "enumerator", self.rng.choice(near), self.region(i)

    def of_call(self, i):
        """Swaps two adjacent arguments, or drops the last one."""
        name, close, text = self.at[i], self.match[i + 1], self.text
        commas = [k for k in range(i, close) if self.at[k] == "," and self.inside[k] == i + 1 and k not in self.dead]
        if (not commas or self.kind[i] != "name" or self.at[i + 1] != "(" or name in {*WORDS, *NAMES, "dot"}
                or self.glsl and not ALIKE.fullmatch(name) or name.isupper() or not (self.body(i) and self.region(i))
                or self.declares(i + 2, close - 1) or self.at[i - 1] not in WORDS and self.declares(i - 1, i)):
            return
        (start, end), at, cuts = self.span(*self.region(i)), self.rng.randrange(len(commas)), [i + 1, *commas, close]
        (a, b), (c, d) = (self.span(cuts[k] + 1, cuts[k + 1] - 1) for k in (at, at + 1))
        drops = at + 1 == len(commas) and not self.glsl and self.rng.random() < 0.3
        new = text[a:b] if drops else text[c:d] + text[b:c] + text[a:b]
        yield "argument", start, end, text[start:a] + new + text[d:end]

    def of_statement(self, i):
        """Drops a statement, or returns before it."""
        t, before, words, last = self.at[i], self.at[i - 1], self.body(i), i
        begins = before in (";", "{", "}")
        control = before == "else" or before == ")" and self.at[self.match[i - 1] - 1] in ("if", "for", "while")
        if words is None or not (begins or control) or self.kind[i] != "name" and t not in ("++", "--"):
            return
        while self.at[last] not in (";", "}", ")", "]", "") and (self.at[last] != "{" or self.group(last)):
            last = max(last, self.match[last]) + 1
        effects = (k for k in range(i, last) if self.at[k] in ASSIGN | {"(", "++", "--"})
        does = next((k for k in effects if self.inside[k] == self.inside[i]), 0)
        (start, end), at = self.span(i, last), words.index("(")
        if t not in WORDS and self.at[last] == ";" and does and not self.declares(i, does):
            yield "dropped", start, end, ";", f"{{ if (!{M}) {self.text[start:end]} }}"
        none = at == 1 or {"void", "explicit", "~", words[at - 1]} & {*words[:at - 1]}  # constructors are named twice
        what = "return; " if none else f"return {words[at - 2]}(0); " if self.glsl else "return {}; "
        known = words[at - 2].islower() if self.glsl else not {"auto", "&"} & {*words[:at]}
        if begins and known and t not in ("case", "default", "else") and self.rng.random() < 0.25:
            yield "early return", start, start, what, f"if ({M}) {what}"

    def edits(self, i):
        """Edits at a token: operator, first position, end, replacement, how it is switched if it is no expression."""
        text, close = self.text, self.match[i + 1]
        for name, new, region in self.of_token(i):
            if region and new and not (self.glsl and self.at[region[1] + 1] in ASSIGN):
                (start, end), (a, b) = self.span(*region), self.spans[i]
                yield name, start, end, text[start:a] + new + text[b:end]
        yield from self.of_call(i)
        yield from self.of_statement(i)
        if self.at[i] == "if" and close > i + 2 and not any(
                self.at[k] in ASSIGN | {";"} and self.inside[k] == i + 1 for k in range(i + 2, close)):
            start, end = self.span(i + 2, close - 1)
            yield "condition", start, end, f"!({text[start:end]})", f"({M} != bool({text[start:end]}))"

    def constness(self, i):
        """Replacements of `constexpr` around token i: a switched value is computed at run time."""
        outer, head, changes = self.inside[i], self.head(i), []
        for k in range(i - len(head), i):
            if self.at[k] == ("const" if self.glsl and outer < 0 else "constexpr") and self.at[k - 1] != "if":
                function = not self.group(i) and "=" not in head
                member = outer >= 0 and TYPES - {"namespace"} & set(self.head(outer))
                new = "inline" if function else "inline const" if member else "const"
                changes.append((*self.spans[k], "" if self.glsl else new))
        return changes + (self.constness(outer) if outer >= 0 else [])

    def edit(self, i, operator, start, end, new, how=None):
        old, lines = self.text[start:end], [self.text.count("\n", 0, at) + 1 for at in (start, end)]
        how = how or f"({M} ? ({' '.join(new.split())}) : ({old}))"
        return argparse.Namespace(file=self.path, operator=operator, start=start, end=end, old=old, new=new,
                                  switched=how, const=self.constness(i), lines=lines, by=None, test=None)


def draw(files, count, seed, changed=None):
    """Draws edits from each folder in turn: a random edit of a random line. No two overlap."""
    rng, folders, edits = random.Random(seed), collections.defaultdict(list), []
    enums = {name: re.findall(r"(?:^|,)\s*(\w+)", values) for name, values in re.findall(
        r"\benum (?:class )?(\w+)[^{;()]*\{([^{}]*)\}", re.sub(r"//[^\n]*", "", "\n".join(files.values())))}
    for path, text in sorted(files.items()):
        source, lines = Source(path, text, enums, rng), folders[path.rpartition("/")[0]]
        for line, tokens in itertools.groupby(range(len(source.line)), lambda i: source.line[i]):
            if changed is None or line in changed.get(path, ()):
                found = [(i, *what) for i in tokens if i not in source.dead for what in source.edits(i)
                         if what[3] != (old := text[what[1]:what[2]]) and not re.search("//|/[*]", old)]
                lines += [(source, found)] if found else []
    folders = [lines for _, lines in sorted(folders.items())]
    rng.shuffle(folders)
    while len(edits) < count and any(folders):
        for lines in filter(None, folders):
            source, found = lines.pop(rng.randrange(len(lines)))
            new = source.edit(*rng.choice(found))
            if all(e.file != new.file or e.start > new.end or new.start > e.end for e in edits):
                edits.append(new)
                new.number = len(edits)
    return edits[:count]


def switched(text, edits):
    """The file's text with all its edits, each behind its switch, and with what sets the switch."""
    changes = {(e.start, e.end): e.switched.replace(M, f"DIPTYCH_MUTANT({e.number}u)") for e in edits}
    changes.update({(start, end): new for e in edits for start, end, new in e.const})
    # The include stands below extensions and unconditional includes.
    at = re.match(r"((//.*|#(ifndef|define) \w+_GLSL|#(version|extension|include) .*)?\n)*", text).end()
    changes[at, at] = '#include "tests/mutation/mutant.h"\n'
    for (start, end), new in sorted(changes.items(), reverse=True):
        text = text[:start] + new + text[end:]
    for old, new in SETTERS.items():
        text = re.sub(r"\b" + re.escape(old), new, text)  # not __wrap_..., which the linker knows
    return text


def blamed(said, edits, tree):
    """The edits on lines named by compiler errors, or by the notes of an error that names none."""
    places = {(e.file, line + 1): e.number for e in edits for line in range(e.lines[0], e.lines[1] + 1)}
    bad, unexplained = set(), False
    for path, line, text in re.findall(r"^(?:ERROR: )?([^\s:]+):(\d+):(.*)$", said, re.M):
        file, error = os.path.relpath(tree / "build" / path, tree), "error: " in text or "' : " in text
        below = range(int(line), int(line) + (12 if "declared here" in text else 1))  # in the function declared there
        edit = next((places[file, at] for at in below if (file, at) in places), None)
        if edit is None and "declared 'constexpr'" in text:  # behind the edit, in the declaration that it made const
            edit = max(((e.start, e.number) for e in edits
                        if e.file == file and e.const and e.lines[1] < int(line)), default=(0, None))[1]
        if error or "expansion of" in text or "note: " in text and unexplained:  # an error's context stands above it
            bad.add(edit)
        if edit or "note: " not in text:
            unexplained = error and edit is None and "compilation terminated" not in text
    return bad - {None}


def call(*command, may_fail=False, **options):
    done = subprocess.run([*map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", **options)
    if done.returncode and not may_fail:
        raise SystemExit(f"{' '.join(done.args)}: {done.stdout.strip()[-3000:]}")
    return done if may_fail else done.stdout


def filtered(suite, names):
    return {**suite, "command": [*suite["command"][:2], names, *suite["command"][3:]]}


class Run:
    def __init__(self, work, options):
        self.tier = "all" if options.all else "default"
        self.options, self.tmp, self.alone, self.file = options, work / "tmp", work / "alone", work / "results.json"
        self.tree = (work / "copy").resolve()
        self.build, self.lock = self.tree / "build", threading.Lock()
        self.pool = concurrent.futures.ThreadPoolExecutor(options.jobs)
        self.tmp.mkdir(parents=True, exist_ok=True)
        saved = json.loads(self.file.read_text(encoding="utf-8")) if self.file.exists() else {}
        self.plan, self.suites = saved.get("plan"), saved.get("suites", {})
        self.edits = [argparse.Namespace(**e) for e in saved.get("edits", [])]

    def save(self):
        with self.lock:
            state = {"plan": self.plan, "suites": {**self.suites}, "edits": [vars(e) for e in self.edits]}
            self.file.with_suffix(".new").write_text(json.dumps(state, indent=1), encoding="utf-8")
            self.file.with_suffix(".new").replace(self.file)

    def git(self, *arguments):
        return call("git", "-C", self.tree, *arguments)

    def standing(self):
        return [e for e in self.edits if e.by != "compiler"]

    def clone(self):
        if not self.tree.exists():
            call("git", "clone", "-q", ROOT, self.tree)
        mark = self.tree / ".git" / "mutants"  # this program may overwrite a clone with this mark
        if not mark.exists() and self.git("status", "--porcelain", "-uno"):
            raise SystemExit(f"{self.tree} has changes that are not committed: give a clone without any")
        mark.touch()
        if not (self.build / "build.ninja").exists():
            call("cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release")

    def draw(self):
        """Draws the edits of the clone's sources, if none are known."""
        o = self.options
        plan = {"number": o.number, "seed": o.seed, "paths": o.paths, "since": o.since,
                "commit": self.git("rev-parse", "HEAD").strip()}
        if self.plan not in (None, plan):
            raise SystemExit(f"{self.file}: it is of another run, {self.plan}: the same arguments and commit, "
                             "or another folder")
        if self.plan is None:
            names = self.git("ls-files", *(o.paths or FOLDERS)).split()
            files = {name: self.git("show", f"HEAD:{name}") for name in names
                     if name.endswith((".cpp", ".h", *GLSL)) and "/example/" not in name}
            changed = {}
            for part in self.git("diff", "-U0", "--no-prefix", o.since or "HEAD", "HEAD").split("\n+++ ")[1:]:
                hunks = re.findall(r"^@@ \S+ \+(\d+)(?:,(\d+))? @@", part, re.M)
                changed[part.split("\n")[0]] = {int(at) + k for at, lines in hunks for k in range(int(lines or 1))}
            count = int(o.number * 1.4) + 1  # some do not compile
            self.plan, self.edits = plan, draw(files, count, o.seed, changed if o.since else None)
            self.save()

    def compile(self):
        """Builds what the compiler accepts. Writes only files that change, so that builds are incremental."""
        targets = [f"{kind}_tests" for kind in KINDS]
        calls = self.git("grep", "-lF", *(f"-e{old}" for old in SETTERS), "HEAD", "--", "*.cpp").replace("HEAD:", "")
        while True:
            edited = {*calls.split(), *(e.file for e in self.standing())}
            for name in edited | {*self.git("diff", "--name-only").split()}:
                text, edits = self.git("show", f"HEAD:{name}"), [e for e in self.standing() if e.file == name]
                text = switched(text, edits) if name in edited else text
                if (self.tree / name).read_text(encoding="utf-8") != text:
                    (self.tree / name).write_text(text, encoding="utf-8")
            done = call("ninja", "-C", self.build, f"-j{self.options.jobs}", "-k", "0", *targets, may_fail=True)
            if done.returncode == 0:
                return
            bad = blamed(done.stdout, self.standing(), self.tree)
            if not bad:
                raise SystemExit("the copy does not build, and no error names an edit:\n" + done.stdout[-4000:])
            for edit in self.edits:
                edit.by = "compiler" if edit.number in bad else edit.by
            say(f"left out, as they do not compile: {' '.join(map(str, sorted(bad)))}")
            self.save()

    def start(self, suite, edits, **environment):
        """Runs a suite with these edits; returns the tests that failed."""
        code, folder = "late", tempfile.TemporaryDirectory(dir=self.tmp, ignore_cleanup_errors=True)
        chosen = ",".join(str(e.number) for e in edits)
        environment.update(suite["environment"], DIPTYCH_MUTANT=chosen, DIPTYCH_TIER=self.tier, TMPDIR=folder.name)
        with folder, open(folder.name + "/said", "w") as said:
            process = subprocess.Popen(  # a mutant may request all memory or disk
                ["prlimit", "--data=8192000000", "--fsize=4096000000", *suite["command"]], stdout=said, stderr=said,
                cwd=suite["folder"], env={**os.environ, **environment}, start_new_session=True)
            with contextlib.suppress(subprocess.TimeoutExpired):
                code = process.wait(15 + 5 * suite["seconds"])
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            text = pathlib.Path(said.name).read_text(encoding="utf-8", errors="replace")
        failed = (re.findall(r"^\[  FAILED  \] ([\w/]+\.[\w/]+)", text, re.M)
                  or re.findall(r"^\[ RUN      \] (\S+)$", text, re.M)[-1:] or [f"({code})"])
        return [] if code == 0 else sorted(set(failed))

    def record(self, suite):
        """Records the edits that a suite reaches without any edit, and its time. Skips suites that fail."""
        reached, every = self.tmp / f"{suite['name']}.reached", suite["command"][2]
        for _ in range(3):
            reached.write_bytes(bytes(1 << 16))
            begun = time.monotonic()
            if not (failed := self.start(suite, [], DIPTYCH_REACHED=reached)):
                break
            say(f"fails without an edit and is left out: {suite['name']} {' '.join(failed)}")
            every += ":-"["-" not in every] + ":".join(failed)
            suite = filtered(suite, every)
        suite["seconds"] = time.monotonic() - begun
        suite["reached"] = [] if failed else [n for n, byte in enumerate(reached.read_bytes()) if byte]
        self.suites[suite["name"]] = suite
        self.save()

    def known(self):
        """The ctest suites that this run may use, in the order of use."""
        new, environment = [], {"DIPTYCH_TESTS": ".", "DIPTYCH_TIER": self.tier}
        listed = call("ctest", "--test-dir", self.build, "--show-only=json-v1", env={**os.environ, **environment})
        for test in json.loads(listed)["tests"]:
            has = {p["name"]: p["value"] for p in test["properties"]}
            kind = next((k for k in KINDS if k in has.get("LABELS", ())), None)
            if kind and test["command"][0].endswith("group.sh"):
                new.append({"name": test["name"] + "+" * self.options.all, "kind": kind, "passed": None,
                            "command": test["command"], "folder": has["WORKING_DIRECTORY"],
                            "seconds": has.get("TIMEOUT", 1800) / 5,
                            "environment": dict(v.split("=", 1) for v in has.get("ENVIRONMENT", ()))})
        list(self.pool.map(self.record, [s for s in new if s["name"] not in self.suites]))
        return sorted((self.suites[s["name"]] for s in new), key=lambda s: (KINDS[s["kind"]], s["seconds"]))

    def attempt(self, suite, edits):
        """Tries the edits that a suite reaches, together. If it fails: each alone; if none fails alone: halves."""
        groups = [[e for e in edits if e.by in OPEN and e.number in suite["reached"]]]
        while groups and suite["passed"] != [e.number for e in groups[0]]:
            group = [e for e in groups.pop() if e.by in OPEN]
            if not group or not (failed := self.start(suite, group)):
                continue
            names = ":".join(f for f in failed[:3] if "." in f)
            few = filtered(suite, names) if names and not self.start(filtered(suite, names), []) else suite
            for edit in group:
                if edit.by in OPEN and (alone := failed if len(group) == 1 else self.start(few, [edit])):
                    edit.by, edit.test = suite["kind"], f"{suite['name']} {alone[0]}"
                    say(f"{edit.number} {edit.file}:{edit.lines[0]} {edit.operator}: {edit.test}")
                    self.save()
            left = [e for e in group if e.by in OPEN]
            groups += [left] if len(left) < len(group) else [left[::2], left[1::2]]
        suite["passed"] = [e.number for e in edits if e.by in OPEN and e.number in suite["reached"]]
        self.save()

    def alone_in_suite(self, edit):
        """The only TEST of the suite that notices the edit; None if several do."""
        failed = self.start(self.suites[edit.test.partition(" ")[0]], [edit])
        return failed[0] if len(failed) == 1 else None

    def equivalent(self, edit):
        """Whether object code and modules equal the original's. WORK/alone is a clone without other edits."""
        if not self.alone.exists():
            call("git", "clone", "-q", self.tree, self.alone)
        result, text = self.tmp / "result", self.git("show", f"HEAD:{edit.file}")
        users = re.findall(r"^(\S+): #deps.*\n((?:    .*\n)*)", call("ninja", "-C", self.build, "-t", "deps"), re.M)
        users += [(str(d.relative_to(self.build))[:-2], d.read_text()) for d in self.build.rglob("*.spv.d")]
        targets = sorted(t for t, names in users if f"/{edit.file}" in names and not t.startswith("tests/"))
        for target in targets:
            command = call("ninja", "-C", self.build, "-t", "commands", "-s", target).strip().split("\n")[-1]
            command = command.replace(str(self.build / target), str(result)).replace(target, str(result))
            command = command.replace(" -Werror ", " ")  # alone, an edit may leave an empty body
            if edit.file.endswith(".cpp"):
                command = re.sub(r" -c \S+", f" -c {self.tree / edit.file}", command)
            command = re.sub(rf"{re.escape(str(self.tree))}\b(?!/build)", str(self.alone), command)
            compiled = set()
            for version in (text[:edit.start] + edit.new + text[edit.end:], text):
                (self.alone / edit.file).write_text(version, encoding="utf-8")
                call("sh", "-c", command, cwd=self.build)
                compiled.add(result.read_bytes())
            if len(compiled) == 2:
                return False
        return bool(targets)

    def go(self):
        self.clone()
        self.draw()
        self.compile()
        suites, wanted = self.known(), self.standing()[:self.plan["number"]]
        say(f"built; {len(suites)} suites are known")
        for _ in range(2):  # the second time without edits that others noticed, which may mask
            list(self.pool.map(lambda suite: self.attempt(suite, wanted), suites))
        heads, rows = ("edits", *KINDS, "survived", "equivalent"), collections.defaultdict(collections.Counter)
        for edit in wanted:
            if edit.by in OPEN:
                edit.by = "equivalent" if self.equivalent(edit) else "survived"
                say(f"{edit.number} {edit.file}:{edit.lines[0]} {edit.by}\n- {edit.old}\n+ {edit.new}")
            for row in (edit.file.rpartition("/")[0], "~all"):
                rows[row].update(("edits", edit.by))
        self.save()
        say(f"\n| folder | {' | '.join(heads)} |\n|{'---|' * (1 + len(heads))}")
        for name, row in sorted(rows.items()):
            say(f"| {name.strip('~')} | " + " | ".join(str(row[h] or "") for h in heads) + " |")
        say(f"\nleft out, as they do not compile: {len(self.edits) - len(self.standing())}")
        if self.options.alone:
            noticed = [e for e in wanted if e.by in KINDS]
            names = collections.Counter(filter(None, self.pool.map(self.alone_in_suite, noticed)))
            say("\nedits that a TEST noticed alone:")
            for name, count in sorted(names.items()):
                say(f"{count} {name}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("paths", nargs="*")
    for name, default in dict(number=120, seed=1, since="", jobs=os.cpu_count()).items():
        parser.add_argument(f"--{name}", type=type(default), default=default)
    for name in ("--all", "--alone"):
        parser.add_argument(name, action="store_true")
    asked = parser.parse_args()
    Run(asked.work.resolve(), asked).go()
