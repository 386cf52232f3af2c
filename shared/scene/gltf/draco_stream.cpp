// SPDX-License-Identifier: MIT
#include "shared/scene/gltf/draco_stream.h"

#include "shared/text/fail.h"

#include <draco/compression/entropy/symbol_decoding.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace diptych::gltf {

namespace {

template <class Number>
Number next(draco::DecoderBuffer& buffer) {
    Number value{};
    if (!buffer.Decode(&value)) fail("its stream is cut short");
    return value;
}

std::uint32_t nextVarint(draco::DecoderBuffer& buffer) {
    std::uint32_t value = 0;
    if (!draco::DecodeVarint(&value, &buffer)) fail("its stream is cut short");
    return value;
}

void skip(draco::DecoderBuffer& buffer, std::uint64_t bytes) {
    if (bytes > static_cast<std::uint64_t>(buffer.remaining_size())) fail("its stream is cut short");
    buffer.Advance(static_cast<std::int64_t>(bytes));
}

// Wraps a decoder of the library. Checks every count of the stream that determines work or memory before
// it is used.
template <class Decoder>
class Bounded : public Decoder {
public:
    explicit Bounded(const DracoExpectation& expected) : expected_(expected) {}

    const draco::MeshAttributeIndicesEncodingData* GetAttributeEncodingData(int attribute) const override {
        const auto* data = Decoder::GetAttributeEncodingData(attribute);
        if (data) checkPrediction(attribute, data->encoded_attribute_value_index_to_corner_map.size());
        return data;
    }

protected:
    bool DecodeConnectivity() override {
        constexpr bool sequential = std::is_same_v<Decoder, draco::MeshSequentialDecoder>;
        stream_ = this->buffer();
        draco::DecoderBuffer ahead = *stream_;
        const std::uint32_t first = nextVarint(ahead), second = nextVarint(ahead);
        const std::size_t faces = sequential ? first : second;
        if (sequential) checkVertices(second);
        if (expected_.triangles && faces != *expected_.triangles)
            fail(fmt::format("its stream holds {} triangles, not {}", faces, *expected_.triangles));
        if (faces > expected_.limit / (3 * dracoBytesPerCorner))
            fail(fmt::format("its stream claims {} triangles", faces));
        if (!sequential) {
            // Each set of seams gets a corner table. Encoders write one per attribute with seams.
            const std::size_t tables = next<std::uint8_t>(ahead);
            const std::size_t max = std::max<std::size_t>(expected_.attributes, 16);
            if (tables > max) fail(fmt::format("its stream has {} sets of seams, more than {}", tables, max));
        }
        return Decoder::DecodeConnectivity();
    }

    // Checks the set of seams of an attribute: if two attributes shared one, the library's counts would be
    // wrong.
    bool CreateAttributesDecoder(std::int32_t id) override {
        if constexpr (std::is_same_v<Decoder, draco::MeshEdgebreakerDecoder>) {
            draco::DecoderBuffer ahead = *this->buffer();
            if (!seams_.insert(next<std::int8_t>(ahead)).second)
                fail("its stream names a set of seams twice");
        }
        return Decoder::CreateAttributesDecoder(id);
    }

    // Called when all attributes are known and none is allocated.
    bool DecodeAllAttributes() override {
        checkVertices(this->point_cloud()->num_points());
        std::size_t bytes = 0;  // per vertex: an index, the values, and 32-bit integers for them
        for (int i = 0; i < this->point_cloud()->num_attributes(); ++i) {
            const draco::PointAttribute& a = *this->point_cloud()->attribute(i);
            bytes += 4 + 4 * a.num_components() + static_cast<std::size_t>(a.byte_stride());
        }
        if (bytes > expected_.limit / std::max<std::size_t>(expected_.vertices, 1))
            fail(
                fmt::format("its stream claims {} bytes for each of {} vertices", bytes, expected_.vertices));
        return Decoder::DecodeAllAttributes();
    }

private:
    DracoExpectation expected_;
    draco::DecoderBuffer* stream_ = nullptr;
    std::set<std::int8_t> seams_;

    void checkVertices(std::size_t count) const {
        if (count != expected_.vertices)
            fail(fmt::format("its stream holds {} vertices, not {}", count, expected_.vertices));
    }

