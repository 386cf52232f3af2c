// SPDX-License-Identifier: MIT
// Helpers for reading glTF values. All throw std::runtime_error that begins with `who`.
#pragma once

#include <tiny_gltf.h>

#include <tbb/parallel_for.h>

#include <cstddef>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

namespace diptych::gltf {

std::string firstLine(std::string_view text);

// Returns `index` if it is -1 or below `count`; otherwise throws "WHO: WHAT 7 of 3".
int checkedIndex(int index, std::size_t count, const std::string& who, const char* what);

// Numbers from an extension's object; `fallback` if the key is absent.
double numberIn(const tinygltf::Value& object, const char* key, double fallback, const std::string& who);
int indexIn(const tinygltf::Value& object, const char* key, int fallback, const std::string& who);
// Requires as many components as the fallback has.
std::vector<double> numbersIn(const tinygltf::Value& object, const char* key, std::vector<double> fallback,
                              const std::string& who);

// Applies NoteList's limit to the notes from `first` on: keeps the first ones and counts the rest.
void limitNotes(std::vector<std::string>& notes, std::size_t first, const std::string& what);

// The extension's object, or nullptr.
const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name);

// Why a buffer's bytes are missing or incomplete, for errors on reading: "buffer 1: a.bin: no such file".
// Empty if complete.
void setMissing(tinygltf::Buffer& buffer, std::string line);
const std::string& missing(const tinygltf::Buffer& buffer);

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
