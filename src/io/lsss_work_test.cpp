// SPDX-License-Identifier: Apache-2.0
#include "io/lsss_work.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/product_example.h"

namespace sonar {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using enum LsssNumbering;

constexpr std::string_view kWork = R"(<?xml version="1.0" encoding="UTF-8"?>
<schools>
  <schoolData ObjectNumber="7" SchoolIdNumber="-1">
    <growParameters><parameters><parameter name="mMinSv">-60</parameter></parameters></growParameters>
    <speciesInterpretationRoot>
      <speciesInterpretationRep frequency="90">
        <species ID="12" fraction="0.25"/><species ID="27" fraction="0.75"/>
      </speciesInterpretationRep>
    </speciesInterpretationRoot>
    <schoolMask>
      <pingMask pingNtDate="128297246410000000" beamCount="1">
        <beam channel="2" beamLength="50" range="1 1"/>
      </pingMask>
      <pingMask pingNtDate="128297246400000000" beamCount="2">
        <beam channel="3" beamLength="60" range="21 4 2 5 0 1"/>
        <beam channel="1" beamLength="60" range=" 60  1 "/>
      </pingMask>
    </schoolMask>
  </schoolData>
  <schoolData/>
</schools>
)";

std::string with(std::string_view what, std::string_view instead) {
  std::string text(kWork);
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), instead);
}

std::string error_of(std::string text, LsssNumbering numbering = from_one) {
  const auto read = parse_lsss_work(std::move(text), "a.work", numbering);
  return read ? "read" : to_line(read.error());
}

// Of channel 3 "21 4 2 5 0 1": samples 21 to 24, two that are left out, 27 to 31, and 32 right behind.
TEST(LsssWork, RangesAreCountsAndGapsFromTheFirstSampleOn) {
  const auto schools = parse_lsss_work(std::string(kWork), "a.work", from_one);
  ASSERT_TRUE(schools) << to_line(schools.error());
  ASSERT_EQ(schools->size(), 2U);
  const LsssSchool& school = schools->at(0);
  EXPECT_EQ(std::pair(school.object_number, school.school_id_number), std::pair(std::int64_t{7}, std::int64_t{-1}));
  ASSERT_EQ(school.pings.size(), 2U);
  EXPECT_EQ(iso_time(school.pings[0].time), "2007-07-24T04:24:00.000Z") << "pings are in the order of time";
  EXPECT_THAT(school.pings[0].runs, ElementsAre(LsssRun{0, 59, 1}, LsssRun{2, 20, 4}, LsssRun{2, 26, 6}));
  EXPECT_THAT(school.pings[1].runs, ElementsAre(LsssRun{1, 0, 1}));
  EXPECT_EQ(main_species(school), "27");
  EXPECT_TRUE(schools->at(1).pings.empty());
  EXPECT_EQ(main_species(schools->at(1)), "");
}

TEST(LsssWork, AChannelMayBeListedTwice) {
  const auto schools = parse_lsss_work(with("<beam channel=\"1\" beamLength=\"60\" range=\" 60  1 \"",
                                            "<beam channel=\"3\" beamLength=\"60\" range=\"25 2 6 3\""),
                                       "a.work", from_one);
  ASSERT_TRUE(schools) << to_line(schools.error());
  EXPECT_THAT(schools->at(0).pings[0].runs, ElementsAre(LsssRun{2, 20, 15})) << "33 to 35 lie behind 32";
}

TEST(LsssWork, NumbersMayCountFromZero) {
  const auto schools = parse_lsss_work(with(" 60  1 ", "59 1"), "a.work", from_zero);
  ASSERT_TRUE(schools) << to_line(schools.error());
  EXPECT_THAT(schools->at(0).pings[0].runs, ElementsAre(LsssRun{1, 59, 1}, LsssRun{3, 21, 4}, LsssRun{3, 27, 6}));
  // Each numbering has numbers that the other does not have.
  EXPECT_THAT(error_of(std::string(kWork), from_zero),
              HasSubstr("school 1: pingMask 2: beam 2: range: sample 60 is beyond beamLength"));
  EXPECT_THAT(error_of(with("channel=\"1\"", "channel=\"0\"")),
              HasSubstr("channel is '0', not a whole number from 1 on"));
  EXPECT_THAT(error_of(with(" 60  1 ", "0 1")), HasSubstr("'0' is no number of a first sample from 1 on"));
}

