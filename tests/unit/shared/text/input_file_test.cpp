// SPDX-License-Identifier: MIT
// Opening special files, and names that lead elsewhere.
#include "shared/text/input_file.h"
#include "tests/support/errors.h"
#include "tests/support/files.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <stdexcept>

namespace diptych {
namespace {

namespace fs = std::filesystem;

TEST(InputFile, ReadsARegularFileAndALinkToOne) {
    const fs::path root = folder();
    std::ofstream(root / "a.txt") << "four";
    fs::create_symlink("a.txt", root / "b.txt");
    EXPECT_EQ(textIn(root / "a.txt", 4), "four");
    EXPECT_EQ(textIn(root / "b.txt", 4), "four") << "users may name a file by a link";
    EXPECT_EQ(faultOf([&] { textIn(root / "a.txt", 3); }), "has 4 bytes; the limit is 3");
    EXPECT_EQ(faultOf([&] { textIn(root / "none.txt", 3); }), "no such file");
}

TEST(InputFile, APointerOfGitLfsIsNamed) {
    const fs::path root = folder();
    std::ofstream(root / "a.png") << "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n";
    const std::string said = "is a Git LFS pointer, not the file; fetch it by git lfs pull";
    EXPECT_EQ(faultOf([&] { textIn(root / "a.png", 100); }), said);
    EXPECT_EQ(faultOf([&] { textBelow(root, "a.png", 100); }), said);
}

// None of them blocks; otherwise the test would hang.
TEST(InputFile, WhatIsNoFileIsSaidAtOnce) {
    const fs::path root = folder();
    ASSERT_EQ(::mkfifo((root / "fifo").c_str(), 0600), 0);
    const int listening = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string name = (root / "s").string();
    ASSERT_LT(name.size(), sizeof address.sun_path);
    std::strcpy(address.sun_path, name.c_str());
    ASSERT_EQ(::bind(listening, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    for (const fs::path& path : {root / "fifo", root / "s", fs::path("/dev/zero"), fs::path("/dev/null")})
        EXPECT_EQ(faultOf([&] { textIn(path, 100); }), "is not a regular file") << path;
    EXPECT_EQ(faultOf([&] { textIn(root, 100); }), "is a folder");
    EXPECT_EQ(faultOf([&] { textBelow(root, "fifo", 100); }), "is not a regular file");
    ::close(listening);
    // A sparse file of 2^40 bytes.
    { std::ofstream(root / "sparse"); }
    fs::resize_file(root / "sparse", std::uintmax_t(1) << 40);
    EXPECT_EQ(faultOf([&] { textIn(root / "sparse", 1000); }), "has 1099511627776 bytes; the limit is 1000");
}

TEST(InputFile, BelowAFolderNoLinkIsFollowed) {
    const fs::path root = folder();
    fs::create_directories(root / "shard/in");
    fs::create_directories(root / "private");
    std::ofstream(root / "private/key.png") << "secret";
    std::ofstream(root / "shard/in/a.png") << "fine";
    fs::create_symlink("../private", root / "shard/out");
    fs::create_symlink("../../private/key.png", root / "shard/in/b.png");
    fs::create_symlink("a.png", root / "shard/in/c.png");
    const fs::path shard = root / "shard";
    EXPECT_EQ(textBelow(shard, "in/a.png", 100), "fine");
    EXPECT_NE(faultOf([&] { textBelow(shard, "out/key.png", 100); }).find("\"out\" is a link"),
              std::string::npos);
    for (const char* name : {"in/b.png", "in/c.png"})
        EXPECT_NE(faultOf([&] { textBelow(shard, name, 100); }).find(".png\" is a link"), std::string::npos)
            << name;
    for (const char* name :
         {"../private/key.png", "in/../../private/key.png", "/etc/passwd", "", "in//a.png", "in/"})
        EXPECT_NE(faultOf([&] { textBelow(shard, name, 1 << 20); }), "") << name;
    fs::create_directory_symlink("shard", root / "named");
    EXPECT_EQ(textBelow(root / "named", "in/a.png", 100), "fine") << "the folder itself is the user's choice";
}

TEST(InputFile, ReadsAsManyBytesAsWereAskedFor) {
    const fs::path root = folder();
    std::ofstream(root / "a") << "abcdef";
    InputFile file(root / "a");
    EXPECT_EQ(file.size(), 6u);
    std::string piece(4, ' ');
    file.read(std::as_writable_bytes(std::span(piece)));
    EXPECT_EQ(piece, "abcd");
    EXPECT_EQ(faultOf([&] { file.read(std::as_writable_bytes(std::span(piece))); }),
              "cannot be read to its end");
}

}  // namespace
}  // namespace diptych
