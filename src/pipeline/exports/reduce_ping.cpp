// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/reduce_ping.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

#include "base/units.h"
#include "pipeline/stages/reduced_ping.h"
#include "school/detect/detect.h"
#include "school/detect/noise_level.h"
#include "school/detect/settle_members.h"
#include "school/evidence/seeds.h"
#include "school/runs.h"

namespace sonar {
namespace {

/// How far a box is enlarged on each side.
struct Reach {
  int fans = 0;
  int beams = 0;
  int samples = 0;
};

/// Detection looks no further round a candidate than this, the samples of its filter left out; where schools meet it looks
/// on along the neighbour, whose own surroundings are kept as well.
constexpr Reach kDetectionReach{
    SearchReach::fans + SearchReach::most_margins * SearchReach::margin_fans,
    SearchReach::beams + SearchReach::most_margins* SearchReach::margin_beams,
    SearchReach::samples + SearchReach::most_margins* SearchReach::margin_samples + kMemberSamples / 2};

bool meet(const IndexBox& a, const IndexBox& b) {
  return a.first_fan <= b.last_fan && b.first_fan <= a.last_fan && a.first_beam <= b.last_beam &&
         b.first_beam <= a.last_beam && a.first_sample <= b.last_sample && b.first_sample <= a.last_sample;
}

IndexBox enlarged(const IndexBox& box, const Reach& by, const Shape3& shape) {
  return box.enlarged(by.fans, by.beams, by.samples).clipped(shape);
}

/// Boxes in which detection looked for what it found, round all that lies above the background of the water together.
std::vector<IndexBox> candidate_boxes(const WaterLevels& water, const Shape3& shape) {
  std::vector<IndexBox> boxes;
  for (std::vector<Run>& part : connected_parts(seed_runs(water, shape), shape, Connectivity::faces)) {
    PingMask mask;
    mask.runs = std::move(part);
    boxes.push_back(enlarged(box_of(mask, shape.beams), kDetectionReach, shape));
  }
  return boxes;
}

/// The boxes that meet a mask's own: stronger neighbours take their voxels first. Where these are detections they are among
/// the masks, with neighbours of their own.
std::vector<IndexBox> deciding_boxes(const WaterLevels& water, const Shape3& shape,
                                     const std::vector<const PingMask*>& masks) {
  std::vector<IndexBox> boxes;
  for (const PingMask* mask : masks) boxes.push_back(enlarged(box_of(*mask, shape.beams), kDetectionReach, shape));
  const std::vector<IndexBox> of_masks = boxes;
  std::ranges::copy_if(candidate_boxes(water, shape), std::back_inserter(boxes), [&](const IndexBox& box) {
    return std::ranges::any_of(of_masks, [&](const IndexBox& of_mask) { return meet(box, of_mask); });
  });
  return boxes;
}

class Keeper {
 public:
  Keeper(const PowerVolume& whole, const StagedPing& ping, ReducedPing& out)
      : whole_(whole), ping_(ping), shape_(whole.volume.counts.shape()), out_(out) {}

  void keep_box(const IndexBox& box) {
    for (int fan = box.first_fan; fan <= box.last_fan; ++fan) {
      for (int beam = box.first_beam; beam <= box.last_beam; ++beam) {
        keep(fan, beam, box.first_sample, box.last_sample + 1);
      }
    }
  }

  /// The corrected sizes look at a mask's beams through all its fans and some more, and at the background round them.
  void keep_surroundings(const PingMask& mask, const MeasureParams& params) {
    const IndexBox box = box_of(mask, shape_.beams);
    const int reach = params.reach_samples + params.ring_gap_samples + params.ring_samples;
    const int first_fan = std::max(0, box.first_fan - params.reach_fans);
    const int last_fan = std::min(shape_.fans - 1, box.last_fan + params.reach_fans);
    for (const Run& run : mask.runs) {
      const int beam = run.row % shape_.beams;
      for (int b = std::max(0, beam - params.reach_beams); b <= std::min(shape_.beams - 1, beam + params.reach_beams);
           ++b) {
        for (int f = first_fan; f <= last_fan; ++f) {
          keep(f, b, run.first_sample - reach, run.end() + reach);
        }
      }
    }
  }

