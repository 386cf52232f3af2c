// SPDX-License-Identifier: MIT
// The estimate of host memory for Frames, and the requests it refuses.
#include "compare/render/host_memory.h"

#include "compare/verdict/pair_reports.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/scene/builtin/builtin.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace diptych {
namespace {

constexpr double megabyte = 1 << 20;

Settings settingsOf(Path path, Size size, int msaa = 1) {
    Settings settings;
    settings.path = path;
    settings.size = size;
    settings.msaa = msaa;
    return settings;
}

RenderOptions channels(bool all) {
    RenderOptions options;
    options.runs = 0;
    options.channels = {Channel::lit, Channel::material_id};
    if (all) {
        options.channels.clear();
        for (const DebugMode& mode : debugModes()) options.channels.push_back(mode.channel);
    }
    return options;
}

// Largest resident sets of commands on lavapipe 22.3, MiB, minus the process's size after loading the
// scene: 76 with builtin:triangle, 110 with builtin:gallery.
TEST(HostMemory, IsAboutWhatCommandsTake) {
    struct Measured {
        const char* what;
        bool compare, all, sun;
        Path path;
        Size size;
        int msaa, scene, peak;
    };
    const Size hd{1920, 1080}, uhd{3840, 2160}, small{640, 360};
    for (const Measured& m : {Measured{"render", false, false, false, Path::forward_plus, hd, 1, 76, 266},
                              {"render", false, false, false, Path::deferred, hd, 1, 76, 304},
                              {"render", false, true, false, Path::forward_plus, hd, 1, 76, 512},
                              {"render", false, false, false, Path::forward_plus, hd, 4, 76, 550},
                              {"render", false, false, false, Path::deferred, hd, 4, 76, 780},
                              {"render", false, false, false, Path::forward_plus, uhd, 1, 76, 767},
                              {"render", false, true, false, Path::forward_plus, uhd, 1, 76, 1411},
                              {"render", false, true, true, Path::forward_plus, small, 1, 110, 497},
                              {"render", false, true, true, Path::forward_plus, hd, 1, 110, 831},
                              {"render", false, true, true, Path::forward_plus, uhd, 1, 110, 1709},
                              {"compare", true, false, false, Path::deferred, hd, 1, 76, 704},
                              {"compare", true, false, false, Path::deferred, uhd, 1, 76, 1771},
                              {"compare", true, true, false, Path::deferred, hd, 1, 76, 718},
                              {"compare", true, true, false, Path::deferred, uhd, 1, 76, 1770},
                              {"compare", true, false, false, Path::deferred, hd, 4, 76, 1301},
                              {"compare", true, false, false, Path::deferred, uhd, 4, 76, 4657},
                              {"compare", true, true, true, Path::deferred, small, 1, 110, 588},
                              {"compare", true, true, true, Path::deferred, hd, 1, 110, 1066},
                              {"compare", true, false, true, Path::deferred, uhd, 1, 110, 2159},
                              {"compare", true, true, true, Path::deferred, hd, 4, 110, 1750}}) {
        std::vector<Settings> settings{settingsOf(m.path, m.size, m.msaa)};
        RenderOptions options = channels(m.all);
        if (m.compare) {
            settings.push_back(settingsOf(Path::forward_plus, m.size, m.msaa));
            options = evaluatedOptions(options, settings, false, false);
        }
        const double estimate =
            m.scene + static_cast<double>(hostMemory(settings, withoutAbsentLayers(options, 0), true, m.sun,
                                                     m.sun ? 41 : 1)) /
                          megabyte;
        EXPECT_GT(estimate / m.peak, 0.7) << m.what << (m.all ? " all " : " lit ") << m.size.width << " "
                                          << m.msaa << ": " << estimate << " of " << m.peak;
        EXPECT_LT(estimate / m.peak, 1.5) << m.what << (m.all ? " all " : " lit ") << m.size.width << " "
                                          << m.msaa << ": " << estimate << " of " << m.peak;
    }
}

TEST(HostMemory, OfAGpuItIsImagesAlone) {
    const std::vector<Settings> one{settingsOf(Path::deferred, {1920, 1080}, 4)};
    const std::uint64_t images = hostMemory(one, channels(false), false, true, 1);
    EXPECT_EQ(images, std::uint64_t{60} * 1920 * 1080);
    EXPECT_LT(images, hostMemory(one, channels(false), true, true, 1));
    // Timed frames are in memory together; frames drawn once are not.
    RenderOptions timed = channels(false);
    const std::vector<Settings> many(20, one.front());
    EXPECT_EQ(hostMemory(many, timed, true, true, 1), hostMemory(one, timed, true, true, 1));
    timed.runs = 5;
    EXPECT_GT(hostMemory(many, timed, true, true, 1), 3 * hostMemory(one, timed, true, true, 1));
    EXPECT_EQ(hostMemory(many, timed, false, true, 1), hostMemory(one, timed, false, true, 1));
}

TEST(HostMemory, WhatIsRefusedSaysWhatHelps) {
    const Scene scene = makeBuiltin("triangle");
    SceneViews views(scene);
    std::vector<Settings> settings{settingsOf(Path::deferred, {16000, 16000}, 4)};
    const std::uint64_t needed =
        hostMemory(settings, withoutAbsentLayers(channels(true), 0), true, false, scene.materials.size());
    int asked = 0;
    const auto free = [&](std::uint64_t bytes) {
        return [&asked, bytes] {
            ++asked;
            return FreeMemory{bytes, "a cgroup"};
        };
    };
    EXPECT_EQ(checkHostMemory(views, settings, channels(true), true, 0, free(UINT64_MAX)), needed);
    EXPECT_NO_THROW(checkHostMemory(views, settings, channels(true), true, 0, free(needed)));
    const auto line = [&](bool all) -> std::string {
        try {
            checkHostMemory(views, settings, channels(all), true, 0, free(2'000'000'000));
            return "was granted";
        } catch (const std::runtime_error& error) {
            return error.what();
        }
    };
    EXPECT_NE(line(true).find("triangle at 16000x16000: needs about "), std::string::npos) << line(true);
    EXPECT_NE(
        line(true).find(" GB, but only 2.0 GB are free (a cgroup); a smaller --size or fewer --channels or "
                        "--msaa 1 needs less"),
        std::string::npos)
        << line(true);
    EXPECT_EQ(line(false).find("--channels"), std::string::npos) << line(false);
    settings.push_back(settings.front());
    settings.back().time = 1;
    settings.front().msaa = settings.back().msaa = 1;
    EXPECT_NE(line(false).find("a smaller --size or fewer cameras and times needs less"), std::string::npos)
        << line(false);
    // Memory that was checked before is not checked again.
    asked = 0;
    EXPECT_NO_THROW(checkHostMemory(views, settings, channels(true), true, UINT64_MAX, free(0)));
    EXPECT_EQ(asked, 0);
}

}  // namespace
}  // namespace diptych
