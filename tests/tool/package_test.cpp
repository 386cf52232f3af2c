// SPDX-License-Identifier: MIT
// The installation: manual page, completions, schemas and adapters, a library that another program links,
// and a Debian package of it all.
#include "tests/tool/run.h"

#include <sstream>
#include <vector>

namespace diptych {
namespace {

bool isThere(const Folder& folder, const std::string& program) {
    return runShell(folder, "command -v " + program, folder.path()).code == 0;
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

TEST(Manual, HasEveryCommandAndOptionOfTheHelp) {
    const Folder folder;
    const Ran page = runTool(folder, "--manual");
    ASSERT_EQ(page.code, 0) << page.err;
    for (std::size_t at = 0; (at = page.out.find("\\&", at)) != page.out.npos; ++at)
        EXPECT_EQ(page.out[at - 1], '\n') << "escapes the first character of a line";
    // As man shows it, if groff is installed; groff's warnings are faults.
    std::string shown = page.out;
    if (isThere(folder, "groff")) {
        folder.write("diptych.1", page.out);
        const Ran ran =
            runShell(folder, "groff -man -Tascii -ww diptych.1 | sed 's/\\x1b\\[[0-9;]*m//g; s/.\\x08//g'",
                     folder.path());
        EXPECT_EQ(ran.err, "");
        EXPECT_NE(ran.out.find("NAME"), std::string::npos);
    }
    for (const char* command : {"compare", "render", "diff", "tradeoff", "explain", "choose", "audit", "plan",
                                "view", "bench", "devices"}) {
        EXPECT_NE(page.out.find(".SH OPTIONS OF " + std::string(command)), std::string::npos) << command;
        // Every option that --help prints at the beginning of a line.
        const Ran help = runTool(folder, std::string(command) + " --help all");
        std::size_t options = 0;
        for (const std::string& line : linesOf(help.out)) {
            const std::size_t at = line.find("--");
            if (!line.starts_with("  -") || at == std::string::npos) continue;
            std::string name = line.substr(at, line.find_first_of(" ,", at) - at), escaped;
            for (const char c : name) escaped += c == '-' ? std::string("\\-") : std::string(1, c);
            EXPECT_NE(page.out.find(escaped), std::string::npos) << command << " " << name;
            ++options;
        }
        EXPECT_GT(options, 3u) << command;
    }
}

// Bash's completions for these words; the last is incomplete.
std::string offered(const Folder& folder, const std::vector<std::string>& words) {
    std::string list;
    for (const std::string& word : words) list += " '" + word + "'";
    const Ran ran = runShell(
        folder,
        "bash -c '. ./diptych.bash; COMP_WORDS=(" +
            [&] {
                std::string plain;
                for (const std::string& word : words) plain += " \"" + word + "\"";
                return plain;
            }() +
            "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _diptych; echo ${COMPREPLY[@]}'",
        folder.path());
    EXPECT_EQ(ran.err, "") << list;
    return ran.out;
}

TEST(Completion, BashOffersCommandsOptionsAndValues) {
    const Folder folder;
    const Ran script = runTool(folder, "--completion bash");
    ASSERT_EQ(script.code, 0) << script.err;
    folder.write("diptych.bash", script.out);
    EXPECT_EQ(offered(folder, {"diptych", "tra"}), "tradeoff\n");
    EXPECT_EQ(offered(folder, {"diptych", "render", "--spot"}), "--spot-cone\n");
    EXPECT_EQ(offered(folder, {"diptych", "render", "--spot-cone", ""}), "gltf smoothstep\n");
    EXPECT_EQ(offered(folder, {"diptych", "compare", "--base-layer", "c"}), "component\n");
    EXPECT_EQ(offered(folder, {"diptych", "compare", "builtin", ":", "gal"}), "gallery\n");
    folder.write("scene.glb", "");
    EXPECT_EQ(offered(folder, {"diptych", "compare", "sce"}), "scene.glb\n");
}

TEST(Completion, TheOtherShellsTakeTheirs) {
    const Folder folder;
    for (const char* shell : {"zsh", "fish"}) {
        const Ran script = runTool(folder, std::string("--completion ") + shell);
        ASSERT_EQ(script.code, 0) << script.err;
        EXPECT_NE(script.out.find("spot-cone"), std::string::npos);
        EXPECT_NE(script.out.find("builtin:gallery"), std::string::npos);
        folder.write(shell, script.out);
        if (isThere(folder, shell)) {
            const Ran checked = runShell(folder, std::string(shell) + " -n " + shell, folder.path());
            EXPECT_EQ(checked.code, 0) << checked.err;
        }
    }
    EXPECT_TRUE(runTool(folder, "--completion tcsh").failedOver("takes one of bash|zsh|fish"));
}

// The installed files, made once for all tests here.
const fs::path& installed() {
    static const fs::path path = [] {
        const fs::path prefix =
            fs::canonical(testing::TempDir()) / ("diptych_installed_" + std::to_string(getpid()));
        fs::remove_all(prefix);
        std::atexit([] {
            std::error_code ignored;
            fs::remove_all(
                fs::canonical(testing::TempDir()) / ("diptych_installed_" + std::to_string(getpid())),
                ignored);
        });
        const Folder folder;
        const Ran ran = runShell(
            folder, "cmake --install '" DIPTYCH_BINARY_DIR "' --strip --prefix '" + prefix.string() + "'",
            folder.path());
        EXPECT_EQ(ran.code, 0) << ran.err;
        return prefix;
    }();
    return path;
}

TEST(Package, WhatIsInstalledIsWhole) {
    for (const char* file :
         {"bin/diptych", "share/man/man1/diptych.1", "share/bash-completion/completions/diptych",
          "share/zsh/vendor-completions/_diptych", "share/fish/vendor_completions.d/diptych.fish",
          "share/doc/diptych/LICENSE", "share/doc/diptych/CHANGELOG.md", "share/doc/diptych/SECURITY.md",
          "share/diptych/schemas/tolerances.schema.json", "share/diptych/schemas/job.schema.json",
          "share/diptych/schemas/renderer.schema.json", "share/diptych/adapters/three.json",
          "share/diptych/adapters/three.mjs", "share/diptych/adapters/template.sh",
          "include/diptych/diptych.h"})
        EXPECT_TRUE(fs::exists(installed() / file)) << file;
    const Folder folder;
    const Ran drawn = runShell(
        folder,
        "'" + (installed() / "bin/diptych").string() + "' render builtin:triangle --size 32x18 -o a.png",
        folder.path());
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_TRUE(fs::exists(folder / "a.png"));
}

TEST(Package, AnotherProgramLinksTheLibrary) {
    const Folder folder;
    const Ran built = runShell(folder,
                               "cmake -S '" DIPTYCH_SOURCE_DIR
                               "/compare/library/example' -B build -DCMAKE_BUILD_TYPE=Release "
                               "-DCMAKE_PREFIX_PATH='" +
                                   installed().string() + "' && cmake --build build",
                               folder.path());
    ASSERT_EQ(built.code, 0) << built.out << built.err;
    const Ran ran = runShell(folder, "build/compare_example", folder.path());
    EXPECT_EQ(ran.code, 1) << ran.err;
    EXPECT_NE(ran.out.find("worst at 3"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("does not hold"), std::string::npos) << ran.out;
}

TEST(Package, ADebianPackageHoldsTheProgramAndSaysWhatItNeeds) {
    const Folder folder;
    for (const auto& [need, package] :
         {std::pair{"dpkg-shlibdeps", "dpkg-dev"}, {"file", "file"}, {"cpack", "cmake"}})
        if (!isThere(folder, need))
            GTEST_SKIP() << need << " is not here (Debian package " << package << "): no .deb is made";
    const Ran packed =
        runShell(folder, "cpack --config '" DIPTYCH_BINARY_DIR "/CPackConfig.cmake' -B .", folder.path());
    ASSERT_EQ(packed.code, 0) << packed.out << packed.err;
    const Ran listed = runShell(folder, "dpkg-deb -c diptych_*.deb", folder.path());
    for (const char* file : {"./usr/bin/diptych", "/man1/diptych.1", "/completions/diptych",
                             "/schemas/tolerances.schema.json", "/adapters/three.mjs"})
        EXPECT_NE(listed.out.find(file), std::string::npos) << file << "\n" << listed.out;
    EXPECT_EQ(listed.out.find("diptych.h"), std::string::npos) << "the library is not the program's";
    const Ran needs = runShell(folder, "dpkg-deb -f diptych_*.deb Depends Version", folder.path());
    for (const char* package : {"libvulkan1", "libc6", "mesa-vulkan-drivers | vulkan-icd"})
        EXPECT_NE(needs.out.find(package), std::string::npos) << needs.out;
}

}  // namespace
}  // namespace diptych
