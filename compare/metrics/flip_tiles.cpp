// SPDX-License-Identifier: MIT
#include "compare/metrics/flip_tiles.h"

#include "compare/metrics/convolve.h"
#include "compare/metrics/pixel.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <functional>

namespace diptych {
namespace {

using metrics::size;

// Large enough that the border, 10 pixels for the default viewing distance, costs little; rows fit in a
// cache.
constexpr int tileWidth = 256, tileHeight = 128;

constexpr std::size_t planes = 5;  // planes of a ComparableRow

struct Tile {
    int x0, y0, x1, y1;
    int width() const { return x1 - x0; }
};

int radiusOf(const HalfKernel& kernel) {
    return static_cast<int>(kernel.size()) - 1;
}

std::vector<Tile> tilesOf(const ImageRows& image) {
    const int across = (image.width + tileWidth - 1) / tileWidth;
    const int down = (image.height + tileHeight - 1) / tileHeight;
    const auto part = [](int whole, int i, int parts) {
        return static_cast<int>(std::int64_t{whole} * i / parts);
    };
    std::vector<Tile> tiles;
    for (int j = 0; j < down; ++j)
        for (int i = 0; i < across; ++i)
            tiles.push_back({part(image.width, i, across), part(image.height, j, down),
                             part(image.width, i + 1, across), part(image.height, j + 1, down)});
    return tiles;
}

// The buffers of one thread. Rows of a tile enter one by one, padded by `radius_` columns and rows; the
// image's border is repeated. Errors of a row are computed once all its taps are there.
class TileRows {
public:
    TileRows(const FlipPair& pair, const FlipFilters& filters)
        : pair_(pair),
          filters_(filters),
          radius_(filters.radius()),
          stride_(tileWidth + 2 * radius_),
          ring_rows_(static_cast<int>(std::bit_ceil(size(2 * radius_ + 1)))),
          rgb_(size(3 * stride_)),
          upright_(size(stride_)),
          second_(size(tileWidth)),
          taps_(size(2 * radius_ + 1)) {
        for (FilteredImage& filtered_image : images_) {
            filtered_image.ring.resize(size(3 * ring_rows_) * size(stride_));
            filtered_image.filtered.resize(size(7 * tileWidth));
        }
    }

    // Whether both images are equal within the filters' support of the tile; then all errors are 0.
    bool isSame(const Tile& tile) const;
    // Calls use(y, errors) for the tile's rows from the top, with tile.width() errors each. `referenceRow`
    // gives the reference's comparable row y; if empty, it is computed.
    using ReferenceRow = std::function<ComparableRow(int y)>;
    template <class Use>
    void errors(const Tile& tile, const FlipExposure* exposure, const ReferenceRow& referenceRow,
                const Use& use) {
        scan(tile, exposure, referenceRow ? test : reference, test, [&](int y) {
            makeErrors(y, referenceRow);
            use(y, second_.data());
        });
    }
    // Calls use(y, row) with the comparable rows of the reference.
    template <class Use>
    void referenceRows(const Tile& tile, const FlipExposure& exposure, const Use& use) {
        scan(tile, &exposure, reference, reference, [&](int y) { use(y, comparable(reference, y)); });
    }

private:
    // The reference, the test and, if there are holes, a weight plane: 0 at holes, 1 elsewhere.
    struct FilteredImage {
        std::vector<float> ring;      // ring_rows_ rows x 3 planes
        std::vector<float> filtered;  // 7 rows
    };
    enum Which { reference, test, weight };

    // Enters rows of the images `first` to `last`, and calls use(y) when all taps of a tile's row are
    // there.
    template <class Use>
    void scan(const Tile& tile, const FlipExposure* exposure, Which first, Which last, const Use& use) {
        tile_ = tile;
        holes_ = hasHoles();
        for (int y = tile.y0 - radius_; y < tile.y1 + radius_; ++y) {
            for (int which = first; which <= last; ++which) enter(static_cast<Which>(which), y, exposure);
            if (holes_) enterWeights(y);
            if (y - radius_ < tile.y0) continue;
            if (holes_) filter(images_[weight], y - radius_);
            use(y - radius_);
        }
    }

