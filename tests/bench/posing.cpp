// SPDX-License-Identifier: MIT
// Time to deform a mesh on the device: bench_posing [-n RUNS] [VERTICES]
// Deforms meshes of VERTICES vertices (default 1,000,000) RUNS times, interleaved with memcpy of as many
// bytes on one thread and on all; medians and spread. Bytes count each needed cache line once. A vertex's
// attributes are one struct, of which normal and tangent are read and written. A copy of n bytes moves 2
// n.
#include "shared/draw/posing.h"
#include "shared/scene/motion/pose.h"
#include "shared/vulkan/device/device.h"
#include "shared/vulkan/device/resources.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace diptych;

namespace {

using Clock = std::chrono::steady_clock;

struct Case {
    std::string name;
    int joint_sets, targets;
    bool flat = false;
    SkinNormals normals = SkinNormals::joints;
};

// A grid with 64 joints in a row; each vertex follows nearby joints, in every set. Targets move positions
// and normals.
Scene sheet(const Case& c, std::size_t vertices) {
    constexpr int joints = 64;
    Scene scene;
    scene.materials.resize(1);
    Primitive p;
    const auto row = static_cast<std::size_t>(std::sqrt(static_cast<double>(vertices)));
    p.flat = c.flat;
    p.joint_sets.resize(static_cast<std::size_t>(c.joint_sets));
    p.targets.resize(static_cast<std::size_t>(c.targets));
    for (std::size_t v = 0; v < vertices; ++v) {
        const glm::vec2 at(glm::vec2(v % row, v / row) / static_cast<float>(row));
        p.positions.emplace_back(at, 0.1f * std::sin(9 * at.x));
        p.normals.emplace_back(0, 0, 1);
        p.tangents.emplace_back(1, 0, 0, 1);
        for (JointSet& set : p.joint_sets) {
            const int near = static_cast<int>(std::min(at.y, 1.0f) * (joints - 4));
            const glm::vec4 weights(0.1f + at.x, 0.7f, 0.2f, 0.4f);
            set.joints.emplace_back(near, near + 1, near + 2, near + 3);
            set.weights.push_back(weights / (1.4f + at.x) / static_cast<float>(c.joint_sets));
        }
        for (MorphTarget& target : p.targets) {
            target.positions.emplace_back(0.1f * at.x, 0, 0.2f * at.y);
            target.normals.emplace_back(0.1f * at.y, 0.3f, 0);
        }
    }
    for (std::size_t v = 0; v + 2 < vertices; v += 3)
        for (std::size_t corner = 0; corner < 3; ++corner)
            p.indices.push_back(static_cast<std::uint32_t>(v + corner));
    scene.meshes.resize(1);
    scene.meshes[0].primitives = {std::move(p)};
    scene.meshes[0].weights.assign(static_cast<std::size_t>(c.targets), 0.3f);
    scene.nodes.resize(1);
    scene.nodes[0].mesh = 0;
    if (c.joint_sets == 0) return scene;
    scene.nodes[0].skin = 0;
    scene.skins.resize(1);
    for (int j = 0; j < joints; ++j) {
        scene.skins[0].joints.push_back(j + 1);
        scene.skins[0].joint_from_mesh.emplace_back(1);
        scene.nodes.emplace_back();
        scene.nodes.back().parent_from_node = glm::rotate(glm::dmat4(1), 0.01 * j, glm::dvec3(0, 1, 0));
    }
    return scene;
}

// For one vertex.
std::size_t bytesRead(const Case& c) {
    const auto sets = static_cast<std::size_t>(c.joint_sets), targets = static_cast<std::size_t>(c.targets);
    return sizeof(glm::vec3) + sizeof(gpu::VertexAttributes) +
           sets * (sizeof(glm::uvec2) + sizeof(glm::vec4)) + targets * 2 * sizeof(glm::vec3);
}
constexpr std::size_t bytesWritten = sizeof(glm::vec3) + sizeof(gpu::VertexAttributes);

// Copies one half of the bytes to the other; ms.
double copyMs(std::vector<std::byte>& bytes, std::size_t moved, unsigned threads) {
    const std::size_t part = moved / 2 / threads;
    const Clock::time_point start = Clock::now();
    std::vector<std::jthread> others;
    const auto copy = [&](std::size_t t) {
        std::memcpy(bytes.data() + moved / 2 + t * part, bytes.data() + t * part, part);
    };
    for (unsigned t = 1; t < threads; ++t) others.emplace_back(copy, t);
    copy(0);
    others.clear();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Posed {
    Scene scene;
    Uploader uploader;
    Geometry geometry;
    Posings posings;
    std::shared_ptr<const Posing> posing;
    PassList passes;

    Posed(Device& device, Pipelines& pipelines, const Case& c, std::size_t vertices)
        : scene(sheet(c, vertices)),
          uploader(device),
          geometry(device, uploader, scene),
          posings(device, uploader, scene, geometry),
          posing(posings.at(poseAt(scene, 0), Skinning::compute, c.normals, pipelines)),
          passes(device, 1, 1) {
        posing->addPasses(passes, pipelines);
    }
};

struct Times {
    std::vector<double> ms;
    double median() {
        std::ranges::sort(ms);
        return ms[ms.size() / 2];
    }
    std::string text(double moved) {
        const double middle = median();
        return fmt::format("{:.2f} ({:.2f} to {:.2f}) ms, {:.1f} GB/s", middle, ms.front(), ms.back(),
                           moved / middle / 1e6);
    }
};

}  // namespace

int main(int count, char** arguments) try {
    std::vector<std::string> rest(arguments + 1, arguments + count);
    std::size_t runs = 15;
    if (rest.size() > 1 && rest[0] == "-n") {
        runs = std::max(1ul, std::stoul(rest[1]));
        rest.erase(rest.begin(), rest.begin() + 2);
    }
    if (rest.size() > 1) throw std::runtime_error("usage: bench_posing [-n RUNS] [VERTICES]");
    const std::size_t vertices = rest.empty() ? 1'000'000 : std::stoul(rest[0]);
    if (vertices < 3 || vertices > 50'000'000) throw std::runtime_error("3 to 50,000,000 vertices");

    Device device(DeviceOptions{});
    const OwnedPipelineLayout layout = makePosingLayout(device);
    Pipelines pipelines(device, layout);
    const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
    fmt::print("{}, {} vertices, {} runs, ms: median (smallest to largest)\n", device.info().name, vertices,
               runs);
    for (const Case& c : {Case{"one joint set", 1, 0},
                          {"one joint set, --skin-normals blended", 1, 0, false, SkinNormals::blended},
                          {"two joint sets", 2, 0},
                          {"2 morph targets", 0, 2},
                          {"8 morph targets", 0, 8},
                          {"one joint set, 2 morph targets", 1, 2},
                          {"one joint set, flat", 1, 0, true}}) {
        Posed posed(device, pipelines, c, vertices);
        const std::size_t moved = (bytesRead(c) + bytesWritten) * vertices;
        std::vector<std::byte> bytes(moved);
        Times pose, one, all;
        copyMs(bytes, moved, threads);
        posed.passes.run();
        for (std::size_t run = 0; run < runs; ++run) {
            pose.ms.push_back(posed.passes.run());
            one.ms.push_back(copyMs(bytes, moved, 1));
            all.ms.push_back(copyMs(bytes, moved, threads));
        }
        fmt::print(
            "{}: {} bytes read, {} written a vertex\n  pose    {}\n  memcpy  {} on one thread\n"
            "          {} on {}; the pose takes {:.2f} times as long\n",
            c.name, bytesRead(c), bytesWritten, pose.text(static_cast<double>(moved)),
            one.text(static_cast<double>(moved)), all.text(static_cast<double>(moved)), threads,
            pose.median() / all.median());
    }
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_posing: %s\n", e.what());
    return 2;
}
