// SPDX-License-Identifier: MIT
#include "compare/audit/reduce.h"

#include "compare/audit/small_scene.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace diptych::audit {

namespace {

template <class Value>
void eraseRange(std::vector<Value>& values, std::size_t from, std::size_t to) {
    values.erase(values.begin() + static_cast<std::ptrdiff_t>(from),
                 values.begin() + static_cast<std::ptrdiff_t>(to));
}

class Reducer {
public:
    Reducer(Case flat, const std::function<FailingPixel(const Case&)>& test, std::size_t budget)
        : now_(std::move(flat)), test_(test), budget_(budget) {}

    std::optional<Reduced> run() {
        if (!accept(Case(now_))) return {};
        // First, so that all later steps render fast; again at the end if it needs more pixels now.
        onePixel();
        dropNodes();
        dropLights();
        dropTriangles();
        dropNodes();
        onePixel();
        dropLights();
        return Reduced{std::move(now_), shown_};
    }

private:
    // Replaces the current case if the candidate fails too.
    bool accept(Case candidate) {
        if (tried_ >= budget_) return false;
        ++tried_;
        const FailingPixel pixel = test_(candidate);
        if (!pixel.fails) return false;
        shown_ = pixel;
        now_ = std::move(candidate);
        return true;
    }

    // Removes ranges of `count` elements but one, first halves, then smaller ones. remove(case, from, to).
    template <class Count, class Remove>
    void shrink(const Count& count, const Remove& remove) {
        for (std::size_t part = (count(now_) + 1) / 2; part > 0; part /= 2)
            for (std::size_t from = 0; from < count(now_) && count(now_) > 1;) {
                const std::size_t to = std::min({from + part, count(now_), from + count(now_) - 1});
                Case candidate = now_;
                remove(candidate, from, to);
                if (!accept(std::move(candidate))) from = to;
                if (tried_ >= budget_) return;
            }
    }

    void dropNodes() {
        shrink([](const Case& c) { return c.scene.nodes.size(); },
               [](Case& c, std::size_t from, std::size_t to) {
                   eraseRange(c.scene.nodes, from, to);
                   // Each node has the mesh of its own index.
                   eraseRange(c.scene.meshes, from, to);
                   for (std::size_t i = 0; i < c.scene.nodes.size(); ++i)
                       c.scene.nodes[i].mesh = static_cast<int>(i);
               });
    }

    // Keeps the last one: a scene without lights has a default directional light.
    void dropLights() {
        shrink([](const Case& c) { return c.scene.lights.size(); },
               [](Case& c, std::size_t from, std::size_t to) { eraseRange(c.scene.lights, from, to); });
    }

    void dropTriangles() {
        shrink([](const Case& c) { return triangleCount(c.scene); },
               [](Case& c, std::size_t from, std::size_t to) {
                   std::size_t before = 0;
                   for (Mesh& mesh : c.scene.meshes) {
                       std::vector<std::uint32_t>& indices = mesh.primitives.front().indices;
                       const std::size_t count = indices.size() / 3;
                       const std::size_t first = std::clamp(from, before, before + count) - before,
                                         last = std::clamp(to, before, before + count) - before;
                       eraseRange(indices, 3 * first, 3 * last);
                       before += count;
                   }
               });
    }

    // Points the camera at the worst pixel only.
    void onePixel() {
        const Camera& camera = now_.camera();
        if (camera.orthographic || shown_.x < 0) return;
        if (now_.settings.size.width == 1 && now_.settings.size.height == 1) return;
        Case candidate = now_;
        Camera& closer = candidate.camera();
        const double height = now_.settings.size.height, width = now_.settings.size.width;
        const double t = std::tan(camera.yfov / 2);
        const double x = (2 * (shown_.x + 0.5) / width - 1) * t * width / height,
                     y = (1 - 2 * (shown_.y + 0.5) / height) * t;
        const glm::dmat3 axes(camera.world_from_camera);
        const glm::dvec3 along = glm::normalize(axes[0] * x + axes[1] * y - axes[2]);
        const glm::dvec3 right = glm::normalize(glm::cross(along, axes[1]));
        closer.world_from_camera[0] = glm::dvec4(right, 0);
        closer.world_from_camera[1] = glm::dvec4(glm::cross(right, along), 0);
        closer.world_from_camera[2] = glm::dvec4(-along, 0);
        closer.yfov = 2 * std::atan(t / height);
        candidate.settings.size = {1, 1};
        accept(std::move(candidate));
    }

    Case now_;
    FailingPixel shown_;
    const std::function<FailingPixel(const Case&)>& test_;
    const std::size_t budget_;
    std::size_t tried_ = 0;
};

}  // namespace

std::optional<Reduced> reduce(const Case& failing, const std::function<FailingPixel(const Case&)>& test,
                              std::size_t budget) {
    std::optional<Case> flat = flattened(failing);
    if (!flat) return {};
    return Reducer(std::move(*flat), test, budget).run();
}

}  // namespace diptych::audit
