// SPDX-License-Identifier: MIT
#include "compare/explain/ablation.h"

#include "compare/explain/frame_images.h"
#include "compare/frames/frame_properties.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace diptych {

Ablation::Ablation(const ExplainedSides& sides, ChannelLighting& lighting, const Scene& scene,
                   std::span<const UndeclaredSetting> undeclared)
    : sides_(sides), lighting_(lighting) {
    findChannels();
    const std::string residual = sides.residualName();
    if (!residual.empty() && sides.residualsDiffer())
        causes_.push_back({AblationCause::Kind::residual, 0, residual,
                           "the part of lit that lighting a side's own channels does not reproduce"});
    if (residual.empty() && sides.residualsDiffer() && sides.haveTerms()) findComponents(scene);
    if (sides.exposure() != 1)
        causes_.push_back({AblationCause::Kind::exposure, 0, "exposure",
                           fmt::format("a factor of {:.4g} on all of lit", double{sides.exposure()})});
    // Last, so that subsets with equal Settings are consecutive: each change needs a frame.
    for (const Field& field : settingFields()) {
        const std::string_view option = field.option;
        const std::string before = sides.settings(0).valueOf(option), now = sides.settings(1).valueOf(option);
        if (before == now || std::ranges::count(settingsInChannels(), option) > 0) continue;
        const auto found = std::ranges::find(undeclared, option, &UndeclaredSetting::option);
        causes_.push_back(
            {AblationCause::Kind::setting, 0, std::string(option),
             found != undeclared.end() ? found->description : fmt::format("{} instead of {}", now, before)});
    }
    if (causes_.size() > static_cast<std::size_t>(maxCauses))
        throw std::runtime_error(
            fmt::format("{} causes exceed the limit of {}: explain two images with more similar Settings",
                        causes_.size(), maxCauses));
}

// Describes roughness widened by specular anti-aliasing, and normals changed by skinning.
std::string Ablation::descriptionOf(const DebugMode& mode) const {
    const bool widened = sides_.settings(1).spec_aa && !sides_.settings(0).spec_aa;
    if (widened && mode.name == "roughness")
        return fmt::format("{}, widened by normals (--spec-aa on --spec-aa-kernel {})", mode.shows,
                           nameOf(sides_.settings(1).spec_aa_kernel));
    const SkinNormals normals = sides_.settings(1).skin_normals;
    if (normals != sides_.settings(0).skin_normals && mode.name == "normals")
        return fmt::format("{}, of skins as by --skin-normals {}", mode.shows, nameOf(normals));
    return std::string(mode.shows);
}

void Ablation::findChannels() {
    // Channels that change no pixel, alone or after all others.
    std::vector<std::size_t> without_effect = lighting_.differing();
    for (const std::size_t side : {1, 0}) {
        const Settings& settings = sides_.settings(side);
        const std::uint32_t all = allChannelsOf(side);
        const Image whole = lighting_.lit(settings, all);
        std::erase_if(without_effect, [&](std::size_t channel) {
            return !sameBits(whole, lighting_.lit(settings, all ^ std::uint32_t{1} << channel));
        });
    }
    for (const std::size_t c : lighting_.differing()) {
        const DebugMode& mode = debugMode(surfaceChannels()[c]);
        if (std::ranges::count(without_effect, c) > 0)
            without_effect_.emplace_back(mode.name);
        else
            causes_.push_back({AblationCause::Kind::channel, c, std::string(mode.name), descriptionOf(mode)});
    }
}

// Finds the lighting components of the residual, if both sides have terms.
void Ablation::findComponents(const Scene& scene) {
    std::array<LitSurfaces, 2> own;
    for (std::size_t side = 0; side < 2; ++side)
        own.at(side) = lighting_.surfaces(sides_.settings(side), allChannelsOf(side));
    // Afterwards, because they need another frame.
    const bool blended = std::ranges::any_of(scene.materials, blends);
    for (std::size_t side = 0; side < 2; ++side) {
        Settings bare = sides_.settings(side);
        bare.transparency = Transparency::off;
        own.at(side).unblended = blended ? lighting_.lit(bare, allChannelsOf(side)) : own.at(side).lit;
    }
    components_.emplace(sides_.frame(0), sides_.frame(1), sides_.lit(1), own);
    for (std::size_t i = 0; i < components_->components().size(); ++i)
        causes_.push_back({AblationCause::Kind::component, i, components_->components()[i].name,
                           components_->components()[i].description});
}

const LightingComponents::Component* Ablation::componentOf(const AblationCause& cause) const {
    return cause.kind == AblationCause::Kind::component ? &components_->components()[cause.index] : nullptr;
}

Image Ablation::lit(Subset subset) {
    if (subset == 0) return channelOf(sides_.frame(1), Channel::lit);
    std::uint32_t channels = allChannelsOf(1);
    std::vector<bool> components(components_ ? components_->components().size() : 0);
    std::size_t residual = 1;
    Settings settings = sides_.settings(1);
    float exposure = sides_.exposure();
    for (std::size_t i = 0; i < causes_.size(); ++i) {
        if ((subset >> i & 1) == 0) continue;
        const AblationCause& cause = causes_[i];
        if (cause.kind == AblationCause::Kind::channel) channels &= ~(std::uint32_t{1} << cause.index);
        if (cause.kind == AblationCause::Kind::residual) residual = 0;
        if (cause.kind == AblationCause::Kind::component) components[cause.index] = true;
        if (cause.kind == AblationCause::Kind::setting)
            settings.set(cause.name, sides_.settings(0).valueOf(cause.name));
        if (cause.kind == AblationCause::Kind::exposure) exposure = 1;
    }
    Image lit;
    if (components_) {
        lit = components_->lit(lighting_.surfaces(settings, channels), components);
    } else {
        lit = lighting_.lit(settings, channels);
        const Image& added = sides_.residual(residual);
        for (std::size_t i = 0; i < lit.data.size(); ++i) lit.data[i] += added.data[i];
    }
    if (exposure != 1)
        for (float& value : lit.data) value *= exposure;
    return lit;
}

}  // namespace diptych
