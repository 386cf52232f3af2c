// SPDX-License-Identifier: MIT
// In a campaign, validates every shader module of the tests' pipelines with SPIRV-Tools, even without
// validation layers: the linker redirects vkCreateShaderModule here. Otherwise only the layers do, in the
// suites that have them: here it takes 10 % of the time.
#include "tests/support/campaign.h"

#include <gtest/gtest.h>
#include <vulkan/vulkan_core.h>
#include <spirv-tools/libspirv.hpp>

#include <string>

extern "C" {

VkResult __real_vkCreateShaderModule(VkDevice, const VkShaderModuleCreateInfo*, const VkAllocationCallbacks*,
                                     VkShaderModule*);

VkResult __wrap_vkCreateShaderModule(VkDevice device, const VkShaderModuleCreateInfo* info,
                                     const VkAllocationCallbacks* allocation, VkShaderModule* module) {
    if (!diptych::isCampaign()) return __real_vkCreateShaderModule(device, info, allocation, module);
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
    std::string said;
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                                 const char* message) { said += std::string(message) + "\n"; });
    spvtools::ValidatorOptions options;
    options.SetScalarBlockLayout(true);
    if (!tools.Validate(info->pCode, info->codeSize / sizeof *info->pCode, options))
        ADD_FAILURE() << "a module is not valid SPIR-V: " << said;
    return __real_vkCreateShaderModule(device, info, allocation, module);
}

}  // extern "C"
