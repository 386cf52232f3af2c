// SPDX-License-Identifier: MIT
#include "shared/frame/debug_modes.h"

#include "shared/contract/debug_mode.h"
#include "shared/contract/gbuffer.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace diptych {

std::span<const DebugMode> debugModes() {
    using namespace gpu;  // the bits of G-buffers
    static constexpr DebugMode modes[] = {
#define DIPTYCH_DEBUG_ROW(index, name, width, errorKind, kind, domain, supported_by, shows, stage, step, \
                          code, standard, compact, part, texels, related)                                \
    {Channel::name,                                                                                      \
     #name,                                                                                              \
     width,                                                                                              \
     ErrorKind::errorKind,                                                                               \
     ChannelKind::kind,                                                                                  \
     Domain::domain,                                                                                     \
     SupportedBy::supported_by,                                                                          \
     shows,                                                                                              \
     step,                                                                                               \
     {FieldCode::code, standard, compact},                                                               \
     TexelUse::texels,                                                                                   \
     related},
        DEBUG_MODES(DIPTYCH_DEBUG_ROW)
#undef DIPTYCH_DEBUG_ROW
    };
    return modes;
}

const DebugMode* findDebugMode(std::string_view nameOrIndex) {
    int index = -1;
    const char* end = nameOrIndex.data() + nameOrIndex.size();
    const auto [rest, error] = std::from_chars(nameOrIndex.data(), end, index);
    const bool isIndex = error == std::errc() && rest == end;
    const auto found = std::ranges::find_if(debugModes(), [&](const DebugMode& mode) {
        return isIndex ? channelIndex(mode.channel) == index : mode.name == nameOrIndex;
    });
    return found == debugModes().end() ? nullptr : &*found;
}

std::optional<Channel> channelOfIndex(int index) {
    const auto found = std::ranges::find(debugModes(), index,
                                         [](const DebugMode& mode) { return channelIndex(mode.channel); });
    return found == debugModes().end() ? std::nullopt : std::optional(found->channel);
}

const DebugMode& debugMode(Channel channel) {
    const auto found = std::ranges::find(debugModes(), channel, &DebugMode::channel);
    if (found == debugModes().end())
        throw std::out_of_range(fmt::format("no channel {}", channelIndex(channel)));
    return *found;
}

std::string_view nameOf(ErrorKind errorKind) {
    switch (errorKind) {
        case ErrorKind::relative:
            return "relative";
        case ErrorKind::absolute:
            return "absolute";
        case ErrorKind::angular:
            return "angular";
        case ErrorKind::axial:
            return "axial";
        case ErrorKind::exact:
            return "exact";
    }
    return "?";
}

std::vector<std::string> exrChannels(const DebugMode& mode) {
    if (mode.channel == Channel::lit) return {"R", "G", "B"};
    if (mode.channel == Channel::depth) return {"Z"};
    const std::string_view letters = mode.kind == ChannelKind::color    ? "RGB"
                                     : mode.kind == ChannelKind::vector ? "XYZ"
                                                                        : "Y";
    std::vector<std::string> channels;
    for (const char letter : letters.substr(0, static_cast<std::size_t>(mode.width)))
        channels.push_back(std::string(mode.name) + "." + letter);
    return channels;
}

}  // namespace diptych
