// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.h"
#include "io/nmea.h"

namespace sonar {

enum class NavQuantity : std::uint8_t { position, heading, velocity, log, clock };
inline constexpr std::array<std::string_view, 5> kNavQuantityNames{"position", "heading", "speed", "log", "clock"};

/// position: latitude, longitude (deg); heading: true (deg), 0; velocity: over ground (m/s), course (deg, NaN =
/// unknown); log: nautical miles, 0; clock: GPS time minus the datagrams' clock (s), 0.
struct NavSample {
  TimeNs time = 0;  ///< the datagram's, not the sentence's
  double first = 0.0;
  double second = 0.0;
  std::uint16_t clock_run = 0;  ///< how often before it the file's pings went back in time
  friend bool operator==(const NavSample&, const NavSample&) = default;
};

/// What one talker said about one quantity in one type of sentence, in file order.
struct NavSeries {
  NavQuantity quantity = NavQuantity::position;
  std::string talker;    ///< "GP"
  std::string sentence;  ///< "GGA"
  std::vector<NavSample> samples;
  friend bool operator==(const NavSeries&, const NavSeries&) = default;
};

/// Files what a sentence says into the series it belongs to; invalid values are left out.
void add_sentence(std::vector<NavSeries>& series, const NmeaSentence& sentence, TimeNs time,
                  std::uint16_t clock_run = 0);

/// Whoever sets a recorder's clock back writes the same times twice: what was said under one clock tells nothing of
/// pings under the other.
class ClockRuns {
 public:
  [[nodiscard]] std::uint16_t run() const { return run_; }
  /// To be called for each ping in file order. One that is earlier than the ping before begins a run, and of what was
  /// said since that ping so does what is earlier than it.
  void begin_ping(TimeNs time, std::vector<NavSeries>& series);

 private:
  std::uint16_t run_ = 0;
  std::optional<TimeNs> last_;
  std::vector<std::size_t> samples_at_last_;  ///< [series]
};

}  // namespace sonar
