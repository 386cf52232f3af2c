// SPDX-License-Identifier: MIT
// Which Settings can be rendered, and in words why the others cannot.
#include "shared/frame/settings.h"

#include <fmt/format.h>

namespace diptych {
namespace {

// Settings of which only the usual value can be rendered, and why. They are looked at in the order of
// Settings::fields(), so "without --env" is said only where --env is none.
struct Fixed {
    std::string_view option, why;
};
constexpr std::string_view not_built = "is not built yet";
constexpr std::string_view needs_evsm = "has no meaning without --shadows evsm";
constexpr std::string_view needs_reference = "has no meaning without --path reference";
constexpr Fixed fixed[] = {
    {"assign", not_built},
    {"time", not_built},
    {"env", not_built},
    {"ibl-intensity", "has no meaning without --env"},
    {"ambient", not_built},
    {"light-cutoff", not_built},
    {"pixel-lights", "has no meaning without --assign per_object"},
    {"area-lights", not_built},
    {"shadows", not_built},
    {"shadow-lights", not_built},
    {"evsm-precision", needs_evsm},
    {"evsm-exponent", needs_evsm},
    {"evsm-bleed", needs_evsm},
    {"evsm-min-variance", needs_evsm},
    {"msaa", not_built},
    {"haze", not_built},
    {"spp", needs_reference},
    {"reference-mode", needs_reference},
};

// Largest side of a picture: what every Vulkan 1.3 device in use has as maxImageDimension2D, or more.
constexpr int max_side = 16384;

}  // namespace

std::optional<std::string> Settings::problem() const {
    if (path == Path::reference)
        return fmt::format("--path reference {}; use deferred or forward_plus", not_built);
    if (size.width < 1 || size.height < 1 || size.width > max_side || size.height > max_side)
        return fmt::format("--size {}: width and height are 1 to {}", valueOf(*this, "size"), max_side);
    if (msaa != 1 && msaa != 4) return fmt::format("--msaa {}: a pixel has 1 or 4 samples", msaa);

    const Settings usual;
    for (const Fixed& setting : fixed) {
        const std::string value = valueOf(*this, setting.option);
        const std::string expected = valueOf(usual, setting.option);
        if (value != expected)
            return fmt::format("--{} {} {}; use {}", setting.option, value, setting.why, expected);
    }
    return std::nullopt;
}

}  // namespace diptych
