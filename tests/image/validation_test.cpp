// SPDX-License-Identifier: MIT
// The Khronos validation layers, including synchronization validation, report nothing for any scene, path,
// G-buffer encoding and assignment.
#include "tests/image/scenes.h"

namespace diptych::tests {
namespace {

class Validation : public testing::TestWithParam<std::string> {};

// Whatever any test of this process drew on device() had no message either.
class NoMessages : public testing::Environment {
    void TearDown() override {
        EXPECT_EQ(device().validationMessages(), 0u) << device().firstValidationMessage();
    }
};
[[maybe_unused]] testing::Environment* const noMessages = testing::AddGlobalTestEnvironment(new NoMessages);

// All frames are drawn by one Renderer, which shares uploads and pipelines with the tests of the scene. Every
// channel is captured in one encoding; another encoding only changes the last shading pass of a capture.
TEST_P(Validation, SaysNothing) {
    const std::uint64_t before = device().validationMessages();
    Renderer& renderer = uploaded(GetParam()).renderer;
    const auto draw = [&](Settings settings, bool everyChannel) {
        settings.size = {64, 36};
        RenderOptions options;
        options.channels = everyChannel ? allChannels()
                                        : std::vector{static_cast<int>(gpu::DEBUG_lit),
                                                      static_cast<int>(gpu::DEBUG_geometric_normal)};
        options.runs = 0;
        options.through_gbuffer = everyChannel;
        renderer.draw(settings, options);
    };
    for (const GBufferEncoding encoding :
         {GBufferEncoding::compact, GBufferEncoding::standard, GBufferEncoding::full})
        for (const Path path : {Path::deferred, Path::forward_plus}) {
            Settings settings = smallPicture(encoding);
            settings.path = path;
            settings.prepass = Switch::on;
            draw(settings, encoding == GBufferEncoding::standard);
            if (path == Path::deferred || encoding != GBufferEncoding::standard) continue;
            settings.prepass = Switch::off;
            draw(settings, false);
        }
    for (const auto& [assign, kernel] : {std::pair{Assignment::tiled, LightKernel::scatter},
                                         {Assignment::tiled, LightKernel::gather},
                                         {Assignment::clustered, LightKernel::gather},
                                         {Assignment::every, LightKernel::automatic},
                                         {Assignment::per_object, LightKernel::automatic}}) {
        Settings settings = smallPicture(GBufferEncoding::standard);
        settings.path = Path::forward_plus;
        settings.assign = assign;
        settings.light_kernel = kernel;
        draw(settings, false);
    }
    EXPECT_EQ(device().validationMessages(), before) << device().firstValidationMessage();
}

INSTANTIATE_TEST_SUITE_P(Builtin, Validation, testing::ValuesIn(builtinScenes()),
                         [](const auto& scene) { return testName(scene.param.substr(8)); });

// Negative control: a buffer of zero bytes is an error that the layers must report to us.
TEST(ValidationNegativeControl, AnErrorIsCounted) {
    Device validated{DeviceOptions{.choice = "", .validate = true}};
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    vkCreateBuffer(validated.handle(), &info, nullptr, &buffer);
    if (buffer != VK_NULL_HANDLE) vkDestroyBuffer(validated.handle(), buffer, nullptr);
    EXPECT_GT(validated.validationMessages(), 0u);
    EXPECT_FALSE(validated.firstValidationMessage().empty());
}

}  // namespace
}  // namespace diptych::tests