    // The library requests an attribute's encoding data right after it has read the prediction method.
    // Predicted texture coordinates have at most one orientation bit per value. The library trusts the
    // stream's number of bits, up to 2^31, and loops over all of them.
    void checkPrediction(int attribute, std::size_t entries) const {
        const char* head = stream_->data_head();
        const int method = head[-2], transform = head[-1];
        if (method == draco::MESH_PREDICTION_TEX_COORDS_DEPRECATED)
            fail("its stream uses a prediction of bitstreams before 2.2");
        if (method != draco::MESH_PREDICTION_TEX_COORDS_PORTABLE ||
            transform != draco::PREDICTION_TRANSFORM_WRAP)
            return;
        draco::DecoderBuffer ahead = *stream_;
        const std::size_t components = this->point_cloud()->attribute(attribute)->num_components();
        const std::size_t values = entries * components;
        if (next<std::uint8_t>(ahead)) {
            std::vector<std::uint32_t> symbols(values);
            if (!draco::DecodeSymbols(static_cast<std::uint32_t>(values), static_cast<int>(components),
                                      &ahead, symbols.data()))
                fail("its stream is damaged: texture coordinates");
        } else {
            skip(ahead, std::uint64_t(next<std::uint8_t>(ahead)) * values);
        }
        const auto bits = next<std::int32_t>(ahead);
        if (bits < 0 || static_cast<std::size_t>(bits) > entries)
            fail(fmt::format("its stream has {} orientations for {} texture coordinates", bits, entries));
    }
};

// Position after the metadata that follows the header. The library would keep a list of all nested
// metadata, with quadratic cost.
std::int64_t endOfMetadata(draco::DecoderBuffer buffer) {
    const std::int64_t begin = buffer.decoded_size();
    const auto skipEntries = [&] {
        for (std::uint32_t n = nextVarint(buffer); n > 0; --n) {
            skip(buffer, next<std::uint8_t>(buffer));  // the metadata's name
            skip(buffer, nextVarint(buffer));
        }
        return nextVarint(buffer);  // number of nested metadata
    };
    const auto skipTree = [&] {
        for (std::uint64_t pending = skipEntries(); pending > 0; --pending) {
            skip(buffer, next<std::uint8_t>(buffer));
            pending += skipEntries();
        }
    };
    for (std::uint32_t n = nextVarint(buffer); n > 0; --n) {
        nextVarint(buffer);  // the attribute's id
        skipTree();
    }
    skipTree();
    return buffer.decoded_size() - begin;
}

template <class Decoder>
std::unique_ptr<draco::Mesh> decodeWith(draco::DecoderBuffer& buffer, const DracoExpectation& expected) {
    auto mesh = std::make_unique<draco::Mesh>();
    Bounded<Decoder> decoder(expected);
    const draco::DecoderOptions options;
    const draco::Status status = decoder.Decode(options, &buffer, mesh.get());
    if (!status.ok()) fail(fmt::format("its stream is damaged: {}", status.error_msg_string()));
    return mesh;
}

}  // namespace

std::unique_ptr<draco::Mesh> decodeDracoStream(std::span<const unsigned char> stream,
                                               const DracoExpectation& expected) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size(), DRACO_BITSTREAM_VERSION(2, 2));
    draco::DecoderBuffer ahead = buffer;
    draco::DracoHeader header;
    if (!draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok()) fail("is not a Draco stream");
    if (header.encoder_type != draco::TRIANGULAR_MESH) fail("its stream is a point cloud, not triangles");
    if (header.version_major != 2 || header.version_minor != 2)
        fail(fmt::format("its stream has bitstream version {}.{}, not 2.2", header.version_major,
                         header.version_minor));

    // Metadata is not needed, so it is removed before decoding.
    std::vector<char> bare;
    if (header.flags & METADATA_FLAG_MASK) {
        const auto headerSize = ahead.decoded_size();
        const auto metadata = endOfMetadata(ahead);
        bare.assign(stream.begin(), stream.end());
        bare.erase(bare.begin() + headerSize, bare.begin() + headerSize + metadata);
        // Offset of the high byte of the flags, which are the last field of the header.
        constexpr std::size_t highFlags = 10;
        bare[highFlags] = static_cast<char>(bare[highFlags] & ~(METADATA_FLAG_MASK >> 8));
        buffer.Init(bare.data(), bare.size());
    }
    switch (header.encoder_method) {
        case draco::MESH_SEQUENTIAL_ENCODING:
            return decodeWith<draco::MeshSequentialDecoder>(buffer, expected);
        case draco::MESH_EDGEBREAKER_ENCODING:
            return decodeWith<draco::MeshEdgebreakerDecoder>(buffer, expected);
        default:
            fail(fmt::format("its stream has the unknown encoding method {}", header.encoder_method));
    }
}

}  // namespace diptych::gltf
