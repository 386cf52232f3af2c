// SPDX-License-Identifier: MIT
#include "compare/experiment/upsample.h"

#include "compare/metrics/channel.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace diptych::experiment {
namespace {

// A new pixel centre between two old pixel centres, on one axis.
struct Between {
    int low = 0, high = 0, nearest = 0;
    double part = 0;  // fraction of the way from low to high
};

std::vector<Between> betweenCentres(int from, int to) {
    std::vector<Between> all(static_cast<std::size_t>(to));
    for (int i = 0; i < to; ++i) {
        const double edge = (i + 0.5) * from / to;  // in old pixels, from the image's edge
        const double centre = std::clamp(edge - 0.5, 0.0, from - 1.0);
        Between& b = all[static_cast<std::size_t>(i)];
        b.low = static_cast<int>(centre);
        b.high = std::min(b.low + 1, from - 1);
        b.nearest = std::clamp(static_cast<int>(edge), 0, from - 1);
        b.part = centre - b.low;
    }
    return all;
}

const Image& channelOf(const Frame& frame, Channel channel) {
    if (const Image* const image = findChannel(frame, channel)) return *image;
    throw std::runtime_error(frame.name + ": has no channel " + std::string(debugMode(channel).name) +
                             " to resize");
}

// Samples an image at new pixel centres.
class Enlarger {
public:
    // `shown`: pixels with a surface or something blended.
    Enlarger(const Image& image, const Coverage& shown) : image_(image), shown_(shown) {}

    // The background stays 0, as in every channel.
    void put(const Between& x, const Between& y, float* to) const {
        if (!shows(x.nearest, y.nearest)) return;
        std::array<double, 3> sum{};
        double weights = 0;
        for (const auto& [row, down] : {std::pair{y.low, 1 - y.part}, {y.high, y.part}})
            for (const auto& [column, across] : {std::pair{x.low, 1 - x.part}, {x.high, x.part}}) {
                const double weight = down * across;
                if (weight == 0 || !shows(column, row)) continue;
                for (int c = 0; c < 3; ++c)
                    sum[static_cast<std::size_t>(c)] += weight * double{image_.at(column, row, c)};
                weights += weight;
            }
        for (std::size_t c = 0; c < 3; ++c) to[c] = static_cast<float>(sum[c] / weights);
    }

private:
    bool shows(int x, int y) const {
        return shown_.covered[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
                              static_cast<std::size_t>(x)] != 0;
    }

    const Image& image_;
    const Coverage& shown_;
};

}  // namespace

Frame upsampled(Frame frame, const Size& size) {
    const Image lit = channelOf(frame, Channel::lit), ids = channelOf(frame, Channel::material_id);
    if (frame.settings.size == size) return frame;
    const Coverage shown = coverage(frame, frame);
    const std::vector<Between> columns = betweenCentres(lit.width, size.width),
                               rows = betweenCentres(lit.height, size.height);
    const auto enlarged = [&](const Image& image) {
        if (image.empty()) return Image();
        const Enlarger enlarger(image, shown);
        Image result(size.width, size.height, 3);
        for (std::size_t y = 0, i = 0; y < rows.size(); ++y)
            for (std::size_t x = 0; x < columns.size(); ++x, ++i)
                enlarger.put(columns[x], rows[y], result.pixel(i));
        return result;
    };
    Image newIds(size.width, size.height, 1);
    for (std::size_t y = 0, i = 0; y < rows.size(); ++y)
        for (std::size_t x = 0; x < columns.size(); ++x, ++i)
            newIds.data[i] = ids.at(columns[x].nearest, rows[y].nearest);
    frame.unblended = enlarged(frame.unblended);
    frame.channels.clear();
    frame.channels[Channel::lit] = enlarged(lit);
    frame.channels[Channel::material_id] = std::move(newIds);
    frame.settings.size = size;
    return frame;
}

}  // namespace diptych::experiment
