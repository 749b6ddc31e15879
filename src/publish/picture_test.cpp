// SPDX-License-Identifier: Apache-2.0
#include "publish/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/test_paths.h"
#include "io/depth_raster.h"
#include "io/product_example.h"
#include "publish/reports/sample_looks.h"
#include "view/slices/slice_picture.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr PixelSize kSize{400, 300};
constexpr std::array kKinds{PictureKind::slice_top,   PictureKind::slice_side,      PictureKind::slice_range,
                            PictureKind::slice_plane, PictureKind::volume,          PictureKind::propagation,
                            PictureKind::survey_map,  PictureKind::observation_map, PictureKind::timeline,
                            PictureKind::echogram,    PictureKind::chart,           PictureKind::lineage,
                            PictureKind::report};

/// One observation of five pings off Norway with two schools; no raw files.
class Pictures : public testing::Test {
 protected:
  Pictures() {
    ObservationProduct product = example::empty("obs-0001", 5);
    example::add_school(product, 1, 0, 3, example::block(1, 1, 2, 20, 8, 200));
    example::add_school(product, 2, 2, 4, example::block(0, 0, 3, 40, 5));
    source_ = PictureSource::of(nullptr, {product}, Recipe{});
    options_.size = kSize;
    options_.volume.frames = 0;
    options_.volume.renderer = RendererChoice::cpu;
  }
  Result<FrameDescription> picture(PictureKind kind, const std::string& observation = "") {
    return picture_frame(kind, *source_, observation, options_, work_);
  }
  /// Refused with one line that says these words.
  void refused(PictureKind kind, const std::string& says, const std::function<void(PictureOptions&)>& change,
               const std::string& observation = "") {
    const PictureOptions before = options_;
    change(options_);
    const auto made = picture(kind, observation);
    options_ = before;
    ASSERT_FALSE(made) << says;
    const std::string line = to_line(made.error());
    EXPECT_THAT(line, testing::HasSubstr(says));
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
  static std::vector<std::string> texts(const FrameDescription& frame) {
    std::vector<std::string> out;
    for (const auto& item : frame.items) {
      if (const auto* text = std::get_if<TextItem>(&item)) out.push_back(text->text);
    }
    return out;
  }

  std::unique_ptr<PictureSource> source_;
  PictureOptions options_;
  Work work_{2};
};

TEST_F(Pictures, EveryKindIsMadeOfAProductAlone) {
  EXPECT_EQ(picture_kinds().size(), kKinds.size() + 4)
      << "a movie is no single picture, noise, frequencies and curves are of samples";
  refused(PictureKind::frequency, "name the raw files of obs-0001 too", [](PictureOptions&) {});
  refused(PictureKind::curves, "name the raw files of obs-0001 too", [](PictureOptions&) {});
  refused(PictureKind::noise_steps, "name the raw files of obs-0001 too", [](PictureOptions&) {});
  for (const PictureKind kind : kKinds) {
    const auto frame = picture(kind);
    ASSERT_TRUE(frame) << to_line(frame.error());
    EXPECT_EQ(frame->size, kind == PictureKind::report ? PixelSize(794, 1123) : kSize);
    EXPECT_THAT(texts(*frame), testing::Contains(testing::HasSubstr("SYNTHETIC")));
    EXPECT_GT(frame->items.size(), 5U);
  }
}

TEST_F(Pictures, TheSameTwiceIsTheSame) {
  for (const PictureKind kind : kKinds) {
    const auto first = picture(kind);
    const auto second = picture(kind);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(texts(*first), texts(*second));
    EXPECT_EQ(first->items.size(), second->items.size());
  }
}

TEST_F(Pictures, AnEchogramAgainstDepthTakesALineOfEchoview) {
  const fs::path file = test::scratch_path("seabed.evl");
  std::ofstream(file) << "EVBD 3 13.0\n2\n20200102 0800000000 20 3\n20200103 0800000000 40 3\n";
  options_.line = file;
  options_.kind.echogram.depth = true;
  auto frame = picture(PictureKind::echogram);
  ASSERT_TRUE(frame) << to_line(frame.error());
  EXPECT_THAT(texts(*frame), testing::Contains(file.filename().string()));
  std::ofstream(file) << "EVBD 3 13.0\n2\n20200102 0800000000 deep 3\n";
  refused(PictureKind::echogram, "line 3: expected CCYYMMDD", [](PictureOptions&) {});
  fs::remove(file);
  refused(PictureKind::echogram, file.string(), [](PictureOptions&) {});
}

TEST_F(Pictures, BadChoicesAreRefusedInOneLine) {
  using enum PictureKind;
  for (const PictureKind kind : {slice_top, volume, propagation}) {
    refused(kind, "no ping 99", [](PictureOptions& o) { o.ping = 99; });
    refused(kind, "no school 7", [](PictureOptions& o) { o.schools = {7}; });
  }
  refused(
      slice_top, "obs-0009", [](PictureOptions&) {}, "obs-0009");
  refused(slice_top, "no fan 3", [](PictureOptions& o) { o.fan = 3; });
  refused(slice_side, "no beam 4", [](PictureOptions& o) { o.beam = 4; });
  refused(echogram, "no fan 3 in obs-0001", [](PictureOptions& o) { o.fan = 3; });
  refused(echogram, "no beam 4", [](PictureOptions& o) { o.beam = 4; });
  refused(echogram, "no pings 3 to 9 in obs-0001: it has pings 0 to 4", [](PictureOptions& o) {
    o.kind.echogram.from_ping = 3;
    o.kind.echogram.to_ping = 9;
  });
  refused(echogram, "choose them with fan and beam", [](PictureOptions& o) { o.kind.echogram.channel = "38"; });
  refused(echogram, "no sounder without fans", [](PictureOptions& o) { o.kind.echogram.below = "auto"; });
  refused(echogram, "no observation obs-0009", [](PictureOptions& o) { o.kind.echogram.below = "obs-0009"; });
  refused(slice_range, "900", [](PictureOptions& o) { o.kind.slice_range.range_m = 900.0; });
  refused(slice_plane, "does not meet", [](PictureOptions& o) {
    o.kind.slice_plane.plane = PlaneLies::horizontal;
    o.kind.slice_plane.depth_m = 900.0;
  });
  refused(volume, "width_px = 40", [](PictureOptions& o) { o.size = {40, 30}; });
  for (const PictureKind kind : {volume, survey_map}) {
    refused(kind, "no such depth raster", [](PictureOptions& o) { o.depth_raster = "nowhere.tif"; });
  }
}

TEST_F(Pictures, WhyThereIsNoGridIsSaid) {
  ObservationProduct product = example::empty("obs-0001", 5);
  product.grid.reset();
  product.diagnostics.push_back(
      {DiagnosticCode::no_grid, "", -1, -1, "the beams make no product grid: ME70 does not look sideways in fans"});
  source_ = PictureSource::of(nullptr, {product}, Recipe{});
  const std::string line =
      "the beams of obs-0001 make no grid of fans and beams to draw: ME70 does not look sideways in fans";
  for (const PictureKind kind : {PictureKind::slice_top, PictureKind::volume, PictureKind::propagation}) {
    refused(kind, line, [](PictureOptions&) {});
  }
}

// The default draws every cell with its own value; what is asked for beside that is said in a key.
TEST_F(Pictures, SlicesArePlainAndNameTheirSchools) {
  EXPECT_EQ(flag_style(PictureOptions{}.display), FlagStyle{});
  EXPECT_FALSE(weak_below(PictureOptions{}.display));
  options_.ping = 2;
  options_.fan = 0;  // where school 2 is; school 1 is in the next one
  EXPECT_THAT(texts(*picture(PictureKind::slice_top)), testing::Not(testing::Contains("school 1, unreviewed")));
  EXPECT_THAT(texts(*picture(PictureKind::slice_top)), testing::Contains("school 2, unreviewed"));
  options_.fan = 1;
  const auto plain = texts(*picture(PictureKind::slice_top));
  EXPECT_THAT(plain, testing::Contains("school 1, unreviewed"));
  EXPECT_THAT(plain, testing::Not(testing::Contains("school 2, unreviewed")));
  EXPECT_THAT(plain, testing::Not(testing::Contains(testing::HasSubstr("near field"))));
  options_.display.removed = NoiseLook::hatched;
  EXPECT_THAT(texts(*picture(PictureKind::slice_top)), testing::Contains("faded: near field, surface, seabed"));
  options_.schools = {2};
  EXPECT_THAT(texts(*picture(PictureKind::slice_top)), testing::Not(testing::Contains("school 1, unreviewed")));
}

// A school's number and its colour are the same in a volume's legend, in the slice's outline and on the map.
TEST_F(Pictures, TheObservationMapNumbersItsSchoolsInTheirColours) {
  options_.ping = 2;
  for (const int school : {1, 2}) {  // one lies on the other: alone each has room for its number
    options_.schools = {school};
    EXPECT_THAT(texts(*picture(PictureKind::observation_map)),
                testing::IsSupersetOf({std::to_string(school), std::string("current ping"),
                                       std::string("path of a school, unreviewed")}));
  }
  options_.schools.clear();
  const auto map = picture(PictureKind::observation_map);
  ASSERT_TRUE(map);
  const auto strokes = [&](const FrameDescription& frame, Rgba8 colour) {
    return std::count_if(frame.items.begin(), frame.items.end(), [&](const auto& item) {
      const auto* path = std::get_if<PathItem>(&item);
      return path != nullptr && path->stroke.colour == colour;
    });
  };
  for (const int school : {1, 2}) {
    options_.fan = school == 1 ? 1 : 0;
    const auto slice = picture(PictureKind::slice_top);
    EXPECT_EQ(strokes(*map, school_colour(school)), 1) << school;
    EXPECT_EQ(strokes(*slice, school_colour(school)), 1) << school;
  }
  EXPECT_EQ(strokes(*map, school_colour(0)), 0);
  const auto* masks = [&]() -> const Image* {
    for (const auto& item : map->items) {
      if (const auto* image = std::get_if<ImageItem>(&item)) return image->image.get();
    }
    return nullptr;
  }();
  ASSERT_NE(masks, nullptr);
  for (const Rgba8& pixel : masks->pixels) {
    const Rgba8 opaque = with_alpha(pixel, 255);
    ASSERT_TRUE(pixel.a == 0 || opaque == school_colour(1) || opaque == school_colour(2));
  }
}

// Depths rise by 10 m a hundredth of a degree northwards, 300 m where the ship is.
TEST_F(Pictures, AVolumeWithASeabedHasAScaleOfItsDepths) {
  const fs::path file = test::scratch_path(".tif");
  DepthGrid grid;
  grid.rows = grid.columns = 4;
  grid.south_deg = 59.985;
  grid.west_deg = 4.985;
  grid.step_latitude_deg = grid.step_longitude_deg = 0.01;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) grid.depth_m.push_back(285.0F + 10.0F * static_cast<float>(row));
  }
  ASSERT_TRUE(write_depth_raster(file, grid));
  const auto without = picture(PictureKind::volume);
  options_.depth_raster = file;
  const auto with = picture(PictureKind::volume);
  fs::remove(file);
  ASSERT_TRUE(without);
  ASSERT_TRUE(with) << to_line(with.error());
  EXPECT_THAT(texts(*without), testing::Not(testing::Contains("seabed depth (m)")));
  EXPECT_THAT(texts(*with), testing::Contains("seabed depth (m)"));
  // Ends of the scale: +- 117 x 1.1 m northwards are +- 0.00116 degrees, +- 1.2 m; the first ping lies at 60 degrees.
  EXPECT_THAT(texts(*with), testing::IsSupersetOf({"298.8", "301.2"}));
}

