#include "io/output/checkpoint.hpp"

#include <gmock/gmock.h>
#include <hdf5.h>

#include <bit>
#include <cstring>
#include <limits>
#include <random>

#include "base/errors.hpp"
#include "io/output/atomic_file.hpp"
#include "io/output/fingerprint.hpp"
#include "io/output/version.hpp"
#include "unit/io/output_folder.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Doubles = std::vector<double>;
using Wholes = std::vector<std::int64_t>;

class CheckpointFile : public test::OutputFolder {
protected:
    const fs::path path = folder / "checkpoint.h5";

    static Checkpoint example() {
        Checkpoint checkpoint("fnv1a64:0123456789abcdef");
        checkpoint.set("state.t", 1.0 / 3);
        checkpoint.set("state.u", Doubles{0.1, -0.0, 1e308});
        checkpoint.set("counts.step", std::int64_t{1} << 60);
        checkpoint.set("events", Wholes{-1, 2});
        checkpoint.set("a.comes.last", std::string("central_difference"));
        return checkpoint;
    }
    /// The message of loading; fails if anything was printed on the way.
    std::string refusal() {
        ::testing::internal::CaptureStderr();
        const std::string message = message_of<InputError>([&] { Checkpoint::load(path); });
        EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
        return message;
    }
};

TEST_F(CheckpointFile, RoundTrip_GivesBackEverythingInOrder) {
    example().save(path);
    const Checkpoint read = Checkpoint::load(path);
    EXPECT_THAT(read.names(), ElementsAre("state.t", "state.u", "counts.step", "events", "a.comes.last"));
    EXPECT_EQ(read.get<double>("state.t"), 1.0 / 3);
    EXPECT_EQ(read.get<Doubles>("state.u", 3), (Doubles{0.1, -0.0, 1e308}));
    EXPECT_TRUE(std::signbit(read.get<Doubles>("state.u")[1]));
    EXPECT_EQ(read.get<std::int64_t>("counts.step"), std::int64_t{1} << 60);
    EXPECT_EQ(read.get<Wholes>("events"), (Wholes{-1, 2}));
    EXPECT_EQ(read.get<std::string>("a.comes.last"), "central_difference");
    EXPECT_EQ(read.deck_fingerprint(), "fnv1a64:0123456789abcdef");
    EXPECT_EQ(read.program_version(), version_string());
    EXPECT_EQ(n_files(), 1u);
}

TEST_F(CheckpointFile, EveryBitPattern_ComesBack) {
    std::mt19937_64 random(4711);
    Doubles numbers(100'000);
    for (double& x : numbers) x = std::bit_cast<double>(random());
    // A quiet and a signalling NaN with payloads, the smallest subnormal number, both infinities.
    for (const auto bits : std::initializer_list<std::uint64_t>{0x7ff8dead'beef0001u, 0xfff00000'00000001u, 0x1u,
                                                                0x7ff00000'00000000u, 0xfff00000'00000000u})
        numbers.push_back(std::bit_cast<double>(bits));
    Checkpoint checkpoint;
    checkpoint.set("x", numbers);
    checkpoint.set("nan", numbers[numbers.size() - 4]);
    checkpoint.save(path);
    const Checkpoint read = Checkpoint::load(path);
    const Doubles& found = read.get<Doubles>("x", numbers.size());
    EXPECT_EQ(std::memcmp(found.data(), numbers.data(), numbers.size() * sizeof(double)), 0);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read.get<double>("nan")), 0xfff00000'00000001u);
}

TEST_F(CheckpointFile, EmptyAndOddValues_ComeBack) {
    Checkpoint checkpoint;
    checkpoint.set("no doubles", Doubles{});
    checkpoint.set("no wholes", Wholes{});
    checkpoint.set("no text", std::string());
    checkpoint.set("one", Doubles{1});
    checkpoint.set("bytes", std::string("a\0b\0", 4));
    checkpoint.save(path);
    const Checkpoint read = Checkpoint::load(path);
    EXPECT_TRUE(read.get<Doubles>("no doubles").empty());
    EXPECT_TRUE(read.get<Wholes>("no wholes").empty());
    EXPECT_EQ(read.get<std::string>("no text"), "");
    EXPECT_EQ(read.get<Doubles>("one"), Doubles{1});
    EXPECT_EQ(read.get<std::string>("bytes"), std::string("a\0b\0", 4));
    EXPECT_EQ(read.deck_fingerprint(), "");
}

TEST_F(CheckpointFile, EqualContent_GivesEqualBytes) {
    example().save(path);
    const std::string first = contents(path);
    Checkpoint::load(path).save(folder / "again.h5");
    EXPECT_EQ(contents(folder / "again.h5"), first);
}

