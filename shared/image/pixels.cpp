// SPDX-License-Identifier: MIT
#include "shared/image/pixels.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <mutex>
#include <set>
#include <string>

namespace diptych {
namespace {

// Images that are spilled to files, by address of their pixels. Never destroyed, because images may
// outlive it.
struct Kept {
    std::mutex mutex;
    std::set<const void*> images;
};

Kept& kept() {
    static auto* const all = new Kept;
    return *all;
}

// Opens a new unnamed file for reading and writing; -1 on failure.
int namelessFile() {
    const char* const chosen = std::getenv("TMPDIR");
    for (const std::string& folder :
         {std::string(chosen ? chosen : ""), std::string("/var/tmp"), std::string("/tmp")}) {
        if (folder.empty()) continue;
        std::string name = folder + "/diptych-XXXXXX";
        if (const int file = ::mkostemp(name.data(), O_CLOEXEC); file >= 0) {
            ::unlink(name.c_str());
            return file;
        }
    }
    return -1;
}

bool writeAll(int file, const char* bytes, std::size_t count) {
    while (count > 0) {
        const ssize_t written = ::write(file, bytes, count);
        if (written <= 0) return false;
        bytes += written;
        count -= static_cast<std::size_t>(written);
    }
    return true;
}

}  // namespace

void* pixels::takePages(std::size_t bytes) {
    void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    return memory;
}

void pixels::givePages(void* memory, std::size_t bytes) noexcept {
    {
        const std::lock_guard lock(kept().mutex);
        kept().images.erase(memory);
    }
    ::munmap(memory, bytes);
}

void keepInFile(PixelData& image) {
    const std::size_t bytes = image.size() * sizeof(float);
    if (bytes < pixels::ownPages) return;
    const int file = namelessFile();
    if (file < 0) return;
    // Maps the file over the vector's pages, which are its own and page-aligned.
    if (writeAll(file, reinterpret_cast<const char*>(image.data()), bytes)) {
        const std::lock_guard lock(kept().mutex);
        const auto entry = kept().images.insert(image.data()).first;
        if (::mmap(image.data(), bytes, PROT_READ, MAP_PRIVATE | MAP_FIXED, file, 0) == MAP_FAILED)
            kept().images.erase(entry);
    }
    ::close(file);  // the mapping keeps it open
}

void letGo(const PixelData& image) {
    const std::lock_guard lock(kept().mutex);
    if (kept().images.contains(image.data()))
        ::madvise(const_cast<float*>(image.data()), image.size() * sizeof(float), MADV_DONTNEED);
}

}  // namespace diptych
