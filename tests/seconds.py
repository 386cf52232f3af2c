#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""seconds.py BUILD: the tables of tests/README.md, from what the last ctest left in a build folder.

Seconds by label, from ctest's own costs (Testing/Temporary/CTestCostData.txt) and labels (ctest --show-only), and the
ten slowest suites and TESTs, these from the JUnit files of tests/results."""
import json
import pathlib
import subprocess
import sys
import xml.etree.ElementTree as xml


def main():
    build = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build")
    shown = subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], check=True, capture_output=True)
    labels = {}
    for test in json.loads(shown.stdout)["tests"]:
        values = [p["value"] for p in test.get("properties", []) if p["name"] == "LABELS"]
        labels[test["name"]] = values[0] if values else ["-"]
    seconds = {}
    for line in (build / "Testing/Temporary/CTestCostData.txt").read_text().splitlines():
        words = line.split()
        if line == "---":
            break
        if len(words) == 3 and words[0] in labels:
            seconds[words[0]] = float(words[2])

    kinds = ("unit", "probe", "image", "tool", "fuzz")
    print("| label | suites | seconds |\n|---|---|---|")
    for kind in kinds:
        of_kind = [seconds.get(name, 0) for name, its in labels.items() if kind in its]
        print(f"| {kind} | {len(of_kind)} | {sum(of_kind):.0f} |")
    print("\n| slowest suite | seconds |\n|---|---|")
    for name in sorted(seconds, key=seconds.get, reverse=True)[:10]:
        print(f"| {name} | {seconds[name]:.0f} |")

    tests = []
    for file in (build / "tests/results").glob("*.xml"):
        for case in xml.parse(file).iter("testcase"):
            tests.append((float(case.get("time", 0)), f"{case.get('classname')}.{case.get('name')}"))
    print("\n| slowest TEST | seconds |\n|---|---|")
    for time, name in sorted(tests, reverse=True)[:10]:
        print(f"| {name} | {time:.0f} |")


if __name__ == "__main__":
    main()
