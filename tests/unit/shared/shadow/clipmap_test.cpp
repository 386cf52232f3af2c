// SPDX-License-Identifier: MIT
// Positions of the sun's clipmap levels, and the pages with a slot.
#include "shared/shadow/clipmap_cache.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace diptych {
namespace {

const glm::dvec3 sunwards = glm::normalize(glm::dvec3(0.3, 1, 0.2));
constexpr ClipmapRequest smallMap{.size = 256, .page = 32, .kernel = 3};

View viewAt(const glm::dvec3& eye, double metre = 1) {
    View view;
    view.width = 320;
    view.height = 180;
    view.camera.near = 0.1 * metre;
    view.camera.world_from_camera =
        glm::inverse(glm::lookAt(eye, eye + glm::dvec3(1, -0.5, 0.3) * metre, {0.01, 1, 0.02}));
    return view;
}

Bounds fieldOf(double metre = 1) {
    Bounds bounds;
    bounds.min = glm::dvec3(-40, -2, -30) * metre;
    bounds.max = glm::dvec3(40, 10, 30) * metre;
    return bounds;
}

Clipmap mapAt(const glm::dvec3& eye) {
    return fitClipmap(viewAt(eye), fieldOf(), sunwards, smallMap);
}

// Level and page, chosen as in the shaders.
Clipmap::Place placeFor(const Clipmap& map, const glm::dvec3& point) {
    std::size_t level = 0;
    while (level + 1 < map.levels.size() && glm::distance(point, map.centre) > map.levels[level].area.end)
        ++level;
    const CascadeArea& area = map.levels[level].area;
    const glm::dvec2 page =
        glm::floor((glm::dvec2(map.grid.space.from(point)) - area.corner) / (area.texel * map.grid.page));
    return {level, static_cast<int>(page.x), static_cast<int>(page.y)};
}

using Marks = std::vector<gpu::uint>;
Marks marksOf(const Clipmap& map, const std::vector<Clipmap::Place>& places) {
    Marks marks((map.pages() + 31) / 32);
    for (const Clipmap::Place& place : places) {
        const std::size_t page = map.numberOf(place);
        marks[page / 32] |= 1u << (page % 32);
    }
    return marks;
}

// Pages requested by an image of the field's ground and walls, seen from the map's centre.
Marks marksAround(const Clipmap& map, int points = 3000) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(0, 1);
    const Bounds field = fieldOf();
    std::vector<Clipmap::Place> places;
    for (int i = 0; i < points; ++i) {
        // Logarithmic distances, from 1/4 to 16 m.
        const glm::dvec3 away = glm::normalize(glm::dvec3(any(random), any(random), any(random)) - 0.5) *
                                std::exp2(6 * any(random) - 2);
        places.push_back(placeFor(map, glm::clamp(map.centre + away, field.min, field.max)));
    }
    return marksOf(map, places);
}

std::size_t countOf(const Marks& marks) {
    std::size_t count = 0;
    for (const gpu::uint word : marks) count += static_cast<std::size_t>(std::popcount(word));
    return count;
}

void draw(ClipmapCache& cache, const ResidentPages& pages) {
    for (const PageDraw& page : cache.stale(pages.resident)) cache.drawn(page);
}

// ---- positions of levels -----------------------------------------------------------------------------

