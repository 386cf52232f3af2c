// SPDX-License-Identifier: MIT
#include "shared/light/light_lists.h"

#include "shared/contract/bindings.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

namespace diptych {

namespace {

constexpr auto listTypes = bindingTypes({LIST_BINDINGS(DIPTYCH_BINDING_ROW)});

// Size limit of each buffer, even if the device allows more.
constexpr std::uint64_t maxBytes = std::uint64_t{256} << 20;

constexpr std::uint32_t threads = 64;  // per workgroup, in all compute shaders but the prefix sum

std::uint32_t workgroups(std::uint32_t count) {
    return (count + threads - 1) / threads;
}

// Slices per thread in gather: fewer slices mean more threads, which wait less for each other.
constexpr gpu::uint slicesOfThread = 8;

constexpr const char* assigning = "assign lights";  // name of the passes

// In rows, because devices need to support only 65,535 workgroups per axis.
glm::uvec3 inRows(std::uint64_t count, gpu::uint depth = 1) {
    constexpr std::uint64_t row = 32768;
    const std::uint64_t groups = (count + threads - 1) / threads;
    return {std::min(groups, row), (groups + row - 1) / row, depth};
}

// List of all local lights; each light type starts a new entry.
std::vector<gpu::uint> listOfAll(const gpu::LightGrid& grid) {
    std::vector<gpu::uint> all;
    const auto add = [&](gpu::uint first, gpu::uint end, gpu::uint endEntry) {
        for (gpu::uint i = first; i < end; ++i) all.push_back(grid.first_local + i);
        all.resize(std::size_t{endEntry} * grid.width, grid.null_light);
    };
    add(0, grid.point_end, grid.all_point_end);
    add(grid.point_end, grid.spot_end, grid.all_spot_end);
    add(grid.spot_end, grid.local_lights, grid.all_end);
    return all;
}

GpuBuffer listBuffer(Device& device, const char* name, std::uint64_t count, std::uint64_t each,
                     VkBufferUsageFlags usage = 0) {
    return GpuBuffer(device, name, std::max<std::uint64_t>(count * each, 16),
                     usage | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                         VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
}

// Number of texels of the largest buffer that shaders may read as texels.
std::uint64_t maxTexels(const gpu::LightGrid& grid, const GpuLights& lights, std::size_t bounds) {
    constexpr std::uint64_t texel = sizeof(gpu::vec4);
    return std::max({lights.lights.size() * sizeof(gpu::Light) / texel,
                     lights.spot_cones.size() * sizeof(gpu::SpotCone) / texel,
                     lights.area_lights.size() * sizeof(gpu::AreaLight) / texel,
                     bounds * sizeof(gpu::LightBound) / texel, std::uint64_t{grid.lists} + 1,
                     std::uint64_t{grid.capacity},  // one texel per entry, whatever its width
                     std::uint64_t{grid.words} * grid.list_stride / 4});
}

}  // namespace

std::span<const VkDescriptorType> listBindings() {
    return listTypes;
}

ListLayouts::ListLayouts(Device& device, VkDescriptorSetLayout frame)
    : lists_(makeSetLayout(device, listTypes)) {
    const std::array<VkDescriptorSetLayout, 2> sets{frame, lists_};
    pipeline_ = makePipelineLayout(device, sets);
}

OwnedBufferView texelsUnless(bool addressed, Device& device, const std::string& name, const GpuBuffer& buffer,
                             VkFormat format) {
    return makeTexelView(device, name, buffer, format, addressed ? bytesPerTexel(format) : VK_WHOLE_SIZE);
}

LightLists::LightLists(Device& device, Uploader& uploader, const ListLayouts& layouts, const Choice& choice,
                       const View& view, const GpuLights& lights)
    : device_(device), layouts_(layouts), choice_(choice) {
    if (lights.local() == 0) choice_.lists = gpu::LISTS_NONE;
    choice_.in_front = choice_.in_front && choice_.lists == gpu::LISTS_TILED;
    std::vector<gpu::LightBound> bounds;
    if (any()) {
        bounds = lightBounds(lights, view);
        grid_ = makeLightGrid({choice_.lists, choice_.in_front}, view, lights, bounds, device.profile().costs,
                              std::min(std::uint64_t{device.limits().maxStorageBufferRange}, maxBytes));
    }
    addressed_ = maxTexels(grid_, lights, bounds.size()) > device.limits().maxTexelBufferElements;
    makeLists();
    if (any()) {
        const std::vector<gpu::uint> all = listOfAll(grid_);
        uploader.buffer(indices_, std::as_bytes(std::span(all)));
        bounds_ = makeBuffer<gpu::LightBound>(device, uploader, "light bounds", bounds, texelsOrAddress);
        bounds_view_ =
            texelsUnless(addressed_, device, "light bounds", bounds_, VK_FORMAT_R32G32B32A32_SFLOAT);
        masks_ = listBuffer(device, "light masks", std::uint64_t{grid_.words} * grid_.list_stride, 4,
                            texelsOrAddress);
        masks_view_ = texelsUnless(addressed_, device, "light masks", masks_, VK_FORMAT_R32G32B32A32_UINT);
        grid_.bounds = addressWords(bounds_.address());
        grid_.masks = addressWords(masks_.address());
    }
    grid_buffer_ = makeBuffer<gpu::LightGrid>(device, uploader, "light grid", std::span(&grid_, 1),
                                              VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
    uploader.flush();
    if (any()) makePassInputs();
}

void LightLists::makeLists() {
    // One more than there are cells: the last is the list of all lights, for positions in no cell.
    heads_ = listBuffer(device_, "light list heads", std::uint64_t{grid_.lists} + 1,
                        sizeof(gpu::LightListHead), texelsOrAddress);
    indices_ =
        listBuffer(device_, "light lists", std::uint64_t{grid_.capacity} * grid_.width, 4, texelsOrAddress);
    listed_ = listBuffer(device_, "light list counts", 2 * std::uint64_t{grid_.lists} + 1, 4);
    heads_view_ = texelsUnless(addressed_, device_, "light list heads", heads_, VK_FORMAT_R32G32B32A32_UINT);
    indices_view_ = texelsUnless(addressed_, device_, "light lists", indices_,
                                 grid_.width == 4 ? VK_FORMAT_R32G32B32A32_UINT : VK_FORMAT_R32_UINT);
    grid_.heads = addressWords(heads_.address());
    grid_.indices = addressWords(indices_.address());
}

void LightLists::makePassInputs() {
    const bool gathers = choice_.kernel == LightCullingKernel::gather;
    candidates_ = listBuffer(
        device_, "light candidates",
        gathers ? std::uint64_t{grid_.words} * (grid_.tiles.x * grid_.tiles.y + grid_.slices) : 0, 4);
    four_begins_ = listBuffer(device_, "begins of light lists", grid_.list_stride / 4, 4);
    used_words_ = listBuffer(device_, "used words of light masks",
                             std::uint64_t{(grid_.words + 31) / 32} * grid_.list_stride, 4);
    counts_ = listBuffer(device_, "light counts", std::uint64_t{grid_.lists} * grid_.segments,
                         sizeof(gpu::LightListCount));
    tile_depths_ = listBuffer(device_, "tile depths", choice_.lists == gpu::LISTS_TILED ? grid_.lists : 0,
                              sizeof(gpu::vec2));
    overflow_ = listBuffer(device_, "light list overflow", 1, 4);
    sampler_ = makeNearestSampler(device_);
    sets_ = DescriptorSets(device_, layouts_.lists(), listTypes, 1);
    sets_.texels(0, gpu::BINDING_BOUNDS, bounds_view_);
    sets_.buffer(0, gpu::BINDING_MASKS, masks_.handle());
    sets_.buffer(0, gpu::BINDING_COUNTS, counts_.handle());
    sets_.buffer(0, gpu::BINDING_TILE_DEPTHS, tile_depths_.handle());
    sets_.buffer(0, gpu::BINDING_OVERFLOW, overflow_.handle());
    sets_.buffer(0, gpu::BINDING_HEADS, heads_.handle());
    sets_.buffer(0, gpu::BINDING_INDICES, indices_.handle());
    sets_.buffer(0, gpu::BINDING_LISTED, listed_.handle());
    sets_.buffer(0, gpu::BINDING_USED_WORDS, used_words_.handle());
    sets_.buffer(0, gpu::BINDING_FOUR_BEGINS, four_begins_.handle());
    sets_.texels(0, gpu::BINDING_MASK_TEXELS, masks_view_);
    sets_.buffer(0, gpu::BINDING_CANDIDATES, candidates_.handle());
}

void LightLists::specialise(Variant& variant) const {
    variant.set(gpu::FEATURE_light_lists, choice_.lists)
        .set(gpu::FEATURE_list_width, any() ? grid_.width : 1)
        .set(gpu::FEATURE_addressed_lights, addressed_)
        .set(gpu::FEATURE_lights_in_front, choice_.in_front);
}

void LightLists::bind(DescriptorSets& frame) const {
    frame.buffer(0, gpu::BINDING_LIGHT_GRID, grid_buffer_.handle());
    frame.texels(0, gpu::BINDING_LIST_HEADS, heads_view_);
    frame.texels(0, gpu::BINDING_LIST_INDICES, indices_view_);
    frame.buffer(0, gpu::BINDING_LIST_COUNTS, listed_.handle());
}

// Adds a compute pass.
struct LightLists::Step {
    PassList& passes;
    Pipelines& pipelines;
    Variant variant;
    VkPipelineLayout layout;
    std::array<VkDescriptorSet, 2> sets;

    Pass& operator()(const char* name, Shader shader, glm::uvec3 size) const {
        const Pipeline pipeline = pipelines.compute(shader, variant, layout);
        return passes.compute(name).record(
            [pipeline, size, layout = layout, sets = sets](VkCommandBuffer commands) {
                vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout, 0, 2, sets.data(),
                                        0, nullptr);
                vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
                vkCmdDispatch(commands, size.x, size.y, size.z);
            });
    }
};

void LightLists::addPasses(PassList& passes, Pipelines& pipelines, const Variant& variant,
                           VkDescriptorSet frame_set, ImageRef depth) {
    if (!any()) return;
    Variant own = variant.only(featuresReadBy(gpu::PASS_LISTS));
    specialise(own);
    const Step step{passes, pipelines, own, layouts_.pipeline(), {frame_set, sets_[0]}};
    // Only tiled lists read the depth, but lavapipe accesses every descriptor of a bound set.
    sets_.image(0, gpu::BINDING_LISTS_DEPTH, passes.view(depth), sampler_,
                VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
    addLightCulling(step, depth);
    addListBuilding(step);
}

void LightLists::addLightCulling(const Step& step, ImageRef depth) const {
    PassList& passes = step.passes;
    const BufferRef candidates = passes.buffer("light candidates", candidates_),
                    masks = passes.buffer("light masks", masks_),
                    depths = passes.buffer("tile depths", tile_depths_),
                    overflow = passes.buffer("list overflow", overflow_);
    const Access read = access::storageRead(inCompute), write = access::storageWrite(inCompute);
    const bool tiled = choice_.lists == gpu::LISTS_TILED;
    if (tiled)
        step("assign depth bounds", Shader::cull_lights_depth_bounds_comp, {grid_.tiles.x, grid_.tiles.y, 1})
            .samples(depth, inCompute)
            .uses(depths, write);
    const bool gathers = choice_.kernel == LightCullingKernel::gather;
    Pass& clear =
        passes.copy(assigning).uses(overflow, access::transferWrite).uses(masks, access::transferWrite);
    if (gathers) clear.uses(candidates, access::transferWrite);
    clear.record([=, this](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, overflow_.handle(), 0, VK_WHOLE_SIZE, 0);
        vkCmdFillBuffer(commands, masks_.handle(), 0, VK_WHOLE_SIZE, 0);
        if (gathers) vkCmdFillBuffer(commands, candidates_.handle(), 0, VK_WHOLE_SIZE, 0);
    });
    // Both shaders write parts of the masks; scatter uses atomics.
    const glm::uvec3 byLight = inRows(std::uint64_t{grid_.local_lights} * gpu::LIGHT_THREADS);
    if (gathers)
        step(assigning, Shader::cull_lights_candidates_comp, byLight)
            .uses(candidates, read)
            .uses(candidates, write);
    Pass& mark = gathers ? step(assigning, Shader::cull_lights_gather_comp,
                                inRows(std::uint64_t{grid_.words} * grid_.tiles.x * grid_.tiles.y,
                                       (grid_.slices + slicesOfThread - 1) / slicesOfThread))
                               .uses(candidates, read)
                         : step(assigning, Shader::cull_lights_scatter_comp, byLight).uses(masks, read);
    mark.uses(masks, write);
    if (tiled) mark.uses(depths, read);
}

void LightLists::addListBuilding(const Step& step) const {
    PassList& passes = step.passes;
    const BufferRef masks = passes.buffer("light masks", masks_),
                    used = passes.buffer("used words", used_words_),
                    counts = passes.buffer("light counts", counts_),
                    begins = passes.buffer("list begins", four_begins_),
                    overflow = passes.buffer("list overflow", overflow_);
    const Access read = access::storageRead(inCompute), write = access::storageWrite(inCompute);
    step(assigning, Shader::light_list_count_comp, {workgroups(grid_.list_stride / 4), 1, 1})
        .uses(masks, addressed_ ? read : access::texelRead(inCompute))
        .uses(used, write)
        .uses(counts, write)
        .uses(counts, read)
        .uses(begins, write);
    step(assigning, Shader::light_list_scan_comp, {1, 1, 1}).uses(begins, read).uses(begins, write);
    step(assigning, Shader::light_list_fill_comp, {workgroups(grid_.lists), grid_.segments, 1})
        .uses(masks, read)
        .uses(used, read)
        .uses(counts, read)
        .uses(begins, read)
        .uses(overflow, read)
        .uses(overflow, write)
        .uses(passes.buffer("list heads", heads_), write)
        .uses(passes.buffer("light lists", indices_), write)
        .uses(passes.buffer("list counts", listed_), write);
}

void LightLists::read(PassList& passes, Pass& pass, VkPipelineStageFlags2 stages) const {
    if (!any()) return;
    const Access reads = addressed_ ? access::storageRead(stages) : access::texelRead(stages);
    pass.uses(passes.buffer("list heads", heads_), reads)
        .uses(passes.buffer("light lists", indices_), reads)
        .uses(passes.buffer("list counts", listed_), access::storageRead(stages));
}

std::vector<gpu::uint> LightLists::wordsOf(const GpuBuffer& from, std::uint64_t first,
                                           std::size_t count) const {
    std::vector<gpu::uint> words(count);
    if (count == 0) return words;
    const GpuBuffer seen(device_, "light list, read back", count * sizeof(gpu::uint),
                         VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback);
    device_.submit([&](VkCommandBuffer commands) {
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
        const VkBufferCopy copy{first * sizeof(gpu::uint), 0, count * sizeof(gpu::uint)};
        vkCmdCopyBuffer(commands, from.handle(), seen.handle(), 1, &copy);
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
    std::memcpy(words.data(), seen.mapped(), count * sizeof(gpu::uint));
    return words;
}

std::uint64_t LightLists::overflowed() const {
    return any() ? wordsOf(overflow_, 0, 1)[0] : 0;
}

std::vector<gpu::uint> LightLists::lightsAt(int x, int y, float depth) const {
    if (!any()) return {};
    constexpr std::uint64_t headWords = sizeof(gpu::LightListHead) / sizeof(gpu::uint);
    const std::vector<gpu::uint> words = wordsOf(heads_, headWords * cellOf(grid_, x, y, depth), headWords);
    gpu::LightListHead head{};
    std::memcpy(&head, words.data(), sizeof head);
    std::vector<gpu::uint> lights = wordsOf(indices_, std::uint64_t{head.begin} * grid_.width,
                                            std::size_t{head.end - head.begin} * grid_.width);
    std::erase(lights, grid_.null_light);
    return lights;
}

std::uint64_t LightLists::bytes() const {
    std::uint64_t sum = 0;
    for (const GpuBuffer* buffer : {&grid_buffer_, &bounds_, &candidates_, &masks_, &counts_, &used_words_,
                                    &four_begins_, &tile_depths_, &heads_, &indices_, &listed_})
        sum += buffer->size();
    return sum;
}

}  // namespace diptych
