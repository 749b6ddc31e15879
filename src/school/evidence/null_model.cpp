// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/null_model.h"

#include <algorithm>
#include <array>
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

namespace sonar {
namespace {

constexpr double kLeastSpread_db = 0.7;  ///< of a mean over so many samples, if none were correlated
constexpr double kMasked = 6.0;          ///< what lies so far above it has no say in the next looks
constexpr int kLooks = 3;
constexpr double kClip = 2.0;     ///< spreads, up to which a block tells of the patch it lies in
constexpr double kRise_db = 3.0;  ///< of the seabed out of the water before it

using Levels = Array3<std::int16_t>;  // [fan][beam][block]
using Marks = Array3<std::uint8_t>;

/// Of a sum of so many whitened values, what it has in their spreads.
const std::array<float, 10> kPerRoot = [] {
  std::array<float, 10> per_root{};
  for (std::size_t n = 1; n < per_root.size(); ++n) per_root[n] = 1.0F / std::sqrt(static_cast<float>(n));
  return per_root;
}();

/// Sums over each beam and those beside it in its own fan and in the next ones, always in the same order.
Array3<float> of_three_by_three(const Array3<float>& values) {
  const Shape3 shape = values.shape();
  Array3<float> of_beams(shape);
  Array3<float> of_fans(shape);
  const auto add = [](std::span<const float> from, std::span<float> to) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += from[i];
  };
  for (int fan = 0; fan < shape.fans; ++fan) {
    for (int beam = 0; beam < shape.beams; ++beam) {
      for (int b = std::max(0, beam - 1); b <= std::min(shape.beams - 1, beam + 1); ++b) {
        add(values.row(fan, b), of_beams.row(fan, beam));
      }
    }
  }
  for (int fan = 0; fan < shape.fans; ++fan) {
    for (int beam = 0; beam < shape.beams; ++beam) {
      for (int f = std::max(0, fan - 1); f <= std::min(shape.fans - 1, fan + 1); ++f) {
        add(of_beams.row(f, beam), of_fans.row(fan, beam));
      }
    }
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

  /// Calls act(i, cell) for each block of a ping, i of its arrays.
  template <class Act>
  void for_each_block(std::size_t p, const Act& act) const {
    std::size_t i = 0;
    for (int row = 0; row < static_cast<int>(shape_.rows()); ++row) {
      const std::size_t first = cell(row / shape_.beams, 0);
      places_.for_each(p, row, shape_.samples,
                       [&](int /*block*/, int place) { act(i++, first + static_cast<std::size_t>(place)); });
    }
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

  /// The water in the middle of each block of a beam, between the places on either side.
  /// of_fan  [place] kMinCount = not known
  void water_of_row(std::span<const std::int16_t> of_fan, float by, std::span<int> out) const {
    if (by == 1.0F) {  // the usual case: blocks are places
      std::copy_n(of_fan.begin(), out.size(), out.begin());
      return;
    }
    const auto last = static_cast<float>(of_fan.size() - 1);
    for (std::size_t block = 0; block < out.size(); ++block) {
      const float at = std::clamp((static_cast<float>(block) + 0.5F) * by - 0.5F, 0.0F, last);
      const auto place = static_cast<std::size_t>(at);
      const int from = of_fan[place];
      const int to = of_fan[std::min(place + 1, of_fan.size() - 1)];
      const int between = from + static_cast<int>((at - static_cast<float>(place)) * static_cast<float>(to - from));
      out[block] = std::min(from, to) > kMinCount ? between : std::max(from, to);
    }
  }

  void find_excess() {
    excess_.clear();
    std::vector<std::int16_t> told(water_.size());
    std::ranges::transform(water_, told.begin(), [](const PlaceStatistics& water) {
      return water.middle == kNoData ? std::int16_t{kMinCount} : water.middle;
    });
    std::vector<int> below(static_cast<std::size_t>(shape_.samples));
    for (std::size_t p = 0; p < pings_.size(); ++p) {
      Levels excess(shape_, kNoData);
      for (int row = 0; row < static_cast<int>(shape_.rows()); ++row) {
        const auto of_fan =
            std::span(told).subspan(cell(row / shape_.beams, 0), static_cast<std::size_t>(places_.count()));
        water_of_row(of_fan, places_.stretch(p, row), below);
        const auto level = std::as_const(levels_[p]).view().row(row);
        const auto noise = std::as_const(noise_levels_[p]).view().row(row);
        const auto out = excess.view().row(row);
        for (std::size_t i = 0; i < out.size(); ++i) {
          const int water = std::max(below[i], int{noise[i]});
          if (level[i] == kNoData || water <= kMinCount) continue;
          out[i] = static_cast<std::int16_t>(std::clamp(level[i] - water, -30000, 30000));
        }
      }
      excess_.push_back(std::move(excess));
    }
    level_patches();
    spread_ = statistics_of_places(excess_, masked_, places_, Trend::none);
  }

  /// Takes out of each ping's excess what is wider than schools.
  void level_patches() {
    patches_.clear();
    for (std::size_t p = 0; p < pings_.size(); ++p) {
      Levels heard(shape_, kNoData);
      for_each_block(p, [&](std::size_t i, std::size_t cell) {
        const std::int16_t excess = excess_[p].all()[i];
        if (excess != kNoData && masked_[p].all()[i] == 0) {
          const int clip =
              static_cast<int>(kClip * std::max<double>(water_[cell].below, counts_from_db(kLeastSpread_db)));
          heard.all()[i] = static_cast<std::int16_t>(std::clamp<int>(excess, -clip, clip));
        }
      });
      patches_.push_back(local_patches(std::as_const(heard).view()));
      auto patch = patches_.back().begin();
      for (std::int16_t& excess : excess_[p].all()) {
        const int by = kPatchStep * *patch++;
        if (excess != kNoData) excess = static_cast<std::int16_t>(excess - by);
      }
    }
  }

  /// Before what lies above it is known the upper half may hold a school; then it is the half that schools must exceed. A
  /// school that keeps its place in the window and fills more than a sixth of it widens the water.
  [[nodiscard]] double width(const PlaceStatistics& told, double least) const {
    return std::max<double>(look_ == 0 ? told.below : told.above, least);
  }

  /// Sum of the whitened excess over 3 x 3 beams, over the root of their number, in 1/256.
  [[nodiscard]] Levels averaged(std::size_t p) const {
    std::vector<float> middle(cells(), 0.0F);
    std::vector<float> scale(cells(), 0.0F);
    for (std::size_t i = 0; i < cells(); ++i) {
      if (spread_[i].middle == kNoData) continue;
      middle[i] = std::max<float>(0.0F, spread_[i].middle);
      scale[i] = static_cast<float>(256.0 / width(spread_[i], counts_from_db(kLeastSpread_db)));
    }
    const auto own = excess_[p].all();
    Array3<float> sum(shape_);
    Array3<float> number(shape_);
    for_each_block(p, [&](std::size_t i, std::size_t cell) {
      const float by = own[i] == kNoData ? 0.0F : scale[cell];
      sum.all()[i] = (static_cast<float>(own[i]) - middle[cell]) * by;
      number.all()[i] = by == 0.0F ? 0.0F : 1.0F;
    });
    sum = of_three_by_three(sum);
    number = of_three_by_three(number);
    Levels out(shape_, kNoData);
    const auto of = number.all();
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (own[i] == kNoData || of[i] == 0.0F) continue;
      const float mean = std::as_const(sum).all()[i] * kPerRoot[static_cast<std::size_t>(of[i])];
      out.all()[i] = static_cast<std::int16_t>(std::clamp(mean, -32000.0F, 32000.0F));
    }
    return out;
  }

  void find_evidence() {
    evidence_.clear();
    for (std::size_t p = 0; p < pings_.size(); ++p) evidence_.push_back(averaged(p));
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
    const auto values = evidence_[p].all();
    for_each_block(p, [&](std::size_t i, std::size_t cell) {
      if (values[i] < needed[cell]) return;  // kNoData is
      const PlaceStatistics& own = own_[cell];
      const double evidence = (values[i] - std::max<int>(0, own.middle)) / width(own, 128.0);
      const auto blocks = static_cast<std::size_t>(shape_.samples);
      if (evidence >= least) act(static_cast<int>(i / blocks), static_cast<int>(i % blocks), evidence);
    });
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