// Every point of the scene is in its level's window, at any scale, camera and lens. The page's slot
// contains all texels that filters and biases read around it.
TEST(Clipmap, WindowsHoldWhatTheirLevelsServe) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const double metre : {1e-3, 1.0, 1e4})
        for (const bool orthographic : {false, true})
            for (const glm::dvec3& to_light : {sunwards, glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0)})
                for (int i = 0; i < 10; ++i) {
                    View view =
                        viewAt(glm::dvec3(any(random), any(random), any(random)) * (60 * metre), metre);
                    view.camera.orthographic = orthographic;
                    view.camera.ymag = 3 * metre;
                    const Clipmap map = fitClipmap(view, fieldOf(metre), to_light, smallMap);
                    ASSERT_GE(map.levels.size(), 2u);
                    EXPECT_LE(map.levels.size(), 30u);
                    for (int k = 0; k < 100; ++k) {
                        const glm::dvec3 point =
                            glm::dvec3(40 * any(random), 4 + 6 * any(random), 30 * any(random)) * metre;
                        const Clipmap::Place place = placeFor(map, point);
                        const int width = place.level + 1 < map.levels.size() ? map.width : 1;
                        EXPECT_TRUE(place.x >= 0 && place.y >= 0 && place.x < width && place.y < width)
                            << metre << " level " << place.level << ": " << place.x << " " << place.y;
                        const Clipmap::Place same = map.placeOf(map.numberOf(place));
                        EXPECT_TRUE(same.level == place.level && same.x == place.x && same.y == place.y);
                        EXPECT_LT(map.numberOf(place), map.pages());
                        const double z = map.grid.space.from(point).z;
                        EXPECT_TRUE(z < map.grid.near && z > map.grid.far);
                    }
                }
}

// Each level has texels twice as wide as the previous one and reaches twice as far; the last covers the
// whole scene.
TEST(Clipmap, LevelsDouble) {
    const Clipmap map = mapAt({3, 1, -4});
    for (std::size_t i = 1; i + 1 < map.levels.size(); ++i) {
        EXPECT_EQ(map.levels[i].area.texel, 2 * map.levels[i - 1].area.texel);
        EXPECT_EQ(map.levels[i].area.end, 2 * map.levels[i - 1].area.end);
    }
    EXPECT_EQ(map.levels.front().area.end, smallMap.size / 2 * map.levels.front().area.texel);
    EXPECT_LE(map.levels.front().area.end, 0.25) << "the near plane is at 0.1 m";
    EXPECT_TRUE(std::isinf(map.levels.back().area.end));
}

// The same part of the world has the same page and depths for any camera position.
TEST(Clipmap, PagesAndDepthsStayWhereTheyAreWhileTheCameraMoves) {
    const Clipmap here = mapAt({3, 1, -4}), there = mapAt({-17.3, 5, 2});
    EXPECT_EQ(here.grid, there.grid);
    const glm::dvec3 point(1, 0, 2);
    std::size_t compared = 0;
    for (std::size_t a = 0; a < here.levels.size(); ++a)
        for (std::size_t b = 0; b < there.levels.size(); ++b) {
            if (here.levels[a].exponent != there.levels[b].exponent) continue;
            const auto address = [&](const Clipmap& map, std::size_t level) {
                const CascadeArea& area = map.levels[level].area;
                const glm::dvec2 page = glm::floor((glm::dvec2(map.grid.space.from(point)) - area.corner) /
                                                   (area.texel * map.grid.page));
                return map.addressOf({level, static_cast<int>(page.x), static_cast<int>(page.y)});
            };
            EXPECT_EQ(address(here, a), address(there, b));
            ++compared;
        }
    EXPECT_GE(compared, 5u);
    // Casters may move a little without changing the depths.
    Bounds moved = fieldOf();
    moved.max.y += 0.01;
    EXPECT_EQ(fitClipmap(viewAt({3, 1, -4}), moved, sunwards, smallMap).grid, here.grid);
}

// A page's parent in the next level covers it, also at negative coordinates.
TEST(Clipmap, ParentsCoverTheirPages) {
    for (const glm::dvec3& eye : {glm::dvec3(3, 1, -4), glm::dvec3(-39, -1, -29), glm::dvec3(39, 9, 29)}) {
        const Clipmap map = mapAt(eye);
        for (std::size_t i = 0; i + 1 < map.pages(); ++i) {
            const Clipmap::Place place = map.placeOf(i), parent = map.parentOf(place);
            const bool whole = parent.level + 1 == map.levels.size();
            ASSERT_TRUE(parent.x >= 0 && parent.y >= 0 && parent.x < map.width && parent.y < map.width);
            if (whole) continue;
            const auto areaOf = [&](const Clipmap::Place& p) {
                CascadeArea area = map.grid.areaOf(map.addressOf(p));
                area.corner += map.grid.gutter * area.texel;
                return area;
            };
            const CascadeArea own = areaOf(place), its = areaOf(parent);
            const double side = own.texel * map.grid.page;
            EXPECT_TRUE(own.corner.x >= its.corner.x && own.corner.y >= its.corner.y &&
                        own.corner.x + side <= its.corner.x + 2 * side &&
                        own.corner.y + side <= its.corner.y + 2 * side)
                << i;
        }
    }
}

