// SPDX-License-Identifier: Apache-2.0
#include "signal/beam_pattern_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/middle.h"
#include "base/units.h"
#include "signal/beam_hits.h"
#include "signal/level_misfit.h"
#include "signal/skyline.h"

namespace sonar {
namespace {

constexpr double kEdge_db = kHalfBothWays_db;
constexpr std::size_t kFigures = BeamErrors::kFigures;

/// Standard deviations of what is known beforehand.
constexpr double kLevelKnown_db = 10.0;
constexpr double kLogStretchKnown = 0.5;  ///< all widths against those stated, one factor across and one up
constexpr double kLogWidthKnown = 0.05;   ///< of a beam against its stretched one: the same elements make all beams
constexpr double kCentreKnown = 0.02;     ///< of a width: the stated steering
constexpr double kShapeKnown = 3.0;

/// Where Tukey's weights end, in standard deviations.
constexpr double kTukey = 4.685;
constexpr int kLeastBeams = 4;
/// Of a width: towards the ends of what the sphere crossed the scale of the directions is known no better, for it follows
/// from beams whose form differs.
constexpr double kScaleKnown = 0.03;
constexpr double kSettled = 1e-3;  ///< dB and widths
constexpr int kMostIterations = 40;
constexpr int kUnguarded = 4;  ///< iterations before outliers are left out: the start may be some dB off
constexpr int kSettling = 8;   ///< iterations before whole pings are left out, for good

double square(double x) { return x * x; }

double limited(double step, double most) { return std::clamp(step, -most, most); }

class Fitter {
 public:
  Fitter(const std::vector<FittedBeam>& stated, const std::vector<HeardLevel>& heard, int pings)
      : stated_(stated), heard_(heard), of_ping_(static_cast<std::size_t>(pings)), normal_(unknowns()) {
    fit_.beams = stated;
    fit_.errors.resize(stated.size());
    fit_.crossed.resize(stated.size());
    fit_.directions.resize(of_ping_.size());
    fit_.used.resize(of_ping_.size());
    for (std::size_t i = 0; i < heard.size(); ++i) of_ping_[static_cast<std::size_t>(heard[i].ping)].push_back(i);
    misfits_.resize(heard.size());
    disturbed_.resize(of_ping_.size());
    hears_.resize(stated.size());
    for (std::size_t i = 0; i < heard.size(); ++i) hears_[beam(i)] = true;
    for (std::size_t k = 0; k < kShared; ++k) normal_.reach(shared() + k, 0);
    std::vector<std::size_t> first(stated.size());  // [beam] the first beam that shares a ping with it
    for (std::size_t b = 0; b < first.size(); ++b) first[b] = b;
    for (const auto& ping : of_ping_) {
      std::size_t least = stated.size();
      for (const std::size_t i : ping) least = std::min(least, beam(i));
      for (const std::size_t i : ping) first[beam(i)] = std::min(first[beam(i)], least);
    }
    for (std::size_t row = 0; row < stated.size() * kFigures; ++row) {
      normal_.reach(row, first[row / kFigures] * kFigures);
    }
  }

  PatternFit run() {
    for (std::size_t p = 0; p < of_ping_.size(); ++p) begin(p);
    for (int i = 0; i < kMostIterations; ++i) {
      fit_.iterations = i + 1;
      const bool guarded = i >= kUnguarded;
      settle_directions(guarded);
      if (i >= kSettling) leave_out_disturbed();
      set_scale();
      count_hits();
      const double step = improve();
      if (i > kSettling && step < kSettled) break;
    }
    settle_directions(true);
    count_hits();
    finish();
    return std::move(fit_);
  }

 private:
  /// What all beams share: the form, then the stretch of widths across and up.
  static constexpr std::size_t kShared = kShapes + 2;
  [[nodiscard]] std::size_t shared() const { return stated_.size() * kFigures; }
  [[nodiscard]] std::size_t unknowns() const { return shared() + kShared; }
  [[nodiscard]] std::size_t beam(std::size_t heard) const { return static_cast<std::size_t>(heard_[heard].beam); }
  [[nodiscard]] std::size_t row(std::size_t heard) const { return beam(heard) * kFigures; }

  /// Where the strongest beams look.
  void begin(std::size_t p) {
    double sum = 0.0;
    FaceDirection at;
    for (const std::size_t i : of_ping_[p]) {
      const FittedBeam& beam = stated_[static_cast<std::size_t>(heard_[i].beam)];
      const double power = linear_from_db(heard_[i].level_db - beam.level_db);
      at.across += power * beam.centre.across;
      at.up += power * beam.centre.up;
      sum += power;
    }
    if (sum > 0.0) fit_.directions[p] = {at.across / sum, at.up / sum};
  }

