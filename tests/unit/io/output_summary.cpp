#include "io/output/summary.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "io/output/atomic_file.hpp"
#include "io/output/version.hpp"
#include "unit/io/output_folder.hpp"

namespace gneiss {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class SummaryOutput : public test::OutputFolder {
protected:
    json written(const RunSummary& summary) {
        write_summary(folder / "summary.json", summary);
        return json::parse(contents(folder / "summary.json"));
    }
};

TEST_F(SummaryOutput, ReadBack_HasEverythingInOrder) {
    RunSummary summary{RunStatus::done, "", "a borehole", "fnv1a64:1", {}};
    summary.groups["counts"] = {{"steps", 12345678901}, {"nodes", 4}};
    summary.groups["metrics"]["peak"] = 1.0 / 3;
    const json read = written(summary);
    EXPECT_EQ(read.at("status"), "done");
    EXPECT_FALSE(read.contains("message"));
    EXPECT_EQ(read.at("title"), "a borehole");
    EXPECT_EQ(read.at("version"), version_string());
    EXPECT_EQ(read.at("deck_fingerprint"), "fnv1a64:1");
    EXPECT_EQ(read.at("counts").at("steps"), 12345678901);
    EXPECT_EQ(read.at("metrics").at("peak").get<double>(), 1.0 / 3);
    EXPECT_FALSE(read.contains("not_finite"));
    const std::string text = contents(folder / "summary.json");
    EXPECT_LT(text.find("status"), text.find("counts"));
    EXPECT_LT(text.find("counts"), text.find("metrics"));
    EXPECT_EQ(text.back(), '\n');
}

TEST_F(SummaryOutput, Status_HasItsName) {
    EXPECT_EQ(written({RunStatus::running}).at("status"), "running");
    EXPECT_EQ(written({RunStatus::interrupted, "SIGTERM"}).at("status"), "interrupted");
    const json failed = written({RunStatus::failed, "element 3 is inverted"});
    EXPECT_EQ(failed.at("status"), "failed");
    EXPECT_EQ(failed.at("message"), "element 3 is inverted");
}

TEST_F(SummaryOutput, NotFiniteNumbers_BecomeNullAndAreListed) {
    const double inf = std::numeric_limits<double>::infinity();
    RunSummary summary;
    summary.groups["metrics"] = {{"good", 1.5}, {"bad", std::numeric_limits<double>::quiet_NaN()}};
    summary.groups["energies"]["list"] = {1.0, inf, -inf};
    const json read = written(summary);
    EXPECT_TRUE(read.at("metrics").at("bad").is_null());
    EXPECT_EQ(read.at("metrics").at("good"), 1.5);
    EXPECT_TRUE(read.at("energies").at("list").at(1).is_null());
    EXPECT_EQ(read.at("not_finite"), json({"/metrics/bad: nan", "/energies/list/1: inf", "/energies/list/2: -inf"}));
}

TEST_F(SummaryOutput, TitleThatIsNoUtf8_IsWrittenAllTheSame) {
    RunSummary summary;
    summary.title = "Gestein \xff";
    EXPECT_EQ(written(summary).at("title"), "Gestein \xEF\xBF\xBD");
}

TEST_F(SummaryOutput, DiskFull_OldSummaryStays) {
    written({RunStatus::running});
    fill_disk(folder / "summary.json");
    EXPECT_THAT(test::message_of<IoError>([&] { write_summary(folder / "summary.json", {RunStatus::done}); }),
                HasSubstr("summary.json: cannot write: No space left on device"));
    EXPECT_EQ(json::parse(contents(folder / "summary.json")).at("status"), "running");
}

}  // namespace
}  // namespace gneiss
