// SPDX-License-Identifier: MIT
// The experiment: what the two sides differ in, and lit of the test with any of it taken from the baseline.
#pragma once

#include "compare/explain/channel_lighting.h"
#include "compare/explain/explained_sides.h"
#include "compare/explain/lighting_stages.h"
#include "compare/explain/shapley.h"
#include "compare/explain/unsaid_settings.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// A cause, as something that can be taken from either side.
struct Swap {
    enum class Kind { channel, rest, stage, exposure, setting };
    Kind kind;
    std::size_t place = 0;    // of a channel, in surfaceChannels()
    std::string name, shows;  // "normals", of a Setting its option; what it is, in words

    std::string title() const { return (kind == Kind::setting ? "--" : "") + name; }
};

// What it is made of must outlive it.
class Swaps {
public:
    // `unsaid`: Settings of the test that it does not say. Throws std::runtime_error, one line, where there
    // are more causes than shares are known of.
    Swaps(const ExplainedSides& sides, ChannelLighting& lighting, const Scene& scene,
          std::span<const UnsaidSetting> unsaid);

    const std::vector<Swap>& causes() const { return causes_; }
    // Channels that differ and change no pixel, alone and when all others are swapped: they are no cause.
    const std::vector<std::string>& inert() const { return inert_; }
    // The stage of lighting that a cause is; nullptr: it is something else.
    const LightingStages::Stage* stageOf(const Swap& cause) const;

    // lit of the test with a subset of the causes taken from the baseline, W x H x 3.
    Image lit(Subset subset);

private:
    std::string shownBy(const DebugMode& mode) const;
    void findChannels();
    void findStages(const Scene& scene);

    const ExplainedSides& sides_;
    ChannelLighting& lighting_;
    std::vector<Swap> causes_;
    std::vector<std::string> inert_;
    std::optional<LightingStages> stages_;
};

}  // namespace diptych
