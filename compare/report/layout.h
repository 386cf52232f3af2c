// SPDX-License-Identifier: MIT
// Which file holds what, decided once for the writers and the page.
#pragma once

#include "compare/diff.h"
#include "compare/picture.h"

#include <map>
#include <string>
#include <vector>

namespace diptych {

// The pictures of one channel; a name is empty where there is no such picture.
struct ChannelPictures {
    std::string baseline, test, difference;  // difference: only where there is one
    PictureScale scale;
    double error_top = 0;  // the error at the end of the error map
};

struct ReportLayout {
    std::vector<std::string> exr;                        // per frame
    std::vector<std::vector<ChannelPictures>> pictures;  // per comparison and channel
    std::map<std::string, std::string> embedded;         // --single-file: picture -> data URI
    double encode_ms = 0;                                // EXRs and pictures

    std::vector<std::string> files() const;                       // all of a report, sorted
    const std::string& source(const std::string& picture) const;  // for the page: its name or data URI
};

// Names are "deferred.exr", "lit.deferred.png"; with several comparisons each one's begin with its number,
// scene and camera: "2-spheres-top.lit.deferred.png".
ReportLayout layoutOf(const Report& report, const PictureChoice& choice);

}  // namespace diptych
