// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

Result<SurveyInfo> info_of(const std::vector<fs::path>& paths, bool checksum = true) {
  Work work(2);
  const auto survey = open_survey(paths, {}, {}, IndexCache{}, work);
  if (!survey) return pass_on(survey);
  return survey_info(*survey, {}, checksum, work);
}

TEST(Info, JsonHasTheNamesAndUnitsOfTheInterface) {
  const test::TemporaryFolder folder;
  folder.write("a.raw", test::small_file(2));
  const auto info = info_of({folder.path()});
  ASSERT_TRUE(info);
  const json j = json::parse(info_json(*info));
  const json& file = j.at("files").at(0);
  EXPECT_EQ(file.at("path"), (folder.path() / "a.raw").string());
  EXPECT_EQ(file.at("format"), "simrad-raw");
  EXPECT_EQ(file.at("sounder"), "MBS");
  EXPECT_EQ(file.at("size"), test::small_file(2).size());
  EXPECT_EQ(file.at("datagrams"), (json{{"CON0", 1}, {"NME0", 4}, {"RAW0", 12}}));
  EXPECT_EQ(file.at("channels"), 6);
  EXPECT_EQ(file.at("pings"), 2);
  EXPECT_EQ(file.at("samples"), (json{{"min", 4}, {"max", 4}}));
  EXPECT_EQ(file.at("first_time_utc"), "2020-01-01T00:00:00.000Z");
  EXPECT_EQ(file.at("last_time_utc"), "2020-01-01T00:00:01.000Z");
  EXPECT_EQ(file.at("first_position").at("latitude"), 60.0);
  EXPECT_EQ(file.at("talkers").at("position"), "GP");
  // The fixes say midnight, half a second after and half a second before the datagrams' clock.
  EXPECT_EQ(file.at("gps_minus_clock_s"), -0.5);
  EXPECT_EQ(file.at("notes"), json::array());
  // 2 pings, channels 1..6, samples 0..3: 2 * (4 * 10 * 21 + 6 * 6).
  EXPECT_EQ(file.at("power_count_sum"), 1752);
  const json& observation = j.at("observations").at(0);
  EXPECT_EQ(observation.at("name"), "obs-0001");
  EXPECT_EQ(observation.at("files"), json{"a.raw"});
  EXPECT_EQ(observation.at("pings"), 2);
  EXPECT_EQ(observation.at("grid"), (json{{"fans", 2}, {"beams", 3}}));
  // By hand: the square of beams of 7 x 3 degrees has 10 log10(pi / (8 ln 2) x 21 (pi / 180)^2) = -24.408 dB; -23 are stated.
  EXPECT_EQ(observation.at("psi").at("stated_db").size(), 2U);
  EXPECT_EQ(observation.at("psi").at("stated_db")[0], json({-23.0, -23.0, -23.0}));
  EXPECT_EQ(observation.at("psi").at("from_widths_db")[1][2], -24.408);
  EXPECT_EQ(observation.at("psi").at("excess_db")[1][2], 1.408);
  EXPECT_THAT(info_text(*info),
              testing::HasSubstr("psi is 1.4 to 1.4 dB (mean 1.4) more than the widths give\n  by fan, "
                                 "deepest first, dB: 1.4 1.4\n"));
}

