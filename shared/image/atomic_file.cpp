// SPDX-License-Identifier: MIT
#include "shared/image/atomic_file.h"

#include <fmt/format.h>

#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace diptych {

namespace fs = std::filesystem;

AtomicFile::AtomicFile(const fs::path& file) : file_(file) {
    std::error_code ignored;
    if (fs::is_symlink(file_, ignored)) file_ = fs::weakly_canonical(file_, ignored);
    const fs::file_status status = fs::status(file_, ignored);
    if (fs::is_directory(status)) fail(EISDIR);
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw std::runtime_error(file_.string() + ": not a regular file, so it cannot be replaced");

    static std::atomic<unsigned> serial{0};
    temporary_ = file_.parent_path() /
                 fmt::format(".{}.{}-{}.tmp", file_.filename().string(), ::getpid(), serial.fetch_add(1));
    stream_ = std::fopen(temporary_.c_str(), "wbx");
    if (!stream_) {
        const int error = errno;
        temporary_.clear();
        fail(error);
    }
}

AtomicFile::~AtomicFile() {
    if (stream_) std::fclose(stream_);
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
    if (std::fflush(stream_) != 0) fail(errno);
    if (std::ferror(stream_)) fail(EIO);
    if (std::fclose(std::exchange(stream_, nullptr)) != 0) fail(errno);
    if (std::rename(temporary_.c_str(), file_.c_str()) != 0) fail(errno);
    temporary_.clear();
}

void AtomicFile::fail(int error) {
    throw std::runtime_error(fmt::format("{}: {}", file_.string(), std::strerror(error)));
}

void writeFile(const fs::path& file, std::string_view contents) {
    AtomicFile out(file);
    std::fwrite(contents.data(), 1, contents.size(), out.stream());
    out.commit();
}

}  // namespace diptych
