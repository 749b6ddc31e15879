// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "base/result.h"
#include "geo/map_projection.h"
#include "model/current.h"
#include "model/depth_grid.h"
#include "model/map_outlines.h"
#include "model/product.h"
#include "model/transect.h"
#include "view/frame_description.h"
#include "view/maps/map_frame.h"
#include "view/sv_scale.h"
#include "view/theme.h"

namespace sonar {

/// What the colour of a school tells.
enum class SchoolColouring : std::uint8_t { mean_sv, status, species };
inline constexpr std::array<std::string_view, 3> kSchoolColouringNames{"sv", "status", "species"};

/// How a survey map looks.
struct SurveyMapStyle {
  SchoolColouring colouring = SchoolColouring::mean_sv;
  double sv_low_db = -60.0;
  double sv_high_db = -30.0;
  bool rejected = false;     ///< schools that a human rejected
  bool swept = true;         ///< the search volume
  bool names = true;         ///< of observations, at their starts
  double margin = 0.06;      ///< of the survey's size, on every side
  bool legend = true;        ///< beside the map; a small window has no room for it
  MapZoom zoom;              ///< of the map that shows the whole survey
  std::size_t left_out = 0;  ///< schools that there are and that nobody wants to see
  int unsearched = 0;        ///< observations whose schools nobody looked for: that they show none says nothing
  std::vector<Transect> transects = {};  ///< drawn along the track, with their names; empty = none are known
  std::shared_ptr<const CurrentProfiles> currents = nullptr;  ///< arrows of the water's velocity; null = none are known
  friend bool operator==(const SurveyMapStyle&, const SurveyMapStyle&) = default;
};

template <class Visitor>
void describe(Visitor& v, SurveyMapStyle& p) {
  v.choice("colouring", p.colouring, kSchoolColouringNames, "what the colour of a school tells");
  v.field("sv_low_db", p.sv_low_db, {.unit = "dB", .min = -120, .max = 0, .text = "first colour of mean Sv"});
  v.field("sv_high_db", p.sv_high_db, {.unit = "dB", .min = -120, .max = 20, .text = "last colour of mean Sv"});
  v.field("rejected", p.rejected, {.text = "show schools that were rejected, too"});
  v.field("swept", p.swept, {.text = "show the search volume in grey"});
  v.field("names", p.names, {.text = "name observations at their starts"});
  v.field("margin", p.margin, {.unit = "1", .min = 0, .max = 5, .text = "sea around the survey, share of its size"});
}

/// What a map of these observations shows: their tracks and what they swept, with the margin. Empty where no ping has a position.
[[nodiscard]] std::optional<GeoExtent> survey_extent(std::span<const ObservationProduct> observations,
                                                     std::span<const ObservationOutlines> outlines, double margin);

/// What a map of that size really shows: the extent above and the sea that fills the paper. What a depth raster should
/// cover. Empty where no ping has a position.
[[nodiscard]] std::optional<GeoExtent> survey_map_extent(std::span<const ObservationProduct> observations,
                                                         std::span<const ObservationOutlines> outlines,
                                                         const SurveyMapStyle& style, PixelSize size,
                                                         const Theme& theme);

/// Where on the picture survey_map() draws which place, for whoever points at it. Empty where no ping has a position.
[[nodiscard]] std::optional<MapFrame> survey_chart(std::span<const ObservationProduct> observations,
                                                   std::span<const ObservationOutlines> outlines,
                                                   const SurveyMapStyle& style, PixelSize size, const Theme& theme);

/// The survey map (figure 6 of Balabanian et al. 2007, made by the program): observations with the ship's track, green
/// markers at their starts, the search volume in grey, schools as outlines and as circles whose area is their
/// backscatter, over depth contours; graticule, scale bar, legend, title with name and time span. From products alone.
/// observations  in the survey's order; masks are not needed
/// outlines      of the same observations, in any order; those that are missing are drawn without areas
/// depths        nullptr = plain sea, and the legend says so
/// note          one more line for the legend: what is wrong with the raster, ...; may be empty
/// errors        bad_parameter: a picture too small for a map, or a parameter out of range; not_found: no positions
[[nodiscard]] Result<FrameDescription> survey_map(std::span<const ObservationProduct> observations,
                                                  std::span<const ObservationOutlines> outlines,
                                                  const DepthGrid* depths, const SurveyMapStyle& style, PixelSize size,
                                                  const Theme& theme, const std::string& note = {});

}  // namespace sonar
