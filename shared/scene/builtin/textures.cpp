// SPDX-License-Identifier: MIT
#include "shared/scene/builtin/textures.h"

#include "shared/scene/lights/rig.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace diptych {
namespace {

constexpr int FULL = 65535;

std::uint32_t hash(int x, int y, std::uint32_t salt) {
    return pcg(static_cast<std::uint32_t>(x) + pcg(static_cast<std::uint32_t>(y) + pcg(salt)));
}

// Smooth step from 0 to FULL.
int smooth(int t) {
    const std::int64_t x = std::clamp(t, 0, FULL);
    return static_cast<int>(x * x / FULL * (3 * FULL - 2 * x) / FULL);
}

int blend(int a, int b, int t) {
    return static_cast<int>(a + (static_cast<std::int64_t>(b) - a) * t / FULL);
}

int wrap(int x, int period) {
    return ((x % period) + period) % period;
}

// Value noise of `columns` x `rows` cells over size x size texels, 0 to FULL.
int noise(int x, int y, int size, int columns, int rows, std::uint32_t salt) {
    const auto corner = [&](int i, int j) {
        return static_cast<int>(hash(wrap(i, columns), wrap(j, rows), salt) >> 16);
    };
    const int fx = wrap(x, size) * columns, fy = wrap(y, size) * rows;
    const int i = fx / size, j = fy / size;
    const int tx = smooth(static_cast<int>(std::int64_t{fx % size} * FULL / size));
    const int ty = smooth(static_cast<int>(std::int64_t{fy % size} * FULL / size));
    return blend(blend(corner(i, j), corner(i + 1, j), tx), blend(corner(i, j + 1), corner(i + 1, j + 1), tx),
                 ty);
}

int octaves(int x, int y, int size, int cells, int count, std::uint32_t salt) {
    int sum = 0, weight = FULL / 2;
    for (int octave = 0; octave < count; ++octave, cells *= 2, weight /= 2)
        sum += blend(0, weight, noise(x, y, size, cells, cells, salt + static_cast<std::uint32_t>(octave)));
    return std::min(sum, FULL);
}

// A cell of a wall pattern: its indices, and the texel's distance to the nearest edge, in texels.
struct Cell {
    int column, row, edge;
};

Cell cellAt(int x, int y, int size, const Masonry& masonry) {
    const int width = size / masonry.cells, height = size / masonry.rows, row = y / height;
    const int shifted = wrap(x + (masonry.bricks && row % 2 == 1 ? width / 2 : 0), size);
    const int dx = shifted % width, dy = y % height;
    return {shifted / width, row, std::min({dx, width - 1 - dx, dy, height - 1 - dy})};
}

std::size_t texelsOf(int size) {
    return static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
}

// Evaluates `texel` at every position, rows in parallel.
template <class Texel>
HeightField heights(int size, Texel&& texel) {
    HeightField field{size, std::vector<int>(texelsOf(size))};
    tbb::parallel_for(0, size, [&](int y) {
        int* next = field.height.data() + static_cast<std::size_t>(size) * static_cast<std::size_t>(y);
        for (int x = 0; x < size; ++x) *next++ = texel(x, y);
    });
    return field;
}

template <class Texel>
TextureImage image(const std::string& name, int size, Texel&& texel) {
    TextureImage made{name, size, size, {}};
    made.rgba.resize(texelsOf(size) * 4);
    tbb::parallel_for(0, size, [&](int y) {
        std::uint8_t* next =
            made.rgba.data() + static_cast<std::size_t>(4 * size) * static_cast<std::size_t>(y);
        for (int x = 0; x < size; ++x) next = std::ranges::copy(texel(x, y), next).out;
    });
    return made;
}

std::uint8_t byte(int value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0, 255));
}

Rgba8 mix(const Rgba8& a, const Rgba8& b, int t) {
    Rgba8 out{};
    for (std::size_t i = 0; i < 4; ++i) out[i] = byte(blend(a[i], b[i], t));
    return out;
}

}  // namespace

int HeightField::at(int x, int y) const {
    return height[static_cast<std::size_t>(wrap(y, size)) * static_cast<std::size_t>(size) +
                  static_cast<std::size_t>(wrap(x, size))];
}

HeightField brickHeights(int size) {
    return heights(size, [size](int x, int y) {
        // Worn edges: they vary by a few texels.
        const Cell cell = cellAt(x, y, size, {4, 8, true});
        const int worn = cell.edge * 4096 - octaves(x, y, size, 16, 3, 7) / 2;
        const int face = FULL * 3 / 4 + static_cast<int>(hash(cell.column, cell.row, 1) >> 19);
        const int grain = octaves(x, y, size, 32, 3, 11) / 8;
        return std::min(FULL, blend(octaves(x, y, size, 64, 2, 3) / 5, face + grain, smooth(worn * 2)));
    });
}

HeightField tileHeights(int size) {
    return heights(size, [size](int x, int y) {
        const Cell cell = cellAt(x, y, size, {4, 4, false});
        const int edge = smooth((cell.edge - size / 256) * (FULL * 64 / size));
        return blend(octaves(x, y, size, 64, 2, 5) / 8, FULL - octaves(x, y, size, 8, 4, 9) / 24, edge);
    });
}

HeightField plasterHeights(int size) {
    return heights(size, [size](int x, int y) { return octaves(x, y, size, 4, 5, 21); });
}

HeightField weaveHeights(int size) {
    return heights(size, [size](int x, int y) {
        const int cell = size / 8, i = x / cell, j = y / cell;
        // Strands have a round profile across, and pass over and under each other along their length.
        const auto arc = [cell](int t) {
            const std::int64_t d = 2 * (t % cell) + 1 - cell;
            return static_cast<int>(FULL - FULL * d * d / (std::int64_t{cell} * cell));
        };
        const bool horizontal = (i + j) % 2 == 0;
        const int across = arc(horizontal ? y : x), along = arc(horizontal ? x : y);
        return blend(0, FULL / 4 + 3 * (along / 4), across);
    });
}