// A raster that ends at the ship's longitude: half of what the picture has room for, and up to a node's step (28 of
// 258 m) more, as far as the outermost nodes are believed.
TEST_F(Pictures, AVolumeSaysHowMuchOfTheSeabedIsKnown) {
  const fs::path file = test::scratch_path(".tif");
  DepthGrid grid;
  grid.rows = grid.columns = 40;
  grid.south_deg = 59.99;
  grid.west_deg = 5.0 - 39.5 * 0.0005;
  grid.step_latitude_deg = grid.step_longitude_deg = 0.0005;
  grid.depth_m.assign(1600, 100.0F);
  ASSERT_TRUE(write_depth_raster(file, grid));
  options_.depth_raster = file;
  const auto part = picture(PictureKind::volume);
  fs::remove(file);
  ASSERT_TRUE(part) << to_line(part.error());
  EXPECT_THAT(texts(*part),
              testing::Contains(testing::MatchesRegex(".*depths known of (5[0-9]|6[01]) % of the seabed.*")));
}

// Masks alone of a ping that has none would be an empty frame: it says why it is empty.
TEST_F(Pictures, MasksAloneOfAPingWithoutASchoolSaySo) {
  options_.volume.data = false;
  options_.schools = {1};
  options_.ping = 2;
  EXPECT_THAT(texts(*picture(PictureKind::volume)), testing::Not(testing::Contains(testing::StartsWith("no masks"))));
  options_.ping = 4;
  EXPECT_THAT(texts(*picture(PictureKind::volume)), testing::Contains("no masks: no school in this ping"));
}

