// SPDX-License-Identifier: MIT
// Runs a program as users do: through the shell, in some folder.
#pragma once

#include "tests/support/files.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace diptych {

namespace fs = std::filesystem;

// A folder of the running test, removed at its end.
class Folder {
public:
    Folder() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        path_ = fs::canonical(testing::TempDir()) / ("diptych_" + std::string(test->test_suite_name()) + "_" +
                                                     test->name() + "_" + std::to_string(getpid()));
        fs::remove_all(path_);
        fs::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    fs::path operator/(const std::string& name) const { return path_ / name; }
    const fs::path& path() const { return path_; }

    void write(const std::string& name, const std::string& text, bool executable = false) const {
        fs::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << text;
        if (executable) fs::permissions(path_ / name, fs::perms::owner_all);
    }

private:
    fs::path path_;
};

struct Ran {
    int code = -1;  // -1: it did not exit by itself
    std::string out, err;

    // Checks for exit code 2 and exactly one line on stderr, from the tool, that contains `word`; stdout
    // is empty, or with --json an object with the error.
    testing::AssertionResult failedOver(const std::string& word) const {
        const bool oneLine = std::ranges::count(err, '\n') == 1 && err.ends_with('\n');
        if (code == 2 && (out.empty() || out.starts_with("{\n  \"schema\": 1,\n  \"error\": ")) && oneLine &&
            err.starts_with("diptych: ") && err.find(word) != err.npos)
            return testing::AssertionSuccess();
        return testing::AssertionFailure()
               << "over " << word << ": code " << code << "\nout: " << out << "\nerr: " << err;
    }
};

// Runs `command`, in shell syntax.
inline Ran runShell(const Folder& scratch, const std::string& command, const fs::path& from) {
    const fs::path out = scratch / ".stdout", err = scratch / ".stderr";
    const int status = std::system(("cd '" + from.string() + "' && { " + command + "; } >'" + out.string() +
                                    "' 2>'" + err.string() + "'")
                                       .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentsOf(out), contentsOf(err)};
}

inline Ran runTool(const Folder& scratch, const std::string& arguments) {
    return runShell(scratch, "'" DIPTYCH_PROGRAM "' " + arguments, scratch.path());
}

// One triangle that faces the default camera, in one file.
inline constexpr const char* triangleGltf = R"({
  "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0 ] } ], "nodes": [ { "mesh": 0 } ],
  "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ],
  "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [ 0, 0, 0 ], "max": [ 1, 1, 0 ] } ],
  "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
  "buffers": [ { "byteLength": 36,
    "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" } ]
})";

}  // namespace diptych
