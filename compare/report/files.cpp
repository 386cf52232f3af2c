// SPDX-License-Identifier: MIT
#include "compare/report/files.h"

#include "compare/picture.h"
#include "compare/report/json.h"
#include "compare/report/report.h"
#include "compare/version.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/atomic_file.h"
#include "shared/image/exr.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace diptych {

void writeFrameExr(const std::filesystem::path& file, const Frame& frame, const ReportDevice& device) {
    std::vector<ExrLayerView> layers;
    for (const auto& [mode, image] : frame.channels)
        if (frame.isAsked(mode)) layers.push_back({exrChannels(debugMode(mode)), &image});
    writeExr(file, layers,
             {{"camera", jsonOf(frame)["camera"].dump()},
              {"commit", commitName()},
              {"device", device.name},
              {"driver", device.driver},
              {"scene", frame.scene},
              {"settings", toJson(frame.settings, -1)},
              {"software", softwareName}});
}

// RFC 4648, section 4.
std::string base64(std::string_view bytes) {
    constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto byte = [&](std::size_t i) {
        return i < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[i])) : 0u;
    };
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const unsigned bits = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
        for (const int shift : {18, 12, 6, 0}) out += letters[bits >> shift & 63];
    }
    for (std::size_t i = bytes.size(); i % 3 != 0; ++i) out[out.size() - (3 - i % 3)] = '=';
    return out;
}

std::string dataUri(const std::filesystem::path& png) {
    std::ifstream stream(png, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) throw std::runtime_error(png.string() + ": cannot be read back");
    return "data:image/png;base64," + base64(bytes);
}

namespace {

void writePicture(const std::filesystem::path& file, const Frame& frame, const DebugMode& shown,
                  const PictureChoice& choice) {
    if (!frame.channels.contains(shown.number))
        throw std::runtime_error(
            fmt::format("--debug {}: the {} path does not make it{}", shown.name, frame.name,
                        shown.maker == MadeBy::forward_only ? "; forward_plus does" : ""));
    const auto lit = frame.channels.find(gpu::DEBUG_lit);
    const Exposure exposure =
        exposureFor(choice, lit == frame.channels.end() ? nullptr : &lit->second, coverage(frame, frame));
    const Frame* frames[] = {&frame};
    writePng(file, picture(shown, frame, scaleFor(shown, exposure, frames)));
}

}  // namespace

void writeFrame(const Frame& frame, const ReportDevice& device, const Output& output, const DebugMode& shown,
                const PictureChoice& choice) {
    if (output.kind == OutputKind::exr)
        writeFrameExr(output.path, frame, device);
    else
        writePicture(output.path, frame, shown, choice);
}

std::vector<std::string> writeFrameFolder(const Frame& frame, const ReportDevice& device,
                                          const std::filesystem::path& folder, const DebugMode& shown,
                                          const PictureChoice& choice) {
    const std::vector<std::string> files{frame.name + ".exr", std::string(shown.name) + ".png", "frame.json"};
    writeFrameExr(folder / files[0], frame, device);
    writePicture(folder / files[1], frame, shown, choice);
    const nlohmann::ordered_json json{
        {"schema", 1},
        {"software", softwareName},
        {"device", {{"name", device.name}, {"driver", device.driver}, {"type", device.type}}},
        {"frame", jsonOf(frame)},
        {"files", files}};
    writeFile(folder / files[2],
              json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    return files;
}

}  // namespace diptych
