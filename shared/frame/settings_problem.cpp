// SPDX-License-Identifier: MIT
// Tells Settings that can be rendered from others, with messages why those cannot.
#include "shared/frame/settings.h"

#include "shared/frame/setting_rows.h"

#include <fmt/format.h>

namespace diptych {
namespace {

// Invalid combinations of several Settings. Rules about a single one are in its row.
using Rule = std::optional<std::string> (*)(const Settings&);

std::optional<std::string> surfacesHaveOneSample(const Settings& s) {
    if (!isReference(s.path) || s.reference_mode != ReferenceMode::surface || s.spp == 1) return {};
    return fmt::format("--spp {}: --reference-mode surface shades one sample; use --reference-mode scene",
                       s.spp);
}

std::optional<std::string> deferredKnowsNoObjects(const Settings& s) {
    if (!hasGBuffer(s.path) || s.assign != Assignment::per_object) return {};
    return "--assign per_object cannot be used with --path deferred: its G-buffer does not store the object; "
           "use --path forward_plus, or --forward-plus assign=per_object if both paths are rendered";
}

std::optional<std::string> tilesNeedDepths(const Settings& s) {
    if (!shadesFragments(s.path) || s.assign != Assignment::tiled || s.prepass != Switch::off) return {};
    return "--assign tiled cannot be used with --prepass off: it needs the depths of a tile; use --prepass "
           "on";
}

std::optional<std::string> storedDepthsAreShaded(const Settings& s) {
    const bool steps = s.depth_format == DepthFormat::d24 || s.depth_format == DepthFormat::d16;
    if (!shadesFragments(s.path) || s.prepass != Switch::off || !steps) return {};
    return fmt::format(
        "--depth-format {} cannot be used with --prepass off: shading needs the stored depth; use --prepass "
        "on",
        nameOf(s.depth_format));
}

std::optional<std::string> levelsHavePages(const Settings& s) {
    if (isReference(s.path) || s.shadows != Shadows::clipmap || s.shadow_size >= 4 * s.clipmap_page_size)
        return {};
    return fmt::format("--clipmap-page-size {}: four pages in a row exceed --shadow-size {}; use {}",
                       s.clipmap_page_size, s.shadow_size,
                       s.shadow_size < 128 ? "--shadow-size 128 or more" : "a smaller one");
}

std::optional<std::string> onlyTheReferenceWalks(const Settings& s) {
    if (isReference(s.path) || s.multiscatter != Multiscatter::walk) return {};
    return "--multiscatter walk: only the reference simulates it; use energy or fdez";
}

std::optional<std::string> sumsOfLayersHaveOneSample(const Settings& s) {
    const bool drawnOver = s.transparency == Transparency::sorted ||
                           s.transparency == Transparency::unsorted ||
                           s.transparency == Transparency::triangles || s.transparency == Transparency::off;
    if (isReference(s.path) || s.msaa == 1 || drawnOver) return {};
    return fmt::format(
        "--transparency {} with --msaa {}: it supports only one sample per pixel; use sorted, unsorted or "
        "triangles",
        nameOf(s.transparency), s.msaa);
}

constexpr Rule rules[] = {surfacesHaveOneSample,    deferredKnowsNoObjects, tilesNeedDepths,
                          storedDepthsAreShaded,    levelsHavePages,        onlyTheReferenceWalks,
                          sumsOfLayersHaveOneSample};

// "''" for an empty value.
std::string quotedValue(const Settings& settings, std::string_view option) {
    const std::string value = settings.valueOf(option);
    return value.empty() ? "''" : value;
}

}  // namespace

std::optional<std::string> Settings::valueProblem() const {
    for (const Field& field : settingFields())
        if (field.valid.check && !field.valid.check(*this))
            return fmt::format("--{} {}: {}", field.option, quotedValue(*this, field.option),
                               field.valid.are);
    return {};
}

std::optional<std::string> Settings::problem() const {
    if (auto wrong = valueProblem()) return wrong;
    for (const Rule& rule : rules)
        if (auto broken = rule(*this)) return broken;

    static const Settings defaults;
    std::optional<std::string> found;
    rows([&](const Field& field, auto member) {
        const DefaultOnly& only = field.default_only;
        if (found || only.because.empty() || this->*member == defaults.*member) return;
        if (only.unless && only.unless(*this)) return;
        found = fmt::format("--{} {} {}; use {}", field.option, valueOf(field.option), only.because,
                            defaults.valueOf(field.option));
    });
    return found;
}

}  // namespace diptych
