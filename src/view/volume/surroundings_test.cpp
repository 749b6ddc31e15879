// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "base/units.h"
#include "model/volume.h"
#include "view/label_room.h"
#include "view/slices/slice_example.h"
#include "view/theme.h"
#include "view/volume/context_layout.h"
#include "view/volume/context_scene.h"
#include "view/volume/distance_bar.h"
#include "view/volume/school_places.h"
#include "view/volume/volume_cut.h"

namespace sonar {
namespace {

constexpr PixelSize kSize{640, 480};

/// A block of voxels.
PingMask block(const Sector& sector, int first_fan, int fans, int first_beam, int beams, int first_sample,
               int samples) {
  PingMask mask;
  for (int fan = first_fan; fan < first_fan + fans; ++fan) {
    for (int beam = first_beam; beam < first_beam + beams; ++beam) {
      mask.runs.push_back({fan * sector.beams() + beam, first_sample, samples});
      mask.confidence.insert(mask.confidence.end(), static_cast<std::size_t>(samples), 255);
    }
  }
  return mask;
}

ContextParams nothing_else() {
  ContextParams params;
  params.sector_frame = params.range_rings = params.sea_surface = params.ship = params.depth_axis = false;
  return params;
}

/// Eyes all round the sector, near and far, above and below.
class RandomCameras {
 public:
  explicit RandomCameras(const Sector& sector) : overview_(overview(sector, kSize)) {}
  Camera next() {
    const auto even = [this](double low, double high) { return std::uniform_real_distribution(low, high)(random_); };
    return zoomed(orbited(overview_, even(-3.1, 3.1), even(-1.2, 0.8)), even(0.35, 1.6));
  }

