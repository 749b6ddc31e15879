// SPDX-License-Identifier: Apache-2.0
#include "io/echoview_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "base/work.h"
#include "io/echoview_reader.h"

namespace sonar {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Two fans of three beams, samples 1 m apart from 0 m on, pings a second apart.
ObservationProduct two_schools() {
  ObservationProduct product;
  product.observation = "obs-0001";
  GridRecord grid;
  grid.grid.elevation_deg = {-10.0, -5.0};
  grid.grid.azimuth_deg = {240.0, 243.0, 246.0};
  grid.range = {0.0, 1.0, 100};
  product.grid = grid;
  product.pings.resize(4);
  for (std::size_t i = 0; i < 4; ++i) product.pings[i].time = static_cast<TimeNs>(i) * kSecondNs;
  product.schools.resize(2);
  product.schools[0].school_id = 3;
  product.schools[0].species = "st\xF8rje\r\nEVRG";
  product.schools[1].school_id = 5;
  // School 3 in fan 0 of ping 1 and in fan 1 of ping 2; school 5 in fan 0 of pings 1 and 3, and not in 2.
  product.masks = {{3, 1, {{{0, 10, 5}, {2, 12, 8}}, {}}},
                   {3, 2, {{{4, 10, 5}}, {}}},
                   {5, 1, {{{1, 50, 1}}, {}}},
                   {5, 3, {{{1, 60, 2}}, {}}}};
  return product;
}

// Samples 10 to 19 of ping 1 reach from 9.5 to 19.5 m, from half a second before it to half a second after.
TEST(EchoviewText, ARegionReachesFromTheNearestSampleToTheFarthest) {
  const std::string text = evr_text(two_schools(), 0);
  EXPECT_THAT(text, HasSubstr("\r\n3\r\n")) << "one of school 3, and two of school 5, which a ping is without";
  EXPECT_THAT(text, HasSubstr("13 6 1 0 2 -1 1 19700101 0000005000 9.5000 19700101 0000015000 19.5000\r\n"));
  EXPECT_THAT(text, HasSubstr("19700101 0000010000 9.5000 19700101 0000015000 9.5000 19700101 0000015000 19.5000 "));
  EXPECT_THAT(text, HasSubstr("\r\nobs-0001/3\r\n"));
  EXPECT_THAT(evr_text(two_schools(), 1), Not(HasSubstr("obs-0001/5")));
}

TEST(EchoviewText, ANameIsOneLineOfUtf8) {
  EXPECT_THAT(evr_text(two_schools(), 1), HasSubstr("\r\nst\uFFFDrje\uFFFD EVRG\r\n"));
}

TEST(EchoviewText, RejectedSchoolsAreLeftOut) {
  ObservationProduct product = two_schools();
  for (SchoolRow& school : product.schools) school.status = "rejected";
  EXPECT_EQ(evr_text(product, 0), "");
}

constexpr const char* kTwoRegions =
    "\xEF\xBB\xBF"
    "EVRG 7 13.0.378\r\n"
    "2\r\n"
    "\r\n"
    "13 4 1 0 6 -1 1 20261121 1957265000 10.5 20261121 1957285000 20.25\r\n"
    "2\r\n"
    "near the wreck\r\n"
    "fan 3\r\n"
    "1\r\n"
    "threshold -60\r\n"
    "herring\r\n"
    "20261121 1957265000 10.5 20261121 1957285000 10.5 20261121 1957285000 20.25 20261121 1957265000 20.25 1\r\n"
    "Region 1\r\n"
    "\r\n"
    "13 1 2 0 6 -1 0\r\n"
    "0\r\n"
    "0\r\n"
    "Unclassified regions\r\n"
    "20261121 1957260001 -9999.99 2\r\n"
    "\r\n";

std::string without_returns(std::string text) {
  std::erase(text, '\r');
  return text;
}

TEST(EchoviewReader, FiguresOfARegionAreWhatTheFileSays) {
  const TimeNs begin = *time_from_iso("2026-11-21T19:57:26.5Z");
  for (const std::string& text : {std::string(kTwoRegions), without_returns(kTwoRegions)}) {
    const auto regions = parse_evr(text, "a.evr");
    ASSERT_TRUE(regions.has_value()) << regions.error().text;
    ASSERT_EQ(regions->size(), 2U);
    const EchoviewRegion& school = regions->front();
    EXPECT_EQ(school.line, 4);
    EXPECT_EQ(school.type, EchoviewType::analysis);
    EXPECT_EQ(school.name, "Region 1");
    EXPECT_EQ(school.region_class, "herring");
    EXPECT_THAT(school.notes, testing::ElementsAre("near the wreck", "fan 3"));
    ASSERT_EQ(school.corners.size(), 4U);
    EXPECT_EQ(school.corners[2].time, begin + 2 * kSecondNs);
    EXPECT_EQ(school.corners[2].depth_m, 20.25);
    const EchoviewRegion& mark = regions->back();
    EXPECT_EQ(mark.type, EchoviewType::marker);
    EXPECT_EQ(mark.name, "");
    EXPECT_EQ(mark.corners.front().time, begin - kSecondNs / 2 + 100'000);
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(EchoviewReader, DamageIsToldWithItsLine) {
  const std::vector<std::pair<std::string, std::string>> damaged{
      {"", "line 1: the file ends; expected EVRG 7"},
      {"hello\n", "line 1: expected EVRG 7"},
      {replaced(kTwoRegions, "EVRG 7", "EVRG 8"), "line 1: EVRG 8; expected version 7"},
      {replaced(kTwoRegions, "\r\n2\r\n", "\r\ntwo\r\n"), "line 2: expected the number of regions"},
      {replaced(kTwoRegions, "\r\n2\r\n", "\r\n9000000000000000000\r\n"), "the file ends; expected a region"},
      {replaced(kTwoRegions, "\r\n2\r\n", "\r\n1\r\n"), "line 14: expected the end after 1 region"},
      {replaced(kTwoRegions, "13 4 1", "12 4 1"), "line 4: expected 13"},
      {replaced(kTwoRegions, "13 4 1", "13 9000000000000000000 1"), "line 11: expected 9000000000000000000 points"},
      {replaced(kTwoRegions, "13 4 1", "13 0 1"), "line 4: expected the number of points"},
      {replaced(kTwoRegions, "-1 1 2026", "-1 0 2026"), "line 4: expected 1 and a bounding box"},
      {replaced(kTwoRegions, "20261121 1957265000 10.5 20261121 1957285000 20.25\r\n2",
                "20261321 1957265000 10.5 20261121 1957285000 20.25\r\n2"),
       "line 4: expected a bounding box"},
      {replaced(kTwoRegions, "\r\n2\r\nnear", "\r\n800000000\r\nnear"), "the file ends; expected"},
      {replaced(kTwoRegions, "1957285000 10.5 20261121", "2557285000 10.5 20261121"), "line 11: point 2: expected"},
      {replaced(kTwoRegions, "1957285000 10.5 20261121", "1957285000 nan 20261121"), "line 11: point 2: expected"},
      {replaced(kTwoRegions, "20.25 1\r\n", "20.25 5\r\n"), "line 11: expected a type of region from 0 to 4"},
      {replaced(kTwoRegions, "20.25 1\r\n", "20.25\r\n"), "line 11: expected 4 points"},
  };
  for (const auto& [text, told] : damaged) {
    const auto regions = parse_evr(text, "a.evr");
    ASSERT_FALSE(regions.has_value()) << told;
    EXPECT_THAT(to_line(regions.error()), testing::StartsWith("a.evr: "));
    EXPECT_THAT(regions.error().text, HasSubstr(told));
  }
}

TEST(EchoviewReader, ALineIsReadAndItsDamageTold) {
  const std::string whole =
      "EVBD 3 13.0\n3\n20261121 1957265000 51.25 3\n20261121 1957265000 9999.99 0\n20261121 1957275000 5 2\n";
  const auto line = parse_evl(whole, "a.evl");
  ASSERT_TRUE(line.has_value()) << line.error().text;
  ASSERT_EQ(line->size(), 3U);
  EXPECT_EQ((*line)[0].time, *time_from_iso("2026-11-21T19:57:26.5Z"));
  EXPECT_EQ((*line)[0].depth_m, 51.25);
  EXPECT_TRUE((*line)[0].known());
  EXPECT_FALSE((*line)[1].known()) << "without bound";
  EXPECT_FALSE((*line)[2].known()) << "bad";
  const std::vector<std::pair<std::string, std::string>> damaged{
      {replaced(whole, "EVBD", "EVRG"), "line 1: expected EVBD 3"},
      {replaced(whole, "\n3\n", "\n4\n"), "line 6: the file ends; expected point 4 of 4"},
      {replaced(whole, "\n3\n", "\n2\n"), "line 5: expected the end after 2 points"},
      {replaced(whole, "51.25 3", "51.25 4"), "line 3: expected CCYYMMDD"},
      {replaced(whole, "51.25 3", "51.25"), "line 3: expected CCYYMMDD"},
      {replaced(whole, "1957275000", "1957255000"), "line 5: expected a time that is not before"},
  };
  for (const auto& [text, told] : damaged) {
    const auto refused = parse_evl(text, "a.evl");
    ASSERT_FALSE(refused.has_value()) << told;
    EXPECT_THAT(refused.error().text, HasSubstr(told));
  }
}

// A file of single letters, or of nothing but ends of lines, takes many times its own bytes once it is taken apart: each is refused
// where it goes beyond what any file has.
TEST(EchoviewReader, LinesBeyondAnyFilesAreRefused) {
  std::string letters;
  for (int i = 0; i < 5'000'000; ++i) letters += "a ";
  const std::string line_of_letters = ": 10000000 bytes; expected ";
  const auto in_region = [&](const std::string& before) { return replaced(kTwoRegions, before, letters + before); };
  const std::string empty_lines = "5000000\n" + std::string(5'000'000, '\n');
  const std::vector<std::pair<std::string, std::string>> regions{
      {letters, "line 1" + line_of_letters + "EVRG 7"},
      {in_region("near the wreck"), "line 6: 10000015 bytes; expected 1 of lines of notes, in at most 8388608"},
      {in_region("20261121 1957265000 10.5 20261121 1957285000 10.5"), "line 11: 10000104 bytes; expected the points"},
      {replaced(kTwoRegions, "1\r\nthreshold -60\r\n", empty_lines),
       "line 4000001: expected the end, after at most 4000000 lines"},
      {kTwoRegions + std::string(5'000'000, '\n'), "line 4000001: expected the end after 2 regions"},
  };
  for (const auto& [text, told] : regions) {
    const auto read = parse_evr(text, "a.evr");
    ASSERT_FALSE(read.has_value()) << told;
    EXPECT_THAT(to_line(read.error()), HasSubstr("a.evr: " + told));
  }
  const auto line = parse_evl("EVBD 3 13.0\n1\n" + letters, "a.evl");
  ASSERT_FALSE(line.has_value());
  EXPECT_THAT(to_line(line.error()), HasSubstr("a.evl: line 3" + line_of_letters + "point 1 of 1, in at most 8388608"));
}

// The last region's name is an empty line: a file that is cut before it, at whatever byte, is refused.
TEST(EchoviewReader, ACutFileIsRefused) {
  const std::string regions = kTwoRegions;
  for (std::size_t size = 0; size + 2 <= regions.size(); ++size) {
    EXPECT_FALSE(parse_evr(regions.substr(0, size), "a.evr").has_value()) << size;
  }
  const std::string line = "EVBD 3 13.0\r\n2\r\n20261121 1957265000 51.25 3\r\n20261121 1957275000 5 2";
  for (std::size_t size = 0; size < line.size(); ++size) {
    EXPECT_FALSE(parse_evl(line.substr(0, size), "a.evl").has_value()) << size;
  }
  EXPECT_TRUE(parse_evr(regions, "").has_value() && parse_evl(line, "").has_value());
}

// A hexagon without its right notch: at 0 and 1 s one stretch, at 2 s two, at 3 s (its end) where it closes.
TEST(EchoviewReader, AConcavePolygonHasTwoStretchesAtATime) {
  const std::vector<EchoviewCorner> corners{{0, 10.0},         {3 * kSecondNs, 10.0}, {3 * kSecondNs, 14.0},
                                            {kSecondNs, 15.0}, {3 * kSecondNs, 16.0}, {3 * kSecondNs, 20.0},
                                            {0, 20.0}};
  const auto told = [&](TimeNs time) {
    std::vector<std::pair<double, double>> out;
    for (const DepthSpan& span : depths_at(corners, time)) out.emplace_back(span.first_m, span.last_m);
    return out;
  };
  using testing::ElementsAre;
  using testing::Pair;
  EXPECT_THAT(told(-1), testing::IsEmpty());
  EXPECT_THAT(told(0), ElementsAre(Pair(10.0, 20.0)));
  EXPECT_THAT(told(kSecondNs / 2), ElementsAre(Pair(10.0, 20.0)));
  EXPECT_THAT(told(2 * kSecondNs), ElementsAre(Pair(10.0, 14.5), Pair(15.5, 20.0)));
  EXPECT_THAT(told(3 * kSecondNs), ElementsAre(Pair(10.0, 14.0), Pair(16.0, 20.0)));
  EXPECT_THAT(told(3 * kSecondNs + 1), testing::IsEmpty());
  const std::vector<EchoviewCorner> upright{{5, 3.0}, {5, 8.0}};
  ASSERT_EQ(depths_at(upright, 5).size(), 1U);
  EXPECT_EQ(depths_at(upright, 5).front().last_m, 8.0);
}

TEST(EchoviewReader, NotesOfAnExportTellEveryCell) {
  const auto regions = parse_evr(evr_text(two_schools(), 0), "obs-0001-fan-00.evr");
  ASSERT_TRUE(regions.has_value()) << regions.error().text;
  const auto cells = cells_of(regions->front(), "");
  ASSERT_TRUE(cells.has_value());
  EXPECT_EQ(cells->fan, 0);
  ASSERT_TRUE(cells->beams.has_value());
  EXPECT_EQ(std::pair(cells->beams->first, cells->beams->last), std::pair(0, 2));
  ASSERT_EQ(cells->pings.size(), 1U);
  EXPECT_EQ(cells->pings[0].time, kSecondNs);
  ASSERT_EQ(cells->pings[0].runs.size(), 2U);
  EXPECT_EQ(cells->pings[0].runs[1].beam, 2);
  EXPECT_EQ(cells->pings[0].runs[1].first_sample, 12);
  EXPECT_EQ(cells->pings[0].runs[1].end(), 20);
  EXPECT_EQ(cells->words, "");
}

TEST(EchoviewReader, IsStopped) {
  Work work(1);
  work.cancel();
  const auto regions = parse_evr(kTwoRegions, "a.evr", &work);
  ASSERT_FALSE(regions.has_value());
  EXPECT_EQ(regions.error().code, ErrorCode::cancelled);
  EchoviewRegion region;
  region.notes = {"cells 19700101 0000010000 2 5 1"};
  const auto cells = cells_of(region, "a.evr", &work);
  ASSERT_FALSE(cells.has_value());
  EXPECT_EQ(cells.error().code, ErrorCode::cancelled);
}

TEST(EchoviewReader, NotesOfAHumanAreWordsAndWrongOnesAreTold) {
  EchoviewRegion region;
  region.first_note_line = 6;
  region.notes = {"fans of herring", "cells look empty", "fan 3"};
  const auto cells = cells_of(region, "a.evr");
  ASSERT_TRUE(cells.has_value());
  EXPECT_EQ(cells->words, "fans of herring; cells look empty");
  EXPECT_EQ(cells->fan, 3);
  for (const char* note :
       {"fan 3 4", "beams 5 3", "beams 5", "cells 20261121 1957265000 1 2", "cells 20261121 1957265000 1 2 0",
        "cells 20261121 1957265000 1 2147483647 2", "fan 99999999999"}) {
    region.notes = {"", note};
    const auto wrong = cells_of(region, "a.evr");
    ASSERT_FALSE(wrong.has_value()) << note;
    EXPECT_THAT(to_line(wrong.error()), HasSubstr("a.evr: line 7: expected"));
  }
}

}  // namespace
}  // namespace sonar
