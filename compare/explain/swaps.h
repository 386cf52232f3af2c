// SPDX-License-Identifier: MIT
// The ablation experiment: the causes, and lit of the test with any of them taken from the baseline.
#pragma once

#include "compare/explain/channel_lighting.h"
#include "compare/explain/explained_sides.h"
#include "compare/explain/lighting_stages.h"
#include "compare/explain/shapley.h"
#include "compare/explain/undeclared_settings.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/image.h"
#include "shared/scene/model/scene.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace diptych {

// A cause: a property that can be taken from either side.
struct Swap {
    enum class Kind { channel, rest, stage, exposure, setting };
    Kind kind;
    // Of a channel: index into surfaceChannels(); of a stage: index into LightingStages::stages().
    std::size_t place = 0;
    std::string name, shows;  // "normals", or a Setting's option; description

    std::string title() const { return (kind == Kind::setting ? "--" : "") + name; }
};

// The constructor arguments must outlive it.
class Swaps {
public:
    // `undeclared`: undeclared Settings of the test. Throws std::runtime_error, one line, if there are more
    // than mostCauses causes.
    Swaps(const ExplainedSides& sides, ChannelLighting& lighting, const Scene& scene,
          std::span<const UndeclaredSetting> undeclared);

    const std::vector<Swap>& causes() const { return causes_; }
    // Channels that differ and change no pixel, alone or after all others: not causes.
    const std::vector<std::string>& inert() const { return inert_; }
    // The lighting component of a cause; nullptr for other causes.
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
