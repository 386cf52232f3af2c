// SPDX-License-Identifier: MIT
#include "shared/frame/frame.h"

#include "shared/contract/debug_mode.h"

#include <fmt/format.h>

namespace diptych {

void letGo(const Frame& frame, Channel channel) {
    for (const auto* images : {&frame.channels, &frame.through_gbuffer})
        if (const auto found = images->find(channel); found != images->end()) letGo(found->second.data);
    if (const auto found = frame.further_samples.find(channel); found != frame.further_samples.end())
        for (const Image& image : found->second) letGo(image.data);
    if (channel == Channel::lit)
        for (const Image* image : {&frame.unblended, &frame.unblended_through_gbuffer})
            if (!image->empty()) letGo(image->data);
}

void letGo(const Frame& frame) {
    for (const auto& [channel, image] : frame.channels) letGo(frame, channel);
}

bool isReferenceFrame(const Frame& frame) {
    return isReference(frame.settings.path) && (frame.origin.file.empty() || !frame.origin.device.empty());
}

std::string uncertaintyNote(double relative) {
    return fmt::format(
        "reference: relative half-width of the 95 % confidence interval of lit is at most {:.2g} at 99.9 % "
        "of the pixels",
        relative);
}

}  // namespace diptych
