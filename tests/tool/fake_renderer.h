// SPDX-License-Identifier: MIT
// A fake renderer for tests: a Python script whose first argument is its behaviour.
#pragma once

#include "tests/tool/run.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace diptych {

// Modes: image (all pixels 0.25, 0.5, 0.75), wide, nan, none, exit, crash, hang FILE (a child writes its
// process id there), flee FILE (hang, but the child has a session of its own), stop FILE (hang, but stops its
// parent), link EXR, old EXR, chatter, keep FOLDER (stores its inputs), copy EXR.
inline const std::string fake_renderer = R"py(
import json, os, shutil, signal, struct, subprocess, sys, time

def write_exr(path, width, height, pixel):
    """Three float channels, no compression (OpenEXR file layout)."""
    def attribute(name, kind, value):
        return name + b'\0' + kind + b'\0' + struct.pack('<i', len(value)) + value
    channels = b''.join(c + b'\0' + struct.pack('<iB3xii', 2, 0, 1, 1) for c in (b'B', b'G', b'R')) + b'\0'
    box = struct.pack('<4i', 0, 0, width - 1, height - 1)
    head = struct.pack('<ii', 20000630, 2) + attribute(b'channels', b'chlist', channels) \
        + attribute(b'compression', b'compression', b'\0') + attribute(b'dataWindow', b'box2i', box) \
        + attribute(b'displayWindow', b'box2i', box) + attribute(b'lineOrder', b'lineOrder', b'\0') \
        + attribute(b'pixelAspectRatio', b'float', struct.pack('<f', 1)) \
        + attribute(b'screenWindowCenter', b'v2f', struct.pack('<ff', 0, 0)) \
        + attribute(b'screenWindowWidth', b'float', struct.pack('<f', 1)) + b'\0'
    line = 8 + 12 * width
    offsets = struct.pack('<%dQ' % height, *(len(head) + 8 * height + y * line for y in range(height)))
    with open(path, 'wb') as out:
        out.write(head + offsets)
        for y in range(height):
            rows = [[pixel(x, y)[c] for x in range(width)] for c in (2, 1, 0)]
            out.write(struct.pack('<ii', y, 12 * width))
            for row in rows:
                out.write(struct.pack('<%df' % width, *row))

mode, file, text = sys.argv[1], sys.argv[-2], sys.argv[-1]
job = json.load(open(file))
out, (width, height) = job['output']['file'], job['size']
colour = lambda x, y: (0.25, 0.5, 0.75)
if mode == 'exit':
    print('drawing', flush=True)
    print('no licence for <this> machine', file=sys.stderr)
    sys.exit(3)
if mode == 'crash':
    os.kill(os.getpid(), signal.SIGSEGV)
if mode == 'stop':
    os.kill(os.getppid(), signal.SIGSTOP)
if mode in ('hang', 'flee', 'stop'):
    script = 'echo $$ > "$1.part"; mv "$1.part" "$1"; exec sleep 600'
    subprocess.Popen((['setsid', '-f'] if mode == 'flee' else []) + ['sh', '-c', script, 'sh', sys.argv[2]])
    time.sleep(600)
if mode == 'none':
    sys.exit(0)
if mode == 'link':
    os.symlink(sys.argv[2], out)
    sys.exit(0)
if mode == 'old':
    shutil.copy2(sys.argv[2], out)
    sys.exit(0)
if mode == 'copy':
    shutil.copyfile(sys.argv[2], out)
    sys.exit(0)
if mode == 'chatter':
    for i in range(20000):
        print('line', i, 'of very many', file=sys.stderr)
if mode == 'keep':
    shutil.copytree(os.path.dirname(file), sys.argv[2], dirs_exist_ok=True)
    json.dump({'argv': sys.argv[1:], 'folder': os.getcwd()},
              open(os.path.join(sys.argv[2], 'handed.json'), 'w'))
if mode == 'nan':
    colour = lambda x, y: (0.25, float('nan') if (x, y) == (3, 2) else 0.5, 0.75)
write_exr(out, width + (mode == 'wide'), height, colour)
)py";

// Rules by which any image passes: no cause of a difference is looked for.
inline const std::string any_image = " --tolerances any.json ";

// Writes any.json, and NAME.json, whose command is the fake renderer in a mode; `more`: further members.
inline void writeRenderer(const Folder& folder, const std::string& name, const std::vector<std::string>& mode,
                          nlohmann::json more = nlohmann::json::object()) {
    folder.write("fake.py", fake_renderer);
    folder.write("any.json", R"({"rules": [{"channel": "lit", "flip": 1, "because": "anything goes"}]})");
    std::vector<std::string> command{"python3", (folder / "fake.py").string()};
    command.insert(command.end(), mode.begin(), mode.end());
    more["command"] = command;
    folder.write(name + ".json", more.dump());
}

}  // namespace diptych
