// SPDX-License-Identifier: MIT
// No message of the Khronos validation layers, synchronization validation included, from any scene, path
// or G-buffer encoding.
#include "tests/image/scenes.h"

namespace diptych::tests {
namespace {

class Validation : public testing::TestWithParam<std::string> {};

TEST_P(Validation, SaysNothing) {
    Device validated{DeviceOptions{.choice = "", .validate = true}};
    const Scene scene = loadScene(GetParam());
    for (const GBufferEncoding encoding :
         {GBufferEncoding::compact, GBufferEncoding::standard, GBufferEncoding::full})
        for (const Switch prepass : {Switch::on, Switch::off}) {
            Settings settings = smallPicture(encoding);
            settings.size = {64, 36};
            settings.prepass = prepass;
            bothPaths(scene, settings, validated);
        }
    EXPECT_EQ(validated.validationMessages(), 0u) << validated.firstValidationMessage();
}

INSTANTIATE_TEST_SUITE_P(Scenes, Validation, testing::ValuesIn(builtinScenes()),
                         [](const auto& scene) { return testName(scene.param.substr(8)); });

// The twin: a buffer of zero bytes is an error that the layers must report to us.
TEST(ValidationTwin, AnErrorIsCounted) {
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
