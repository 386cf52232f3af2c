// SPDX-License-Identifier: MIT
// The Khronos validation layers, including synchronization validation, report nothing while any test of
// this program runs.
#include "tests/image/scenes.h"

namespace diptych::tests {
namespace {

// Fails a test during which the layers reported something. Tests render on device(), with validation
// except in suites that repeat others' work. For those, parity tests render every built-in scene in all
// encodings with and without a pre-pass, and light list tests use all assignments.
class NoMessages : public testing::EmptyTestEventListener {
    void OnTestEnd(const testing::TestInfo&) override {
        const std::uint64_t now = device().validationMessages();
        EXPECT_EQ(now, before_) << device().firstValidationMessage();
        before_ = now;
    }
    std::uint64_t before_ = 0;
};
[[maybe_unused]] const bool is_listening = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new NoMessages);
    return true;
}();

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
