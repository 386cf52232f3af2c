// SPDX-License-Identifier: MIT
// Helpers for reading glTF values. All throw std::runtime_error whose text begins with `who`.
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

// Returns `index` if it is -1 or names one of `count` objects; otherwise throws "WHO: WHAT 7 of 3".
int checkedIndex(int index, std::size_t count, const std::string& who, const char* what);

// Numbers from an extension's object; `fallback` where the key is absent.
double numberIn(const tinygltf::Value& object, const char* key, double fallback, const std::string& who);
int indexIn(const tinygltf::Value& object, const char* key, int fallback, const std::string& who);
std::vector<double> numbersIn(const tinygltf::Value& object, const char* key, std::vector<double> fallback,
                              const std::string& who);  // as many components as the fallback

// Applies NoteList's limit to the notes from `first` on: the first are kept, the others counted.
void limitNotes(std::vector<std::string>& notes, std::size_t first, const std::string& what);

// The extension's object, or nullptr.
const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name);

// The reason why a buffer's bytes are missing, or the last of them, for errors of whoever reads it: "buffer
// 1: a.bin: no such file". Empty: they are there.
void setMissing(tinygltf::Buffer& buffer, std::string line);
const std::string& missing(const tinygltf::Buffer& buffer);

// Calls run(i) for all i below `count` on all cores, then rethrows the failure with the lowest index.
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
