// SPDX-License-Identifier: MIT
// SET_FRAME for the light-list compute shaders, which read View and LightGrid. All other bindings are
// valid, because a device may access any bound resource.
#pragma once

#include "shared/contract/bindings.h"
#include "shared/light/light_lists.h"
#include "shared/scene/view.h"
#include "shared/vulkan/device/resources.h"
#include "shared/vulkan/instance/check.h"
#include "shared/vulkan/pipelines/descriptors.h"

#include <array>
#include <cstring>
#include <span>
#include <vector>

namespace diptych {

// View of a camera at the origin along -z: view axes (x, y, z) are (x, -y, -z) in the world.
inline View plainView(int width, int height, double yfov = 1) {
    View view;
    view.width = width;
    view.height = height;
    view.camera.yfov = yfov;
    return view;
}

// View depth, m, from reversed depth z > 0, and the inverse.
inline double depthOf(const View& view, double z) {
    const gpu::View v = view.gpuView();
    return (double{v.depth_numerator.x} + double{v.depth_numerator.y} * z) /
           (double{v.depth_denominator.x} + double{v.depth_denominator.y} * z);
}
inline double reversedOf(const View& view, double depth) {
    const gpu::View v = view.gpuView();
    return (depth * double{v.depth_denominator.x} - double{v.depth_numerator.x}) /
           (double{v.depth_numerator.y} - depth * double{v.depth_denominator.y});
}

class KernelFrame {
public:
    KernelFrame(Device& device, const View& view)
        : uploader_(device), layout_(makeSetLayout(device, types())) {
        const gpu::View data = view.gpuView();
        view_ = makeBuffer<gpu::View>(device, uploader_, "view", std::span(&data, 1),
                                      VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
        uploader_.flush();
        lists_ = ListLayouts(device, layout_);
        sets_ = DescriptorSets(device, layout_, types(), 1);
        for (std::uint32_t binding = 0; binding < types().size(); ++binding)
            if (types()[binding] == uniform) sets_.buffer(0, binding, view_.handle());
    }
    Uploader& uploader() { return uploader_; }
    const ListLayouts& lists() const { return lists_; }
    DescriptorSets& sets() { return sets_; }
    VkDescriptorSet set() const { return sets_[0]; }

private:
    static constexpr VkDescriptorType uniform = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    using Types = std::array<VkDescriptorType, gpu::BINDING_LIST_COUNTS + 1>;
    // Bindings that the shaders do not read may have any content, except those that LightLists::bind()
    // writes.
    static const Types& types() {
        static const Types all = [] {
            Types made;
            made.fill(uniform);
            made[gpu::BINDING_LIST_HEADS] = made[gpu::BINDING_LIST_INDICES] =
                VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
            made[gpu::BINDING_LIST_COUNTS] = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
            return made;
        }();
        return all;
    }
    Uploader uploader_;
    OwnedDescriptorSetLayout layout_;
    GpuBuffer view_;
    ListLayouts lists_;
    DescriptorSets sets_;
};

// Reads back a device buffer.
template <class T>
std::vector<T> contents(Device& device, const GpuBuffer& buffer) {
    const GpuBuffer host(device, "read back", buffer.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                         MemoryUse::readback);
    device.submit([&](VkCommandBuffer commands) {
        const VkBufferCopy all{0, 0, buffer.size()};
        vkCmdCopyBuffer(commands, buffer.handle(), host.handle(), 1, &all);
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
    std::vector<T> result(buffer.size() / sizeof(T));
    std::memcpy(result.data(), host.mapped(), result.size() * sizeof(T));
    return result;
}

}  // namespace diptych
