// SPDX-License-Identifier: MIT
// Failing memory allocations and devices: exit code 2, one line that says what helps, no output.
#include "tests/support/campaign.h"
#include "tests/tool/faults.h"

#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <string>

namespace diptych {
namespace {

#ifdef DIPTYCH_FAULTS

const std::string renderTriangle =
    "render builtin:triangle --path deferred -q -o r --size 16x9 --runs 1 --channels albedo";

// Makes one call after another fail, until the tool no longer reaches it. Returns the number of calls, as
// Rows::atMost() expects it. `said`: the errors.
int sweep(const std::string& function, VkResult result, const std::string& says, int step = 1,
          const Rows& rows = Rows(faultStride), std::string* said = nullptr) {
    const Folder folder;
    EXPECT_EQ(runTool(folder, renderTriangle).code, 0);
    const Contents old = contentsBelow(folder / "r");
    int hit = 0;
    for (int row = 0, at = 1; at < manyCalls && !testing::Test::HasFailure();
         row = rows.after(row), at = 1 + row * step) {
        const Faulted ran =
            runFaulted(folder, renderTriangle, {function, std::to_string(static_cast<int>(result))}, at);
        if (ran.seen.empty()) return rows.atMost(hit);
        ++hit;
        EXPECT_TRUE(ran.failedOver(says)) << function << " " << at;
        EXPECT_EQ(contentsBelow(folder / "r"), old) << function << " " << at;
        EXPECT_TRUE(leftoversIn(folder.path()).empty()) << function << " " << at;
        if (said) *said += ran.err;
    }
    ADD_FAILURE() << function << " has no end";
    return hit;
}

TEST(DeviceFaults, MemoryThatIsNotThereNamesASmallerSize) {
    EXPECT_GE(sweep("vkAllocateMemory", VK_ERROR_OUT_OF_DEVICE_MEMORY, "try a smaller --size"), 2);
    EXPECT_GE(sweep("vkAllocateMemory", VK_ERROR_OUT_OF_HOST_MEMORY, "try a smaller --size"), 2);
    EXPECT_GE(sweep("vkMapMemory", VK_ERROR_MEMORY_MAP_FAILED, "try a smaller --size"), 1);
}

TEST(DeviceFaults, ALostDeviceIsNamedAtEverySubmitWithWhatItWasRunning) {
    const std::string lost =
        ": the device was lost; try a smaller --size or fewer --lights, or choose another device with "
        "--device";
    std::string said;
    EXPECT_GE(sweep("vkQueueSubmit2", VK_ERROR_DEVICE_LOST, lost, 1, Rows(1), &said), 10);
    for (const char* what : {"G-buffer to shade", "G-buffer", "shade", "capture"})
        EXPECT_NE(said.find(std::string("diptych: Vulkan: running ") + what + lost), said.npos)
            << what << "\n"
            << said;
    EXPECT_GE(sweep("vkWaitForFences", VK_ERROR_DEVICE_LOST, lost, 2), 3);
}

TEST(DeviceFaults, WhatCannotBeMadeIsNamed) {
    EXPECT_GE(sweep("vkCreateInstance", VK_ERROR_INCOMPATIBLE_DRIVER, "install mesa-vulkan-drivers"), 1);
    EXPECT_GE(sweep("vkCreateDevice", VK_ERROR_INITIALIZATION_FAILED, "vkCreateDevice"), 1);
    EXPECT_GE(sweep("vkCreateBuffer", VK_ERROR_OUT_OF_HOST_MEMORY, "vkCreateBuffer", 3), 3);
    EXPECT_GE(sweep("vkCreateImage", VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkCreateImage", 3), 3);
    EXPECT_GE(sweep("vkCreateGraphicsPipelines", VK_ERROR_OUT_OF_HOST_MEMORY, "vkCreateGraphicsPipelines"),
              3);
    EXPECT_GE(sweep("vkAllocateDescriptorSets", VK_ERROR_OUT_OF_POOL_MEMORY, "vkAllocateDescriptorSets"), 1);
}

// All large allocations of this program and of its libraries. Smaller ones are too many to fail one by
// one.
TEST(DeviceFaults, AnAllocationThatFailsIsOneLine) {
    const Folder folder;
    ASSERT_EQ(runTool(folder, renderTriangle).code, 0);
    const Contents old = contentsBelow(folder / "r");
    const Rows rows(faultStride);
    int failed = 0;
    for (int row = 0, at = 1;; row = rows.after(row), at = 1 + 7 * row) {
        ASSERT_LT(at, manyCalls);
        const Faulted ran = runFaulted(folder, renderTriangle, {"memory", "12", false, 4096}, at);
        EXPECT_TRUE(leftoversIn(folder.path()).empty()) << at << " " << ran.err;
        if (ran.seen.empty()) break;
        if (ran.code == 0) {
            // The library recovered from the failed allocation.
            fs::remove_all(folder / "r");
            ASSERT_EQ(runTool(folder, renderTriangle).code, 0);
            continue;
        }
        ++failed;
        EXPECT_TRUE(ran.failedOver("")) << at;
        if (testing::Test::HasFailure()) break;
    }
    EXPECT_GE(rows.atMost(failed), 6);
    EXPECT_EQ(contentsBelow(folder / "r").size(), old.size());
}

#endif

}  // namespace
}  // namespace diptych
