// SPDX-License-Identifier: MIT
// Compiling for a GPU that is not installed: reports for light pipelines, for ones that spill, and for
// ones that exceed the device's limits.
#include "shared/vulkan/pipelines/device_compiler.h"
#include "shared/vulkan/instance/driver_probe.h"
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/descriptors.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <optional>

namespace diptych {
namespace {

constexpr const char* family = "vega10";  // RADV of Debian 12 and of Debian 13 compile for it

std::vector<std::uint32_t> wordsOf(const std::string& shader) {
    const std::filesystem::path file = std::filesystem::path(DIPTYCH_PROBE_DIR) / (shader + ".spv");
    std::vector<std::uint32_t> words(std::filesystem::file_size(file) / 4);
    std::ifstream(file, std::ios::binary)
        .read(reinterpret_cast<char*>(words.data()), static_cast<std::streamsize>(words.size() * 4));
    return words;
}

class DeviceCompilerTest : public testing::Test {
protected:
    // Opened once for all tests.
    static void SetUpTestSuite() {
        if (radvFiles().empty()) return;
        compiler_.emplace(family);
        DeviceOptions options;
        options.compiler = &*compiler_;
        device_.emplace(options);
    }
    static void TearDownTestSuite() {
        device_.reset();
        compiler_.reset();
    }
    void SetUp() override {
        if (!compiler_)
            GTEST_SKIP() << "RADV (mesa-vulkan-drivers) is not installed: nothing compiles for " << family;
    }

    static CompiledPipeline compiled(const std::string& shader) {
        constexpr std::array types{binding_kind::storage_buffer, binding_kind::storage_buffer};
        const OwnedDescriptorSetLayout set = makeSetLayout(*device_, types);
        const OwnedPipelineLayout layout =
            makePipelineLayout(*device_, std::array<VkDescriptorSetLayout, 1>{set},
                               VkPushConstantRange{VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(std::uint32_t)});
        const std::vector<std::uint32_t> words = wordsOf(shader);
        ShaderModule module{};
        module.name = shader;
        module.words = words;
        const std::array requests{PipelineRequest{.layout = layout, .kernel = &module}};
        return compiler_->compile(requests).front();
    }

