// SPDX-License-Identifier: Apache-2.0
// Units that numbers are read in, and that every kind of picture follows them.
#include "view/units.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/units.h"
#include "view/axes.h"
#include "view/charts/chart.h"
#include "view/charts/chart_bins.h"
#include "view/charts/effort_charts.h"
#include "view/charts/leg_chart.h"
#include "view/maps/contours.h"
#include "view/maps/depth_layer.h"
#include "view/maps/map_example.h"
#include "view/maps/scale_bars.h"
#include "view/maps/survey_map.h"
#include "view/slices/slice_example.h"
#include "view/slices/slice_picture.h"
#include "view/timelines/timeline.h"
#include "view/volume/context_scene.h"
#include "view/volume/distance_bar.h"
#include "view/volume/propagation_view.h"

namespace sonar {
namespace {

using map_example::says;

constexpr PixelSize kSize{1000, 760};
constexpr double kFoot_m = 0.3048;  // international yard and pound agreement, 1959
constexpr Units kFeet{LengthUnit::feet, SpeedUnit::knots};
constexpr Units kFathoms{LengthUnit::fathoms, SpeedUnit::usual};

Theme read_in(const Units& units, PixelSize size = kSize) {
  Theme theme = light_theme(size);
  theme.units = units;
  return theme;
}

// 1 fathom = 6 feet = 1.8288 m; 1 kn = 1852 m / 3600 s.
TEST(Units, AreThoseOfTheBooks) {
  EXPECT_DOUBLE_EQ(kFathoms.length().of(1.8288), 1.0);
  EXPECT_DOUBLE_EQ(kFeet.length().of(1.8288), 6.0);
  EXPECT_DOUBLE_EQ(kFeet.speed().of(1852.0 / 3600.0), 1.0);
  EXPECT_EQ(quantity_text(30.48, 1, kFeet.length()), "100.0 ft");
  EXPECT_EQ(quantity_text(91.44, 1, kFathoms.length()), "50.0 fm");
  EXPECT_EQ(quantity_text(5.0, 2, kFeet.speed()), "9.72 kn") << "18000 / 1852";
  EXPECT_EQ(quantity_text(12.34, 1, Units{}.length()), "12.3 m");
  EXPECT_EQ(with_unit("depth", kFathoms.length()), "depth (fm)");
}

TEST(Units, SpeedsAreAsIsUsualUntilSomebodyChooses) {
  const Units usual;
  EXPECT_EQ(quantity_text(5.144444, 1, usual.ship_speed()), "10.0 kn");
  EXPECT_EQ(quantity_text(5.144444, 1, usual.speed()), "5.1 m/s");
  const Units all_mps{LengthUnit::metres, SpeedUnit::metres_per_second};
  EXPECT_EQ(all_mps.ship_speed().name, "m/s");
  EXPECT_EQ(kFeet.speed().name, "kn");
}

TEST(Units, ColumnsFollowByTheUnitThatTheyCarry) {
  EXPECT_EQ(shown_unit("m", kFeet).name, "ft");
  EXPECT_EQ(shown_unit("m", Units{}).name, "m");
  for (const char* speed : {"m/s", "m s-1", "m s\u207B\u00B9"}) {
    EXPECT_EQ(shown_unit(speed, kFeet).name, "kn");
    EXPECT_DOUBLE_EQ(shown_unit(speed, kFeet).of(1852.0 / 3600.0), 1.0);
    EXPECT_EQ(shown_unit(speed, Units{}).name, speed);
  }
  // A column of knots: what it holds are knots.
  EXPECT_EQ(shown_unit("kn", kFeet).si, 1.0);
  EXPECT_DOUBLE_EQ(shown_unit("kn", {LengthUnit::metres, SpeedUnit::metres_per_second}).of(1.0), 1852.0 / 3600.0);
  for (const char* other : {"", "1", "m2", "m\u00B2", "m3", "nmi", "dB re 1 m-1", "m2 nmi-2", "s", "mm", "cm"}) {
    EXPECT_EQ(shown_unit(other, kFeet).si, 1.0) << other;
    EXPECT_EQ(shown_unit(other, kFeet).name, other);
  }
}

TEST(Units, RoundNumbersAreOfTheUnitThatIsRead) {
  // 100 m are 328 ft, 54.7 fm; 7 m are 22.97 ft.
  EXPECT_DOUBLE_EQ(round_below(100.0, kFeet.length()), 200.0 * kFoot_m);
  EXPECT_DOUBLE_EQ(round_below(100.0, kFathoms.length()), 50.0 * 1.8288);
  EXPECT_DOUBLE_EQ(round_below(7.0, kFeet.length()), 20.0 * kFoot_m);
  EXPECT_EQ(round_below(7.0, Units{}.length()), 5.0);
  for (int feet = 1; feet <= 1000; feet *= 10) {
    EXPECT_DOUBLE_EQ(round_below(feet * kFoot_m, kFeet.length()), feet * kFoot_m) << "no less for rounding";
  }
  EXPECT_EQ(round_text(1250.0 * kFoot_m, kFeet.length()), "1250 ft");
  EXPECT_EQ(round_text(5.0, kFeet.length()), "16.4 ft");
  EXPECT_EQ(round_text(1234.5, Units{}.length()), "1234.5 m");
  EXPECT_EQ(round_text(0.0, kFeet.length()), "0 ft");
}

// Law: a tick stands where the number beside it is, in the unit; its numbers are as round as those of metres are.
TEST(Units, TicksAreRoundInTheUnitAndStandWhereTheyShould) {
  for (const Units& units : {kFeet, kFathoms, Units{}}) {
    const Theme theme = read_in(units);
    for (const double deepest : {3.7, 60.96, 423.0, 2512.0}) {
      const PlotFrame plot{{100, 50, 400, 300}, {0, 1, "x"}, length_axis(-0.1 * deepest, deepest, "depth", theme)};
      FrameDescription frame;
      add_axes(frame, plot, theme);
      std::vector<double> read;
      for (const auto& item : frame.items) {
        const auto* text = std::get_if<TextItem>(&item);
        if (text == nullptr || text->anchor != TextAnchor::right) continue;
        const bool above = text->text.starts_with("\u2212");
        const double number = std::stod(above ? "-" + text->text.substr(3) : text->text);
        read.push_back(number);
        EXPECT_NEAR(text->at.y, plot.at(0.0, number * units.length().si).y, 1e-6) << text->text;
      }
      ASSERT_GE(read.size(), 2U) << deepest;
      const double step = read[1] - read[0];
      const double lead = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
      EXPECT_TRUE(std::abs(lead - 1.0) < 1e-6 || std::abs(lead - 2.0) < 1e-6 || std::abs(lead - 5.0) < 1e-6) << step;
      EXPECT_NEAR(std::remainder(read[0], step), 0.0, 1e-6 * step);
    }
  }
}

// --- kinds of pictures --------------------------------------------------------------------------------------------

/// A unit that is no part of a word, nor of m² or m⁻¹.
bool names(const std::string& text, const std::string& unit) {
  const auto goes_on = [](char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) >= 0x80U;
  };
  for (std::size_t at = text.find(unit); at != std::string::npos; at = text.find(unit, at + 1)) {
    const std::size_t end = at + unit.size();
    if ((at == 0 || !goes_on(text[at - 1])) && (end == text.size() || !goes_on(text[end]))) return true;
  }
  return false;
}

bool names(const FrameDescription& frame, const std::string& unit) {
  return std::any_of(frame.items.begin(), frame.items.end(), [&](const auto& item) {
    const auto* text = std::get_if<TextItem>(&item);
    return text != nullptr && names(text->text, unit);
  });
}

/// Made by `draw` for a theme: of metres it speaks as ever, of feet and knots only where these are read.
template <class Draw>
void expect_follows(const Draw& draw, const std::string& what, const char* unit = "ft") {
  const FrameDescription metres = draw(light_theme(kSize));
  EXPECT_TRUE(names(metres, "m")) << what;
  EXPECT_FALSE(names(metres, unit)) << what;
  const FrameDescription read = draw(read_in(kFeet));
  for (const auto& item : read.items) {
    const auto* text = std::get_if<TextItem>(&item);
    EXPECT_FALSE(text != nullptr && names(text->text, "m")) << what << ": " << text->text;
  }
  EXPECT_FALSE(names(read.title, "m")) << what << ": " << read.title;
  EXPECT_TRUE(names(read, unit)) << what;
}

TEST(UnitsOfPictures, SlicesFollow) {
  const Sector sector = slice_example::hand_sector();
  const slice_example::LitVolume volume(sector, {4, 3, 20}, -30.0, -90.0);
  const PlaneSlice oblique = *oblique_plane({-30.0, -40.0, 50.0}, {0.3, 0.2, 1.0});
  for (const auto& [what, view] :
       std::vector<std::pair<std::string, SliceView>>{{"top", {TopSlice{4}}},
                                                      {"side", {SideSlice{3}}},
                                                      {"range", {RangeSlice{20}}},
                                                      {"horizontal", {horizontal_plane(50.0, 0.0)}},
                                                      {"vertical", {vertical_plane(rad_from_deg(270.0))}},
                                                      {"oblique", {oblique}}}) {
    expect_follows(
        [&, &shown = view](const Theme& theme) {
          auto made = slice_picture(sector, volume.data(), {}, shown, {}, theme, kSize);
          EXPECT_TRUE(made) << to_line(made.error());
          return made ? std::move(made->frame) : FrameDescription{};
        },
        what);
  }
}

// What lies under the pointer stays what it is.
TEST(UnitsOfPictures, AVoxelIsWhereItWas) {
  const Sector sector = slice_example::hand_sector();
  const Voxel lit{4, 3, 20};
  const slice_example::LitVolume volume(sector, lit, -30.0, -90.0);
  const auto metres = slice_picture(sector, volume.data(), {}, {SideSlice{3}}, {}, light_theme(kSize), kSize);
  const auto feet = slice_picture(sector, volume.data(), {}, {SideSlice{3}}, {}, read_in(kFeet), kSize);
  ASSERT_TRUE(metres && feet);
  EXPECT_EQ(metres->place_of(lit), feet->place_of(lit));
  EXPECT_EQ(feet->plot.y.first, metres->plot.y.first) << "values stay in metres";
}

TEST(UnitsOfPictures, TimelinesFollow) {
  ObservationProduct p = map_example::product("obs-0001", 40);
  map_example::add_school(p, 9, p.pings[0].transducer, 5, 15, map_example::block(2, 1, 2, 24, 3));
  const TimelineObservation one{&p, nullptr};
  for (const EchogramHeight height : {EchogramHeight::range, EchogramHeight::depth}) {
    expect_follows(
        [&](const Theme& theme) {
          TimelineStyle style;
          style.height = height;
          return *timeline(std::span(&one, 1), style, kSize, theme);
        },
        "timeline");
  }
}

TEST(UnitsOfPictures, PropagationsFollow) {
  ObservationProduct p = map_example::product("obs-0001", 5);
  map_example::add_school(p, 4, p.pings[3].transducer, 3, 3, map_example::block(2, 1, 2, 24, 3));
  for (const MaskAspect aspect : {MaskAspect::above, MaskAspect::side}) {
    PropagationStyle style;
    style.aspect = aspect;
    const auto panels = propagation_panels(p, 3, style);
    expect_follows(
        [&](const Theme& theme) {
          return *propagation_view(p.grid->grid.sector(p.grid->range), panels, style, kSize, theme);
        },
        "propagation");
  }
}

TEST(UnitsOfPictures, VolumesFollow) {
  const Sector sector = slice_example::sectors()[0].sector;
  const Camera camera = overview(sector, kSize);
  expect_follows(
      [&](const Theme& theme) {
        FrameDescription frame{kSize, {}, {}, {}};
        ContextParams params;
        params.units = theme.units;
        params.heading_deg = 0.0;
        params.currents.longest_mps = 0.4;
        for (const double depth_m : current_depths(sector, params.transducer_depth_m, theme.units)) {
          params.currents.at.push_back({depth_m, 0.4, 0.0});
        }
        add_context_labels(frame, sector, params, basis(camera, kSize), theme);
        return frame;
      },
      "labels of the volume");
  expect_follows(
      [&](const Theme& theme) {
        FrameDescription frame{kSize, {}, {}, {}};
        const auto bar = distance_bar(camera, kSize, 150.0, theme.units.length());
        add_distance_bar(frame, *bar, distance_bar_place(*bar, 900.0, 700.0, theme), theme);
        return frame;
      },
      "scale bar of the volume");
  const SeabedPatch bed{2, 2, 0.0, 0.0, 10.0, {100.0F, 120.0F, 140.0F, 160.0F}};
  // 197 ft of depths: every 20 ft are ten lines, every 50 ft fewer.
  const double step_ft = seabed_line_step_m(bed, kFeet) / kFoot_m;
  EXPECT_TRUE(std::abs(step_ft - 20.0) < 1e-9 || std::abs(step_ft - 50.0) < 1e-9) << step_ft;
}

TEST(UnitsOfPictures, MapsFollow) {
  const std::vector<ObservationProduct> all{map_example::product("obs-0001", 60)};
  DepthGrid grid{59.9, 4.8, 0.005, 0.005, 60, 100, {}, "sea.nc"};
  for (int i = 0; i < grid.rows * grid.columns; ++i) grid.depth_m.push_back(static_cast<float>(100 + i % 100));
  const CurrentProfile profile{all[0].pings[5].time, all[0].pings[5].transducer, {{20, 0.4, 0.0}}};
  SurveyMapStyle style;
  style.currents = std::make_shared<const CurrentProfiles>(CurrentProfiles{profile});
  const auto draw = [&](const Theme& theme) { return *survey_map(all, {}, &grid, style, kSize, theme); };
  expect_follows(draw, "survey map");
  const FrameDescription feet = draw(read_in(kFeet));
  EXPECT_TRUE(says(feet, "depth (ft)"));
  EXPECT_TRUE(says(feet, "current at 66 ft depth")) << "20 m are 65.6 ft";
  EXPECT_TRUE(says(feet, "0.78")) << "0.4 * 3600 / 1852";
  // 83 to 373 m are 272 to 1224 ft: bands of 200 ft.
  ScalarField depths{{30, 1}, {}};
  for (int x = 0; x < 30; ++x) depths.values.push_back(static_cast<float>(83 + 10 * x));
  const DepthBands bands = depth_bands(depths, read_in(kFeet));
  ASSERT_GE(bands.levels_m.size(), 3U);
  EXPECT_LE(bands.levels_m.front(), 83.0);
  EXPECT_GE(bands.levels_m.back(), 373.0);
  for (const double level : bands.levels_m) EXPECT_NEAR(std::remainder(level / kFoot_m, 200.0), 0.0, 1e-6);
}

TEST(UnitsOfPictures, AScaleBarOfMapsIsOfTheUnitWhereItIsShort) {
  const PixelRect place{60.0, 40.0, 800.0, 600.0};
  const MapFrame near = fit_map({60.0, 60.004, 5.0, 5.008}, place);
  const ScaleBar metres = scale_bar(near, {70.0, 600.0}, 180.0, false);
  EXPECT_TRUE(metres.text.ends_with(" m")) << metres.text;
  const ScaleBar feet = scale_bar(near, {70.0, 600.0}, 180.0, false, kFeet);
  EXPECT_TRUE(feet.text.ends_with(" ft")) << feet.text;
  EXPECT_NEAR(std::stod(feet.text) * kFoot_m, feet.length_m, 1e-9);
  EXPECT_LE(feet.to.x - feet.from.x, 180.5);
  EXPECT_TRUE(scale_bar(near, {70.0, 600.0}, 180.0, true, kFeet).text.ends_with(" nmi"));
  const MapFrame far = fit_map({60.0, 60.5, 4.0, 5.5}, place);
  EXPECT_TRUE(scale_bar(far, {70.0, 600.0}, 180.0, false, kFeet).text.ends_with(" km"));
}

TEST(UnitsOfPictures, ChartsFollow) {
  ObservationProduct product;
  product.observation = "obs-0001";
  product.schools.emplace_back().school_id = 1;
  for (int ping = 0; ping < 30; ++ping) {
    SchoolPingRow& row = product.school_pings.emplace_back();
    row.school_id = 1;
    row.ping_index = ping;
    row.depth_m = 50.0 + 1.7 * ping;
    row.speed_smoothed_mps = 0.1 * ping;
  }
  const auto data = [&](const Theme& theme, const std::string& x, const std::string& y) {
    return *chart_data(std::span(&product, 1), {ChartTable::school_pings, x, y, true, theme.units});
  };
  expect_follows(
      [&](const Theme& theme) { return chart(data(theme, "ping_index", "depth_m"), {}, kSize, theme)->frame; },
      "chart of depths");
  EXPECT_TRUE(says(chart(data(read_in(kFeet), "speed_smoothed_mps", ""), {}, kSize, read_in(kFeet))->frame, "(kn)"));
  const ChartColumn depth = data(read_in(kFeet), "depth_m", "").x;
  EXPECT_EQ(column_text(depth, 30.48), "100 ft");
  EXPECT_EQ(column_text(*chart_column(ChartTable::school_pings, "volume_m3"), 12.0),
            column_text(shown_in(*chart_column(ChartTable::school_pings, "volume_m3"), kFeet), 12.0));
  // Bins are round numbers of feet, and hold what they say.
  std::vector<double> depths;
  for (const SchoolPingRow& row : product.school_pings) depths.push_back(row.depth_m);
  const ChartBins bins = chart_bins(depths, depth, 0);
  ASSERT_GE(bins.count(), 2U);
  const double width_ft = (bins.edges[1] - bins.edges[0]) / kFoot_m;
  for (const double edge : bins.edges) EXPECT_NEAR(std::remainder(edge / kFoot_m, width_ft), 0.0, 1e-6);
  const double lead = width_ft / std::pow(10.0, std::floor(std::log10(width_ft) + 1e-9));
  EXPECT_TRUE(std::abs(lead - 1.0) < 1e-6 || std::abs(lead - 2.0) < 1e-6 || std::abs(lead - 5.0) < 1e-6) << width_ft;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    EXPECT_LE(bins.edges[bins.bin_of_row[i]], depths[i] + 1e-9);
    EXPECT_GT(bins.edges[bins.bin_of_row[i] + 1], depths[i] - 1e-9);
  }
}

