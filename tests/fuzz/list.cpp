// SPDX-License-Identifier: MIT
#include "compare/files/scene_folders.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/scratch_folder.h"

using namespace diptych;

FUZZ_TARGET(list)(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = fuzz::textAt(data, size);
    // Without slashes it cannot name files outside the folder, and no pattern searches the machine.
    if (text.find('/') != text.npos || text.find("..") != text.npos) return 0;
    const fuzz::ScratchFolder folder;
    folder.write("list", text);
    folder.write("other", "builtin:points\nscene.glb\n");
    folder.write("scene.glb", "glTF");
    fuzz::readOrSayWhy([&] {
        const std::vector<std::string> scenes = scenesOf({"@" + (folder / "list").string()});
        fuzz::require(!scenes.empty(), "a list that names nothing is an error");
    });
    return 0;
}
