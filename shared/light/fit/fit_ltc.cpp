// SPDX-License-Identifier: MIT
// fit_ltc FILE.exr: fits the table of linearly transformed cosines and writes it with its error. Run it by
// hand after the specular lobe of shaders/lib/shading/brdf.glsl changes, and copy the file to
// shared/light/ltc.exr.
#include "shared/image/exr.h"
#include "shared/light/fit/fit.h"
#include "shared/light/ltc.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <mutex>
#include <numeric>
#include <string>
#include <vector>

namespace {

using namespace diptych;

void writeTable(const std::string& file, const LtcTable& table) {
    constexpr int side = gpu::LTC_CELLS;
    std::vector<Image> images;
    for (const LtcLayer& layer : ltcLayers) {
        Image& image = images.emplace_back(side, side, 1);
        std::ranges::transform(table.cells, image.data.begin(),
                               [&](const LtcCell& c) { return layer.from(c); });
    }
    std::vector<ExrLayerView> layers;
    for (std::size_t i = 0; i < images.size(); ++i)
        layers.push_back({{std::string(ltcLayers[i].name) + ".Y"}, &images[i]});
    writeExr(file, layers,
             {{"comments", "Linearly transformed cosines; shared/contract/ltc.h says what they are."}});
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "fit_ltc: takes one argument, the output file: fit_ltc shared/light/ltc.exr\n");
        return 2;
    }
    try {
        std::mutex printing;
        int said = 0;
        const diptych::LtcTable table = diptych::ltc::fitTable([&](double fraction) {
            const std::lock_guard lock(printing);
            if (const int percent = static_cast<int>(fraction * 100); percent >= said + 5)
                fmt::print(stderr, "fit_ltc: {} %\n", said = percent);
        });
        writeTable(argv[1], table);
        for (const bool layer : {false, true}) {
            double sum = 0, largest = 0;
            for (const diptych::LtcCell& cell : table.cells) {
                const double error{(layer ? cell.layer : cell.even).error};
                sum += error;
                largest = std::max(largest, error);
            }
            fmt::print("{}: error of the {} lobe: mean {:.4f}, largest {:.4f}\n", argv[1],
                       layer ? "layer's" : "even", sum / static_cast<double>(table.cells.size()), largest);
        }
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "fit_ltc: {}\n", error.what());
        return 2;
    }
}
