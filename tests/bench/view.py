#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How quick the window is, on a screen in memory (Xvfb) with real key events (xdotool).

    tests/bench/view.py [PROGRAM]        build/compare/diptych

Prints medians with the least and the greatest of several starts:
  - from the start of the program to the first picture, and to the first whole one, of builtin:gallery
  - from a key that goes down to the picture that shows it, at 640x360 while the view moves
  - the interface's own frames: median, 99th percentile and longest, while pictures take about 5 s each
"""
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time

PROGRAM = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else "build/compare/diptych")
STARTS = 5


class Display:
    """A screen in memory that lives as long as this object."""

    def __init__(self):
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x760x24", "-nolisten", "tcp"],
                                       pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        os.environ["DISPLAY"] = ":" + os.read(read, 16).decode().strip()

    def close(self):
        self.server.terminate()
        self.server.wait()


def events(words):
    subprocess.run(["xdotool"] + words.split(), check=True, stdout=subprocess.DEVNULL)


class View:
    """The window, and what it has said (-v)."""

    def __init__(self, words):
        self.said = tempfile.NamedTemporaryFile("r")
        self.process = subprocess.Popen([PROGRAM, "view", "-v"] + words, stderr=open(self.said.name, "w"))

    def lines(self, pattern):
        with open(self.said.name) as said:
            return [float(found) for found in re.findall(pattern, said.read())]

    def wait(self, pattern, count=1, seconds=120):
        end = time.time() + seconds
        while len(self.lines(pattern)) < count:
            if time.time() > end or self.process.poll() is not None:
                sys.exit(f"view.py: nothing matched {pattern} within {seconds} s: {open(self.said.name).read()}")
            time.sleep(0.02)

    def close(self):
        events("key ctrl+q")
        self.process.wait(60)


def show(what, values, unit):
    print(f"{what:<64} {statistics.median(values):8.2f} {unit}  ({min(values):.2f} to {max(values):.2f}, {len(values)} times)")


def starts():
    first, whole = [], []
    for _ in range(STARTS):
        view = View(["builtin:gallery"])
        view.wait(r"first whole picture after ([\d.]+) s")
        first += view.lines(r"first picture after ([\d.]+) s")
        whole += view.lines(r"first whole picture after ([\d.]+) s")
        view.close()
    show("start to the first picture, gallery", first, "s")
    show("start to the first whole picture, 810x706", whole, "s")


def keys():
    # Only keys pressed while the view already moves: the key before them is held down.
    shown = r"key [WASD]: seen after (\d+) ms"
    view = View(["builtin:gallery", "--size", "640x360"])
    view.wait(r"first whole picture after ([\d.]+) s")
    time.sleep(8)
    events("mousemove 60 500 keydown w")
    time.sleep(1)
    taken = len(view.lines(shown))
    for i in range(20):
        key = "ad"[i % 2]
        events(f"keydown {key}")
        time.sleep(0.4)
        events(f"keyup {key}")
    events("keyup w")
    time.sleep(1)
    show("key to picture at 640x360 while it moves, gallery", view.lines(shown)[taken:], "ms")
    view.close()


def interface():
    # Every light at every pixel: an image of both paths takes seconds.
    view = View(["builtin:gallery", "--lights", "point:2000", "--assign", "every", "--size", "640x360"])
    view.wait(r"first picture after ([\d.]+) s")
    for i in range(40):
        events(f"mousemove {100 + 10 * i} {300 + i}")
        time.sleep(0.25)
    view.close()
    print("the interface while pictures take seconds:", open(view.said.name).read().strip().splitlines()[-1].split("interface: ")[-1])


def main():
    display = Display()
    try:
        starts()
        keys()
        interface()
    finally:
        display.close()


if __name__ == "__main__":
    main()
