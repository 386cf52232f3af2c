// SPDX-License-Identifier: MIT
#include "shared/image/atomic_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <stdexcept>
#include <utility>

namespace diptych {

namespace fs = std::filesystem;

namespace {

// Rejects folders and devices before a temporary file is created.
const fs::path& replaceable(const fs::path& file) {
    std::error_code ignored;
    const fs::file_status status = fs::symlink_status(file, ignored);
    if (fs::is_directory(status)) throw std::runtime_error(writingFailed(file, EISDIR));
    if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_symlink(status))
        throw std::runtime_error(file.string() + ": not a regular file, so it cannot be replaced");
    return file;
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& file)
    : file_(replaceable(file)), temporary_(file_.parent_path(), file_), stream_(temporary_.createFile()) {
    if (!stream_) fail(errno);
}

AtomicFile::~AtomicFile() {
    if (stream_) std::fclose(stream_);
}

// The errno of an earlier failed write is lost. Writing one more byte reproduces it; the file is discarded
// anyway. If that write succeeds, the cause is gone, and EIO is reported.
void AtomicFile::commit() {
    const bool failed = std::ferror(stream_) != 0;
    errno = 0;
    if (failed) std::fputc(0, stream_);
    if (std::fflush(stream_) != 0 || failed) fail(errno != 0 ? errno : EIO);
    if (std::fclose(std::exchange(stream_, nullptr)) != 0) fail(errno);
    if (!temporary_.become()) fail(errno);
}

void AtomicFile::fail(int error) {
    throw std::runtime_error(writingFailed(finalName(file_), error));
}

void writeFile(const fs::path& file, std::string_view contents) {
    AtomicFile out(file);
    std::fwrite(contents.data(), 1, contents.size(), out.stream());
    out.commit();
}

}  // namespace diptych