    static std::optional<DeviceCompiler> compiler_;
    static std::optional<Device> device_;
};
std::optional<DeviceCompiler> DeviceCompilerTest::compiler_;
std::optional<Device> DeviceCompilerTest::device_;

TEST_F(DeviceCompilerTest, LetsADeviceThatDrawsChooseAsAGpu) {
    EXPECT_NE(compiler_->info().name.find("VEGA10"), std::string::npos) << compiler_->info().name;
    EXPECT_TRUE(device_->profile().wide_groups);
    EXPECT_FALSE(device_->info().name.starts_with("Null")) << "what cannot run is not chosen to draw";
}

TEST_F(DeviceCompilerTest, SaysWhatAKernelTakes) {
    Pipelines pipelines(*device_, VK_NULL_HANDLE);
    const OwnedPipelineLayout layout =
        makePipelineLayout(*device_, {}, VkPushConstantRange{VK_SHADER_STAGE_COMPUTE_BIT, 0, 128});
    PassList passes(*device_, 1, 1);
    passes.compute("cull");
    compiler_->takeRequests();
    passes.compute("choose");
    pipelines.compute(Shader::cull_meshlets_comp, {}, layout);
    pipelines.compute(Shader::cull_meshlets_comp, {}, layout);
    const std::vector<PipelineRequest> asked = compiler_->takeRequests();
    ASSERT_EQ(asked.size(), 1u) << "each once";
    EXPECT_EQ(asked[0].pass, "choose");
    EXPECT_EQ(asked[0].name(), "cull_meshlets.comp");
    const CompiledPipeline compiled = compiler_->compile(asked).front();
    EXPECT_EQ(compiled.error, "");
    ASSERT_EQ(compiled.shaders.size(), 1u);
    const ShaderCost& cost = compiled.shaders[0].cost;
    for (const ShaderCostRow& row : shaderCostRows())
        EXPECT_TRUE((cost.*row.value).has_value())
            << row.name << ": RADV calls it otherwise than " << row.driver_name;
    // GCN has 256 vector registers a lane, and ten waves a SIMD unit.
    EXPECT_GT(*cost.vector_registers, 4);
    EXPECT_LE(*cost.vector_registers, 256);
    EXPECT_GE(*cost.occupancy, 1);
    EXPECT_LE(*cost.occupancy, 10);
    EXPECT_EQ(*cost.spilled_vectors, 0);
    EXPECT_EQ(compiled.shaders[0].subgroup_size, 64u);
}

TEST_F(DeviceCompilerTest, NamesWhatLiesInMemory) {
    const CompiledPipeline compiled = this->compiled("large_array.comp");
    ASSERT_EQ(compiled.shaders.size(), 1u) << compiled.error;
    EXPECT_GE(*compiled.shaders[0].cost.scratch_bytes, 64 * 2048 * 4) << "2048 words of each of 64 threads";
}

TEST_F(DeviceCompilerTest, RefusesMoreSharedMemoryThanThereIs) {
    const CompiledPipeline compiled = this->compiled("large_shared.comp");
    EXPECT_NE(compiled.error.find("131072 bytes of shared memory"), std::string::npos) << compiled.error;
}

TEST_F(DeviceCompilerTest, SaysWhichFormatCannotBeDrawnTo) {
    // No AMD GPU since GCN 3 has a 24-bit depth format.
    const PipelineKey key{.vertex = Shader::full_screen_vert, .depth = VK_FORMAT_X8_D24_UNORM_PACK32};
    const OwnedPipelineLayout layout = makePipelineLayout(*device_, {});
    const std::array requests{PipelineRequest{.layout = layout, .key = key, .choose = plainParts}};
    const CompiledPipeline compiled = compiler_->compile(requests).front();
    EXPECT_TRUE(compiled.shaders.empty());
    EXPECT_NE(compiled.error.find("does not support X8_D24_UNORM_PACK32"), std::string::npos)
        << compiled.error;
}

// Mesa 22.3 (Debian 12) does not know these names of RDNA 3 and 4; Mesa 25 (Debian 13) knows all.
TEST_F(DeviceCompilerTest, RecentFamiliesCompileOrAreNamed) {
    const std::string driver = compiler_->info().driver, mesa = "Mesa ";
    ASSERT_NE(driver.find(mesa), std::string::npos) << driver;
    const int version = std::stoi(driver.substr(driver.find(mesa) + mesa.size()));
    for (const char* recent : {"navi21", "NAVI31", "gfx1201"}) {
        try {
            EXPECT_NE(DeviceCompiler(recent).info().name.find("Null hardware"), std::string::npos);
        } catch (const std::runtime_error& error) {
            EXPECT_LT(version, 25) << error.what();
            EXPECT_NE(std::string(error.what()).find(driver), std::string::npos) << error.what();
        }
    }
}

// RADV exits the process for unknown families, so the compiler runs in a child process.
TEST(DriverProbe, AFamilyThatRadvDoesNotKnowIsAnError) {
    if (radvFiles().empty()) GTEST_SKIP() << "RADV (mesa-vulkan-drivers) is not installed";
    try {
        DeviceCompiler("navi999");
        FAIL() << "it compiles for what does not exist";
    } catch (const std::runtime_error& error) {
        const std::string said = error.what();
        EXPECT_NE(said.find("--compile-on navi999"), std::string::npos) << said;
        EXPECT_NE(said.find("radv Mesa"), std::string::npos) << "which RADV it was: " << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
    EXPECT_EQ(std::getenv("RADV_FORCE_FAMILY"), nullptr);
}

TEST(DriverProbe, AChildsEndIsToldFromItsAnswer) {
    const DriverProbe answered = probeInChild([] { return std::string("so"); });
    EXPECT_FALSE(answered.crashed);
    EXPECT_EQ(answered.output, "so");
    const DriverProbe threw = probeInChild([]() -> std::string { throw std::runtime_error("no"); });
    EXPECT_FALSE(threw.crashed);
    EXPECT_EQ(threw.output, "no");
    EXPECT_TRUE(probeInChild([]() -> std::string { std::abort(); }).crashed);
}

TEST(DriverProbe, TheEnvironmentIsSetBack) {
    ::setenv("DIPTYCH_THERE", "before", 1);
    ::unsetenv("DIPTYCH_ABSENT");
    {
        const EnvironmentVariables set({{"DIPTYCH_THERE", "now"}, {"DIPTYCH_ABSENT", "now"}});
        EXPECT_STREQ(std::getenv("DIPTYCH_THERE"), "now");
        EXPECT_STREQ(std::getenv("DIPTYCH_ABSENT"), "now");
    }
    EXPECT_STREQ(std::getenv("DIPTYCH_THERE"), "before");
    EXPECT_EQ(std::getenv("DIPTYCH_ABSENT"), nullptr);
    ::unsetenv("DIPTYCH_THERE");
}

}  // namespace
}  // namespace diptych
