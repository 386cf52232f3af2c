// SPDX-License-Identifier: MIT
// Seeded edits of JSON. Values get other types, out-of-range numbers, wrong names, or too few or too many
// elements; keys and raw bytes change, too.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace diptych::fuzz {

class JsonMutator {
public:
    explicit JsonMutator(unsigned seed) : random_(seed) {}

    std::string mutated(const std::string& text) {
        nlohmann::ordered_json json = nlohmann::ordered_json::parse(text);
        for (std::size_t edits = 1 + below(3); edits > 0; --edits) edit(json);
        std::string bytes = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
        if (below(8) == 0) bytes.resize(below(bytes.size() + 1));
        if (below(8) == 0 && !bytes.empty()) bytes[below(bytes.size())] = static_cast<char>(below(256));
        if (below(64) == 0) bytes.insert(below(bytes.size() + 1), std::string(200000, '['));
        return bytes;
    }

private:
    using Json = nlohmann::ordered_json;

    std::size_t below(std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
    }

    Json hostile() {
        static const Json values[] = {nullptr,
                                      true,
                                      -1,
                                      0,
                                      1,
                                      2147483647,
                                      -2147483648LL,
                                      18446744073709551615ull,
                                      9223372036854775807LL,
                                      1e300,
                                      0.5,
                                      "",
                                      "/",
                                      "..",
                                      "../out.png",
                                      "/tmp/out.png",
                                      "a/../../b.json",
                                      "link/picture.png",
                                      "fifo.png",
                                      "index.html",
                                      std::string("a\0b.png", 7),
                                      "\xE2\x80\xAE.png",
                                      std::string(5000, 'x') + ".png",
                                      Json::array(),
                                      Json::object(),
                                      Json::array({Json::array({1, 2}), "x"}),
                                      {{"name", 1}}};
        return values[below(std::size(values))];
    }

    // A node of the tree, found by a random descent.
    Json& place(Json& json) {
        if (!json.is_structured() || json.empty() || below(5) == 0) return json;
        auto at = json.begin();
        std::advance(at, static_cast<std::ptrdiff_t>(below(json.size())));
        return place(*at);
    }

    void edit(Json& json) {
        Json& at = place(json);
        const std::size_t kind = below(4);
        if (kind == 0 && at.is_array() && !at.empty())
            at.erase(below(at.size()));
        else if (kind == 1 && at.is_array())
            at.push_back(at.empty() ? hostile() : Json(at[below(at.size())]));
        else if (kind == 2 && at.is_object() && !at.empty())
            at.erase(std::next(at.begin(), static_cast<std::ptrdiff_t>(below(at.size()))));
        else if (&at != &json || below(20) == 0)
            at = hostile();
    }

    std::mt19937 random_;
};

}  // namespace diptych::fuzz
