// SPDX-License-Identifier: MIT
#pragma once

#include "shared/text/counted.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace diptych::gltf {

// Notes of one kind, which a file may cause in any number. Keeps the first ones, drops duplicates and
// counts the rest.
class NoteList {
public:
    // `about`: subject of the last line, as in "12 more notes about nodes".
    explicit NoteList(std::string about) : about_(std::move(about)) {}

    void add(std::string note) {
        if (std::find(notes_.begin(), notes_.end(), note) != notes_.end()) return;
        if (notes_.size() < shown)
            notes_.push_back(std::move(note));
        else
            ++more_;
    }

    void moveTo(std::vector<std::string>& notes) {
        for (std::string& note : notes_) notes.push_back(std::move(note));
        if (more_) notes.push_back(fmt::format("{} about {}", counted(more_, "more note"), about_));
        notes_.clear();
        more_ = 0;
    }

private:
    static constexpr std::size_t shown = 20;  // about one screen
    std::string about_;
    std::vector<std::string> notes_;
    std::size_t more_ = 0;
};

}  // namespace diptych::gltf
