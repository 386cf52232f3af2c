// SPDX-License-Identifier: MIT
#include "compare/reference/checkpoint.h"

#include "compare/reference/key.h"
#include "shared/image/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace diptych::reference {

struct Checkpoint::Head {
    std::uint64_t magic, key, floats;
};

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t magic = 0x31707963666e6572u;

[[noreturn]] void failWriting(const fs::path& file) {
    throw std::runtime_error(writingFailed(file, errno));
}

std::uint64_t sumOf(std::uint64_t index, std::span<const float> values) {
    Key key;
    key.add(index);
    key.add(std::as_bytes(values));
    return key.value();
}

fs::path fileOf(const fs::path& stem, std::uint64_t key) {
    return fmt::format("{}-{:08x}", stem.string(), key >> 32);
}

// Files in the folder of `stem` named by the stem, a dash, and then only hexadecimal digits and dashes.
std::vector<fs::path> filesOf(const OpenFolder& folder, const fs::path& stem) {
    const std::string prefix = stem.filename().string() + "-";
    std::vector<fs::path> files;
    for (const std::string& name : folder.names())
        if (name.starts_with(prefix) && name.size() > prefix.size() &&
            name.find_first_not_of("0123456789abcdef-", prefix.size()) == name.npos && folder.hasFile(name))
            files.push_back(stem.parent_path() / name);
    std::ranges::sort(files);
    return files;
}

// Opens for reading and writing, because some file systems only lock such files. Null, with errno EEXIST,
// for anything but a regular file that only this user may write; a file that is created here is one.
std::FILE* opened(const OpenFolder& folder, const fs::path& file, bool create) {
    constexpr int how = O_RDWR | O_NONBLOCK;
    const fs::path name = file.filename();
    int descriptor = create ? folder.open(name, how | O_CREAT | O_EXCL, 0644) : -1;
    const bool fresh = descriptor >= 0;
    if (!create || (!fresh && errno == EEXIST)) descriptor = folder.open(name, how);
    if (descriptor < 0) return nullptr;
    struct stat status {};
    const bool ours =
        ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
        (fresh || (status.st_uid == ::geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0));
    std::FILE* stream = ours ? ::fdopen(descriptor, "r+b") : nullptr;
    if (!stream) ::close(descriptor);
    if (!ours) errno = EEXIST;
    return stream;
}

// False if another program holds the lock. Closing the stream releases it.
bool lock(std::FILE* stream) {
    while (::flock(::fileno(stream), LOCK_EX | LOCK_NB) != 0)
        if (errno != EINTR) return errno != EWOULDBLOCK;
    return true;
}

// Whether the open file still exists under its name.
bool isAt(std::FILE* stream, const OpenFolder& folder, const fs::path& file) {
    struct stat open {};
    return ::fstat(::fileno(stream), &open) == 0 && folder.has(file.filename(), open);
}

enum class Holds { nothing, this_image, something_else };

// Compares the beginning of the file with `head`. A file shorter than a head has just been created.
template <class Head>
Holds headOf(std::FILE* stream, const Head& head) {
    Head there{};
    if (std::fread(&there, sizeof there, 1, stream) != 1) return Holds::nothing;
    return std::memcmp(&there, &head, sizeof head) == 0 ? Holds::this_image : Holds::something_else;
}

// Reads the following records up to the first incomplete one; returns its position.
long readRecords(std::FILE* stream, std::size_t floats, std::vector<Checkpoint::Record>& records) {
    long whole = std::ftell(stream);
    Checkpoint::Record record{0, std::vector<float>(floats)};
    std::uint64_t sum = 0;
    while (std::fread(&record.index, sizeof record.index, 1, stream) == 1 &&
           std::fread(record.values.data(), sizeof(float), floats, stream) == floats &&
           std::fread(&sum, sizeof sum, 1, stream) == 1 && sum == sumOf(record.index, record.values)) {
        records.push_back(record);
        whole = std::ftell(stream);
    }
    return whole;
}

}  // namespace

