// SPDX-License-Identifier: Apache-2.0
#include "school/detect/echo_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/units.h"
#include "school/detect/detect_params.h"
#include "school/evidence/seeds.h"

namespace sonar {
namespace {

constexpr double kUnitsOfReference = 1000.0;

std::int16_t in_units(double sv, double unit_sv) {
  return static_cast<std::int16_t>(std::lround(std::clamp(sv / unit_sv, -32000.0, 32000.0)));
}

bool any_never(const SampleFlags* flags, int first, int end) {
  return std::any_of(flags + first, flags + end, [](SampleFlags flag) { return any(flag & kNeverMember); });
}

/// Mean sv of a piece; NaN where less than half of it is sound.
double mean_of(const std::int16_t* counts, const SampleFlags* flags, int first, int end) {
  double sum = 0.0;
  int sound = 0;
  for (int s = first; s < end; ++s) {
    if (counts[s] == kNoData || any(flags[s] & kNotFiltered)) continue;
    sum += linear_from_count(counts[s]);
    ++sound;
  }
  return 2 * sound >= end - first ? sum / sound : NAN;
}

}  // namespace

EchoPieces echo_pieces(const PingEcho& echo, const Thresholder& thresholder, const IndexBox& mask, double reference_db,
                       double threshold_db) {
  constexpr int kSamples = EchoPieces::kSamples;
  IndexBox box = mask.enlarged(SearchReach::fans, SearchReach::beams, SearchReach::samples);
  box.first_sample -= box.first_sample % kSamples;  // the same pieces in every ping
  box.last_sample += kSamples - 1 - box.last_sample % kSamples;
  box = box.clipped(echo.sv.shape());
  const int pieces = (box.samples() + kSamples - 1) / kSamples;
  const Shape3 shape{box.fans(), box.beams(), pieces};
  if (shape.size() > EchoPieces::kMost) return {};
  EchoPieces out{box, linear_from_db(reference_db) / kUnitsOfReference, Array3<std::int16_t>(shape, kNoData),
                 Array3<std::int16_t>(shape)};
  const double threshold_sv = linear_from_db(threshold_db);
  std::vector<double> water_sv(static_cast<std::size_t>(pieces));
  for (int fan = 0; fan < shape.fans; ++fan) {
    for (int beam = 0; beam < shape.beams; ++beam) {
      const int row = (box.first_fan + fan) * echo.sv.shape().beams + box.first_beam + beam;
      thresholder.background(row, box.first_sample + kSamples / 2, kSamples, water_sv);
      const std::int16_t* counts = echo.unfiltered.row(row).data();
      const SampleFlags* flags = echo.flags.row(row).data();
      for (int piece = 0; piece < pieces; ++piece) {
        const int first = box.first_sample + piece * kSamples;
        const int end = std::min(first + kSamples, box.last_sample + 1);
        const double mean = mean_of(counts, flags, first, end);
        const double water = water_sv[static_cast<std::size_t>(piece)];
        out.water(fan, beam, piece) = in_units(water, out.unit_sv);
        if (any_never(flags, first, end)) continue;
        // Other sightings would take a loud seabed's edge for the school.
        const bool loud = water >= threshold_sv;
        const bool told =
            std::isfinite(mean) && (!loud || evidence_of({{{row, first, end - first}}, {}}, echo.water) > 0.0);
        out.own(fan, beam, piece) = told ? in_units(mean - water, out.unit_sv) : EchoPieces::kUnheard;
      }
    }
  }
  return out;
}

}  // namespace sonar
