// SPDX-License-Identifier: Apache-2.0
#include "base/time.h"

#include <gtest/gtest.h>

namespace sonar {
namespace {

// 100 ns ticks since 1601; 1970-01-01 is 11 644 473 600 s later.
TEST(Time, FromFiletime) {
  EXPECT_EQ(time_from_filetime(116444736000000000ULL), 0);
  EXPECT_EQ(time_from_filetime(116444736000000001ULL), 100);
  // A time stamp of a real file, D20070724: day 13718 since 1970.
  EXPECT_EQ(iso_time(*time_from_filetime(128297246400000000ULL)), "2007-07-24T04:24:00.000Z");
}

TEST(Time, OutsideItsYearsIsNoTime) {
  EXPECT_FALSE(time_from_filetime(0));
  EXPECT_FALSE(time_from_filetime(116444736000000000ULL - 1));
  EXPECT_FALSE(time_from_filetime(~0ULL));
  EXPECT_FALSE(time_from_filetime((11644473600ULL + 7258118400ULL) * 10000000ULL));
  EXPECT_TRUE(time_from_filetime((11644473600ULL + 7258118400ULL) * 10000000ULL - 1));
}

TEST(Time, FiletimeThereAndBack) {
  for (const std::uint64_t ticks : {116444736000000000ULL, 128297246400000000ULL, 139999999999999999ULL}) {
    EXPECT_EQ(filetime_from_time(*time_from_filetime(ticks)), ticks);
  }
}

// Unix seconds of known dates, from `date -u -d ... +%s`.
TEST(Time, KnownDates) {
  EXPECT_EQ(time_from_calendar(1970, 1, 1, 0.0), 0);
  EXPECT_EQ(time_from_calendar(2000, 2, 29, 43200.0), 951825600 * kSecondNs);
  EXPECT_EQ(time_from_calendar(2009, 11, 13, 0.5), 1258070400 * kSecondNs + kSecondNs / 2);
  EXPECT_EQ(iso_time(951825600 * kSecondNs), "2000-02-29T12:00:00.000Z");
  EXPECT_EQ(time_text(951825600 * kSecondNs), "2000-02-29 12:00:00.000 UTC");
  EXPECT_EQ(raw_name_time(951825600 * kSecondNs), "20000229-T120000");
}

TEST(Time, TextIsRoundedDownToTheMillisecond) {
  EXPECT_EQ(iso_time(999'999), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(iso_time(kSecondNs - 1), "1970-01-01T00:00:00.999Z");
  EXPECT_EQ(iso_time(-1), "1969-12-31T23:59:59.999Z");
}

TEST(Time, FromIso) {
  EXPECT_EQ(time_from_iso("2000-02-29T12:00:00Z"), 951825600 * kSecondNs);
  EXPECT_EQ(time_from_iso("2000-02-29T12:00:00.5Z"), 951825600 * kSecondNs + 500'000'000);
  EXPECT_EQ(time_from_iso("1970-01-01T00:00:00.123456789Z"), 123'456'789);
  for (const TimeNs time : {TimeNs{0}, 1258070400 * kSecondNs + 7'000'000, 4102444799 * kSecondNs}) {
    EXPECT_EQ(time_from_iso(iso_time(time)), time);
  }
}

TEST(Time, WhatIsNoTimeIsRefused) {
  for (const char* text :
       {"", "2000-02-29", "2000-02-29T12:00:00", "2000-02-29 12:00:00Z", "2000-13-01T00:00:00Z", "2000-00-01T00:00:00Z",
        "2000-01-32T00:00:00Z", "2000-01-01T24:00:00Z", "2000-01-01T00:60:00Z", "2000-01-01T00:00:00.Z",
        "2000-01-01T00:00:00.1234567890Z", "2000-01-01T00:00:00.12x4Z", "-200-01-01T00:00:00Z", "2000-01-01T-1:00:00Z",
        "2001-02-29T00:00:00Z", "9999-01-01T00:00:00Z", "0001-01-01T00:00:00Z", "2000-04-31T00:00:00Z"}) {
    EXPECT_FALSE(time_from_iso(text)) << text;
  }
}

}  // namespace
}  // namespace sonar
