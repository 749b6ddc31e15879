// SPDX-License-Identifier: Apache-2.0
#include "pipeline/survey/survey.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "io/simrad/test_bytes.h"
#include "pipeline/stages/load_volume.h"
#include "pipeline/survey/test_opened.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using test::Bytes;
using test::count;
using test::kStart;
using test::opened;

std::vector<TimeNs> times(const SurveyFiles& survey) {
  std::vector<TimeNs> list;
  for (const ObservationFiles& o : survey.observations) {
    for (std::size_t i = 0; i < o.pings.size(); ++i) list.push_back(survey.ping_time(o, i));
  }
  return list;
}

Bytes er60(int pings, TimeNs start, float gain_db = 20.0F) {
  Bytes bytes = test::con0({.sounder = "ER60", .beams = {{38'000.0F, 0.0F, 0.0F, gain_db}}}, start);
  for (int i = 0; i < pings; ++i) bytes.add(test::raw0(start + i * kSecondNs, {.frequency_hz = 38'000.0F}, {1, 2, 3}));
  return bytes;
}

TEST(Survey, FolderHoldsRawFilesOfAnyCase) {
  const test::TemporaryFolder folder;
  folder.write("b.RAW", test::small_file(1));
  folder.write("a.raw", test::small_file(1));
  folder.write("c.txt", test::small_file(1));
  fs::create_directory(folder.path() / "deeper.raw");
  const std::vector<fs::path> folder_only{folder.path()};
  EXPECT_EQ(list_survey(folder_only).value(),
            (std::vector<fs::path>{folder.path() / "a.raw", folder.path() / "b.RAW"}));
  const std::vector<fs::path> named{folder.path() / "c.txt", folder.path(), folder.path() / "a.raw"};
  EXPECT_EQ(list_survey(named).value().size(), 3U);
  const std::vector<fs::path> missing{folder.path() / "none"};
  EXPECT_EQ(list_survey(missing).error().code, ErrorCode::not_found);
}

// By the standard's attributes in the head of an HDF5 file; a raster of depths beside raw files is none of the survey's.
TEST(Survey, FilesOfSonarNetcdf4AreNamedAndOtherNetcdfIsNot) {
  const test::TemporaryFolder folder;
  const auto hdf5 = [](const std::string& text) {
    return Bytes().text("\x89HDF\r\n\x1a\n", 8).zeros(600).text(text, 64);
  };
  folder.write("sonar.nc", hdf5("sonar_convention_name"));
  folder.write("depth.nc", hdf5("elevation"));
  folder.write("words.nc", Bytes().text("SONAR-netCDF4 is a convention", 40));
  const std::vector<fs::path> paths{folder.path()};
  EXPECT_EQ(list_survey(paths).value(), (std::vector<fs::path>{folder.path() / "sonar.nc"}));
  const SurveyFiles survey = opened(folder);
  EXPECT_TRUE(require_files(survey, paths));
  EXPECT_EQ(count(survey.files.at(0).index.diagnostics, DiagnosticCode::format_not_read), 1);
  const test::TemporaryFolder empty;
  const std::vector<fs::path> nothing{empty.path()};
  const auto refused = require_files(opened(empty), nothing);
  ASSERT_FALSE(refused);
  EXPECT_EQ(to_line(refused.error()), empty.path().string() + ": holds no raw files (*.raw)");
}

TEST(Survey, OneObservationOverFilesInOrderOfTime) {
  const test::TemporaryFolder folder;
  folder.write("z-first.raw", test::small_file(3));
  folder.write("a-second.raw", test::small_file(2, kStart + 100 * kSecondNs));
  const SurveyFiles survey = opened(folder);
  ASSERT_EQ(survey.observations.size(), 1U);
  const ObservationFiles& o = survey.observations[0];
  EXPECT_EQ(o.name, "obs-0001");
  EXPECT_EQ(o.pings.size(), 5U);
  EXPECT_EQ(o.files.size(), 2U);
  EXPECT_EQ(input_files(survey, o).at(0).name, "z-first.raw");
  EXPECT_TRUE(o.diagnostics.empty());
  EXPECT_EQ(o.navigation.size(), 5U);
  EXPECT_NEAR(o.navigation[0].transducer.latitude_deg, 60.0, 1e-9);
  EXPECT_EQ(o.navigation[0].heading_deg, 90.0);
  EXPECT_EQ(o.navigation[0].transducer_depth_m, 7.0);
  EXPECT_EQ(o.talkers.at("heading"), "IN");
}

TEST(Survey, GridRangeAndSettings) {
  const test::TemporaryFolder folder;
  folder.write("a.raw", test::small_file(1));
  const SurveyFiles survey = opened(folder);
  const ObservationFiles& o = survey.observations.at(0);
  ASSERT_TRUE(o.grid);
  EXPECT_EQ(o.grid->fans(), 2);
  EXPECT_EQ(o.grid->beams(), 3);
  EXPECT_EQ(o.grid->azimuth_deg, (std::vector<double>{267.5, 270.0, 272.5}));
  // dr = 1500 * 0.0005 / 2; range zero = c tau / 4 = 1500 * 0.002 / 4.
  EXPECT_NEAR(o.range.spacing_m, 0.375, 1e-7);
  EXPECT_NEAR(o.range.first_m, -0.75, 1e-6);
  EXPECT_EQ(o.range.count, 4);
  EXPECT_EQ(o.sample_count, (std::vector<std::int32_t>{4, 4}));
  EXPECT_EQ(o.transmit.size(), 6U);
  EXPECT_EQ(o.sound_speed_mps, 1500.0);
  EXPECT_EQ(opened({folder.path()}, {.range_zero_pulses = 0.0}).observations.at(0).range.first_m, 0.0);
}

TEST(Survey, GapBeginsAnObservation) {
  const auto observations = [](TimeNs gap) {
    const test::TemporaryFolder folder;
    folder.write("a.raw", test::small_file(1).add(test::small_ping(kStart + gap)));
    return opened(folder).observations.size();
  };
  EXPECT_EQ(observations(120 * kSecondNs), 1U);
  EXPECT_EQ(observations(121 * kSecondNs), 2U);
}

TEST(Survey, LongestDurationCutsAndSaysSo) {
  const test::TemporaryFolder folder;
  folder.write("a.raw", test::small_file(25));
  const SurveyFiles survey = opened(folder, {.observation_max_s = 10.0});
  ASSERT_EQ(survey.observations.size(), 3U);
  EXPECT_EQ(survey.observations[0].pings.size(), 11U);  // 0 .. 10 s
  EXPECT_EQ(survey.observations[1].pings.size(), 11U);
  EXPECT_EQ(survey.observations[2].pings.size(), 3U);
  EXPECT_FALSE(survey.observations[0].continues_cut);
  EXPECT_TRUE(survey.observations[1].continues_cut);
  EXPECT_EQ(survey.observations[0].cut_after, 0);
  EXPECT_EQ(survey.observations[1].cut_after, kStart + 10 * kSecondNs);
  EXPECT_TRUE(survey.observations[1].diagnostics.empty());
  EXPECT_EQ(opened(folder, {.observation_max_s = 0.0}).observations.size(), 1U);
}

TEST(Survey, OtherSoundersAreNumberedAfterTheMs70) {
  const test::TemporaryFolder folder;
  folder.write("a.raw", er60(3, kStart - 10 * kSecondNs));
  folder.write("b.raw", test::small_file(2));
  folder.write("c.raw", er60(3, kStart + kSecondNs));
  const SurveyFiles survey = opened(folder);
  ASSERT_EQ(survey.observations.size(), 2U);
  EXPECT_EQ(survey.observations[0].config.kind, SounderKind::ms70);
  EXPECT_EQ(survey.observations[0].pings.size(), 2U);
  EXPECT_EQ(survey.observations[1].name, "obs-0002");
  EXPECT_EQ(survey.observations[1].pings.size(), 6U);
  EXPECT_FALSE(survey.observations[1].grid);
  EXPECT_EQ(count(survey.observations[1].diagnostics, DiagnosticCode::no_grid), 1);
}

TEST(Survey, CopiesChangeNothing) {
  const test::TemporaryFolder folder;
  folder.write("line.raw", test::small_file(3));
  folder.write("line2.raw", test::small_file(3, kStart + 10 * kSecondNs));
  const SurveyFiles before = opened(folder);
  folder.write("line3, a copy.raw", test::small_file(3));
  const SurveyFiles after = opened(folder);
  EXPECT_EQ(times(after), times(before));
  ASSERT_EQ(after.observations.size(), 1U);
  EXPECT_EQ(input_files(after, after.observations[0]), input_files(before, before.observations[0]));
  EXPECT_EQ(count(after.diagnostics, DiagnosticCode::duplicate_file), 1);
  EXPECT_TRUE(after.observations[0].diagnostics.empty());
  folder.write("a copy of line.raw", test::small_file(3));  // the first by name is the one
  const SurveyFiles again = opened(folder);
  EXPECT_EQ(times(again), times(before));
  EXPECT_EQ(input_files(again, again.observations[0]).at(0).name, "a copy of line.raw");
  EXPECT_EQ(count(again.diagnostics, DiagnosticCode::duplicate_file), 2);
}

/// A file with some channels of small_ping() only, 1-based as in the file.
Bytes channels_of(const std::vector<int>& channels, int pings) {
  Bytes bytes = test::con0(test::small_ms70());
  for (int i = 0; i < pings; ++i) {
    for (const int channel : channels) {
      bytes.add(test::raw0(kStart + i * kSecondNs, {.channel = channel},
                           {static_cast<std::int16_t>(channel * 10), static_cast<std::int16_t>(channel * 10 + i)}));
    }
  }
  return bytes;
}

TEST(Survey, ChannelsOfOnePingInTwoFilesMakeOnePing) {
  const test::TemporaryFolder folder;
  folder.write("a.raw", channels_of({1, 2}, 3));
  folder.write("b.raw", channels_of({3, 4, 5, 6}, 3));
  const SurveyFiles survey = opened(folder);
  ASSERT_EQ(survey.observations.size(), 1U);
  const ObservationFiles& o = survey.observations[0];
  ASSERT_EQ(o.pings.size(), 3U);
  EXPECT_EQ(o.files.size(), 2U);
  ASSERT_TRUE(o.grid);
  EXPECT_EQ(o.sample_count, (std::vector<std::int32_t>{2, 2}));
  for (const ChannelTransmit& transmit : o.transmit) EXPECT_TRUE(transmit.seen());
  EXPECT_EQ(count(survey.diagnostics, DiagnosticCode::repeated_ping), 0);
  for (int i = 0; i < 3; ++i) {
    const auto ping = load_ping(survey, o.pings[static_cast<std::size_t>(i)]);
    ASSERT_TRUE(ping);
    ASSERT_EQ(ping->channels.size(), 6U);
    for (int c = 0; c < 6; ++c) {
      const ChannelPing& channel = ping->channels[static_cast<std::size_t>(c)];
      EXPECT_EQ(channel.channel, c);
      EXPECT_EQ(channel.power_count[1], (c + 1) * 10 + i);
    }
  }
  const auto volume = load_volume(survey, o, 2);
  ASSERT_TRUE(volume);
  for (const SampleFlags flags : volume->volume.flags.view().row(0)) EXPECT_EQ(flags, SampleFlags::none);
}

TEST(Survey, RepeatedChannelIsTakenOnceAndNoted) {
  const test::TemporaryFolder folder;
  folder.write("a.raw", channels_of({1, 2, 3}, 2));
  folder.write("b.raw", channels_of({3, 4, 5, 6}, 2));
  const SurveyFiles survey = opened(folder);
  ASSERT_EQ(survey.observations.size(), 1U);
  EXPECT_EQ(survey.observations[0].pings.size(), 2U);
  EXPECT_EQ(count(survey.diagnostics, DiagnosticCode::repeated_ping), 1);
  const auto ping = load_ping(survey, survey.observations[0].pings[0]);
  ASSERT_TRUE(ping);
  EXPECT_EQ(ping->channels.size(), 6U);
}

TEST(Survey, PingsInTwoFilesAreTakenOnce) {
  const test::TemporaryFolder folder;
  Bytes cut = test::small_file(5);
  // The copy ends inside its third ping.
  cut.data.resize(test::small_file(2).size() + test::small_ping(kStart).size() - 100);
  folder.write("a.raw", cut);
  folder.write("b.raw", test::small_file(5));
  const SurveyFiles survey = opened(folder);
  ASSERT_EQ(survey.observations.size(), 1U);
  const auto all = times(survey);
  ASSERT_EQ(all.size(), 5U);
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
  EXPECT_GE(count(survey.diagnostics, DiagnosticCode::repeated_ping), 1);
  // Of the cut ping the whole one is kept.
  for (const SurveyPing& ping : survey.observations[0].pings) EXPECT_EQ(survey.entry(ping).channels, 6);
}

TEST(Survey, ChangedBeamsBeginAnObservation) {
  const test::TemporaryFolder folder;
  folder.write("a.raw", er60(2, kStart));
  folder.write("b.raw", er60(2, kStart + 10 * kSecondNs, 21.0F));
  const SurveyFiles survey = opened(folder);
  ASSERT_EQ(survey.observations.size(), 2U);
  EXPECT_EQ(count(survey.observations[1].diagnostics, DiagnosticCode::grid_changed), 1);
  EXPECT_FALSE(survey.observations[1].continues_cut);
}

TEST(Survey, ChangedSettingsBeginAnObservation) {
  const auto observations = [](const test::Raw0Spec& later) {
    const test::TemporaryFolder folder;
    folder.write("a.raw", test::small_file(2).add(test::small_ping(kStart + 5 * kSecondNs, later)));
    const SurveyFiles survey = opened(folder);
    if (survey.observations.size() == 2) {
      EXPECT_EQ(count(survey.observations[1].diagnostics, DiagnosticCode::settings_changed), 1);
    }
    return survey.observations.size();
  };
  EXPECT_EQ(observations({.interval_s = 0.001F}), 2U);
  EXPECT_EQ(observations({.pulse_s = 0.001F}), 2U);
  // By hand: of 600 samples the last moves by 600 (1500 / 1480 - 1) = 8.1; of 4 it stays where it is.
  EXPECT_EQ(observations({.sound_speed_mps = 1480.0F, .offset = 596}), 2U);
  EXPECT_EQ(observations({.sound_speed_mps = 1480.0F}), 1U);
  EXPECT_EQ(observations({.power_w = 5.0F}), 1U);
  EXPECT_EQ(observations({.sound_speed_mps = 1500.1F}), 1U);
}

TEST(Survey, TimeRunningBackBeginsAnObservation) {
  const test::TemporaryFolder folder;
  Bytes bytes = test::small_file(3);
  bytes.add(test::small_ping(kStart - 5 * kSecondNs)).add(test::small_ping(kStart - 4 * kSecondNs));
  folder.write("a.raw", bytes);
  const SurveyFiles survey = opened(folder);
  ASSERT_EQ(survey.observations.size(), 2U);
  // Numbered in order of time.
  EXPECT_EQ(survey.observations[0].pings.size(), 2U);
  EXPECT_EQ(count(survey.observations[0].diagnostics, DiagnosticCode::time_back), 1);
}

TEST(Survey, UnequalSampleSpacingIsNoGrid) {
  const test::TemporaryFolder folder;
  Bytes bytes = test::con0(test::small_ms70());
  bytes.add(test::raw0(kStart, {.channel = 1}, {1, 2})).add(test::raw0(kStart, {.channel = 2, .pulse_s = 0.004F}, {1}));
  folder.write("a.raw", bytes);
  const SurveyFiles survey = opened(folder);
  ASSERT_EQ(survey.observations.size(), 1U);
  EXPECT_FALSE(survey.observations[0].grid);
  EXPECT_EQ(count(survey.observations[0].diagnostics, DiagnosticCode::no_common_range), 1);
  EXPECT_EQ(count(survey.observations[0].diagnostics, DiagnosticCode::no_grid), 0);
}

TEST(Survey, UnreadableFileStopsNothing) {
  const test::TemporaryFolder folder;
  folder.write("a.raw", test::small_file(2));
  fs::create_directory_symlink(folder.path() / "nowhere", folder.path() / "broken.raw");
  const SurveyFiles survey = opened(folder);
  EXPECT_EQ(survey.observations.size(), 1U);
  EXPECT_EQ(survey.files.size(), 2U);
  EXPECT_EQ(count(survey.diagnostics, DiagnosticCode::unreadable), 1);
}

TEST(Survey, WhatLeadsToNoFileIsSkippedWithANote) {
  const test::TemporaryFolder folder;
  folder.write("a.raw", test::small_file(2));
  fs::create_symlink(folder.path() / "loop.raw", folder.path() / "loop.raw");
  const SurveyFiles survey = opened(folder);
  EXPECT_EQ(survey.observations.size(), 1U);
  EXPECT_EQ(survey.files.size(), 1U);
  ASSERT_EQ(count(survey.diagnostics, DiagnosticCode::unreadable), 1);
  EXPECT_NE(survey.diagnostics.front().text.find("skipped"), std::string::npos);
  // It says nothing of where results may go.
  EXPECT_TRUE(require_outside_raw(survey, folder.path().string() + "-work"));
  const std::vector<fs::path> loop{folder.path() / "loop.raw", fs::path("/") / std::string(300, 'x')};
  EXPECT_TRUE(require_outside_raw(loop, folder.path().string() + "-work"));
  EXPECT_FALSE(require_outside_raw(loop, folder.path() / "work"));
  // Who names it is told, and nothing is begun.
  Work work(1);
  for (const fs::path& named : loop) {
    const auto alone = open_survey({&named, 1}, {}, {}, IndexCache{}, work);
    ASSERT_FALSE(alone);
    EXPECT_EQ(alone.error().where.file, named.string());
  }
}

TEST(Survey, NothingIsWrittenBesideTheFiles) {
  const test::TemporaryFolder folder;
  const test::TemporaryFolder elsewhere;
  folder.write("a.raw", test::small_file(2));
  Work work(1);
  const std::vector<fs::path> paths{folder.path()};
  ASSERT_TRUE(open_survey(paths, {}, {}, IndexCache{elsewhere.path()}, work));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

// One note for an observation, however many fixes are wild, with the file that holds the first.
TEST(Survey, AnObservationNamesTheFileOfItsFirstWildFix) {
  const test::TemporaryFolder folder;
  for (int file = 0; file < 2; ++file) {
    Bytes bytes = test::con0(test::small_ms70());
    for (int i = 8 * file; i < 8 * file + 8; ++i) {
      const TimeNs time = kStart + i * 2 * kSecondNs;
      const double wild = i == 10 || i == 13 ? 0.2 : 0.0;  // minutes of latitude: 370 m
      bytes.add(test::nme0(time, test::with_checksum(fmt::format(
                                     "GPGGA,000000,60{:07.4f},N,00500.0000,E,1,8,1,0,M,0,M,,", 0.005 * i + wild))));
      bytes.add(test::small_ping(time));
    }
    folder.write(file == 0 ? "a.raw" : "b.raw", bytes);
  }
  const SurveyFiles survey = opened(folder);
  ASSERT_EQ(survey.observations.size(), 1U);
  const ObservationFiles& observation = survey.observations[0];
  ASSERT_EQ(count(observation.diagnostics, DiagnosticCode::position_jump), 1);
  for (const Diagnostic& note : observation.diagnostics) {
    if (note.code != DiagnosticCode::position_jump) continue;
    EXPECT_TRUE(note.file.ends_with("/b.raw")) << note.file;
    EXPECT_EQ(note.ping_index, 10);
    EXPECT_EQ(note.text.find("2 fixes"), 0U) << note.text;
  }
  EXPECT_NEAR(observation.navigation[10].transducer.latitude_deg, 60.0 + 0.05 / 60.0, 1e-8);
}

TEST(Survey, NothingIsMadeBeneathRawFiles) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(require_not_beneath_raw(folder.path() / "new" / "survey"));
  folder.write("photograph.raw", Bytes().zeros(400));
  EXPECT_TRUE(require_not_beneath_raw(folder.path() / "new"));
  folder.write("a.RAW", test::small_file(1));
  EXPECT_TRUE(require_not_beneath_raw(folder.path()));  // that folder's own affair
  for (const char* inner : {"new", "new/survey", "new/../other"}) {
    const auto refused = require_not_beneath_raw(folder.path() / inner);
    ASSERT_FALSE(refused) << inner;
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
  }
  fs::create_directory_symlink(folder.path(), folder.path().string() + "-link");
  EXPECT_FALSE(require_not_beneath_raw(folder.path().string() + "-link/new"));
  fs::remove(folder.path().string() + "-link");
}

TEST(Survey, OutsideParametersAreRefused) {
  Work work(1);
  const auto survey = open_survey({}, {.observation_gap_s = -1.0}, {}, IndexCache{}, work);
  ASSERT_FALSE(survey);
  EXPECT_EQ(survey.error().code, ErrorCode::bad_parameter);
}

}  // namespace
}  // namespace sonar