  DirectionEquations direct(std::size_t p, bool guarded) {
    DirectionEquations d;
    for (const std::size_t i : of_ping_[p]) {
      misfits_[i] = misfit(heard_[i], fit_.beams[beam(i)], stated_[beam(i)], fit_.shape, fit_.directions[p],
                           guarded ? kTukey * scale_ : 0.0);
      d.add(misfits_[i]);
    }
    return d;
  }

  /// The directions that suit the beams as they are.
  void settle_directions(bool guarded) {
    constexpr int kSteps = 6;
    for (std::size_t p = 0; p < of_ping_.size(); ++p) {
      bool sound = true;
      for (int step = 0; step < kSteps && sound; ++step) {
        const DirectionEquations d = direct(p, guarded);
        sound = d.sound();
        if (!sound) break;
        const auto move = d.solve(d.ga, d.gu);
        const FittedBeam& beam = stated_[static_cast<std::size_t>(heard_[of_ping_[p].front()].beam)];
        fit_.directions[p].across += limited(move[0], beam.width_across / 3.0);
        fit_.directions[p].up += limited(move[1], beam.width_up / 3.0);
      }
      int beams = 0;
      int refused = 0;
      const bool still = direct(p, guarded).sound() && sound;
      for (const std::size_t i : of_ping_[p]) {
        if (misfits_[i].under_top_db <= kFormEnds_db) continue;
        ++beams;
        if (misfits_[i].weight <= 0.0) ++refused;
      }
      fit_.used[p] = !disturbed_[p] && still && beams - refused >= kLeastBeams && refused <= beams / 3;
      if (!fit_.used[p]) leave_out(p);
    }
  }

  void leave_out(std::size_t p) {
    fit_.used[p] = false;
    for (const std::size_t i : of_ping_[p]) misfits_[i].weight = 0.0;
  }

  /// A fish beside the sphere is heard by several beams, by some so little that they look sound: the whole ping goes where
  /// its levels fit together much worse than those of other pings.
  void leave_out_disturbed() {
    constexpr double kMuchWorse = 1.7;
    std::vector<double> misfit_of(of_ping_.size());
    std::vector<double> sorted;
    for (std::size_t p = 0; p < of_ping_.size(); ++p) {
      if (!fit_.used[p]) continue;
      double sum = 0.0;
      double shares = 0.0;
      for (const std::size_t i : of_ping_[p]) {
        sum += misfits_[i].share * square(misfits_[i].excess);
        shares += misfits_[i].share;
      }
      misfit_of[p] = std::sqrt(sum / shares);
      sorted.push_back(misfit_of[p]);
    }
    if (sorted.empty()) return;
    const double most = kMuchWorse * std::max(1.0, middle_of(std::move(sorted)));
    for (std::size_t p = 0; p < of_ping_.size(); ++p) {
      if (misfit_of[p] <= most) continue;
      disturbed_[p] = true;
      leave_out(p);
    }
  }

  /// Spread of the residuals in their own standard errors, by their median.
  void set_scale() {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < heard_.size(); ++i) {
      const Misfit& m = misfits_[i];
      if (m.weight <= 0.0 || m.under_top_db < kFormHolds_db) continue;
      sizes.push_back(m.excess);
    }
    if (sizes.empty()) return;
    // Never below what is known of the errors: what a direction takes away of them would leave out ever more levels.
    scale_ = std::max(1.0, kStandardOverMiddleDeviation * middle_of(std::move(sizes)));
  }

  void count_hits() {
    BeamHits hits = hits_of(fit_.beams, heard_, misfits_, fit_.directions);
    fit_.hits = std::move(hits.count);
    fit_.crossed = std::move(hits.crossed);
  }

  /// Figures of a ping's beams and of the form, each with what ties it to the ping's direction.
  struct Tied {
    std::size_t row;
    std::array<double, 2> to;
  };

  void fill_normal(std::vector<double>& g, std::vector<std::vector<Tied>>& ties,
                   std::vector<DirectionEquations>& directs) {
    normal_.clear();
    std::fill(g.begin(), g.end(), 0.0);
    for (std::size_t b = 0; b < stated_.size(); ++b) hold_to_stated(b, g);
    for (std::size_t k = 0; k < kShared; ++k) {
      const double known = k < kShapes ? kShapeKnown : kLogStretchKnown;
      const double now = k < kShapes ? fit_.shape.k[k] : log_stretch_[k - kShapes];
      normal_.at(shared() + k, shared() + k) += 1.0 / square(known);
      g[shared() + k] -= now / square(known);
    }
    for (std::size_t p = 0; p < of_ping_.size(); ++p) {
      ties[p].clear();
      if (!fit_.used[p]) continue;
      add_ping(p, g, ties[p], directs[p]);
    }
  }

