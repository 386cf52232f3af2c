// SPDX-License-Identifier: MIT
#include "shared/shadow/clipmap_shadow.h"

#include "shared/contract/bindings.h"
#include "shared/draw/pipeline_keys.h"
#include "shared/draw/record.h"
#include "shared/shadow/blended_receivers.h"
#include "shared/text/counted.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <utility>

namespace diptych {

namespace {

template <class T>
void append(std::vector<glm::vec4>& texels, const T& value) {
    static_assert(sizeof(T) % sizeof(glm::vec4) == 0);
    const std::size_t at = texels.size();
    texels.resize(at + sizeof(T) / sizeof(glm::vec4));
    std::memcpy(&texels[at], &value, sizeof(T));
}

enum : std::size_t { OF_PREPARING, OF_FRAME, SETS };

}  // namespace

ClipmapShadow::ClipmapShadow(const FrameInputs& inputs, Uploader& uploader, ClipmapAtlases& atlases,
                             const Pose& pose, Clipmap clipmap, const Settings& settings)
    : device_(inputs.device),
      uploader_(uploader),
      layouts_(atlases),
      pose_(pose),
      all_(settings.shadow_casters == ShadowCasters::all),
      clipmap_(std::move(clipmap)),
      atlas_(atlases.lend({static_cast<std::uint32_t>(settings.clipmap_pages),
                           static_cast<std::uint32_t>(clipmap_.grid.slot())})),
      sampler_(makeNearestSampler(device_)),
      sets_(device_, atlases.marks(), clipmapBindings(), SETS) {
    const std::uint64_t words = (clipmap_.pages() + 31) / 32;
    marks_ = GpuBuffer(device_, "shadow page marks", words * sizeof(gpu::uint),
                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                           VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    marks_seen_ = GpuBuffer(device_, "shadow page marks, read back", marks_.size(),
                            VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::readback);
    for (std::size_t set = 0; set < SETS; ++set)
        sets_.buffer(set, gpu::BINDING_CLIPMAP_MARKS, marks_.handle());
    atlas_->follow(pose, inputs.geometry, clipmap_.grid.space);
}

std::vector<glm::vec4> ClipmapShadow::texels(const View& view, double bias) const {
    std::vector<glm::vec4> texels;
    append(texels, gpuClipmap(clipmap_, view.eye()));
    for (const gpu::Cascade& level : gpuCascades(cascadesOf(clipmap_), view.eye(), bias))
        append(texels, level);
    if (resident_pages_.table.empty()) {
        texels.resize(texels.size() + clipmap_.pages());
        return texels;
    }
    for (const ResidentPages::Entry& entry : resident_pages_.table) {
        const PageDraw& page = resident_pages_.resident[entry.resident];
        const ClipmapLevel& level = clipmap_.levels[entry.level];
        const bool whole = page.page.exponent == PageAddress::whole_scene;
        const glm::i64vec2 place =
            whole ? glm::i64vec2(0) : glm::i64vec2(page.page.x, page.page.y) - level.first;
        const glm::i64vec2 shift = glm::i64vec2(atlas_->shape().cornerOf(page.slot)) +
                                   glm::i64vec2(clipmap_.grid.gutter) -
                                   place * static_cast<std::int64_t>(clipmap_.grid.page);
        append(texels, gpu::ClipmapPage{
                           .shift = glm::vec2(shift), .level = static_cast<float>(entry.level), .spare = 0});
    }
    return texels;
}

void ClipmapShadow::prepare(const FrameInputs& inputs, const View& view) {
    PassList passes(device_, static_cast<std::uint32_t>(view.width), static_cast<std::uint32_t>(view.height));
    const ImageRef depth = sceneDepth(passes, inputs);
    readGeometry(passes, passes.draw("depth of shadow pages"), inputs)
        .depth(depth, Load::clear)
        .record(recordDraws(inputs, inputs.draws.solids(), depthKey));
    addMarkPasses(passes, inputs, depth, OF_PREPARING);
    passes.run();
    std::vector<gpu::uint> marks = readMarks();
    BlendedReceivers{inputs.draws, pose_, inputs.geometry, view}.mark(clipmap_, marks);
    resident_pages_ = atlas_->cache().makeResident(clipmap_, marks);
    cold_ = atlas_->cache().stale(resident_pages_.resident).size();
}

void ClipmapShadow::addMarks(PassList& passes, const FrameInputs& inputs, ImageRef depth) {
    addMarkPasses(passes, inputs, depth, OF_FRAME);
}

void ClipmapShadow::addMarkPasses(PassList& passes, const FrameInputs& inputs, ImageRef depth,
                                  std::size_t set) {
    const BufferRef marks = passes.buffer("shadow page marks", marks_);
    const char* const name = "mark shadow pages";
    Variant variant;
    variant.set(gpu::FEATURE_orthographic, inputs.variant.get(gpu::FEATURE_orthographic))
        .set(gpu::FEATURE_samples, static_cast<gpu::uint>(inputs.samples))
        .set(gpu::FEATURE_depth_format, inputs.depth.kind);
    sets_.image(set, gpu::BINDING_CLIPMAP_DEPTH, passes.view(depth), sampler_,
                VK_IMAGE_LAYOUT_DEPTH_READ_ONLY_OPTIMAL);
    passes.copy(name).uses(marks, access::transferWrite).record([this](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, marks_.handle(), 0, VK_WHOLE_SIZE, 0);
    });
    Pass& mark = passes.compute(name);
    const Pipeline pipeline =
        inputs.pipelines.compute(Shader::clipmap_mark_comp, variant, layouts_.pipeline());
    mark.samples(depth, inCompute)
        .uses(marks, access::storageRead(inCompute))
        .uses(marks, access::storageWrite(inCompute))
        .record([this, pipeline, set, frame = inputs.frame_set,
                 groups = glm::uvec2(passes.width(), passes.height())](VkCommandBuffer commands) {
            const std::array sets{frame, sets_[set]};
            vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layouts_.pipeline(), 0,
                                    sets.size(), sets.data(), 0, nullptr);
            vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
            constexpr std::uint32_t side = gpu::CLIPMAP_MARK_SIDE;
            vkCmdDispatch(commands, (groups.x + side - 1) / side, (groups.y + side - 1) / side, 1);
        });
    if (set == OF_FRAME)
        mark.prepare([this, &inputs] {
            atlas_->draw(inputs, uploader_, pose_, clipmap_.grid, resident_pages_.resident, all_);
        });
}

