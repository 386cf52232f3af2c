#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the modules of this repository from the code: folders as boxes, includes as arrows.

    modules.py              writes modules.svg beside this script
    modules.py --check      prints errors and exits 1: a cycle of includes, or a modules.svg that does not match
                            the code

A module is one row above the highest module that it includes, so every arrow points down. Implied arrows are
omitted (transitive reduction). Tests are not drawn.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
SVG = pathlib.Path(__file__).with_name("modules.svg")
TOPS = ("shared", "forward_plus", "deferred", "shaders", "compare")
ENDINGS = {".cpp", ".h", ".glsl", ".vert", ".frag", ".comp"}
PARTS = {"shared/light/fit": "shared/light"}  # parts of a larger module, as compare/X/page is of compare/X

BOX_WIDTH, BOX_HEIGHT, GAP_X, GAP_Y, MARGIN = 132, 34, 14, 46, 20


def module_of(path):
    folder = re.sub(r"^(compare/\w+)/page$|^(shaders/lib)/\w+$", r"\1\2", path.parent.as_posix())
    return PARTS.get(folder, folder)


def read_uses(root):
    """module -> the modules that its files include"""
    files = {}
    for top in TOPS:
        for path in (root / top).rglob("*"):
            if path.suffix in ENDINGS:
                files[path.relative_to(root).as_posix()] = path
    uses = {}
    for name, path in files.items():
        here = pathlib.PurePosixPath(name)
        module = module_of(here)
        uses.setdefault(module, set())
        for target in re.findall(r'^\s*#\s*include\s*"([^"]+)"', path.read_text(encoding="utf-8"), re.M):
            beside = (here.parent / target).as_posix()
            found = beside if beside in files else target
            if found in files and module_of(pathlib.PurePosixPath(found)) != module:
                uses[module].add(module_of(pathlib.PurePosixPath(found)))
    return uses


def find_circle(uses):
    """The modules of one cycle in order; empty if there is none."""
    done, path = set(), []

    def visit(module):
        if module in path:
            return path[path.index(module):]
        if module in done:
            return []
        path.append(module)
        for used in sorted(uses.get(module, ())):
            circle = visit(used)
            if circle:
                return circle
        path.pop()
        done.add(module)
        return []

    for module in sorted(uses):
        circle = visit(module)
        if circle:
            return circle
    return []


def rows_of(uses):
    row = {}

    def place(module):
        if module not in row:
            row[module] = 1 + max((place(used) for used in uses.get(module, ())), default=-1)
        return row[module]

    for module in sorted(uses):
        place(module)
    return row


def reduced(uses):
    """The transitive reduction: without implied arrows."""
    reach = {}

    def reached(module):
        if module not in reach:
            reach[module] = set().union(*({used} | reached(used) for used in uses.get(module, ())))
        return reach[module]

    return {module: {used for used in direct if not any(used in reached(other) for other in direct if other != used)}
            for module, direct in uses.items()}


def draw(uses):
    row = rows_of(uses)
    arrows = reduced(uses)
    height = max(row.values()) + 1
    rows = [sorted(m for m in row if row[m] == r) for r in range(height)]
    users = {m: [u for u in arrows if m in arrows[u]] for m in row}
    place = {m: float(i) for members in rows for i, m in enumerate(members)}
    for _ in range(12):  # sort each row by the mean position of its neighbours, bottom up and top down
        for neighbours, order in ((arrows, range(1, height)), (users, range(height - 2, -1, -1))):
            for r in order:
                def mean(m):
                    near = [place[n] for n in neighbours.get(m, ())]
                    return sum(near) / len(near) if near else place[m]
                rows[r].sort(key=lambda m: (mean(m), m))
                for i, m in enumerate(rows[r]):
                    place[m] = i - (len(rows[r]) - 1) / 2
    widest = max(len(members) for members in rows)
    width = 2 * MARGIN + widest * (BOX_WIDTH + GAP_X) - GAP_X
    total = 2 * MARGIN + height * (BOX_HEIGHT + GAP_Y) - GAP_Y

    def corner(m):
        x = width / 2 + place[m] * (BOX_WIDTH + GAP_X) - BOX_WIDTH / 2
        y = total - MARGIN - BOX_HEIGHT - row[m] * (BOX_HEIGHT + GAP_Y)
        return x, y

    colours = {"shared": "#dbe9f6", "shaders": "#e6e0f0", "forward_plus": "#fde3c8", "deferred": "#fde3c8",
               "compare": "#def0dc"}
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {total}" font-family="sans-serif" '
           'font-size="12">',
           "<!-- made by tests/architecture/modules.py -->",
           '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="6" markerHeight="6" '
           'orient="auto"><path d="M0 0L8 4L0 8z" fill="#777"/></marker></defs>',
           f'<rect width="{width}" height="{total}" fill="white"/>']
    for module in sorted(arrows):
        for used in sorted(arrows[module]):
            (x0, y0), (x1, y1) = corner(module), corner(used)
            x0, y0, x1 = x0 + BOX_WIDTH / 2, y0 + BOX_HEIGHT, x1 + BOX_WIDTH / 2
            bend = (y1 - y0) / 2
            out.append(f'<path d="M{x0:g} {y0:g}C{x0:g} {y0 + bend:g} {x1:g} {y1 - bend:g} {x1:g} {y1:g}" '
                       'fill="none" stroke="#999" marker-end="url(#tip)"/>')
    for module in sorted(row):
        x, y = corner(module)
        fill = colours[module.split("/")[0]]
        out.append(f'<rect x="{x:g}" y="{y:g}" width="{BOX_WIDTH}" height="{BOX_HEIGHT}" rx="4" fill="{fill}" '
                   'stroke="#555"/>')
        out.append(f'<text x="{x + BOX_WIDTH / 2:g}" y="{y + BOX_HEIGHT / 2 + 4:g}" text-anchor="middle">{module}</text>')
    out.append("</svg>")
    return "\n".join(out) + "\n"


def main():
    uses = read_uses(ROOT)
    circle = find_circle(uses)
    if circle:
        sys.exit("modules include each other in a circle: " + " -> ".join(circle + circle[:1]))
    picture = draw(uses)
    if sys.argv[1:] == ["--check"]:
        if not SVG.exists() or SVG.read_text(encoding="utf-8") != picture:
            sys.exit(f"{SVG.name} is not what the code gives; run tests/architecture/modules.py")
    else:
        SVG.write_text(picture, encoding="utf-8")


if __name__ == "__main__":
    main()
