// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "geo/sector.h"
#include "model/avoidance.h"
#include "model/echo_statistics.h"
#include "model/filtered_ping.h"
#include "pipeline/stages/school_curves.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "view/charts/panel_chart.h"

namespace sonar {

/// A school's mask in a ping, and what lies beside it.
struct MaskInPing {
  const PingMask& mask;
  std::span<const PingMask* const> masks;  ///< all of the ping, the school's among them
  const StagedPing& ping;
  const Sector& sector;
};

/// What curves of one school are made of.
struct SchoolCurves {
  std::string name;
  Rgba8 colour;
  SvHistogram inside = {};
  SvHistogram outside = {};           ///< of the water round it, as water_round() has it
  std::vector<GrownSize> sizes = {};  ///< by rising tolerance; empty = it did not grow by one
  EchoStatistics stored = {};         ///< of the mask as it is, where it has sizes
  bool from_clicks = false;           ///< grown from the clicks that made it; else from its strongest voxel

  /// Takes what a ping adds to the distribution.
  void add(const MaskInPing& in_ping);
  void add(const SchoolCurves& more);
  /// Grows it again by each of tolerance_changes_db(); voxels of other schools are left to them.
  /// errors  as growth_sensitivity()
  Result<void> grow(const MaskInPing& in_ping, const GrowthStart& start, const FilteredPing& filtered,
                    const std::function<bool()>& go_on);
};

/// Changes of the tolerance that a school is grown again with: 6 dB either way, by half dB.
[[nodiscard]] std::vector<double> tolerance_changes_db();

/// Share of the volume over Sv, in each school and round it; the background is marked.
[[nodiscard]] PanelChartData distribution_chart(std::span<const SchoolCurves> schools, std::string title,
                                                const std::string& pings, const Theme& theme);
/// Volume, backscatter and mean Sv over the tolerance, and those of the mask as it is; of one school its plateau too.
[[nodiscard]] PanelChartData tolerance_chart(std::span<const SchoolCurves> schools, std::string title,
                                             const std::string& ping, const Theme& theme);
/// Medians over schools with quartiles, in bins against the ship.
[[nodiscard]] PanelChartData avoidance_chart(std::span<const AvoidanceRow> rows, AgainstShip over, std::string title,
                                             const Theme& theme);

/// Whether one of them has sizes.
[[nodiscard]] bool any_grew(std::span<const SchoolCurves> schools);
/// Why there is no curve over the tolerance of schools in a ping, none of which has sizes.
[[nodiscard]] std::string why_none_grew(std::span<const SchoolCurves> schools, std::int64_t ping_index);
/// Of schools that have no mask in the ping that curves are asked of.
/// schools  their names, "school 1"
[[nodiscard]] std::string not_in_ping(std::span<const std::string> schools, std::int64_t ping_index);

/// errors  not_found: no raw files, no schools, or none with what is asked for; as DrawnObservation::ping()
[[nodiscard]] Result<FrameDescription> curves_frame(const std::vector<DrawnObservation*>& observations,
                                                    const PictureOptions& options, Work& work);

}  // namespace sonar
