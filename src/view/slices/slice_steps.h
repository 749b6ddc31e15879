// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/array.h"
#include "base/result.h"
#include "base/sample_flags.h"
#include "base/units.h"
#include "view/colour_map.h"
#include "view/slices/slice_picture.h"

namespace sonar {

// One slice of a ping at every step of its processing, side by side, and two of the steps compared.

/// A ping behind one step: its Sv, and which samples are not there any more.
struct SliceStep {
  std::string name;                           ///< "Interference"
  std::vector<std::string> words;             ///< lines on what the step did
  bool off = false;                           ///< the step was not taken
  View3<const std::int16_t> sv;               ///< [fan][beam][sample], Sv counts
  SampleFlags taken_out = SampleFlags::none;  ///< samples with any of these flags are not there
};

/// Views borrow.
struct SliceStepsData {
  View3<const SampleFlags> flags;  ///< [fan][beam][sample]
  std::vector<SliceStep> steps;    ///< in order; the first is where it begins
  std::vector<MaskLayer> masks{};  ///< outlined in the compared pictures
};

struct SliceStepsStyle {
  SvColours colours = sv_colours(SvScale{});
  SliceMaskStyle masks;
  bool north_up = false;
  bool mark = true;             ///< samples that a step took out, filled in or changed, against the step before
  double mark_db = 6.0;         ///< changed by so much or more
  double difference_db = 20.0;  ///< at the ends of the scale of differences
  std::optional<std::pair<std::size_t, std::size_t>>
      compared{};  ///< two of the steps at a larger size, before and after
};

/// Where a picture of a step is drawn.
struct SliceStepPlace {
  enum class Shows : std::uint8_t { step, before, after, difference };
  Shows shows = Shows::step;
  std::size_t step = 0;  ///< of a difference that of `after`
  PixelRect place;       ///< with its words
  PixelRect plot;        ///< the slice alone
};

struct SliceStepsPicture {
  FrameDescription frame;
  std::vector<SliceStepPlace> places;
  std::shared_ptr<const SliceMap> map;    ///< of a step's plot: all are alike
  std::shared_ptr<const SliceMap> large;  ///< of the compared ones' plots; null without
  /// What lies there; null = nothing.
  [[nodiscard]] const SliceStepPlace* at(PixelPoint pixel) const;
  [[nodiscard]] const SliceMap& map_of(const SliceStepPlace& place) const {
    return place.shows == SliceStepPlace::Shows::step ? *map : *large;
  }
  [[nodiscard]] std::optional<Voxel> voxel_at(PixelPoint pixel) const;
};

/// All steps in a grid; or two of them large, before and after, with their difference, above a row of all.
/// view    one for all, so that they have one extent
/// errors  bad_parameter: as slice_picture(); no steps, or none of a number. mismatch: data of another shape
[[nodiscard]] Result<SliceStepsPicture> slice_steps(const Sector& sector, const SliceStepsData& data,
                                                    const SlicePing& ping, const SliceView& view,
                                                    const SliceStepsStyle& style, const Theme& theme, PixelSize size);

/// Numbers of the samples that a slice goes through, (fan * beams + beam) * samples + sample, rising: a fan, the beams of
/// one number, or a range whole; of a plane those that a picture of 800 x 600 pixels shows.
[[nodiscard]] std::vector<std::int32_t> samples_in(const Sector& sector, const Slice& slice);

// --- images, for the composition above --------------------------------------------------------------------------------

/// Behind a step; kNoData = not there.
[[nodiscard]] inline std::int16_t sample_of(const SliceStep& step, View3<const SampleFlags> flags, std::int32_t voxel) {
  const auto at = static_cast<std::size_t>(voxel);
  return any(flags.all()[at] & step.taken_out) ? kNoData : step.sv.all()[at];
}

/// What became of a sample from one step to a later one.
enum class SampleFate : std::uint8_t { absent, kept, changed, taken_out, filled_in };
/// least  counts that make a change
[[nodiscard]] SampleFate fate(std::int16_t before, std::int16_t after, int least);

/// Marks what became of samples over a step's image: taken out in full, filled in or changed in stripes.
void mark_fates(Image& image, const SliceMap& map, const SliceStepsData& data, const SliceStep& before,
                const SliceStep& after, double mark_db, const Theme& theme);

/// after - before in dB on a diverging scale, -most..most; what is there on one side alone in a mark's colour.
[[nodiscard]] Image difference_image(const SliceMap& map, const SliceStepsData& data, const SliceStep& before,
                                     const SliceStep& after, double most_db, const Theme& theme);
/// Its colours: weaker = blue, stronger = red, on a middle that is the theme's water.
[[nodiscard]] ColourMap difference_colours(const Theme& theme);

}  // namespace sonar
