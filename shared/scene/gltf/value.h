// SPDX-License-Identifier: MIT
// Helpers for reading the document's JSON, also if it is not yet checked against the schema, and its indices.
#pragma once

#include "shared/scene/gltf/note_list.h"

#include <nlohmann/json_fwd.hpp>

#include <tbb/parallel_for.h>

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::gltf {

// The member `key`; nullptr if it is absent or `value` is not an object.
const nlohmann::json* memberOf(const nlohmann::json& value, std::string_view key);

// The array at a JSON pointer; empty if there is none.
const nlohmann::json& arrayAt(const nlohmann::json& document, const std::string& location);

// Element `index` of an array; null if it is absent.
const nlohmann::json& elementOf(const nlohmann::json& array, std::size_t index);

// The object of an extension of `owner`; nullptr if absent.
const nlohmann::json* extension(const nlohmann::json& owner, std::string_view name);
// Also removes it from `owner`; null if absent.
nlohmann::json takeExtension(nlohmann::json& owner, const char* name);

// Returns `value` if it is an index below `count`; otherwise throws std::runtime_error that begins with
// `who`.
int indexBelow(const nlohmann::json& value, std::size_t count, const std::string& who);

std::string firstLine(std::string_view text);

// Applies NoteList's limit to the notes from `first` on: keeps the first ones and counts the rest.
void limitNotes(std::vector<std::string>& notes, std::size_t first, const std::string& what);

// Calls `run`. The message of its std::runtime_error; empty if there is none.
template <class Run>
std::string faultOf(const Run& run) {
    try {
        run();
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return {};
}

// Calls `read`. If it throws, a note says so, and the scene lacks what `read` had not yet read.
template <class Read>
void readOrNote(NoteList& notes, const Read& read) {
    if (const std::string fault = faultOf(read); !fault.empty()) notes.add(fault + ": left out");
}

// Calls run(i) for i below `count` on all cores, then rethrows the exception with the lowest index.
template <class Run>
void forEachInParallel(std::size_t count, const Run& run) {
    std::vector<std::exception_ptr> failures(count);
    tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
        try {
            run(i);
        } catch (...) {
            failures[i] = std::current_exception();
        }
    });
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
}

}  // namespace diptych::gltf
