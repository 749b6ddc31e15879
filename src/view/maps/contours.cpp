// SPDX-License-Identifier: Apache-2.0
#include "view/maps/contours.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sonar {
namespace {

/// Edges are numbered 2 (y width + x) for the one to the right of a node, + 1 for the one below it. Each is crossed at
/// most once, and met by at most two segments.
class Tracer {
 public:
  Tracer(const ScalarField& field, double level)
      : field_(field), level_(level), next_(2 * field.values.size(), {kNone, kNone}) {}

  std::vector<ContourLine> lines() {
    for (int y = 0; y + 1 < field_.size.height; ++y) {
      for (int x = 0; x + 1 < field_.size.width; ++x) visit(x, y);
    }
    std::vector<ContourLine> out;
    // Open lines first, from an end; what is left is closed.
    for (const std::size_t e : touched_) {
      if ((next_[e][0] == kNone) != (next_[e][1] == kNone)) out.push_back(follow(e, false));
    }
    for (const std::size_t e : touched_) {
      if (next_[e][0] != kNone && next_[e][1] != kNone) out.push_back(follow(e, true));
    }
    return out;
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  [[nodiscard]] double value(int x, int y) const { return static_cast<double>(field_.at(x, y)); }
  [[nodiscard]] bool above(double v) const { return v >= level_; }
  [[nodiscard]] std::size_t edge(int x, int y, bool down) const {
    return 2 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(field_.size.width) +
                static_cast<std::size_t>(x)) +
           (down ? 1U : 0U);
  }

  void visit(int x, int y) {
    const std::array<double, 4> v{value(x, y), value(x + 1, y), value(x + 1, y + 1), value(x, y + 1)};
    const double mean = (v[0] + v[1] + v[2] + v[3]) / 4.0;
    if (std::isnan(mean)) return;
    const std::array<std::size_t, 4> edges{edge(x, y, false), edge(x + 1, y, true), edge(x, y + 1, false),
                                           edge(x, y, true)};
    std::array<std::size_t, 4> crossed{};
    std::size_t n = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (above(v[i]) != above(v[(i + 1) % 4])) crossed[n++] = edges[i];
    }
    if (n == 2) {
      link(crossed[0], crossed[1]);
    } else if (n == 4) {
      // Crossed edges go round: top, right, bottom, left. The mean says which corners hang together.
      const bool joined = above(mean) == above(v[0]);
      link(crossed[0], crossed[joined ? 1 : 3]);
      link(crossed[2], crossed[joined ? 3 : 1]);
    }
  }

  void link(std::size_t a, std::size_t b) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
      if (next_[from][0] == kNone && next_[from][1] == kNone) touched_.push_back(from);
      (next_[from][0] == kNone ? next_[from][0] : next_[from][1]) = to;
    }
  }

  [[nodiscard]] PixelPoint point(std::size_t e) const {
    const auto width = static_cast<std::size_t>(field_.size.width);
    const int x = static_cast<int>(e / 2 % width);
    const int y = static_cast<int>(e / 2 / width);
    const bool down = e % 2 == 1;
    const double a = value(x, y);
    const double b = down ? value(x, y + 1) : value(x + 1, y);
    const double t = std::clamp((level_ - a) / (b - a), 0.0, 1.0);
    return {x + (down ? 0.0 : t), y + (down ? t : 0.0)};
  }

  ContourLine follow(std::size_t start, bool closed) {
    ContourLine line;
    line.closed = closed;
    std::size_t e = start;
    while (e != kNone) {
      line.points.push_back(point(e));
      const std::size_t after = next_[e][0] != kNone ? next_[e][0] : next_[e][1];
      next_[e] = {kNone, kNone};
      if (after == kNone) break;
      (next_[after][0] == e ? next_[after][0] : next_[after][1]) = kNone;
      e = after == start ? kNone : after;
    }
    return line;
  }

  const ScalarField& field_;
  double level_;
  std::vector<std::array<std::size_t, 2>> next_;
  std::vector<std::size_t> touched_;
};

}  // namespace

std::vector<ContourLine> contour_lines(const ScalarField& field, double level) { return Tracer(field, level).lines(); }

}  // namespace sonar
