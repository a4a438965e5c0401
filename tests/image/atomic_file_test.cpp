// Files are written whole or not at all: after any failure the folder holds what it held before.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "base/diagnostics.h"
#include "base/file.h"
#include "image/temporary_folder.h"

namespace brume {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(AtomicFile, WritesAndReplaces) {
  const TemporaryFolder folder;
  const std::string path = folder.file("with spaces and ümläuts.txt");
  write_file_atomically(path, "old");
  write_file_atomically(path, "new and longer");
  EXPECT_EQ(read_file(path), "new and longer");
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST(AtomicFile, RespectsTheUmask) {
  const TemporaryFolder folder;
  const mode_t before = umask(027);
  write_file_atomically(folder.file("a"), "x");
  umask(before);
  struct stat status {};
  ASSERT_EQ(stat(folder.file("a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(AtomicFile, AThrowingWriterLeavesTheOldFileAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.txt");
  write_file_atomically(path, "old");
  const auto fail_halfway = [&](const std::string& temporary) {
    EXPECT_TRUE(temporary.ends_with(".part"));
    EXPECT_EQ(folder.names().size(), 2u);
    write_bytes_to(temporary, "ne");
    throw std::runtime_error("halfway");
  };
  EXPECT_THROW(write_file_atomically(path, fail_halfway), std::runtime_error);
  EXPECT_EQ(read_file(path), "old");
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

// The limit on a file's size stands in for a full disk: write() fails after some bytes.
TEST(AtomicFile, AFailingDiskLeavesTheOldFileAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.txt");
  write_file_atomically(path, "old");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{100000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = error_of([&] { write_file_atomically(path, std::string(1000000, 'x')); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(message, HasSubstr(path));
  EXPECT_THAT(message, HasSubstr("File too large"));
  EXPECT_EQ(read_file(path), "old");
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(AtomicFile, NamesThePathAndTheReason) {
  const TemporaryFolder folder;
  write_file_atomically(folder.file("file"), "x");
  const auto message = [&](const std::string& path) {
    std::string text = error_of([&] { write_file_atomically(path, "x"); });
    EXPECT_THAT(text, HasSubstr(path));
    EXPECT_EQ(text, error_of([&] { check_writable(path); }));
    return text;
  };
  EXPECT_THAT(message(folder.path()), HasSubstr("it is a folder"));
  EXPECT_THAT(message(folder.file("missing/a.txt")), HasSubstr("there is no folder"));
  EXPECT_THAT(message(folder.file("file/a.txt")), HasSubstr("not a folder"));
  EXPECT_THAT(message(""), HasSubstr("empty"));
  EXPECT_THAT(message("/dev/null"), HasSubstr("not a regular file"));
  EXPECT_THAT(folder.names(), ElementsAre("file"));
}

TEST(AtomicFile, AFolderWithoutPermission) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const TemporaryFolder folder;
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_THAT(error_of([&] { write_file_atomically(folder.file("a"), "x"); }), HasSubstr("Permission denied"));
}

TEST(AtomicFile, FollowsASymbolicLink) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("there"));
  std::filesystem::create_symlink("there/target", folder.file("link"));
  write_file_atomically(folder.file("link"), "x");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(read_file(folder.file("there/target")), "x");
}

TEST(AtomicFile, TakesTheLongestNames) {
  const TemporaryFolder folder;
  const std::string path = folder.file(std::string(255, 'n'));
  write_file_atomically(path, "x");
  EXPECT_EQ(read_file(path), "x");
}

TEST(ReadFile, RefusesWhatIsNoFile) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { read_file(folder.file("missing")); }), HasSubstr("No such file"));
  EXPECT_THAT(error_of([&] { read_file(folder.path()); }), HasSubstr("it is a folder"));
  EXPECT_THAT(error_of([&] { read_file("/dev/zero"); }), HasSubstr("not a regular file"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Suffix, IsLowerCaseAndOfTheLastPart) {
  EXPECT_EQ(suffix("a/b.c/Picture.EXR"), ".exr");
  EXPECT_EQ(suffix("a.b/c"), "");
  EXPECT_EQ(suffix(".png"), "");
  EXPECT_EQ(suffix("x.tar.gz"), ".gz");
}

}  // namespace
}  // namespace brume
