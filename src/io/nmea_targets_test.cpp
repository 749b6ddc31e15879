// SPDX-License-Identifier: Apache-2.0
#include "io/nmea_targets.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <limits>
#include <string>

#include "io/nmea.h"
#include "io/udp_sender.h"

namespace sonar {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

NmeaTarget target() {
  NmeaTarget t;
  t.number = 103;
  t.name = "school 103";
  t.time = time_from_calendar(2026, 11, 26, 12 * 3600 + 35 * 60 + 19.5);
  t.latitude_deg = -60.5;
  t.longitude_deg = 4.75;
  t.distance_m = 926.0;
  t.bearing_deg = 271.25;
  t.speed_mps = 0.514444444;
  t.course_deg = 90.0;
  return t;
}

// By hand, after the fields of NMEA 0183's tables.
TEST(NmeaTargets, TellPlaceAndMotion) {
  EXPECT_EQ(tll_sentence(target()).substr(0, 65), "$SSTLL,03,6030.0000,S,00445.0000,E,school 103,123519.50,T,*29\r\n");
  EXPECT_EQ(ttm_sentence(target()).substr(0, 62), "$SSTTM,03,0.500,271.3,T,1.0,90.0,T,,,N,school 103,T,,123519.50");
}

TEST(NmeaTargets, AreSoundSentencesWhateverIsNotKnown) {
  NmeaTarget unknown = target();
  unknown.latitude_deg = unknown.longitude_deg = unknown.speed_mps = unknown.course_deg = kNone;
  unknown.name = "a,b*c$";
  unknown.lost = true;
  for (const std::string& text : {tll_sentence(unknown), ttm_sentence(unknown), tll_sentence(target())}) {
    const auto sentence = parse_nmea(text);
    ASSERT_TRUE(sentence) << text;
    EXPECT_FALSE(sentence->checksum_wrong) << text;
    EXPECT_LE(text.size(), 82U) << text;
  }
  EXPECT_EQ(parse_nmea(tll_sentence(unknown))->field(6), "a b c ");
  EXPECT_EQ(parse_nmea(tll_sentence(unknown))->field(8), "L");
}

TEST(NmeaTargets, MinutesNeverReachSixtyNorBearingsAWholeTurn) {
  NmeaTarget t = target();
  t.bearing_deg = 359.96;
  EXPECT_NE(ttm_sentence(t).find(",0.500,0.0,T,"), std::string::npos);
  t.latitude_deg = 59.99999999;
  EXPECT_NE(tll_sentence(t).find(",6000.0000,N,"), std::string::npos);
}

TEST(UdpSender, ReachesAListener) {
  const int listener = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&at), sizeof(at)), 0);
  socklen_t size = sizeof(at);
  ASSERT_EQ(::getsockname(listener, reinterpret_cast<sockaddr*>(&at), &size), 0);
  const auto sender = UdpSender::open("127.0.0.1:" + std::to_string(ntohs(at.sin_port)));
  ASSERT_TRUE(sender);
  sender->send("$SSTLL*00\r\n");
  std::array<char, 100> heard{};
  const auto count = ::recv(listener, heard.data(), heard.size(), 0);
  EXPECT_EQ(std::string(heard.data(), static_cast<std::size_t>(count)), "$SSTLL*00\r\n");
  ::close(listener);
  sender->send("nobody listens");
}

TEST(UdpSender, RefusesWhatIsNoAddress) {
  for (const char* wrong :
       {"", "127.0.0.1", ":10110", "127.0.0.1:", "127.0.0.1:charts", "[::1", "127.0.0.1:0", "127.0.0.1:99999"}) {
    const auto sender = UdpSender::open(wrong);
    ASSERT_FALSE(sender) << wrong;
    EXPECT_EQ(sender.error().code, ErrorCode::usage) << wrong;
  }
}

}  // namespace
}  // namespace sonar
