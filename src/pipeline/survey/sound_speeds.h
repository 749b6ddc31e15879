// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "io/raw_index.h"

namespace sonar {

/// Sound speeds of an observation's pings, channel by channel. All share the range axis of the middle one, and every
/// sample of every ping lies where it says to half a sample.
class SoundSpeeds {
 public:
  /// Takes a ping's settings in where its ranges fit those taken before; else says which channel does not.
  std::string take(const TransmitSet& set);
  /// Half way between the slowest and the fastest of the first channel that was seen.
  [[nodiscard]] double middle_mps() const;
  /// How far that channel's ranges may be off; empty where all are the same.
  [[nodiscard]] std::string drift() const;

 private:
  struct Span {
    double least_mps = std::numeric_limits<double>::infinity();
    double most_mps = 0.0;
    std::int32_t samples = 0;
  };
  [[nodiscard]] Span first() const;
  std::vector<Span> spans_;
};

}  // namespace sonar
