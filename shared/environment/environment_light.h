// SPDX-License-Identifier: MIT
// An environment on the GPU: its maps, shared by all views with the same request, and one view's
// parameters.
#pragma once

#include "shared/environment/environment_maps.h"
#include "shared/frame/settings.h"
#include "shared/vulkan/device/resources.h"
#include "shared/vulkan/instance/user_cache.h"
#include "shared/vulkan/pipelines/descriptors.h"
#include "shared/vulkan/spirv/variant.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// GPU images of one environment for one request.
struct EnvironmentImages {
    EnvironmentRequest request;
    bool without_sun = false;
    Harmonics harmonics{};
    double window = 0;  // minWindow()
    glm::vec4 diffuse{0};
    std::vector<glm::vec4> levels{};
    GpuImage maps{}, sky{};
    std::string note{};
};

// Images of the scene's environment, and of the same without its sun, for all requests so far.
class EnvironmentStore {
public:
    explicit EnvironmentStore(Device& device, std::filesystem::path cache = userCacheFolder())
        : device_(device), folder_(std::move(cache)) {}
    // `background`: the scene's environment, which is visible. `environment`: the same, or its replacement
    // for lighting. Throws std::runtime_error, one line, if the device does not support the image's size.
    const EnvironmentImages& at(Uploader& uploader, const Environment& environment,
                                const Environment& background, const EnvironmentRequest& request);
    std::uint64_t bytes() const;

private:
    Device& device_;
    std::filesystem::path folder_;
    std::vector<std::unique_ptr<EnvironmentImages>> made_;
};

// Environment of one view. Without an environment, or with intensity 0, it does nothing.
class EnvironmentLight {
public:
    struct Source {
        const Environment *environment, *background;  // see EnvironmentStore::at; or nullptr
    };
    // `frame`: SET_FRAME, in which it writes its bindings.
    EnvironmentLight(Device& device, Uploader& uploader, EnvironmentStore& store, const Source& source,
                     DescriptorSets& frame, const Settings& settings);

    static bool isLit(const Environment* environment, const Settings& settings) {
        return environment != nullptr && settings.ibl_intensity > 0;
    }
    void specialise(Variant& variant) const { variant.set(gpu::FEATURE_environment, feature_); }
    const std::vector<std::string>& notes() const { return notes_; }
    std::uint64_t bytes() const { return texels_.size(); }
    std::uint64_t imageBytes() const { return image_bytes_; }  // of its maps, which views may share

private:
    gpu::uint feature_ = 0;
    std::uint64_t image_bytes_ = 0;
    GpuBuffer texels_;
    OwnedBufferView texels_view_;
    OwnedSampler nearest_;
    std::vector<std::string> notes_;
};

// Rotation from world axes to the environment's axes. `degrees` rotate the environment about +Y,
// counter-clockwise seen from above.
glm::mat3 environmentFromWorld(double degrees);

}  // namespace diptych
