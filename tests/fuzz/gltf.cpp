// SPDX-License-Identifier: MIT
// Fuzzes .gltf and .glb; the reader distinguishes them by their first bytes. External files are available.
#include "shared/scene/gltf/gltf.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/valid_scene.h"

#include <tbb/global_control.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <stdlib.h>

using namespace diptych;

namespace {

// A folder of external files: 256 bytes, the same in a subfolder, a link to them, links that lead outside,
// and a broken link.
class Beside {
public:
    Beside() {
        namespace fs = std::filesystem;
        std::string name = (fs::temp_directory_path() / "diptych_fuzz_XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error(name + ": cannot be made");
        folder = name;
        fs::create_directory(folder / "sub");
        for (const char* file : {"a.bin", "sub/b.bin"})
            std::ofstream(folder / file) << std::string(256, '\1');
        fs::create_symlink("sub/b.bin", folder / "link.bin");
        fs::create_symlink("/etc/passwd", folder / "out.bin");
        fs::create_directory_symlink("/etc", folder / "etc");
        fs::create_symlink("loop.bin", folder / "loop.bin");
    }
    ~Beside() {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }
    std::filesystem::path folder;
};

}  // namespace

FUZZ_TARGET(gltf)(const std::uint8_t* data, std::size_t size) {
    // One thread: the same input always does the same.
    static const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
    static const Beside beside;
    fuzz::readOrSayWhy([&] {
        fuzz::requireSound(parseGltf({data, data + size}, "fuzz.gltf", beside.folder));
    });
    return 0;
}
