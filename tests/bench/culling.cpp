// SPDX-License-Identifier: MIT
// What --cull on saves:  bench_culling [-n RUNS] [-s WxH] [-m SAMPLES] SCENE...
// Frames of both paths with and without it, in turn, by the clock and in CPU time of the process, which
// other programs disturb less; and how long it takes to cut a scene's primitives into clusters.
#include "compare/render/renderer.h"
#include "shared/draw/cluster_triangles.h"
#include "shared/scene/load.h"
#include "shared/vulkan/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace diptych;

namespace {

double cpuMs() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// Of the threads that are not named so: lavapipe draws by those named llvmpipe-0, llvmpipe-1, ..., and one
// other runs commands, shades vertices and sets triangles up.
double cpuMsBeside(const std::string& name) {
    double ms = 0;
    for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
        std::string comm;
        std::getline(std::ifstream(thread.path() / "comm"), comm);
        double ns = 0;
        std::ifstream(thread.path() / "schedstat") >> ns;
        if (!comm.starts_with(name)) ms += 1e-6 * ns;
    }
    return ms;
}

std::string spread(std::vector<double> values) {
    std::ranges::sort(values);
    return fmt::format("{:6.1f} ({:6.1f} to {:6.1f})", values[values.size() / 2], values.front(),
                       values.back());
}

double cutMs(const Scene& scene) {
    const auto start = std::chrono::steady_clock::now();
    ClusterTriangles triangles;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& p : mesh.primitives) {
            std::vector<std::uint32_t> indices = p.indices;
            for (const Cluster& cluster : cutIntoClusters(p.positions, indices))
                triangles.add(cluster, p.positions,
                              std::span(indices).subspan(cluster.first_index, cluster.index_count));
        }
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void measure(Device& device, const std::string& file, Settings settings, std::size_t runs) {
    const Scene scene = loadScene(file);
    Renderer renderer(device, scene);
    std::vector<Settings> each;
    for (const Path path : drawn_paths)
        for (const bool cull : {false, true}) {
            settings.path = path;
            settings.cull = cull;
            each.push_back(settings);
        }
    PreparedFrames frames = renderer.prepare(each);
    std::vector<std::vector<double>> wall(each.size()), cpu(each.size()), front(each.size());
    for (std::size_t run = 0; run <= runs; ++run)
        for (std::size_t i = 0; i < each.size(); ++i) {
            const double beside = cpuMsBeside("llvmpipe"), before = cpuMs(), ms = frames.draw(i),
                         used = cpuMs() - before, set = cpuMsBeside("llvmpipe") - beside;
            if (run == 0) continue;  // drivers compile
            wall[i].push_back(ms);
            cpu[i].push_back(used);
            front[i].push_back(set);
        }
    fmt::print("{}: cut in {:.1f} ms\n", file, cutMs(scene));
    for (std::size_t i = 0; i < each.size(); ++i)
        fmt::print("  {:<12} --cull {:<3}  {}   CPU {}   of it vertices and set-up {}\n",
                   nameOf(each[i].path), each[i].cull ? "on" : "off", spread(wall[i]), spread(cpu[i]),
                   spread(front[i]));
    for (std::size_t i = 0; i < each.size(); i += 2) {
        std::vector<double> ratios, used;
        for (std::size_t run = 0; run < runs; ++run) {
            ratios.push_back(wall[i + 1][run] / wall[i][run]);
            used.push_back(cpu[i + 1][run] / cpu[i][run]);
        }
        std::ranges::sort(ratios);
        std::ranges::sort(used);
        fmt::print("  {}: with it {:.3f} times as long, {:.3f} times the CPU time, medians of pairs\n",
                   nameOf(each[i].path), ratios[runs / 2], used[runs / 2]);
    }
}

}  // namespace

int main(int count, char** arguments) try {
    std::vector<std::string> files(arguments + 1, arguments + count);
    std::size_t runs = 21;
    Settings settings;
    settings.set("size", "1280x720");
    settings.shadows = Shadows::off;
    while (files.size() > 2 && files[0].size() == 2 && files[0][0] == '-') {
        if (files[0] == "-n") runs = std::max(1ul, std::stoul(files[1]));
        if (files[0] == "-s") settings.set("size", files[1]);
        if (files[0] == "-m") settings.set("msaa", files[1]);
        files.erase(files.begin(), files.begin() + 2);
    }
    if (files.empty())
        throw std::runtime_error("usage: bench_culling [-n RUNS] [-s WxH] [-m SAMPLES] SCENE...");
    Device device(DeviceOptions{});
    fmt::print("{}, {} runs, ms: median (smallest to largest)\n", device.info().name, runs);
    for (const std::string& file : files) measure(device, file, settings, runs);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_culling: %s\n", e.what());
    return 2;
}
