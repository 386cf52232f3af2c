// SPDX-License-Identifier: MIT
// Renders one pixel: its surfaces, light and shadows.
#pragma once

#include "compare/reference/light/haze.h"
#include "compare/reference/light/lighting.h"
#include "compare/reference/pixel.h"
#include "compare/reference/pixel_rays.h"
#include "compare/reference/request.h"
#include "compare/reference/scattering/transmission.h"
#include "compare/reference/scene/geometry.h"
#include "compare/reference/scene/material.h"
#include "compare/reference/scene/mesh_path.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace diptych::reference {

bool isLocal(const Light& light);
// Whether any material blends or transmits light.
bool blendsSomewhere(const Request& request);

class PixelRenderer {
public:
    explicit PixelRenderer(const Request& request);

    // The pixel of render() with light from the surface of Request::decoded in place of the captured one.
    Pixel withDecoded(int x, int y, Pixel pixel) const;
    Pixel render(int x, int y) const;

    // The contribution of each light and of everything else at the pixel's centre; empty in the
    // background.
    void takeTerms(int x, int y, PixelLight& pixel) const;

private:
    std::uint64_t seedOf(int x, int y) const;

    // Start of a shadow ray, relative to the point's distance from the camera: far above rounding errors
    // in double, far below modelled detail. A captured position is only as exact as a float32 depth.
    static constexpr double exactOffset = 1e-9, capturedOffset = 1e-5;
    // Gap between the end of a shadow ray and the light, relative to the ray's length. It keeps a ceiling,
    // whose float32 vertices may round to below the lamp, from occluding a lamp on it.
    static constexpr double lightOffset = 1e-5;
    // Minimum number of directions to a sun's disc, and their random stream, which no light has.
    static constexpr int minDiscSamples = 64;
    static constexpr std::uint64_t discStream = ~std::uint64_t{0};
    // The random stream of light through the pane.
    static constexpr std::uint64_t paneStream = ~std::uint64_t{6};

    // Light from behind the triangle does not reach it, whatever the shading normal, unless the surface
    // transmits it.
    struct Foot {
        glm::dvec3 position, geometric_normal;
        TriangleId without;
        double offset;
        bool both_sides = false;

        // The normal on the side of the light; empty if no light arrives from there.
        std::optional<glm::dvec3> normalTowards(const glm::dvec3& to_light) const {
            const double cosine = glm::dot(geometric_normal, to_light);
            if (cosine > 0) return geometric_normal;
            return both_sides && cosine < 0 ? std::optional(-geometric_normal) : std::nullopt;
        }
    };
    Visibility visibilityFrom(const Foot& foot) const;

    // The visible fraction of the sun's disc, by directions that cover it evenly.
    double seenOfDisc(const Foot& foot, std::uint64_t seed) const;

    // Visibility of the shadow-casting sun, its centre or its disc; 1 without one. A partly visible disc
    // is at the shadow's boundary; otherwise the distance is measured for its centre.
    void takeShadow(Pixel& pixel, const Surface& s, const Foot& foot, std::uint64_t seed) const;

    // The same for shadow-casting points and spots, weighted by the luminance of their irradiance.
    void takeLocalShadows(Pixel& pixel, const Surface& s, const Foot& foot) const;
    void takeShadows(Pixel& pixel, const Surface& s, const Foot& foot, std::uint64_t seed) const;

    // The background behind all haze, as the camera sees it.
    glm::dvec3 background(const PixelRay& ray) const;

    // Applies the haze in front of the surface to its light.
    void takeHaze(Pixel& pixel, const Surface& s) const;
    Ray cameraRay(const PixelRay& pixel, double from) const;

    // The nearest opaque surface.
    std::optional<Hit> nearest(const PixelRay& ray) const;

    // A surface, and the start of rays from it.
    struct Standing {
        Surface surface;
        Foot foot;
        double depth = 0;
    };

