// SPDX-License-Identifier: MIT
#include "tests/probe/posing_compare.h"

#include "shared/draw/posing.h"
#include "shared/vulkan/device/device.h"
#include "tests/probe/probe.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace diptych {

namespace {

constexpr double halfUlp = 0x1p-24;

template <class T>
std::vector<T> readBuffer(const GpuBuffer& buffer, std::uint64_t count) {
    Device& device = probeDevice();
    const GpuBuffer staging(device, "read back", count * sizeof(T), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                            MemoryUse::readback);
    device.submit([&](VkCommandBuffer commands) {
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
        const VkBufferCopy copy{0, 0, count * sizeof(T)};
        vkCmdCopyBuffer(commands, buffer.handle(), staging.handle(), 1, &copy);
    });
    std::vector<T> values(count);
    std::memcpy(values.data(), staging.mapped(), count * sizeof(T));
    return values;
}

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

glm::dmat3 cofactorsOf(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

double largestOf(const glm::dmat3& m) {
    double largest = 0;
    for (int c = 0; c < 3; ++c) largest = std::max(largest, glm::compMax(glm::abs(m[c])));
    return largest;
}

// Lower bound of the matrix's condition number: |M| |M^-1| / 3 in the Frobenius norm.
double stretchOf(const glm::dmat3& m) {
    const auto norm = [](const glm::dmat3& a) {
        return std::sqrt(glm::dot(a[0], a[0]) + glm::dot(a[1], a[1]) + glm::dot(a[2], a[2]));
    };
    return norm(m) * norm(cofactorsOf(m)) / std::abs(glm::determinant(m)) / 3;
}

// A joint, or the single matrix that moves all vertices.
struct Mover {
    glm::dmat3 axes;
    double weight = 0;
};

// Inputs of a vertex, as magnitudes that bound its rounding errors.
struct Parts {
    glm::dmat4 matrix{0};
    double scale = 0;  // sum over joints of weight times the matrix's largest element (3x3)
    double reach = 0;  // the same for the terms of its position, m
    std::vector<Mover> movers;
};

class Instanced {
public:
    Instanced(const Scene& scene, const Pose& pose, const Instance& instance)
        : primitive(primitiveOf(scene, instance)), instance_(instance), pose_(pose) {
        glm::vec3 min(1e30f), max(-1e30f);
        for (const glm::vec3& p : primitive.positions) {
            min = glm::min(min, p);
            max = glm::max(max, p);
        }
        pivot_ = (glm::dvec3(min) + glm::dvec3(max)) / 2.0;
        if (instance.weights >= 0) weights_ = &pose.weights[static_cast<std::size_t>(instance.weights)];
    }

    const Primitive& primitive;

    // Length of the base attribute plus lengths of all deltas, without cancellation.
    template <class T, class DeltasOf>
    double lengthOf(const T& rest, const DeltasOf& deltasOf, std::size_t v) const {
        double sum = glm::length(rest);
        for (std::size_t t = 0; weights_ != nullptr && t < primitive.targets.size(); ++t) {
            const auto& deltas = deltasOf(primitive.targets[t]);
            if (!deltas.empty()) sum += std::abs((*weights_)[t]) * double{glm::length(deltas[v])};
        }
        return sum;
    }
    // Base attribute with its deltas, in double.
    template <class T, class DeltasOf>
    glm::dvec3 morphed(const std::vector<T>& rest, const DeltasOf& deltasOf, std::size_t v) const {
        glm::dvec3 sum(rest[v]);
        for (std::size_t t = 0; weights_ != nullptr && t < primitive.targets.size(); ++t) {
            const auto& deltas = deltasOf(primitive.targets[t]);
            if (!deltas.empty()) sum += (*weights_)[t] * glm::dvec3(deltas[v]);
        }
        return sum;
    }
    template <class Has>
    bool isMoved(const Has& has) const {
        for (std::size_t t = 0; weights_ != nullptr && t < primitive.targets.size(); ++t)
            if ((*weights_)[t] != 0 && has(primitive.targets[t])) return true;
        return false;
    }

    Parts partsOf(std::size_t v) const {
        Parts parts;
        const double away = lengthOf(
            glm::dvec3(primitive.positions[v]) - pivot_,
            [](const MorphTarget& t) -> auto& { return t.positions; }, v);
        const glm::dvec3 origin = pose_.boxes[static_cast<std::size_t>(instance_.box)].origin;
        double whole = 0;
        const auto add = [&](const glm::dmat4& m, double weight) {
            const double largest = largestOf(glm::dmat3(m));
            parts.movers.push_back({glm::dmat3(m), weight});
            parts.matrix += weight * m;
            parts.scale += weight * largest;
            const double moved = glm::length(glm::dvec3(m * glm::dvec4(pivot_, 1)) - origin);
            parts.reach += weight * (3 * largest * away + moved);
            whole += weight;
        };
        if (instance_.skin < 0) {
            add(instance_.world_from_object, 1);
        } else {
            const auto& skin = pose_.skins[static_cast<std::size_t>(instance_.skin)];
            for (const JointSet& set : primitive.joint_sets)
                for (int i = 0; i < 4; ++i)
                    if (set.weights[v][i] > 0) add(skin[set.joints[v][i]], set.weights[v][i]);
        }
        parts.matrix /= whole;
        return parts;
    }

    // Number of roundings: morph targets, of any count, joints, and later operations.
    double roundings() const { return 32 + 8 * static_cast<double>(primitive.joint_sets.size()); }

private:
    const Instance& instance_;
    const Pose& pose_;
    glm::dvec3 pivot_{0};
    const std::vector<double>* weights_ = nullptr;
};

void raise(double& largest, double value) {
    largest = std::max(largest, value);
}

struct Got {
    const glm::vec3* positions;
    const gpu::VertexAttributes* attributes;
};

class Comparison {
public:
    Comparison(const Scene& scene, const Pose& pose, const Instance& instance, Got got, std::string what,
               PosingErrors& errors, SkinNormals normals)
        : of_(scene, pose, instance),
          exact_(posedVertices(scene, pose, instance, normals == SkinNormals::blended)),
          of_joints_(normals == SkinNormals::joints && instance.skin >= 0),
          origin_(pose.boxes[static_cast<std::size_t>(instance.box)].origin),
          got_(got),
          what_(std::move(what)),
          errors_(errors) {
        const int map = materialsOf(scene, pose)[static_cast<std::size_t>(of_.primitive.material)]
                            .normal_texture.texcoord;
        fresh_ = !of_.primitive.tangent_groups.empty() &&
                 (instance.map_rotated || of_.isMoved([map](const MorphTarget& t) {
                     return !t.positions.empty() || !t.normals.empty() || !t.texcoords[map].empty();
                 }));
        const PosedBox& box = pose.boxes[static_cast<std::size_t>(instance.box)];
        diagonal_ = glm::length(box.max - box.min);
    }

    void run() {
        for (std::size_t v = 0; v < exact_.positions.size() && !testing::Test::HasFailure(); ++v) {
            ++errors_.vertices;
            const Parts parts = of_.partsOf(v);
            const std::string at = fmt::format("{}, vertex {}", what_, v);
            attributes(v, at);
            if (std::isnan(exact_.positions[v].x)) {
                for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isnan(got_.positions[v][c])) << at;
                ++errors_.missing;
                continue;
            }
            const double off = glm::distance(glm::dvec3(got_.positions[v]) + origin_, exact_.positions[v]);
            EXPECT_LE(off, 1e-5 * diagonal_) << at;
            EXPECT_LE(off, 2 * of_.roundings() * halfUlp * parts.reach) << at;
            raise(errors_.position, off / diagonal_);
            normal(v, parts, at);
            tangent(v, parts, at);
        }
    }

private:
    void normal(std::size_t v, const Parts& parts, const std::string& at) {
        const glm::dvec3 exact = exact_.normals[v], got(got_.attributes[v].normal);
        if (parts.scale == 0) {
            EXPECT_EQ(got, glm::dvec3(0)) << at;
            return;
        }
        if (exact == glm::dvec3(0)) return;
        const glm::dmat3 m(parts.matrix);
        double bound = 0, cancelled = 1;
        if (of_.primitive.flat) {
            const std::size_t first = v / 3 * 3;
            const glm::dvec3 a = exact_.positions[first], u = exact_.positions[first + 1] - a,
                             w = exact_.positions[first + 2] - a;
            if (std::isnan(u.x + w.x)) return;
            double reach = 0;
            for (std::size_t c = 0; c < 3; ++c) raise(reach, of_.partsOf(first + c).reach);
            bound = 4 * of_.roundings() * halfUlp * reach * std::max(glm::length(u), glm::length(w)) /
                    glm::length(glm::cross(u, w));
        } else {
            const double length = of_.lengthOf(
                glm::dvec3(of_.primitive.normals[v]), [](const MorphTarget& t) -> auto& { return t.normals; },
                v);
            const glm::dvec3 rest = morphedNormal(v);
            cancelled = length / glm::length(rest);
            if (of_joints_)
                bound = jointsBound(parts, rest, length, exact, at);
            else
                bound = 6 * of_.roundings() * halfUlp * parts.scale * parts.scale * length /
                        glm::length(cofactorsOf(m) * rest);
        }
        bound = glm::degrees(bound);
        if (!(bound < 90)) return;  // direction lost in float32
        const double off = degreesBetween(got, exact);
        EXPECT_LE(off, bound) << at;
        EXPECT_NEAR(glm::length(got), 1, 1e-6) << at;
        raise(errors_.normal_bound, off / bound);
        if (stretchOf(m) > 4 || cancelled > 10) return;
        EXPECT_LE(off, 0.05) << at;
        raise(errors_.normal, off);
    }

    // rad. Also checks the double result against glTF's inverse transpose if every joint has an inverse.
    // For each joint, float32 rounds the cofactors and the determinant, of a matrix scaled to a largest
    // element of 1.
    double jointsBound(const Parts& parts, const glm::dvec3& rest, double length, const glm::dvec3& exact,
                       const std::string& at) const {
        const double rounded = 6 * of_.roundings() * halfUlp;
        double off = 0, min = 1;
        glm::dvec3 sum(0);
        for (const Mover& mover : parts.movers) {
            const double largest = largestOf(mover.axes);
            if (largest == 0) continue;
            const glm::dmat3 axes = mover.axes / largest;
            const double determinant = std::abs(glm::determinant(axes));
            min = std::min(min, determinant);
            const glm::dvec3 turned = cofactorsOf(axes) * rest;
            const double weight = mover.weight / (largest * determinant);
            off += weight * (rounded * length + glm::length(turned) * 2 * rounded / determinant);
            sum += mover.weight * (glm::transpose(glm::inverse(mover.axes)) * rest);
        }
        const double size = glm::length(sum);
        if (min < 1e-6 || !(size > 1e-3 * off)) return std::numeric_limits<double>::infinity();
        EXPECT_LT(degreesBetween(sum, exact), 1e-6) << at;
        return off / size;
    }

    glm::dvec3 morphedNormal(std::size_t v) const {
        return of_.morphed(
            of_.primitive.normals, [](const MorphTarget& t) -> auto& { return t.normals; }, v);
    }

    void tangent(std::size_t v, const Parts& parts, const std::string& at) {
        const glm::dvec3 exact = exact_.tangents[v], got(got_.attributes[v].tangent);
        if (parts.scale == 0) {
            EXPECT_EQ(got, glm::dvec3(0)) << at;
            return;
        }
        if (exact == glm::dvec3(0)) return;
        const double off = degreesBetween(got, exact);
        if (fresh_) {
            EXPECT_LE(off, 0.05) << at;
            raise(errors_.fresh_tangent, off);
            return;
        }
        const auto deltasOf = [](const MorphTarget& t) -> auto& {
            return t.tangents;
        };
        const glm::dvec3 rest(of_.primitive.tangents[v]);
        const double length = of_.lengthOf(rest, deltasOf, v);
        const glm::dvec3 morphed = of_.morphed(of_.primitive.tangents, deltasOf, v);
        const double bound = glm::degrees(4 * of_.roundings() * halfUlp * parts.scale * length /
                                          glm::length(glm::dmat3(parts.matrix) * morphed));
        if (!(bound < 90)) return;
        EXPECT_LE(off, bound) << at;
        EXPECT_NEAR(glm::length(got), 1, 1e-6) << at;
        raise(errors_.tangent_bound, off / bound);
    }

    // An attribute that targets change, or that is unchanged.
    template <class G, class R, class E, class DeltasOf>
    void attribute(const G& got, const std::vector<R>& rest, const std::vector<E>& exact,
                   const DeltasOf& deltasOf, std::size_t v, const std::string& at) {
        if (rest.empty()) return;
        if (exact.empty()) {
            EXPECT_EQ(R(got), rest[v]) << at;
            return;
        }
        const double bound = of_.roundings() * halfUlp * of_.lengthOf(E(rest[v]), deltasOf, v);
        const double off = glm::distance(E(got), exact[v]);
        EXPECT_LE(off, bound) << at;
        if (bound > 0) raise(errors_.attribute_bound, off / bound);
    }
    void attributes(std::size_t v, const std::string& at) {
        const gpu::VertexAttributes& got = got_.attributes[v];
        const Primitive& p = of_.primitive;
        EXPECT_EQ(got.tangent.w, p.tangents[v].w * exact_.bitangents) << at;
        attribute(
            got.texcoord0, p.texcoords[0], exact_.texcoords[0],
            [](const MorphTarget& t) -> auto& { return t.texcoords[0]; }, v, at + " texcoord 0");
        attribute(
            got.texcoord1, p.texcoords[1], exact_.texcoords[1],
            [](const MorphTarget& t) -> auto& { return t.texcoords[1]; }, v, at + " texcoord 1");
        attribute(
            got.color, p.colors, exact_.colors, [](const MorphTarget& t) -> auto& { return t.colors; }, v,
            at + " colour");
    }

    Instanced of_;
    PosedVertices exact_;
    bool of_joints_;
    glm::dvec3 origin_;
    Got got_;
    std::string what_;
    PosingErrors& errors_;
    bool fresh_ = false;
    double diagonal_ = 0;
};

}  // namespace