TEST_F(CheckpointFile, SetAgain_ReplacesInPlace) {
    Checkpoint checkpoint = example();
    checkpoint.set("state.t", 2.0);
    EXPECT_EQ(checkpoint.get<double>("state.t"), 2.0);
    EXPECT_EQ(checkpoint.names().front(), "state.t");
    EXPECT_EQ(checkpoint.names().size(), 5u);
    for (const char* name : {"", ".", "a/b"}) EXPECT_THROW(checkpoint.set(name, 1.0), std::invalid_argument) << name;
}

TEST_F(CheckpointFile, WrongRequests_AreRefusedWithTheReason) {
    example().save(path);
    const Checkpoint read = Checkpoint::load(path);
    EXPECT_TRUE(read.contains("state.u"));
    EXPECT_FALSE(read.contains("state.v"));
    EXPECT_EQ(message_of<InputError>([&] { read.get<Doubles>("state.v"); }),
              path.string() + ": has no entry 'state.v'");
    EXPECT_EQ(message_of<InputError>([&] { read.get<double>("state.u"); }),
              path.string() + ": entry 'state.u' is numbers, needed: a number");
    EXPECT_EQ(message_of<InputError>([&] { read.get<Doubles>("state.u", 4); }),
              path.string() + ": entry 'state.u' has length 3, needed: 4");
}

TEST_F(CheckpointFile, NoFile_InputError) {
    EXPECT_EQ(refusal(), path.string() + ": no such checkpoint; a run leaves checkpoint.h5 among its results");
}

TEST_F(CheckpointFile, NotHdf5_InputError) {
    for (const char* text : {"", "t,u\n1,2\n"}) {
        put(path, text);
        EXPECT_EQ(refusal(), path.string() + ": is no checkpoint: it is not an HDF5 file");
    }
}

TEST_F(CheckpointFile, Hdf5OfSomethingElse_InputError) {
    H5Fclose(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
    EXPECT_EQ(refusal(), path.string() +
                             ": is cut off, or an HDF5 file of something else: the fingerprint at its end "
                             "is missing");
    put(path, contents(path) + fingerprint_text(contents(path)));
    EXPECT_EQ(refusal(), path.string() + ": is no checkpoint: this HDF5 file was written by something else");
}

TEST_F(CheckpointFile, OtherFormatVersion_InputErrorWithBoth) {
    example().save(path);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);  // as h5dump: the fingerprint does no harm
    ASSERT_GE(file, 0);
    const hid_t attribute = H5Aopen(file, "format_version", H5P_DEFAULT);
    const std::int64_t other = Checkpoint::format_version + 1;
    H5Awrite(attribute, H5T_NATIVE_INT64, &other);
    H5Aclose(attribute);
    H5Fclose(file);  // cuts off what stands behind its own bytes
    put(path, contents(path) + fingerprint_text(contents(path)));
    EXPECT_THAT(refusal(), HasSubstr("has checkpoint format 2, written by version " + version_string()));
}

TEST_F(CheckpointFile, CutOff_InputError) {
    example().save(path);
    const std::string whole = contents(path);
    for (const std::size_t length : {whole.size() - 1, whole.size() / 2, std::size_t{100}, std::size_t{9}}) {
        put(path, whole.substr(0, length));
        EXPECT_THAT(refusal(), HasSubstr("checkpoint.h5: is cut off")) << length;
    }
}

TEST_F(CheckpointFile, AnyBitChanged_IsNoticed) {
    example().save(path);
    const std::string whole = contents(path);
    constexpr std::size_t signature = 8;  // damage there is found too, with another message
    std::mt19937 random(4711);
    for (int trial = 0; trial < 300; ++trial) {
        const std::size_t at = signature + random() % (whole.size() - signature);
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << random() % 8));
        put(path, damaged);
        EXPECT_THAT(refusal(), ::testing::AnyOf(HasSubstr("is damaged"), HasSubstr("is cut off"))) << at;
    }
}

TEST_F(CheckpointFile, DiskFull_IoErrorAndOldFileStays) {
    example().save(path);
    const std::string before = contents(path);
    fill_disk(path);
    Checkpoint other;
    other.set("x", Doubles(100'000, 1.0));
    ::testing::internal::CaptureStderr();
    EXPECT_EQ(message_of<IoError>([&] { other.save(path); }),
              path.string() + ": cannot write: No space left on device");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(contents(path), before);
}

TEST_F(CheckpointFile, ErrorPrinting_IsAsBeforeAfterwards) {
    H5E_auto2_t before = nullptr, after = nullptr;
    void* data = nullptr;
    H5Eget_auto2(H5E_DEFAULT, &before, &data);
    ASSERT_NE(before, nullptr);
    refusal();
    H5Eget_auto2(H5E_DEFAULT, &after, &data);
    EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace gneiss
