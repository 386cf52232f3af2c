// SPDX-License-Identifier: MIT
#include "compare/external/external_frame.h"

#include "compare/external/child_process.h"
#include "compare/external/job.h"
#include "compare/files/frame_exr.h"
#include "compare/frames/frame_properties.h"
#include "compare/frames/nonfinite.h"
#include "shared/contract/debug_mode.h"
#include "shared/frame/debug_modes.h"
#include "shared/image/srgb.h"
#include "shared/image/temporary.h"
#include "shared/text/counted.h"
#include "shared/text/one_line.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace diptych::external {
namespace {

namespace fs = std::filesystem;

// Linux limit of one argument: MAX_ARG_STRLEN less the terminator.
constexpr std::size_t longest_argument = 128 * 1024 - 1;
// Last lines of stderr that become notes.
constexpr std::size_t max_lines = 10;

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
        if (!line.empty()) lines.push_back(oneLine(line));
    }
    return lines;
}

std::vector<std::string> argumentsOf(const ExternalRenderer& renderer, const Job& job) {
    std::vector<std::string> arguments = renderer.command;
    arguments.push_back(job.file.string());
    arguments.push_back(job.text.size() <= longest_argument
                            ? job.text
                            : nlohmann::json{{"schema", 1}, {"job", job.file.string()}}.dump());
    return arguments;
}

// To linear Rec.709 from other primaries, both with white point D65 (ITU-R BT.2087, SMPTE EG 432-1).
using Rows = std::array<std::array<double, 3>, 3>;
constexpr Rows rec709_from_p3{
    {{1.2249401, -0.2249402, 0.0}, {-0.0420569, 1.0420571, 0.0}, {-0.0196376, -0.0786361, 1.0982735}}};
constexpr Rows rec709_from_rec2020{{{1.6604910, -0.5876411, -0.0728499},
                                    {-0.1245505, 1.1328999, -0.0083494},
                                    {-0.0181508, -0.1005789, 1.1187297}}};

void convert(Image& image, const Rows& rows) {
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        float* p = image.pixel(i);
        const std::array<double, 3> from{p[0], p[1], p[2]};
        for (std::size_t r = 0; r < 3; ++r)
            p[r] = static_cast<float>(rows[r][0] * from[0] + rows[r][1] * from[1] + rows[r][2] * from[2]);
    }
}

void mirror(Image& image, bool rows, bool columns) {
    const Image from = image;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.components; ++c)
                image.at(x, y, c) =
                    from.at(columns ? image.width - 1 - x : x, rows ? image.height - 1 - y : y, c);
}

// Applies the input corrections to the pixels.
void correctFrame(Frame& frame, const InputCorrections& corrections) {
    for (auto& [mode, image] : frame.channels) {
        if (corrections.upside_down || corrections.mirrored)
            mirror(image, corrections.upside_down, corrections.mirrored);
        // Transfer curve and primaries apply to radiance only.
        if (mode != Channel::lit) continue;
        if (corrections.transfer == Transfer::srgb)
            for (float& value : image.data)
                value = static_cast<float>(linearFromSrgb(std::max(0.0, double{value})));
        if (corrections.primaries == Primaries::display_p3) convert(image, rec709_from_p3);
        if (corrections.primaries == Primaries::rec2020) convert(image, rec709_from_rec2020);
    }
}

void checkFinite(const Frame& frame) {
    for (const auto& [mode, image] : frame.channels) {
        const std::uint64_t count = nonfinitePixels(image);
        if (count == 0) continue;
        std::size_t first = 0;
        const auto finite = [&](std::size_t i) {
            const float* p = image.pixel(i);
            return std::all_of(p, p + image.components, [](float v) { return std::isfinite(v); });
        };
        while (finite(first)) ++first;
        const auto width = static_cast<std::size_t>(image.width);
        throw std::runtime_error(fmt::format("{} is NaN or infinite at {}, the first at {},{}",
                                             debugMode(mode).name, counted(count, "pixel"), first % width,
                                             first / width));
    }
}