// The test file's beams: 7 degrees in the first field of widths, which an MS70 has for vertical, 3 in the second.
TEST(Info, WidthsAreNamedAsTheSounderLooks) {
  const test::TemporaryFolder folder;
  folder.write("fans.raw", test::small_file(1));
  const auto fans = info_of({folder.path() / "fans.raw"});
  ASSERT_TRUE(fans);
  EXPECT_THAT(info_text(*fans), testing::HasSubstr(", -3 dB width vertical 7 deg, horizontal 3 deg\n"));
  const json seven{{"min", 7.0}, {"max", 7.0}};
  const json three{{"min", 3.0}, {"max", 3.0}};
  const json of_fans = json::parse(info_json(*fans)).at("observations").at(0).at("instrument");
  EXPECT_EQ(of_fans.at("width_vertical_deg"), seven);
  EXPECT_EQ(of_fans.at("width_horizontal_deg"), three);
  EXPECT_EQ(of_fans.at("width_alongship_deg"), seven);

  folder.write("down.raw",
               test::con0({.sounder = "ER60", .beams = {{}}}).add(test::raw0(test::kStart, {.channel = 1}, {1, 2})));
  const auto down = info_of({folder.path() / "down.raw"});
  ASSERT_TRUE(down);
  EXPECT_THAT(info_text(*down), testing::HasSubstr(", -3 dB width alongship 7 deg, athwartship 3 deg\n"));
  const json of_down = json::parse(info_json(*down)).at("observations").at(0).at("instrument");
  EXPECT_EQ(of_down.at("width_alongship_deg"), seven);
  EXPECT_EQ(of_down.at("width_vertical_deg"), nullptr);
}

TEST(Info, AnObservationIsHeadedByTheModel) {
  for (const auto& [recorder, head] : {std::pair{"MBS", "obs-0001: Simrad MS70 (MBS), 1 ping, 2 fans x 3 beams, "},
                                       std::pair{"Simrad MS70", "obs-0001: Simrad MS70, 1 ping, 2 fans x 3 beams, "},
                                       std::pair{"ER60", "obs-0001: Simrad EK60 (ER60), 1 ping, no grid, "},
                                       std::pair{"XYZ", "obs-0001: XYZ, 1 ping, "}}) {
    const test::TemporaryFolder folder;
    test::Con0Spec spec = test::small_ms70();
    spec.sounder = recorder;
    folder.write("a.raw", test::con0(spec).add(test::small_ping(test::kStart)));
    const auto info = info_of({folder.path()});
    ASSERT_TRUE(info);
    EXPECT_THAT(info_text(*info), testing::HasSubstr(head)) << recorder;
  }
}

TEST(Info, DamagedFileIsListedWithItsNotes) {
  const test::TemporaryFolder folder;
  test::Bytes bytes = test::small_file(2);
  bytes.data.resize(bytes.size() - 1);
  folder.write("a.raw", bytes);
  const auto info = info_of({folder.path()});
  ASSERT_TRUE(info);
  EXPECT_TRUE(info->all_readable());
  const json note = json::parse(info_json(*info)).at("files").at(0).at("notes").at(0);
  EXPECT_EQ(note.at("code"), "file-truncated");
  EXPECT_GT(note.at("offset"), 0);
  EXPECT_TRUE(note.at("text").is_string());
}

TEST(Info, FilesThatCannotBeReadAreToldApart) {
  const test::TemporaryFolder folder;
  folder.write("a.raw", test::small_file(1));
  EXPECT_TRUE(info_of({folder.path()}).value().all_readable());
  folder.write("empty.raw", {});
  const auto info = info_of({folder.path()});
  ASSERT_TRUE(info);
  EXPECT_FALSE(info->all_readable());
  EXPECT_EQ(info->files.size(), 2U);
  EXPECT_EQ(info->observations.size(), 1U);
  EXPECT_FALSE(info_text(*info).empty());
}

/// Counted by walking the recorded files to their last byte (data/README.md).
struct Fact {
  const char* file;
  int channels;
  int pings;
  int samples;
  std::int64_t sentences;
  std::int64_t sum;
};

