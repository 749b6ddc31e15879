// SPDX-License-Identifier: Apache-2.0
#include "view/volume/volume_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace sonar {

VolumeData volume_data(const Sector& sector, const Volume& volume, SampleFlags hidden, double transducer_depth_m) {
  VolumeData out{sector, volume.counts, -transducer_depth_m};
  const auto flags = volume.flags.all();
  const auto sv = out.sv.all();
  for (std::size_t i = 0; i < sv.size() && i < flags.size(); ++i) {
    if (any(flags[i] & hidden)) {
      sv[i] = kNoData;
    }
  }
  return out;
}

Result<OpticalTable> optical_table(const TransferFunction& transfer, int entries, double first_db, double last_db) {
  if (entries < 2 || entries > kMostTableEntries) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a transfer table has {} entries; expected 2 to {}", entries, kMostTableEntries));
  }
  if (!(first_db < last_db) || !std::isfinite(first_db) || !std::isfinite(last_db)) {
    return fail(ErrorCode::bad_parameter,
                fmt::format("a transfer table reaches from {} to {} dB; expected rising limits", first_db, last_db));
  }
  OpticalTable out{first_db, last_db, transfer.table(entries, first_db, last_db)};
  for (auto& entry : out.rgb_extinction) {
    const double opacity = std::clamp(static_cast<double>(entry[3]), 0.0, 0.999);
    entry[3] = static_cast<float>(-std::log1p(-opacity) / transfer.opacity_length_m());
  }
  return out;
}

}  // namespace sonar
