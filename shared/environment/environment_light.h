// SPDX-License-Identifier: MIT
// An environment on the device: its maps, made once for all views that ask for the same ones, and what one
// view reads them by.
#pragma once

#include "shared/environment/environment_maps.h"
#include "shared/frame/settings.h"
#include "shared/vulkan/descriptors.h"
#include "shared/vulkan/resources.h"
#include "shared/vulkan/user_cache.h"
#include "shared/vulkan/variant.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace diptych {

// What one request made of one environment, on the device.
struct EnvironmentImages {
    EnvironmentRequest request;
    bool without_sun = false;
    Harmonics harmonics{};
    double window = 0;  // leastWindow()
    glm::vec4 diffuse{0};
    std::vector<glm::vec4> levels{};
    GpuImage maps{}, sky{};
    std::string note{};
};

// The environment of a scene and what its sun leaves of it, each with all that was asked of it.
class EnvironmentStore {
public:
    explicit EnvironmentStore(Device& device, std::filesystem::path cache = userCacheFolder())
        : device_(device), folder_(std::move(cache)) {}
    // `background`: the scene's environment, which is seen; `environment`: the same, or what lights in its
    // place. Throws std::runtime_error, one line, where the device holds no picture so large.
    const EnvironmentImages& at(Uploader& uploader, const Environment& environment,
                                const Environment& background, const EnvironmentRequest& request);
    std::uint64_t bytes() const;

private:
    Device& device_;
    std::filesystem::path folder_;
    std::vector<std::unique_ptr<EnvironmentImages>> made_;
};

// One view's. Without an environment, or where its intensity is 0, it changes nothing.
class EnvironmentLight {
public:
    // `environment`, `background`: of the scene (EnvironmentStore::at), or nullptr. `frame`: the sets of
    // SET_FRAME, to which it writes its bindings.
    EnvironmentLight(Device& device, Uploader& uploader, EnvironmentStore& store,
                     const Environment* environment, const Environment* background, DescriptorSets& frame,
                     const Settings& settings);

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

// World axes to the environment's: `degrees` turn it about +Y, counter-clockwise seen from above.
glm::mat3 environmentFromWorld(double degrees);

}  // namespace diptych
