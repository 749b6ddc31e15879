// SPDX-License-Identifier: Apache-2.0
#include "session/looks/curves.h"

#include <gtest/gtest.h>

#include "session/test_app.h"

namespace sonar {
namespace {

/// Opacity of a curve at a level, by its corners.
double opacity_at(const TransferFunction& curve, double sv_db) {
  const auto corners = corners_of(curve);
  if (sv_db <= corners.front().sv_db) return corners.front().opacity;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const OpacityPoint& a = corners[i - 1];
    const OpacityPoint& b = corners[i];
    if (sv_db <= b.sv_db) return a.opacity + (b.opacity - a.opacity) * (sv_db - a.sv_db) / (b.sv_db - a.sv_db);
  }
  return corners.back().opacity;
}

bool white(const TransferFunction& curve) {
  for (const TransferPoint& point : curve.points()) {
    if (point.rgb[0] < 1.0 || point.rgb[1] < 1.0 || point.rgb[2] < 1.0) return false;
  }
  return true;
}

class LinkedCurves : public testing::Test, protected TestApp {
 protected:
  void SetUp() override { begin(); }
  void expect_same_opacity() {
    for (double sv = -90.0; sv <= -10.0; sv += 2.5) {
      EXPECT_NEAR(opacity_at(app_->workspace.view_curve(), sv), opacity_at(app_->workspace.growth_curve(), sv), 1e-9)
          << sv;
    }
  }
};

TEST_F(LinkedCurves, HaveOneOpacityAndKeepTheColoursApart) {
  Workspace& w = workspace();
  w.curves_linked.set(true);
  expect_same_opacity();
  w.growth_curve.set(*growth_curve_of({{-66.0, 0.1}, {-40.0, 0.8}}));
  expect_same_opacity();
  EXPECT_NEAR(opacity_at(w.view_curve(), -53.0), 0.45, 1e-9);
  EXPECT_FALSE(white(w.view_curve()));
  EXPECT_TRUE(white(w.growth_curve()));
  w.view_curve.set(*curve_of(w.display.values().scale, {{-70.0, 0.0}, {-50.0, 0.5}}));
  expect_same_opacity();
  EXPECT_TRUE(white(w.growth_curve()));
}

TEST_F(LinkedCurves, ADrawnCurveKeepsItsShapeAndTakesTheColoursOfTheScale) {
  Workspace& w = workspace();
  w.curve_follows_scale.set(false);
  w.view_curve.set(*curve_of(w.display.values().scale, {{-66.0, 0.1}, {-40.0, 0.8}}));
  const auto before = w.view_curve();
  DisplayParams changed = w.display.values();
  changed.scale.map = ColourMapName::thermal;
  w.display.assign(changed);
  queue_.drain();
  EXPECT_NEAR(opacity_at(w.view_curve(), -53.0), opacity_at(before, -53.0), 1e-9);
  EXPECT_FALSE(w.view_curve() == before);
  EXPECT_FALSE(w.curve_follows_scale());
}

}  // namespace
}  // namespace sonar
