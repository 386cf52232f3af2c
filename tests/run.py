#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""run.py BUILD [all | NAME] [ctest's options]: what ./diptych test runs, by ctest, in a build folder that is up to date.

Without a word: the default tier, all but what tests/longer.txt and the label `longer` name. NAME: every suite and TEST
that has it in its name. Before ctest's closing lines stands a line a kind: TESTs, seconds, what was skipped and why.
Exit code: ctest's."""
import collections
import os
import pathlib
import re
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as xml


def command(build, words):
    """ctest's words, and what the environment tells suites.cmake."""
    call = ["ctest", "--test-dir", build, "--output-on-failure", "--no-tests=error", "--no-label-summary",
            "-j", str(len(os.sched_getaffinity(0)) + 1)]  # tests of windows and pages wait
    chosen = {"DIPTYCH_TIER": "all", "DIPTYCH_TESTS": ""}
    if words and words[0] == "all":
        words = words[1:]
    elif words and not words[0].startswith("-"):
        chosen["DIPTYCH_TESTS"] = words[0]
        call += ["-R", re.escape(words[0])]
        words = words[1:]
    else:
        chosen["DIPTYCH_TIER"] = "default"
        call += ["-LE", "^longer$"]
    return call + words, chosen


def kinds(results, since, other):
    """A line a kind, from the JUnit files that are newer than `since`; other: kind -> seconds of other tests."""
    tests, seconds, skipped = collections.Counter(), collections.Counter(), {}
    for file in results.glob("*.xml"):
        if file.stat().st_mtime < since:
            continue
        kind = file.name.split(".")[0]
        for case in xml.parse(file).iter("testcase"):
            tests[kind] += 1
            seconds[kind] += float(case.get("time", 0))
            for reason in case.iter("skipped"):
                why = (reason.get("message") or "").splitlines()[-1:] or ["no reason given"]
                skipped.setdefault(kind, collections.Counter())[why[0]] += 1
    for kind, each in other.items():
        if kind not in tests:
            tests[kind], seconds[kind] = len(each), sum(each)
    lines = []
    for kind in sorted(tests):
        lines.append(f"{kind:9}{tests[kind]:5} tests{seconds[kind]:7.0f} s")
        lines += [f"    {count} skipped: {why}" for why, count in skipped.get(kind, {}).items()]
    return lines


def main():
    build = sys.argv[1]
    call, chosen = command(build, sys.argv[2:])
    since = time.time() - 1  # file timestamps are coarser
    other = {}
    ctest = subprocess.Popen(call, stdout=subprocess.PIPE, text=True, errors="replace", env={**os.environ, **chosen})
    for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGINT):
        signal.signal(number, lambda received, _: ctest.send_signal(received))
    for line in ctest.stdout:
        ended = re.search(r"Test +#\d+: (\S+) .* ([\d.]+) sec$", line)
        if ended:
            other.setdefault(ended[1].split(".")[0], []).append(float(ended[2]))
        if re.match(r"\d+% tests passed", line):
            print(*kinds(pathlib.Path(build) / "tests/results", since, other), "", sep="\n")
        print(line, end="", flush=True)
    return ctest.wait()


if __name__ == "__main__":
    sys.exit(main())
