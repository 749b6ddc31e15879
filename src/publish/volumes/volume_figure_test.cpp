// SPDX-License-Identifier: Apache-2.0
#include "publish/volumes/volume_figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "publish/volumes/test_volume_figure.h"
#include "publish/volumes/volume_legend.h"
#include "view/label_room.h"

namespace sonar {
namespace {

using namespace volume_test;  // NOLINT(google-build-using-namespace)

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Where a camera sees the voxels of the schools, and points between them.
std::vector<PixelPoint> seen_of(const VolumeFigure& figure, const VolumePlace& place, const CameraBasis& camera) {
  std::vector<PixelPoint> out;
  const Sector& sector = figure.sector();
  for (const MaskLayer& layer : figure.masks) {
    for (const Run& run : layer.mask->runs) {
      for (double sample = run.first_sample; sample <= run.end() - 1; sample += 0.25) {
        const Point<Sonar> at = Sector::direction(sector.elevation_rad(run.row / sector.beams()),
                                                  sector.azimuth_rad(run.row % sector.beams())) *
                                sector.range().range_m(sample);
        const auto seen = camera.project(at);
        if (seen) out.push_back({place.rect.x + seen->pixel.x, place.rect.y + seen->pixel.y});
      }
    }
  }
  return out;
}

// Law: in 200 random views no words in the volume lie on others, on a school, or beyond its edge: labels, numbers of
// schools, legend, scale bar and, in every tenth view, why nothing is there.
TEST(VolumeFigure, NothingLiesOnAnythingInTwoHundredViews) {
  std::mt19937 random(20200105);
  int numbers = 0;
  int legends = 0;
  int tracks = 0;
  int bars = 0;
  int whys = 0;
  for (int view = 0; view < 200; ++view) {
    const bool nothing = view % 10 == 9;
    VolumeFigure figure = schools_alone(nothing ? 0 : 7);
    PictureOptions options;
    options.volume.data = !nothing;
    options.size = view % 2 == 0 ? PixelSize{640, 400} : PixelSize{900, 700};
    options.dark = view % 3 == 0;
    options.volume.drop_lines = DropLines::all;
    choose_trails(view, figure, options);
    options.kind.volume = from_anywhere(random, 0.6, 2.5);
    const auto place = volume_place(options);
    ASSERT_TRUE(place);
    const PixelSize size{static_cast<int>(place->rect.width), static_cast<int>(place->rect.height)};
    const CameraBasis camera = basis(*volume_camera(figure.sector(), options, place->rays), size);
    const std::vector<PixelPoint> schools = seen_of(figure, *place, camera);
    std::vector<PixelRect> words;
    bool bar = false;
    for (const TextItem& text : words_in(frame_of(figure, options), place->rect)) {
      const PixelRect box = LabelRoom::box_of(text);
      for (const PixelRect& other : words) ASSERT_FALSE(overlap(box, other)) << view << ' ' << text.text;
      words.push_back(box);
      for (const PixelPoint& school : schools) ASSERT_FALSE(inside(box, school)) << view << ' ' << text.text;
      numbers += text.text.size() == 1 ? 1 : 0;
      legends += text.text == "fuzzy area" ? 1 : 0;
      tracks += text.text == "track of the ship" ? 1 : 0;
      whys += text.text.starts_with("no masks: ") ? 1 : 0;
      bar = bar || text.text.ends_with("at the view's centre");
    }
    bars += bar ? 1 : 0;
  }
  EXPECT_GT(numbers, 500);
  EXPECT_GT(legends, 170);
  EXPECT_GT(tracks, 140);
  EXPECT_GT(bars, 190);
  EXPECT_EQ(whys, 20);
}

// A profile at the ship tells of 10 to 30 m, and recipes let it hold 20 m farther: depths of which nothing is told have no
// arrow. Between two profiles it is linear in time, as it is for schools.
TEST(VolumeFigure, ArrowsOfTheCurrentStandWhereItIsTold) {
  Recipe recipe;
  PingNavigation ship;
  ship.time = 100 * kSecondNs;
  ship.transducer = {60.0, 5.0};
  ship.heading_deg = 0.0;
  ship.transducer_depth_m = 7.0;
  recipe.current_profiles = {{0, ship.transducer, {{10.0, 0.0, 0.1}, {30.0, 0.0, 0.3}}},
                             {400 * kSecondNs, ship.transducer, {{10.0, 0.4, 0.1}, {30.0, 0.4, 0.3}}}};
  const Sector sector = slice_example::hand_sector();
  VolumeFigure figure = schools_alone(1);
  figure.navigation = ship;
  figure.currents = volume_currents(recipe, sector, ship, {});
  ASSERT_EQ(figure.currents.at.size(), 2U) << "20 and 40 m of 20, 40, ... 180";
  EXPECT_NEAR(figure.currents.at[0].east_mps, 0.1, 1e-12);
  EXPECT_NEAR(figure.currents.at[0].north_mps, 0.2, 1e-12);
  EXPECT_EQ(figure.currents.at[1].depth_m, 40.0);
  EXPECT_NEAR(figure.currents.at[1].north_mps, 0.3, 1e-12) << "the last bin holds below it";
  EXPECT_NEAR(figure.currents.longest_mps, 0.5, 1e-12);
  PictureOptions options;
  const auto told = [&] {
    for (const LegendRow& row : volume_legend(figure, options, {0.0, 0.0, 600.0, 400.0}, theme_of(options))) {
      if (row.words.starts_with("current below the ship: 0.5 m/s is 50 m long")) return true;
    }
    return false;
  };
  EXPECT_TRUE(told());
  options.volume.context = false;
  EXPECT_FALSE(told()) << "they stand round the volume";
  VolumeParams off;
  off.current_arrows = false;
  EXPECT_EQ(volume_currents(recipe, sector, ship, off), CurrentColumn{});
  ship.heading_deg = kNaN;
  EXPECT_EQ(volume_currents(recipe, sector, ship, {}), CurrentColumn{}) << "nobody knows which way they point";
}

// Lines go down to the chart where there is one, else to the plane where that was seen, else nowhere.
TEST(VolumeFigure, DropLinesKnowTheirSeabed) {
  VolumeFigure figure = schools_alone(3);
  PictureOptions options;
  const auto bed_of = [&](DropLines lines) {
    options.volume.drop_lines = lines;
    return volume_surroundings(figure, options).schools;
  };
  for (const SchoolPlace& school : bed_of(DropLines::all)) {
    EXPECT_TRUE(school.drop_line);
    const Point<Sonar>& m = school.middle;
    const bool seen = std::abs(m.x) <= 90.0 && m.y >= -180.0 && m.y <= -30.0;
    EXPECT_EQ(std::isnan(school.seabed_z_m), !seen);
    if (seen) {
      EXPECT_NEAR(school.seabed_z_m, 120.0 + 0.05 * m.x, 1e-9);
    }
  }
  std::vector<SchoolPlace> schools = bed_of(DropLines::selected);
  EXPECT_EQ(std::count_if(schools.begin(), schools.end(), [](const SchoolPlace& s) { return s.drop_line; }), 1);
  EXPECT_TRUE(schools[2].drop_line);
  EXPECT_EQ(schools[2].name.find("3: "), 0U) << "with its depth: " << schools[2].name;
  figure.seabed =
      std::make_shared<SeabedPatch>(SeabedPatch{2, 2, -300.0, -300.0, 600.0, std::vector<float>(4, 150.0F)});
  EXPECT_NEAR(bed_of(DropLines::all)[0].seabed_z_m, 143.0, 1e-6) << "7 m below the sea the sonar is";
  schools = bed_of(DropLines::none);
  EXPECT_TRUE(std::none_of(schools.begin(), schools.end(), [](const SchoolPlace& s) { return s.drop_line; }));
}

}  // namespace
}  // namespace sonar