    int paddedWidth() const { return tile_.width() + 2 * radius_; }
    float* row(FilteredImage& filtered_image, int y, int plane) const {
        const int slot = (y - tile_.y0 + radius_) & (ring_rows_ - 1);
        return filtered_image.ring.data() + size(3 * slot + plane) * size(stride_);
    }
    OpponentRow opponents(FilteredImage& p, int y) const {
        return {row(p, y, 0), row(p, y, 1), row(p, y, 2)};
    }
    static FilteredRow filtered(FilteredImage& p) {
        const auto at = [&](int i) { return p.filtered.data() + i * tileWidth; };
        return {at(0), at(1), at(2), at(3), at(4), at(5), at(6)};
    }

    bool hasHoles() const;
    void enter(Which which, int y, const FlipExposure* exposure);
    void gather(const ImageRows& image, int y);
    void enterWeights(int y);

    using Convolve = void(float*, const float* const*, const float*, int, int);
    const float* const* middle() const { return taps_.data() + radius_; }
    // Convolves vertically: a plane's rows around y into upright_.
    void down(Convolve convolve, const HalfKernel& kernel, FilteredImage& filtered_image, int y, int plane);
    // Convolves horizontally: upright_ into a row of the tile's width.
    void along(Convolve convolve, const HalfKernel& kernel, float* out);

    void filter(FilteredImage& filtered_image, int y);
    ComparableRow comparable(Which which, int y);
    void makeErrors(int y, const ReferenceRow& referenceRow);
    void withoutHoles(const FilteredRow& row, const FilteredRow& weights) const;

