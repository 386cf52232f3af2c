// SPDX-License-Identifier: MIT
// Reads the attributes of one primitive for the vertices that are kept.
#pragma once

#include "shared/scene/gltf/accessor.h"
#include "shared/scene/gltf/model.h"
#include "shared/scene/model/scene.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace diptych::gltf {

// Whether all components are finite and within maxCoordinate.
template <class Vec>
bool isUsable(const Vec& v) {
    for (int c = 0; c < Vec::length(); ++c)
        if (!(std::abs(static_cast<double>(v[c])) <= maxCoordinate)) return false;
    return true;
}

struct AttributeReader {
    const Model& model;
    const tinygltf::Primitive& file;
    const std::string& who;           // names the primitive in messages
    Selection which;                  // indices of the file's vertices that are kept
    std::vector<std::string>& notes;  // receives deviations from the file

    template <class... Args>
    void note(fmt::format_string<Args...> text, Args&&... args) const {
        notes.push_back(who + ": " + fmt::format(text, std::forward<Args>(args)...));
    }

    bool has(const std::string& name) const { return file.attributes.contains(name); }

    // Reads an attribute by read(model, accessor, who, which); empty if it is absent.
    template <class Vec, class Read>
    std::vector<Vec> read(const std::string& name, const Read& read) const {
        const auto at = file.attributes.find(name);
        if (at == file.attributes.end()) return {};
        return read(model, at->second, fmt::format("{}: {}", who, name), which);
    }

    // Replaces vectors that are not finite or beyond maxCoordinate by `instead`. Adds a note that ends in
    // `said`.
    template <class Vec>
    void repair(std::vector<Vec>& values, const Vec& instead, const std::string& name,
                const char* said) const {
        std::size_t broken = 0, finite = 0;
        for (Vec& v : values) {
            if (isUsable(v)) continue;
            ++broken;
            bool all = true;
            for (int c = 0; c < Vec::length(); ++c) all &= std::isfinite(v[c]);
            finite += all;
            v = instead;
        }
        const auto say = [&](std::size_t count, const std::string& what) {
            if (count)
                note("{}: {} {}: {} is used", name, count == 1 ? "1 is" : fmt::format("{} are", count), what,
                     said);
        };
        say(broken - finite, "not finite");
        say(finite, fmt::format("beyond {:g}", maxCoordinate));
    }
};

// deformation.cpp: joints and morph targets of a primitive (glTF 2.0, 3.7.3.3 and 3.7.2.2).

// Reads JOINTS_n and WEIGHTS_n for n = 0, 1, ... while present, and normalizes the weights. `joints`:
// joint count of the smallest skin that uses the primitive. `vertices`: file indices of the kept vertices,
// for messages. Throws std::runtime_error.
void readJointSets(const AttributeReader& reader, std::size_t joints, std::span<const std::uint32_t> vertices,
                   Primitive& primitive);

// Reads the morph targets; every primitive of the mesh has `count`. Reads deltas of POSITION, NORMAL,
// TANGENT, TEXCOORD_0, TEXCOORD_1 and COLOR_0 if the primitive has that attribute; omits others with a
// note. Throws std::runtime_error.
void readTargets(const AttributeReader& reader, std::size_t count, Primitive& primitive);

}  // namespace diptych::gltf
