// SPDX-License-Identifier: MIT
#include "compare/plot/labels.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace diptych {
namespace {

constexpr double gap = 7;  // between a point and its label
constexpr int distances = 6;
// In order of preference. Along a falling step line, above right and below left are free.
constexpr std::array<std::pair<int, int>, 8> directions{
    {{1, -1}, {-1, 1}, {1, 1}, {-1, -1}, {0, -1}, {0, 1}, {1, 0}, {-1, 0}}};

constexpr double between = 4;  // two labels

PlotBox grown(PlotBox box) {
    return {box.left - between, box.top - between, box.right + between, box.bottom + between};
}

double overlap(const PlotBox& a, const PlotBox& b) {
    const double across = std::min(a.right, b.right) - std::max(a.left, b.left),
                 down = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
    return std::max(across, 0.0) * std::max(down, 0.0);
}

PlotBox boxOf(const Label& label, std::pair<int, int> direction, int distance, const PlotBox& area) {
    const double far = gap + distance * label.height, across = label.width / 2, down = label.height / 2;
    // The label's centre, so that its nearest edge or corner has the given distance from the point,
    // clamped to the area.
    const double x = std::max(std::min(label.x + direction.first * (far + across), area.right - across),
                              area.left + across),
                 y = std::max(std::min(label.y + direction.second * (far + down), area.bottom - down),
                              area.top + down);
    return {x - across, y - down, x + across, y + down};
}

}  // namespace

std::vector<PlotBox> positionLabels(const std::vector<Label>& labels, const std::vector<PlotBox>& marks,
                                    const PlotBox& area) {
    std::vector<PlotBox> placed;
    for (const Label& label : labels) {
        PlotBox best{};
        double min = std::numeric_limits<double>::infinity();
        for (int distance = 0; distance < distances; ++distance)
            for (std::size_t d = 0; d < directions.size(); ++d) {
                const PlotBox box = boxOf(label, directions[d], distance, area);
                const double room = label.width * label.height;
                // Each criterion outweighs all weaker ones together.
                double cost = distance + 0.01 * static_cast<double>(d);
                for (const PlotBox& other : placed) cost += 1e3 * overlap(box, grown(other)) / room;
                for (const PlotBox& mark : marks) cost += 10 * overlap(box, mark) / room;
                if (cost >= min) continue;
                min = cost;
                best = box;
            }
        placed.push_back(best);
    }
    return placed;
}

}  // namespace diptych
