// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych::gltf {

// Records references between items of a document's collections, and broken items. A broken item is omitted
// unless a scene needs it; then loading fails.
class References {
public:
    // Reads the sizes of the collections from the document, including the lights of KHR_lights_punctual.
    explicit References(const nlohmann::json& document);

    // Number of items of a collection. The lights' collection is called KHR_lights_punctual.
    std::size_t count(std::string_view collection) const;

    // References recorded between enter() and leave() belong to this item.
    void enter(std::string_view collection, std::size_t item);
    void leave() { current_ = none; }
    bool inside() const { return current_ != none; }
    void names(std::string_view collection, std::size_t item);

    // Marks the item as unusable, with a reason: "accessor 3: count is -1, not at least 0". The first
    // reason counts.
    void broken(std::string_view collection, std::size_t item, std::string line);

    // An item that is broken, or that refers to a broken one, and the reason.
    struct Fault {
        std::string_view collection;
        std::size_t item;
        std::string line;
        bool cause;  // broken itself
    };

    // All unusable items, in the order in which their causes were found. Throws std::runtime_error with
    // the first cause that affects a scene (or, in a file without scenes, a node).
    std::vector<Fault> unusable() const;

private:
    using Id = std::uint32_t;  // index of an item, counted over all collections
    static constexpr Id none = ~Id(0);
    struct Collection {
        std::string_view name;
        Id first = 0;
        std::size_t count = 0;
    };
    std::vector<Collection> collections_;
    Id items_ = 0;
    Id current_ = none;
    std::vector<std::pair<Id, Id>> edges_;            // (item, item that refers to it)
    std::vector<std::pair<Id, std::string>> broken_;  // in order of discovery
    std::map<Id, std::size_t> index_;                 // index in broken_

    const Collection& find(std::string_view name) const;
};

}  // namespace diptych::gltf
