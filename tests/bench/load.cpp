// SPDX-License-Identifier: MIT
// Time from a file to a renderable scene: bench_load [-n RUNS] SCENE...
// Interleaves RUNS loads of every scene; medians and spread. `memory`: resident size that the scene's
// first load added to the process, and the size of the loaded data.
#include "shared/scene/load.h"
#include "shared/draw/geometry.h"
#include "shared/material/materials.h"
#include "shared/scene/model/scene.h"
#include "shared/vulkan/device/device.h"
#include "shared/vulkan/device/resources.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

using namespace diptych;

namespace {

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

template <class T>
std::size_t bytesOf(const std::vector<T>& v) {
    return v.size() * sizeof(T);
}

// Images with their mip chains (4/3), and geometry.
std::size_t decodedBytes(const Scene& scene) {
    std::size_t bytes = 0;
    for (const TextureImage& image : scene.images)
        bytes += (bytesOf(image.rgba) + bytesOf(image.rgba16)) * 4 / 3;
    for (const Mesh& mesh : scene.meshes)
        for (const Primitive& p : mesh.primitives)
            bytes += bytesOf(p.positions) + bytesOf(p.normals) + bytesOf(p.tangents) +
                     bytesOf(p.texcoords[0]) + bytesOf(p.texcoords[1]) + bytesOf(p.colors) +
                     bytesOf(p.indices);
    return bytes;
}

struct Load {
    double read_ms = 0, upload_ms = 0;  // read: parse, decode, tangents; upload: mip chains and device data
    std::size_t bytes = 0;
};

Load load(Device& device, const std::string& file) {
    Load result;
    const Clock::time_point start = Clock::now();
    const Scene scene = loadScene(file);
    result.read_ms = msSince(start);
    const Clock::time_point loaded = Clock::now();
    Uploader uploader(device);
    const Geometry geometry(device, uploader, scene);
    const Materials materials(device, uploader, scene);
    uploader.flush();
    result.upload_ms = msSince(loaded);
    result.bytes = decodedBytes(scene);
    return result;
}

long residentKib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

// In a process of its own, so that its peak is due to this scene.
double addedMib(const std::string& file) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    const pid_t child = fork();
    if (child == 0) {
        Device device(DeviceOptions{});
        const long before = residentKib();
        load(device, file);
        const double added = static_cast<double>(residentKib() - before) / 1024;
        _exit(write(ends[1], &added, sizeof added) == sizeof added ? 0 : 1);
    }
    double added = 0;
    if (child < 0 || read(ends[0], &added, sizeof added) != sizeof added)
        throw std::runtime_error("the child failed");
    waitpid(child, nullptr, 0);
    close(ends[0]);
    close(ends[1]);
    return added;
}

std::string spread(std::vector<double> values) {
    std::ranges::sort(values);
    return fmt::format("{:.0f} ({:.0f} to {:.0f})", values[values.size() / 2], values.front(), values.back());
}

}  // namespace

int main(int count, char** arguments) try {
    std::vector<std::string> files(arguments + 1, arguments + count);
    std::size_t runs = 5;
    if (files.size() > 1 && files[0] == "-n") {
        runs = std::max(1ul, std::stoul(files[1]));
        files.erase(files.begin(), files.begin() + 2);
    }
    if (files.empty()) throw std::runtime_error("usage: bench_load [-n RUNS] SCENE...");

    std::vector<double> memory;
    for (const std::string& file : files)
        memory.push_back(addedMib(file));  // before this process has threads
    Device device(DeviceOptions{});
    std::vector<std::vector<double>> read(files.size()), upload(files.size()), whole(files.size());
    std::vector<double> size(files.size());
    for (std::size_t run = 0; run < runs; ++run)
        for (std::size_t i = 0; i < files.size(); ++i) {
            const Load l = load(device, files[i]);
            read[i].push_back(l.read_ms);
            upload[i].push_back(l.upload_ms);
            whole[i].push_back(l.read_ms + l.upload_ms);
            size[i] = static_cast<double>(l.bytes) / (1 << 20);
        }
    fmt::print("{}, {} runs, ms: median (smallest to largest)\n", device.info().name, runs);
    for (std::size_t i = 0; i < files.size(); ++i)
        fmt::print(
            "{}\n  to drawable {}   read and decode {}   mip chains and upload {}\n"
            "  decoded {:.0f} MiB, memory {:.0f} MiB: {:.2f} times\n",
            files[i], spread(whole[i]), spread(read[i]), spread(upload[i]), size[i], memory[i],
            memory[i] / size[i]);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "bench_load: %s\n", e.what());
    return 2;
}
