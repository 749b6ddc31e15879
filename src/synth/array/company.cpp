// SPDX-License-Identifier: Apache-2.0
#include "synth/array/company.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "synth/array/fish.h"
#include "synth/random.h"

namespace sonar::synth::array {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kShallowest_m = 0.3;

/// A complex amplitude of many in one place: Gaussian, of this mean squared size.
std::complex<double> gathered(double mean_m2, RandomStream& random) {
  const double size = std::sqrt(mean_m2 / 2.0);
  const double re = random.normal();
  return {size * re, size * random.normal()};
}

/// Gathers one thing's echoes.
class Gathering {
 public:
  Gathering(CompanyKind kind, const View& view, double reach_m) : view_(view), reach_m_(reach_m), out_{kind, {}, {}} {}
  void add(Point<Enu> at, std::complex<double> amplitude, double mean_m2) {
    at.z = std::min(at.z, -view_.transducer_m.z - kShallowest_m);
    const double r = norm(at);
    if (r > reach_m_) return;
    const Direction from = view_.heard(at);
    if (from.abeam <= 0.0) return;
    out_.echoes.push_back({from, r, amplitude, mean_m2});
    out_.places.push_back(at);
  }
  void hand_on(const std::function<void(const CompanyEchoes&)>& use) const {
    if (!out_.echoes.empty()) use(out_);
  }

 private:
  const View& view_;
  double reach_m_;
  CompanyEchoes out_;
};

struct Seen {
  const View& view;
  std::uint64_t seed;
  std::uint32_t observation;
  int ping;
  double reach_m;
  [[nodiscard]] RandomStream drawn(std::uint32_t thing) const {
    return {seed, Purpose::cloud, observation, static_cast<std::uint32_t>(ping), thing};
  }
};

void hull_cloud(const HullCloud& c, const Seen& seen, std::uint32_t thing,
                const std::function<void(const CompanyEchoes&)>& use) {
  constexpr int kEchoes = 250;
  RandomStream random = seen.drawn(thing);
  Gathering gathering(CompanyKind::hull_bubbles, seen.view, seen.reach_m);
  const double now = 1.0 + 0.6 * std::sin(kTurn * seen.view.seconds / c.period_s + c.phase);
  const double each = c.backscatter_m2 * now / kEchoes;
  for (int i = 0; i < kEchoes; ++i) {
    const double bow = c.bow_m + c.long_m * random.normal();
    const double port = c.port_m + c.wide_m * random.normal();
    const double up = -c.depth_m + c.high_m * random.normal() - seen.view.transducer_m.z;
    gathering.add(seen.view.from_ship(bow, port, up), gathered(each, random), each);
  }
  gathering.hand_on(use);
}

void plume(const Plume& p, double wind_rad, const Seen& seen, std::uint32_t thing,
           const std::function<void(const CompanyEchoes&)>& use) {
  constexpr int kEchoes = 60;
  const double age = seen.view.seconds - p.born_s;
  if (age < 0.0 || age > 4.0 * p.fades_s) return;
  const Point<Enu> centre = seen.view.in_scene({}) * -1.0 + Point<Enu>{p.east_m, p.north_m, 0.0};
  if (std::hypot(centre.x, centre.y) > seen.reach_m + p.length_m) return;
  if (seen.view.along_ship(centre).y > p.length_m) return;  // on the other side
  RandomStream random = seen.drawn(thing);
  Gathering gathering(CompanyKind::plume, seen.view, seen.reach_m);
  // It grows within some seconds and fades over minutes.
  constexpr double kGrows_s = 6.0;
  const double each = p.backscatter_m2 * (1.0 - std::exp(-age / kGrows_s)) * std::exp(-age / p.fades_s) / kEchoes;
  const Point<Enu> middle = seen.view.from_transducer({p.east_m, p.north_m, 0.0});
  const double s = std::sin(wind_rad);
  const double c = std::cos(wind_rad);
  for (int i = 0; i < kEchoes; ++i) {
    const double down = p.length_m * random.uniform(-0.5, 0.5);
    const double across = p.width_m * random.uniform(-0.5, 0.5);
    const double deep = -p.depth_m * std::log(random.uniform());
    gathering.add({middle.x + down * s + across * c, middle.y + down * c - across * s, middle.z - deep},
                  gathered(each, random), each);
  }
  gathering.hand_on(use);
}

}  // namespace

void for_each_company(const Sea& sea, const FishParams& fish, double wave_number, const View& view, std::uint64_t seed,
                      std::uint32_t observation, int ping, double reach_m,
                      const std::function<void(const CompanyEchoes&)>& use) {
  const Seen seen{view, seed, observation, ping, reach_m};
  std::uint32_t thing = 0;
  for (const HullCloud& c : sea.hull) hull_cloud(c, seen, thing++, use);
  for (const Plume& p : sea.plumes) plume(p, sea.wind_rad, seen, thing++, use);
  for (const LoneFish& one : sea.lone) {
    RandomStream random = seen.drawn(thing++);
    const Point<Enu> in_scene = one.at_m + one.velocity_mps * view.seconds;
    const Point<Enu> rough = in_scene - view.transducer_m;
    if (norm(rough) > reach_m || view.along_ship(rough).y > 0.0) continue;
    if (sea.terrain.there && -in_scene.z > sea.terrain.depth_at(in_scene.x, in_scene.y)) continue;
    const Point<Enu> at = view.from_transducer(in_scene);
    const double heading = std::atan2(one.velocity_mps.x, one.velocity_mps.y);
    const Point<Enu> axis = fish_axis(heading + 0.15 * random.normal(), 0.15 * random.normal());
    const double along = (axis.x * at.x + axis.y * at.y + axis.z * at.z) / std::max(1.0, norm(at));
    const double m2 = one.broadside_m2 * aspect(fish, wave_number, one.length_cm, along);
    Gathering gathering(CompanyKind::single_fish, view, reach_m);
    gathering.add(at, std::sqrt(m2), m2);
    gathering.hand_on(use);
  }
}

}  // namespace sonar::synth::array
