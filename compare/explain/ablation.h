// SPDX-License-Identifier: MIT
// The ablation experiment: the causes, and lit of the test with any of them taken from the baseline.
#pragma once

#include "compare/explain/channel_lighting.h"
#include "compare/explain/explained_sides.h"
#include "compare/explain/lighting_components.h"
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
struct AblationCause {
    enum class Kind { channel, residual, component, exposure, setting };
    Kind kind;
    // A channel's index into surfaceChannels(), or a component's into LightingComponents::components().
    std::size_t index = 0;
    std::string name, description;  // name: "normals", or a Setting's option

    std::string title() const { return (kind == Kind::setting ? "--" : "") + name; }
};

// The constructor arguments must outlive it.
class Ablation {
public:
    // `undeclared`: undeclared Settings of the test. Throws std::runtime_error, one line, if there are more
    // than maxCauses causes.
    Ablation(const ExplainedSides& sides, ChannelLighting& lighting, const Scene& scene,
             std::span<const UndeclaredSetting> undeclared);

    const ExplainedSides& sides() const { return sides_; }
    ChannelLighting& lighting() const { return lighting_; }
    const std::vector<AblationCause>& causes() const { return causes_; }
    // Channels that differ and change no pixel, alone or after all others: not causes.
    const std::vector<std::string>& without_effect() const { return without_effect_; }
    // The lighting component of a cause; nullptr for other causes.
    const LightingComponents::Component* componentOf(const AblationCause& cause) const;

    // lit of the test with a subset of the causes taken from the baseline, W x H x 3.
    Image lit(Subset subset);

private:
    std::string descriptionOf(const DebugMode& mode) const;
    void findChannels();
    void findComponents(const Scene& scene);

    const ExplainedSides& sides_;
    ChannelLighting& lighting_;
    std::vector<AblationCause> causes_;
    std::vector<std::string> without_effect_;
    std::optional<LightingComponents> components_;
};

}  // namespace diptych
