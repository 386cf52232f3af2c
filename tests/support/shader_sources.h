// SPDX-License-Identifier: MIT
// Shaders built from changed copies of the sources, with the build's commands.
#pragma once

#include "tests/support/files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace diptych {

// Copies all files that shaders of the program and of tests include.
inline void copyShaderSources(const std::filesystem::path& root) {
    for (const char* each : {"shaders/lib", "shaders/pass", "shared/contract", "tests/probe/shaders"}) {
        std::filesystem::create_directories(root / each);
        std::filesystem::copy(std::filesystem::path(DIPTYCH_SOURCE_DIR) / each, root / each,
                              std::filesystem::copy_options::recursive);
    }
}

// Replaces `old`, which occurs once in the file.
inline void replaceIn(const std::filesystem::path& file, std::string_view old, std::string_view put) {
    std::string text = contentsOf(file);
    const std::size_t at = text.find(old);
    ASSERT_NE(at, std::string::npos) << file << " no longer has\n" << old;
    ASSERT_EQ(text.find(old, at + 1), std::string::npos) << file << " has twice\n" << old;
    text.replace(at, old.size(), put);
    std::ofstream(file, std::ios::binary) << text;
}

inline void runCommand(const std::string& command) {
    ASSERT_EQ(std::system((command + " >&2").c_str()), 0) << command;
}

// `source`: path from the root, such as "shaders/pass/gbuffer.frag".
inline void compileShader(const std::filesystem::path& root, std::string_view source,
                          const std::filesystem::path& out) {
    runCommand(fmt::format("'{}' -V --quiet --target-env vulkan1.3 '-I{}' -DSTAGE_{} '{}' -o '{}'",
                           DIPTYCH_GLSLANG, root.string(), source.substr(source.find('.') + 1),
                           (root / source).string(), out.string()));
}
inline void optimiseShader(const std::filesystem::path& out) {
    runCommand(fmt::format("'{}' '{}'", DIPTYCH_EXACT_SPIRV, out.string()));
    runCommand(fmt::format("'{0}' {1} --scalar-block-layout '{2}' -o '{2}'", DIPTYCH_SPIRV_OPT,
                           DIPTYCH_SPIRV_PASSES, out.string()));
}

}  // namespace diptych