// The bias moves a surface, also sideways, and the filter reads around it: never beyond the page's slot.
TEST(Clipmap, TheGutterHoldsWhatFiltersRead) {
    for (const int kernel : {1, 3, 5, 7})
        for (const double bias : {0.0, 0.5, 4.0}) {
            ClipmapRequest request = smallMap;
            request.kernel = kernel;
            request.bias = bias;
            const Clipmap map = fitClipmap(viewAt({3, 1, -4}), fieldOf(), sunwards, request);
            const double aside = std::sqrt(2.0) * (0.5 * kernel + 0.5);
            EXPECT_GE(map.grid.gutter, bias + aside + 0.5 * kernel + 1);
            EXPECT_LE(map.grid.gutter, bias + aside + 0.5 * kernel + 3);
        }
}

// ---- pages with slots --------------------------------------------------------------------------------

// Every marked page is resident if there is capacity; otherwise a page that covers it is. No two pages
// share a slot.
void expectResident(const Clipmap& map, const Marks& marks, const ResidentPages& pages, std::uint32_t slots) {
    ASSERT_EQ(pages.table.size(), map.pages());
    EXPECT_EQ(pages.requested, countOf(marks));
    EXPECT_LE(pages.resident.size(), slots);
    std::set<std::uint32_t> used;
    for (const PageDraw& page : pages.resident) {
        EXPECT_LT(page.slot, slots);
        EXPECT_TRUE(used.insert(page.slot).second) << "two pages in one slot";
    }
    std::size_t fallback = 0;
    for (std::size_t i = 0; i < map.pages(); ++i) {
        const ResidentPages::Entry& entry = pages.table[i];
        ASSERT_LT(entry.resident, pages.resident.size());
        Clipmap::Place place = map.placeOf(i);
        fallback += (marks[i / 32] >> (i % 32) & 1u) != 0 && entry.level != place.level;
        while (place.level < entry.level) place = map.parentOf(place);
        EXPECT_EQ(pages.resident[entry.resident].page, map.addressOf(place)) << i;
    }
    EXPECT_EQ(pages.fallback, fallback);
}

TEST(ClipmapCache, EveryPageIsServedWhateverThePoolHolds) {
    const Clipmap map = mapAt({3, 1, -4});
    const Marks marks = marksAround(map);
    const auto all = static_cast<std::uint32_t>(countOf(marks));
    ASSERT_GT(all, 60u);
    for (const std::uint32_t slots : {1u, 2u, 7u, all / 2, all - 1, all, all + 1, 10 * all}) {
        ClipmapCache cache(slots);
        const ResidentPages pages = cache.makeResident(map, marks);
        expectResident(map, marks, pages, slots);
        // The whole scene's page is resident in addition to the requested ones.
        EXPECT_EQ(pages.fallback == 0, slots > all) << slots;
        if (slots == 1) {
            EXPECT_EQ(pages.fallback, all);
        }
    }
}

// Coarser levels fall back last. If the pool is almost large enough, only the farthest pages of the finest
// level use the next one.
TEST(ClipmapCache, TheFinestLevelGivesWayFirst) {
    const Clipmap map = mapAt({3, 1, -4});
    const Marks marks = marksAround(map);
    ClipmapCache cache(static_cast<std::uint32_t>(countOf(marks)) - 3);
    const ResidentPages pages = cache.makeResident(map, marks);
    EXPECT_GT(pages.fallback, 0u);
    EXPECT_LE(pages.fallback, 24u);
    std::size_t finest = map.levels.size();
    for (std::size_t i = 0; i < map.pages(); ++i)
        if ((marks[i / 32] >> (i % 32) & 1u) != 0) finest = std::min(finest, map.placeOf(i).level);
    for (std::size_t i = 0; i < map.pages(); ++i)
        if ((marks[i / 32] >> (i % 32) & 1u) != 0 && pages.table[i].level != map.placeOf(i).level) {
            EXPECT_LE(map.placeOf(i).level, finest + 1);
            EXPECT_EQ(pages.table[i].level, map.placeOf(i).level + 1);
        }
}

