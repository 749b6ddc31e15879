// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/array.h"
#include "school/detect/thresholder.h"
#include "school/judge/ping_echo.h"
#include "school/runs.h"

namespace sonar {

/// The echo in and round a detection, by short pieces of each beam, for when other pings are known too.
struct EchoPieces {
  static constexpr int kSamples = 4;  ///< of a piece
  /// Larger schools have so many voxels that fading moves their border little; theirs is not kept.
  static constexpr std::size_t kMost = 40000;

  /// A piece that may be a school's, of which nothing is heard in this ping: faults overwrite it, or the water is as loud
  /// as the school and it does not stand out.
  static constexpr std::int16_t kUnheard = -32767;

  IndexBox box;              ///< its samples are those of whole pieces, but where the record ends
  double unit_sv = 0.0;      ///< m^-1
  Array3<std::int16_t> own;  ///< [fan][beam][piece] mean sv less the background, units; kUnheard; kNoData = no school's
  Array3<std::int16_t> water;  ///< same shape: the background, units

  [[nodiscard]] bool empty() const { return box.empty(); }
  /// Piece of a sample of the box.
  [[nodiscard]] int piece(int sample) const { return (sample - box.first_sample) / kSamples; }
};

/// mask                        of the detection
/// reference_db, threshold_db  of the detection
/// thresholder                 knows the background
/// out                         empty where it would hold more than kMost pieces
[[nodiscard]] EchoPieces echo_pieces(const PingEcho& echo, const Thresholder& thresholder, const IndexBox& mask,
                                     double reference_db, double threshold_db);

}  // namespace sonar