Checkpoint::Checkpoint(const fs::path& stem, std::uint64_t key, std::size_t floats)
    : folder_(OpenFolder::at(stem.parent_path())), floats_(floats) {
    const Head head{magic, key, floats};
    file_ = fileOf(stem, key);
    for (int i = 2; !open(head); ++i) file_ = fmt::format("{}-{}", fileOf(stem, key).string(), i);
    try {
        merge(stem, head);
    } catch (...) {
        std::fclose(stream_);
        throw;
    }
}

Checkpoint::~Checkpoint() {
    if (stream_) std::fclose(stream_);
}

// Opens and locks file_; false if this program cannot use it.
bool Checkpoint::open(const Head& head) {
    do {
        if (stream_) std::fclose(stream_);
        stream_ = opened(folder_, file_, true);
        if (!stream_ && errno == EEXIST) return false;
        if (!stream_) failWriting(file_);
        if (!lock(stream_)) {
            std::fclose(std::exchange(stream_, nullptr));
            return false;
        }
    } while (!isAt(stream_, folder_, file_));
    const Holds holds = headOf(stream_, head);
    if (holds == Holds::something_else) {
        std::fclose(std::exchange(stream_, nullptr));
        return false;
    }
    // Overwrites a record that was incomplete when the program ended.
    const long whole = holds == Holds::this_image ? readRecords(stream_, floats_, earlier_) : 0;
    if (std::fseek(stream_, whole, SEEK_SET) != 0 ||
        (whole == 0 && (std::fwrite(&head, sizeof head, 1, stream_) != 1 || std::fflush(stream_) != 0))) {
        const int error = errno;
        std::fclose(std::exchange(stream_, nullptr));
        errno = error;
        failWriting(file_);
    }
    return true;
}

// Another program that renders the same image may be appending to its file. Its complete records are taken
// and its file is left unchanged.
void Checkpoint::merge(const fs::path& stem, const Head& head) {
    std::set<std::uint64_t> have;
    for (const Record& record : earlier_) have.insert(record.index);
    for (const fs::path& other : filesOf(folder_, stem)) {
        if (other == file_ || !other.native().starts_with(fileOf(stem, head.key).native())) continue;
        std::FILE* stream = opened(folder_, other, false);
        if (!stream) continue;
        const bool ended = lock(stream) && isAt(stream, folder_, other);
        const Holds holds = headOf(stream, head);
        std::vector<Record> records;
        if (holds == Holds::this_image) readRecords(stream, floats_, records);
        try {
            for (Record& record : records) {
                if (!have.insert(record.index).second) continue;
                keep(record.index, record.values);
                earlier_.push_back(std::move(record));
            }
        } catch (...) {
            std::fclose(stream);
            throw;
        }
        // Includes a file that a program had just created when it was killed.
        if (holds != Holds::something_else && ended) folder_.removeFile(other.filename());
        std::fclose(stream);
    }
}

void Checkpoint::keep(std::uint64_t index, std::span<const float> values) {
    std::vector<float> filled(values.begin(), values.end());
    filled.resize(floats_);
    const std::uint64_t sum = sumOf(index, filled);
    const std::lock_guard lock(mutex_);
    if (!stream_) return;
    if (std::fwrite(&index, sizeof index, 1, stream_) != 1 ||
        std::fwrite(filled.data(), sizeof(float), floats_, stream_) != floats_ ||
        std::fwrite(&sum, sizeof sum, 1, stream_) != 1 || std::fflush(stream_) != 0)
        failWriting(file_);
}

// Removes the file while it is locked, so that a program waiting for the lock sees that it is gone.
void Checkpoint::remove() {
    const std::lock_guard lock(mutex_);
    if (!stream_) return;
    folder_.removeFile(file_.filename());
    std::fclose(std::exchange(stream_, nullptr));
}

std::vector<fs::path> abandonedCheckpoints(const fs::path& stem) {
    const OpenFolder folder = OpenFolder::at(stem.parent_path());
    std::vector<fs::path> files = filesOf(folder, stem);
    std::erase_if(files, [&](const fs::path& file) {
        std::FILE* stream = opened(folder, file, false);
        if (!stream) return false;
        const bool ended = lock(stream);
        std::fclose(stream);
        return !ended;
    });
    return files;
}

}  // namespace diptych::reference
