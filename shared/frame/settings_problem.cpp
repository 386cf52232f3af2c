// SPDX-License-Identifier: MIT
// Which Settings can be rendered, and in words why the others cannot.
#include "shared/frame/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diptych {
namespace {

// Settings of which only the usual value can be rendered, and why.
struct Fixed {
    std::string_view option, why;
    std::string_view without = {};  // free where this option is not as usual
};
constexpr std::string_view not_built = "is not built yet";
constexpr std::string_view needs_evsm = "has no meaning without --shadows evsm";
constexpr std::string_view needs_reference = "has no meaning without --path reference";
constexpr Fixed fixed[] = {
    {"time", "is not built yet but in --path reference --reference-mode scene"},
    {"ibl-intensity", "has no meaning without --env", "env"},
    {"shadows", not_built},
    {"shadow-lights", not_built},
    {"evsm-precision", needs_evsm, "shadows"},
    {"evsm-exponent", needs_evsm, "shadows"},
    {"evsm-bleed", needs_evsm, "shadows"},
    {"evsm-min-variance", needs_evsm, "shadows"},
    {"msaa", not_built},
    {"haze", not_built},
    {"spp", needs_reference},
    {"reference-mode", needs_reference},
};

// Settings that change no bit of what a path draws.
struct Unread {
    std::string_view option;
    Path path;
    std::string_view why;
};
constexpr std::string_view only_reference = "the reference alone takes samples of what it shades";
constexpr std::string_view not_blended = "no path blends yet";
constexpr Unread unread[] = {
    {"assign", Path::reference, "the reference evaluates every light"},
    {"light-kernel", Path::reference, "the reference evaluates every light"},
    {"light-cutoff", Path::reference, "the reference lets every light go on as far as its range"},
    {"pixel-lights", Path::reference, "the reference evaluates every light"},
    {"prepass", Path::deferred, "deferred has no depth pre-pass"},
    {"prepass", Path::reference, "the reference has no depth pre-pass"},
    {"area-lights", Path::reference, "the reference integrates area lights"},
    {"gbuffer", Path::forward_plus, "forward_plus has no G-buffer"},
    {"gbuffer", Path::reference, "the reference has no G-buffer"},
    {"sort", Path::deferred, not_blended},
    {"sort", Path::forward_plus, not_blended},
    {"sort", Path::reference, "the reference blends by depth"},
    {"spp", Path::deferred, only_reference},
    {"spp", Path::forward_plus, only_reference},
    {"reference-mode", Path::deferred, only_reference},
    {"reference-mode", Path::forward_plus, only_reference},
};

// What the reference can, or has alone.
constexpr std::string_view in_reference[] = {"shadows", "spp", "reference-mode"};
constexpr std::string_view in_mode_scene[] = {"time"};

// More than that would take a day for a small picture.
constexpr int most_samples = 65536;

// Largest side of a picture: what every Vulkan 1.3 device in use has as maxImageDimension2D, or more.
constexpr int max_side = 16384;

}  // namespace

std::optional<std::string> Settings::problem() const {
    if (size.width < 1 || size.height < 1 || size.width > max_side || size.height > max_side)
        return fmt::format("--size {}: width and height are 1 to {}", valueOf(*this, "size"), max_side);
    if (msaa != 1 && msaa != 4) return fmt::format("--msaa {}: a pixel has 1 or 4 samples", msaa);

    if (spp < 1 || spp > most_samples) return fmt::format("--spp {}: 1 to {}", spp, most_samples);
    if (path == Path::reference && spp > 1 && reference_mode == ReferenceMode::surface)
        return fmt::format("--spp {}: --reference-mode surface shades one sample; use --reference-mode scene",
                           spp);
    if (!(time >= 0 && std::isfinite(time)))
        return fmt::format("--time {}: is finite and at least 0 s", time);
    if (env.empty()) return "--env '': names no file; use none";
    if (!(ibl_intensity >= 0 && std::isfinite(ibl_intensity)))
        return fmt::format("--ibl-intensity {}: is finite and at least 0", ibl_intensity);

    if (!(light_cutoff >= 0 && std::isfinite(light_cutoff)))
        return fmt::format("--light-cutoff {}: is finite and at least 0", light_cutoff);
    for (const float component : {ambient.r, ambient.g, ambient.b})
        if (!(component >= 0 && std::isfinite(component)))
            return fmt::format("--ambient {}: components are finite and at least 0",
                               valueOf(*this, "ambient"));
    if (assign == Assignment::per_object && path == Path::deferred)
        return "--assign per_object has no meaning with --path deferred: its G-buffer does not say which "
               "object a pixel "
               "is of; use --path forward_plus";
    if (pixel_lights < 0) return fmt::format("--pixel-lights {}: is at least 0", pixel_lights);
    if (assign != Assignment::per_object && pixel_lights != Settings().pixel_lights)
        return fmt::format("--pixel-lights {} has no meaning without --assign per_object; use {}",
                           pixel_lights, Settings().pixel_lights);
    if (assign == Assignment::tiled && path == Path::forward_plus && prepass == Switch::off)
        return "--assign tiled has no meaning with --prepass off: a tile's lights are chosen by its depths; "
               "use "
               "--prepass on";

    const Settings usual;
    const auto isUsual = [&](std::string_view option) {
        return valueOf(*this, option) == valueOf(usual, option);
    };
    for (const Fixed& setting : fixed) {
        if (path == Path::reference && std::ranges::count(in_reference, setting.option) > 0) continue;
        if (path == Path::reference && reference_mode == ReferenceMode::scene &&
            std::ranges::count(in_mode_scene, setting.option) > 0)
            continue;
        if (!setting.without.empty() && !isUsual(setting.without)) continue;
        const std::string value = valueOf(*this, setting.option);
        const std::string expected = valueOf(usual, setting.option);
        if (value != expected)
            return fmt::format("--{} {} {}; use {}", setting.option, value, setting.why, expected);
    }
    return std::nullopt;
}

std::string_view unreadBecause(Path path, std::string_view option) {
    for (const Unread& row : unread)
        if (row.path == path && row.option == option) return row.why;
    return {};
}

Settings readSettings(const Settings& settings) {
    Settings read = settings;
    const Settings usual;
    for (const Unread& row : unread)
        if (row.path == settings.path) set(read, row.option, valueOf(usual, row.option));
    return read;
}

}  // namespace diptych
