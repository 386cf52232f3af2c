// SPDX-License-Identifier: MIT
#include "shared/text/input_file.h"

#include "shared/text/fail.h"
#include "shared/text/open_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

namespace diptych {
namespace {

namespace fs = std::filesystem;

constexpr int reading = O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY;

[[noreturn]] void failToOpen(int error) {
    if (error == ENOENT || error == ENOTDIR) fail("no such file");
    if (error == ELOOP) fail("is a link; links are not followed here");
    if (error == ENXIO) fail("is not a regular file");  // a socket, or a missing device
    fail("cannot be read: " + std::generic_category().message(error));
}

// Opens each folder on the way without following links.
int openBelow(const fs::path& root, const std::string& name) {
    const OpenFolder top = OpenFolder::at(root);
    int folder = top.isOpen() ? ::fcntl(top.descriptor(), F_DUPFD_CLOEXEC, 0) : -1;
    if (folder < 0) failToOpen(errno);
    const auto step = [&](const std::string& part, int flags) {
        const int next = part.empty() || part == ".." ? (errno = ELOOP, -1)
                                                      : ::openat(folder, part.c_str(), flags | O_NOFOLLOW);
        const int error = errno;
        struct stat there {};
        // O_DIRECTORY fails with ENOTDIR for a link.
        const bool link = next < 0 && ::fstatat(folder, part.c_str(), &there, AT_SYMLINK_NOFOLLOW) == 0 &&
                          S_ISLNK(there.st_mode);
        ::close(std::exchange(folder, next));
        if (link) fail(fmt::format("\"{}\" is a link; links are not followed here", part));
        if (next < 0) failToOpen(error);
    };
    std::size_t at = 0;
    for (std::size_t slash; (slash = name.find('/', at)) != name.npos; at = slash + 1)
        step(name.substr(at, slash - at), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    step(name.substr(at), reading);
    return folder;
}

std::string wholeOf(InputFile& file) {
    std::string text(file.size(), '\0');
    file.read(std::as_writable_bytes(std::span(text)));
    return text;
}

// A checkout without Git LFS leaves such a text in place of the file. Leaves the offset for reading.
bool isLfsPointer(int descriptor) {
    constexpr std::string_view start = "version https://git-lfs";
    char text[start.size()];
    return ::pread(descriptor, text, sizeof text, 0) == ssize_t{sizeof text} &&
           std::string_view(text, sizeof text) == start;
}

}  // namespace

InputFile::InputFile(const fs::path& file, std::uint64_t max_bytes)
    : descriptor_(::open(file.c_str(), reading)) {
    if (descriptor_ < 0) failToOpen(errno);
    check(max_bytes);
}

InputFile::InputFile(const fs::path& root, const std::string& name, std::uint64_t max_bytes)
    : descriptor_(openBelow(root, name)) {
    check(max_bytes);
}

InputFile::~InputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void InputFile::check(std::uint64_t max_bytes) {
    struct stat status {};
    const bool known = ::fstat(descriptor_, &status) == 0;
    const int error = errno;
    size_ = known ? static_cast<std::uint64_t>(status.st_size) : 0;
    const bool pointer = known && S_ISREG(status.st_mode) && isLfsPointer(descriptor_);
    if (known && S_ISREG(status.st_mode) && size_ <= max_bytes && !pointer) return;
    ::close(std::exchange(descriptor_, -1));  // the destructor does not run if the constructor throws
    if (!known) failToOpen(error);
    if (S_ISDIR(status.st_mode)) fail("is a folder");
    if (!S_ISREG(status.st_mode)) fail("is not a regular file");
    if (pointer) fail("is a Git LFS pointer, not the file; fetch it by git lfs pull");
    fail(fmt::format("has {} bytes; the limit is {}", size_, max_bytes));
}

void InputFile::read(std::span<std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t got = ::read(descriptor_, bytes.data(), bytes.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail("cannot be read: " + std::generic_category().message(errno));
        if (got == 0) fail("cannot be read to its end");
        bytes = bytes.subspan(static_cast<std::size_t>(got));
    }
}

std::string textIn(const fs::path& path, std::uint64_t max_bytes) {
    InputFile file(path, max_bytes);
    return wholeOf(file);
}

std::string textBelow(const fs::path& root, const std::string& name, std::uint64_t max_bytes) {
    InputFile file(root, name, max_bytes);
    return wholeOf(file);
}

}  // namespace diptych
