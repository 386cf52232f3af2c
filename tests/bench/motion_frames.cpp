// SPDX-License-Identifier: MIT
// Cost of motion per frame: bench_motion_frames [-n RUNS] [SCENE [SECONDS]]
// Interleaves frames of both paths: complete, without deformation (with the existing pose, like a frame
// at rest), and deformation alone. Medians and spread. Complete minus deformation should equal the frame at
// rest.
#include "compare/frames/frame_properties.h"
#include "compare/render/prepared_view.h"
#include "shared/scene/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

using namespace diptych;

namespace {

struct Times {
    std::vector<double> ms;
    double median() {
        std::ranges::sort(ms);
        return ms[ms.size() / 2];
    }
    std::string text() {
        const double middle = median();
        return fmt::format("{:.3f} ({:.3f} to {:.3f})", middle, ms.front(), ms.back());
    }
};

// The deformation passes come first, under one name.
std::size_t posingPasses(const PassList& passes) {
    std::size_t count = 0;
    for (const DeclaredUse& use : passes.declarations())
        if (use.pass == "pose") count = std::max(count, use.number + 1);
    return count;
}

}  // namespace

int main(int count, char** arguments) try {
    std::vector<std::string> rest(arguments + 1, arguments + count);
    std::size_t runs = 51;
    if (rest.size() > 1 && rest[0] == "-n") {
        runs = std::max(1ul, std::stoul(rest[1]));
        rest.erase(rest.begin(), rest.begin() + 2);
    }
    if (rest.size() > 2) throw std::runtime_error("usage: bench_motion_frames [-n RUNS] [SCENE [SECONDS]]");
    const Scene scene = loadScene(rest.empty() ? "builtin:motion" : rest[0]);
    Device device(DeviceOptions{});
    SharedResources shared(device, scene);
    SceneViews views(scene);
    fmt::print("{}, {}, {} runs, ms: median (smallest to largest)\n", device.info().name, scene.name, runs);
    for (const Path path : {Path::deferred, Path::forward_plus})
        for (const Skinning skinning : {Skinning::compute, Skinning::vertex}) {
            Settings settings;
            settings.path = path;
            settings.skinning = skinning;
            settings.time = rest.size() > 1 ? std::stod(rest[1]) : 0.7;
            PreparedFrame frame(device, shared, views.at(viewRequest(settings)), settings);
            const std::size_t posing = posingPasses(frame.passes), all = frame.passes.size();
            frame.passes.run();
            Times whole, still, pose;
            for (std::size_t run = 0; run < runs; ++run) {
                whole.ms.push_back(frame.passes.run());
                still.ms.push_back(frame.passes.run(posing, all));
                if (posing > 0) pose.ms.push_back(frame.passes.run(0, posing));
            }
            const double posed = posing > 0 ? pose.median() : 0;
            fmt::print("{}, --skinning {}\n  whole     {}\n  at rest   {}\n", nameOf(path), nameOf(skinning),
                       whole.text(), still.text());
            if (posing > 0) fmt::print("  posing    {}\n", pose.text());
            fmt::print("  the whole without posing is {:.3f} of the frame at rest\n",
                       (whole.median() - posed) / still.median());
        }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_motion_frames: %s\n", e.what());
    return 2;
}
