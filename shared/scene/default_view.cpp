// SPDX-License-Identifier: MIT
#include "shared/scene/default_view.h"

#include "shared/scene/motion/posed.h"
#include "shared/scene/visible_surface.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

namespace diptych {
namespace {

constexpr double defaultFov = glm::radians(60.0);
constexpr int ratedWidth = 48, ratedHeight = 27;  // rays per candidate
constexpr double ratedAspect = double{ratedWidth} / ratedHeight;

// A challenger replaces a view if its entropy exceeds that view's by this: twice as many equal parts.
constexpr double clearlyMore = 1;  // bits

// Least fraction of directions that hit front faces for an eye to be indoors. A floor under the sky gives
// 0.5, a closed room 1; 0.75 accepts a courtyard.
constexpr double surrounded = 0.75;
constexpr double minHeadroom = 2, eyeHeight = 1.6;  // m, glTF's unit
constexpr int columns = 7;                          // candidate eyes lie on a grid of columns x columns
constexpr int maxFloors = 16;                       // per column
constexpr std::size_t maxEyes = 16;                 // the most spacious ones are rated
constexpr int aroundDirections = 96, yaws = 8;

// The radius of the bounds, or a substitute if they are empty or a single point.
double usableRadius(const Bounds& bounds) {
    const double radius = bounds.radius();
    return radius > 0 && std::isfinite(radius) ? radius : 1.0;
}

// Smallest distance along `backward` from the bounds' centre at which all eight corners are visible, with
// a margin of 5 %. Fitting a sphere would leave most of the image empty for a long hall.
double fittingDistance(const Bounds& bounds, const glm::dmat4& axes, double aspect) {
    const double tanY = std::tan(defaultFov * 0.5) / 1.05, tanX = tanY * aspect;
    const double radius = usableRadius(bounds);
    double distance = 1e-3 * radius;
    const glm::dvec3 half = bounds.empty() || !(bounds.radius() > 0) ? glm::dvec3(radius / std::sqrt(3.0))
                                                                     : (bounds.max - bounds.min) * 0.5;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y,
                           corner & 4 ? half.z : -half.z);
        const double x = std::abs(glm::dot(p, glm::dvec3(axes[0])));
        const double y = std::abs(glm::dot(p, glm::dvec3(axes[1])));
        const double towards = glm::dot(p, glm::dvec3(axes[2]));
        distance = std::max(distance, towards + std::max(x / tanX, y / tanY));
    }
    return distance;
}

// Whether `eye` sees the front of at least one triangle, or either side of a double-sided one.
bool anythingFaces(const Scene& scene, const Pose& pose, const glm::dvec3& eye) {
    for (const Instance& instance : pose.instances) {
        const Primitive& primitive = primitiveOf(scene, instance);
        if (primitive.indices.empty()) continue;
        if (scene.materials[static_cast<std::size_t>(primitive.material)].double_sided) return true;
        const glm::dmat4& worldFromObject = instance.world_from_object;
        const double handedness = glm::determinant(glm::dmat3(worldFromObject)) < 0 ? -1 : 1;
        const std::vector<glm::dvec3> posed =
            instance.deformed() ? posedPositions(scene, pose, instance) : std::vector<glm::dvec3>();
        const auto corner = [&](std::size_t i) {
            const std::uint32_t v = primitive.indices[i];
            return posed.empty() ? glm::dvec3(worldFromObject * glm::dvec4(primitive.positions[v], 1.0))
                                 : posed[v];
        };
        for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
            const glm::dvec3 a = corner(i), b = corner(i + 1), c = corner(i + 2);
            if (glm::dot(glm::cross(b - a, c - a), eye - a) * handedness > 0) return true;
        }
    }
    return false;
}

class Rating {
public:
    Rating(const Scene& scene, const Pose& pose, const Bounds& bounds)
        : bounds_(bounds), surface_(scene, pose, bounds) {}

    DefaultView rated(DefaultView view) const {
        const glm::dmat4 camera = worldFromCamera(view, bounds_, ratedAspect);
        const double tanY = std::tan(defaultFov * 0.5);
        std::vector<VisibleSurface::Seen> seen;
        for (int y = 0; y < ratedHeight; ++y)
            for (int x = 0; x < ratedWidth; ++x) {
                const glm::dvec3 ray((2 * (x + 0.5) / ratedWidth - 1) * tanY * ratedAspect,
                                     (1 - 2 * (y + 0.5) / ratedHeight) * tanY, -1);
                const auto hit =
                    surface_.nearest(glm::dvec3(camera[3]), glm::normalize(glm::dmat3(camera) * ray));
                if (hit) seen.push_back(*hit);
            }
        view.covered = static_cast<double>(seen.size()) / (ratedWidth * ratedHeight);
        view.entropy = viewEntropy(parts(seen));
        return view;
    }

