// SPDX-License-Identifier: Apache-2.0
#include "school/measure/repeat_ping.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/units.h"
#include "school/detect/noise_level.h"
#include "school/grow/grow.h"
#include "school/measure/echo_row.h"

namespace sonar {
namespace {

/// A filter that runs twice takes off a body's corners twice; what the second time takes is put on before it, up to this.
constexpr double kMostRaised_db = 6.0;

std::int16_t clamped(double counts) {
  return static_cast<std::int16_t>(
      std::clamp(std::round(counts), static_cast<double>(kMinCount), static_cast<double>(kMaxCount)));
}

}  // namespace

PingRepeater::PingRepeater(const MeasureInput& ping, const PingMask& mask, const MedianParams& median,
                           double tolerance_db)
    : ping_(ping), mask_(mask), median_(median), tolerance_db_(tolerance_db) {
  // What may become a member lies a beam, a fan and half the filter off, and the filter looks as far again.
  const Shape3 shape = ping.sv.shape();
  box_ = box_of(mask, shape.beams).enlarged(2, 2, median.kernel_samples).clipped(shape);
  const Shape3 size{box_.fans(), box_.beams(), box_.samples()};
  members_ = Array3<std::uint8_t>(size);
  next_to_ = Array3<std::uint8_t>(size);
  const int reach = median.kernel_samples / 2;
  std::size_t i = 0;
  for (const Run& run : mask.runs) {
    const int fan = run.row / shape.beams - box_.first_fan;
    const int beam = run.row % shape.beams - box_.first_beam;
    const int from = run.first_sample - box_.first_sample;
    for (int s = 0; s < run.count; ++s) members_(fan, beam, from + s) = mask.confidence[i++];
    for (int f = std::max(0, fan - 1); f <= std::min(size.fans - 1, fan + 1); ++f) {
      for (int b = std::max(0, beam - 1); b <= std::min(size.beams - 1, beam + 1); ++b) {
        const auto row = next_to_.row(f, b);
        std::fill(row.begin() + std::max(0, from - reach),
                  row.begin() + std::min(size.samples, from + run.count + reach), 1);
      }
    }
  }
  field_.emplace(*ping.grid, box_, ping.sector->range().spacing_m, ping.pulse_m);
  heard_ = heard_in_box();
  level_ = smoothed();
  echo_of_level_ = echo_of_level();
}

Array3<std::int16_t> PingRepeater::heard_in_box() const {
  Array3<std::int16_t> heard(members_.shape());
  for (int f = 0; f < box_.fans(); ++f) {
    for (int b = 0; b < box_.beams(); ++b) {
      const auto row = ping_.filtered.row(box_.first_fan + f, box_.first_beam + b);
      const auto from =
          row.subspan(static_cast<std::size_t>(box_.first_sample), static_cast<std::size_t>(box_.samples()));
      std::copy(from.begin(), from.end(), heard.view().row(f, b).begin());
    }
  }
  return heard;
}

Array3<std::int16_t> PingRepeater::smoothed() const {
  const double limit = counts_from_db(kMostRaised_db);
  const Array3<SampleFlags> sound(heard_.shape());
  Array3<std::int16_t> again(heard_.shape());
  median_into(heard_.view(), sound.view(), median_, again.view());
  for (std::size_t i = 0; i < again.all().size(); ++i) {
    const std::int16_t heard = heard_.all()[i];
    std::int16_t& raised = again.all()[i];
    raised = raised == kNoData || heard == kNoData ? heard
                                                   : clamped(heard + std::clamp(1.0 * heard - raised, -limit, limit));
  }
  MedianParams along = median_;
  along.kernel_fans = along.kernel_beams = 1;
  Array3<std::int16_t> level(heard_.shape());
  median_into(again.view(), sound.view(), along, level.view());
  for (std::size_t i = 0; i < level.all().size(); ++i) {
    if (level.all()[i] == kNoData || heard_.all()[i] == kNoData) level.all()[i] = heard_.all()[i];
  }
  return level;
}

double PingRepeater::echo_of_level() const {
  double echo = 0.0;
  double level = 0.0;
  for (const Run& run : mask_.runs) {
    const EchoRow row(ping_, run.row, 1.0);
    const auto sv = ping_.sv.row(run.row);
    const int beams = ping_.sector->beams();
    const auto level_of_row = level_.view().row(run.row / beams - box_.first_fan, run.row % beams - box_.first_beam);
    const double solid_angle = ping_.sector->solid_angle_sr(run.row / beams, run.row % beams);
    for (int s = run.first_sample; s < run.end(); ++s) {
      const auto i = static_cast<std::size_t>(s);
      const std::int16_t told = level_of_row[static_cast<std::size_t>(s - box_.first_sample)];
      if (!row.heard(s) || told == kNoData) continue;
      const double volume = solid_angle * ping_.sector->shell_m3_per_sr(s);
      echo += volume * linear_from_count(sv[i]);
      level += volume * linear_from_count(told);
    }
  }
  return counts_from_db(echo > 0.0 && level > 0.0 ? db_from_linear(echo / level) : -kMedianOfMean_db);
}

double PingRepeater::loud_part_db(View3<const std::int16_t> later) const {
  constexpr double kLoud = 0.95;
  std::vector<std::int16_t> before;
  std::vector<std::int16_t> after;
  for (const Run& run : mask_.runs) {
    const auto counts = ping_.filtered.row(run.row);
    const auto again = later.row(run.row / ping_.sv.shape().beams - box_.first_fan,
                                 run.row % ping_.sv.shape().beams - box_.first_beam);
    for (int s = run.first_sample; s < run.end(); ++s) {
      const std::int16_t count = counts[static_cast<std::size_t>(s)];
      if (count == kNoData) continue;
      before.push_back(count);
      after.push_back(again[static_cast<std::size_t>(s - box_.first_sample)]);
    }
  }
  if (before.empty()) return 0.0;
  const auto rank = static_cast<std::ptrdiff_t>(kLoud * static_cast<double>(before.size() - 1));
  std::nth_element(before.begin(), before.begin() + rank, before.end());
  std::nth_element(after.begin(), after.begin() + rank, after.end());
  return db_from_counts(after[static_cast<std::size_t>(rank)] - before[static_cast<std::size_t>(rank)]);
}

PingMask PingRepeater::mask_again(View3<const std::int16_t> later, double threshold_db) const {
  const int beams = ping_.sv.shape().beams;
  const double before = counts_from_db(ping_.threshold_db);
  const double now = counts_from_db(threshold_db);
  const double tolerance = counts_from_db(tolerance_db_);
  PingMask out;
  for (int f = 0; f < box_.fans(); ++f) {
    for (int b = 0; b < box_.beams(); ++b) {
      const int row = (box_.first_fan + f) * beams + box_.first_beam + b;
      const auto level = ping_.filtered.row(row);
      const auto flags = ping_.flags.row(row);
      const auto again = later.row(f, b);
      PingMask run;
      bool holds = false;  // a member of old: nothing grows apart from the school
      const auto end_run = [&] {
        if (holds) {
          out.runs.insert(out.runs.end(), run.runs.begin(), run.runs.end());
          out.confidence.insert(out.confidence.end(), run.confidence.begin(), run.confidence.end());
        }
        run = {};
        holds = false;
      };
      for (int s = 0; s < box_.samples(); ++s) {
        const int sample = box_.first_sample + s;
        const auto i = static_cast<std::size_t>(sample);
        const std::uint8_t confidence = members_(f, b, s);
        const bool was = confidence > 0;
        const bool heard = level[i] != kNoData;
        const bool above = heard && level[i] >= before;
        const std::int16_t level_again = again[static_cast<std::size_t>(s)];
        bool is = was;
        // What stands against its threshold a human decided, or what lay beside it did: it stays.
        if (was == above && heard) is = level_again >= now;
        if (!was && is) {
          const bool taken = ping_.others != nullptr && confidence_at(*ping_.others, row, sample) > 0;
          is = next_to_(f, b, s) > 0 && !any(flags[i] & kNeverMember) && !taken;
        }
        if (!is) {
          end_run();
          continue;
        }
        if (run.runs.empty()) run.runs.push_back({row, sample, 0});
        ++run.runs.back().count;
        // how far below the reference that its confidence counts from
        double below = tolerance - (level_again - now);
        if (was) below = tolerance * std::sqrt(1.0 - confidence / 255.0) - (heard ? level_again - level[i] : 0.0);
        const double share = std::clamp(below / tolerance, 0.0, 1.0);
        run.confidence.push_back(quantised_confidence(1.0 - share * share));
        const bool beside = (b > 0 && members_(f, b - 1, s) > 0) ||
                            (b + 1 < box_.beams() && members_(f, b + 1, s) > 0) ||
                            (f > 0 && members_(f - 1, b, s) > 0) || (f + 1 < box_.fans() && members_(f + 1, b, s) > 0);
        holds = holds || was || beside;
      }
      end_run();
    }
  }
  return out;
}

PingMask PingRepeater::under_fading(std::uint64_t seed) {
  const Shape3 shape = ping_.sv.shape();
  if (sv_.all().empty()) {  // each repeat writes the same box anew
    sv_ = Array3<std::int16_t>(shape);
    filtered_ = Array3<std::int16_t>(shape);
    std::copy(ping_.sv.all().begin(), ping_.sv.all().end(), sv_.all().begin());
    std::copy(ping_.filtered.all().begin(), ping_.filtered.all().end(), filtered_.all().begin());
  }
  Array3<std::int16_t> sv = field_->draw(seed);
  for (std::size_t i = 0; i < sv.all().size(); ++i) {
    const std::int16_t level = level_.all()[i];
    sv.all()[i] = level == kNoData ? kNoData : clamped(level + echo_of_level_ + sv.all()[i]);
  }
  Array3<std::int16_t> later(sv.shape());
  const Array3<SampleFlags> sound(sv.shape());
  median_into(sv.view(), sound.view(), median_, later.view());
  const auto first = static_cast<std::size_t>(box_.first_sample);
  for (int f = 0; f < box_.fans(); ++f) {
    for (int b = 0; b < box_.beams(); ++b) {
      const auto sv_of_ping = sv_.view().row(box_.first_fan + f, box_.first_beam + b).subspan(first);
      const auto filtered = filtered_.view().row(box_.first_fan + f, box_.first_beam + b).subspan(first);
      const auto faded = sv.view().row(f, b);
      const auto again = later.view().row(f, b);
      for (std::size_t s = 0; s < faded.size(); ++s) {
        if (again[s] == kNoData || filtered[s] == kNoData) again[s] = filtered[s];
        filtered[s] = again[s];
        if (sv_of_ping[s] != kNoData && faded[s] != kNoData) sv_of_ping[s] = faded[s];
      }
    }
  }
  const View3<const std::int16_t> now = std::as_const(later).view();
  threshold_db_ = ping_.threshold_db + loud_part_db(now);
  return mask_again(now, threshold_db_);
}

PingMask PingRepeater::at_threshold(double step_db) const {
  return mask_again(heard_.view(), ping_.threshold_db + step_db);
}

}  // namespace sonar
