// SPDX-License-Identifier: Apache-2.0
#include "view/volume/school_trails.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/units.h"
#include "model/mask_middle.h"
#include "view/volume/context_layout.h"
#include "view/volume/mask_sections.h"

namespace sonar {
namespace {

constexpr double kReach = 8.0;           ///< of what is drawn, in ranges of the sonar
constexpr double kStep = 0.02;           ///< of the ship's track, in ranges: finer is not seen
constexpr double kOutlineAlpha = 200.0;  ///< of the newest
constexpr double kTrackAlpha = 230.0;
constexpr double kToComeAlpha = 90.0;  ///< of the ship's way that it has not sailed yet

}  // namespace

double trail_strength(int age, int of) { return 1.0 - static_cast<double>(age - 1) / std::max(1, of); }

/// One set of lines on its way.
class SchoolTrails::Drawing {
 public:
  Drawing(SchoolTrails& trails, const Sector& sector, const TrailSubject& subject, const PingNavigation& ship,
          const Theme& theme)
      : trails_(trails),
        sector_(sector),
        subject_(subject),
        theme_(theme),
        ship_(ship.placement(), *trails.origin_),
        under_ship_(ship_.to_earth({})),
        far_m_(far_range_m(sector)) {}

  /// sailed  up to here
  void ship_track(std::int64_t sailed) {
    const auto count = static_cast<std::int64_t>(subject_.pings->size());
    std::optional<Point<Enu>> before;
    for (std::int64_t ping = 0; ping < count; ++ping) {
      const EarthPose* pose = pose_of(ping);
      if (pose == nullptr) {
        before.reset();
        continue;
      }
      Point<Enu> here = pose->to_earth({});
      here.z = 0.0;  // the track lies on the sea
      const bool must = ping == sailed || ping + 1 == count;
      if (before && !must && norm(here - *before) < kStep * far_m_) continue;
      const double alpha = ping <= sailed ? kTrackAlpha : kToComeAlpha;
      if (before) line(*before, here, faded(theme_.track, alpha), 1.6);
      before = here;
    }
  }

  void school_track(const TrailSchool& school) {
    std::optional<Point<Enu>> before;
    for (const TrailSchool::There& there : school.pings) {
      const EarthPose* pose = pose_of(there.ping_index);
      const auto middle = pose != nullptr ? middle_of(school, *there.mask) : std::nullopt;
      if (!middle) continue;
      const Point<Enu> here = placed(*middle, there.ping_index, *pose);
      if (before) line(*before, here, faded(school.colour, kTrackAlpha), school.selected ? 2.6 : 1.6);
      before = here;
    }
  }

  void trail(const TrailSchool& school, std::int64_t ping_index, int pings) {
    // The newest last: it lies over the older ones.
    for (const TrailSchool::There& there : school.pings) {
      const std::int64_t age = ping_index - there.ping_index;
      const EarthPose* pose = age >= 1 && age <= pings ? pose_of(there.ping_index) : nullptr;
      if (pose == nullptr) continue;
      const Rgba8 colour = faded(school.colour, kOutlineAlpha * trail_strength(static_cast<int>(age), pings));
      for (const auto& outline : outlines_of(school, *there.mask)) {
        std::optional<Point<Enu>> before;
        for (const Point<Sonar>& place : outline) {
          const Point<Enu> here = placed(place, there.ping_index, *pose);
          if (before) line(*before, here, colour, school.selected ? 1.8 : 1.2);
          before = here;
        }
      }
    }
  }

  std::vector<SceneLine> take() { return std::move(lines_); }

 private:
  static Rgba8 faded(Rgba8 colour, double alpha) {
    return with_alpha(colour, static_cast<int>(std::lround(alpha * colour.a / 255.0)));
  }
  [[nodiscard]] const EarthPose* pose_of(std::int64_t ping) const {
    const auto i = static_cast<std::size_t>(ping);
    if (ping < 0 || i >= subject_.pings->size()) return nullptr;
    auto& pose = trails_.poses_[i];
    const PingNavigation& there = (*subject_.pings)[i];
    if (!pose && on_earth(there)) pose.emplace(there.placement(), *trails_.origin_);
    return pose ? &*pose : nullptr;
  }
  /// A place that a ping has seen, by that ping's attitude.
  [[nodiscard]] Point<Enu> placed(const Point<Sonar>& place, std::int64_t ping, const EarthPose& pose) const {
    if (subject_.beams_stabilised) return pose.to_earth(place);
    const PingNavigation& there = (*subject_.pings)[static_cast<std::size_t>(ping)];
    Placement attitude;
    attitude.roll_rad = rad_from_deg(there.roll_deg);
    attitude.pitch_rad = rad_from_deg(there.pitch_deg);
    return pose.to_earth(levelled(place, attitude));
  }
  [[nodiscard]] std::optional<Point<Sonar>> middle_of(const TrailSchool& school, const PingMask& mask) const {
    Look& look = trails_.kept_[school.owner][&mask];
    if (!look.middle && !mask.empty()) {
      const auto middle = mask_middle(mask, sector_.beams());
      look.middle = sector_.centre(middle->fan, middle->beam, middle->sample);
    }
    return look.middle;
  }
  [[nodiscard]] const std::vector<std::vector<Point<Sonar>>>& outlines_of(const TrailSchool& school,
                                                                          const PingMask& mask) const {
    Look& look = trails_.kept_[school.owner][&mask];
    if (!look.outlines) {
      look.outlines = mask_sections(sector_, mask);
      ++trails_.outlines_made_;
    }
    return *look.outlines;
  }
  void line(const Point<Enu>& from, const Point<Enu>& to, Rgba8 colour, double width) {
    const auto near = [&](const Point<Enu>& place) {
      return std::hypot(place.x - under_ship_.x, place.y - under_ship_.y) < kReach * far_m_;
    };
    if (near(from) && near(to))
      lines_.push_back({ship_.to_ship(from), ship_.to_ship(to), colour, width * theme_.line_px});
  }

  SchoolTrails& trails_;
  const Sector& sector_;
  const TrailSubject& subject_;
  const Theme& theme_;
  EarthPose ship_;
  Point<Enu> under_ship_;
  double far_m_;
  std::vector<SceneLine> lines_;
};

std::vector<SceneLine> SchoolTrails::lines(const Sector& sector, const TrailSubject& subject, std::int64_t ping_index,
                                           const PingNavigation& ship, const TrailParams& params, const Theme& theme) {
  if (!params.any() || !subject.pings || !on_earth(ship)) return {};
  if (poses_of_ != subject.pings || poses_.size() != subject.pings->size()) {
    const auto known = std::find_if(subject.pings->begin(), subject.pings->end(), on_earth);
    if (known == subject.pings->end()) return {};
    origin_ = known->transducer;
    poses_of_ = subject.pings;
    poses_.assign(subject.pings->size(), std::nullopt);
  }
  std::set<std::shared_ptr<const void>> here;
  for (const TrailSchool& school : subject.schools) here.insert(school.owner);
  std::erase_if(kept_, [&](const auto& one) { return !here.contains(one.first); });
  Drawing drawing(*this, sector, subject, ship, theme);
  if (params.ship_track) drawing.ship_track(ping_index);
  for (const TrailSchool& school : subject.schools) {
    if (params.pings > 0) drawing.trail(school, ping_index, params.pings);
    if (params.school_tracks) drawing.school_track(school);
  }
  return drawing.take();
}

}  // namespace sonar
