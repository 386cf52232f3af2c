// SPDX-License-Identifier: MIT
#include "compare/reference/checkpoint.h"

#include "compare/reference/key.h"
#include "shared/image/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace diptych::reference {
namespace {

constexpr std::uint64_t magic = 0x31707963666e6572u;

struct Head {
    std::uint64_t magic, key, floats;
};

[[noreturn]] void fail(const std::filesystem::path& file) {
    throw std::runtime_error(writingFailed(file, errno));
}

std::uint64_t sumOf(std::uint64_t number, std::span<const float> values) {
    Key key;
    key.add(number);
    key.add(std::as_bytes(values));
    return key.value();
}

}  // namespace

Checkpoint::Checkpoint(std::filesystem::path file, std::uint64_t key, std::size_t floats)
    : file_(std::move(file)), floats_(floats) {
    if (file_.empty()) return;
    const Head head{magic, key, floats};
    long whole = 0;
    if (std::FILE* stream = std::fopen(file_.c_str(), "rb")) {
        Head there{};
        if (std::fread(&there, sizeof there, 1, stream) == 1 &&
            std::memcmp(&there, &head, sizeof head) == 0) {
            whole = sizeof head;
            Record record{0, std::vector<float>(floats)};
            std::uint64_t sum = 0;
            while (std::fread(&record.number, sizeof record.number, 1, stream) == 1 &&
                   std::fread(record.values.data(), sizeof(float), floats, stream) == floats &&
                   std::fread(&sum, sizeof sum, 1, stream) == 1 &&
                   sum == sumOf(record.number, record.values)) {
                earlier_.push_back(record);
                whole = std::ftell(stream);
            }
        }
        std::fclose(stream);
    }
    stream_ = std::fopen(file_.c_str(), whole > 0 ? "r+b" : "wb");
    if (!stream_) fail(file_);
    // A record that was being written when the program ended is written over.
    if (whole > 0 ? std::fseek(stream_, whole, SEEK_SET) != 0
                  : std::fwrite(&head, sizeof head, 1, stream_) != 1 || std::fflush(stream_) != 0)
        fail(file_);
}

Checkpoint::~Checkpoint() {
    if (stream_) std::fclose(stream_);
}

void Checkpoint::keep(std::uint64_t number, std::span<const float> values) {
    if (!stream_) return;
    std::vector<float> filled(values.begin(), values.end());
    filled.resize(floats_);
    const std::uint64_t sum = sumOf(number, filled);
    const std::lock_guard lock(mutex_);
    if (std::fwrite(&number, sizeof number, 1, stream_) != 1 ||
        std::fwrite(filled.data(), sizeof(float), floats_, stream_) != floats_ ||
        std::fwrite(&sum, sizeof sum, 1, stream_) != 1 || std::fflush(stream_) != 0)
        fail(file_);
}

}  // namespace diptych::reference
