// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/rules.h"

#include "shared/scene/gltf/properties.h"
#include "shared/scene/gltf/value.h"
#include "shared/text/counted.h"
#include "shared/text/fail.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

namespace diptych::gltf {

namespace {

using Json = nlohmann::json;

void checkAccessor(const Json& accessor, const std::string& who) {
    const auto type = accessor["componentType"].get<std::int64_t>();
    if (type < 5120 || type > 5126 || type == 5124)
        fail(who, fmt::format("componentType {} does not exist", type));
    if (accessor.contains("sparse") && accessor["sparse"]["count"] > accessor["count"])
        fail(who, fmt::format("{} sparse elements for {} elements", accessor["sparse"]["count"].dump(),
                              accessor["count"].dump()));
}

// Removes a member that is 0 but must be positive; exporters write 0 for "none".
void leaveOutZero(Json& item, const char* key, const std::string& who, NoteList& notes) {
    if (!item.contains(key) || item[key] != 0) return;
    notes.add(fmt::format("{}: {} 0: ignored", who, key));
    item.erase(key);
}

// A whole number in an object that may be broken, and so not what the schema says.
std::optional<std::int64_t> wholeOf(const Json& object, std::string_view key) {
    const Json* value = memberOf(object, key);
    return value && value->is_number_integer() ? std::optional(value->get<std::int64_t>()) : std::nullopt;
}

// The accessors that read a bufferView.
struct Readers {
    std::set<std::int64_t> index_bytes;  // component sizes of its index accessors
    bool others = false;
};

// The readers of each bufferView with a stride.
std::map<std::size_t, Readers> readersOf(const Json& document,
                                         const std::map<std::size_t, std::int64_t>& strides) {
    std::map<std::size_t, Readers> readers;
    const Json& accessors = arrayAt(document, "/accessors");
    std::vector<bool> isIndices(accessors.size(), false);
    for (const Json& mesh : arrayAt(document, "/meshes"))
        for (const Json& primitive : arrayAt(mesh, "/primitives"))
            if (const auto index = wholeOf(primitive, "indices");
                index && static_cast<std::size_t>(*index) < accessors.size())
                isIndices[static_cast<std::size_t>(*index)] = true;
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        const auto view = wholeOf(accessors[i], "bufferView");
        if (!view || !strides.contains(static_cast<std::size_t>(*view))) continue;
        Readers& r = readers[static_cast<std::size_t>(*view)];
        const auto type = wholeOf(accessors[i], "componentType");
        if (isIndices[i] && type)
            r.index_bytes.insert(*type == 5125 ? 4 : *type == 5123 ? 2 : 1);
        else
            r.others = true;
    }
    return readers;
}

}  // namespace

void checkRules(std::string_view collection, Json& item, const std::string& who, NoteList& notes) {
    if (collection == "accessors") return checkAccessor(item, who);
    if (collection == "nodes" && item.contains("matrix") &&
        (item.contains("translation") || item.contains("rotation") || item.contains("scale")))
        notes.add(who + ": has a matrix and translation, rotation or scale: the matrix is used");
    // Cameras and spot lights need the object that their type names.
    if (collection == "cameras") {
        const std::string& type = item["type"].get_ref<const std::string&>();
        if (!item.contains(type)) fail(who, fmt::format("is {0} but has no {0}", type));
        if (type == "perspective") leaveOutZero(item["perspective"], "zfar", who, notes);
    }
    if (collection == "KHR_lights_punctual") {
        if (item["type"] == "spot" && !item.contains("spot")) fail(who, "is spot but has no spot");
        leaveOutZero(item, "range", who, notes);
    }
}

// Source: Khronos, glTF 2.0 Specification, 2021, 5.11.4 and 3.6.2.4.
void checkStrides(Json& document, References& references, NoteList& notes) {
    std::map<std::size_t, std::int64_t> strides;
    for (std::size_t i = 0; const Json& view : arrayAt(document, "/bufferViews")) {
        if (const auto stride = wholeOf(view, "byteStride")) strides[i] = *stride;
        ++i;
    }
    if (strides.empty()) return;
    Json& views = document["bufferViews"];
    const std::map<std::size_t, Readers> readers = readersOf(document, strides);
    for (const auto& [view, stride] : strides) {
        const std::string who = fmt::format("bufferView {}", view);
        const auto at = readers.find(view);
        const Readers read = at == readers.end() ? Readers{} : at->second;
        if (stride == 0) {
            notes.add(who + ": byteStride 0: read as packed");
            views[view].erase("byteStride");
        } else if (!read.index_bytes.empty()) {
            if (read.index_bytes != std::set{stride})
                references.broken(
                    "bufferViews", view,
                    fmt::format("{}: byteStride {}, but indices must be packed, {} each", who, stride,
                                counted(static_cast<std::uint64_t>(*read.index_bytes.begin()), "byte")));
            else
                notes.add(fmt::format("{}: byteStride {} of packed indices: ignored", who, stride));
            if (!read.others) views[view].erase("byteStride");
        } else if (stride < 4) {
            references.broken("bufferViews", view,
                              fmt::format("{}: byteStride {} is not from 4 to 252", who, stride));
        } else if (stride % 4 != 0) {
            references.broken("bufferViews", view,
                              fmt::format("{}: byteStride {} is not a multiple of 4", who, stride));
        }
    }
}

namespace {

Json emptyItem(std::string_view collection) {
    if (collection == "accessors") return {{"componentType", 5126}, {"count", 0}, {"type", "SCALAR"}};
    if (collection == "animations") return {{"channels", Json::array()}, {"samplers", Json::array()}};
    if (collection == "bufferViews") return {{"buffer", 0}, {"byteLength", 0}};
    if (collection == "buffers") return {{"byteLength", 0}, {"uri", "data:,"}};
    if (collection == "cameras")
        return {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 1.0}}}};
    if (collection == "KHR_lights_punctual") return {{"type", "point"}};
    if (collection == "meshes") return {{"primitives", Json::array()}};
    if (collection == "skins") return {{"joints", Json::array()}};
    return Json::object();
}

}  // namespace

std::map<std::size_t, std::string> leaveOutUnusable(Json& document, const References& references,
                                                    NoteList& notes) {
    std::map<std::string, std::set<std::size_t>> gone;  // by collection
    std::map<std::size_t, std::string> meshes;
    for (const References::Fault& fault : references.unusable()) {
        const bool light = fault.collection == "KHR_lights_punctual";
        Json& items = light ? document["extensions"][fault.collection]["lights"]
                            : document[std::string(fault.collection)];
        items[fault.item] = emptyItem(fault.collection);
        gone[std::string(fault.collection)].insert(fault.item);
        if (fault.collection == "meshes") meshes.emplace(fault.item, fault.line);
        notes.add(fault.cause ? fault.line + ": left out"
                              : fmt::format("{} {}: left out, it needs {}",
                                            light ? "light" : schema::itemOf(fault.collection), fault.item,
                                            fault.line));
    }
    for (const auto& [key, collection] : {std::pair("camera", "cameras"), {"skin", "skins"}})
        if (gone.contains(collection) && document.contains("nodes"))
            for (Json& node : document["nodes"])
                if (node.contains(key) && gone[collection].contains(node[key].get<std::size_t>()))
                    node.erase(key);
    return meshes;
}

}  // namespace diptych::gltf
