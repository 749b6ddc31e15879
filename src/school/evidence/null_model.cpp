// SPDX-License-Identifier: Apache-2.0
#include "school/evidence/null_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "base/units.h"
#include "school/evidence/patches.h"
#include "school/evidence/place_statistics.h"
#include "school/evidence/seabed_stretch.h"

namespace sonar {
namespace {

constexpr double kPiece_m = 1.9;         ///< a block of three is about as long as the shortest school
constexpr int kPieces = 3;               ///< of a block
constexpr double kLeastSpread_db = 0.7;  ///< of a mean over so many samples, if none were correlated
constexpr double kMasked = 6.0;          ///< what stands out so far has no say in the next looks
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
      : pings_(pings), sector_(sector), piece_(piece_samples(sector.range())), stretch_(seabed_stretch(pings, sector)) {
    const Shape3 pieces = pings.front().means->shape();
    shape_ = {pieces.fans, pieces.beams, (pieces.samples + kPieces - 1) / kPieces};
    for (std::size_t p = 0; p < pings.size(); ++p) {
      levels_.push_back(levels_of(p));
      floors_.push_back(floors_of(p));
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
    for (std::size_t p = 0; p < pings_.size(); ++p) out.push_back(answer(p, least));
    return out;
  }

 private:
  [[nodiscard]] std::size_t cells() const {
    return static_cast<std::size_t>(shape_.fans) * static_cast<std::size_t>(shape_.samples);
  }
  [[nodiscard]] std::size_t cell(int fan, int block) const {
    return static_cast<std::size_t>(fan) * static_cast<std::size_t>(shape_.samples) + static_cast<std::size_t>(block);
  }

  [[nodiscard]] double stretch(std::size_t ping, int row) const {
    return stretch_[ping].empty() ? 1.0 : static_cast<double>(stretch_[ping][static_cast<std::size_t>(row)]);
  }

  [[nodiscard]] Levels levels_of(std::size_t p) const {
    Levels levels(shape_, kNoData);
    const Array3<float>& means = *pings_[p].means;
    for (int row = 0; row < static_cast<int>(shape_.rows()); ++row) {
      const auto pieces = means.view().row(row);
      const auto out = levels.view().row(row);
      const double per_block = kPieces / stretch(p, row);
      for (int block = 0; block < shape_.samples; ++block) {
        const auto first = static_cast<std::ptrdiff_t>(std::lround(block * per_block));
        const auto end = std::min(
            std::ssize(pieces), std::max(first + 1, static_cast<std::ptrdiff_t>(std::lround((block + 1) * per_block))));
        double sum = 0.0;
        int known = 0;
        for (auto i = first; i < end; ++i) {
          const auto mean = static_cast<double>(pieces[static_cast<std::size_t>(i)]);
          if (!(mean > 0.0)) continue;
          sum += mean;
          ++known;
        }
        if (2 * known < end - first || known == 0) continue;
        const double counts =
            std::clamp(counts_from_db(db_from_linear(sum / known)), double{kMinCount}, double{kMaxCount});
        out[static_cast<std::size_t>(block)] = static_cast<std::int16_t>(std::lround(counts));
      }
    }
    return levels;
  }

  /// Mean noise of each beam at the middle of each block.
  [[nodiscard]] Levels floors_of(std::size_t p) const {
    Levels floors(shape_, kMinCount);
    const Background& noise = pings_[p].noise;
    for (int row = 0; row < static_cast<int>(shape_.rows()); ++row) {
      if (!noise.known(row)) continue;
      const double power = noise.power_counts(row);
      const auto table = noise.calibration.row(row);
      const auto out = floors.view().row(row);
      for (int block = 0; block < shape_.samples; ++block) {
        const double middle = (block + 0.5) * kPieces * piece_ / stretch(p, row);
        const auto s = std::min(table.size() - 1, static_cast<std::size_t>(middle));
        if (table[s] == kNoData) continue;
        out[static_cast<std::size_t>(block)] =
            static_cast<std::int16_t>(std::lround(std::clamp(power + table[s], double{kMinCount}, double{kMaxCount})));
      }
    }
    return floors;
  }

  void find_level() {
    water_ = statistics_of_places(levels_, masked_);
    lift_seabed();
  }

  /// Hills are heard where the ground in between is not yet: in beams that point down the water is as loud as up to
  /// where the seabed would be if it lay so much higher.
  void lift_seabed() {
    const double nearer = seabed_nearer(pings_);
    if (!(nearer < 1.0)) return;
    for (int fan = 0; fan < shape_.fans; ++fan) {
      if (sector_.elevation_rad(fan) >= 0.0) continue;
      const auto told = std::span(water_).subspan(cell(fan, 0), static_cast<std::size_t>(shape_.samples));
      for (std::size_t b = 0; b < told.size(); ++b) {
        const auto last = std::min(told.size() - 1, static_cast<std::size_t>(static_cast<double>(b) / nearer));
        std::int16_t loudest = told[b].middle;
        for (std::size_t i = b + 1; i <= last; ++i) loudest = std::max(loudest, told[i].middle);
        if (loudest - told[b].middle >= counts_from_db(kRise_db)) told[b].middle = loudest;
      }
    }
  }

  [[nodiscard]] int background(std::size_t p, int row, int block) const {
    const int floor = floors_[p].view().row(row)[static_cast<std::size_t>(block)];
    const std::int16_t water = water_[cell(row / shape_.beams, block)].middle;
    return water == kNoData ? floor : std::max(int{water}, floor);
  }

  void find_excess() {
    excess_.clear();
    for (std::size_t p = 0; p < pings_.size(); ++p) {
      Levels excess(shape_, kNoData);
      for (int row = 0; row < static_cast<int>(shape_.rows()); ++row) {
        const auto level = levels_[p].view().row(row);
        const auto out = excess.view().row(row);
        for (int block = 0; block < shape_.samples; ++block) {
          const auto b = static_cast<std::size_t>(block);
          if (level[b] == kNoData) continue;
          const int below = background(p, row, block);
          if (below <= kMinCount) continue;
          out[b] = static_cast<std::int16_t>(std::clamp(level[b] - below, -30000, 30000));
        }
      }
      excess_.push_back(std::move(excess));
    }
    level_patches();
    spread_ = statistics_of_places(excess_, masked_);
  }

  /// Takes out of each ping's excess what is wider than schools.
  void level_patches() {
    std::vector<std::int16_t> clip(cells());
    for (std::size_t i = 0; i < cells(); ++i) {
      clip[i] = static_cast<std::int16_t>(kClip * std::max<double>(water_[i].below, counts_from_db(kLeastSpread_db)));
    }
    patches_.clear();
    for (std::size_t p = 0; p < pings_.size(); ++p) {
      patches_.push_back(local_patches(std::as_const(excess_[p]).view(), std::as_const(masked_[p]).view(), clip));
      auto patch = patches_.back().begin();
      for (std::int16_t& excess : excess_[p].all()) {
        const int by = kPatchStep * *patch++;
        if (excess != kNoData) excess = static_cast<std::int16_t>(excess - by);
      }
    }
  }

  /// Before what stands out is known the upper half may hold a school; then it is the half that schools must exceed. A
  /// school that keeps its place in the window fills less than a sixth of it.
  [[nodiscard]] double width(const PlaceStatistics& told, double least) const {
    return std::max<double>(look_ == 0 ? told.below : told.above, least);
  }

  /// Sum of the whitened excess over 3 x 3 beams, over the root of their number, in 1/256.
  [[nodiscard]] Levels averaged(const Levels& excess) const {
    std::vector<float> middle(cells(), 0.0F);
    std::vector<float> scale(cells(), 0.0F);
    for (std::size_t i = 0; i < cells(); ++i) {
      if (spread_[i].middle == kNoData) continue;
      middle[i] = std::max<float>(0.0F, spread_[i].middle);
      scale[i] = static_cast<float>(256.0 / width(spread_[i], counts_from_db(kLeastSpread_db)));
    }
    Array3<float> sum(shape_);
    Array3<float> number(shape_);
    for (int row = 0; row < static_cast<int>(shape_.rows()); ++row) {
      const auto from = excess.view().row(row);
      const auto whitened = sum.view().row(row);
      const auto known = number.view().row(row);
      const std::size_t first = cell(row / shape_.beams, 0);
      for (std::size_t i = 0; i < from.size(); ++i) {
        const float by = from[i] == kNoData ? 0.0F : scale[first + i];
        whitened[i] = (static_cast<float>(from[i]) - middle[first + i]) * by;
        known[i] = by == 0.0F ? 0.0F : 1.0F;
      }
    }
    sum = of_three_by_three(sum);
    number = of_three_by_three(number);
    Levels out(shape_, kNoData);
    const auto own = excess.all();
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
    for (const Levels& excess : excess_) evidence_.push_back(averaged(excess));
    own_ = statistics_of_places(evidence_, masked_);
  }

  [[nodiscard]] double evidence(std::size_t p, int row, int block) const {
    const std::int16_t value = evidence_[p].view().row(row)[static_cast<std::size_t>(block)];
    const PlaceStatistics& own = own_[cell(row / shape_.beams, block)];
    if (value == kNoData || own.middle == kNoData) return -std::numeric_limits<double>::infinity();
    return (value - std::max<int>(0, own.middle)) / width(own, 128.0);
  }

  /// Once masked, always masked: a school that keeps its place would else have a say again as soon as it has none.
  void mask(std::size_t p) {
    Marks& marks = masked_[p];
    for (int fan = 0; fan < shape_.fans; ++fan) {
      for (int beam = 0; beam < shape_.beams; ++beam) {
        for (int block = 0; block < shape_.samples; ++block) {
          if (evidence(p, fan * shape_.beams + beam, block) < kMasked) continue;
          for (int f = std::max(0, fan - 1); f <= std::min(shape_.fans - 1, fan + 1); ++f) {
            for (int b = std::max(0, beam - 1); b <= std::min(shape_.beams - 1, beam + 1); ++b) {
              for (int s = std::max(0, block - 1); s <= std::min(shape_.samples - 1, block + 1); ++s)
                marks(f, b, s) = 1;
            }
          }
        }
      }
    }
  }

  [[nodiscard]] WaterLevels answer(std::size_t p, double least) const {
    WaterLevels out;
    out.block_samples = kPieces * piece_;
    out.blocks = shape_.samples;
    out.stretch = stretch_[p];
    out.patch = patches_[p];
    for (std::size_t i = 0; i < cells(); ++i) {
      out.level.push_back(water_[i].middle == kNoData ? std::int16_t{kMinCount} : water_[i].middle);
      out.reach.push_back(spread_[i].middle == kNoData ? std::int16_t{0}
                                                       : static_cast<std::int16_t>(width(spread_[i], 0.0)));
    }
    for (int row = 0; row < static_cast<int>(shape_.rows()); ++row) {
      for (int block = 0; block < shape_.samples; ++block) {
        const double found = evidence(p, row, block);
        if (found >= least) out.cells.push_back({row, block, static_cast<float>(found)});
      }
    }
    return out;
  }

  std::span<const WaterPing> pings_;
  const Sector& sector_;
  int piece_;
  int look_ = 0;
  std::vector<std::vector<float>> stretch_;  ///< [ping][row]
  Shape3 shape_;                             ///< fans, beams, blocks
  std::vector<Levels> levels_;
  std::vector<Levels> floors_;
  std::vector<Levels> excess_;
  std::vector<std::vector<std::int8_t>> patches_;  ///< [ping][row][block]
  std::vector<Levels> evidence_;
  std::vector<Marks> masked_;
  std::vector<PlaceStatistics> water_;
  std::vector<PlaceStatistics> spread_;
  std::vector<PlaceStatistics> own_;
};

}  // namespace

int piece_samples(const RangeAxis& range) {
  return std::max(1, static_cast<int>(std::lround(kPiece_m / range.spacing_m)));
}

std::vector<WaterLevels> water_levels(std::span<const WaterPing> window, const Sector& sector, double least) {
  if (window.empty()) return {};
  return Window(window, sector).run(least);
}

}  // namespace sonar