TEST_F(Pictures, AVolumesLegendNamesCoreAndFuzzyAreaAndTheSchools) {
  options_.ping = 2;
  options_.size = {1200, 900};  // in a small picture, their numbers beside them are all that names schools
  EXPECT_THAT(texts(*picture(PictureKind::volume)),
              testing::IsSupersetOf({"core, confidence 0.64 and more", "fuzzy area", "school 1, unreviewed"}));
  options_.display.masks = false;
  EXPECT_THAT(texts(*picture(PictureKind::volume)), testing::Not(testing::Contains("fuzzy area")));
}

// The heading is known: it is 0.
TEST_F(Pictures, VolumesSayWhatBearingsStartFrom) {
  EXPECT_THAT(texts(*picture(PictureKind::volume)), testing::Contains("masks of schools; true bearings"));
  options_.volume.context = false;
  EXPECT_THAT(texts(*picture(PictureKind::volume)), testing::Contains("masks of schools"));
}

// Where tables turn or bend places, slices and volumes say that they do not; elsewhere nothing is said.
TEST_F(Pictures, SlicesAndVolumesSayWhereTheyAreStraightAndTablesAreNot) {
  ObservationProduct product = example::empty("obs-0001", 5);
  example::add_school(product, 1, 0, 3, example::block(1, 1, 2, 20, 8, 200));
  options_.size = {900, 400};  // no title is cut short
  const auto said = [&](const Recipe& recipe, double pitch_deg) {
    for (PingNavigation& ping : product.pings) ping.pitch_deg = pitch_deg;
    source_ = PictureSource::of(nullptr, {product}, recipe);
    std::vector<std::string> words;
    for (const PictureKind kind : {PictureKind::slice_side, PictureKind::volume}) {
      for (const std::string& text : texts(*picture(kind))) {
        if (text.find(kStraightAndLevel) != std::string::npos) words.push_back(text);
      }
    }
    return words;
  };
  const std::vector<std::string> told{"depth, straight and level beams (m)",
                                      "masks of schools; true bearings; straight and level beams"};
  Recipe recipe;
  EXPECT_THAT(said(recipe, 5.0), testing::IsEmpty()) << "stabilised";
  recipe.navigation.beams_stabilised = false;
  EXPECT_THAT(said(recipe, 0.0), testing::IsEmpty());
  EXPECT_EQ(said(recipe, 5.0), told);
  recipe.navigation.beams_stabilised = true;
  recipe.survey.sound_speed_profile = {{0.0, 1504.0}, {100.0, 1304.0}};
  EXPECT_THAT(said(recipe, 5.0), testing::IsEmpty()) << "a profile that bends nothing";
  recipe.survey.bend_rays = true;
  EXPECT_EQ(said(recipe, 0.0), told);
}

