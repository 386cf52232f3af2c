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

// Which items of a document's collections name which, and which of them are broken. What is broken and no
// scene needs may be left out; what a scene needs may not.
class References {
public:
    // The collections as they are sized in the document, the lights of KHR_lights_punctual among them.
    explicit References(const nlohmann::json& document);

    // Items of a collection, as the file has them; the lights' is called KHR_lights_punctual.
    std::size_t count(std::string_view collection) const;

    // From enter to leave, indices that are met belong to this item.
    void enter(std::string_view collection, std::size_t item);
    void leave() { current_ = none; }
    bool inside() const { return current_ != none; }
    void names(std::string_view collection, std::size_t item);

    // The item cannot be read: "accessor 3: count is -1, not at least 0". The first line stays.
    void broken(std::string_view collection, std::size_t item, std::string line);

    // An item that stands for nothing: broken itself, or in need of one that is, and why.
    struct Fault {
        std::string_view collection;
        std::size_t item;
        std::string line;
        bool cause;  // broken itself
    };

    // Everything that is of no use, in the order in which its causes were found. Throws std::runtime_error
    // with the first cause that a scene needs (or, in a file without scenes, a node).
    std::vector<Fault> unusable() const;

private:
    using Id = std::uint32_t;  // of an item among those of all collections
    static constexpr Id none = ~Id(0);
    struct Collection {
        std::string_view name;
        Id first = 0;
        std::size_t count = 0;
    };
    std::vector<Collection> collections_;
    Id items_ = 0;
    Id current_ = none;
    std::vector<std::pair<Id, Id>> edges_;            // named, who names it
    std::vector<std::pair<Id, std::string>> broken_;  // in the order in which they were found
    std::map<Id, std::size_t> place_;                 // in broken_

    const Collection& find(std::string_view name) const;
};

}  // namespace diptych::gltf
