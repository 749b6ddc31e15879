// SPDX-License-Identifier: Apache-2.0
#include "view/maps/map_frame.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geo/geodesic.h"
#include "view/maps/graticule.h"
#include "view/maps/scale_bars.h"

namespace sonar {
namespace {

constexpr PixelRect kPlace{50.0, 40.0, 800.0, 600.0};
const GeoExtent kExtents[] = {
    {60.0, 60.5, 4.0, 5.5}, {-45.2, -44.9, 179.5, 180.7}, {84.0, 84.6, -20.0, -10.0}, {2.0, 2.2, 10.0, 10.1}};

TEST(MapFrame, FitsTheExtentAndGoesThereAndBack) {
  for (const GeoExtent& e : kExtents) {
    const MapFrame map = fit_map(e, kPlace);
    bool touches = false;
    for (int i = 0; i <= 20; ++i) {
      for (int j = 0; j <= 20; ++j) {
        const Geographic place{e.south_deg + (e.north_deg - e.south_deg) * i / 20.0,
                               wrap_180(e.west_deg + (e.east_deg - e.west_deg) * j / 20.0)};
        const PixelPoint p = *map.at(place);
        EXPECT_GT(p.x, kPlace.x - 0.5);
        EXPECT_LT(p.x, kPlace.x + kPlace.width + 0.5);
        EXPECT_GT(p.y, kPlace.y - 0.5);
        EXPECT_LT(p.y, kPlace.y + kPlace.height + 0.5);
        touches = touches || p.x < kPlace.x + 0.5 || p.y < kPlace.y + 0.5;
        const Geographic back = *map.geographic(p);
        EXPECT_NEAR(back.latitude_deg, place.latitude_deg, 1e-9);
        EXPECT_NEAR(wrap_180(back.longitude_deg - place.longitude_deg), 0.0, 1e-9);
      }
    }
    EXPECT_TRUE(touches);  // as large as it goes
    // North is up: a place farther north is higher.
    EXPECT_LT(map.at(Geographic{e.north_deg, e.middle().longitude_deg})->y,
              map.at(Geographic{e.south_deg, e.middle().longitude_deg})->y);
  }
}

TEST(MapFrame, PixelPlacesAreTheExactOnesToAHundredthOfAPixel) {
  for (const GeoExtent& e : kExtents) {
    const MapFrame map = fit_map(e, kPlace);
    const PixelPlaces places(map, {800, 600}, 1.0);
    for (int y = 0; y < 600; y += 37) {
      for (int x = 0; x < 800; x += 41) {
        const PixelPoint p = *map.at(places.at(x, y));
        EXPECT_NEAR(p.x, kPlace.x + x + 0.5, 0.01);
        EXPECT_NEAR(p.y, kPlace.y + y + 0.5, 0.01);
      }
    }
  }
}

TEST(MapZoom, WhatLiesUnderThePointerStaysThereAndOutIsTheWholeAgain) {
  const MapFrame whole = fit_map(kExtents[0], kPlace);
  const PixelPoint at{700.0, 120.0};
  MapZoom zoom = zoomed_about(kPlace, whole.metres_per_px, {}, at, 3.0);
  zoom = zoomed_about(kPlace, whole.metres_per_px, zoom, at, 2.0);
  const MapFrame near = zoomed(whole, zoom);
  EXPECT_NEAR(near.metres_per_px, whole.metres_per_px / 6.0, 1e-9);
  EXPECT_NEAR(near.plane(at).x, whole.plane(at).x, 1e-6);
  EXPECT_NEAR(near.plane(at).y, whole.plane(at).y, 1e-6);
  const PixelPoint to{650.0, 300.0};
  const MapFrame panned = zoomed(whole, dragged(whole.metres_per_px, zoom, at, to));
  EXPECT_NEAR(panned.plane(to).x, near.plane(at).x, 1e-6);
  EXPECT_NEAR(panned.plane(to).y, near.plane(at).y, 1e-6);
  EXPECT_EQ(zoomed_about(kPlace, whole.metres_per_px, zoom, at, 1e-9), MapZoom{});
  EXPECT_EQ(zoomed_about(kPlace, whole.metres_per_px, zoom, at, 1e9).factor, 1000.0);
}

TEST(Graticule, EveryLabelStandsAtItsDegree) {
  for (const GeoExtent& e : kExtents) {
    const MapFrame map = fit_map(e, kPlace);
    const Graticule g = graticule(map, 120.0);
    EXPECT_GE(g.latitudes.size(), 2U);
    EXPECT_GE(g.longitudes.size(), 2U);
    for (const auto& label : g.latitudes) {
      EXPECT_DOUBLE_EQ(label.at.x, kPlace.x);
      const double pixel_deg = map.metres_per_px / 111'000.0;
      EXPECT_NEAR(map.geographic(label.at)->latitude_deg, label.degrees, pixel_deg);
    }
    for (const auto& label : g.longitudes) {
      EXPECT_DOUBLE_EQ(label.at.y, kPlace.y + kPlace.height);
      const PixelPoint p = *map.at(Geographic{map.geographic(label.at)->latitude_deg, label.degrees});
      EXPECT_NEAR(p.x, label.at.x, 1.0);
    }
  }
}

TEST(Graticule, DegreesAreWrittenAsOnCharts) {
  EXPECT_EQ(latitude_text(60.5, 0.5), "60°30′ N");
  EXPECT_EQ(latitude_text(-60.0, 1.0), "60° S");
  EXPECT_EQ(latitude_text(0.0, 1.0), "0°");
  EXPECT_EQ(longitude_text(-3.75, 0.25), "3°45′ W");
  EXPECT_EQ(longitude_text(5.0 - 1e-12, 0.5), "5°00′ E");
  EXPECT_EQ(longitude_text(4.0 + 20.0 / 3600.0, 20.0 / 3600.0), "4°00′20″ E");
  EXPECT_EQ(longitude_text(180.0, 1.0), "180°");
  EXPECT_EQ(longitude_text(181.5, 0.5), "178°30′ W");
}

TEST(ScaleBar, IsTrueWithinHalfAPercentAtItsPlace) {
  for (const GeoExtent& e : kExtents) {
    const MapFrame map = fit_map(e, kPlace);
    for (const bool nautical : {true, false}) {
      for (const PixelPoint left : {PixelPoint{70.0, 600.0}, PixelPoint{600.0, 60.0}}) {
        const ScaleBar bar = scale_bar(map, left, 180.0, nautical);
        EXPECT_LE(bar.to.x - bar.from.x, 180.5);
        EXPECT_GE(bar.to.x - bar.from.x, 60.0);
        const double metres = geodesic(*map.geographic(bar.from), *map.geographic(bar.to)).distance_m;
        EXPECT_NEAR(metres / bar.length_m, 1.0, 0.005) << bar.text;
      }
    }
  }
  EXPECT_EQ(scale_bar(fit_map({60.0, 60.5, 4.0, 5.5}, kPlace), {70.0, 600.0}, 180.0, true).text, "10 nmi");
}

// Lower left, lower right, upper left: the first that hides fewest symbols, then least else.
TEST(ScaleBar, StandsInTheCornerThatHidesLeast) {
  const MapFrame map = fit_map({60.0, 60.5, 4.0, 5.5}, kPlace);
  const Theme theme = light_theme({640, 480});
  const double em = theme.text_px;
  const PixelPoint lower_left{map.place.x + 2.0 * em, map.place.y + map.place.height - 2.0 * em};
  const PixelPoint lower_right{map.place.x + map.place.width - 2.0 * em, lower_left.y};
  const PixelPoint upper_left{lower_left.x, map.place.y + 2.0 * em};
  using Points = std::vector<PixelPoint>;
  const auto stands_over = [&](const PixelPoint& corner, const Points& symbols, const Points& besides) {
    const auto bars = scale_bars(map, theme, symbols, besides);
    return bars && inside(bars->place, corner);
  };
  EXPECT_TRUE(stands_over(lower_left, {}, {}));
  EXPECT_TRUE(stands_over(lower_right, {}, {lower_left}));
  EXPECT_TRUE(stands_over(upper_left, {lower_left}, {lower_right}));
  EXPECT_TRUE(stands_over(upper_left, {lower_left, lower_right}, {}));
  EXPECT_TRUE(stands_over(lower_left, {lower_right, upper_left}, {lower_left}));
  EXPECT_TRUE(stands_over(lower_left, {lower_left, lower_right, upper_left}, {}));
}

TEST(MapFrame, ShowsAllMeridiansWhereThePoleIsInThePicture) {
  const GeoExtent e = shown_extent(fit_map({88.5, 90.0, -180.0, 180.0}, kPlace));
  EXPECT_EQ(e.north_deg, 90.0);
  EXPECT_NEAR(e.east_deg - e.west_deg, 360.0, 1e-9);
}

}  // namespace
}  // namespace sonar