TEST(LsssWork, WhatIsWrongIsNamedWithItsPlace) {
  const std::string place = "school 1: pingMask 2: beam 1: ";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {with("21 4 2 5 0 1", "21 4 2"), place + "range: '' is no count of samples, in '21 4 2'"},
      {with("21 4 2 5 0 1", ""), place + "range: '' is no number of a first sample"},
      {with("21 4 2 5 0 1", "21 0"), place + "range: '0' is no count of samples"},
      {with("21 4 2 5 0 1", "21 4 -1 5"), place + "range: '-1' is no gap of samples"},
      {with("21 4 2 5 0 1", "21 4.5"), place + "range: '4.5' is no count of samples"},
      {with("21 4 2 5 0 1", "21 41"), place + "range: sample 61 is beyond beamLength"},
      {with("21 4 2 5 0 1", "21 99999999999999999999"), place + "range: '99999999999999999999' is no count"},
      {with("21 4 2 5 0 1", "21 2147483647 2147483647 2147483647"), "is beyond beamLength"},
      {with("channel=\"3\" beamLength", "beamLength"), place + "channel is not there, not a whole number from 1 on"},
      {with("channel=\"3\"", "channel=\"4294967299\""), place + "channel is '4294967299'"},
      {with("beamLength=\"60\"", "beamLength=\"0\""), place + "beamLength is '0', not a whole number from 1 on"},
      {with("beamCount=\"2\"", "beamCount=\"1\""), "school 1: pingMask 2: beamCount is 1, but 2 beams follow"},
      {with("\"1\" beamLength=\"60\" range=\" 60  1 \"", "\"3\" beamLength=\"60\" range=\"32 2\""),
       "school 1: pingMask 2: samples of channel 3 stand there twice"},
      {with("128297246400000000", "1282972464"), "school 1: pingMask 2: pingNtDate is '1282972464', not 100 ns since"},
      {with("128297246400000000", "128297246410000000"), "school 1: pingNtDate 128297246410000000 stands there twice"},
      {with("fraction=\"0.25\"", "fraction=\"nan\""), "school 1: fraction is 'nan', not a number from 0 to 1"},
      {with("frequency=\"90\"", ""), "school 1: frequency is '', not a number of kHz above 0"},
      {with("ObjectNumber=\"7\"", "ObjectNumber=\"&seven;\""), "school 1: ObjectNumber is '&seven;'"},
      {with("</schoolMask>", ""), "no well-formed XML: "},
      {with("<schools>", "<places>"), "no well-formed XML: "},
      {std::string(kWork).replace(200, 1, 1, '\0'), "byte 200: a zero byte"},
      {"<places/>", "a.work: begins with 'places', where schools is expected"},
      {"", "no well-formed XML: "},
      {"<regionInterpretation version=\"1.0\"/>", "interprets an echosounder"},
      {std::string(8'000'001, '='), "8000001 elements and attributes; up to 256 MB and 8000000 are read"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string said = error_of(text);
    EXPECT_THAT(said, HasSubstr("a.work: "));
    EXPECT_THAT(said, HasSubstr(expected));
    EXPECT_THAT(said, Not(HasSubstr("\n")));
  }
}

