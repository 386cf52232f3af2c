// SPDX-License-Identifier: MIT
#pragma once

#include "shared/scene/model/load_progress.h"
#include "shared/scene/model/scene.h"

#include <atomic>
#include <cstddef>

namespace diptych::gltf {

// Reports progress by counting completed pieces of work. Thread-safe.
class Tally {
public:
    Tally(std::size_t pieces, const char* step, const LoadProgress& progress)
        : pieces_(pieces), step_(step), progress_(progress) {}

    void oneMore() {
        const std::size_t done = ++done_;
        if (progress_) progress_(static_cast<double>(done) / static_cast<double>(pieces_), step_);
    }

private:
    std::size_t pieces_;
    const char* step_;
    const LoadProgress& progress_;
    std::atomic<std::size_t> done_ = 0;
};

}  // namespace diptych::gltf
