// SPDX-License-Identifier: Apache-2.0
#include "pipeline/integrate/integrate_params.h"

#include <fmt/format.h>

#include <cmath>

namespace sonar {

Result<CellLayout> cell_layout(const IntegrateParams& params) {
  if (auto sound = validate(params); !sound) return pass_on(sound);
  CellLayout layout;
  layout.range_bin_m = params.range_bin_m;
  if (params.max_range_m > 0.0) layout.max_range_m = params.max_range_m;
  layout.channel_m = params.depth_channel_m;
  if (params.layer_top_m == 0.0 && params.layer_bottom_m == 0.0) {
    layout.depth_from_m = params.depth_min_m;
    if (params.depth_max_m == 0.0) return layout;
    // what divides evenly in decimals may not in binary
    const double channels = std::floor((params.depth_max_m - params.depth_min_m) / layout.channel_m + 1e-9);
    if (channels < 1.0) {
      return fail(ErrorCode::bad_parameter,
                  fmt::format("depth_max_m = {}: expected at least depth_min_m + depth_channel_m, {}",
                              params.depth_max_m, params.depth_min_m + params.depth_channel_m));
    }
    layout.max_channels = static_cast<int>(channels);
    return layout;
  }
  if (!(params.layer_bottom_m > params.layer_top_m)) {
    return fail(ErrorCode::bad_parameter, fmt::format("layer_bottom_m = {}: expected more than the layer's top, {}",
                                                      params.layer_bottom_m, params.layer_top_m));
  }
  layout.depth_from_m = params.layer_top_m;
  layout.channel_m = params.layer_bottom_m - params.layer_top_m;
  layout.max_channels = 1;
  return layout;
}

}  // namespace sonar