    // Eye positions indoors, most spacious first.
    std::vector<glm::dvec3> eyesInside() const {
        std::vector<std::pair<double, glm::dvec3>> eyes;  // mean distance to the surroundings, eye
        const glm::dvec3 size = bounds_.max - bounds_.min;
        for (int i = 0; i < columns * columns; ++i) {
            const double x = bounds_.min.x + size.x * (i % columns + 0.5) / columns;
            const double z = bounds_.min.z + size.z * (i / columns + 0.5) / columns;
            for (const double floor : floors(x, z))
                if (const auto eye = standing({x, floor, z}))
                    if (const auto space = spaceAround(*eye)) eyes.emplace_back(*space, *eye);
        }
        std::stable_sort(eyes.begin(), eyes.end(),
                         [](const auto& a, const auto& b) { return a.first > b.first; });
        std::vector<glm::dvec3> best;
        for (const auto& [space, eye] : eyes)
            if (best.size() < maxEyes) best.push_back(eye);
        return best;
    }

private:
    // Pixel counts of the parts of a view. A part is a primitive with one of six facings, within a factor
    // of two in distance. Distances are clamped to 1/8 to 1/2 of the bounds' radius, so that near geometry
    // gets no extra parts. All back faces are one part; the background is another.
    std::vector<std::size_t> parts(const std::vector<VisibleSurface::Seen>& seen) const {
        const double radius = usableRadius(bounds_);
        std::map<std::tuple<std::uint32_t, int, int>, std::size_t> fronts;
        std::size_t backs = 0;
        for (const auto& at : seen) {
            const glm::dvec3 n = glm::abs(at.normal);
            const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
            const int side = 2 * axis + (at.normal[axis] < 0);
            const int octave =
                static_cast<int>(std::floor(std::log2(std::clamp(at.distance / radius, 0.125, 0.5))));
            ++(at.front ? fronts[{at.instance, side, octave}] : backs);
        }
        std::vector<std::size_t> pixels{ratedWidth * ratedHeight - seen.size(), backs};
        for (const auto& [part, count] : fronts) pixels.push_back(count);
        return pixels;
    }

    // Whether this is a front face whose slope is at most 45 degrees.
    static bool isFloor(const VisibleSurface::Seen& at) { return at.front && at.normal.y > 0.7; }

    // Heights of the floors at (x, z), highest first.
    std::vector<double> floors(double x, double z) const {
        const double step = 1e-4 * usableRadius(bounds_);
        std::vector<double> heights;
        double from = bounds_.max.y + step;
        for (int i = 0; i < maxFloors; ++i) {
            const auto hit = surface_.nearest({x, from, z}, {0, -1, 0});
            if (!hit) break;
            const double height = from - hit->distance;
            if (isFloor(*hit)) heights.push_back(height);
            from = height - step;
        }
        return heights;
    }

    // An eye above the floor. None if the headroom is too small or the floor does not continue around the
    // feet, as on a leaf or a chair. The eye is at least a fifth of the headroom up, for scenes that are
    // not in metres.
    std::optional<glm::dvec3> standing(const glm::dvec3& floor) const {
        const double step = 1e-4 * usableRadius(bounds_);
        const auto above = surface_.nearest(floor + glm::dvec3(0, step, 0), {0, 1, 0});
        const double headroom = above ? above->distance : bounds_.max.y - floor.y;
        if (!(headroom >= minHeadroom)) return std::nullopt;
        const double height = std::max(eyeHeight, headroom / 5);
        const glm::dvec3 eye = floor + glm::dvec3(0, height, 0);
        const double reach = std::max(height / 2, usableRadius(bounds_) / 20);
        for (int direction = 0; direction < 8; ++direction) {
            const double azimuth = glm::radians(45.0 * direction);
            const glm::dvec3 aside = glm::dvec3(std::sin(azimuth), 0, std::cos(azimuth)) * reach;
            const auto below = surface_.nearest(eye + aside, {0, -1, 0});
            if (!below || !isFloor(*below) || std::abs(below->distance - height) > height / 5)
                return std::nullopt;
        }
        return eye;
    }

    // Mean distance from the eye to its surroundings, m; none if it is not surrounded. Directions form a
    // Fibonacci lattice.
    std::optional<double> spaceAround(const glm::dvec3& eye) const {
        const double golden = glm::radians(180.0) * (3 - std::sqrt(5.0));
        const double near = freeCamera(bounds_).near;
        int fronts = 0;
        double sum = 0;
        for (int i = 0; i < aroundDirections; ++i) {
            const double y = 1 - 2 * (i + 0.5) / aroundDirections, r = std::sqrt(1 - y * y);
            const auto hit = surface_.nearest(eye, {r * std::cos(golden * i), y, r * std::sin(golden * i)});
            if (!hit || !hit->front) continue;
            if (!(hit->distance > near)) return std::nullopt;  // the eye touches the surface
            ++fronts;
            sum += hit->distance;
        }
        if (fronts < surrounded * aroundDirections) return std::nullopt;
        return sum / fronts;
    }

    const Bounds& bounds_;  // of the pose
    VisibleSurface surface_;
};

// The candidate with the highest entropy if it exceeds `before` by clearlyMore; else `before`.
DefaultView clearlyBetter(const DefaultView& before, const std::vector<DefaultView>& others) {
    DefaultView best = before;
    for (const DefaultView& other : others)
        if (other.entropy >= before.entropy + clearlyMore && other.entropy > best.entropy) best = other;
    return best;
}

