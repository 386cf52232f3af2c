// SPDX-License-Identifier: MIT
// The workflow files in .ci/ that users copy: their commands must parse, and the commands must write the
// files that the workflows keep.
#include "compare/cli/option_groups.h"
#include "tests/support/command_lines.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>

#include <sstream>

namespace diptych {

using namespace cli;

namespace {

// Every line that calls the command, split into words, up to "||".
std::vector<std::vector<std::string>> callsIn(const std::string& text,
                                              const std::string& command = "compare") {
    std::vector<std::vector<std::string>> calls;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t at = line.find("diptych " + command + " ");
        if (at == std::string::npos) continue;
        std::istringstream words(line.substr(at + 8, line.find(" || ") - at - 8));
        calls.emplace_back(std::istream_iterator<std::string>(words), std::istream_iterator<std::string>());
    }
    return calls;
}

TEST(Workflows, TheirCommandsParseAndTheirFilesAreTheReports) {
    for (const char* file : {"github-workflow.yml", "gitlab.yml"}) {
        const std::string text = contentsOf(std::filesystem::path(DIPTYCH_SOURCE_DIR) / ".ci" / file);
        const auto calls = callsIn(text);
        ASSERT_EQ(calls.size(), 1u) << file;
        const auto options = parsedAs<SceneGroup>(calls[0]);
        EXPECT_EQ(options.scenes, std::vector<std::string>{"scenes/*.glb"});
        EXPECT_FALSE(options.settings.problem());
        const std::string folder = options.out.string();
        ASSERT_FALSE(folder.empty());
        EXPECT_NE(text.find(": " + folder + "/junit.xml\n"), std::string::npos) << file;
        const bool kept = text.find("path: " + folder + "\n") != std::string::npos ||
                          text.find("paths:\n      - " + folder + "/\n") != std::string::npos;
        EXPECT_TRUE(kept) << file;
        EXPECT_EQ(text.find('\t'), std::string::npos) << "YAML is indented by spaces";
        EXPECT_NE(text.find("--target package && cp /opt/diptych/build/diptych_*.deb ."), std::string::npos);
        EXPECT_TRUE(text.find("path: diptych_*.deb\n") != std::string::npos ||
                    text.find("      - diptych_*.deb\n") != std::string::npos)
            << file << ": keeps no package";
    }
}

// Many scenes on several machines: the commands of the shards and of the merge.
TEST(Workflows, ShardsAndTheirMergeParse) {
    for (const char* file : {"github-matrix.yml", "gitlab-parallel.yml"}) {
        const std::string text = contentsOf(std::filesystem::path(DIPTYCH_SOURCE_DIR) / ".ci" / file);
        const auto shards = callsIn(text), merges = callsIn(text, "merge");
        ASSERT_EQ(shards.size(), 1u) << file;
        ASSERT_EQ(merges.size(), 1u) << file;
        const auto shard = parsedAs<ShardedGroup>(shards[0]);
        const auto merge = parsedAs<OutputGroup>(merges[0]);
        EXPECT_EQ(shard.scenes, std::vector<std::string>{"scenes/"});
        EXPECT_NE(shard.shard.find('/'), std::string::npos) << "I/N, of the matrix";
        EXPECT_TRUE(shard.out.string().starts_with("shard-"));
        EXPECT_EQ(merges[0][1], "shard-*/") << "which the shell expands";
        EXPECT_NE(text.find(": " + merge.out.string() + "/junit.xml\n"), std::string::npos) << file;
        EXPECT_EQ(text.find('\t'), std::string::npos) << "YAML is indented by spaces";
    }
}

}  // namespace
}  // namespace diptych
