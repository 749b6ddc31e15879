// SPDX-License-Identifier: Apache-2.0
#include "school/seabed_flank.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/units.h"

namespace sonar {
namespace {

constexpr int kStep = 4;  ///< samples between two looks at the flank: the filter is longer than that
constexpr int kNoFlank = std::numeric_limits<int>::max();
constexpr SampleFlags kUnusable = SampleFlags::near_field | SampleFlags::surface | kFault;

/// What a beam hears behind what stands out of the flank.
enum class Behind : std::uint8_t { unknown, nothing, seabed };

struct OfRow {
  Stretch stretch;  ///< what stands out of the flank
  int top = kMinCount;
  Behind behind = Behind::unknown;
  bool seen = false;  ///< it is part of a body already
};

class FlankSearch {
 public:
  FlankSearch(const SeabedWater& water, const Ground& ground, Seabed& seabed)
      : water_(water),
        params_(water.params),
        ground_(ground),
        seabed_(seabed),
        beams_(water.sector.beams()),
        rows_(seabed.first_sample.size()) {}

  void run() {
    for (int fan = 0; fan < water_.sector.fans(); ++fan) look(fan);
    for (int row = 0; row < static_cast<int>(rows_.size()); ++row) {
      if (of(row).stretch.empty() || of(row).seen) continue;
      const std::vector<int> body = hanging_together(row);
      if (is_school(body)) open(body);
    }
  }

 private:
  [[nodiscard]] OfRow& of(int row) { return rows_[static_cast<std::size_t>(row)]; }
  [[nodiscard]] const OfRow& of(int row) const { return rows_[static_cast<std::size_t>(row)]; }
  [[nodiscard]] int loudest(int row) const { return ground_.loudest[static_cast<std::size_t>(row)]; }
  [[nodiscard]] int flank_begin(int row) const { return seabed_.first_sample[static_cast<std::size_t>(row)]; }
  [[nodiscard]] int count(int row, int sample) const { return water_.sv.row(row)[static_cast<std::size_t>(sample)]; }
  [[nodiscard]] int samples_of(double metres) const {
    return std::max(1, static_cast<int>(metres / water_.sector.range().spacing_m));
  }
  /// Where a beam is looked at: schools reach out of the flank towards the sonar, and none below the ground.
  [[nodiscard]] int begin_of(int row) const {
    return std::max(0, flank_begin(row) - samples_of(params_.flank_before_m));
  }
  [[nodiscard]] int end_of(int row) const {
    return std::min(loudest(row), ground_.first[static_cast<std::size_t>(row)]);
  }
  [[nodiscard]] bool has_flank(int row) const { return loudest(row) >= 0 && flank_begin(row) < end_of(row); }

  void look(int fan) {
    int longest = 0;
    for (int row = fan * beams_; row < (fan + 1) * beams_; ++row) {
      if (has_flank(row)) longest = std::max(longest, loudest(row) - begin_of(row));
    }
    if (longest == 0) return;
    profile(fan, longest);
    for (int row = fan * beams_; row < (fan + 1) * beams_; ++row) {
      if (!has_flank(row)) continue;
      OfRow& own = of(row);
      own.stretch = standing_out(row);
      if (own.stretch.empty()) continue;
      for (int s = own.stretch.first; s < own.stretch.end; ++s) own.top = std::max(own.top, count(row, s));
      own.behind = behind(row);
    }
  }

  /// The flank in a fan, by samples before each of its beams hears the plane loudest. The ground may be a little nearer in
  /// one beam than the plane says: there it is as loud as it is behind.
  void profile(int fan, int longest) {
    std::vector<int> exact(static_cast<std::size_t>(longest) + 1, kNoFlank);
    for (int before = 0; before <= longest; before += kStep) {
      std::fill_n(exact.begin() + before, std::min(kStep, longest + 1 - before), flank(fan, before));
    }
    profile_.resize(exact.size());
    const double sine_down = std::max(beam_axis(water_.sector, fan * beams_ + beams_ / 2).z, 1e-3);
    const int slack = samples_of(std::max(params_.flank_slack_m, params_.flank_lift_m / sine_down));
    for (int before = 0; before <= longest; ++before) {
      const auto from = exact.begin() + std::max(0, before - slack);
      profile_[static_cast<std::size_t>(before)] = *std::max_element(from, exact.begin() + before + 1);
    }
  }

  [[nodiscard]] int flank(int fan, int before) {
    values_.clear();
    for (int row = fan * beams_; row < (fan + 1) * beams_; ++row) {
      const int s = loudest(row) - before;
      if (loudest(row) < 0 || s < 0 || s >= water_.sv.shape().samples) continue;
      if (count(row, s) == kNoData || any(water_.flags.row(row)[static_cast<std::size_t>(s)] & kUnusable)) continue;
      values_.push_back(count(row, s));
    }
    if (std::ssize(values_) < params_.flank_beams) return kNoFlank;
    const auto last = static_cast<double>(values_.size() - 1);
    const auto rank = values_.begin() + static_cast<std::ptrdiff_t>(params_.flank_share * last);
    std::nth_element(values_.begin(), rank, values_.end());
    return *rank;
  }

