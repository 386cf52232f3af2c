// SPDX-License-Identifier: MIT
// Small readers that all of glTF's objects share. All throw std::runtime_error with `who` at its start.
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

// `index` if it names one of `count` objects; -1 stays -1. Otherwise "WHO: WHAT 7 of 3".
int checkedIndex(int index, std::size_t count, const std::string& who, const char* what);

// Members of an extension's object; `fallback` where there is none.
double numberIn(const tinygltf::Value& object, const char* key, double fallback, const std::string& who);
int indexIn(const tinygltf::Value& object, const char* key, int fallback, const std::string& who);
std::vector<double> numbersIn(const tinygltf::Value& object, const char* key, std::vector<double> fallback,
                              const std::string& who);  // as many as the fallback has

// Those of `notes` from `first` on as a NoteList keeps them: the first of each kind, the others counted.
void limitNotes(std::vector<std::string>& notes, std::size_t first, const std::string& what);

// The extension's object, or nullptr.
const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name);

// Why a buffer's bytes are not there, as whoever reads it is told: "buffer 1: a.bin: no such file". Empty:
// they are there.
void setMissing(tinygltf::Buffer& buffer, std::string line);
const std::string& missing(const tinygltf::Buffer& buffer);

// run(i) for i below `count` on all cores; then the first failure by index, whatever thread met it.
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
