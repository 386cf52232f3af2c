// SPDX-License-Identifier: MIT
// Preloaded into the tool: makes the n-th call of a kind fail, or kills the program before it.
//   FAULT_IN     "create" (folders, files, links), "write", "close" (and flush), "move" (renames),
//                "remove", "lock", separated by commas; or
//                "memory", "vkAllocateMemory", another function of Vulkan below
//   FAULT_AT     n, from 1; for Vulkan functions every later call fails too: a lost device stays lost
//   FAULT_FOR    if set: only this many calls of Vulkan functions fail, as if the device recovers
//   FAULT_DO     "kill", an errno as a number, or a VkResult
//   FAULT_FROM   if set: every later call fails too, as on a full disk
//   FAULT_UNDER  only files below this folder: drivers keep caches elsewhere
//   FAULT_SEEN   file that records the failed calls
//   FAULT_BYTES  ignores allocations below this size
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vulkan/vulkan_core.h>

#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <new>

// glibc's own names of the functions that are replaced here.
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);
extern "C" void* __libc_realloc(void* old, std::size_t size);

namespace {

std::atomic<int> calls{0};

const char* setting(const char* name) {
    const char* const value = std::getenv(name);
    return value ? value : "";
}

bool isMeant(const char* kind) {
    const char* const found = std::strstr(setting("FAULT_IN"), kind);
    const std::size_t size = std::strlen(kind);
    return found && (found[size] == 0 || found[size] == ',') &&
           (found == setting("FAULT_IN") || found[-1] == ',');
}

void sayItHappened(const char* kind, const char* where) {
    const int file = ::open(setting("FAULT_SEEN"), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (file < 0) return;
    char line[PATH_MAX + 32];
    const int size = std::snprintf(line, sizeof line, "%s %s\n", kind, where);
    if (size > 0 && ::write(file, line, static_cast<std::size_t>(size)) < 0) std::abort();
    ::close(file);
}

// The error number if this call must fail; otherwise 0.
int faultIn(const char* kind, const char* where = "", bool stays = false) {
    if (!isMeant(kind)) return 0;
    const int call = ++calls, at = std::atoi(setting("FAULT_AT"));
    if (call < at || (call > at && !stays && !*setting("FAULT_FROM"))) return 0;
    if (*setting("FAULT_FOR") && call >= at + std::atoi(setting("FAULT_FOR"))) return 0;
    sayItHappened(kind, where);
    if (std::strcmp(setting("FAULT_DO"), "kill") == 0) ::kill(::getpid(), SIGKILL);
    return std::atoi(setting("FAULT_DO"));
}

bool isUnder(const char* path) {
    return path[0] != '/' ||
           std::strncmp(path, setting("FAULT_UNDER"), std::strlen(setting("FAULT_UNDER"))) == 0;
}

bool isOpenUnder(int file) {
    char link[64], path[PATH_MAX];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t size = ::readlink(link, path, sizeof path - 1);
    if (size < 0) return false;
    path[size] = 0;
    return path[0] == '/' && isUnder(path);
}

// Whether the file is in the folder to be tested, and not e.g. the program's own stdout.
bool isUnder(int file) {
    return file > STDERR_FILENO && (::fcntl(file, F_GETFL) & O_ACCMODE) != O_RDONLY && isOpenUnder(file);
}

bool fails(const char* kind, const char* path) {
    if (const int error = isUnder(path) ? faultIn(kind, path) : 0) {
        errno = error;
        return true;
    }
    return false;
}

bool fails(const char* kind, int folder, const char* path) {
    return (path[0] == '/' || folder == AT_FDCWD || isOpenUnder(folder)) && fails(kind, path);
}

bool fails(const char* kind, std::FILE* stream) {
    if (const int error = isUnder(::fileno(stream)) ? faultIn(kind, "a file") : 0) {
        stream->_flags |= 0x20;  // glibc's error flag, which ferror() reads
        errno = error;
        return true;
    }
    return false;
}

template <typename Function>
Function next(const char* name, Function) {
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

// Large allocations of this program and of the libraries that process its images. Failed allocations in
// drivers are not tested (Mesa crashes).
bool allocationFails(std::size_t size, const void* caller) {
    if (!isMeant("memory") || size < static_cast<std::size_t>(std::atol(setting("FAULT_BYTES"))))
        return false;
    Dl_info module{};
    if (::dladdr(caller, &module) == 0 || !module.dli_fname) return false;
    for (const char* const ours :
         {"/diptych", "/report_writer", "libpng", "libOpenEXR", "libz.so", "libfmt", "libtinygltf"})
        if (std::strstr(module.dli_fname, ours)) return faultIn("memory", module.dli_fname) != 0;
    return false;
}

}  // namespace

#define NEXT(name) next(#name, &name)

extern "C" {

std::FILE* fopen(const char* path, const char* mode) {
    return std::strchr(mode, 'w') && fails("create", path) ? nullptr : NEXT(fopen)(path, mode);
}
int mkdir(const char* path, mode_t mode) noexcept {
    return fails("create", path) ? -1 : NEXT(mkdir)(path, mode);
}
int link(const char* from, const char* to) noexcept {
    return fails("create", to) ? -1 : NEXT(link)(from, to);
}
int mkdirat(int folder, const char* path, mode_t mode) noexcept {
    return fails("create", folder, path) ? -1 : NEXT(mkdirat)(folder, path, mode);
}
int linkat(int fromFolder, const char* from, int toFolder, const char* to, int flags) noexcept {
    return fails("create", toFolder, to) ? -1 : NEXT(linkat)(fromFolder, from, toFolder, to, flags);
}
int openat(int folder, const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return (flags & O_CREAT) != 0 && fails("create", folder, path) ? -1
                                                                   : NEXT(openat)(folder, path, flags, mode);
}
std::size_t fwrite(const void* data, std::size_t size, std::size_t count, std::FILE* stream) {
    return fails("write", stream) ? 0 : NEXT(fwrite)(data, size, count, stream);
}
int fflush(std::FILE* stream) {
    return stream && fails("close", stream) ? EOF : NEXT(fflush)(stream);
}
int fclose(std::FILE* stream) {
    const bool fault = fails("close", stream);
    const int error = errno, closed = NEXT(fclose)(stream);
    if (!fault) return closed;
    errno = error;
    return EOF;
}
int rename(const char* from, const char* to) noexcept {
    return fails("move", to) ? -1 : NEXT(rename)(from, to);
}
int renameat2(int fromFolder, const char* from, int toFolder, const char* to, unsigned flags) noexcept {
    return fails("move", toFolder, to) ? -1 : NEXT(renameat2)(fromFolder, from, toFolder, to, flags);
}
int remove(const char* path) noexcept {
    return fails("remove", path) ? -1 : NEXT(remove)(path);
}
int rmdir(const char* path) noexcept {
    return fails("remove", path) ? -1 : NEXT(rmdir)(path);
}
int unlinkat(int folder, const char* path, int flags) noexcept {
    return fails("remove", folder, path) ? -1 : NEXT(unlinkat)(folder, path, flags);
}
int flock(int file, int operation) noexcept {
    if (const int error = faultIn("lock")) {
        errno = error;
        return -1;
    }
    return NEXT(flock)(file, operation);
}

void* malloc(std::size_t size) noexcept {
    if (!allocationFails(size, __builtin_return_address(0))) return __libc_malloc(size);
    errno = ENOMEM;
    return nullptr;
}
void* calloc(std::size_t count, std::size_t size) noexcept {
    if (!allocationFails(count * size, __builtin_return_address(0))) return __libc_calloc(count, size);
    errno = ENOMEM;
    return nullptr;
}
void* realloc(void* old, std::size_t size) noexcept {
    if (!allocationFails(size, __builtin_return_address(0))) return __libc_realloc(old, size);
    errno = ENOMEM;
    return nullptr;
}

#define FAILS_IN_VULKAN(name, parameters, arguments)                             \
    VKAPI_ATTR VkResult VKAPI_CALL name parameters {                             \
        const int fault = faultIn(#name, "", true);                              \
        return fault != 0 ? static_cast<VkResult>(fault) : NEXT(name) arguments; \
    }
FAILS_IN_VULKAN(vkCreateInstance,
                (const VkInstanceCreateInfo* i, const VkAllocationCallbacks* a, VkInstance* o), (i, a, o))
FAILS_IN_VULKAN(vkCreateDevice,
                (VkPhysicalDevice d, const VkDeviceCreateInfo* i, const VkAllocationCallbacks* a,
                 VkDevice* o),
                (d, i, a, o))
FAILS_IN_VULKAN(vkAllocateMemory,
                (VkDevice d, const VkMemoryAllocateInfo* i, const VkAllocationCallbacks* a,
                 VkDeviceMemory* o),
                (d, i, a, o))
FAILS_IN_VULKAN(vkMapMemory,
                (VkDevice d, VkDeviceMemory m, VkDeviceSize f, VkDeviceSize s, VkMemoryMapFlags g, void** o),
                (d, m, f, s, g, o))
FAILS_IN_VULKAN(vkCreateBuffer,
                (VkDevice d, const VkBufferCreateInfo* i, const VkAllocationCallbacks* a, VkBuffer* o),
                (d, i, a, o))
FAILS_IN_VULKAN(vkCreateImage,
                (VkDevice d, const VkImageCreateInfo* i, const VkAllocationCallbacks* a, VkImage* o),
                (d, i, a, o))
FAILS_IN_VULKAN(vkCreateGraphicsPipelines,
                (VkDevice d, VkPipelineCache c, uint32_t n, const VkGraphicsPipelineCreateInfo* i,
                 const VkAllocationCallbacks* a, VkPipeline* o),
                (d, c, n, i, a, o))
FAILS_IN_VULKAN(vkAllocateDescriptorSets,
                (VkDevice d, const VkDescriptorSetAllocateInfo* i, VkDescriptorSet* o), (d, i, o))
FAILS_IN_VULKAN(vkQueueSubmit, (VkQueue q, uint32_t n, const VkSubmitInfo* i, VkFence f), (q, n, i, f))
FAILS_IN_VULKAN(vkQueueSubmit2, (VkQueue q, uint32_t n, const VkSubmitInfo2* i, VkFence f), (q, n, i, f))
FAILS_IN_VULKAN(vkWaitForFences, (VkDevice d, uint32_t n, const VkFence* f, VkBool32 w, uint64_t t),
                (d, n, f, w, t))

}  // extern "C"

void* operator new(std::size_t size) {
    void* const memory = allocationFails(size, __builtin_return_address(0)) ? nullptr : __libc_malloc(size);
    if (!memory) throw std::bad_alloc();
    return memory;
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