  /// The last stretch of a beam that is long enough.
  [[nodiscard]] Stretch standing_out(int row) const {
    const auto rise = static_cast<int>(counts_from_db(params_.flank_rise_db));
    const auto least = static_cast<int>(counts_from_db(params_.onset_db));
    const int gap = samples_of(params_.onset_gap_m);
    Stretch last;
    Stretch now;
    for (int s = begin_of(row); s < end_of(row); ++s) {
      const int flank = profile_[static_cast<std::size_t>(loudest(row) - s)];
      if (flank == kNoFlank || count(row, s) < std::max(flank + rise, least)) continue;
      if (now.empty() || s - now.end > gap) now.first = s;
      now.end = s + 1;
      if (now.end - now.first >= samples_of(params_.flank_least_m)) last = now;
    }
    return last;
  }

  [[nodiscard]] Behind behind(int row) const {
    if (loudest(row) >= water_.sv.shape().samples) return Behind::unknown;
    const int slack = static_cast<int>(params_.inlier_share * loudest(row));
    const int to = std::min(water_.sv.shape().samples, loudest(row) + slack + 1);
    const auto dip = static_cast<int>(counts_from_db(params_.flank_dip_db));
    const int wanted = profile_.front() - static_cast<int>(counts_from_db(params_.hill_behind_db));
    int quietest = of(row).top;
    for (int s = of(row).stretch.end; s < to; ++s) {
      quietest = std::min(quietest, count(row, s));
      const bool parted = quietest <= of(row).top - dip && count(row, s) >= quietest + dip;
      if (parted && count(row, s) >= wanted) return Behind::seabed;
    }
    return Behind::nothing;
  }

  /// Rows whose stretches touch from beam to beam.
  std::vector<int> hanging_together(int start) {
    std::vector<int> body{start};
    of(start).seen = true;
    for (std::size_t at = 0; at < body.size(); ++at) {
      const int fan = body[at] / beams_;
      const int beam = body[at] % beams_;
      for (const auto& [f, b] : {std::pair{fan - 1, beam}, {fan + 1, beam}, {fan, beam - 1}, {fan, beam + 1}}) {
        if (f < 0 || f >= water_.sector.fans() || b < 0 || b >= beams_) continue;
        OfRow& other = of(f * beams_ + b);
        const Stretch& own = of(body[at]).stretch;
        if (other.seen || other.stretch.end <= own.first || own.end <= other.stretch.first) continue;
        other.seen = true;
        body.push_back(f * beams_ + b);
      }
    }
    return body;
  }

  /// A hill stands out as well, but it is where the beams end that hear it loudest.
  [[nodiscard]] bool is_school(const std::vector<int>& body) const {
    if (std::ssize(body) < params_.flank_rows) return false;
    int loudest_row = body.front();
    for (const int row : body) {
      if (of(row).top > of(loudest_row).top) loudest_row = row;
    }
    if (above_ground_m(loudest_row) < params_.flank_sigmas * ground_.roughness_m) return false;
    if (ground_.roughness_m <= params_.flank_smooth_m) return true;
    const auto near_top = of(loudest_row).top - static_cast<int>(counts_from_db(params_.flank_top_db));
    int judged = 0;
    int before_seabed = 0;
    for (const int row : body) {
      if (of(row).top < near_top || of(row).behind == Behind::unknown) continue;
      ++judged;
      before_seabed += of(row).behind == Behind::seabed ? 1 : 0;
    }
    return before_seabed > 0 && before_seabed >= params_.flank_apart_share * judged;
  }

  /// Of the middle of a stretch, on the beam's axis.
  [[nodiscard]] double above_ground_m(int row) const {
    const Stretch& own = of(row).stretch;
    const Point<Sonar> at = beam_axis(water_.sector, row) * water_.sector.range().range_m((own.first + own.end) / 2);
    return ground_.plane.z(at.x, at.y) - at.z;
  }

  void open(const std::vector<int>& body) {
    if (seabed_.open.empty()) seabed_.open.resize(rows_.size());
    for (const int row : body) {
      seabed_.open[static_cast<std::size_t>(row)] = {std::max(of(row).stretch.first, flank_begin(row)),
                                                     of(row).stretch.end};
    }
  }

  const SeabedWater& water_;
  const SeabedParams& params_;
  const Ground& ground_;
  Seabed& seabed_;
  int beams_;
  std::vector<OfRow> rows_;
  std::vector<int> profile_;  ///< [samples before the loudest] of the fan that is looked at
  std::vector<int> values_;
};

}  // namespace

void open_flank(const SeabedWater& water, const Ground& ground, Seabed& seabed) {
  if (water.params.flank_rise_db > 0.0) FlankSearch(water, ground, seabed).run();
}

}  // namespace sonar
