// SPDX-License-Identifier: Apache-2.0
#include "publish/picture_options.h"

#include <array>

namespace sonar {

std::span<const PictureKindInfo> picture_kinds() {
  static constexpr std::array<PictureKindInfo, 9> kinds{{
      {"slice-top", "one fan from above, every cell with its own value"},
      {"slice-side", "one vertical fan from the side"},
      {"slice-range", "all beams at one range"},
      {"slice-plane", "a horizontal, vertical or oblique plane in metres"},
      {"volume", "a ping in three dimensions, with what stands round it"},
      {"propagation", "the schools of a ping and of its neighbours"},
      {"observation-map", "an observation from above: ship, path, footprints, schools"},
      {"survey-map", "all observations and schools on a chart"},
      {"timeline", "an echogram of an observation or of the survey, with school tracks"},
  }};
  return kinds;
}

Theme theme_of(const PictureOptions& options) {
  return options.dark ? dark_theme(options.size) : light_theme(options.size);
}

Result<TransferFunction> view_curve(const PictureOptions& options) {
  if (options.transfer) return *options.transfer;
  // Strong enough that a school some tens of metres thick is opaque at its core.
  return transfer_function(options.scale, 0.9);
}

SvColours colours_of(const PictureOptions& options) {
  if (options.transfer) return sv_colours(*options.transfer, options.scale.threshold_db, options.scale.no_data);
  return sv_colours(options.scale);
}

}  // namespace sonar