// Neither a stack nor entities grow with what a file asks for.
TEST(LsssWork, DeepNestingAndEntitiesDoNoHarm) {
  std::string deep = "<schools>";
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  EXPECT_THAT(error_of(deep), HasSubstr("no well-formed XML: "));
  for (int i = 0; i < 100'000; ++i) deep += "</a>";
  EXPECT_EQ(error_of(deep + "</schools>"), "read");
  const std::string laughs = R"(<!DOCTYPE schools [<!ENTITY a "7"><!ENTITY b "&a;&a;&a;&a;">]>)";
  EXPECT_THAT(error_of(laughs + "<schools><schoolData ObjectNumber=\"&b;\"/></schools>"),
              HasSubstr("school 1: ObjectNumber is '&b;'"));
}

/// Two schools: one with runs in three fans, up to the last sample of the one that is shorter, the other in two pings.
ObservationProduct two_schools() {
  ObservationProduct product = example::empty("obs-0001", 4);
  PingMask mask{{{1, 5, 3}, {1, 10, 2}, {6, 0, 4}, {11, 55, 3}}, std::vector<std::uint8_t>(12, 200)};
  example::add_school(product, 2, 1, 1, mask);
  example::add_school(product, 5, 2, 3, example::block(2, 0, 4, 30, 20));
  return product;
}

Result<std::vector<LsssCells>> placed_in(const ObservationProduct& product, std::span<const LsssSchool> schools) {
  std::vector<TimeNs> times;
  for (const PingNavigation& ping : product.pings) times.push_back(ping.time);
  return place_lsss(schools, product.grid->grid, product.grid->sample_count, times, "a.work");
}

TEST(LsssWork, WhatIsWrittenHasTheSameCellsWhenItIsRead) {
  const ObservationProduct product = two_schools();
  const std::vector<int> row_of_channel = product.grid->grid.row_of_channel();
  for (const LsssNumbering numbering : {from_one, from_zero}) {
    const auto schools = parse_lsss_work(lsss_work_text(product, 0, numbering), "a.work", numbering);
    ASSERT_TRUE(schools) << to_line(schools.error());
    const auto cells = placed_in(product, *schools);
    ASSERT_TRUE(cells) << to_line(cells.error());
    ASSERT_EQ(cells->size(), product.masks.size());
    for (std::size_t i = 0; i < product.masks.size(); ++i) {
      const SchoolMask& mask = product.masks[i];
      EXPECT_EQ(schools->at(cells->at(i).school).object_number, mask.school_id);
      EXPECT_EQ(cells->at(i).ping_index, mask.ping_index);
      std::vector<sonar::Run> runs;
      for (const LsssRun& run : cells->at(i).runs) {
        runs.push_back({row_of_channel[static_cast<std::size_t>(run.channel)], run.first_sample, run.count});
      }
      std::ranges::sort(runs);
      EXPECT_EQ(runs, mask.mask.runs);
    }
  }
}

// What we wrote tells how it counts, wherever in the prolog that stands; a file of LSSS does not, nor does a text inside it.
TEST(LsssWork, TheCommentOfAnExportTellsTheNumbering) {
  const auto first_channel = [](std::string text, std::optional<LsssNumbering> numbering) {
    const auto schools = parse_lsss_work(std::move(text), "a.work", numbering);
    return schools ? schools->at(0).pings.at(0).runs.at(0).channel : -1;
  };
  const std::string from_0 = lsss_work_text(two_schools(), 0, from_zero);
  const std::string from_1 = lsss_work_text(two_schools(), 0, from_one);
  EXPECT_EQ(first_channel(from_0, std::nullopt), 0);
  EXPECT_EQ(first_channel(from_1, std::nullopt), 0);
  std::string edited = from_0;
  edited.insert(edited.find("<!--"), "<!-- mine -->\n");
  EXPECT_EQ(first_channel(edited, std::nullopt), 0);
  const auto in_root = [](std::string_view comment) {
    return "<schools>" + std::string(comment) +
           "<schoolData><schoolMask><pingMask pingNtDate=\"128297246410000000\">"
           "<beam channel=\"2\" beamLength=\"9\" range=\"1 1\"/></pingMask></schoolMask></schoolData></schools>";
  };
  EXPECT_EQ(first_channel(in_root(""), std::nullopt), 1);
  EXPECT_EQ(first_channel(in_root("<!-- Channels and samples count from 0. -->"), std::nullopt), 1);
  EXPECT_EQ(first_channel("<!-- Channels and samples count from 7. -->" + in_root(""), std::nullopt), 1);
  EXPECT_EQ(first_channel("<!-- Channels and samples count from 0. -->" + in_root(""), std::nullopt), 2);
  EXPECT_EQ(first_channel("<!-- Channels and samples count from 0. -->" + in_root(""), from_one), 1)
      << "who says so himself knows better";
}

// Rows 1 and 11 of the example are channels 10 and 0; its second ping is at 1 700 000 002.1234567 s.
TEST(LsssWork, ChannelsAndTimesAreThoseOfTheRawFile) {
  const std::string text = lsss_work_text(two_schools(), 0, from_one);
  EXPECT_THAT(text, HasSubstr("<pingMask pingNtDate=\"133444736021234567\" beamCount=\"3\">\n"
                              "        <beam channel=\"1\" beamLength=\"58\" range=\"56 3\"/>\n"));
  EXPECT_THAT(text, HasSubstr("<beam channel=\"11\" beamLength=\"60\" range=\"6 3 2 2\"/>"));
  EXPECT_THAT(lsss_work_text(two_schools(), 0, from_zero),
              HasSubstr("channel=\"10\" beamLength=\"60\" range=\"5 3 2 2\"/>"));
  EXPECT_THAT(lsss_work_text(two_schools(), -3 * kSecondNs, from_one), HasSubstr("pingNtDate=\"133444736051234567\""))
      << "the recipe took 3 s from the datagrams' times";
}

TEST(LsssWork, OnlyWhatLsssCanHoldIsWritten) {
  ObservationProduct product = two_schools();
  product.schools[0].species = "6009";
  product.schools[1].species = "<herring>";
  const std::string text = lsss_work_text(product, 0, from_one);
  const auto schools = parse_lsss_work(text, "a.work", from_one);
  ASSERT_TRUE(schools) << to_line(schools.error());
  EXPECT_EQ(main_species(schools->at(0)), "6009");
  EXPECT_EQ(main_species(schools->at(1)), "");
  EXPECT_THAT(text, Not(HasSubstr("herring")));
  product.schools[0].status = "rejected";
  EXPECT_THAT(lsss_work_text(product, 0, from_one), Not(HasSubstr("ObjectNumber=\"2\"")));
  product.schools[1].status = "rejected";
  EXPECT_EQ(lsss_work_text(product, 0, from_one), "");
  product.grid.reset();
  EXPECT_EQ(lsss_work_text(product, 0, from_one), "");
}

TEST(LsssWork, MasksArePlacedInTheObservationThatHasTheirPings) {
  ObservationProduct product = example::empty("obs-0001", 3);
  for (std::size_t i = 0; i < 3; ++i) product.pings[i].time = static_cast<TimeNs>(i) * kSecondNs;
  const auto place = [&](TimeNs time, LsssRun run) {
    LsssSchool school;
    school.pings = {{time, {run}}};
    return placed_in(product, std::vector<LsssSchool>{school});
  };
  for (const TimeNs off : {-kSecondNs / 1000, TimeNs{0}, kSecondNs / 1000}) {
    const auto cells = place(kSecondNs + off, {0, 50, 8});
    ASSERT_TRUE(cells && cells->size() == 1) << off;
    EXPECT_EQ(cells->at(0).ping_index, 1);
    EXPECT_THAT(cells->at(0).runs, ElementsAre(LsssRun{0, 50, 8}));
  }
  for (const TimeNs time : {kSecondNs - kSecondNs / 500, kSecondNs + kSecondNs / 500, 3 * kSecondNs, -kSecondNs}) {
    const auto cells = place(time, {99, 0, 1});
    ASSERT_TRUE(cells) << "what lies in other pings need not fit";
    EXPECT_TRUE(cells->empty());
  }
  for (const auto& [run, expected] :
       {std::pair{LsssRun{12, 0, 1}, "no fan has channel 12 (from 0)"},
        std::pair{LsssRun{0, 50, 9}, "channel 0 (from 0) has 58 samples, and the mask more"},
        std::pair{LsssRun{11, 70, 1}, "channel 11 (from 0) has 60 samples"}}) {
    const auto refused = place(kSecondNs, run);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::mismatch);
    EXPECT_THAT(to_line(refused.error()), HasSubstr(expected));
    EXPECT_THAT(to_line(refused.error()), HasSubstr("a.work: school 1: ping of 1970-01-01T00:00:01.000Z: "));
  }
}

}  // namespace
}  // namespace sonar
