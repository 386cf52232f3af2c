// SPDX-License-Identifier: MIT
// Finds which of two paths has the lower error against the reference, where, and by how much.
#pragma once

#include "compare/metrics/channel.h"
#include "shared/frame/debug_modes.h"
#include "shared/frame/frame.h"
#include "shared/image/image.h"
#include "shared/image/png.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace diptych {

// Error of one path against the reference, or of one path against the other.
struct PathError {
    ChannelStats stats;
    double relative_rmse = 0;  // of |t - r| / max(|r|, 1e-3 mean luminance)
    std::optional<double> flip;
};

// Pixels of one material.
struct MaterialError {
    int id = -1;
    std::string name;
    std::uint64_t pixels = 0;
    std::array<double, 2> mean{};  // mean error of each path
};

struct CloserPathChannel {
    const DebugMode* mode = nullptr;
    std::array<PathError, 2> paths;  // against the reference
    PathError between;               // second path against the first
    std::array<std::uint64_t, 2> closer_pixels{};
    std::uint64_t even_pixels = 0;  // pixels where both errors are equal
    // 0 or 1: the path with the lower mean error. -1: the difference is below the reference's uncertainty
    // or a thousandth of the lower error.
    int closer = -1;
    double by = 1;  // higher mean error over the lower one; infinite if that is 0
    // Materials by decreasing contribution to the difference of the two errors, at most eight.
    std::vector<MaterialError> materials;
    // First path's error minus the second's, by pixel; below 0 the first is closer.
    Image error_difference;
};

struct CloserPath {
    std::size_t reference = 0;
    std::array<std::size_t, 2> paths{};       // indices in Report::frames
    std::vector<CloserPathChannel> channels;  // those of litModes that all three have
};

// `names`: names of materials by id, may be short.
CloserPath closerPathOf(const std::vector<Frame>& frames, std::size_t reference,
                        std::array<std::size_t, 2> paths, const Coverage& coverage,
                        const std::vector<std::string>& names);

// "forward_plus is closer to the reference: mean error 1.2e-06 against 0.0012 (1000 times less), at 87 % of
// the pixels (deferred at 3 %)"
std::string closerPathLine(const CloserPath& closer, const CloserPathChannel& channel,
                           const std::vector<Frame>& frames);

// Blue where the first path is closer, orange where the second is. Brightness is the difference of their
// errors, full at `top`.
Image8 closerPathImage(const Image& error_difference, double top);
double closerPathTop(const Image& error_difference);  // 99th percentile of the non-zero values

}  // namespace diptych
