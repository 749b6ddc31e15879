// SPDX-License-Identifier: Apache-2.0
#include "session/pictures/picture_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <optional>
#include <utility>

#include "base/units.h"
#include "session/pictures/exports.h"
#include "session/slices/slice_places.h"
#include "session/test_app.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Size of a PNG, by its header; empty where there is none.
std::optional<PixelSize> size_of_png(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::array<unsigned char, 24> head{};
  if (!in.read(reinterpret_cast<char*>(head.data()), head.size())) return std::nullopt;
  const auto at = [&](std::size_t i) {
    return (head[i] << 24) | (head[i + 1] << 16) | (head[i + 2] << 8) | head[i + 3];
  };
  return PixelSize{at(16), at(20)};
}

class PictureFile : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    begin();
    app_->dialogs.file_to_save = [this](const auto&, const auto&, const std::string& name) {
      saved_ = out_ / name;
      return saved_.string();
    };
    app_->dialogs.parameters = [this](const std::string&, const PanelSection& section) {
      asked_ = section.names;
      answer_(*section.source);
      return accept_;
    };
  }
  void answer(std::function<void(ParameterSource&)> answer) { answer_ = std::move(answer); }
  std::optional<PixelSize> made(const std::string& kind) {
    saved_.clear();
    press("picture." + kind);
    document().settle();
    return size_of_png(saved_);
  }
  [[nodiscard]] const std::string& told() { return document().notices().back(); }

  fs::path out_ = TestSurvey::easy().fresh();
  fs::path saved_;  ///< under the name that was offered
  std::vector<std::string> asked_;
  std::function<void(ParameterSource&)> answer_ = [](ParameterSource&) {};
  bool accept_ = true;
};

TEST_F(PictureFile, HasTheSizeThatWasAskedFor) {
  answer([](ParameterSource& source) {
    (void)source.set("width_px", 640);
    (void)source.set("height_px", 480);
    (void)source.set("scale", 1.5);
  });
  const auto image = made("slice-top");
  ASSERT_TRUE(image) << told();
  EXPECT_EQ(*image, (PixelSize{960, 720}));
  EXPECT_THAT(asked_, Not(Contains("slice-range.range_m")));
}

TEST_F(PictureFile, IsNotMadeWhereTheHumanDeclines) {
  accept_ = false;
  answer([](ParameterSource& source) { (void)source.set("width_px", 640); });
  EXPECT_FALSE(made("slice-top"));
  EXPECT_EQ(workspace().picture_file.values().paper.width_px, 1600) << "what was there comes back";
}

TEST_F(PictureFile, EveryKindAsksForWhatItNeedsAndIsMade) {
  paint(4, 6, 5, 5, 200);  // a chart is of schools
  document().settle();
  for (const PictureKindInfo& kind : picture_kinds()) {
    if (kind.name == "movie") continue;  // it has menu entries of its own
    answer([](ParameterSource& source) {
      (void)source.set("width_px", 480);
      (void)source.set("height_px", 360);
    });
    EXPECT_TRUE(made(std::string(kind.name))) << kind.name << ": " << told();
    for (const std::string& name : asked_)
      EXPECT_TRUE(workspace().picture_file.value(name)) << kind.name << ": " << name;
  }
}

TEST_F(PictureFile, AllPlanesOfTheCommandLineCanBeHad) {
  for (std::size_t i = 0; i < kPlaneLiesNames.size(); ++i) {
    answer([i](ParameterSource& source) { (void)source.set("slice-plane.plane", Choice{i}); });
    EXPECT_TRUE(made("slice-plane")) << kPlaneLiesNames[i] << ": " << told();
    fs::remove(saved_);
  }
  answer([](ParameterSource& source) {
    (void)source.set("slice-plane.plane", Choice{static_cast<std::size_t>(PlaneLies::oblique)});
    (void)source.set("slice-plane.normal", std::string("0,0,0"));
  });
  EXPECT_FALSE(made("slice-plane"));
  EXPECT_THAT(told(), HasSubstr("make no plane"));
}