 private:
  Camera overview_;
  std::mt19937 random_{20200104};
};

// By hand: fan 4 looks down 30 degrees, beam 3 to port; samples are 5 m long, so that the 20th begins at 97.5 m, and the
// record ends at 200 m. Another beam whose shadow begins at the record's end has none.
TEST(Shadow, LiesAlongItsBeamsUpToTheRecordsEnd) {
  const Sector sector = slice_example::hand_sector();
  ContextParams params = nothing_else();
  EXPECT_TRUE(context_scene(sector, params, light_theme(kSize)).lines.empty());
  std::vector<int> from(56, 41);
  from[4 * 7 + 3] = 20;
  params.shadow_from = std::make_shared<const std::vector<int>>(from);
  const ContextScene scene = context_scene(sector, params, light_theme(kSize));
  double nearest_m = 1e9;
  double farthest_m = 0.0;
  for (const SceneLine& line : scene.lines) {
    for (const Point<Sonar>& end : {line.from, line.to}) {
      EXPECT_NEAR(end.x, 0.0, 1e-9);
      EXPECT_NEAR(end.z / -end.y, std::tan(rad_from_deg(30.0)), 1e-9);
      nearest_m = std::min(nearest_m, norm(end));
      farthest_m = std::max(farthest_m, norm(end));
    }
  }
  EXPECT_NEAR(nearest_m, 97.5, 1e-9);
  EXPECT_NEAR(farthest_m, 200.0, 1e-9);
}

// By hand: the mask's middle is fan 4 (-30 degrees), beam 3 (270), 20 samples of 5 m: 100 m to port, 50 m below the sonar
// and 86.6 m away. The surface is 7 m above the sonar; a bed of 120 m lies 113 m below it.
TEST(DropLines, GoStraightUpToTheSeaAndDownToTheBed) {
  const Sector sector = slice_example::hand_sector();
  auto place = school_place(sector, block(sector, 3, 3, 2, 3, 18, 5));
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->middle.x, 0.0, 1e-9);
  EXPECT_NEAR(place->middle.y, -100.0 * std::cos(rad_from_deg(30.0)), 1e-9);
  EXPECT_NEAR(place->middle.z, 50.0, 1e-9);
  const auto lowest_and_highest = [&](double bed_z_m) {
    ContextParams params = nothing_else();
    place->seabed_z_m = bed_z_m;
    place->drop_line = true;
    params.schools = {*place};
    double top = 1e9;
    double low = -1e9;
    for (const SceneLine& line : context_scene(sector, params, light_theme(kSize)).lines) {
      // Straight up and down, or level.
      if (line.from.z != line.to.z) {
        EXPECT_LT(std::hypot(line.to.x - place->middle.x, line.to.y - place->middle.y), 1e-9);
      }
      top = std::min({top, line.from.z, line.to.z});
      low = std::max({low, line.from.z, line.to.z});
    }
    return std::pair{low, top};
  };
  EXPECT_EQ(lowest_and_highest(113.0), (std::pair{113.0, -7.0}));
  EXPECT_NEAR(lowest_and_highest(std::nan("")).first, 50.0, 1e-9) << "the bed is not known";
  EXPECT_NEAR(lowest_and_highest(40.0).first, 50.0, 1e-9) << "the school lies below the plane";
  place->drop_line = false;
  ContextParams params = nothing_else();
  params.schools = {*place};
  EXPECT_TRUE(context_scene(sector, params, light_theme(kSize)).lines.empty());
}

// A ball of 12 m, 100 m away, in beams of 1 degree and samples of 1 m: seen from above its footprint reaches 12 m in every
// direction, to within a beam's width, and lies within the school's box; it is drawn level on the surface and on the bed.
TEST(DropLines, EndInTheSchoolsFootprint) {
  using slice_example::even_deg;
  using slice_example::radians;
  const Sector sector(radians(even_deg(-60, 1, 41)), radians(even_deg(250, 1, 41)), {0.5, 1.0, 200});
  const Point<Sonar> centre = Sector::direction(rad_from_deg(-40.0), rad_from_deg(270.0)) * 100.0;
  constexpr double kRadius_m = 12.0;
  const double beam_m = rad_from_deg(1.0) * (100.0 + kRadius_m);
  PingMask ball;
  for (int row = 0; row < sector.fans() * sector.beams(); ++row) {
    for (int s = 0; s < sector.range().count; ++s) {
      if (norm(sector.centre(row / sector.beams(), row % sector.beams(), s) - centre) > kRadius_m) continue;
      ball.runs.push_back({row, s, 1});
      ball.confidence.push_back(255);
    }
  }
  auto place = school_place(sector, ball);
  ASSERT_TRUE(place);
  const auto reach = [](const std::vector<Point<Sonar>>& places, const Point<Sonar>& way) {
    double most = -1e9;
    for (const Point<Sonar>& p : places) most = std::max(most, p.x * way.x + p.y * way.y);
    return most;
  };
  for (int deg = 0; deg < 360; deg += 10) {
    const Point<Sonar> way = Sector::direction(0.0, rad_from_deg(deg));
    EXPECT_NEAR(reach(place->footprint, way) - (centre.x * way.x + centre.y * way.y), kRadius_m, beam_m) << deg;
  }
  for (const Point<Sonar>& way : {Point<Sonar>{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}) {
    EXPECT_LE(reach(place->footprint, way), reach(place->edge, way));
  }
  place->drop_line = true;
  place->seabed_z_m = 113.0;
  ContextParams params = nothing_else();
  params.schools = {*place};
  std::map<double, std::size_t> level;
  for (const SceneLine& line : context_scene(sector, params, light_theme(kSize)).lines) {
    if (line.from.z == line.to.z) ++level[line.from.z];
  }
  EXPECT_EQ(level, (std::map<double, std::size_t>{{-7.0, place->footprint.size()}, {113.0, place->footprint.size()}}));
}

TEST(SchoolPlaces, AnEmptyMaskHasNone) { EXPECT_FALSE(school_place(slice_example::hand_sector(), PingMask{})); }

// Law: wherever it is looked at from, every voxel of a school lies in the school's box.
TEST(SchoolPlaces, NoVoxelLiesOutsideTheBox) {
  const Sector sector = slice_example::hand_sector();
  for (const PingMask& mask :
       {block(sector, 3, 3, 1, 4, 18, 5), block(sector, 0, 8, 0, 7, 2, 30), block(sector, 7, 1, 6, 1, 40, 1)}) {
    const auto place = school_place(sector, mask);
    ASSERT_TRUE(place);
    RandomCameras cameras(sector);
    for (int view = 0; view < 100; ++view) {
      const CameraBasis camera = basis(cameras.next(), kSize);
      const auto box = school_box(*place, camera);
      for (const sonar::Run& run : mask.runs) {
        for (const int sample : {run.first_sample, run.end() - 1}) {
          const auto seen = camera.project(sector.centre(run.row / sector.beams(), run.row % sector.beams(), sample));
          if (!seen || !inside({0.0, 0.0, 640.0, 480.0}, seen->pixel)) continue;
          ASSERT_TRUE(box);
          const PixelRect wide{box->x - 1.0, box->y - 1.0, box->width + 2.0, box->height + 2.0};
          ASSERT_TRUE(inside(wide, seen->pixel)) << view;
        }
      }
    }
  }
}

bool overlap(const PixelRect& a, const PixelRect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

// Law: in 200 random views no label lies on a school, on what was taken before, or on another label; schools have their
// names in most of them, and the selected one has its number in all that show it.
TEST(SchoolPlaces, NoLabelLiesOnASchoolInTwoHundredViews) {
  const Sector sector = slice_example::hand_sector();
  ContextParams params;
  for (int i = 0; i < 6; ++i) {
    auto place = school_place(sector, block(sector, 1 + i, 1, i, 1, 8 + 5 * i, 3));
    place->name = std::to_string(i + 1);
    place->selected = i == 2;
    place->drop_line = true;
    params.schools.push_back(*place);
  }
  params.top_fan = 3;
  params.side_beam = 4;
  const std::vector<PixelRect> taken{{0.0, 380.0, 180.0, 100.0}, {480.0, 440.0, 160.0, 40.0}};
  RandomCameras cameras(sector);
  int names = 0;
  int seen = 0;
  for (int view = 0; view < 200; ++view) {
    const CameraBasis camera = basis(cameras.next(), kSize);
    FrameDescription frame{kSize, {}, {}, {}};
    add_context_labels(frame, sector, params, camera, light_theme(kSize), {}, taken);
    std::vector<PixelRect> boxes = taken;
    for (const SchoolPlace& school : params.schools) {
      if (const auto box = school_box(school, camera)) boxes.push_back(*box);
    }
    seen += static_cast<int>(boxes.size() - taken.size());
    int selected = 0;
    for (const auto& item : frame.items) {
      const auto* label = std::get_if<TextItem>(&item);
      if (label == nullptr) continue;  // a line to the number that stands farther off
      const PixelRect own = LabelRoom::box_of(*label);
      selected += label->text == "3" ? 1 : 0;
      ASSERT_TRUE(std::ranges::none_of(boxes, [&](const PixelRect& box) { return overlap(own, box); }))
          << view << ' ' << label->text;
      boxes.push_back(own);
      names += label->text.size() == 1 ? 1 : 0;
    }
    ASSERT_EQ(selected, school_box(params.schools[2], camera) ? 1 : 0) << view;
  }
  EXPECT_GT(names, seen * 6 / 10);
}

// The outline of the slice from above lies at its fan's elevation, that of the slice from the side in its beam's plane.
TEST(SlicePlanes, LieWhereTheSlicesLie) {
  for (const auto& [name, sector] : slice_example::sectors()) {
    const int fan = sector.fans() / 2;
    for (const Point<Sonar>& p : fan_outline(sector, fan)) {
      if (norm(p) < 1e-6) continue;
      EXPECT_NEAR(std::atan2(-p.z, std::hypot(p.x, p.y)), sector.elevation_rad(fan), 1e-9) << name;
    }
    const int beam = sector.beams() / 3;
    for (const Point<Sonar>& p : beam_outline(sector, beam)) {
      const double azimuth = sector.azimuth_rad(beam);
      EXPECT_NEAR(p.x * std::sin(azimuth) - p.y * std::cos(azimuth), 0.0, 1e-9) << name;
    }
    ContextParams params = nothing_else();
    EXPECT_TRUE(context_scene(sector, params, light_theme(kSize)).lines.empty());
    params.top_fan = fan;
    EXPECT_GT(context_scene(sector, params, light_theme(kSize)).lines.size(), 4U);
  }
}

TEST(FittedSeabed, LiesOnItsPlaneWhereItWasSeen) {
  ContextParams params = nothing_else();
  const FittedSeabed bed{80.0, 0.1, -0.05, -150.0, 20.0, -180.0, -60.0};
  params.fitted_seabed = bed;
  const ContextScene scene = context_scene(slice_example::hand_sector(), params, light_theme(kSize));
  EXPECT_TRUE(scene.opaque.empty()) << "it is not sure enough to hide echoes";
  std::set<double> x;
  std::set<double> y;
  const auto on_it = [&](const Point<Sonar>& p) {
    EXPECT_NEAR(p.z, 80.0 + 0.1 * p.x - 0.05 * p.y, 1e-9);
    x.insert(p.x);
    y.insert(p.y);
  };
  for (const SceneTriangle& t : scene.ground) std::for_each(t.corners.begin(), t.corners.end(), on_it);
  ASSERT_EQ(scene.ground.size(), 2U);
  for (const SceneLine& line : scene.lines) {
    on_it(line.from);
    on_it(line.to);
  }
  EXPECT_EQ(*x.begin(), -150.0);
  EXPECT_EQ(*x.rbegin(), 20.0);
  EXPECT_EQ(*y.begin(), -180.0);
  EXPECT_EQ(*y.rbegin(), -60.0);
}

// Between nodes of a plane it is the plane; outside, and beside unknown nodes, nothing is known.
TEST(SeabedUnder, IsInterpolatedBetweenNodes) {
  SeabedPatch bed{3, 3, -10.0, -10.0, 10.0, {}};
  for (int iy = 0; iy < 3; ++iy) {
    for (int ix = 0; ix < 3; ++ix) bed.depth_m.push_back(static_cast<float>(100 + 2 * ix - 3 * iy));
  }
  EXPECT_NEAR(depth_under(bed, -5.0, 2.5), 100.0 + 2.0 * 0.5 - 3.0 * 1.25, 1e-5);
  EXPECT_NEAR(depth_under(bed, 10.0, 10.0), 98.0, 1e-5);
  EXPECT_TRUE(std::isnan(depth_under(bed, 10.1, 0.0)));
  bed.depth_m[0] = std::nanf("");
  EXPECT_TRUE(std::isnan(depth_under(bed, -9.0, -9.0)));
}

// Law: whatever of a sector is seen, from outside it or from within, is seen in its outline, which is convex.
TEST(SectorOutline, HoldsWhatIsSeenOfTheSector) {
  for (const auto& [name, sector] : slice_example::sectors()) {
    RandomCameras cameras(sector);
    int seen = 0;
    for (int view = 0; view < 40; ++view) {
      Camera camera = cameras.next();
      if (view % 4 == 0) camera = zoomed(camera, 0.1);  // many of these stand within the sector
      const CameraBasis eye = basis(camera, kSize);
      const ConvexOutline outline = sector_outline(sector, nothing_else(), eye);
      for (int place = 0; place < 300; ++place) {
        const Voxel voxel{place % sector.fans(), (7 * place) % sector.beams(), 5 + place % 90};
        const auto at = eye.project(sector.centre(voxel.fan, voxel.beam, voxel.sample));
        if (!at || at->depth_m < 50.0 || !inside({0.0, 0.0, 640.0, 480.0}, at->pixel)) continue;
        ++seen;
        ASSERT_GE(outline.size(), 3U) << name << ' ' << view;
        for (std::size_t i = 0; i < outline.size(); ++i) {
          const PixelPoint a = outline[i];
          const PixelPoint b = outline[(i + 1) % outline.size()];
          const double turn = (b.x - a.x) * (at->pixel.y - a.y) - (b.y - a.y) * (at->pixel.x - a.x);
          ASSERT_GT(turn, -2.0 * std::hypot(b.x - a.x, b.y - a.y)) << name << ' ' << view << ": two pixels outside";
        }
      }
    }
    EXPECT_GT(seen, 1000) << name;
  }
}

// What the bar says, projected: across the line of sight at the target.
TEST(DistanceBar, IsAsLongAsTheSameDistanceAtTheTarget) {
  const Sector sector = slice_example::hand_sector();
  RandomCameras cameras(sector);
  for (int view = 0; view < 50; ++view) {
    const Camera camera = cameras.next();
    const auto bar = distance_bar(camera, kSize, 150.0);
    ASSERT_TRUE(bar);
    const CameraBasis b = basis(camera, kSize);
    const auto left = b.project(camera.target + b.right * (-0.5 * bar->length_m));
    const auto right = b.project(camera.target + b.right * (0.5 * bar->length_m));
    ASSERT_TRUE(left && right);
    EXPECT_NEAR(right->pixel.x - left->pixel.x, bar->length_px, 1e-6);
    EXPECT_LE(bar->length_px, 150.0);
    EXPECT_GT(bar->length_px, 150.0 / 2.5 - 1e-9) << "the next round length would have had room";
    const double digits = bar->length_m / std::pow(10.0, std::floor(std::log10(bar->length_m) + 1e-9));
    EXPECT_TRUE(std::abs(digits - 1.0) < 1e-9 || std::abs(digits - 2.0) < 1e-9 || std::abs(digits - 5.0) < 1e-9);
  }
  EXPECT_FALSE(distance_bar({{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}}, kSize, 150.0));
}

// What is left out lies on the eye's side of the slice, and all of it does; the slice itself is drawn.
TEST(VolumeCuts, LeaveOutTheEyesSideOfASlice) {
  for (const auto& [name, sector] : slice_example::sectors()) {
    RandomCameras cameras(sector);
    const int fan = sector.fans() / 2;
    const int beam = sector.beams() / 3;
    const double azimuth = sector.azimuth_rad(beam);
    for (int view = 0; view < 40; ++view) {
      const Point<Sonar> eye = cameras.next().eye;
      const VolumeCut cut = cut_before(sector, eye, fan, beam);
      const bool above = -eye.z > std::tan(sector.elevation_rad(fan)) * std::hypot(eye.x, eye.y);
      for (int i = 0; i < sector.fans(); ++i) {
        EXPECT_EQ(cut.fans[static_cast<std::size_t>(i)] != 0, above ? i <= fan : i >= fan) << name;
      }
      const auto side = [&](const Point<Sonar>& p) { return p.y * std::cos(azimuth) - p.x * std::sin(azimuth); };
      for (int i = 0; i < sector.beams(); ++i) {
        const double there = side(Sector::direction(0.0, sector.azimuth_rad(i)));
        if (i != beam && std::abs(there) < 1e-9) continue;  // just behind
        EXPECT_EQ(cut.beams[static_cast<std::size_t>(i)] != 0, i == beam || there * side(eye) < 0.0) << name;
      }
    }
  }
}

TEST(VolumeCuts, SamplesThatAreCutAwayAreNoData) {
  Array3<std::int16_t> sv({3, 2, 4}, 7);
  Array3<std::int16_t> whole = sv;
  cut_away(whole, {});
  EXPECT_EQ(whole, sv);
  cut_away(sv, {{1, 0, 1}, {0, 1}});
  for (int fan = 0; fan < 3; ++fan) {
    for (int beam = 0; beam < 2; ++beam) {
      for (int s = 0; s < 4; ++s) EXPECT_EQ(sv(fan, beam, s), fan != 1 && beam == 1 ? 7 : kNoData);
    }
  }
}

}  // namespace
}  // namespace sonar