    // From a path's captured channels; empty in the background.
    std::optional<Standing> capturedAt(int x, int y) const;

    // From the nearest hit; empty in the background.
    std::optional<Standing> tracedAt(const PixelRay& ray) const;
    Standing standingAt(const Hit& hit, const PixelRay& ray) const;
    Pixel renderCaptured(int x, int y, std::uint64_t seed) const;
    Pixel shaded(const Hit& hit, const PixelRay& ray, std::uint64_t seed) const;
    static bool isOnEdge(const Hit& hit);

    // The nearest surface with transmission in front of `end`.
    std::optional<Hit> paneBefore(double end, const PixelRay& ray) const;

    // Radiance that an opaque surface or the background sends against a ray, through the haze between,
    // W/(sr m^2).
    struct Sent {
        glm::dvec3 radiance{0};
        double uncertainty = 0;
    };
    Sent sentAlong(const PixelRay& ray, const Ray& search, std::uint64_t seed) const;

    // Light that passes a pane: its radiance behind the haze, and the fraction of light from behind that
    // passes; `uncertainty`: of the radiance, as in Shading.
    struct Passed {
        glm::dvec3 radiance{0}, fraction{0};
        double uncertainty = 0;
    };
    // The way of light to a surface with transmission, seen along the pixel's ray.
    struct Pane {
        const Hit& hit;
        const Pixel& pixel;  // its surface and haze
        const PixelRay& ray;
        glm::dvec3 tint;  // transmitted()
    };
    Passed passedThrough(const Pane& pane, std::uint64_t seed) const;
    // Whether light is traced through the closed mesh.
    bool goesThroughMesh(const Hit& hit) const;
    // In one direction of the lobe, with a component's index; through a mesh, along one path.
    Passed passedAs(const Pane& pane, int component, const TransmittedLobe::Sample& lobe,
                    std::uint64_t seed) const;
    Passed passedMesh(const Pane& pane, int component, std::uint64_t seed) const;

    // Draws the nearest surface with transmission over lit. Returns the fraction of what is behind that
    // remains visible, and moves `end` to it: it hides what blends behind it.
    double withPane(Pixel& pixel, double& end, const PixelRay& ray, std::uint64_t seed) const;

    // Blended surfaces in front of `end`, front to back. At equal depth, the one later in the scene is in
    // front.
    std::vector<Hit> blendedHits(double end, const PixelRay& ray) const;

    // Blends them over lit (Porter and Duff 1984, "Compositing Digital Images"). Returns the visible
    // fraction of the background. Transmittance has no colour because the paths blend by one number
    // (shared/transparent/README.md). A surface's haze counts only for the fraction it hides, because the
    // background has its own.
    double blendedBefore(double end, const PixelRay& ray, std::uint64_t seed, Pixel& pixel) const;

    // Channels other than lit and those of the pane show the nearest opaque surface.
    Pixel alongRay(const PixelRay& ray, std::uint64_t seed) const;

    // Draws the pane and blends surfaces over the pixel, including those that lie on it: `end` has float32
    // precision.
    Pixel withBlended(Pixel pixel, double end, const PixelRay& ray, std::uint64_t seed) const;

    // With several samples, light is their mean over the pixel; other channels show the centre.
    Pixel renderScene(int x, int y, std::uint64_t seed) const;

    const Request& request_;
    const glm::dvec3 eye_;
    const PixelRays rays_;
    const Geometry geometry_;
    const Materials materials_;
    const MeshPaths mesh_paths_;
    Lighting lighting_;
    std::optional<EnvironmentLight> background_;  // set if another environment lights the scene
    std::optional<Haze> haze_;
    const Light* sun_ = nullptr;        // the shadow-casting one
    std::vector<const Light*> locals_;  // shadow-casting points and spots
    const bool blends_;                 // whether any material blends
    const double scene_radius_;         // m, of a sphere around all geometry
};

}  // namespace diptych::reference