  /// A beam that hears nothing stays, whatever is stated of it.
  void hold_to_stated(std::size_t b, std::vector<double>& g) {
    if (!hears_[b]) {
      for (std::size_t f = 0; f < kFigures; ++f) normal_.at(b * kFigures + f, b * kFigures + f) += 1.0;
      return;
    }
    const FittedBeam& now = fit_.beams[b];
    const FittedBeam& was = stated_[b];
    const std::array<double, kFigures> off = {
        now.level_db - was.level_db, std::log(now.width_across / was.width_across) - log_stretch_[0],
        std::log(now.width_up / was.width_up) - log_stretch_[1],
        (now.centre.across - was.centre.across) / was.width_across, (now.centre.up - was.centre.up) / was.width_up};
    constexpr std::array<double, kFigures> known = {kLevelKnown_db, kLogWidthKnown, kLogWidthKnown, kCentreKnown,
                                                    kCentreKnown};
    for (std::size_t f = 0; f < kFigures; ++f) {
      const std::size_t i = b * kFigures + f;
      normal_.at(i, i) += 1.0 / square(known[f]);
      g[i] -= off[f] / square(known[f]);
    }
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
      const std::size_t i = b * kFigures + BeamErrors::log_width_across + k;
      const std::size_t stretch = shared() + kShapes + k;
      normal_.at(stretch, stretch) += 1.0 / square(kLogWidthKnown);
      normal_.at(stretch, i) -= 1.0 / square(kLogWidthKnown);
      g[stretch] += off[BeamErrors::log_width_across + k] / square(kLogWidthKnown);
    }
  }

  void add_ping(std::size_t p, std::vector<double>& g, std::vector<Tied>& ties, DirectionEquations& direct) {
    const std::size_t shapes = shared();
    direct = {};
    std::array<Tied, kShapes> of_shape{};
    for (std::size_t k = 0; k < kShapes; ++k) of_shape[k].row = shapes + k;
    for (const std::size_t i : of_ping_[p]) {
      const Misfit& m = misfits_[i];
      if (m.weight <= 0.0) continue;
      const double w = m.weight;
      direct.add(m);
      for (std::size_t f = 0; f < kFigures; ++f) {
        const double wf = w * m.by_beam[f];
        for (std::size_t e = 0; e <= f; ++e) normal_.at(row(i) + f, row(i) + e) += wf * m.by_beam[e];
        for (std::size_t k = 0; k < kShapes; ++k) normal_.at(shapes + k, row(i) + f) += wf * m.by_shape[k];
        g[row(i) + f] += wf * m.residual_db;
        ties.push_back({row(i) + f, {wf * m.by_direction[0], wf * m.by_direction[1]}});
      }
      for (std::size_t k = 0; k < kShapes; ++k) {
        const double wk = w * m.by_shape[k];
        for (std::size_t e = 0; e <= k; ++e) normal_.at(shapes + k, shapes + e) += wk * m.by_shape[e];
        g[shapes + k] += wk * m.residual_db;
        of_shape[k].to[0] += wk * m.by_direction[0];
        of_shape[k].to[1] += wk * m.by_direction[1];
      }
    }
    ties.insert(ties.end(), of_shape.begin(), of_shape.end());
    // The direction is eliminated: what it takes from the other unknowns.
    const auto moved = direct.solve(direct.ga, direct.gu);
    for (const Tied& one : ties) {
      const auto by = direct.solve(one.to[0], one.to[1]);
      for (const Tied& other : ties) {
        if (other.row <= one.row) normal_.at(one.row, other.row) -= by[0] * other.to[0] + by[1] * other.to[1];
      }
      g[one.row] -= one.to[0] * moved[0] + one.to[1] * moved[1];
    }
  }

