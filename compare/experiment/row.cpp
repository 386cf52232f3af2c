// SPDX-License-Identifier: MIT
#include "compare/experiment/row.h"

#include "compare/files/frame_json.h"

#include <algorithm>
#include <cstdint>

namespace diptych::experiment {
namespace {

using Json = nlohmann::ordered_json;
using JsonPath = JsonAt<Json>;

// Upper limit of whole numbers in a row, so that sums of rows stay exact.
constexpr std::uint64_t max_counted = std::uint64_t(1) << 48;

double joined(const std::vector<Row>& cameras, Measure measure) {
    double sum = 0, largest = 0;
    for (const Row& camera : cameras) {
        sum += camera[measure];  // NaN if one was not measured
        largest = std::max(largest, camera[measure]);
    }
    switch (named(measure).over) {
        case OverCameras::mean:
            return sum / static_cast<double>(cameras.size());
        case OverCameras::largest:
            return std::isnan(sum) ? sum : largest;
        default:
            return sum;
    }
}

// Groups are objects of their measures.
void addMeasures(Json& json, const Measures& measured) {
    for (std::size_t i = 0; i < measures.size(); ++i) {
        const auto measure = static_cast<Measure>(i);
        const auto& [group, name, unit, over, title, means] = measures[i];
        Json& object = json[std::string(group)];
        if (!measured.has(measure)) continue;
        const double value = measured[measure];
        object[std::string(name)] = measures[i].isWhole() && std::isfinite(value)
                                        ? Json(static_cast<std::uint64_t>(value))
                                        : finiteOrNull(value);
    }
}

void addMeasured(Json& json, const Row& row) {
    addMeasures(json, row.measured);
    Json visits = Json::array(), cameras = Json::array();
    for (const FrameTime& block : row.blocks) visits.push_back(jsonOf(block));
    for (const Row& camera : row.cameras) {
        Json& one = cameras.emplace_back(Json{{"camera", camera.camera}});
        addMeasured(one, camera);
    }
    if (!row.ms.empty()) json["ms"]["all"] = row.ms;
    json["visits"] = std::move(visits);
    json["passes"] = jsonOf(row.passes);
    json["cameras"] = std::move(cameras);
    json["warnings"] = row.warnings;
}

double numberFrom(const JsonPath& json, bool whole) {
    if (json.json().is_null()) return std::numeric_limits<double>::infinity();
    return whole ? static_cast<double>(json.whole<std::uint64_t>(0, max_counted)) : json.number();
}

Row measuredFrom(const JsonPath& json) {
    Row row;
    for (std::size_t i = 0; i < measures.size(); ++i) {
        const JsonPath group = json.at(std::string(measures[i].group).c_str());
        if (const std::string name(measures[i].name); group.has(name.c_str()))
            row.measured[static_cast<Measure>(i)] = numberFrom(group.at(name.c_str()), measures[i].isWhole());
    }
    if (const JsonPath ms = json.at("ms"); ms.has("all"))
        for (const JsonPath& each : ms.at("all").each()) row.ms.push_back(each.number());
    for (const JsonPath& block : json.at("visits").each())
        row.blocks.push_back({block.at("median").number(), block.at("min").number(), block.at("max").number(),
                              block.at("runs").whole<int>(0, 1'000'000)});
    for (const JsonPath& pass : json.at("passes").each())
        row.passes.push_back({pass.at("name").text(), pass.at("ms").number()});
    for (const JsonPath& camera : json.at("cameras").each()) {
        row.cameras.push_back(measuredFrom(camera));
        row.cameras.back().camera = camera.at("camera").text();
    }
    row.warnings = json.at("warnings").texts();
    return row;
}

}  // namespace

void Measures::set(const FrameTime& time) {
    (*this)[Measure::ms] = time.median;
    (*this)[Measure::ms_min] = time.min;
    (*this)[Measure::ms_max] = time.max;
    (*this)[Measure::frames] = time.runs;
}

void Measures::set(const FrameBytes& bytes) {
    (*this)[Measure::memory] = static_cast<double>(bytes.images + bytes.buffers);
    (*this)[Measure::image_bytes] = static_cast<double>(bytes.images);
    (*this)[Measure::buffer_bytes] = static_cast<double>(bytes.buffers);
    (*this)[Measure::gbuffer_bytes] = static_cast<double>(bytes.gbuffer_per_pixel);
    (*this)[Measure::full_size_bytes] = static_cast<double>(bytes.full_size_images);
}

void Measures::set(const FrameCounters& counters) {
    (*this)[Measure::lights] = static_cast<double>(counters.lights);
    (*this)[Measure::nonfinite_pixels] = static_cast<double>(counters.nonfinite_pixels);
    (*this)[Measure::overflowed_lists] = static_cast<double>(counters.overflowed_lists);
    (*this)[Measure::unsorted_fragments] = static_cast<double>(counters.unsorted.fragments);
    (*this)[Measure::unsorted_pixels] = static_cast<double>(counters.unsorted.pixels);
}

void joinBlocks(Row& row) {
    FrameTime time = row.blocks.front();
    time.median = 0;
    time.runs = 0;
    for (const FrameTime& block : row.blocks) {
        time.median += block.median / static_cast<double>(row.blocks.size());
        time.min = std::min(time.min, block.min);
        time.max = std::max(time.max, block.max);
        time.runs += block.runs;
    }
    row.measured.set(time);
}

void joinCameras(Row& row) {
    for (std::size_t i = 0; i < measures.size(); ++i)
        if (measures[i].over != OverCameras::separate)
            row.measured[static_cast<Measure>(i)] = joined(row.cameras, static_cast<Measure>(i));
    row.passes.clear();
    for (const Row& camera : row.cameras)
        for (const PassTime& pass : camera.passes) {
            const double ms = pass.ms / static_cast<double>(row.cameras.size());
            const auto known = std::ranges::find(row.passes, pass.name, &PassTime::name);
            if (known != row.passes.end())
                known->ms += ms;
            else
                row.passes.push_back({pass.name, ms});
        }
}

CameraRange cameraRangeOf(const Row& row, Measure measure) {
    CameraRange range{row[measure], row[measure], row[measure]};
    for (const Row& camera : row.cameras) {
        range.low = std::min(range.low, camera[measure]);
        range.high = std::max(range.high, camera[measure]);
    }
    return range;
}

Json jsonOf(const Row& row) {
    Json json{{"scene", row.scene},
              {"varied", orNull(row.varied)},
              {"camera", orNull(row.camera)},
              {"path", nameOf(row.settings.path)},
              {"settings", jsonOf(row.settings)},
              {"renderer", orNull(row.renderer)},
              {"failed", orNull(row.failed)},
              {"judgement", orNull(row.judgement)}};
    addMeasured(json, row);
    return json;
}

Row rowFrom(const JsonPath& json) {
    const auto textOf = [&](const char* key) {
        return json.at(key).json().is_null() ? std::string() : json.at(key).text();
    };
    Row row = measuredFrom(json);
    row.scene = json.at("scene").text();
    row.varied = textOf("varied");
    row.failed = textOf("failed");
    row.settings = settingsFromJson(json.at("settings").json().dump());
    return row;
}

}  // namespace diptych::experiment
