// SPDX-License-Identifier: Apache-2.0
#include "synth/array/fish_school.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace sonar::synth::array {
namespace {

constexpr double kLowest = 0.66;   ///< sine of the steepest elevation at which a school's middle is put
constexpr double kHighest = 0.02;  ///< ... and of the flattest
constexpr int kTries = 80;

Point<Own> drawn_size(FormKind kind, const ArrayParams& p, RandomStream& random) {
  const double length = random.uniform(p.length_min_m, p.length_max_m);
  const double flat = random.uniform(0.2, 0.45);
  switch (kind) {
    case FormKind::ring:
      return {length, length, std::min(20.0, 0.3 * length)};
    case FormKind::crescent:
      return {length, 0.6 * length, std::clamp(flat * length, 5.0, 20.0)};
    case FormKind::sheets:
      return {length, 0.7 * length, random.uniform(10.0, 22.0)};
    case FormKind::column: {
      const double wide = std::max(8.0, 0.35 * length);
      return {wide, wide, random.uniform(20.0, 55.0)};
    }
    case FormKind::hourglass:
    case FormKind::tadpole:
      return {length, 0.45 * length, std::clamp(flat * length, 5.0, 18.0)};
    case FormKind::vacuolated:
    case FormKind::amoeba:
      return {length, random.uniform(0.55, 0.9) * length, std::clamp(flat * length, 6.0, 25.0)};
  }
  return {length, length, length};
}

/// A place, a course and a depth; tried until one is free.
class Placing {
 public:
  Placing(const SchoolSetting& setting, RandomStream& random) : g_(setting), random_(random) {}

  /// false  no room
  bool place(School& school, int index) {
    for (int i = 0; i < kTries; ++i) {
      if (attempt(school, index)) return true;
    }
    return false;
  }
  void keep(const School& school, double abeam_s) { placed_.push_back({&school, abeam_s}); }
  [[nodiscard]] double abeam_s() const { return abeam_s_; }

 private:
  bool attempt(School& school, int index) {
    const ArrayParams& p = g_.params;
    const double lasts_s = g_.voyage.seconds_of(g_.voyage.pings);
    abeam_s_ = lasts_s * std::clamp((index + random_.uniform(-0.2, 1.2)) / std::max(1, p.schools), 0.03, 0.97);
    const double range = random_.uniform(p.range_min_m, p.range_max_m);
    const double course = random_.uniform(0.0, 2.0 * std::numbers::pi);
    const double speed = random_.uniform(0.0, p.own_speed_max_mps);
    school.velocity_mps = {speed * std::sin(course), speed * std::cos(course), 0.0};
    school.heading_rad = course;
    school.axis_rad = course + random_.normal() * 0.4;
    const double regime = random_.uniform();
    const double drawn = random_.uniform();
    const double abeam = rad_from_deg(g_.voyage.ship.course_deg) - std::numbers::pi / 2.0;
    const Point<Enu> ship = ship_at(g_.voyage, abeam_s_);
    const double bottom = bottom_m(ship.x + range * std::sin(abeam), ship.y + range * std::cos(abeam));
    const double half = school.form.half_m().z;
    const double transducer = g_.voyage.ship.transducer_depth_m;
    const double shallowest = std::max(half + 1.5, transducer + kHighest * range);
    const double deepest = std::min(transducer + kLowest * range, bottom - half - 1.0);
    if (deepest < shallowest) return false;
    double depth = shallowest + drawn * (deepest - shallowest);
    const bool stands = school.form.kind() == FormKind::column;
    if ((regime < 0.25 || stands) && bottom - half - 8.0 < deepest) {
      depth = std::max(shallowest, bottom - half - (stands ? 1.0 : 1.0 + 7.0 * drawn));
    } else if (regime > 0.75) {
      depth = std::min(deepest, half + 1.5 + 5.0 * drawn);
    }
    const double level = std::sqrt(std::max(0.0, range * range - (depth - transducer) * (depth - transducer)));
    const Point<Enu> there{ship.x + level * std::sin(abeam), ship.y + level * std::cos(abeam), -depth};
    school.centre_m = there - school.velocity_mps * abeam_s_;
    return is_free(school);
  }

  [[nodiscard]] double bottom_m(double east, double north) const {
    constexpr double kNone_m = 1e6;
    return g_.terrain.there ? g_.terrain.depth_at(east, north) : kNone_m;
  }