TextureImage normalMap(const std::string& name, const HeightField& field, double relief) {
    return image(name, field.size, [&](int x, int y) {
        // Central differences. v grows downwards, so the slope along the bitangent is the texel above
        // minus the one below. The products are exact in double, so compilers cannot round them
        // differently.
        const double dx = field.at(x - 1, y) - field.at(x + 1, y),
                     dy = field.at(x, y + 1) - field.at(x, y - 1);
        const double dz = std::round(2 * FULL / relief);
        const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
        const auto encode = [length](double d) {
            return byte(static_cast<int>(std::lround((d / length + 1) * 127.5)));
        };
        return Rgba8{encode(dx), encode(dy), encode(dz), 255};
    });
}

TextureImage colorMap(const std::string& name, const HeightField& field, Rgba8 low, Rgba8 high,
                      const Masonry& masonry, int variation) {
    return image(name, field.size, [&](int x, int y) {
        const Cell cell = cellAt(x, y, field.size, masonry);
        const int dark = static_cast<int>(hash(cell.column, cell.row, 33) >> 24) * variation / 255;
        const Rgba8 color = mix(low, high, field.at(x, y));
        return mix(color, {0, 0, 0, color[3]}, dark * FULL / 255);
    });
}

TextureImage checker(const std::string& name, int size, int cells, Rgba8 a, Rgba8 b) {
    return image(name, size,
                 [=](int x, int y) { return (x * cells / size + y * cells / size) % 2 == 0 ? a : b; });
}

TextureImage leaf(const std::string& name, int size) {
    return image(name, size, [size](int x, int y) {
        // From the tip (top) to the stem, in 1/1024 of the size. Half the width follows a distorted
        // parabola.
        const int u = 1024 * x / size - 512, v = 1024 * y / size;
        const int t = std::clamp(v - 20, 0, 800);
        const int half = t * (800 - t) / 800 * (600 + t) / 800;  // widest below the middle
        const bool stem = std::abs(u) < 18 && v >= 780 && v < 1010;
        const bool inside = v > 20 && v < 820 && std::abs(u) < half;
        const int rib = std::abs(u) < 10 ? FULL : 0;
        const int side = wrap(v - std::abs(u) * 3 / 4, 96) < 10 ? FULL / 2 : 0;
        const int shade = octaves(x, y, size, 8, 3, 41);
        const Rgba8 blade = mix({38, 84, 36, 255}, {92, 142, 58, 255}, shade);
        Rgba8 color = mix(blade, {164, 186, 104, 255}, std::max(rib, side));
        color[3] = stem || inside ? 255 : 0;
        return color;
    });
}

TextureImage lattice(const std::string& name, int size) {
    return image(name, size, [size](int x, int y) {
        const int cell = size / 4, bar = cell / 7;
        const int a = wrap(x + y, cell), b = wrap(x - y, cell);
        const int edge = std::min({a, cell - a, b, cell - b});
        Rgba8 color =
            mix({120, 84, 40, 255}, {214, 170, 96, 255}, std::max(0, FULL - edge * FULL / (bar + 1)));
        color[3] = edge <= bar ? 255 : 0;
        return color;
    });
}

TextureImage brushed(const std::string& name, int size) {
    return image(name, size, [size](int x, int y) {
        const int streak = (noise(x, y, size, 4, size / 2, 51) + noise(x, y, size, 8, size / 4, 52)) / 2;
        return Rgba8{255, byte(60 + streak * 120 / FULL), 255, 255};
    });
}

TextureImage occlusion(const std::string& name, const HeightField& field) {
    return image(name, field.size, [&](int x, int y) {
        const std::uint8_t open = byte(64 + field.at(x, y) * 191 / FULL);
        return Rgba8{open, open, open, 255};
    });
}

TextureImage dusk(const std::string& name, int size) {
    return image(name, size, [size](int x, int y) {
        constexpr std::array<Rgba8, 5> SKY{{{255, 158, 84, 255},
                                            {196, 112, 110, 255},
                                            {96, 90, 140, 255},
                                            {48, 66, 122, 255},
                                            {24, 38, 84, 255}}};
        const int clouds = (octaves(x, 3 * y, size, 4, 4, 71) - FULL / 2) / 4;
        const int t = std::clamp(4 * FULL / size * (size - 1 - y) + clouds, 0, 4 * FULL - 1);
        const auto band = static_cast<std::size_t>(t / FULL);
        const Rgba8 sky = mix(SKY[band], SKY[band + 1], smooth(t % FULL));
        const bool star = y < size / 2 && hash(x, y, 77) % 977 == 0;
        return star ? mix(sky, {255, 250, 240, 255}, FULL * (size / 2 - y) / size * 2) : sky;
    });
}

TextureImage glyphs(const std::string& name, int size) {
    return image(name, size, [size](int x, int y) {
        const int cell = size / 8, dot = cell / 7, i = x / cell, j = y / cell;
        const int column = (x % cell) / dot - 1, row = (y % cell) / dot - 1;
        const bool inside = column >= 0 && column < 5 && row >= 0 && row < 5;
        const int mirrored = std::min(column, 4 - column);
        const bool lit = inside && (hash(i * 8 + mirrored, j * 8 + row, 61) & 1) != 0;
        return lit ? Rgba8{255, byte(140 + 14 * j), byte(60 + 24 * i), 255} : Rgba8{0, 0, 0, 255};
    });
}

}  // namespace diptych
