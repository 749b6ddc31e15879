// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/units.h"
#include "view/colour_map.h"
#include "view/label_room.h"
#include "view/slices/slice_example.h"
#include "view/volume/context_layout.h"
#include "view/volume/context_scene.h"

namespace sonar {
namespace {

std::vector<TextItem> labels_of(const Sector& sector, const ContextParams& params, const Camera& camera,
                                PixelSize size) {
  FrameDescription frame{size, {}, {}, {}};
  add_context_labels(frame, sector, params, basis(camera, size), light_theme(size));
  std::vector<TextItem> out;
  for (const auto& item : frame.items) out.push_back(std::get<TextItem>(item));
  return out;
}

bool overlap(const PixelRect& a, const PixelRect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

// A number stands beside its school where no trail runs, though it would have stood elsewhere.
TEST(ContextLabels, NumbersOfSchoolsKeepOffTrails) {
  constexpr PixelSize kPicture{800, 600};
  const Sector sector = slice_example::hand_sector();
  const Camera camera = overview(sector, kPicture);
  const CameraBasis eye = basis(camera, kPicture);
  ContextParams params;
  params.sector_frame = params.range_rings = params.sea_surface = params.ship = params.depth_axis = false;
  SchoolPlace school;
  school.middle = sector.centre(4, 3, 20);
  school.name = "7";
  for (const double d : {-8.0, 8.0}) school.edge.push_back(school.middle + Point<Sonar>{d, d, d});
  params.schools = {school};
  auto trails = std::make_shared<std::vector<SceneLine>>();
  std::vector<PixelRect> stood;
  // Whatever place it takes, the next trail runs there.
  for (int i = 0; i < 6; ++i) {
    params.trails = std::make_shared<const std::vector<SceneLine>>(*trails);
    const std::vector<TextItem> labels = labels_of(sector, params, camera, kPicture);
    ASSERT_EQ(labels.size(), 1U);
    const PixelRect box = LabelRoom::box_of(labels[0]);
    const PixelPoint middle{box.x + 0.5 * box.width, box.y + 0.5 * box.height};
    for (const PixelRect& before : stood)
      EXPECT_FALSE(inside(box, {before.x + 0.5 * before.width, before.y + 0.5 * before.height}));
    stood.push_back(box);
    const auto at = [&](double dy) {
      const Ray ray = eye.ray({middle.x, middle.y + dy});
      return ray.origin + ray.direction * 100.0;
    };
    trails->push_back({at(-1.0), at(1.0), {255, 0, 0, 255}});
  }
}

// A text of ten pixels is 12 high; "ab" is as wide as the theme says.
TEST(LabelRoom, NoLabelLiesOnAnotherOrReachesOut) {
  LabelRoom room({0.0, 0.0, 100.0, 50.0});
  TextItem label{{}, "ab", 10.0, {}, TextAnchor::centre};
  const auto at = [&](double x, double y) {
    const PixelPoint place{x, y};
    return room.place(label, std::span(&place, 1));
  };
  EXPECT_TRUE(at(50, 25));
  EXPECT_FALSE(at(50, 25 + 11.9));
  EXPECT_TRUE(at(50, 25 + 12.0));
  EXPECT_FALSE(at(20, 5.9)) << "reaches over the top";
  EXPECT_FALSE(at(99, 25)) << "reaches over the right";
  EXPECT_TRUE(at(20, 6.0));
}

TEST(LabelRoom, ALineIsAvoidedWhereThereIsAChoice) {
  LabelRoom room({0.0, 0.0, 100.0, 100.0});
  room.add_line({0, 0}, {100, 100});
  const TextItem label{{}, "ab", 10.0, {}, TextAnchor::centre};
  const std::array<PixelPoint, 2> on_then_beside{{{50, 50}, {75, 25}}};
  EXPECT_EQ(room.place(label, on_then_beside)->at, on_then_beside[1]);
  const std::array<PixelPoint, 1> only_on{{{50, 50}}};
  EXPECT_EQ(room.place(label, only_on)->at, only_on[0]);
  EXPECT_FALSE(room.place(label, only_on)) << "taken";
  const std::array<PixelPoint, 1> crossed{{{20, 20}}};
  EXPECT_FALSE(room.place(label, crossed, false)) << "rather none than on a line";
  EXPECT_TRUE(room.place(label, crossed)) << "nothing was taken";
}

// A small picture has fewer labels, and what is left crosses no line.
TEST(ContextLabels, ASmallPictureHasFewer) {
  const Sector sector = slice_example::sectors()[0].sector;
  const ContextParams params;
  const auto count = [&](PixelSize size) { return labels_of(sector, params, overview(sector, size), size).size(); };
  const std::size_t large = count({900, 700});
  const std::size_t small = count({250, 200});
  EXPECT_GE(small, 3U);
  EXPECT_LE(small, 2 * large / 3);
  constexpr PixelSize kSmall{250, 200};
  const CameraBasis camera = basis(overview(sector, kSmall), kSmall);
  ContextParams lines = params;
  lines.ship = lines.sea_surface = false;
  for (const TextItem& label : labels_of(sector, params, overview(sector, kSmall), kSmall)) {
    const PixelRect box = LabelRoom::box_of(label);
    for (const SceneLine& line : context_scene(sector, lines, light_theme(kSmall)).lines) {
      const auto a = camera.project(line.from);
      const auto b = camera.project(line.to);
      if (!a || !b) continue;
      for (int i = 0; i <= 200; ++i) {
        const PixelPoint p{a->pixel.x + i / 200.0 * (b->pixel.x - a->pixel.x),
                           a->pixel.y + i / 200.0 * (b->pixel.y - a->pixel.y)};
        ASSERT_FALSE(p.x > box.x && p.x < box.x + box.width && p.y > box.y && p.y < box.y + box.height) << label.text;
      }
    }
  }
}

// Law: for every sector and from everywhere, labels leave each other room and stay in the picture.
TEST(ContextLabels, NeverCollide) {
  constexpr PixelSize kSize{540, 420};
  ContextParams params;
  std::size_t most = 0;
  for (const auto& [name, sector] : slice_example::sectors()) {
    for (int turn = 0; turn < 360; turn += 15) {
      for (const double rise : {-40.0, 0.0, 30.0}) {
        for (const double zoom : {0.5, 1.0, 3.0}) {
          const Camera camera =
              zoomed(orbited(overview(sector, kSize), rad_from_deg(turn), rad_from_deg(rise)), 1.0 / zoom);
          const std::vector<TextItem> labels = labels_of(sector, params, camera, kSize);
          most = std::max(most, labels.size());
          for (std::size_t i = 0; i < labels.size(); ++i) {
            const PixelRect box = LabelRoom::box_of(labels[i]);
            ASSERT_TRUE(box.x >= 0 && box.y >= 0 && box.x + box.width <= kSize.width &&
                        box.y + box.height <= kSize.height)
                << name << ' ' << labels[i].text;
            for (std::size_t k = 0; k < i; ++k) {
              ASSERT_FALSE(overlap(box, LabelRoom::box_of(labels[k])))
                  << name << ' ' << turn << ' ' << labels[i].text << " on " << labels[k].text;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(most, 12U);
}

// Both are metres: every label says of which, but in a small picture one of each does.
TEST(ContextLabels, RangesAndDepthsAreToldApart) {
  const Sector sector = slice_example::sectors()[0].sector;
  for (const PixelSize size : {PixelSize{900, 700}, PixelSize{280, 230}}) {
    int ranges = 0;
    int depths = 0;
    int bare = 0;
    for (const TextItem& label : labels_of(sector, {}, overview(sector, size), size)) {
      ranges += label.text.starts_with("range ") ? 1 : 0;
      depths += label.text.starts_with("depth ") ? 1 : 0;
      bare += label.text.ends_with(" m") && std::isdigit(static_cast<unsigned char>(label.text[0])) != 0 ? 1 : 0;
    }
    EXPECT_GE(ranges, 1);
    EXPECT_GE(depths, 1);
    if (size.width == 900) {
      EXPECT_EQ(bare, 0);
      EXPECT_GE(ranges, 3);
      EXPECT_GE(depths, 2);
    } else {
      EXPECT_EQ(ranges, 1);
      EXPECT_EQ(depths, 1);
    }
  }
}

// From above, 1200 m up, 60 degrees: a metre is 0.5 pixels (300 / (1000 tan 30) = 0.52). The sector of 200 m looks to
// port, its first edge at 242.5: the rings' labels lie beyond it, aft; nothing crosses the sector's own lines.
TEST(ContextLabels, StandBesideWhatTheyName) {
  const Sector sector = slice_example::sectors()[0].sector;
  constexpr PixelSize kSize{600, 600};
  const Camera camera{{0.0, -100.0, -600.0}, {0.0, -100.0, 0.0}, {1.0, 0.0, 0.0}, rad_from_deg(60.0)};
  const CameraBasis b = basis(camera, kSize);
  ContextParams params;
  params.depth_axis = false;
  const std::vector<TextItem> labels = labels_of(sector, params, camera, kSize);
  const double edge = sector.azimuth_rad(0);
  for (const std::string text : {"50 m", "100 m", "150 m"}) {
    const auto label =
        std::find_if(labels.begin(), labels.end(), [&](const TextItem& t) { return t.text == "range " + text; });
    ASSERT_NE(label, labels.end()) << text;
    const double radius = std::stod(text);
    const PixelPoint tick = b.project(on_surface(radius, edge, -7.0))->pixel;
    EXPECT_GT(label->at.y, tick.y) << "aft is down";
    EXPECT_LT(std::hypot(label->at.x - tick.x, label->at.y - tick.y), 4.0 * label->size_px);
    const PixelRect box = LabelRoom::box_of(*label);
    for (int i = 0; i <= 400; ++i) {
      const PixelPoint p = b.project(on_surface(i * 0.5, edge, -7.0))->pixel;
      EXPECT_FALSE(p.x > box.x && p.x < box.x + box.width && p.y > box.y && p.y < box.y + box.height) << text;
    }
  }
  const auto has = [&](const std::string& text) {
    return std::any_of(labels.begin(), labels.end(), [&](const TextItem& t) { return t.text == text; });
  };
  EXPECT_TRUE(has("270\u00B0"));
}

// A wall before the lower part of the picture hides what is labelled there, and only that; one far behind hides nothing.
TEST(ContextLabels, WhatIsHiddenHasNone) {
  const Sector sector = slice_example::sectors()[0].sector;
  constexpr PixelSize kSize{600, 500};
  const auto labels = [&](int wall_from_row) {
    std::vector<float> metres(60 * 50, 1e9F);
    std::fill(metres.begin() + 60 * wall_from_row, metres.end(), 1.0F);
    FrameDescription frame{kSize, {}, {}, {}};
    add_context_labels(frame, sector, {}, basis(overview(sector, kSize), kSize), light_theme(kSize),
                       {{60, 50}, metres});
    std::vector<TextItem> out;
    for (const auto& item : frame.items) out.push_back(std::get<TextItem>(item));
    return out;
  };
  const auto lower = [](const TextItem& a, const TextItem& b) { return a.at.y < b.at.y; };
  const std::vector<TextItem> all = labels(50);
  const double highest = std::min_element(all.begin(), all.end(), lower)->at.y;
  const double lowest = std::max_element(all.begin(), all.end(), lower)->at.y;
  const int wall = static_cast<int>((highest + lowest) / 2.0 / 10.0);
  const std::vector<TextItem> left = labels(wall);
  // A label stands within three of its heights from its place.
  const double room = 3.0 * all.front().size_px;
  ASSERT_GT(lowest - highest, 2.5 * room);
  for (const TextItem& t : left) EXPECT_LT(t.at.y, 10.0 * wall + room) << t.text;
  for (const TextItem& t : all) {
    const bool shown = std::any_of(left.begin(), left.end(), [&](const TextItem& l) { return l.text == t.text; });
    EXPECT_TRUE(shown || t.at.y > 10.0 * wall - room) << t.text;
  }
  EXPECT_TRUE(labels(0).empty());
}

// Heading 100: what lies at 260 from the bow bears 360, which is written 000.
TEST(ContextLabels, BearingsAreClockwiseFromNorthOrFromTheBow) {
  ContextParams params;
  EXPECT_EQ(bearing_text(rad_from_deg(260.0), params), "260\u00B0");
  EXPECT_EQ(bearing_text(rad_from_deg(-100.0), params), "260\u00B0");
  params.heading_deg = 100.0;
  EXPECT_EQ(bearing_text(rad_from_deg(260.0), params), "000\u00B0");
}

// Fans up to 4 degrees below the level reach 199 cos 4 m sideways; all round and level: all of the range.
TEST(ContextLabels, TheSurfaceReachesToTheSectorsEdge) {
  const auto sectors = slice_example::sectors();
  const SurfaceGrid port = surface_grid(sectors[1].sector, {});
  EXPECT_NEAR(port.edge_m, 199.0 * std::cos(rad_from_deg(4.0)), 1e-9);
  EXPECT_LE(port.radii_m.back(), port.edge_m);
  const ContextScene scene = context_scene(sectors[1].sector, {}, light_theme({640, 480}));
  double farthest = 0.0;
  for (const SceneTriangle& t : scene.translucent) {
    for (const Point<Sonar>& p : t.corners) farthest = std::max(farthest, std::hypot(p.x, p.y));
  }
  EXPECT_NEAR(farthest, port.edge_m, 1e-9);
}

TEST(SeabedColours, SpanWhatLiesBelowTheSea) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(depth_span({2, 2, 0, 0, 1, {none, -30.0F, 120.0F, 300.0F}}), (std::pair{120.0, 300.0}));
  EXPECT_EQ(depth_span({2, 1, 0, 0, 1, {200.0F, 200.0F}}), (std::pair{199.5, 200.5}));
  EXPECT_FALSE(depth_span({2, 1, 0, 0, 1, {none, -1.0F}}));
}

// A ridge one metre high on a hundred: its slopes have the same depths, and the light tells one from the other.
TEST(SeabedRelief, AGentleRidgeIsSeenAndItsPlacesAreTrue) {
  SeabedPatch bed{21, 3, -100.0, -10.0, 10.0, {}};
  for (int iy = 0; iy < 3; ++iy) {
    for (int ix = 0; ix < 21; ++ix) bed.depth_m.push_back(static_cast<float>(100.0 + 0.01 * std::abs(ix - 10) * 10.0));
  }
  EXPECT_NEAR(relief_exaggeration(bed), 60.0, 0.1);  // the light makes a slope of 0.6 of one of 0.01
  ContextParams params;
  params.sector_frame = params.range_rings = params.sea_surface = params.ship = params.depth_axis = false;
  const ContextScene scene = context_scene(slice_example::hand_sector(), params, light_theme({640, 480}), bed);
  double least = 1e9;
  for (const SceneTriangle& a : scene.opaque) {
    for (const Point<Sonar>& corner : a.corners) {
      EXPECT_NEAR(corner.z + params.transducer_depth_m, 100.0 + 0.01 * std::abs(corner.x), 1e-4);
    }
    const double x = (a.corners[0].x + a.corners[1].x + a.corners[2].x) / 3.0;
    for (const SceneTriangle& b : scene.opaque) {
      const double other = (b.corners[0].x + b.corners[1].x + b.corners[2].x) / 3.0;
      if (x < 0.0 && std::abs(x + other) < 1.0)
        least = std::min(least, std::abs(lightness(a.colour) - lightness(b.colour)));
    }
  }
  EXPECT_GT(least, 5.0);
  EXPECT_EQ(relief_exaggeration({3, 3, 0.0, 0.0, 10.0, std::vector<float>(9, 50.0F)}), 1.0) << "level";
}

// Lines of equal depth lie at round depths, on the seabed.
TEST(SeabedRelief, ContoursLieAtTheirDepths) {
  SeabedPatch bed{5, 5, 0.0, 0.0, 10.0, {}};
  for (int iy = 0; iy < 5; ++iy) {
    for (int ix = 0; ix < 5; ++ix) bed.depth_m.push_back(static_cast<float>(101.3 + 2.0 * ix));
  }
  EXPECT_EQ(seabed_line_step_m(bed), 1.0);
  ContextParams params;
  params.sector_frame = params.range_rings = params.sea_surface = params.ship = params.depth_axis = false;
  const ContextScene scene = context_scene(slice_example::hand_sector(), params, light_theme({640, 480}), bed);
  int level = 0;
  for (const SceneLine& line : scene.lines) {
    const double depth = line.from.z + params.transducer_depth_m;
    EXPECT_NEAR(depth, 101.3 + 0.2 * line.from.x, 1e-3);
    if (std::abs(line.from.x - line.to.x) > 1e-6 || line.colour.a < 100) continue;
    EXPECT_NEAR(depth, std::round(depth), 1e-6);
    ++level;
  }
  EXPECT_EQ(level, 8 * 4);  // 102 to 109 m, four cells each
}

// A level seabed has the colours of its scale.
TEST(SeabedColours, AreThoseOfALevelSeabed) {
  SeabedPatch bed{3, 3, -10.0, -10.0, 10.0, std::vector<float>(9, 300.0F)};
  ContextParams params;
  params.ship = false;
  bed.depth_m[0] = 300.001F;  // not quite, so that the scale has two ends
  const ContextScene scene = context_scene(slice_example::hand_sector(), params, light_theme({640, 480}), bed);
  ASSERT_EQ(scene.opaque.size(), 8U);
  EXPECT_EQ(scene.opaque.back().colour, seabed_colours().at(0.5));
}

}  // namespace
}  // namespace sonar
