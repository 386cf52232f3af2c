// SPDX-License-Identifier: MIT
// Shards of a report, for tests that change their files.
#pragma once

#include "compare/report/whole_report.h"
#include "compare/shards/merge.h"
#include "tests/support/files.h"
#include "tests/support/report_builder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// Two channels of a few pixels: the kinds of files matter, not their number.
inline Report smallReport(const std::string& scene = "builtin:one") {
    std::vector<Frame> frames = bothFrames(scene);
    for (Frame& frame : frames) {
        frame.requested = {Channel::lit, Channel::normals};
        std::erase_if(frame.channels, [&](const auto& channel) {
            return !frame.isRequested(channel.first) && channel.first != Channel::material_id;
        });
    }
    frames[1].through_gbuffer = frames[0].channels;
    return reportOf(std::move(frames));
}

// A folder with shards of one command, an unrelated file, and paths to it.
struct Shards {
    std::filesystem::path root = folder();
    std::filesystem::path shard = root / "shard-1";

    explicit Shards(int count = 1) {
        std::ofstream(root / "secret.png") << "secret";
        shards::Manifest manifest{"build", "compare", {{"asked", {{"keep", 0}}}}, {}, {}, {}};
        for (int i = 1; i <= count; ++i)
            manifest.items.push_back({"scene-" + std::to_string(i), "box-" + std::to_string(i) + "/", i});
        for (int i = 1; i <= count; ++i) {
            const std::filesystem::path parts = root / ("parts-" + std::to_string(i));
            const shards::Item& item = manifest.items[static_cast<std::size_t>(i - 1)];
            ReportOptions options;
            options.scene_folder = item.folder;
            WholeReport whole;
            whole.parts.push_back({writePart(smallReport(), parts, options), parts});
            manifest.shard = {i, count};
            whole.shard = textOf(manifest);
            options.scene_folder.reset();
            writeWhole(whole, joinedOf(whole), root / ("shard-" + std::to_string(i)), options);
            std::filesystem::remove_all(parts);
        }
    }

    std::filesystem::path part() const { return shard / "box-1/part.json"; }
    void change(const std::filesystem::path& file,
                const std::function<void(nlohmann::ordered_json&)>& edit) const {
        nlohmann::ordered_json json = nlohmann::ordered_json::parse(contentsOf(file));
        edit(json);
        std::filesystem::remove(file);  // it may be a hard link
        std::ofstream(file) << json.dump();
    }

    // Merges as `merge` does. Returns the reported problems, one per line.
    std::string merged(const std::vector<std::filesystem::path>& folders) const {
        shards::Joined joined = shards::join(folders);
        std::string problems;
        for (const std::string& problem : joined.problems) {
            EXPECT_EQ(problem.find_first_of("\n\r"), std::string::npos) << problem;
            EXPECT_EQ(problem.find("json.exception"), std::string::npos) << problem;
            problems += problem + "\n";
        }
        ReportOptions options;
        writeWhole(joined.report, joinedOf(joined.report), root / "out", options);
        return problems;
    }
    std::string merged() const { return merged({shard}); }

    // All files except the output.
    std::vector<std::string> outside() const {
        std::vector<std::string> files = filesIn(root);
        std::erase_if(files, [](const std::string& name) { return name.starts_with("out/"); });
        return files;
    }
};

}  // namespace diptych
