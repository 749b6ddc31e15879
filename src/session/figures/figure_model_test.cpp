// SPDX-License-Identifier: Apache-2.0
#include "session/figures/figure_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <variant>

#include "publish/picture_output.h"
#include "session/maps/survey_map_model.h"
#include "session/slices/slice_model.h"
#include "session/test_app.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Without a window: no view of the survey is seen, the page's preview alone.
class Figures : public testing::Test, protected TestApp {
 protected:
  void SetUp() override {
    begin();
    (void)workspace().volume.set("renderer", Choice{1});  // the processor
    (void)workspace().volume.set("frames", 1);
    compose();
  }
  void compose() {
    figure_ = std::make_unique<FigureModel>(*app_);
    figure_->resize({500, 400}, 1.0);
    figure_->set_seen(true);
    settle();
  }
  void TearDown() override { figure_.reset(); }
  void settle() {
    do {
      document().settle();
      for (PictureDock& dock : app_->pictures) dock.picture->wait();
      figure_->wait();
    } while (queue_.drain() > 0);
  }
  void set(const char* name, const PropertyValue& to) {
    ASSERT_TRUE(workspace().figure.set(name, to)) << name;
    settle();
  }
  void show(const std::string& panels) { set("panels", panels); }
  [[nodiscard]] const FrameDescription& page() { return *figure_->page(); }
  [[nodiscard]] std::vector<std::string> words() {
    std::vector<std::string> out;
    for (const auto& item : page().items) {
      if (const auto* text = std::get_if<TextItem>(&item)) out.push_back(text->text);
    }
    return out;
  }
  [[nodiscard]] std::ptrdiff_t count_of(const std::string& text) {
    const auto all = words();
    return std::count(all.begin(), all.end(), text);
  }

  std::unique_ptr<FigureModel> figure_;
  fs::path out_ = TestSurvey::easy().fresh();
};

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

constexpr const char* kSv = "Sv (dB re 1 m\u207B\u00B9)";

// Every view that the window has, four on a page: the sizes of text are those of the page.
TEST_F(Figures, TextOfEveryKindOfPictureHasThePointsOfThePage) {
  set("paper", Choice{static_cast<std::size_t>(FigurePaper::a4_upright)});
  std::vector<std::string> pages;
  std::size_t shown = 0;
  for (const PictureDock& dock : app_->pictures) {
    constexpr std::array kOfSchools{"chart", "frequency", "curves", "lineage"};  // no school is measured yet
    if (std::find(kOfSchools.begin(), kOfSchools.end(), dock.id) != kOfSchools.end()) continue;
    if (shown++ % 4 == 0) pages.emplace_back();
    pages.back() += dock.id + ",";
  }
  ASSERT_GE(pages.size(), 3U);
  for (const int dpi : {100, 300}) {
    set("dpi", dpi);
    std::set<long> of_panels;
    for (const std::string& panels : pages) {
      show(panels);
      ASSERT_TRUE(figure_->page()) << panels << figure_->problem();
      EXPECT_THAT(words(), Not(Contains(HasSubstr("no room for it")))) << panels;
      for (const auto& item : page().items) {
        const auto* text = std::get_if<TextItem>(&item);
        if (text == nullptr) continue;
        const double points = text->size_px * 72.0 / dpi;
        EXPECT_GE(points, 6.0) << text->text << " at " << dpi;
        EXPECT_LE(points, 8.0 * 1.001) << text->text << " at " << dpi;
        of_panels.insert(std::lround(points * 100.0));
      }
    }
    EXPECT_THAT(of_panels, Contains(800));
    EXPECT_LE(of_panels.size(), 6U) << "one size, and a few of small print";
  }
}

TEST_F(Figures, SlicesAndVolumeOfOneScaleHaveOneColourBar) {
  show("top_slice,side_slice,volume");
  ASSERT_TRUE(figure_->page()) << figure_->problem();
  EXPECT_EQ(count_of(kSv), 1);
  // Another scale: every panel follows, and it is still one bar with the new ends.
  ASSERT_TRUE(workspace().display.set("scale.low_db", -71.0));
  settle();
  EXPECT_EQ(count_of(kSv), 1);
  EXPECT_EQ(count_of("\u221271"), 1);
}

TEST_F(Figures, APageWithoutColoursGivesTheBarsRoomToItsPanels) {
  show("propagation,observation_map");
  ASSERT_TRUE(figure_->page()) << figure_->problem();
  double rightmost = 0.0;
  for (const auto& item : page().items) {
    if (const auto* clip = std::get_if<ClipItem>(&item))
      rightmost = std::max(rightmost, clip->place.x + clip->place.width);
  }
  const double margin_px = 2.0 * 300 / 25.4;
  EXPECT_NEAR(rightmost, page().size.width - margin_px, 8.0);
}

TEST_F(Figures, APictureThatNobodySeesInTheWindowIsDrawnAndReadToItsEnd) {
  set("height_mm", 200.0);
  show("top_slice,observation_timeline+,echogram+");
  ASSERT_TRUE(figure_->page()) << figure_->problem();
  EXPECT_EQ(app_->picture("observation_timeline")->pictures(), 0) << "its view is not seen";
  EXPECT_EQ(app_->picture("observation_timeline")->incomplete(), "");
  EXPECT_EQ(app_->picture("echogram")->incomplete(), "");
  EXPECT_EQ(figure_->told(), "");
  EXPECT_THAT(words(), Contains(HasSubstr("a, c: Sv; b: largest Sv"))) << "one bar says what each panel shows";
}

