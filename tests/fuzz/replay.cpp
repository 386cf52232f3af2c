// SPDX-License-Identifier: MIT
//     replay TARGET FILE|FOLDER...
// Runs a target without a fuzzer on each of the files and on those in the folders. A finding ends the
// program as it would end the fuzzer, after printing the file's name.
#include "tests/fuzz/fuzz.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <vector>

namespace fs = std::filesystem;

int main(int count, char** names) {
    const auto& targets = diptych::fuzz::Target::all();
    const auto target = targets.find(count > 1 ? names[1] : "");
    if (target == targets.end()) {
        std::fprintf(stderr, "usage: replay TARGET FILE|FOLDER...\n");
        return 2;
    }
    std::set<fs::path> files;
    for (int i = 2; i < count; ++i)
        if (fs::is_directory(names[i])) {
            for (const auto& entry : fs::recursive_directory_iterator(names[i]))
                if (entry.is_regular_file()) files.insert(entry.path());
        } else if (fs::exists(names[i])) {
            files.insert(names[i]);
        }
    for (const fs::path& file : files) {
        std::fprintf(stderr, "%s\n", file.c_str());
        std::ifstream stream(file, std::ios::binary);
        const std::vector<char> bytes(std::istreambuf_iterator<char>(stream), {});
        target->second(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    std::fprintf(stderr, "%zu files\n", files.size());
    return files.empty() ? 1 : 0;
}
