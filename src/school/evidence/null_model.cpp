// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/null_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/units.h"
#include "school/evidence/block_means.h"
#include "school/evidence/patches.h"
#include "school/evidence/place_statistics.h"
#include "school/evidence/places.h"
#include "school/evidence/seabed_stretch.h"
#include "signal/excess_kernels.h"

namespace sonar {
namespace {

constexpr double kLeastSpread_db = 0.7;  ///< of a mean over so many samples, if none were correlated
constexpr double kMasked = 6.0;          ///< what lies so far above it has no say in the next looks
constexpr int kLooks = 3;
constexpr double kClip = 2.0;     ///< spreads, up to which a block tells of the patch it lies in
constexpr double kRise_db = 3.0;  ///< of the seabed out of the water before it

using Levels = Array3<std::int16_t>;  // [fan][beam][block]
using Marks = Array3<std::uint8_t>;

/// Sum of a row and those `apart` before and after it, as far as there are any, always in the same order.
void add_three(View3<const float> values, int row, int apart, bool before, bool after, std::span<float> out) {
  const auto here = values.row(row);
  const auto first = before ? values.row(row - apart) : here;
  const auto last = after ? values.row(row + apart) : here;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const float sum = before ? first[i] + here[i] : here[i];
    out[i] = after ? sum + last[i] : sum;
  }
}

/// Sums over each beam and those beside it in its own fan and in the next ones.
Array3<float> of_three_by_three(const Array3<float>& values) {
  const Shape3 shape = values.shape();
  Array3<float> of_beams(shape);
  Array3<float> of_fans(shape);
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    const int beam = row % shape.beams;
    add_three(values.view(), row, 1, beam > 0, beam + 1 < shape.beams, of_beams.view().row(row));
  }
  for (int row = 0; row < static_cast<int>(shape.rows()); ++row) {
    const int fan = row / shape.beams;
    add_three(std::as_const(of_beams).view(), row, shape.beams, fan > 0, fan + 1 < shape.fans, of_fans.view().row(row));
  }
  return of_fans;
}

class Window {
 public:
  Window(std::span<const WaterPing> pings, const Sector& sector)
      : pings_(pings),
        sector_(sector),
        block_samples_(block_samples(sector.range())),
        shape_(pings.front().means->shape()),
        places_(seabed_stretch(pings, sector), shape_) {
    for (const WaterPing& ping : pings) {
      levels_.push_back(*ping.means);
      noise_levels_.push_back(block_noise(ping.noise, shape_, block_samples_));
      masked_.emplace_back(shape_);
    }
  }

  std::vector<WaterLevels> run(double least) {
    for (look_ = 0;; ++look_) {
      find_level();
      find_excess();
      find_evidence();
      if (look_ + 1 == kLooks) break;
      for (std::size_t p = 0; p < pings_.size(); ++p) mask(p);
    }
    std::vector<WaterLevels> out;
    for (std::size_t p = 0; p < pings_.size(); ++p) {
      out.push_back(pings_[p].asked ? answer(p, least) : WaterLevels{});
    }
    return out;
  }

 private:
  [[nodiscard]] std::size_t cells() const {
    return static_cast<std::size_t>(shape_.fans) * static_cast<std::size_t>(places_.count());
  }
  [[nodiscard]] std::size_t cell(int fan, int place) const {
    return static_cast<std::size_t>(fan) * static_cast<std::size_t>(places_.count()) + static_cast<std::size_t>(place);
  }

  [[nodiscard]] int rows() const { return static_cast<int>(shape_.rows()); }
  [[nodiscard]] std::span<const std::int16_t> excess(std::size_t p) const { return excess_[p].all(); }

  /// What is told of a fan's places, at the blocks of one of its beams.
  /// of_places  [fan][place]
  template <class Value>
  void lay_out_row(const std::vector<Value>& of_places, std::size_t p, int row, std::span<Value> out) const {
    const auto of_fan = std::span(of_places).subspan(cell(row / shape_.beams, 0));
    places_.for_each(p, row, shape_.samples, [&](int block, int place) {
      out[static_cast<std::size_t>(block)] = of_fan[static_cast<std::size_t>(place)];
    });
  }

  /// The same at all blocks of a ping.
  template <class Value>
  [[nodiscard]] Array3<Value> laid_out(const std::vector<Value>& of_places, std::size_t p) const {
    Array3<Value> out(shape_);
    for (int row = 0; row < rows(); ++row) lay_out_row(of_places, p, row, out.view().row(row));
    return out;
  }