/// What the file's own rules make of the parameters that are asked for, against where the window's slice lies.
TEST_F(PictureFile, OfARangeOrPlaneSliceBeginsWhereTheWindowsLies) {
  const Sector& sector = document().shown()->sector();
  Voxel voxel{sector.fans() / 3, sector.beams() / 4, sector.range().count / 5};
  for (const PlaneSlice::Kind lies :
       {PlaneSlice::Kind::horizontal, PlaneSlice::Kind::vertical, PlaneSlice::Kind::oblique}) {
    choose_plane(workspace(), lies);
    for (int moved = 0; moved < 2; ++moved) {  // a vertical plane through the sonar, and beside it
      answer([&](ParameterSource&) {
        const PictureParams& asked = workspace().picture_file.values().kind;
        EXPECT_EQ(std::round(sector.range().sample_at(asked.slice_range.range_m)), workspace().slices().sample);
        const auto live = std::get<PlaneSlice>(live_slice(workspace(), SliceKind::plane, document().ping()));
        const auto places = places_of(asked.slice_plane);
        ASSERT_TRUE(places);
        Result<PlaneSlice> made = fail(ErrorCode::usage, "not made");
        const auto& t = places->through;
        const auto& o = places->point;
        const auto& n = places->normal;
        const PingNavigation& ping = document().shown()->files().navigation[0];
        switch (asked.slice_plane.plane) {
          case PlaneLies::horizontal:
            made = horizontal_plane(asked.slice_plane.depth_m, ping.transducer_depth_m);
            break;
          case PlaneLies::along_bearing:
            made = vertical_plane(rad_from_deg(asked.slice_plane.bearing_deg) - plane_frame(ping).heading_rad);
            break;
          case PlaneLies::through_places:
            made = vertical_plane({t[0], t[1], 0.0}, {t[2], t[3], 0.0});
            break;
          case PlaneLies::oblique:
            made = oblique_plane({o[0], o[1], o[2]}, {n[0], n[1], n[2]});
            break;
          case PlaneLies::through_school:
            break;
        }
        ASSERT_TRUE(made);
        for (const auto& [a, b] :
             {std::pair(made->origin, live.origin), std::pair(made->right * 100.0, live.right * 100.0),
              std::pair(made->down * 100.0, live.down * 100.0)}) {
          EXPECT_LT(norm(a - b), 0.002);
        }
      });
      EXPECT_TRUE(made("slice-plane")) << told();
      EXPECT_TRUE(made("slice-range")) << told();
      lay_slices_through(workspace(), voxel);
      document().settle();
    }
  }
  accept_ = false;
  const PictureParams before = workspace().picture_file.values().kind;
  voxel.sample += 20;
  lay_slices_through(workspace(), voxel);
  EXPECT_FALSE(made("slice-range"));
  EXPECT_EQ(workspace().picture_file.values().kind.slice_range.range_m, before.slice_range.range_m);
}

TEST_F(PictureFile, ThatIsTooLargeIsRefusedInOneLine) {
  answer([](ParameterSource& source) {
    (void)source.set("width_px", 16384);
    (void)source.set("height_px", 16384);
  });
  EXPECT_FALSE(made("slice-top"));
  EXPECT_THAT(told(), HasSubstr("16384 x 16384 at scale 1 makes 268 million pixels; expected 64 at most"));
}

TEST_F(PictureFile, OfAVolumeLooksFromWhereTheWindowDoes) {
  Camera camera;
  camera.eye = {0.0, -100.0, -200.0};
  camera.target = {0.0, 200.0, 50.0};
  workspace().camera.set(camera);
  EXPECT_EQ(picture_options(workspace(), PictureKind::volume)->camera, camera);
  PictureFileParams params;
  params.camera_of_window = false;
  workspace().picture_file.assign(params);
  EXPECT_FALSE(picture_options(workspace(), PictureKind::volume)->camera);
}

TEST_F(PictureFile, OfAVolumeHasSchoolsAsTheWindowDoes) {
  for (const bool tint : {true, false}) {
    DisplayParams params;
    params.tint = tint;
    workspace().display.assign(params);
    EXPECT_EQ(picture_options(workspace(), PictureKind::volume)->display.tint, tint);
  }
}