TEST_F(Figures, ThePageHasThePixelsOfItsPaper) {
  show("top_slice");
  set("width_mm", 85.0);
  set("height_mm", 60.0);
  set("dpi", 600);
  ASSERT_TRUE(figure_->page()) << figure_->problem();
  EXPECT_EQ(page().size, (PixelSize{2008, 1417}));  // 85 and 60 mm times 600 / 25.4
  EXPECT_EQ(workspace().figure.values().paper, FigurePaper::own) << "a size that no paper has";
}

TEST_F(Figures, APaperThatIsChosenSetsTheSize) {
  set("paper", Choice{static_cast<std::size_t>(FigurePaper::a4_across)});
  EXPECT_EQ(workspace().figure.values().width_mm, 297.0);
  EXPECT_EQ(workspace().figure.values().height_mm, 210.0);
  EXPECT_EQ(workspace().figure.values().paper, FigurePaper::a4_across);
}

TEST_F(Figures, ViewsAreChosenMovedAndGivenRowsOfTheirOwn) {
  show("top_slice,volume");
  figure_->choose("observation_timeline", true);
  figure_->choose("volume", false);
  settle();
  figure_->set_wide("observation_timeline", true);
  figure_->move("observation_timeline", -1);
  figure_->move("observation_timeline", -1);  // it is the first already
  settle();
  EXPECT_EQ(workspace().figure.values().panels, "observation_timeline+,top_slice");
  const auto choices = figure_->choices();
  ASSERT_EQ(choices.size(), app_->pictures.size());
  EXPECT_EQ(choices[0], (FigureChoice{"observation_timeline", "Observation timeline", true, true}));
  EXPECT_TRUE(choices[1].chosen);
  EXPECT_FALSE(choices[2].chosen);
}

TEST_F(Figures, WithoutAChoiceALineSaysWhatIsExpected) {
  for (const FigureChoice& one : figure_->choices()) {
    figure_->choose(one.id, false);
    settle();
  }
  EXPECT_FALSE(figure_->page());
  EXPECT_THAT(figure_->problem(), HasSubstr("no picture is chosen for the figure"));
  figure_->write(out_ / "none.png");
  settle();
  EXPECT_FALSE(fs::exists(out_ / "none.png"));
}

// As zoomed in the window: the panel's axes have other ticks than those of the whole sector.
TEST_F(Figures, APanelShowsThePartThatItsViewShows) {
  show("top_slice");
  const auto whole = words();
  auto& slice = dynamic_cast<SliceModel&>(*app_->picture("top_slice"));
  slice.resize({600, 500}, 1.0);
  slice.set_seen(true);
  settle();
  PointerEvent wheel{PointerAction::wheel, PointerButton::none, {300.0, 250.0}};
  wheel.control = true;
  wheel.wheel_steps = 12.0;
  slice.pointer(wheel);
  slice.set_seen(false);
  settle();
  ASSERT_TRUE(slice.zoomed());
  EXPECT_NE(words(), whole);
  EXPECT_EQ(slice.picture()->map->view().extent.has_value(), true);
}

TEST_F(Figures, SyntheticDataIsCalledSoWhateverIsLeftOut) {
  show("top_slice");
  set("headings", Choice{static_cast<std::size_t>(FigureHeadings::none)});
  set("source", false);
  EXPECT_THAT(words(), Contains("SYNTHETIC data"));
  set("source", true);
  EXPECT_THAT(words(), Contains(StartsWith("obs-0001 SYNTHETIC, ping ")));
}

// What is written is the page of the preview, with its resolution and where it is from.
TEST_F(Figures, ThePageIsWrittenWithItsResolutionAndOrigin) {
  show("top_slice,side_slice");
  set("dpi", 150);
  app_->dialogs.file_to_save = [this](const auto&, const auto&, const std::string& name) {
    return (out_ / name).string();
  };
  const FrameDescription seen = page();
  figure_->ask_and_write();
  settle();
  const fs::path file = out_ / "obs-0001-figure.png";
  EXPECT_THAT(figure_->told(), HasSubstr("written: "));
  const std::string bytes = bytes_of(file);
  ASSERT_TRUE(write_picture(seen, out_ / "seen.png"));
  EXPECT_EQ(bytes, bytes_of(out_ / "seen.png"));
  EXPECT_EQ(seen.size, (PixelSize{1063, 709}));
  EXPECT_THAT(bytes, HasSubstr("Sonar Explorer test"));
  EXPECT_THAT(bytes, HasSubstr(recipe_hash(document().measuring_recipe())));
  for (const char* name : {"a.svg", "a.pdf"}) {
    figure_->write(out_ / name);
    settle();
    EXPECT_GT(fs::file_size(out_ / name), 1000U) << figure_->told();
  }
}

TEST_F(Figures, NothingIsWrittenWhereRawFilesLie) {
  show("top_slice");
  const fs::path file = TestSurvey::easy().folder() / "figure.png";
  figure_->write(file);
  settle();
  EXPECT_FALSE(fs::exists(file));
  EXPECT_THAT(figure_->told(), HasSubstr("raw"));
}

// Preferences keep what the page is like, not the words, which are of one survey.
TEST_F(Figures, ChoicesAreKeptForTheNextTime) {
  set("dpi", 450);
  show("volume,observation_timeline+");
  set("caption", std::string("Fig. 1"));
  app_->preferences.path = out_ / "preferences.json";
  app_->preferences.take(workspace());
  ASSERT_TRUE(app_->preferences.save());
  const FigureParams kept = Preferences::load(app_->preferences.path).preferences.figure;
  EXPECT_EQ(kept.dpi, 450);
  EXPECT_EQ(kept.panels, "volume,observation_timeline+");
  EXPECT_EQ(kept.caption, "");
}

}  // namespace
}  // namespace sonar
