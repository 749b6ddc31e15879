// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/describe.h"
#include "base/result.h"
#include "model/product.h"
#include "view/frame_description.h"
#include "view/maps/mask_mosaic.h"
#include "view/theme.h"
#include "view/volume/mask_colours.h"

namespace sonar {

/// From where masks are seen.
enum class MaskAspect : std::uint8_t {
  above,  ///< bow up, starboard right
  side,   ///< across the beams' direction: away from the ship to the right, up is up
};
inline constexpr std::array<std::string_view, 2> kMaskAspectNames{"above", "side"};

struct PropagationStyle {
  int before = 2;
  int after = 2;
  MaskAspect aspect = MaskAspect::above;
  bool whole_sector = false;  ///< else only where masks are
  bool one_row = false;       ///< side by side, however narrow
  bool dates = false;         ///< each ping's day and "UTC", too: where nothing round the view tells them
  MaskPalette palette{.colouring = MaskColouring::core_fuzzy, .core_at = 0.64};
  int focus = -1;  ///< school of MosaicMask that the view is fitted to, where it is seen; -1 = all
  friend bool operator==(const PropagationStyle&, const PropagationStyle&) = default;
};

template <class Visitor>
void describe(Visitor& v, PropagationStyle& p) {
  v.field("before", p.before, {.min = 0, .max = 100, .text = "pings before the current one"});
  v.field("after", p.after, {.min = 0, .max = 100, .text = "pings after the current one"});
  v.choice("aspect", p.aspect, kMaskAspectNames, "from where masks are seen");
  v.field("whole_sector", p.whole_sector, {.text = "show the whole sector, not only where masks are"});
  v.field("one_row", p.one_row, {.text = "all pings in one row"});
  v.field("dates", p.dates, {.text = "the day of each ping beside its time"});
  v.group("palette", p.palette, "colours of masks");
}

/// One ping of the view.
struct PropagationPanel {
  std::int64_t ping_index = 0;
  bool bad = false;       ///< the ping was not used
  bool absent = false;    ///< there is no such ping: before the first or after the last
  bool searched = true;   ///< schools were looked for; else that there is none says nothing
  bool left_out = false;  ///< schools that there are and that nobody wants to see: "no school" would be wrong
  bool current = false;
  TimeNs time = 0;
  double transducer_depth_m = std::numeric_limits<double>::quiet_NaN();  ///< NaN = no scale of depths from the side
  std::vector<MosaicMask> masks;                                         ///< point into what the panel was made from
  std::vector<std::int64_t> school_ids;  ///< of `masks`, written beside them; may be empty
  std::string note;                      ///< along the lower edge: why a propagation ended here; may be empty
};
/// The current ping of a product and its neighbours. At an observation's ends the places of pings that there are not stay
/// empty and say so, so that the current one keeps its place; not where all pings are shown anyway.
/// searched  schools were looked for
[[nodiscard]] std::vector<PropagationPanel> propagation_panels(const ObservationProduct& product, std::int64_t current,
                                                               const PropagationStyle& style, bool searched = true);

/// Where propagation_view() draws each panel. errors: as there
[[nodiscard]] Result<std::vector<PixelRect>> propagation_places(const Sector& sector,
                                                                std::span<const PropagationPanel> panels,
                                                                const PropagationStyle& style, PixelSize size,
                                                                const Theme& theme);

/// The current ping and its neighbours side by side, each a projection of its masks, all at one scale about one place in
/// the sonar's frame; each labelled with ping and time, from the side with depths below the sea surface; pings without
/// a school, and bad ones say so.
/// title   first line of the picture
/// errors  bad_parameter: a parameter out of range, no panels, or a picture too small for them
[[nodiscard]] Result<FrameDescription> propagation_view(const Sector& sector, std::span<const PropagationPanel> panels,
                                                        const PropagationStyle& style, PixelSize size,
                                                        const Theme& theme, const std::string& title = {});

}  // namespace sonar
