// SPDX-License-Identifier: Apache-2.0
#include "pipeline/integrate/integrate_params.h"

#include <fmt/format.h>

namespace sonar {

Result<CellLayout> cell_layout(const IntegrateParams& params) {
  if (auto sound = validate(params); !sound) return pass_on(sound);
  CellLayout layout;
  layout.range_bin_m = params.range_bin_m;
  if (params.max_range_m > 0.0) layout.max_range_m = params.max_range_m;
  layout.channel_m = params.depth_channel_m;
  if (params.layer_top_m == 0.0 && params.layer_bottom_m == 0.0) return layout;
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