  void find_level() {
    water_ = statistics_of_places(levels_, masked_, places_, Trend::steep);
    lift_seabed();
  }

  /// Hills are heard where the seabed in between is not yet: in beams that point down the water is as loud as up to
  /// where the seabed would be if it lay so much higher.
  void lift_seabed() {
    const double nearer = seabed_nearer(pings_);
    if (!(nearer < 1.0)) return;
    for (int fan = 0; fan < shape_.fans; ++fan) {
      if (sector_.elevation_rad(fan) >= 0.0) continue;
      const auto told = std::span(water_).subspan(cell(fan, 0), static_cast<std::size_t>(places_.count()));
      for (std::size_t b = 0; b < told.size(); ++b) {
        const auto last = std::min(told.size() - 1, static_cast<std::size_t>(static_cast<double>(b) / nearer));
        std::int16_t loudest = told[b].middle;
        for (std::size_t i = b + 1; i <= last; ++i) loudest = std::max(loudest, told[i].middle);
        if (loudest - told[b].middle >= counts_from_db(kRise_db)) told[b].middle = loudest;
      }
    }
  }

  /// The water in the middle of each block of a ping, between the places on either side.
  /// told  [fan][place] kMinCount = not known
  [[nodiscard]] Levels water_of(const std::vector<std::int16_t>& told, std::size_t p) const {
    Levels out(shape_);
    const int last = places_.count() - 1;
    for (int row = 0; row < rows(); ++row) {
      const auto at_blocks = out.view().row(row);
      const float by = places_.stretch(p, row);
      if (by == 1.0F) {  // blocks are places
        lay_out_row(told, p, row, at_blocks);
        continue;
      }
      const std::int16_t* of_fan = told.data() + cell(row / shape_.beams, 0);
      for (std::size_t block = 0; block < at_blocks.size(); ++block) {
        const float at = std::clamp((static_cast<float>(block) + 0.5F) * by - 0.5F, 0.0F, static_cast<float>(last));
        const int place = static_cast<int>(at);
        const int from = of_fan[place];
        const int to = of_fan[std::min(place + 1, last)];
        const int between = from + static_cast<int>((at - static_cast<float>(place)) * static_cast<float>(to - from));
        at_blocks[block] = static_cast<std::int16_t>(std::min(from, to) > kMinCount ? between : std::max(from, to));
      }
    }
    return out;
  }

  void find_excess() {
    std::vector<std::int16_t> told;
    for (const PlaceStatistics& water : water_) told.push_back(water.middle == kNoData ? kMinCount : water.middle);
    excess_.clear();
    for (std::size_t p = 0; p < pings_.size(); ++p) {
      const Levels water = water_of(told, p);
      excess_over(levels_[p].all(), water.all(), noise_levels_[p].all(), excess_.emplace_back(shape_).all());
    }
    level_patches();
    spread_ = statistics_of_places(excess_, masked_, places_, Trend::none);
  }

  /// Takes out of each ping's excess what is wider than schools.
  void level_patches() {
    std::vector<std::int16_t> clips;
    for (const PlaceStatistics& water : water_) {
      const double clip = kClip * std::max<double>(water.below, counts_from_db(kLeastSpread_db));
      clips.push_back(static_cast<std::int16_t>(std::min<double>(clip, kMaxCount)));
    }
    Levels heard(shape_);
    patches_.clear();
    for (std::size_t p = 0; p < pings_.size(); ++p) {
      clip_excess(excess(p), laid_out(clips, p).all(), masked_[p].all(), heard.all());
      patches_.push_back(local_patches(std::as_const(heard).view()));
      take_off_steps(patches_.back(), kPatchStep, excess_[p].all());
    }
  }

  /// Before what lies above it is known the upper half may hold a school; then it is the half that schools must exceed. A
  /// school that keeps its place in the window and fills more than a sixth of it widens the water.
  [[nodiscard]] double width(const PlaceStatistics& told, double least) const {
    return std::max<double>(look_ == 0 ? told.below : told.above, least);
  }

  /// Sum of the whitened excess over 3 x 3 beams, over the root of their number, in 1/256.
  /// middle, scale  [fan][place] of what the excess is whitened by; a scale of 0 = not known
  [[nodiscard]] Levels averaged(std::size_t p, const std::vector<float>& middle,
                                const std::vector<float>& scale) const {
    Array3<float> whitened(shape_);
    Array3<float> number(shape_);
    whiten(excess(p), laid_out(middle, p).all(), laid_out(scale, p).all(), whitened.all(), number.all());
    const Array3<float> sum = of_three_by_three(whitened);
    const Array3<float> of = of_three_by_three(number);
    Levels out(shape_);
    over_root(excess(p), sum.all(), of.all(), out.all());
    return out;
  }

