// SPDX-License-Identifier: MIT
// report_writer old|new|check FOLDER: writes one of two reports as compare does, or repairs the folder as
// compare does before rendering. It needs no device, so that a test can run it hundreds of times.
#include "compare/files/output.h"
#include "compare/report/report.h"
#include "tests/support/report_builder.h"

#include <cstdio>
#include <exception>
#include <string>

int main(int argc, char** argv) {
    using namespace diptych;
    if (argc != 3) return 3;
    const std::string which = argv[1];
    try {
        std::vector<Frame> frames = bothFrames();
        // Few files, so that a test reaches every writing call in a short time.
        for (Frame& frame : frames)
            std::erase_if(frame.channels, [](const auto& channel) {
                return channel.first != Channel::albedo && channel.first != Channel::roughness &&
                       channel.first != Channel::material_id;
            });
        // In the new report roughness differs, which adds a difference image.
        if (which == "new") frames[1].channels[Channel::roughness].at(1, 2, 0) = 0.25f;
        if (which == "check")
            checkReplaceable({OutputKind::folder, argv[2]}, "report.json", false);
        else
            writeReport(reportOf(std::move(frames)), argv[2], {});
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "diptych: %s\n", error.what());
        return 2;
    }
}
