// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "model/outline.h"
#include "model/product.h"
#include "view/frame_description.h"
#include "view/key_rows.h"
#include "view/maps/map_frame.h"
#include "view/maps/mask_mosaic.h"
#include "view/maps/scale_bars.h"
#include "view/refused_marks.h"
#include "view/theme.h"
#include "view/volume/mask_colours.h"

namespace sonar {

/// What of an observation's map stays while pings come and go: made once, drawn often.
struct ObservationMapBase {
  MapFrame map;
  PixelSize size;
  Theme theme;
  std::vector<PixelPoint> hull;                     ///< convex hull of the footprints of all pings
  PathItem track;                                   ///< the ship's path
  std::vector<std::vector<PixelPoint>> footprints;  ///< [ping]; empty without position, heading or grid
  std::string title;
  std::vector<KeyEntry> key{};  ///< below the map; may be empty
  PixelRect key_place{};
  bool searched = true;               ///< schools were looked for; else the title says that they were not
  std::size_t left_out = 0;           ///< schools that there are and that the map does not show
  std::optional<PixelPoint> start{};  ///< of the observation
  std::optional<ScaleBars> scale{};   ///< in a corner that the ship keeps off where there is one
  PlacementOf placed = &PingNavigation::placement;
};

/// key     with room for a key of lines and colours below the map; refused = of refused echoes too
/// pings   of the observation; product may lack schools and masks
/// placed  how they lie: footprints turn as footprint() has it, masks turn and bend as mask_rings() has them
/// errors  not_found: no ping has a position; bad_parameter: a picture too small for a map
[[nodiscard]] Result<ObservationMapBase> observation_map_base(const ObservationProduct& product, PixelSize size,
                                                              const Theme& theme, const MapZoom& zoom = {},
                                                              bool key = false, bool refused = false,
                                                              const PlacementOf& placed = &PingNavigation::placement);

/// Without a mask: for whoever sets pings one by one.
[[nodiscard]] MaskMosaic empty_mosaic(const ObservationMapBase& base, std::size_t pings);

/// All masks of a product in a mosaic that lies in the map; a school's number tells its colour, as everywhere.
[[nodiscard]] MaskMosaic mask_mosaic(const ObservationMapBase& base, const ObservationProduct& product);

/// The observation from above (Balabanian et al. 2007, figure 5, green): ship and path, convex hull of all pings'
/// footprints, the current ping's footprint, and the maximum projection of the masks of all segmented pings.
/// mosaic   made for this base; its raster is drawn as it is
/// current  ping to mark; empty = none
/// schools  how many the title tells of; empty = those of the product
[[nodiscard]] FrameDescription observation_map(const ObservationMapBase& base, const ObservationProduct& product,
                                               const MaskMosaic& mosaic, std::optional<std::size_t> current,
                                               const MaskPalette& palette,
                                               std::optional<std::size_t> schools = std::nullopt);

/// A school as a map shows it beside its masks.
struct MapSchool {
  std::int64_t number = 0;
  std::string status;  ///< solid, dashed or dotted, as everywhere
  bool selected = false;
  std::vector<Geographic> places;  ///< in time order
  std::string name{};              ///< that a human gave it, beside its number
};
/// The schools of a product with their places.
/// selected  school_id that is highlighted; 0 = none
/// rejected  those that were rejected, too
[[nodiscard]] std::vector<MapSchool> map_schools(const ObservationProduct& product, std::int64_t selected = 0,
                                                 bool rejected = true);
/// Paths of schools in their colours, rejected ones grey, with their numbers beside them, or with a line to them; numbers
/// that find no room are named in a corner. Over an observation map.
/// ship  where it is drawn: numbers keep off it; empty = nowhere
void add_map_schools(FrameDescription& frame, const ObservationMapBase& base, std::span<const MapSchool> schools,
                     std::optional<PixelPoint> ship = std::nullopt);

/// Marks refused echoes, each where it was loudest. Over an observation map.
/// rows    of the observation; those without a place are left out
/// chosen  echo_id that is highlighted; 0 = none
/// out     where they are
std::vector<PlacedMark> add_map_refused(FrameDescription& frame, const ObservationMapBase& base,
                                        std::span<const RefusedEcho> rows, std::int64_t chosen = 0);

}  // namespace sonar
