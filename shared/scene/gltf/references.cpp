// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/references.h"

#include "shared/scene/gltf/value.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace diptych::gltf {

namespace {

using Json = nlohmann::json;

constexpr std::string_view lightCollection = "KHR_lights_punctual";

constexpr std::array<std::string_view, 14> collectionNames{
    "accessors", "animations", "bufferViews", "buffers",  "cameras", "images", lightCollection,
    "materials", "meshes",     "nodes",       "samplers", "scenes",  "skins",  "textures"};

// A value that is not an array counts as empty; the schema reports it.
std::size_t sizeIn(const Json& document, std::string_view name) {
    const std::string location(name);
    return arrayAt(document, name == lightCollection ? "/extensions/" + location + "/lights" : "/" + location)
        .size();
}

}  // namespace

References::References(const Json& document) {
    std::size_t items = 0;
    for (const std::string_view name : collectionNames) {
        collections_.push_back({name, static_cast<Id>(items), sizeIn(document, name)});
        items += collections_.back().count;
    }
    // Unreachable within the limit on JSON (limits.h), because an item takes at least two bytes.
    if (items >= none) throw std::runtime_error("has more objects than 32-bit indices can address");
    items_ = static_cast<Id>(items);
}

const References::Collection& References::find(std::string_view name) const {
    return *std::ranges::find(collections_, name, &Collection::name);
}

std::size_t References::count(std::string_view collection) const {
    return find(collection).count;
}

void References::enter(std::string_view collection, std::size_t item) {
    current_ = find(collection).first + static_cast<Id>(item);
}

void References::names(std::string_view collection, std::size_t item) {
    if (inside()) edges_.emplace_back(find(collection).first + static_cast<Id>(item), current_);
}

void References::broken(std::string_view collection, std::size_t item, std::string line) {
    const Id id = find(collection).first + static_cast<Id>(item);
    if (index_.emplace(id, broken_.size()).second) broken_.emplace_back(id, std::move(line));
}

std::vector<References::Fault> References::unusable() const {
    if (broken_.empty()) return {};
    const Collection& roots = find(count("scenes") ? "scenes" : "nodes");
    std::vector<std::pair<Id, Id>> edges = edges_;
    std::ranges::sort(edges);
    std::vector<bool> seen(items_, false);
    std::vector<Fault> faults;
    for (const auto& [cause, line] : broken_) {
        std::vector<Id> waiting{cause};
        while (!waiting.empty()) {
            const Id id = waiting.back();
            waiting.pop_back();
            if (seen[id]) continue;
            seen[id] = true;
            if (id >= roots.first && id - roots.first < roots.count) throw std::runtime_error(line);
            const auto after = std::ranges::upper_bound(collections_, id, {}, &Collection::first);
            // An empty collection begins where the next one does. So the id belongs to the last collection
            // that begins at or before it.
            const Collection& owner = *std::prev(after);
            faults.push_back({owner.name, id - owner.first, line, id == cause});
            for (auto edge = std::ranges::lower_bound(edges, std::pair{id, Id(0)});
                 edge != edges.end() && edge->first == id; ++edge)
                waiting.push_back(edge->second);
        }
    }
    return faults;
}

}  // namespace diptych::gltf
