// SPDX-License-Identifier: MIT
// Images with blended surfaces, and their failures against the reference.
#pragma once

#include "compare/verdict/pair_reports.h"
#include "tests/image/scenes.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace diptych::tests {

inline Settings blendedImage() {
    Settings settings = smallImage(GBufferEncoding::full);
    settings.size = {96, 54};
    return settings;
}

inline glm::dvec3 litAt(const Frame& frame, int x, int y) {
    const Image& image = frame.channels.at(Channel::lit);
    return {double{image.at(x, y, 0)}, double{image.at(x, y, 1)}, double{image.at(x, y, 2)}};
}

inline Frame drawnBlended(Path path, const Scene& scene, const Settings& settings) {
    Renderer renderer(device(), scene, pipelines());
    return drawnBy(path, renderer, settings, {Channel::lit});
}

// Failures of both paths against the reference.
inline std::vector<std::string> failedChannels(const Scene& scene, Renderer& renderer,
                                               const Settings& settings) {
    Settings truth = settings;
    truth.path = Path::reference;
    truth.transparency = Transparency::sorted;
    RenderOptions options;
    options.channels = allChannels();
    options.runs = 0;
    std::vector<Frame> frames{renderer.draw(truth, options)};
    for (Frame& frame : bothPaths(renderer, settings)) frames.push_back(std::move(frame));
    const Requirements needs = requirements(scene, poseAt(scene, 0));
    const DeviceInfo& info = device().info();
    const Report report = makeReport({{std::move(frames), needs}}, {info.name, info.driver, info.type});
    std::vector<std::string> failed;
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}})
        for (const ChannelDiff& channel : report.comparisons.at(i).channels)
            if (channel.verdict == Verdict::fail)
                failed.push_back(fmt::format("{}: {}", channel.mode->name, channel.reason));
    return failed;
}
inline std::vector<std::string> failedChannels(const char* name, const Settings& settings) {
    return failedChannels(uploaded(name).scene, uploaded(name).renderer, settings);
}

}  // namespace diptych::tests
