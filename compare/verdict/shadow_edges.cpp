// SPDX-License-Identifier: MIT
#include "compare/verdict/shadow_edges.h"

#include "shared/contract/debug_mode.h"

#include <algorithm>

namespace diptych {

ShadowEdges::ShadowEdges(const FramePair& pair) {
    if (!pair.hasReference()) return;
    reference_ = &pair.reference();
    path_ = &pair.path();
    depth_ = findChannel(*path_, Channel::depth);
    level_ = findChannel(*path_, Channel::cascade);
    coarser_ = findChannel(*path_, Channel::page_residency);
    const bool by_depth = !path_->shadow_filter_radii.empty() && depth_ != nullptr,
               by_level =
                   !path_->shadow_level_filter_radii.empty() && level_ != nullptr && coarser_ != nullptr;
    sun_ = !reference_->shadow_edge.empty() && (by_depth || by_level);
    if (!reference_->local_shadow_edge.empty() && path_->local_shadow_filter_radius > 0)
        local_ = &reference_->local_shadow_edge;
}

const ShadowFilterRadius& ShadowEdges::filterRadius(std::size_t pixel) const {
    if (!path_->shadow_level_filter_radii.empty()) {
        const float level = *level_->pixel(pixel) + *coarser_->pixel(pixel);
        return path_->shadow_level_filter_radii.at(static_cast<std::size_t>(std::max(level, 0.0f)));
    }
    const double depth{*depth_->pixel(pixel)};
    const auto found = std::ranges::find_if(
        path_->shadow_filter_radii, [&](const ShadowFilterRadius& valid) { return depth <= valid.depth; });
    return found == path_->shadow_filter_radii.end() ? path_->shadow_filter_radii.back() : *found;
}

bool ShadowEdges::isNearLocal(std::size_t pixel) const {
    return local_ && double{local_->pixel(pixel)[0]} <= path_->local_shadow_filter_radius;
}

double ShadowEdges::allowed(const DebugMode& mode, std::size_t pixel) const {
    const bool sun = isNear(pixel), local = isNearLocal(pixel);
    if (mode.channel == Channel::shadow_visibility) return sun ? 1 : 0;
    if (mode.channel == Channel::local_visibility) return local ? 1 : 0;
    if (sourceOf(mode.channel).stage != ChannelStage::light) return 0;
    return (sun ? double{reference_->shadow_edge.pixel(pixel)[1]} : 0) +
           (local ? double{local_->pixel(pixel)[1]} : 0);
}

}  // namespace diptych