// One step back leaves a quarter of a level's pages. So half a pool costs little more than one step, and a
// small pool still has finer pages than the whole scene's.
TEST(ClipmapCache, ASmallPoolFallsBackStepByStep) {
    const Clipmap map = mapAt({3, 1, -4});
    const Marks marks = marksAround(map, 20000);
    const auto farthestBack = [&](std::size_t slots) {
        ClipmapCache cache(static_cast<std::uint32_t>(slots));
        const ResidentPages pages = cache.makeResident(map, marks);
        std::size_t max = 0, whole = 0;
        for (std::size_t i = 0; i < map.pages(); ++i) {
            if ((marks[i / 32] >> (i % 32) & 1u) == 0) continue;
            max = std::max(max, pages.table[i].level - map.placeOf(i).level);
            whole += pages.table[i].level + 1 == map.levels.size();
        }
        return std::pair(max, whole);
    };
    const std::size_t all = countOf(marks);
    EXPECT_LE(farthestBack(all / 2).first, 3u);
    for (const std::size_t slots : {all / 2, all / 8, std::size_t{16}})
        EXPECT_EQ(farthestBack(slots).second, 0u) << slots;
    EXPECT_EQ(farthestBack(1).second, all);
}

// A static camera redraws nothing, nor does another viewpoint with the same pages.
TEST(ClipmapCache, WhatStaysIsDrawnOnce) {
    const Clipmap map = mapAt({3, 1, -4});
    const Marks marks = marksAround(map);
    ClipmapCache cache(4096);
    for (int frame = 1; frame <= 4; ++frame) {
        const ResidentPages pages = cache.makeResident(map, marks);
        EXPECT_EQ(cache.stale(pages.resident).size(), frame == 1 ? pages.resident.size() : 0u) << frame;
        draw(cache, pages);
    }
}

// The marks alone determine the resident pages: after any history they are the same as in a new cache.
// Pages that are not redrawn have the right contents.
TEST(ClipmapCache, HistoryChangesNoPage) {
    const auto walk = [] {
        std::vector<glm::dvec3> eyes;
        for (int i = 0; i < 100; ++i) eyes.push_back({3 + 0.05 * i, 1, -4 - 0.02 * i});
        eyes.push_back({-35, 8, 25});  // a teleport to negative coordinates
        // Jumps by exactly one window's width of some levels, and back.
        const Clipmap map = mapAt(eyes.back());
        for (const std::size_t level : {std::size_t{3}, std::size_t{5}})
            for (const double to : {1.0, -1.0})
                eyes.push_back(eyes.back() +
                               map.grid.space.x * (to * std::ldexp(map.width, map.levels[level].exponent)));
        return eyes;
    }();
    for (const std::uint32_t slots : {40u, 200u, 4096u}) {
        ClipmapCache cache(slots);
        std::map<std::uint32_t, PageAddress> atlas;  // page in each slot
        std::size_t redrawn = 0, resident_pages = 0;
        for (std::size_t step = 0; step < walk.size(); ++step) {
            const Clipmap map = mapAt(walk[step]);
            const Marks marks = marksAround(map, 600);
            const ResidentPages pages = cache.makeResident(map, marks);
            expectResident(map, marks, pages, slots);
            for (const PageDraw& page : cache.stale(pages.resident)) {
                atlas[page.slot] = page.page;
                ++redrawn;
            }
            draw(cache, pages);
            resident_pages += pages.resident.size();
            for (const PageDraw& page : pages.resident) ASSERT_EQ(atlas.at(page.slot), page.page) << step;
            ClipmapCache anew(slots);
            const ResidentPages alone = anew.makeResident(map, marks);
            ASSERT_EQ(pages.resident.size(), alone.resident.size());
            for (std::size_t i = 0; i < alone.resident.size(); ++i)
                ASSERT_EQ(pages.resident[i].page, alone.resident[i].page) << step;
            for (std::size_t i = 0; i < map.pages(); ++i)
                ASSERT_EQ(pages.table[i].resident, alone.table[i].resident);
        }
        EXPECT_LT(redrawn, resident_pages / 2);
    }
}

