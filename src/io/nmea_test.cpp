// SPDX-License-Identifier: Apache-2.0
#include "io/nmea.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/simrad/test_bytes.h"

namespace sonar {
namespace {

NmeaSentence parsed(std::string_view text) {
  const auto sentence = parse_nmea(text);
  EXPECT_TRUE(sentence) << text;
  return sentence.value_or(NmeaSentence{});
}

TEST(Nmea, CutsIntoTalkerTypeAndFields) {
  const NmeaSentence s = parsed("\n$GPGGA,1,,3*00\r\nrest");
  EXPECT_EQ(s.talker, "GP");
  EXPECT_EQ(s.type, "GGA");
  ASSERT_EQ(s.fields.size(), 3U);
  EXPECT_EQ(s.field(1), "1");
  EXPECT_EQ(s.field(2), "");
  EXPECT_EQ(s.field(3), "3");
  EXPECT_EQ(s.field(9), "");
}

// The worked example that receivers' manuals print: the exclusive or of "GPGLL,5300.97914,N,00259.98174,E,125926,A" is
// 28 hexadecimal.
TEST(Nmea, ChecksumIsVerifiedWherePresent) {
  EXPECT_FALSE(parsed("$GPGLL,5300.97914,N,00259.98174,E,125926,A*28").checksum_wrong);
  EXPECT_TRUE(parsed("$GPGLL,5300.97914,N,00259.98174,E,125926,A*29").checksum_wrong);
  EXPECT_TRUE(parsed("$GPGLL,5300.97914,N,00259.98174,E,125926,A*2").checksum_wrong);
  EXPECT_FALSE(parsed("$GPGLL,5300.97914,N,00259.98174,E,125926,A").checksum_wrong);
}

TEST(Nmea, OddIdsAreNoStandardTalkers) {
  EXPECT_EQ(parsed("$PASHR,1").talker, "");
  EXPECT_EQ(parsed("$99DBS,1").talker, "99");
  EXPECT_EQ(parsed("$GPR00,1").talker, "GP");
  EXPECT_FALSE(parse_nmea("no dollar"));
  EXPECT_FALSE(parse_nmea("$"));
  EXPECT_FALSE(parse_nmea("$,,"));
}

TEST(Nmea, PositionsByHand) {
  const auto north_west = nmea_fix(parsed("$GPGGA,190214,4437.5000,N,12402.8860,W,1,8,1,0,M,0,M,,"));
  ASSERT_TRUE(north_west);
  EXPECT_NEAR(north_west->latitude_deg, 44.625, 1e-12);
  EXPECT_NEAR(north_west->longitude_deg, -(124.0 + 2.886 / 60.0), 1e-12);
  const auto south = nmea_fix(parsed("$GPGLL,0030.0,S,18000.0,E,000000,A"));
  ASSERT_TRUE(south);
  EXPECT_NEAR(south->latitude_deg, -0.5, 1e-12);
  EXPECT_NEAR(south->longitude_deg, -180.0, 1e-12);
}

TEST(Nmea, InvalidFixesAreRefused) {
  for (const char* text :
       {"$GPGGA,190214,4437.5,N,12402.8,W,0,8", "$GPGGA,190214,4437.5,N,12402.8,W,,8", "$GPGGA,190214,,N,12402.8,W,1,8",
        "$GPGGA,190214,9100.0,N,12402.8,W,1,8", "$GPGGA,190214,4461.0,N,12402.8,W,1,8",
        "$GPGGA,190214,4437.5,X,12402.8,W,1,8", "$GPGGA,190214,inf,N,12402.8,W,1,8", "$GPGLL,4437.5,N,12402.8,W,0,V",
        "$GPRMC,190214,V,4437.5,N,12402.8,W,1,2,150617", "$GPGGA,190214,-4437.5,N,12402.8,W,1,8"}) {
    EXPECT_FALSE(nmea_fix(parsed(text))) << text;
  }
}

TEST(Nmea, Headings) {
  EXPECT_EQ(nmea_heading(parsed("$INHDT,96.3,T")), 96.3);
  EXPECT_EQ(nmea_heading(parsed("$INHDT,360.0,T")), 0.0);
  EXPECT_EQ(nmea_heading(parsed("$INTHS,12.5,A")), 12.5);
  EXPECT_FALSE(nmea_heading(parsed("$INTHS,12.5,V")));
  EXPECT_FALSE(nmea_heading(parsed("$INHDT,,T")));
  EXPECT_FALSE(nmea_heading(parsed("$INHDT,720,T")));
  // Magnetic 358, deviation 1 W, variation 5 E: 358 - 1 + 5 = 2.
  EXPECT_NEAR(*nmea_heading(parsed("$HCHDG,358,1,W,5,E")), 2.0, 1e-12);
  EXPECT_FALSE(nmea_heading(parsed("$HCHDG,358,17777777777777777777777777,W,5,E"))) << "no compass deviates so far";
  EXPECT_FALSE(nmea_heading(parsed("$HCHDG,358,1,W,181,E")));
  EXPECT_EQ(nmea_heading(parsed("$HCHDG,0,0.00000000000000000001,W,,")), 0.0);
}

TEST(Nmea, Velocities) {
  const auto vtg = nmea_velocity(parsed("$GPVTG,45.0,T,,M,10.0,N,18.52,K"));
  ASSERT_TRUE(vtg);
  EXPECT_NEAR(vtg->speed_mps, 18520.0 / 3600.0, 1e-12);
  EXPECT_EQ(vtg->course_deg, 45.0);
  const auto km = nmea_velocity(parsed("$GPVTG,,T,,M,,N,36.0,K"));
  ASSERT_TRUE(km);
  EXPECT_NEAR(km->speed_mps, 10.0, 1e-12);
  EXPECT_TRUE(std::isnan(km->course_deg));
  EXPECT_FALSE(nmea_velocity(parsed("$GPVTG,45.0,T,,M,,N,,K")));
  EXPECT_FALSE(nmea_velocity(parsed("$GPVTG,45.0,T,,M,999,N,,K")));
}

TEST(Nmea, LogAndTimes) {
  EXPECT_EQ(nmea_log(parsed("$SDVLW,1071.626,N,1071.626,N")), 1071.626);
  EXPECT_FALSE(nmea_log(parsed("$SDVLW,,N,,N")));
  const TimeNs noon = time_from_calendar(2017, 6, 15, 43200.0);
  EXPECT_EQ(nmea_time(parsed("$GPZDA,120000.50,15,06,2017,00,00"), 0), noon + kSecondNs / 2);
  EXPECT_EQ(nmea_time(parsed("$GPRMC,120000,A,4437.5,N,12402.8,W,1,2,150617,,"), 0), noon);
  EXPECT_FALSE(nmea_time(parsed("$GPZDA,120000,31,02,2017"), 0));
  EXPECT_FALSE(nmea_time(parsed("$GPZDA,250000,15,06,2017"), 0));
  // A minute past midnight, seen by a clock that is two minutes behind: the day after the clock's.
  const TimeNs late = time_from_calendar(2017, 6, 15, 86340.0);
  EXPECT_EQ(nmea_time(parsed("$GPGGA,000100,4437.5,N,12402.8,W,1,8"), late), late + 120 * kSecondNs);
}

}  // namespace
}  // namespace sonar
