// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/array.h"
#include "base/result.h"
#include "base/sample_flags.h"
#include "base/time.h"
#include "view/axes.h"
#include "view/frame_description.h"
#include "view/refused_marks.h"
#include "view/slices/slice.h"
#include "view/sv_scale.h"
#include "view/theme.h"
#include "view/volume/volume_scene.h"

namespace sonar {

/// What is drawn of flagged samples. A flag in several sets: hidden, else faded and hatched.
struct FlagStyle {
  SampleFlags hidden = SampleFlags::none;   ///< drawn as no data
  SampleFlags hatched = SampleFlags::none;  ///< colour kept, stripes over it
  SampleFlags faded = SampleFlags::none;    ///< mixed with the water's colour; low_snr marks what is mostly noise
  friend bool operator==(const FlagStyle&, const FlagStyle&) = default;
};

/// How selected areas lie over the data.
struct SliceMaskStyle {
  bool shown = true;           ///< off: nothing of them is drawn, and their room in the key is left free
  double core_at = 0.64;       ///< confidence from which a voxel is core; below it is fuzzy
  bool tint = false;           ///< over the data, whose colours it changes; else a dotted line round the core
  double core_strength = 0.5;  ///< of the tint, 0 = data alone .. 1 = colour alone
  double fuzzy_strength = 0.25;
  bool outline = true;  ///< in full colour, along the cells' edges, with a contrasting rim outside
  friend bool operator==(const SliceMaskStyle&, const SliceMaskStyle&) = default;
};

/// One ping's data on the sector of a SliceMap; views borrow.
struct SliceData {
  View3<const std::int16_t> sv;    ///< [fan][beam][sample], Sv counts
  View3<const SampleFlags> flags;  ///< same shape, or empty
  std::vector<MaskLayer> masks;    ///< later ones lie above earlier ones
  std::vector<RefusedMark> refused = {};
  std::vector<int> shadow_from = {};  ///< [row] sample from which schools' shadow is hatched; empty = not drawn
};

/// Colours a ping through a map: gather and look-up only.
/// errors  mismatch: the data's shape is not the map's sector's
/// cost    a few ms for 800 x 600
[[nodiscard]] Result<Image> slice_image(const SliceMap& map, const SliceData& data, const SvColours& colours,
                                        const FlagStyle& flags, const SliceMaskStyle& masks, const Theme& theme);

/// Why a sample is flagged, for a status line: "interference, low signal"; empty for none.
[[nodiscard]] std::string flag_text(SampleFlags flags);

/// The ping that a slice's title names.
struct SlicePing {
  std::string observation;  ///< may carry SYNTHETIC
  std::int64_t ping_index = -1;
  TimeNs time = 0;
  double heading_rad = std::numeric_limits<double>::quiet_NaN();  ///< NaN = unknown: no north arrow
  double transducer_depth_m = 0.0;
  std::vector<double> frequency_hz;          ///< [fan], for the title; may be empty
  std::shared_ptr<const Refraction> rays{};  ///< drawn in the side slice with its rings; null = no profile is known
  bool moved = false;                        ///< places in tables are turned or bent, and these are not: depths say so
};
/// What pictures say then of the depths that they draw.
inline constexpr std::string_view kStraightAndLevel = "straight and level beams";

/// What a slice's key tells beside the looks of flagged samples.
struct SliceKey {
  struct School {
    Rgba8 colour;
    OutlineLine line = OutlineLine::solid;
    std::string name;
    std::optional<std::size_t> mask{};  ///< in SliceData::masks: named where the slice cuts it; empty = always
  };
  bool filtered = false;                  ///< noise removal took samples out, which are drawn as no data
  std::optional<double> weak_below_db{};  ///< of the samples that carry low_snr
  std::vector<School> schools{};
};

struct SliceStyle {
  SvColours colours = sv_colours(SvScale{});
  FlagStyle flags;
  SliceMaskStyle masks;
  bool grid = false;
  bool rings = true;              ///< range rings and bearings, sector outline
  bool decorations = true;        ///< title, axes, colour bar; false = the slice alone, edge to edge
  bool north_up = false;          ///< the view's `up_rad` was made so: axes read east and north
  std::optional<SliceKey> key{};  ///< below the slice: what is not drawn as recorded, and whose the outlines are
};

/// A slice laid into a place of a picture: its axes in its own coordinates, grown to fill the place with square metres or
/// degrees, and which voxel each of its pixels shows.
struct MappedSlice {
  PlotFrame plot;
  std::shared_ptr<const SliceMap> map;
};
/// view  checked; empty where it does not meet the sector
[[nodiscard]] std::optional<MappedSlice> mapped_slice(const Sector& sector, const SliceView& view,
                                                      const PixelRect& place);

/// A slice ready to be drawn, with what a pointer needs.
struct SlicePicture {
  FrameDescription frame;
  PlotFrame plot;                       ///< axes as labelled (depths below the water line)
  std::shared_ptr<const SliceMap> map;  ///< of the plot's pixels
  std::vector<PlacedMark> refused = {};

  /// The voxel under a place of the whole picture.
  [[nodiscard]] std::optional<Voxel> voxel_at(PixelPoint pixel) const;
  /// Where a voxel appears in the whole picture.
  [[nodiscard]] std::optional<PixelPoint> place_of(const Voxel& voxel) const;
  /// As SliceMap::carried(), in the whole picture.
  [[nodiscard]] std::optional<PixelPoint> carried(const Voxel& voxel) const;
};

/// earlier  a map that may fit (of the ping before); it is used again where it does
/// errors   bad_parameter (a beam that is not there, a slice that misses the sector, a picture below 160 x 120), mismatch
[[nodiscard]] Result<SlicePicture> slice_picture(const Sector& sector, const SliceData& data, const SlicePing& ping,
                                                 const SliceView& view, const SliceStyle& style, const Theme& theme,
                                                 PixelSize size, std::shared_ptr<const SliceMap> earlier = {});

}  // namespace sonar