TEST(UnitsOfPictures, SectionsAndCourseLegsFollow) {
  EffortRow unit;
  unit.transect = "T1";
  unit.edsu = 1;
  unit.distance_nmi = 1.0;
  NascRow cell;
  cell.transect = "T1";
  cell.edsu = 1;
  cell.range_from_m = 15.24;
  cell.depth_from_m = 20.0;
  cell.depth_to_m = 30.0;
  cell.sv_mean_db = -50.0;
  cell.volume_m3 = 3.0;
  const auto section = [&](const Theme& theme) {
    return sv_section(std::span(&unit, 1), std::span(&cell, 1), 15.24, sv_colours(SvScale{}), kSize, theme)->frame;
  };
  expect_follows(section, "section of Sv");
  EXPECT_TRUE(says(section(read_in(kFeet)), "range bin from 50 ft"));
  const LegChartData legs{"Setup check", {{"2020-01-01 08:00:00", 45.0, 5.0, 12, 0.1, 0.02, -0.6, 0.1}}, {}};
  expect_follows([&](const Theme& theme) { return leg_chart(legs, kSize, theme)->frame; }, "course legs", "kn");
  EXPECT_NE(leg_text(legs.legs[0], kFeet).find("ship 9.7 kn"), std::string::npos) << leg_text(legs.legs[0], kFeet);
  EXPECT_NE(leg_text(legs.legs[0]).find("ship 5.0 m/s"), std::string::npos);
}

}  // namespace
}  // namespace sonar