std::vector<gpu::uint> ClipmapShadow::readMarks() const {
    device_.submit([&](VkCommandBuffer commands) {
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT);
        const VkBufferCopy copy{0, 0, marks_.size()};
        vkCmdCopyBuffer(commands, marks_.handle(), marks_seen_.handle(), 1, &copy);
        memoryBarrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    });
    std::vector<gpu::uint> marks(marks_.size() / sizeof(gpu::uint));
    std::memcpy(marks.data(), marks_seen_.mapped(), marks_.size());
    return marks;
}

ShadowPages ClipmapShadow::counts() const {
    return {.requested = resident_pages_.requested,
            .resident = resident_pages_.requested - resident_pages_.fallback,
            .fallback = resident_pages_.fallback,
            .drawn = cold_};
}

std::vector<std::string> ClipmapShadow::notes() const {
    const AtlasShape& shape = atlas_->shape();
    std::vector<std::string> notes{
        fmt::format("--shadows clipmap: {} of {}x{} pages and one page for the whole scene; {} of {}x{} "
                    "texels in an atlas of {}x{}, {:.1f} MiB",
                    counted(clipmap_.levels.size() - 1, "level"), clipmap_.width, clipmap_.width,
                    counted(shape.pages, "slot"), shape.slot, shape.slot, shape.size().x, shape.size().y,
                    static_cast<double>(atlas_->bytes()) / (1 << 20))};
    notes.push_back(
        fmt::format("shadow pages: requested {}, resident {}, replaced by a coarser level {}; drawn once, "
                    "before the first frame: {} of {}",
                    resident_pages_.requested, resident_pages_.requested - resident_pages_.fallback,
                    resident_pages_.fallback, cold_, resident_pages_.resident.size()));
    return notes;
}

}  // namespace diptych
