// SPDX-License-Identifier: MIT
// The reference's uncertainty survives writing and reading its EXR: a path is judged against the file as it
// is against the Frame.
#include "compare/files/frame_exr.h"
#include "compare/render/reference_frame.h"
#include "compare/verdict/baseline.h"
#include "compare/verdict/comparison.h"
#include "shared/contract/debug_mode.h"
#include "shared/image/exr.h"
#include "tests/unit/files.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace diptych {
namespace {

constexpr auto lit = static_cast<int>(gpu::DEBUG_lit), ids = static_cast<int>(gpu::DEBUG_material_id);
const ReportDevice device{"a device", "1.0", "cpu"};

// Two grey pixels.
Frame frameOf(Path path, float left, float right) {
    Frame frame;
    frame.name = std::string(nameOf(path));
    frame.scene = "builtin:one";
    frame.settings.path = path;
    frame.settings.size = {2, 1};
    frame.camera.far = std::numeric_limits<double>::infinity();
    frame.channels[lit] = Image(2, 1, 3);
    frame.channels[lit].data = {left, left, left, right, right, right};
    frame.channels[ids] = Image(2, 1, 1);
    return frame;
}

// A sampled reference with uncertainties of a third and of a hundredth.
Frame sampled() {
    Frame truth = frameOf(Path::reference, 1, 2);
    truth.uncertainty = Image(2, 1, 1);
    truth.uncertainty.data = {1.0f / 3, 0.01f};
    truth.relative_uncertainty = 0.1 + 0.2;
    return truth;
}

Frame throughExr(const Frame& frame) {
    const std::filesystem::path file = folder() / "reference.exr";
    writeFrameExr(file, frame, device);
    return frameFromExr(file);
}

ChannelDiff judged(const Frame& truth, const Frame& path) {
    Report report;
    report.device = device;
    report.frames = {truth, path};
    return compareFrames(report, 0, 1, Requirements()).channels.front();
}

TEST(Uncertainty, ComesBackAsItWas) {
    const Frame truth = sampled(), back = throughExr(truth);
    ASSERT_TRUE(isReferenceFrame(back));
    EXPECT_EQ(back.uncertainty.width, 2);
    EXPECT_EQ(back.uncertainty.height, 1);
    EXPECT_EQ(back.uncertainty.components, 1);
    EXPECT_EQ(back.uncertainty.data, truth.uncertainty.data);
    EXPECT_EQ(back.relative_uncertainty, truth.relative_uncertainty);
    EXPECT_EQ(back.notes, std::vector<std::string>{uncertaintyNote(truth.relative_uncertainty)});
    EXPECT_EQ(back.channels.size(), 2u) << "it is no channel";
    EXPECT_EQ(back.channels.at(lit).data, truth.channels.at(lit).data);
}

// Infinite and NaN uncertainties are read back, too: a reader accepts all that this program writes.
TEST(Uncertainty, OfAnySizeComesBack) {
    for (const double relative : {0.0, 1e-300, 5e-324, 1e300, std::numeric_limits<double>::infinity()}) {
        Frame truth = sampled();
        truth.relative_uncertainty = relative;
        truth.uncertainty.data = {std::numeric_limits<float>::infinity(), 0};
        const Frame back = throughExr(truth);
        EXPECT_EQ(back.relative_uncertainty, relative);
        EXPECT_EQ(back.uncertainty.data, truth.uncertainty.data);
    }
}

TEST(Uncertainty, TheVerdictAgainstTheFileIsThatAgainstTheFrame) {
    const Frame truth = sampled(), back = throughExr(truth);
    for (const float right : {2.0f, 2.02f, 2.2f}) {
        const Frame path = frameOf(Path::forward_plus, 1.5f, right);
        const ChannelDiff now = judged(truth, path), stored = judged(back, path);
        ASSERT_EQ(now.mode->number, lit);
        EXPECT_EQ(now.verdict, right > 2.1f ? Verdict::fail : Verdict::pass) << right;
        EXPECT_EQ(stored.verdict, now.verdict) << right;
        ASSERT_TRUE(stored.certain_p999.has_value());
        EXPECT_EQ(stored.certain_p999, now.certain_p999);
        EXPECT_EQ(stored.tolerance.max, now.tolerance.max);
        EXPECT_EQ(stored.tolerance.because, now.tolerance.because);
        EXPECT_EQ(stored.reason, now.reason);
    }
    // Without the uncertainty the same picture would fail.
    Frame bare = back;
    bare.uncertainty = {};
    EXPECT_EQ(judged(bare, frameOf(Path::forward_plus, 1.5f, 2)).verdict, Verdict::fail);
}

TEST(Uncertainty, IsWrittenBesideLitAlone) {
    Frame truth = sampled();
    truth.requested = {ids};
    EXPECT_TRUE(throughExr(truth).uncertainty.empty());
    truth = sampled();
    truth.uncertainty = {};
    const Frame exact = throughExr(truth);
    EXPECT_TRUE(exact.uncertainty.empty());
    EXPECT_TRUE(exact.notes.empty());
}

TEST(Uncertainty, OfAFileThatWasChangedIsRefusedInOneLine) {
    const std::filesystem::path file = folder() / "reference.exr";
    writeFrameExr(file, sampled(), device);
    const PictureFile whole = readExr(file);
    for (const char* wrong : {"", "much", "0.1 or so"}) {
        std::vector<ExrLayerView> layers;
        for (const PictureLayer& layer : whole.layers) layers.push_back({layer.channels, &layer.image});
        std::vector<ExrAttribute> attributes;
        for (const auto& [name, value] : whole.attributes)
            attributes.push_back({name, name == "relative_uncertainty" ? wrong : value});
        writeExr(file, layers, attributes);
        try {
            frameFromExr(file);
            ADD_FAILURE() << wrong;
        } catch (const std::runtime_error& error) {
            EXPECT_EQ(std::string(error.what()), file.string() + ": its attribute relative_uncertainty, \"" +
                                                     wrong + "\", is no number");
        }
    }
}

}  // namespace
}  // namespace diptych