  [[nodiscard]] bool is_free(const School& school) const {
    for (const auto& [other, seconds] : placed_) {
      for (const double t : {abeam_s_, seconds}) {
        const Point<Enu> apart = school.centre_at(t) - other->centre_at(t);
        const double level = std::hypot(apart.x, apart.y);
        const double wide = 1.3 * (school.form.half_m().x + other->form.half_m().x) + 15.0;
        if (level < wide) return false;
      }
    }
    return true;
  }

  const SchoolSetting& g_;
  RandomStream& random_;
  double abeam_s_ = 0.0;
  std::vector<std::pair<const School*, double>> placed_;
};

}  // namespace

Point<Enu> School::offset_at(const Point<Own>& at_rest, double seconds) const {
  const Point<Own> p = form.place(at_rest, seconds);
  const double s = std::sin(axis_rad);
  const double c = std::cos(axis_rad);
  return {p.x * s + p.y * c, p.x * c - p.y * s, p.z};
}

void fill_school(School& school, const FishParams& params, double wave_number, std::uint64_t seed,
                 std::uint32_t observation) {
  RandomStream random(seed, Purpose::fish, observation, static_cast<std::uint32_t>(school.id));
  const Point<Own> half = school.form.half_m();
  const auto anywhere = [&] {
    const double x = random.uniform(-half.x, half.x);
    const double y = random.uniform(-half.y, half.y);
    return Point<Own>{x, y, random.uniform(-half.z, half.z)};
  };
  constexpr int kProbes = 20000;
  constexpr double kInhabited = 0.05;
  double density = 0.0;
  int inhabited = 0;
  for (int i = 0; i < kProbes; ++i) {
    const double here = school.form.density(anywhere());
    density += here;
    inhabited += here > kInhabited ? 1 : 0;
  }
  const double box_m3 = 8.0 * half.x * half.y * half.z;
  school.volume_m3 = box_m3 * inhabited / kProbes;
  const double fish = school.per_m3 * box_m3 * density / kProbes;
  school.together = std::max(1, static_cast<int>(std::ceil(fish / params.most_echoes)));
  const auto wanted = static_cast<std::size_t>(std::max(1.0, std::round(fish / school.together)));
  school.echoes.clear();
  school.echoes.reserve(wanted);
  while (school.echoes.size() < wanted) {
    const Point<Own> at = anywhere();
    if (random.uniform() * Form::kMostDensity > school.form.density(at)) continue;
    double broadside = 0.0;
    for (int i = 0; i < school.together; ++i) {
      const double spread = std::clamp(random.normal(), -2.5, 2.5) * params.length_spread;
      broadside += broadside_m2(params, school.fish_length_cm * std::max(0.2, 1.0 + spread));
    }
    school.echoes.push_back({at, broadside});
  }
  school.mean_aspect.assign(1, MeanAspect(params, wave_number, school.fish_length_cm));
}

std::vector<School> make_schools(const SchoolSetting& setting, Work& work) {
  const ArrayParams& p = setting.params;
  const auto seed = static_cast<std::uint64_t>(p.seed);
  RandomStream random(seed, Purpose::school, setting.observation);
  const int first_kind = random.index(static_cast<int>(kFormNames.size()));
  std::vector<School> schools;
  schools.reserve(static_cast<std::size_t>(p.schools));
  Placing placing(setting, random);
  for (int i = 0; i < p.schools; ++i) {
    const auto kind = static_cast<FormKind>((first_kind + i) % static_cast<int>(kFormNames.size()));
    const Point<Own> size = drawn_size(kind, p, random);
    School school(
        Form(kind, size, RandomStream(seed, Purpose::school, setting.observation, static_cast<std::uint32_t>(i) + 1)));
    school.fish_length_cm = random.uniform(p.fish.length_min_cm, p.fish.length_max_cm);
    school.per_m3 = p.fish.per_m3_min * std::pow(p.fish.per_m3_max / p.fish.per_m3_min, random.uniform());
    if (!placing.place(school, i)) continue;
    school.id = static_cast<int>(schools.size()) + 1;
    schools.push_back(std::move(school));
    placing.keep(schools.back(), placing.abeam_s());
  }
  work.for_each(static_cast<std::int64_t>(schools.size()), [&](std::int64_t i) {
    fill_school(schools[static_cast<std::size_t>(i)], p.fish, setting.wave_number, seed, setting.observation);
  });
  return schools;
}

}  // namespace sonar::synth::array