DefaultView outsideAt(DefaultView::Viewpoint viewpoint, const glm::dvec3& backward) {
    DefaultView view;
    view.viewpoint = viewpoint;
    view.backward = glm::normalize(backward);
    return view;
}

// The direction (+1, +0.6, +1), or the opposite one if no triangle faces the first.
DefaultView standardView(const Scene& scene, const Pose& pose, const Bounds& bounds) {
    const auto sees = [&](const DefaultView& view) {
        return anythingFaces(scene, pose, glm::dvec3(worldFromCamera(view, bounds, ratedAspect)[3]));
    };
    const DefaultView standard = outsideAt(DefaultView::Viewpoint::standard, {1, 0.6, 1});
    const DefaultView behind = outsideAt(DefaultView::Viewpoint::outside, {-1, -0.6, -1});
    return !sees(standard) && sees(behind) ? behind : standard;
}

// Eight azimuths at the height of the usual view, then eight from higher up. The first is the usual view.
std::vector<DefaultView> outsideViews(const Rating& rating) {
    std::vector<DefaultView> views;
    for (const double height : {0.6, 1.8})
        for (int step = 0; step < 8; ++step) {
            const double azimuth = glm::radians(45.0 * (step + 1));
            views.push_back(rating.rated(
                outsideAt(DefaultView::Viewpoint::outside,
                          {std::sqrt(2.0) * std::sin(azimuth), height, std::sqrt(2.0) * std::cos(azimuth)})));
        }
    return views;
}

std::vector<DefaultView> insideViews(const Rating& rating) {
    std::vector<DefaultView> views;
    for (const glm::dvec3& eye : rating.eyesInside())
        for (int step = 0; step < yaws; ++step) {
            const double azimuth = glm::radians(360.0) * step / yaws;
            DefaultView view =
                outsideAt(DefaultView::Viewpoint::inside, {std::sin(azimuth), 0, std::cos(azimuth)});
            view.eye = eye;
            views.push_back(rating.rated(view));
        }
    return views;
}

}  // namespace

std::string DefaultView::describe() const {
    const char* from = viewpoint == Viewpoint::inside    ? "from inside"
                       : viewpoint == Viewpoint::outside ? "from another side, because it shows more"
                                                         : "from outside";
    return fmt::format("{}; the scene covers {:.0f} % of the image", from, 100 * covered);
}

double viewEntropy(const std::vector<std::size_t>& pixels) {
    double all = 0, bits = 0;
    for (const std::size_t count : pixels) all += static_cast<double>(count);
    for (const std::size_t count : pixels)
        if (count > 0) bits -= static_cast<double>(count) / all * std::log2(static_cast<double>(count) / all);
    return bits;
}

DefaultView chooseDefaultView(const Scene& scene, const std::string& animation) {
    const Pose pose = poseAt(scene, 0, animation);
    const Bounds bounds = worldBounds(scene, pose);
    const Rating rating(scene, pose, bounds);
    const DefaultView standard = rating.rated(standardView(scene, pose, bounds));
    if (bounds.empty()) return standard;
    return clearlyBetter(clearlyBetter(standard, outsideViews(rating)), insideViews(rating));
}

double targetDistance(const DefaultView& view, const Bounds& bounds, double aspect) {
    if (view.viewpoint == DefaultView::Viewpoint::inside) return usableRadius(bounds);
    return fittingDistance(bounds, lookAt(view.backward, glm::dvec3(0)), aspect);
}

glm::dmat4 worldFromCamera(const DefaultView& view, const Bounds& bounds, double aspect) {
    if (view.viewpoint == DefaultView::Viewpoint::inside) return lookAt(view.eye, view.eye - view.backward);
    const glm::dvec3 centre = usableCentre(bounds);
    return lookAt(centre + view.backward * targetDistance(view, bounds, aspect), centre);
}

// near is a thousandth of the bounds' radius, because an eye inside a building may be that close to a
// wall. Reversed float depth loses no precision by it. The far plane is infinite, so nothing is clipped.
Camera freeCamera(const Bounds& bounds) {
    Camera camera;
    camera.yfov = defaultFov;
    camera.near = 1e-3 * usableRadius(bounds);
    return camera;
}

glm::dvec3 usableCentre(const Bounds& bounds) {
    return bounds.empty() ? glm::dvec3(0) : bounds.centre();
}

glm::dmat4 lookAt(const glm::dvec3& eye, const glm::dvec3& target) {
    const glm::dvec3 backward = glm::normalize(eye - target);
    // Below 1e-6 the direction of `right` would be rounding error.
    const bool atPole = glm::length(glm::cross(glm::dvec3(0, 1, 0), backward)) < 1e-6;
    const glm::dvec3 up = atPole ? glm::dvec3(0, 0, backward.y > 0 ? -1 : 1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(up, backward));
    return glm::dmat4(glm::dvec4(right, 0), glm::dvec4(glm::cross(backward, right), 0),
                      glm::dvec4(backward, 0), glm::dvec4(eye, 1));
}

}  // namespace diptych
