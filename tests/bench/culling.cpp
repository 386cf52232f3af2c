// SPDX-License-Identifier: MIT
// Savings of --cull on: bench_culling [-n RUNS] [-s WxH] [-m SAMPLES] SCENE...
// Renders frames of both paths, interleaved: without culling, culled by the CPU, and culled by a compute
// shader into indirect draws. Reports wall-clock time and the process's CPU time, which other programs
// disturb less; and the time to split a scene's primitives into meshlets.
#include "shared/draw/culling.h"
#include "compare/render/prepared_frames.h"
#include "compare/render/renderer.h"
#include "shared/scene/load.h"
#include "shared/vulkan/device/device.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
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

// CPU time of all threads but those with this name prefix. lavapipe rasterizes in threads llvmpipe-0,
// llvmpipe-1, ...; one other thread executes commands, shades vertices and sets up triangles.
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
    MeshletTriangles triangles;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& p : mesh.primitives) {
            std::vector<std::uint32_t> indices = p.indices;
            for (const Meshlet& meshlet : buildMeshlets(p.positions, indices))
                triangles.add(meshlet, p.positions,
                              std::span(indices).subspan(meshlet.first_index, meshlet.index_count));
        }
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

struct Way {
    const char* name;
    Device& device;
    bool cull;
};

struct Measured {
    std::string name;
    std::vector<double> wall, cpu, front;  // ms
};

// Ratios to the first, medians of pairs.
void printRatios(const Measured& first, const Measured& other) {
    const auto medianOf = [](const std::vector<double>& a, const std::vector<double>& b) {
        std::vector<double> ratios;
        for (std::size_t run = 0; run < a.size(); ++run) ratios.push_back(b[run] / a[run]);
        std::ranges::sort(ratios);
        return ratios[ratios.size() / 2];
    };
    fmt::print("  {}: {:.3f} times as long as {}, {:.3f} times the CPU time, medians of pairs\n", other.name,
               medianOf(first.wall, other.wall), first.name, medianOf(first.cpu, other.cpu));
}

void measure(const std::vector<Way>& ways, const std::string& file, Settings settings, std::size_t runs) {
    const Scene scene = loadScene(file);
    struct Drawn {
        Measured measured;
        PreparedFrames frames;
    };
    std::vector<std::unique_ptr<Renderer>> renderers;
    std::vector<Drawn> drawn;
    for (const Way& way : ways) renderers.push_back(std::make_unique<Renderer>(way.device, scene));
    for (const Path path : drawn_paths)
        for (std::size_t i = 0; i < ways.size(); ++i) {
            settings.path = path;
            settings.cull = ways[i].cull;
            drawn.push_back({{fmt::format("{}, {}", nameOf(path), ways[i].name), {}, {}, {}},
                             renderers[i]->prepare(std::span(&settings, 1))});
        }
    for (std::size_t run = 0; run <= runs; ++run)
        for (auto& [measured, frames] : drawn) {
            const double beside = cpuMsBeside("llvmpipe"), before = cpuMs(), ms = frames.draw(0),
                         used = cpuMs() - before, set = cpuMsBeside("llvmpipe") - beside;
            if (run == 0) continue;  // drivers compile
            measured.wall.push_back(ms);
            measured.cpu.push_back(used);
            measured.front.push_back(set);
        }
    fmt::print("{}: cut in {:.1f} ms\n", file, cutMs(scene));
    for (auto& [measured, frames] : drawn) {
        fmt::print("  {:<30}  {}   CPU {}   of it vertices and set-up {}; ", measured.name,
                   spread(measured.wall), spread(measured.cpu), spread(measured.front));
        for (const PassTime& pass : frames.profile(0))
            if (pass.name == Culling::name) fmt::print("{} {:.1f}", pass.name, pass.ms);
        fmt::print("\n");
    }
    for (std::size_t i = 0; i < drawn.size(); ++i)
        if (i % ways.size() > 0) printRatios(drawn[i - i % ways.size()].measured, drawn[i].measured);
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
    Device device(DeviceOptions{}),
        computing({.choice = "", .validate = false, .choices = ProfileChoices::culling_by_compute});
    fmt::print("{}, {} runs, ms: median (smallest to largest)\n", device.info().name, runs);
    const std::vector<Way> ways{
        {"all", device, false}, {"by the host", device, true}, {"by compute", computing, true}};
    for (const std::string& file : files) measure(ways, file, settings, runs);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_culling: %s\n", e.what());
    return 2;
}