TEST_F(PictureFile, ShowsTheSelectedSchoolAloneWhereThatIsAsked) {
  paint(2, 4, 5, 5, 200);
  paint(2, 4, 10, 10, 400);
  document().settle();
  select(2);
  EXPECT_EQ(picture_options(workspace(), PictureKind::slice_top)->display.filtered, false) << "as the window's slices";
  EXPECT_EQ(picture_options(workspace(), PictureKind::volume)->volume.filtered, true) << "as the window's volume";
  EXPECT_TRUE(picture_options(workspace(), PictureKind::slice_top)->schools.empty());
  PictureFileParams params;
  params.selected_school_alone = true;
  workspace().picture_file.assign(params);
  EXPECT_EQ(picture_options(workspace(), PictureKind::slice_top)->schools, (std::vector<std::int64_t>{2}));
}

TEST_F(PictureFile, OfATimelineMayBeOfTheWholeSurveyAgainstTheLog) {
  answer([](ParameterSource& source) {
    (void)source.set("timeline.whole_survey", true);
    (void)source.set("timeline.along_log", true);
    (void)source.set("timeline.maximum", false);
  });
  EXPECT_TRUE(made("timeline")) << told();
  const auto options = picture_options(workspace(), PictureKind::timeline);
  const TimelineParams& timeline = options->kind.timeline;
  EXPECT_TRUE(timeline.whole_survey && timeline.along_log && !timeline.maximum);
}

TEST_F(PictureFile, AMovieIsAskedForItsPace) {
  paint(4, 6, 5, 5, 200);
  document().settle();
  select(1);
  app_->dialogs.folder_to_save = [this](const auto&, const auto&) { return out_.string(); };
  answer([](ParameterSource& source) {
    (void)source.set("movie.pictures_per_second", 2.0);
    (void)source.set("movie.each_picture", true);
    (void)source.set("width_px", 400);
    (void)source.set("height_px", 300);
  });
  for (const char* movie : {"export.movie_side", "export.movie_map"}) {
    press(movie);
    document().settle();
    EXPECT_THAT(told(), HasSubstr("written: 3 pictures in"));
    EXPECT_THAT(asked_, Contains("movie.pictures_per_second"));
    EXPECT_THAT(asked_, Not(Contains("movie.motion"))) << "nothing but a volume has a camera";
    EXPECT_EQ(size_of_png(out_ / "movie-0001.png"), (PixelSize{400, 300}));
  }
}

TEST_F(PictureFile, AMovieOfAVolumeMayTurnOrSailPast) {
  EXPECT_THAT(asked_for(PictureKind::volume, true), Contains("movie.motion"));
  EXPECT_THAT(asked_for(PictureKind::volume, true), Contains("movie.turntable_pictures"));
  EXPECT_THAT(asked_for(PictureKind::volume, true), Not(Contains("movie.of"))) << "the menu says it";
  EXPECT_THAT(asked_for(PictureKind::volume), Not(Contains("movie.motion"))) << "a picture is none";
  EXPECT_THAT(asked_for(PictureKind::slice_top, true), Contains("movie.between"));
  EXPECT_THAT(asked_for(PictureKind::observation_map, true), Not(Contains("movie.between")));
  EXPECT_THAT(asked_for(PictureKind::report), Not(Contains("width_px"))) << "its paper is A4";
}

TEST_F(PictureFile, AReportGoesIntoAFolderBesideTheSurvey) {
  app_->dialogs.folder_to_save = [this](const auto&, const auto&) { return out_.string(); };
  press("export.report");
  document().settle();
  EXPECT_THAT(told(), HasSubstr("report.pdf"));
  EXPECT_TRUE(fs::exists(out_ / "report.pdf"));
}

TEST_F(PictureFile, ReducedRawFilesAreAskedForTheirMargins) {
  paint(4, 6, 5, 5, 200);
  document().settle();
  app_->dialogs.folder_to_save = [this](const auto&, const auto&) { return (out_ / "reduced").string(); };
  const auto size = [&] {
    press("export.raw-reduced");
    document().settle();
    EXPECT_THAT(told(), HasSubstr("written: "));
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(out_ / "reduced")) {
      if (entry.is_regular_file()) bytes += entry.file_size();
    }
    fs::remove_all(out_ / "reduced");
    return bytes;
  };
  const auto narrow = size();
  answer([](ParameterSource& source) { (void)source.set("margin_samples", 300); });
  EXPECT_GT(size(), narrow);
}

}  // namespace
}  // namespace sonar
