// SPDX-License-Identifier: MIT
// A G-buffer that gives back more than its bits can lose is found by the channel at fault, although both
// paths' light agrees on what it gives back.
#include "compare/verdict/encoding_use.h"
#include "compare/verdict/pair_reports.h"
#include "tests/image/scenes.h"

#include <glm/gtc/packing.hpp>

#include <cmath>
#include <functional>

namespace diptych::tests {
namespace {

float rounded(float value, int steps) {
    return std::floor(value * static_cast<float>(steps) + 0.5f) / static_cast<float>(steps);
}
float asHalf(float value) {
    return glm::unpackHalf1x16(glm::packHalf1x16(value));
}

struct DecodingFault {
    const char* name;
    Channel channel;
    std::function<float(float)> plant;  // what the G-buffer gives back of a component
};
void PrintTo(const DecodingFault& fault, std::ostream* out) {
    *out << fault.name;
}
const DecodingFault decodingFaults[] = {
    {"NormalsOfTwelveBits", Channel::normals, [](float x) { return rounded(x, 2047); }},
    {"NormalsOfHalfFloats", Channel::normals, asHalf},
    {"NormalsOfAnotherLength", Channel::normals, [](float x) { return 0.999f * x; }},
    {"GeometricNormalsOfFiveBits", Channel::geometric_normal, [](float x) { return rounded(x, 15); }},
    {"RoughnessOfEightBits", Channel::roughness, [](float x) { return rounded(x, 255); }},
    {"RoughnessOfHalfFloats", Channel::roughness, asHalf},
    {"AlbedoWithoutItsRoot", Channel::albedo, [](float x) { return rounded(x, 255); }},
    {"AlbedoRootedTwice", Channel::albedo, [](float x) { return std::sqrt(x); }},
    {"MetallicOfFourBits", Channel::metallic, [](float x) { return x > 0 && x < 1 ? x - 0.5f / 15 : x; }},
    {"OcclusionOfSevenBits", Channel::occlusion, [](float x) { return rounded(x, 127); }},
    {"EmissionOfEightBits", Channel::emission, [](float x) { return x * (1 + 1.0f / 200); }},
};

// Deferred decodes `channel` so, and both paths shade what it gives back.
Report withDecoded(std::vector<Frame> frames, const Requirements& needs, const DecodingFault* fault) {
    if (fault)
        for (float& value : frames[0].channels.at(fault->channel).data) value = fault->plant(value);
    const DeviceInfo& info = device().info();
    return makeReport({{std::move(frames), needs}}, {info.name, info.driver, info.type});
}

class DecodingFaults : public testing::TestWithParam<DecodingFault> {
public:
    // Drawn once for all faults.
    static const std::vector<Frame>& sound() {
        static const std::vector<Frame> frames = [] {
            Settings settings = smallImage(GBufferEncoding::standard);
            return uploaded("builtin:gallery").bothPaths(settings);
        }();
        return frames;
    }
    static Requirements needs() {
        const Scene& scene = uploaded("builtin:gallery").scene;
        return requirements(scene, poseAt(scene, 0));
    }
};

TEST_P(DecodingFaults, AreFoundByTheirChannelAlone) {
    ASSERT_TRUE(withDecoded(sound(), needs(), nullptr).passed());
    const Report report = withDecoded(sound(), needs(), &GetParam());
    for (const ChannelDiff& channel : report.comparisons.at(0).channels)
        EXPECT_EQ(channel.verdict == Verdict::fail, channel.mode->channel == GetParam().channel)
            << channel.mode->name << " " << channel.reason;
}

INSTANTIATE_TEST_SUITE_P(Faults, DecodingFaults, testing::ValuesIn(decodingFaults),
                         [](const auto& fault) { return std::string(fault.param.name); });

}  // namespace
}  // namespace diptych::tests