 private:
  void keep(int fan, int beam, int first, int end) {
    const auto from = whole_.volume.counts.row(fan, beam);
    const auto flags = std::as_const(ping_.sv.flags).row(fan, beam);
    const auto to = out_.counts.row(fan, beam);
    for (int s = std::max(0, first); s < std::min(shape_.samples, end); ++s) {
      const auto i = static_cast<std::size_t>(s);
      to[i] = any(flags[i] & kFault) ? kReducedFault : from[i];
    }
  }

  const PowerVolume& whole_;
  const StagedPing& ping_;
  Shape3 shape_;
  ReducedPing& out_;
};

int recorded_end(std::span<const std::int16_t> row) {
  auto end = static_cast<int>(row.size());
  while (end > 0 && row[static_cast<std::size_t>(end - 1)] == kNoData) --end;
  return end;
}

/// In each fan the last sample of its longest beam.
void keep_last_samples(const Array3<std::int16_t>& counts, Array3<std::int16_t>& out) {
  for (int fan = 0; fan < counts.shape().fans; ++fan) {
    int longest = 0;
    int end = 0;
    for (int beam = 0; beam < counts.shape().beams; ++beam) {
      const int here = recorded_end(counts.row(fan, beam));
      if (here <= end) continue;
      end = here;
      longest = beam;
    }
    if (end > 0) out(fan, longest, end - 1) = counts(fan, longest, end - 1);
  }
}

/// Sample by sample the mean of neighbouring beams of a fan stands for them, in the middle one, where nothing of them
/// is kept: raw files have one sample interval for all channels and no gaps in a channel, so that it is whole channels
/// that save room.
void keep_coarse(const Array3<std::int16_t>& counts, int group, Array3<std::int16_t>& out) {
  const Shape3 shape = counts.shape();
  for (int fan = 0; fan < shape.fans; ++fan) {
    for (int first = 0; first < shape.beams; first += group) {
      const int end = std::min(shape.beams, first + group);
      const int middle = (first + end - 1) / 2;
      for (int s = 0; s < shape.samples; ++s) {
        double sum = 0.0;
        int data = 0;
        bool untouched = true;
        for (int beam = first; beam < end; ++beam) {
          untouched = untouched && out(fan, beam, s) == kNoData;
          const std::int16_t count = counts(fan, beam, s);
          if (count == kNoData) continue;
          sum += linear_from_count(count);
          ++data;
        }
        if (!untouched || data == 0) continue;
        const double mean = std::clamp<double>(counts_from_db(db_from_linear(sum / data)), kMinCount + 1, kMaxCount);
        out(fan, middle, s) = static_cast<std::int16_t>(std::lround(mean));
      }
    }
  }
}

void fill_record(const PowerVolume& whole, const std::vector<int>& row_of_channel, const Seabed& seabed,
                 const std::vector<float>& background_db, ReducedPing& out) {
  if (seabed.found) {
    out.seabed = ReducedSeabed{seabed.offset_m, seabed.slope_x, seabed.slope_y, seabed.min_x,
                               seabed.max_x,    seabed.min_y,   seabed.max_y};
  }
  // A file that was reduced before tells how long its beams once were.
  const std::vector<int> told =
      is_reduced(whole.heads) ? reduced_lengths(whole.heads, row_of_channel) : std::vector<int>{};
  const int samples = whole.volume.counts.shape().samples;
  out.record.resize(whole.volume.counts.shape().rows());
  for (std::size_t row = 0; row < out.record.size(); ++row) {
    ReducedRow& record = out.record[row];
    record.background_db = background_db.empty() ? std::numeric_limits<float>::quiet_NaN() : background_db[row];
    if (told.empty()) {
      record.recorded_samples = recorded_end(whole.volume.counts.view().row(static_cast<int>(row)));
    } else {
      record.recorded_samples = told[row] < 0 ? samples : std::min(told[row], samples);
    }
    const bool heard = seabed.found && !seabed.heard_sample.empty();
    record.open_end = seabed.found ? seabed.first_sample[row] : samples;
    record.seabed_sample = heard ? seabed.heard_sample[row] : record.open_end;
    record.open_first = record.seabed_sample;
  }
}

/// Beams that the file will not hold: no channel to write, or no sample of it. Those that end with the ping are water.
void note_short_beams(const PowerVolume& whole, const std::vector<int>& row_of_channel, ReducedPing& out) {
  const int samples = whole.volume.counts.shape().samples;
  std::vector<bool> there(row_of_channel.size(), false);
  for (const ChannelPing& head : whole.heads) {
    if (head.channel >= 0 && static_cast<std::size_t>(head.channel) < there.size()) {
      there[static_cast<std::size_t>(head.channel)] = true;
    }
  }
  for (std::size_t channel = 0; channel < row_of_channel.size(); ++channel) {
    const int row = row_of_channel[channel];
    if (row < 0) continue;
    const ReducedRow& record = out.record[static_cast<std::size_t>(row)];
    const bool kept = there[channel] && recorded_end(std::as_const(out.counts).view().row(row)) > 0;
    if (!kept && record.recorded_samples < samples) out.short_beams.push_back({static_cast<int>(channel), record});
  }
}

}  // namespace

Result<ReducedPing> reduce_ping(Engine& engine, GroupWater& waters, std::int64_t ping_index,
                                const std::vector<const PingMask*>& masks, KeepAlso also, const ReduceParams& params) {
  const auto whole = load_volume(engine.survey(), engine.observation(), static_cast<std::size_t>(ping_index));
  if (!whole) return pass_on(whole);
  ReducedPing out;
  out.counts = Array3<std::int16_t>(whole->volume.counts.shape(), kNoData);
  Seabed seabed;
  if (!masks.empty() || also.detections) {
    const auto staged = engine.staged(ping_index);
    if (!staged) return pass_on(staged);
    seabed = staged->seabed;
    auto told = waters.of(ping_index);
    if (!told) return pass_on(told);
    const WaterLevels water = std::move(*told);
    const Recipe& recipe = engine.recipe();
    // What became no school is still what tracks were joined past: without it they would be joined otherwise.
    std::vector<Detection> detected;
    std::vector<const PingMask*> deciding = masks;
    if (recipe.automatic && also.detections) {
      detected = detect(engine.echo(*staged, water), recipe.detect);
      for (const Detection& one : detected) deciding.push_back(&one.mask);
    }
    const Reach reach{recipe.median.kernel_fans / 2 + params.margin_fans,
                      recipe.median.kernel_beams / 2 + params.margin_beams,
                      recipe.median.kernel_samples / 2 + params.margin_samples};
    Keeper keeper(*whole, *staged, out);
    out.water = water;
    for (const IndexBox& box : deciding_boxes(water, whole->volume.counts.shape(), deciding)) {
      keeper.keep_box(enlarged(box, reach, whole->volume.counts.shape()));
    }
    for (const PingMask* mask : masks) keeper.keep_surroundings(*mask, recipe.measure);
  }
  if (also.ends) keep_last_samples(whole->volume.counts, out.counts);
  if (params.coarsen_beams > 0) keep_coarse(whole->volume.counts, params.coarsen_beams, out.counts);
  const std::vector<int> row_of_channel = engine.grid().row_of_channel();
  fill_record(*whole, row_of_channel, seabed, engine.background_db(ping_index), out);
  note_short_beams(*whole, row_of_channel, out);
  return out;
}

}  // namespace sonar