namespace {

// Vertices that the compute shaders deform, read back.
struct ReadBack {
    std::vector<glm::vec3> positions;
    std::vector<gpu::VertexAttributes> attributes;
};
ReadBack posedByKernels(const Scene& scene, const Pose& pose, SkinNormals normals) {
    Device& device = probeDevice();
    Uploader uploader(device);
    const Geometry geometry(device, uploader, scene);
    Posings posings(device, uploader, scene, geometry);
    uploader.flush();
    const OwnedPipelineLayout layout = makePosingLayout(device);
    Pipelines pipelines(device, layout);
    const auto posing = posings.at(pose, Skinning::compute, normals, pipelines);
    if (!posing->any()) return {};
    return {readBuffer<glm::vec3>(posing->positions(), posing->vertices()),
            readBuffer<gpu::VertexAttributes>(posing->attributes(), posing->vertices())};
}

}  // namespace

std::vector<glm::vec3> posedNormals(const Scene& scene, const Pose& pose, SkinNormals normals) {
    std::vector<glm::vec3> all;
    for (const gpu::VertexAttributes& a : posedByKernels(scene, pose, normals).attributes)
        all.push_back(a.normal);
    return all;
}

void comparePosing(const Scene& scene, const Pose& pose, const std::string& what, PosingErrors& errors,
                   SkinNormals normals) {
    const ReadBack got = posedByKernels(scene, pose, normals);
    ASSERT_FALSE(got.positions.empty()) << what;
    std::size_t first = 0;
    for (std::size_t i = 0; i < pose.instances.size(); ++i) {
        const Instance& instance = pose.instances[i];
        const Primitive& primitive = primitiveOf(scene, instance);
        if (instance.box < 0 || primitive.indices.empty()) continue;
        Comparison(scene, pose, instance, {&got.positions[first], &got.attributes[first]},
                   fmt::format("{}, instance {}", what, i), errors, normals)
            .run();
        first += primitive.positions.size();
    }
    EXPECT_EQ(first, got.positions.size()) << what;
}

void printErrors(const std::string& what, const PosingErrors& e) {
    fmt::print(
        "{}: {} vertices, {} NaN on both sides; largest errors: position {:.2g} of the diagonal, normal "
        "{:.2g} degrees up to 4:1 and {:.2f} of what rounding may do, tangent {:.2f} of it, made anew "
        "{:.2g} degrees, colours and texture coordinates {:.2f}\n",
        what, e.vertices, e.missing, e.position, e.normal, e.normal_bound, e.tangent_bound, e.fresh_tangent,
        e.attribute_bound);
}

}  // namespace diptych
