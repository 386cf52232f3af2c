// SPDX-License-Identifier: MIT
// Deformed vertices of skinned and morphed instances: computed once per frame by compute shaders, or by
// the vertex shader of every draw (--skinning). Both give the same bits.
#pragma once

#include "shared/draw/deformations.h"
#include "shared/draw/draw_list.h"
#include "shared/frame/setting_values.h"
#include "shared/vulkan/passes/pass_list.h"
#include "shared/vulkan/pipelines/pipelines.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace diptych {

// Layout of the compute shaders, shared by all poses.
OwnedPipelineLayout makePosingLayout(Device& device);

// Resources that all poses of a scene share.
struct PosingSources {
    Device& device;
    Uploader& uploader;
    const Geometry& geometry;
    Deformations rest;
    OwnedPipelineLayout layout;  // of makePosingLayout()
};

// One pose of a scene. It owns its buffers, so frames of different times may be drawn in any order.
class Posing {
public:
    Posing() = default;  // an empty pose
    // Deforms the instances once, for draws before the first frame. Throws std::runtime_error if memory
    // runs out, or if more morph targets have a weight than a shader can add. The sources must outlive it.
    Posing(const PosingSources& sources, Pipelines& pipelines, const Pose& pose, Skinning skinning,
           SkinNormals normals);

    bool any() const { return !instances_.empty(); }
    // Adds passes named "pose"; they go before the first pass that draws.
    void addPasses(PassList& passes, Pipelines& pipelines) const;
    // Declares that the pass draws geometry; returns the pass.
    Pass& read(PassList& passes, Pass& pass) const;

    // Whether an item's vertices are in the buffers of bind(), at vertexOffset().
    bool isPosed(const DrawItem& item) const { return item.box >= 0 && skinning_ == Skinning::compute; }
    // Whether the vertex shader deforms it; vertexPosing() is VERTEX_POSING_* or 0, address() its
    // PosedInstance.
    bool isPosedInShader(const DrawItem& item) const {
        return item.box >= 0 && skinning_ == Skinning::vertex;
    }
    gpu::uint vertexPosing(const DrawItem& item) const;
    gpu::uvec2 address(const DrawItem& item) const;
    std::int32_t vertexOffset(const DrawItem& item) const;
    void bind(VkCommandBuffer commands) const;

    std::uint64_t vertices() const { return vertices_; }
    std::uint64_t bytes() const;
    const GpuBuffer& positions() const { return positions_; }    // vec3 by box; for tests
    const GpuBuffer& attributes() const { return attributes_; }  // VertexAttributes, likewise

private:
    struct Posed {
        VkDeviceAddress address = 0;  // of its gpu::PosedInstance
        std::uint32_t vertices = 0, groups = 0;
        std::uint64_t first_vertex = 0;
        gpu::PosingConstants constants{};  // of the compute shaders
        Variant variant{};                 // of the compute shaders
    };
    struct Data;
    void addInstances(Data& data, const PosingSources& sources, const Pose& pose, SkinNormals normals);
    void makeBuffers(Device& device, const Data& data);
    // Returns the copies of undeformed attributes that copyAttributes() makes.
    std::vector<VkBufferCopy> setAddresses(Data& data);
    void copyAttributes(Device& device, const Geometry& geometry,
                        const std::vector<VkBufferCopy>& copies) const;

    VkPipelineLayout layout_ = VK_NULL_HANDLE;
    Skinning skinning_ = Skinning::compute;
    std::vector<Posed> instances_;  // by box
    std::uint64_t vertices_ = 0;
    bool makes_tangents_ = false;
    GpuBuffer pose_, positions_, attributes_, morphed_, tangents_;
};

// Poses of one scene. Concurrent views share a pose while one of them uses it.
class Posings {
public:
    Posings(Device& device, Uploader& uploader, const Scene& scene, const Geometry& geometry);
    std::shared_ptr<const Posing> at(const Pose& pose, Skinning skinning, SkinNormals normals,
                                     Pipelines& pipelines);
    std::uint64_t bytes() const { return sources_.rest.bytes(); }  // of data that all poses share
    std::size_t made() const { return made_; }                     // number of poses created

private:
    // Inputs that determine a pose's vertices.
    struct Key {
        Skinning skinning = Skinning::compute;
        SkinNormals normals = SkinNormals::joints;
        std::vector<Instance> instances;  // deformed ones
        std::vector<PosedBox> boxes;
        std::vector<std::vector<glm::dmat4>> skins;
        std::vector<std::vector<double>> weights;
        std::vector<TextureSlot> maps;  // by instance: its tangentMap()
        bool operator==(const Key&) const = default;
    };
    struct CachedBuffers {
        Key key;
        std::weak_ptr<const Posing> posing;
    };
    PosingSources sources_;
    std::vector<CachedBuffers> kept_;
    std::size_t made_ = 0;
};

}  // namespace diptych
