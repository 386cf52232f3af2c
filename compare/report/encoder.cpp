// SPDX-License-Identifier: MIT
#include "compare/report/encoder.h"

#include "compare/files/data_uri.h"
#include "compare/files/frame_exr.h"
#include "compare/image/channel_image.h"
#include "compare/report/values.h"
#include "shared/image/atomic_file.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

namespace diptych {
namespace {

// Writes one file. Tasks may run in any order and on any thread; the longest are listed first.
using Task = std::function<void()>;

class Encoder {
public:
    Encoder(const Report& report, ReportLayout& layout, const std::filesystem::path& folder,
            const Stage& progress)
        : report_(report), layout_(layout), folder_(folder), progress_(progress) {}

    void run() {
        std::vector<Task> tasks;
        for (std::size_t i = 0; i < report_.frames.size(); ++i)
            if (!layout_.exr[i].empty())
                tasks.push_back([this, i] {
                    writeFrameExr(folder_ / layout_.exr[i], report_.frames[i],
                                  deviceOf(report_, report_.frames[i]));
                });
        for (std::size_t i = 0; i < report_.comparisons.size(); ++i)
            for (std::size_t k = 0; k < report_.comparisons[i].channels.size(); ++k)
                addImages(tasks, report_.comparisons[i], report_.comparisons[i].channels[k],
                          layout_.images[i][k]);
        for (std::size_t i = 0; i < report_.comparisons.size(); ++i)
            if (!layout_.cause_maps[i].empty())
                tasks.push_back(
                    [this, i] { write(layout_.cause_maps[i], *report_.comparisons[i].explained->map); });
        for (std::size_t i = 0; i < report_.closer_paths.size(); ++i)
            for (std::size_t k = 0; k < report_.closer_paths[i].channels.size(); ++k)
                if (!layout_.closer_paths[i][k].empty())
                    tasks.push_back([this, i, k] {
                        const Image& error_difference = report_.closer_paths[i].channels[k].error_difference;
                        write(layout_.closer_paths[i][k],
                              closerPathImage(error_difference, closerPathTop(error_difference)));
                    });
        std::atomic<std::size_t> done{0};
        tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t i) {
            tasks[i]();
            progress_.at(static_cast<double>(++done) / static_cast<double>(tasks.size()), "write pictures");
        });
    }

private:
    void addImages(std::vector<Task>& tasks, const Comparison& comparison, const ChannelDiff& channel,
                   ChannelImages& images) {
        if (!images.baseline.empty() || !images.test.empty())
            tasks.push_back([&] { writePair(comparison, *channel.mode, images); });
        if (images.differ || !images.values.empty())
            tasks.push_back([&] { writeErrors(comparison, channel, images); });
    }

    // Identical images share one file.
    void writePair(const Comparison& comparison, const DebugMode& mode, ChannelImages& images) {
        const Frame &left = report_.baseline(comparison), &right = report_.test(comparison);
        const auto draw = [&](const Frame& frame, const std::string& name) {
            return name.empty() ? Image8() : channelImage(mode, frame, images.scale);
        };
        const Image8 a = draw(left, images.baseline), b = draw(right, images.test);
        if (!images.same.empty() && a.data == b.data) {
            images.baseline = images.test = images.same;
            write(images.same, a);
        } else {
            if (!a.data.empty()) write(images.baseline, a);
            if (!b.data.empty()) write(images.test, b);
        }
        for (const Frame* frame : {&left, &right}) letGo(*frame, mode.channel);
    }

    // Writes the error image, its histogram and worst pixels, and the values script, which includes the
    // errors.
    void writeErrors(const Comparison& comparison, const ChannelDiff& channel, ChannelImages& images) {
        const DebugMode& mode = *channel.mode;
        const Frame &baseline = report_.baseline(comparison), &test = report_.test(comparison);
        const Image *left = findChannel(baseline, mode.channel), *right = findChannel(test, mode.channel);
        Image errors;
        if (images.differ) {
            errors = errorImage(mode.error_kind, mode.kind, *left, *right, comparison.coverage);
            const Image& shown = channel.shown_error ? *channel.shown_error : errors;
            if (!images.difference.empty()) write(images.difference, errorMap(shown, images.error_top));
            images.histogram = errorHistogram(shown, comparison.coverage);
            images.worst = worstPixels(shown, maxWorstPixels, worstPixelSpacing, channel.stats.worst_x,
                                       channel.stats.worst_y);
        }
        writeValues(images.values, left ? left : right, left ? right : nullptr,
                    errors.empty() ? nullptr : &errors);
        for (const Frame* frame : {&baseline, &test}) letGo(*frame, mode.channel);
    }

    void writeValues(const std::string& name, const Image* first, const Image* second, const Image* errors) {
        if (name.empty()) return;
        AtomicFile script(folder_ / name);
        valuesScript(name, {first, second, errors}, [&](std::string_view text) {
            std::fwrite(text.data(), 1, text.size(), script.stream());
        });
        script.commit();
    }

    void write(const std::string& name, const Image8& image) {
        if (!layout_.single_file) return writePng(folder_ / name, image);
        std::string uri = dataUri(pngBytes(halfSize(image)));
        const std::lock_guard lock(mutex_);
        layout_.embedded[name] = std::move(uri);
    }

    const Report& report_;
    ReportLayout& layout_;
    const std::filesystem::path& folder_;
    const Stage& progress_;
    std::mutex mutex_;
};

}  // namespace

void encode(const Report& report, ReportLayout& layout, const std::filesystem::path& folder,
            const Stage& progress) {
    Encoder(report, layout, folder, progress).run();
}

}  // namespace diptych