// What a window exports is read in its units; programs leave SI.
TEST_F(Pictures, EveryKindIsReadInTheUnitsThatAreChosen) {
  const auto metres = testing::AnyOf(testing::EndsWith(" m"), testing::HasSubstr("(m)"), testing::HasSubstr(" m "));
  for (const PictureKind kind : {PictureKind::volume, PictureKind::propagation, PictureKind::timeline,
                                 PictureKind::chart, PictureKind::report}) {
    options_.kind.chart.y = "depth_m";
    options_.units = {};
    const auto si = picture(kind);
    options_.units = {LengthUnit::feet, SpeedUnit::knots};
    const auto feet = picture(kind);
    ASSERT_TRUE(si && feet);
    EXPECT_THAT(texts(*si), testing::Contains(metres));
    EXPECT_THAT(texts(*feet), testing::Not(testing::Contains(metres)));
    EXPECT_THAT(texts(*feet), testing::Contains(testing::AnyOf(testing::HasSubstr(" ft"), testing::HasSubstr("(ft)"))));
  }
  const auto report = picture(PictureKind::report);
  EXPECT_THAT(texts(*report), testing::IsSupersetOf({"Depth ft", "Length ft"})) << "whole: they have room";
  options_.units.lengths = LengthUnit::fathoms;
  EXPECT_THAT(texts(*picture(PictureKind::report)), testing::IsSupersetOf({"Depth fm", "Length fm"}));
}

}  // namespace
}  // namespace sonar