// If a caster moves, exactly the pages that show it are redrawn, including those where only a filter reads
// it. The whole scene's page is always redrawn.
TEST(ClipmapCache, WhatHasMovedIsDrawnAnew) {
    const Clipmap map = mapAt({3, 1, -4});
    const Marks marks = marksAround(map);
    ClipmapCache cache(4096);
    const ResidentPages pages = cache.makeResident(map, marks);
    draw(cache, pages);
    const glm::dvec2 lower(map.grid.space.from({4, 0, -4})), upper = lower + glm::dvec2(0.5, 0.7);
    cache.moved(lower, upper);
    std::size_t fresh = 0;
    const std::vector<PageDraw> stale = cache.stale(pages.resident);
    for (const PageDraw& page : pages.resident) {
        const CascadeArea area = map.grid.areaOf(page.page);
        const double side = area.texel * map.grid.slot();
        const bool shows = area.corner.x <= upper.x && area.corner.y <= upper.y &&
                           area.corner.x + side >= lower.x && area.corner.y + side >= lower.y;
        const bool drawn =
            std::ranges::none_of(stale, [&](const PageDraw& s) { return s.page == page.page; });
        EXPECT_EQ(drawn, !shows && page.page.exponent != PageAddress::whole_scene);
        fresh += drawn;
    }
    EXPECT_GT(stale.size(), 1u);
    EXPECT_GT(fresh, stale.size());
}

// With another sun or another depth range, no page is kept.
TEST(ClipmapCache, PagesOfAnotherGridAreForgotten) {
    const Clipmap map = mapAt({3, 1, -4});
    const Marks marks = marksAround(map);
    Bounds higher = fieldOf();
    higher.max.y += 100;
    for (const Clipmap& other : {fitClipmap(viewAt({3, 1, -4}), fieldOf(),
                                            glm::normalize(sunwards + glm::dvec3(1e-6, 0, 0)), smallMap),
                                 fitClipmap(viewAt({3, 1, -4}), higher, sunwards, smallMap)}) {
        ClipmapCache cache(4096);
        draw(cache, cache.makeResident(map, marks));
        const ResidentPages pages = cache.makeResident(other, marksAround(other));
        EXPECT_EQ(cache.stale(pages.resident).size(), pages.resident.size());
    }
}

// A page that got a slot but was not drawn, because its view was not drawn, is drawn the next time.
TEST(ClipmapCache, WhatWasNotDrawnIsNotTakenForDrawn) {
    const Clipmap map = mapAt({3, 1, -4});
    const Marks marks = marksAround(map);
    ClipmapCache cache(4096);
    (void)cache.makeResident(map, marks);
    const ResidentPages pages = cache.makeResident(map, marks);
    EXPECT_EQ(cache.stale(pages.resident).size(), pages.resident.size());
}

// With the camera standing on the ground, a step of 5 cm keeps more than nine of ten pages.
TEST(ClipmapCache, ASmallStepRedrawsFewPages) {
    const auto marksOfGround = [](const Clipmap& map) {
        std::vector<Clipmap::Place> places;
        for (double x = -39.9; x < 40; x += 0.1)
            for (double z = -29.9; z < 30; z += 0.1) places.push_back(placeFor(map, {x, 0, z}));
        return marksOf(map, places);
    };
    ClipmapCache cache(4096);
    const Clipmap before = mapAt({3, 1.7, -4}), after = mapAt({3.05, 1.7, -4});
    draw(cache, cache.makeResident(before, marksOfGround(before)));
    const ResidentPages pages = cache.makeResident(after, marksOfGround(after));
    EXPECT_GT(pages.resident.size(), 200u);
    EXPECT_LT(10 * cache.stale(pages.resident).size(), pages.resident.size());
    RecordProperty("redrawn", static_cast<int>(cache.stale(pages.resident).size()));
    RecordProperty("pages", static_cast<int>(pages.resident.size()));
}

}  // namespace
}  // namespace diptych
