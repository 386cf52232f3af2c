#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""CPU seconds of a clean build, by folder and library and by kind of command, and what is embedded.

    build_cost.py [TARGET...] [--source DIR] [--jobs N]     TARGET: diptych, all, or any other (diptych)

Builds into a temporary folder. CMake prefixes each command with this script, which takes the time of that command
alone: the load of the machine matters less than for the clock.
"""
import argparse, collections, os, pathlib, re, sys, tempfile, time

ROOT = pathlib.Path(__file__).resolve().parents[2]
KINDS = "glslang", "exact_spirv", "spirv-opt", "C++", "link", "other"
TOOLS = {"glslangValidator": "glslang", "exact_spirv": "exact_spirv", "spirv-opt": "spirv-opt", "ar": "link",
         "ranlib": "link"}


def run(command, **options):
    """Its CPU seconds, children included. Exits if it fails."""
    child = os.posix_spawnp(command[0], command, os.environ, **options)
    _, status, usage = os.wait4(child, 0)
    if status:
        sys.exit(os.waitstatus_to_exitcode(status) if os.WIFEXITED(status) else 1)
    return usage.ru_utime + usage.ru_stime


def kind_of(command):
    tool = os.path.basename(command[0])
    if tool.endswith("++") or "g++" in tool or "clang" in tool:
        return "C++" if "-c" in command else "link"
    return TOOLS.get(tool, "other")


def place_of(command, build):
    """Folder of a module, library or program of an object, in the build folder; else where the command runs."""
    words = " ".join(command[command.index("-o") if "-c" in command else 0:])  # without precompiled headers
    found = re.search(r"(\S+)/[^/\s]+\.spv\b", words) or re.search(r"(\S*CMakeFiles/[\w+-]+)\.dir/", words)
    place = os.path.relpath(os.path.join(os.getcwd(), found[1] if found else ""), build)
    return re.sub(r"CMakeFiles/(diptych_)?", "", place)


def launched(log, build, command):
    """One command of the build: runs it and adds a line to the log."""
    seconds = run(command)
    module = re.search(r"([^/\s]+)\.spv\b", " ".join(command))
    line = "\t".join([str(seconds), kind_of(command), place_of(command, build), module[1] if module else ""])
    with open(log, "a", encoding="utf-8") as out:
        out.write(line + "\n")


def report(build, rows):
    kinds = [kind for kind in KINDS if any(kind == row[1] for row in rows)]
    cells, modules = collections.Counter(), collections.Counter()
    for seconds, kind, place, module in rows:
        for key in (place, kind), (place, "all"), ("all", kind), ("all", "all"):
            cells[key] += float(seconds)
        if kind in KINDS[:3]:
            modules[module] += float(seconds)
    print("| CPU s |", " | ".join([*kinds, "all"]), "|\n|---|" + "--:|" * (len(kinds) + 1))
    for place in sorted({row[2] for row in rows}, key=lambda place: -cells[place, "all"]) + ["all"]:
        print(f"| {place} |", " | ".join(f"{cells[place, kind]:.1f}" if cells[place, kind] else ""
                                         for kind in [*kinds, "all"]), "|")
    if modules:
        name, seconds = modules.most_common(1)[0]
        print(f"\nslowest module: {name}, {seconds:.1f} s")
    if (build / "compare/diptych").exists():
        print(f"program: {(build / 'compare/diptych').stat().st_size:,} bytes")
        sizes = {path.stem: path.stat().st_size for folder in ("shaders", "compare/probe")
                 for path in (build / folder).glob("*.spv")}
        largest = max(sizes, key=sizes.get)
        print(f"SPIR-V in it: {sum(sizes.values()):,} bytes in {len(sizes)} modules; "
              f"largest: {largest}, {sizes[largest]:,} bytes")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("targets", nargs="*", default=["diptych"])
    parser.add_argument("--source", type=pathlib.Path, default=ROOT)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        build, log, launch = (pathlib.Path(folder).resolve() / name for name in ("build", "log", "launch.cmake"))
        log.write_text("")
        launcher = f"{sys.executable} {__file__} --launched {log} {build}"
        launch.write_text("".join(f'set_property(GLOBAL PROPERTY RULE_LAUNCH_{rule} "{launcher}")\n'
                                  for rule in ("COMPILE", "LINK", "CUSTOM")))
        quiet = [(os.POSIX_SPAWN_DUP2, 2, 1)]  # stdout has the table alone
        began = time.monotonic()
        configured = run(["cmake", "-S", str(given.source), "-B", str(build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                          f"-DCMAKE_PROJECT_INCLUDE={launch}"], file_actions=quiet)
        run(["cmake", "--build", str(build), "-j", str(given.jobs), "--target", *given.targets], file_actions=quiet)
        rows = [line.split("\t") for line in log.read_text().splitlines()]
        report(build, [*rows, (configured, "other", "configuring", "")])
        print(f"clock: {time.monotonic() - began:.0f} s with {given.jobs} jobs")


if sys.argv[1:2] == ["--launched"]:
    launched(sys.argv[2], sys.argv[3], sys.argv[4:])
else:
    main()
