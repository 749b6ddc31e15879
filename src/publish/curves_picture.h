// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/work.h"
#include "model/avoidance.h"
#include "pipeline/stages/school_curves.h"
#include "publish/picture_options.h"
#include "publish/picture_source.h"
#include "view/charts/panel_chart.h"

namespace sonar {

/// What curves of one school are made of.
struct SchoolCurves {
  std::string name;
  Rgba8 colour;
  SvHistogram inside;
  SvHistogram outside;           ///< of the water round it, as water_round() has it
  std::vector<GrownSize> sizes;  ///< by rising tolerance; empty = it did not grow by one
};

/// Changes of the tolerance that a school is grown again with: 6 dB either way, by half dB.
[[nodiscard]] std::vector<double> tolerance_changes_db();

/// Share of the volume over Sv, in each school and round it; the background is marked.
[[nodiscard]] PanelChartData distribution_chart(std::span<const SchoolCurves> schools, std::string title,
                                                const std::string& pings, const Theme& theme);
/// Volume, backscatter and mean Sv over the tolerance; of one school its plateau too.
[[nodiscard]] PanelChartData tolerance_chart(std::span<const SchoolCurves> schools, std::string title,
                                             const std::string& ping, const Theme& theme);
/// Medians over schools with quartiles, in bins against the ship.
[[nodiscard]] PanelChartData avoidance_chart(std::span<const AvoidanceRow> rows, AgainstShip over, std::string title,
                                             const Theme& theme);

/// errors  not_found: no raw files, no schools, or none with what is asked for; as DrawnObservation::ping()
[[nodiscard]] Result<FrameDescription> curves_frame(const std::vector<DrawnObservation*>& observations,
                                                    const PictureOptions& options, Work& work);

}  // namespace sonar
