// SPDX-License-Identifier: MIT
#include "shared/frame/debug_modes.h"

#include "shared/contract/debug_mode.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace diptych {
namespace {

constexpr DebugMode modes[] = {
#define DIPTYCH_DEBUG_ROW(number, name, width, metric, kind, domain, maker, shows) \
    {number, #name, width, Metric::metric, ChannelKind::kind, Domain::domain, MadeBy::maker, shows},
    DEBUG_MODES(DIPTYCH_DEBUG_ROW)
#undef DIPTYCH_DEBUG_ROW
};

}  // namespace

std::span<const DebugMode> debugModes() {
    return modes;
}

const DebugMode* findDebugMode(std::string_view nameOrNumber) {
    int number = -1;
    const char* end = nameOrNumber.data() + nameOrNumber.size();
    const auto [rest, error] = std::from_chars(nameOrNumber.data(), end, number);
    const bool isNumber = error == std::errc() && rest == end;
    const auto found = std::ranges::find_if(modes, [&](const DebugMode& mode) {
        return isNumber ? mode.number == number : mode.name == nameOrNumber;
    });
    return found == std::end(modes) ? nullptr : &*found;
}

const DebugMode& debugMode(int number) {
    const auto found = std::ranges::find(modes, number, &DebugMode::number);
    if (found == std::end(modes)) throw std::out_of_range("debug mode " + std::to_string(number));
    return *found;
}

std::string_view nameOf(Metric metric) {
    switch (metric) {
        case Metric::relative:
            return "relative";
        case Metric::absolute:
            return "absolute";
        case Metric::angular:
            return "angular";
        case Metric::axial:
            return "axial";
        case Metric::exact:
            return "exact";
    }
    return "?";
}

std::vector<std::string> exrChannels(const DebugMode& mode) {
    if (mode.number == gpu::DEBUG_lit) return {"R", "G", "B"};
    if (mode.number == gpu::DEBUG_depth) return {"Z"};
    const std::string_view letters = mode.kind == ChannelKind::color    ? "RGB"
                                     : mode.kind == ChannelKind::vector ? "XYZ"
                                                                        : "Y";
    std::vector<std::string> channels;
    for (const char letter : letters.substr(0, static_cast<std::size_t>(mode.width)))
        channels.push_back(std::string(mode.name) + "." + letter);
    return channels;
}

}  // namespace diptych