TEST(Info, FactsOfTheRecordedFiles) {
  const fs::path folder = test::data_folder() / "raw";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "no recorded data beside the source";
  for (const Fact& fact : {Fact{"Summer2017-D20170615-T214712.raw", 3, 10, 259, 130, -48'757'955},
                           Fact{"Summer2017-D20170615-T214606.raw", 3, 43, 259, -1, -208'610'252},
                           Fact{"Summer2017-D20170615-T212933.raw", 3, 52, 259, 745, -252'834'558},
                           Fact{"Summer2017-D20170615-T190214.raw", 3, 19, 3888, 688, -2'561'562'094},
                           Fact{"RedSlip-D20160915-T120914.raw", 1, 1205, 837, 1, -6'950'622'914},
                           Fact{"D20070724-T042400.raw", 4, 36, 2604, 125, -4'405'006'622}}) {
    const auto info = info_of({folder / fact.file});
    ASSERT_TRUE(info) << fact.file;
    const FileInfo& file = info->files.at(0);
    EXPECT_EQ(file.format, "simrad-raw");
    EXPECT_EQ(file.sounder, "ER60");
    EXPECT_EQ(file.channels, fact.channels) << fact.file;
    EXPECT_EQ(file.pings, fact.pings) << fact.file;
    EXPECT_EQ(file.min_samples, fact.samples) << fact.file;
    EXPECT_EQ(file.max_samples, fact.samples) << fact.file;
    EXPECT_EQ(file.datagrams.at("RAW0"), fact.channels * fact.pings) << fact.file;
    if (fact.sentences >= 0) {
      EXPECT_EQ(file.datagrams.at("NME0"), fact.sentences) << fact.file;
    }
    EXPECT_EQ(file.power_count_sum, fact.sum) << fact.file;
    EXPECT_TRUE(file.notes.empty()) << fact.file;
  }
}

TEST(Info, PlacesAndClocksOfTheRecordedFiles) {
  const fs::path folder = test::data_folder() / "raw";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "no recorded data beside the source";
  const FileInfo pacific = info_of({folder / "Summer2017-D20170615-T190214.raw"}, false).value().files.at(0);
  EXPECT_NEAR(pacific.first_position->latitude_deg, 44.6264, 5e-5);
  EXPECT_NEAR(pacific.first_position->longitude_deg, -124.0481, 5e-5);
  EXPECT_EQ(pacific.talkers.at("heading"), "IN");
  EXPECT_EQ(pacific.talkers.at("position"), "GP");
  const FileInfo atlantic = info_of({folder / "D20070724-T042400.raw"}, false).value().files.at(0);
  EXPECT_NEAR(atlantic.first_position->latitude_deg, 40.263, 5e-4);
  EXPECT_NEAR(atlantic.first_position->longitude_deg, -71.222, 5e-4);
  EXPECT_NEAR(atlantic.gps_minus_clock_s, -35.0, 0.5);
  const FileInfo red_slip = info_of({folder / "RedSlip-D20160915-T120914.raw"}, false).value().files.at(0);
  EXPECT_EQ(iso_time(*red_slip.first_time), "2016-09-15T12:09:14.888Z");
  EXPECT_EQ(iso_time(*red_slip.last_time), "2016-09-15T12:10:06.644Z");
  EXPECT_FALSE(red_slip.first_position);
}

TEST(Info, Ek80AndNetcdfAreRecognisedAndNamed) {
  const fs::path folder = test::data_folder();
  if (folder.empty()) GTEST_SKIP() << "no recorded data beside the source";
  const auto ek80 = info_of({folder / "raw/EK80-power-angle.raw"});
  ASSERT_TRUE(ek80);
  EXPECT_EQ(ek80->files.at(0).format, "simrad-ek80");
  EXPECT_EQ(ek80->files.at(0).datagrams.at("RAW3"), 12);
  EXPECT_TRUE(ek80->all_readable());
  const auto netcdf = info_of({folder / "netcdf/SU90-sonar-netcdf4-template.nc"});
  ASSERT_TRUE(netcdf);
  EXPECT_EQ(netcdf->files.at(0).format, "sonar-netcdf4");
  EXPECT_FALSE(netcdf->all_readable());
}

}  // namespace
}  // namespace sonar