  /// One step of everything together. returns  the largest change, in widths and dB
  double improve() {
    std::vector<double> step(unknowns());
    std::vector<std::vector<Tied>> ties(of_ping_.size());
    std::vector<DirectionEquations> directs(of_ping_.size());
    fill_normal(step, ties, directs);
    const auto root = SkylineRoot::of(normal_);
    if (!root) return 0.0;
    root->solve(step);
    double most = 0.0;
    for (std::size_t b = 0; b < stated_.size(); ++b) {
      const auto at = [&](std::size_t f, double limit) {
        const double change = limited(step[b * kFigures + f], limit);
        if (fit_.crossed[b]) most = std::max(most, std::abs(change));
        return change;
      };
      FittedBeam& beam = fit_.beams[b];
      beam.level_db += at(BeamErrors::level_db, 3.0);
      beam.width_across *= std::exp(at(BeamErrors::log_width_across, 0.2));
      beam.width_up *= std::exp(at(BeamErrors::log_width_up, 0.2));
      beam.centre.across += at(BeamErrors::centre_across, 0.1) * stated_[b].width_across;
      beam.centre.up += at(BeamErrors::centre_up, 0.1) * stated_[b].width_up;
    }
    for (std::size_t k = 0; k < kShapes; ++k) {
      fit_.shape.k[k] += limited(step[shared() + k], 0.5);
    }
    for (std::size_t k = 0; k < 2; ++k) log_stretch_[k] += limited(step[shared() + kShapes + k], 0.2);
    for (std::size_t p = 0; p < of_ping_.size(); ++p) {
      if (!fit_.used[p]) continue;
      double a = directs[p].ga;
      double u = directs[p].gu;
      for (const Tied& tied : ties[p]) {
        a -= tied.to[0] * step[tied.row];
        u -= tied.to[1] * step[tied.row];
      }
      const auto move = directs[p].solve(a, u);
      const FittedBeam& beam = stated_[static_cast<std::size_t>(heard_[of_ping_[p].front()].beam)];
      fit_.directions[p].across += limited(move[0], beam.width_across / 3.0);
      fit_.directions[p].up += limited(move[1], beam.width_up / 3.0);
    }
    return most;
  }

  void finish() {
    fit_.residual_db.assign(heard_.size(), std::numeric_limits<double>::quiet_NaN());
    const std::vector<double> taken = leverage(heard_, misfits_, of_ping_, fit_.used);
    double squares = 0.0;
    double weights = 0.0;
    double unexplained = 0.0;
    double hits = 0.0;
    double freedom = 0.0;
    for (std::size_t i = 0; i < heard_.size(); ++i) {
      const Misfit& m = misfits_[i];
      if (m.weight <= 0.0) continue;
      fit_.residual_db[i] = m.residual_db;
      squares += m.weight * square(m.residual_db);
      weights += m.weight;
      freedom += 1.0 - taken[i];
      if (m.under_top_db < -kEdge_db) continue;
      unexplained += square(m.residual_db) - (1.0 - taken[i]) * square(heard_[i].se_db);
      hits += 1.0 - taken[i];
    }
    if (weights > 0.0) fit_.residual_rms_db = std::sqrt(squares / weights);
    if (unexplained > 0.0) fit_.form_se_db = std::sqrt(unexplained / hits);
    set_errors(squares / std::max(1.0, freedom));
  }

  /// variance  of a level of weight 1
  void set_errors(double variance) {
    std::vector<double> g(unknowns());
    std::vector<std::vector<Tied>> ties(of_ping_.size());
    std::vector<DirectionEquations> directs(of_ping_.size());
    fill_normal(g, ties, directs);
    const auto root = SkylineRoot::of(normal_);
    if (!root) return;
    for (std::size_t b = 0; b < stated_.size(); ++b) {
      if (fit_.hits[b] == 0) continue;
      std::array<std::size_t, kFigures> rows{};
      for (std::size_t f = 0; f < kFigures; ++f) rows[f] = b * kFigures + f;
      const std::vector<double> inverse = root->inverse_among(rows);
      auto& covariance = fit_.errors[b].covariance;
      for (std::size_t f = 0; f < kFigures; ++f) {
        for (std::size_t e = 0; e < kFigures; ++e) covariance[f][e] = variance * inverse[f * kFigures + e];
      }
      // An error of the form at the top is one of the level; at the -6 dB contour, where a level changes by twice 6 dB with
      // the logarithm of a width, one of the width.
      covariance[BeamErrors::level_db][BeamErrors::level_db] += square(fit_.form_se_db);
      for (const auto width : {BeamErrors::log_width_across, BeamErrors::log_width_up}) {
        covariance[width][width] += square(fit_.form_se_db / (2.0 * kEdge_db)) + square(kScaleKnown);
      }
    }
  }

  const std::vector<FittedBeam>& stated_;
  const std::vector<HeardLevel>& heard_;
  std::vector<std::vector<std::size_t>> of_ping_;  ///< [ping] -> indices of heard
  std::vector<Misfit> misfits_;                    ///< [heard]
  std::vector<bool> disturbed_;                    ///< [ping]
  std::vector<bool> hears_;                        ///< [beam]
  Skyline normal_;
  std::array<double, 2> log_stretch_{};  ///< across, up
  double scale_ = 1.0;
  PatternFit fit_;
};

}  // namespace

PatternFit fit_patterns(const std::vector<FittedBeam>& stated, const std::vector<HeardLevel>& heard, int pings) {
  return Fitter(stated, heard, pings).run();
}

}  // namespace sonar