    const FlipPair& pair_;
    const FlipFilters& filters_;
    int radius_, stride_, ring_rows_;
    Tile tile_{};
    bool holes_ = false;
    FilteredImage images_[3];
    std::vector<float> rgb_, upright_, second_;
    std::vector<const float*> taps_;
};

bool TileRows::isSame(const Tile& tile) const {
    const ImageRows &a = pair_.reference, &b = pair_.test;
    const int left = std::max(tile.x0 - radius_, 0), right = std::min(tile.x1 + radius_, a.width);
    for (int y = std::max(tile.y0 - radius_, 0); y < std::min(tile.y1 + radius_, a.height); ++y)
        if (!a.storesSame(b, left, y, right - left)) return false;
    return true;
}

bool TileRows::hasHoles() const {
    if (pair_.holes.empty()) return false;
    const ImageRows& image = pair_.reference;
    const int left = std::max(tile_.x0 - radius_, 0), right = std::min(tile_.x1 + radius_, image.width);
    for (int y = std::max(tile_.y0 - radius_, 0); y < std::min(tile_.y1 + radius_, image.height); ++y) {
        const Hole* row = pair_.holes.data() + size(y) * size(image.width);
        if (std::any_of(row + left, row + right, [](Hole h) { return h != Hole::none; })) return true;
    }
    return false;
}

// Copies row y of the padded tile to rgb_; holes become black, which is 0 in every plane.
void TileRows::gather(const ImageRows& image, int y) {
    const int line = std::clamp(y, 0, image.height - 1);
    const int first = tile_.x0 - radius_, last = first + paddedWidth();
    const int left = std::max(first, 0), right = std::min(last, image.width);
    image.copy(rgb_.data() + 3 * (left - first), left, line, right - left);
    const auto repeat = [&](int from, int to, int column) {
        for (int x = from; x < to; ++x) image.copy(rgb_.data() + 3 * (x - first), column, line, 1);
    };
    repeat(first, left, 0);
    repeat(right, last, image.width - 1);
    if (!holes_) return;
    const Hole* holes = pair_.holes.data() + size(line) * size(image.width);
    for (int x = first; x < last; ++x)
        if (holes[std::clamp(x, 0, image.width - 1)] != Hole::none)
            std::fill_n(rgb_.data() + 3 * (x - first), 3, 0.0f);
}

void TileRows::enterWeights(int y) {
    const ImageRows& image = pair_.reference;
    const Hole* holes = pair_.holes.data() + size(std::clamp(y, 0, image.height - 1)) * size(image.width);
    const OpponentRow out = opponents(images_[weight], y);
    for (int i = 0; i < paddedWidth(); ++i) {
        const int x = std::clamp(tile_.x0 - radius_ + i, 0, image.width - 1);
        out.y[i] = out.cx[i] = out.cz[i] = holes[x] == Hole::none ? 1.0f : 0.0f;
    }
}

void TileRows::enter(Which which, int y, const FlipExposure* exposure) {
    gather(which == reference ? pair_.reference : pair_.test, y);
    const OpponentRow out = opponents(images_[which], y);
    if (exposure)
        opponentsFromLinear(out, rgb_.data(), paddedWidth(), exposure->scale, exposure->mapper);
    else
        opponentsFromSrgb(out, rgb_.data(), paddedWidth());
}

void TileRows::down(Convolve convolve, const HalfKernel& kernel, FilteredImage& filtered_image, int y,
                    int plane) {
    const int radius = radiusOf(kernel);
    for (int k = -radius; k <= radius; ++k) taps_[size(radius_ + k)] = row(filtered_image, y + k, plane);
    convolve(upright_.data(), middle(), kernel.data(), radius, paddedWidth());
}

void TileRows::along(Convolve convolve, const HalfKernel& kernel, float* out) {
    const int radius = radiusOf(kernel);
    for (int k = -radius; k <= radius; ++k) taps_[size(radius_ + k)] = upright_.data() + radius_ + k;
    convolve(out, middle(), kernel.data(), radius, tile_.width());
}

void TileRows::filter(FilteredImage& filtered_image, int y) {
    const FilteredRow out = filtered(filtered_image);
    const FlipFilters& f = filters_;
    down(convolveEven, f.y, filtered_image, y, 0);
    along(convolveEven, f.y, out.y);
    down(convolveEven, f.cx, filtered_image, y, 1);
    along(convolveEven, f.cx, out.cx);
    down(convolveEven, f.cz[0], filtered_image, y, 2);
    along(convolveEven, f.cz[0], out.cz);
    down(convolveEven, f.cz[1], filtered_image, y, 2);
    along(convolveEven, f.cz[1], second_.data());
    for (int i = 0; i < tile_.width(); ++i)
        out.cz[i] = f.cz_fraction[0] * out.cz[i] + f.cz_fraction[1] * second_[size(i)];

    down(convolveEven, f.smooth, filtered_image, y, 0);
    along(convolveOdd, f.edge, out.edge_x);
    along(convolveEven, f.point, out.point_x);
    down(convolveOdd, f.edge, filtered_image, y, 0);
    along(convolveEven, f.smooth, out.edge_y);
    down(convolveEven, f.point, filtered_image, y, 0);
    along(convolveEven, f.smooth, out.point_y);
}

// Renormalizes filtered values after holes entered as 0: their weights are distributed over the other
// pixels. The feature detectors, whose weights add up to 0, treat a hole as the filtered luminance at the
// evaluated pixel.
void TileRows::withoutHoles(const FilteredRow& row, const FilteredRow& weights) const {
    constexpr float min = 1e-30f;  // for a hole among holes, whose error is set elsewhere
    for (int i = 0; i < tile_.width(); ++i) {
        row.y[i] /= std::max(weights.y[i], min);
        row.cx[i] /= std::max(weights.cx[i], min);
        row.cz[i] /= std::max(weights.cz[i], min);
        row.edge_x[i] -= row.y[i] * weights.edge_x[i];
        row.edge_y[i] -= row.y[i] * weights.edge_y[i];
        row.point_x[i] -= row.y[i] * weights.point_x[i];
        row.point_y[i] -= row.y[i] * weights.point_y[i];
    }
}

ComparableRow TileRows::comparable(Which which, int y) {
    filter(images_[which], y);
    const FilteredRow row = filtered(images_[which]);
    if (holes_) withoutHoles(row, filtered(images_[weight]));
    return comparableRow(row, tile_.width());
}

void TileRows::makeErrors(int y, const ReferenceRow& referenceRow) {
    const ComparableRow r = referenceRow ? referenceRow(y) : comparable(reference, y);
    flipErrors(second_.data(), r, comparable(test, y), tile_.width());
    if (!holes_) return;
    const Hole* holes = pair_.holes.data() + size(y) * size(pair_.reference.width) + tile_.x0;
    for (int i = 0; i < tile_.width(); ++i)
        if (holes[i] != Hole::none) second_[size(i)] = holes[i] == Hole::different ? 1.0f : 0.0f;
}

// most = max(most, next).
void keepLargest(const float* next, float* max, int n) {
    for (int i = 0; i < n; ++i) max[i] = next[i] > max[i] ? next[i] : max[i];
}

void tileErrors(TileRows& rows, const Tile& tile, const std::vector<FlipExposure>& exposures, Image& errors,
                const FilteredReference* cache) {
    if (rows.isSame(tile)) return;
    if (exposures.empty())
        rows.errors(tile, nullptr, {},
                    [&](int y, const float* row) { std::copy_n(row, tile.width(), &errors.at(tile.x0, y)); });
    for (std::size_t i = 0; i < exposures.size(); ++i) {
        TileRows::ReferenceRow reference;
        if (cache && cache->has(i)) reference = [&, i](int y) { return cache->row(i, tile.x0, y); };
        rows.errors(tile, &exposures[i], reference,
                    [&](int y, const float* row) { keepLargest(row, &errors.at(tile.x0, y), tile.width()); });
    }
}

}  // namespace

FilteredReference::FilteredReference(const ImageRows& reference, const std::vector<Hole>& holes,
                                     const FlipFilters& filters, const std::vector<FlipExposure>& exposures,
                                     std::size_t max_bytes)
    : width_(size(reference.width)), height_(size(reference.height)) {
    const std::size_t floats = planes * reference.pixels();
    exposures_.resize(std::min(exposures.size(), max_bytes / (floats * sizeof(float))));
    for (auto& exposure : exposures_) exposure.resize(floats);
    const FlipPair pair{reference, reference, holes};
    const std::vector<Tile> tiles = tilesOf(reference);
    tbb::enumerable_thread_specific<TileRows> rows([&] { return TileRows(pair, filters); });
    tbb::parallel_for(std::size_t{0}, exposures_.size() * tiles.size(), [&](std::size_t i) {
        const Tile& tile = tiles[i % tiles.size()];
        const std::size_t exposure = i / tiles.size();
        rows.local().referenceRows(tile, exposures[exposure], [&](int y, const ComparableRow& row) {
            const float* from[planes] = {row.lightness, row.a, row.b, row.edge, row.point};
            for (std::size_t plane = 0; plane < planes; ++plane)
                std::copy_n(from[plane], tile.width(), exposures_[exposure].data() + at(plane, tile.x0, y));
        });
    });
}

std::size_t FilteredReference::at(std::size_t plane, int x, int y) const {
    return (plane * height_ + size(y)) * width_ + size(x);
}

ComparableRow FilteredReference::row(std::size_t exposure, int x, int y) const {
    const float* of = exposures_[exposure].data();
    return {of + at(0, x, y), of + at(1, x, y), of + at(2, x, y), of + at(3, x, y), of + at(4, x, y)};
}

void flipErrorMap(const FlipPair& pair, const FlipFilters& filters,
                  const std::vector<FlipExposure>& exposures, Image& errors, const FilteredReference* cache) {
    errors = Image(pair.reference.width, pair.reference.height, 1);
    const std::vector<Tile> tiles = tilesOf(errors);
    tbb::enumerable_thread_specific<TileRows> rows([&] { return TileRows(pair, filters); });
    tbb::parallel_for(std::size_t{0}, tiles.size(),
                      [&](std::size_t i) { tileErrors(rows.local(), tiles[i], exposures, errors, cache); });
}

}  // namespace diptych
