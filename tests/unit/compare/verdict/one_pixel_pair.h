// SPDX-License-Identifier: MIT
// A pair of 1 x 1 Frames with every channel.
#pragma once

#include "compare/verdict/pair_reports.h"
#include "compare/verdict/tolerance.h"
#include "shared/contract/debug_mode.h"

namespace diptych {

// Input of a tolerance; its values are equal.
struct OnePixelPair {
    Frame deferred, forward;
    Requirements needs;
    Coverage covered = everyPixel(1);
    bool cpu = true;

    OnePixelPair() {
        deferred.name = "deferred";
        deferred.settings.path = Path::deferred;
        forward.name = "forward_plus";
        forward.settings.path = Path::forward_plus;
        deferred.settings.size = forward.settings.size = {1, 1};
        for (const DebugMode& mode : debugModes()) {
            forward.channels[mode.channel] = Image(1, 1, mode.width, 0.5f);
            if (isAngle(mode.error_kind)) forward.channels[mode.channel].data = {0.6f, 0, 0.8f};
            if (mode.supported_by != SupportedBy::forward_only)
                deferred.channels[mode.channel] = forward.channels[mode.channel];
            if (mode.supported_by == SupportedBy::deferred_only) forward.channels.erase(mode.channel);
        }
    }
    OnePixelPair& encoding(GBufferEncoding e) {
        deferred.settings.gbuffer = forward.settings.gbuffer = e;
        return *this;
    }
    FramePair pair() const { return {deferred, forward, needs, covered, cpu}; }
    Tolerance of(Channel mode) const { return derivedTolerance(debugMode(mode), pair()); }
};

}  // namespace diptych