timespec writtenAt(const fs::path& file) {
    struct stat status {};
    if (::lstat(file.c_str(), &status) != 0)
        throw std::runtime_error(errno == ENOENT ? std::string("wrote no picture to output.file")
                                                 : fmt::format("its picture: {}", std::strerror(errno)));
    // Rejects links, which may lead to an older file.
    if (!S_ISREG(status.st_mode)) throw std::runtime_error("its picture is not a regular file");
    return status.st_mtim;
}

// How the renderer failed, and the last line of its output.
std::string problemOf(const std::string& how, const Ended& ended) {
    const std::vector<std::string> lines = linesOf(ended.output);
    return lines.empty() ? how : fmt::format("{}: {}", how, lines.back());
}

}  // namespace

Frame readImage(const fs::path& file, const fs::path& after, const InputCorrections& corrections,
                const Size& size) {
    const timespec then = writtenAt(after), now = writtenAt(file);
    if (std::pair(now.tv_sec, now.tv_nsec) < std::pair(then.tv_sec, then.tv_nsec))
        throw std::runtime_error("its picture is older than its job");
    Frame frame = [&] {
        try {
            return frameFromExr(file);
        } catch (const std::runtime_error& error) {
            std::string why = error.what();  // names a temporary folder
            if (const std::size_t at = why.find(file.string()); at != std::string::npos)
                why.replace(at, file.string().size(), "its picture");
            throw std::runtime_error(why);
        }
    }();
    if (frame.settings.size != size)
        throw std::runtime_error(fmt::format("its picture is {}x{}, but {}x{} was requested",
                                             frame.settings.size.width, frame.settings.size.height,
                                             size.width, size.height));
    checkFinite(frame);
    correctFrame(frame, corrections);
    return frame;
}

Attempt drawExternally(const ExternalRenderer& renderer, const Scene& scene, const SceneView& view,
                       const Settings& settings) {
    const fs::path root = fs::absolute(fs::temp_directory_path());
    Temporary folder(root, root / "diptych-job");
    if (!folder.createFolder(true))
        throw std::runtime_error(fmt::format("{}: {}; set TMPDIR to another folder", oneLine(root.string()),
                                             std::strerror(errno)));
    const Job job = writeJob(folder.path(), scene, view, settings, renderer);
    Attempt attempt;
    Ended ended;
    try {
        ended = runProgram(argumentsOf(renderer, job), renderer.folder, renderer.timeout);
        attempt.output = ended.output;
        if (const std::string how = howItEnded(ended, renderer.timeout); !how.empty())
            throw std::runtime_error(problemOf(how, ended));
        Frame image = readImage(job.image, job.file, renderer.corrections, settings.size);
        Frame frame = describedFrame(scene, view, settings);
        frame.name = renderer.name;
        frame.settings.path = Path::reference;
        frame.channels = std::move(image.channels);
        frame.origin.file = renderer.file.string();
        frame.origin.external = true;
        frame.origin.omitted_channels = std::move(image.origin.omitted_channels);
        std::erase(frame.origin.omitted_channels, "A");  // pixel coverage
        frame.origin.corrections = describe(renderer.corrections);
        frame.made_in_ms = ended.ms;
        for (const std::string& line : frame.origin.corrections)
            frame.notes.push_back(fmt::format("{}: correction {}", renderer.name, line));
        for (const std::string& line : job.notes)
            if (std::ranges::count(frame.notes, line) == 0) frame.notes.push_back(line);
        const std::vector<std::string> lines = linesOf(ended.warned);
        const std::size_t from = lines.size() > max_lines ? lines.size() - max_lines : 0;
        for (std::size_t i = from; i < lines.size(); ++i)
            frame.notes.push_back(fmt::format("{} says: {}", renderer.name, lines[i]));
        attempt.frame = std::move(frame);
    } catch (const std::runtime_error& error) {
        attempt.problem = error.what();
    }
    return attempt;
}

}  // namespace diptych::external
