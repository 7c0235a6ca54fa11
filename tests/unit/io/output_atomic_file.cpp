#include "io/output/atomic_file.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "io/output/fingerprint.hpp"
#include "io/output/version.hpp"
#include "unit/io/output_folder.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

class AtomicFile : public test::OutputFolder {};

TEST_F(AtomicFile, Contents_AppearUnderTheNameAlone) {
    write_atomically(folder / "a.txt", std::string_view("one\n"));
    EXPECT_EQ(contents(folder / "a.txt"), "one\n");
    EXPECT_EQ(n_files(), 1u);
}

TEST_F(AtomicFile, WhileWriting_OldFileStandsUntouched) {
    put(folder / "a.txt", "old");
    write_atomically(folder / "a.txt", [&](const fs::path& part) {
        EXPECT_EQ(part.parent_path(), folder);
        put(part, "new");
        EXPECT_EQ(contents(folder / "a.txt"), "old");
    });
    EXPECT_EQ(contents(folder / "a.txt"), "new");
}

TEST_F(AtomicFile, WriterThrows_OldFileStaysAndPartIsRemoved) {
    put(folder / "a.txt", "old");
    const auto failing = [&](const fs::path& part) {
        put(part, "half of it");
        throw std::runtime_error("no more");
    };
    EXPECT_THROW(write_atomically(folder / "a.txt", failing), std::runtime_error);
    EXPECT_EQ(contents(folder / "a.txt"), "old");
    EXPECT_EQ(n_files(), 1u);
}

TEST_F(AtomicFile, DiskFull_IoErrorWithPathAndReason) {
    const fs::path path = folder / "a.txt";
    fill_disk(path);
    EXPECT_EQ(message_of<IoError>([&] { write_atomically(path, std::string_view("text")); }),
              path.string() + ": cannot write: No space left on device");
    EXPECT_EQ(n_files(), 0u);
}

TEST_F(AtomicFile, ParentIsAFile_IoErrorWithPathAndReason) {
    put(folder / "file", "");
    const fs::path path = folder / "file" / "a.txt";
    try {
        write_atomically(path, std::string_view("text"));
        FAIL() << "no exception";
    } catch (const IoError& error) {
        EXPECT_EQ(error.path(), path);
        EXPECT_EQ(error.what(), path.string() + ": cannot open: Not a directory");
    }
}

TEST_F(AtomicFile, TargetIsAFolder_IoErrorAndPartIsRemoved) {
    fs::create_directory(folder / "a");
    EXPECT_THAT(message_of<IoError>([&] { write_atomically(folder / "a", std::string_view("text")); }),
                HasSubstr("cannot rename the finished file: Is a directory"));
    EXPECT_EQ(n_files(), 1u);
}

TEST_F(AtomicFile, ReadFile_GivesEveryByte) {
    const std::string text("a\0b\r\n\xff", 6);
    put(folder / "a", text);
    EXPECT_EQ(read_file(folder / "a"), text);
    EXPECT_THAT(message_of<IoError>([&] { read_file(folder / "none"); }), HasSubstr("No such file or directory"));
}

TEST_F(AtomicFile, MakeFolder_MakesParentsAndReportsFailure) {
    make_folder(folder / "a" / "b");
    make_folder(folder / "a" / "b");
    EXPECT_TRUE(fs::is_directory(folder / "a" / "b"));
    put(folder / "file", "");
    EXPECT_THAT(message_of<IoError>([&] { make_folder(folder / "file" / "b"); }), HasSubstr("Not a directory"));
}

TEST(Fingerprint, PublishedTestVectors_AreMet) {
    // Noll's test vectors of FNV-1a 64: "", "a", "foobar".
    EXPECT_EQ(fingerprint(""), 0xcbf29ce484222325u);
    EXPECT_EQ(fingerprint("a"), 0xaf63dc4c8601ec8cu);
    EXPECT_EQ(fingerprint("foobar"), 0x85944171f73967e8u);
    EXPECT_EQ(fingerprint("bar", fingerprint("foo")), fingerprint("foobar"));
    EXPECT_EQ(fingerprint_text("a"), "fnv1a64:af63dc4c8601ec8c");
}

TEST(Version, Text_HasNumberAndRevision) {
    EXPECT_THAT(version(), MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
    EXPECT_THAT(git_revision(), MatchesRegex("unknown|[0-9a-f]{7,40}(-dirty)?"));
    EXPECT_EQ(version_string(), version() + " (" + git_revision() + ")");
}

}  // namespace
}  // namespace gneiss
