// SPDX-License-Identifier: Apache-2.0
#include "synth/nmea_sentences.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string_view>

#include "base/units.h"
#include "io/raw_datagrams.h"

namespace sonar::synth {
namespace {

/// dddmm.mmmmmm: degrees and minutes to two millimetres.
std::string angle_text(double degrees, int digits) {
  const auto micro_minutes = static_cast<std::int64_t>(std::llround(std::abs(degrees) * 60e6));
  return fmt::format("{:0{}d}{:02d}.{:06d}", micro_minutes / 60'000'000, digits, micro_minutes / 1'000'000 % 60,
                     micro_minutes % 1'000'000);
}

}  // namespace

std::vector<std::string> nmea_second(const PingNavigation& n) {
  const std::string iso = iso_time(n.time);  // 2026-11-21T19:57:26.123Z
  const std::string_view text = iso;
  const std::string clock =
      fmt::format("{}{}{}.{}", text.substr(11, 2), text.substr(14, 2), text.substr(17, 2), text.substr(20, 2));
  const double lat = n.transducer.latitude_deg;
  const double lon = n.transducer.longitude_deg;
  const double knots = n.speed_mps / kKnot_mps;
  return {
      nmea_sentence(fmt::format("GPGGA,{},{},{},{},{},2,10,0.9,2.0,M,45.0,M,,", clock, angle_text(lat, 2),
                                lat < 0 ? 'S' : 'N', angle_text(lon, 3), lon < 0 ? 'W' : 'E')),
      nmea_sentence(fmt::format("GPVTG,{:.2f},T,,M,{:.3f},N,{:.3f},K,D", n.course_deg, knots, knots * 1.852)),
      nmea_sentence(fmt::format("GPHDT,{:.3f},T", n.heading_deg)),
      nmea_sentence(fmt::format("VDVLW,{:.4f},N,{:.4f},N", n.distance_nmi, n.distance_nmi)),
      nmea_sentence(
          fmt::format("GPZDA,{},{},{},{},00,00", clock, text.substr(8, 2), text.substr(5, 2), text.substr(0, 4))),
  };
}

}  // namespace sonar::synth
