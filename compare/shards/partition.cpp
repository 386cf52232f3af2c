// SPDX-License-Identifier: MIT
#include "compare/shards/partition.h"

#include "compare/files/diptych_files.h"
#include "shared/scene/gltf/limits.h"
#include "shared/scene/gltf/resources.h"
#include "shared/text/fail.h"
#include "shared/text/input_file.h"
#include "shared/text/json.h"
#include "shared/text/json_at.h"
#include "shared/text/named.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <numeric>
#include <span>
#include <stdexcept>
#include <tuple>

namespace diptych::shards {
namespace {

namespace fs = std::filesystem;

// Without timings: bytes whose loading takes as long as rendering a small scene (lavapipe, 640x360, 2
// cores).
constexpr double bytesOfDrawing = 4 << 20;

std::optional<int> numberIn(std::string_view text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

// Variables of a Slurm array task.
struct ArrayTask {
    int id = 0, first = 0, step = 0, last = 0;
    std::optional<int> count;
};

int variable(const Variables& environment, const char* name, const std::string& word) {
    const std::optional<std::string> text = environment(name);
    const std::optional<int> number = text ? numberIn(*text) : std::nullopt;
    if (!number)
        throw std::runtime_error(fmt::format(
            "--shard {}: {} {}; run it as a task of a Slurm array (sbatch --array=1-16), or give --shard I/N",
            word, name, text ? "is not a number: " + *text : "is not set"));
    return *number;
}

Shard shardOfArray(const std::string& word, const Variables& environment) {
    ArrayTask task;
    task.id = variable(environment, "SLURM_ARRAY_TASK_ID", word);
    task.first = variable(environment, "SLURM_ARRAY_TASK_MIN", word);
    task.last = variable(environment, "SLURM_ARRAY_TASK_MAX", word);
    task.step = variable(environment, "SLURM_ARRAY_TASK_STEP", word);
    if (environment("SLURM_ARRAY_TASK_COUNT"))
        task.count = variable(environment, "SLURM_ARRAY_TASK_COUNT", word);
    const int count = task.step > 0 ? (task.last - task.first) / task.step + 1 : 0;
    const bool regular = task.step > 0 && task.first <= task.id && task.id <= task.last &&
                         (task.last - task.first) % task.step == 0 &&
                         (task.id - task.first) % task.step == 0 && task.count.value_or(count) == count;
    if (!regular)
        throw std::runtime_error(
            fmt::format("--shard {}: the array is irregular (task {} of {} to {} by {}), and Slurm does not "
                        "list its tasks; give --shard slurm/N with tasks 1 to N",
                        word, task.id, task.first, task.last, task.step));
    return {(task.id - task.first) / task.step + 1, count};
}

// Buffers and images in the JSON of a .gltf, or in the first chunk of a .glb. Null on failure.
nlohmann::json gltfJson(const fs::path& path) {
    try {
        InputFile file(path, gltf::MAX_FILE_BYTES);
        std::string text(std::min<std::uint64_t>(file.size(), 20), '\0');
        file.read(std::as_writable_bytes(std::span(text)));
        const auto byte = [&](std::size_t at) {
            return static_cast<std::uint32_t>(static_cast<unsigned char>(text[at]));
        };
        const bool binary = text.size() == 20 && text.starts_with("glTF");
        const std::uint64_t left = file.size() - text.size();
        const std::uint64_t length =
            binary ? byte(12) | byte(13) << 8 | byte(14) << 16 | byte(15) << 24 : left;
        if (length > left || length > gltf::MAX_JSON_BYTES) return {};
        if (binary) text.clear();
        const std::size_t read = text.size();
        text.resize(read + length);
        file.read(std::as_writable_bytes(std::span(text).subspan(read)));
        return parseJson(text, [](int depth, const std::string& key) {
            return depth > 1 ? key == "uri" : key == "buffers" || key == "images";
        });
    } catch (const std::runtime_error&) {  // loadScene() reports the reason
        return {};
    }
}

std::string fileName(const std::string& scene) {
    std::error_code ignored;
    return fs::exists(scene, ignored) ? scene : scene.substr(0, scene.rfind("?scene="));
}

}  // namespace

Shard shardOf(const std::string& word, const Variables& environment) {
    const std::size_t slash = word.find('/');
    const std::string first = word.substr(0, slash);
    if (first == "slurm" && slash == word.npos) return shardOfArray(word, environment);
    const std::optional<int> count = slash == word.npos ? std::nullopt : numberIn(word.substr(slash + 1));
    const std::optional<int> index =
        first == "slurm" && count ? variable(environment, "SLURM_ARRAY_TASK_ID", word) : numberIn(first);
    if (!count || !index)
        throw std::runtime_error(
            fmt::format("--shard {}: give I/N, counted from 1, e.g. 2/16; or slurm, or slurm/N", word));
    if (*count > max_shards)
        throw std::runtime_error(fmt::format("--shard {}: at most {} shards", word, max_shards));
    if (*count < 1 || *index < 1 || *index > *count)
        throw std::runtime_error(
            fmt::format("--shard {}: there is no shard {} of {}; the first is 1", word, *index, *count));
    return {*index, *count};
}

std::vector<fs::path> filesOf(const std::string& scene) {
    if (scene.starts_with("builtin:")) return {};
    const fs::path file = fileName(scene);
    std::vector<fs::path> files{file};
    const nlohmann::json json = gltfJson(file);
    if (!json.is_object()) return files;
    for (const char* kind : {"buffers", "images"})
        if (const auto all = json.find(kind); all != json.end() && all->is_array())
            for (const auto& one : *all)
                if (one.is_object() && one.contains("uri") && one["uri"].is_string()) {
                    const std::string uri = one["uri"];
                    if (!uri.starts_with("data:"))
                        files.push_back(file.parent_path() / gltf::percentDecoded(uri));
                }
    return files;
}

std::uint64_t bytesOf(const std::string& scene) {
    std::uint64_t bytes = 0;
    for (const fs::path& file : filesOf(scene)) {
        std::error_code error;
        const auto size = fs::file_size(file, error);
        if (!error) bytes += size;
    }
    return bytes;
}

std::map<std::string, double> timingsOf(const fs::path& report) {
    return named("--timings " + report.string(), [&] {
        const nlohmann::json json =
            parseJson(textIn(reportFile(report), json_bytes), [](int depth, const std::string& key) {
                return depth > 1 ? key == "scene" || key == "made_in_ms" : key == "frames";
            });
        std::map<std::string, double> timings;
        const JsonAt top(json);
        if (top.has("frames"))
            for (const auto& frame : top.at("frames").each())
                if (const double ms = frame.numberOr("made_in_ms", 0); ms > 0)
                    timings[frame.textOr("scene", "")] += ms;
        if (timings.empty()) fail("is not a report.json with rendered frames, nor a folder with one");
        return timings;
    });
}

std::vector<double> weightsOf(const std::vector<std::string>& scenes,
                              const std::map<std::string, double>& timings) {
    std::vector<double> weights;
    double ms = 0, bytes = 0;
    for (const std::string& scene : scenes) {
        weights.push_back(static_cast<double>(bytesOf(scene)) + bytesOfDrawing);
        if (const auto found = timings.find(scene); found != timings.end()) {
            ms += found->second;
            bytes += weights.back();
        }
    }
    for (std::size_t i = 0; i < scenes.size() && ms > 0; ++i) {
        const auto found = timings.find(scenes[i]);
        weights[i] = found != timings.end() ? found->second : weights[i] * ms / bytes;
    }
    return weights;
}

std::vector<int> partition(const std::vector<double>& weights, int count) {
    std::vector<std::size_t> order(weights.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return weights[i]; });
    struct Load {
        double weight = 0;
        std::size_t scenes = 0;
    };
    std::vector<Load> loads(static_cast<std::size_t>(count));
    std::vector<int> shards(weights.size());
    for (const std::size_t i : order) {
        const auto min =
            std::ranges::min_element(loads, {}, [](const Load& l) { return std::tuple(l.weight, l.scenes); });
        min->weight += weights[i];
        ++min->scenes;
        shards[i] = static_cast<int>(min - loads.begin()) + 1;
    }
    return shards;
}

}  // namespace diptych::shards