  void find_evidence() {
    std::vector<float> middle(cells(), 0.0F);
    std::vector<float> scale(cells(), 0.0F);
    for (std::size_t i = 0; i < cells(); ++i) {
      if (spread_[i].middle == kNoData) continue;
      middle[i] = std::max<float>(0.0F, spread_[i].middle);
      scale[i] = static_cast<float>(256.0 / width(spread_[i], counts_from_db(kLeastSpread_db)));
    }
    evidence_.clear();
    for (std::size_t p = 0; p < pings_.size(); ++p) evidence_.push_back(averaged(p, middle, scale));
    own_ = statistics_of_places(evidence_, masked_, places_, Trend::none);
  }

  /// Calls act(row, block, evidence) for the blocks of a ping that have so much at least. least > 0
  template <class Act>
  void for_each_clear(std::size_t p, double least, const Act& act) const {
    std::vector<int> needed(cells(), std::numeric_limits<int>::max());  // most blocks are told by this alone
    for (std::size_t i = 0; i < cells(); ++i) {
      if (own_[i].middle == kNoData) continue;
      needed[i] = static_cast<int>(std::max<int>(0, own_[i].middle) + least * width(own_[i], 128.0));
    }
    const Array3<int> needed_at = laid_out(needed, p);
    const std::span<const std::int16_t> values = evidence_[p].all();
    const auto blocks = static_cast<std::size_t>(shape_.samples);
    std::vector<PlaceStatistics> own_at(blocks);
    int laid_out_row = -1;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] < needed_at.all()[i]) continue;  // kNoData is
      const int row = static_cast<int>(i / blocks);
      if (row != laid_out_row) lay_out_row(own_, p, row, std::span(own_at));
      laid_out_row = row;
      const PlaceStatistics& own = own_at[i % blocks];
      const double evidence = (values[i] - std::max<int>(0, own.middle)) / width(own, 128.0);
      if (evidence >= least) act(row, static_cast<int>(i % blocks), evidence);
    }
  }

  /// Once masked, always masked: a school that keeps its place would else have a say again as soon as it has none.
  void mask(std::size_t p) {
    Marks& marks = masked_[p];
    for_each_clear(p, kMasked, [&](int row, int block, double /*evidence*/) {
      const int fan = row / shape_.beams;
      const int beam = row % shape_.beams;
      for (int f = std::max(0, fan - 1); f <= std::min(shape_.fans - 1, fan + 1); ++f) {
        for (int b = std::max(0, beam - 1); b <= std::min(shape_.beams - 1, beam + 1); ++b) {
          for (int s = std::max(0, block - 1); s <= std::min(shape_.samples - 1, block + 1); ++s) marks(f, b, s) = 1;
        }
      }
    });
  }

  [[nodiscard]] WaterLevels answer(std::size_t p, double least) const {
    WaterLevels out;
    out.block_samples = block_samples_;
    out.blocks = shape_.samples;
    out.places = places_.count();
    out.stretch = places_.stretch(p);
    out.patch = patches_[p];
    for (std::size_t i = 0; i < cells(); ++i) {
      out.level.push_back(water_[i].middle == kNoData ? std::int16_t{kMinCount} : water_[i].middle);
      out.reach.push_back(spread_[i].middle == kNoData ? std::int16_t{0}
                                                       : static_cast<std::int16_t>(width(spread_[i], 0.0)));
    }
    for_each_clear(p, least, [&](int row, int block, double evidence) {
      out.cells.push_back({row, block, static_cast<float>(evidence)});
    });
    return out;
  }

  std::span<const WaterPing> pings_;
  const Sector& sector_;
  int block_samples_;
  Shape3 shape_;  ///< fans, beams, blocks
  Places places_;
  int look_ = 0;
  std::vector<Levels> levels_;
  std::vector<Levels> noise_levels_;
  std::vector<Levels> excess_;
  std::vector<std::vector<std::int8_t>> patches_;  ///< [ping][row][block]
  std::vector<Levels> evidence_;
  std::vector<Marks> masked_;
  std::vector<PlaceStatistics> water_;
  std::vector<PlaceStatistics> spread_;
  std::vector<PlaceStatistics> own_;
};

}  // namespace

std::vector<WaterLevels> water_levels(std::span<const WaterPing> window, const Sector& sector, double least) {
  if (window.empty()) return {};
  return Window(window, sector).run(least);
}

}  // namespace sonar
