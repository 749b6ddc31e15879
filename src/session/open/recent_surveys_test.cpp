// SPDX-License-Identifier: Apache-2.0
#include "session/open/recent_surveys.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "session/test_survey.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

TEST(RecentSurveys, AThumbnailIsTheMeanOfTheMiddle) {
  // Twice as wide as the thumbnail's shape: of each side a quarter is left out.
  Image image({4 * kThumbnail.width, 2 * kThumbnail.height}, {255, 0, 0, 255});
  for (int y = 0; y < image.size.height; ++y) {
    for (int x = kThumbnail.width; x < 3 * kThumbnail.width; ++x) {
      image.at(x, y) = {static_cast<std::uint8_t>(100 + 2 * (x % 2) + 4 * (y % 2)), 20, 30, 255};
    }
  }
  const Image small = reduced(image, kThumbnail);
  ASSERT_EQ(small.size, kThumbnail);
  for (const Rgba8& one : small.pixels) EXPECT_EQ(one, (Rgba8{103, 20, 30, 255}));
}

TEST(RecentSurveys, APictureSmallerThanAThumbnailIsEnlarged) {
  const Image small = reduced(Image({5, 3}, {1, 2, 3, 255}), kThumbnail);
  for (const Rgba8& one : small.pixels) EXPECT_EQ(one, (Rgba8{1, 2, 3, 255}));
}

TEST(RecentSurveys, WhatIsClearHasNoColourInTheMean) {
  Image image({2 * kThumbnail.width, kThumbnail.height * 2}, {9, 9, 9, 0});
  for (std::size_t i = 0; i < image.pixels.size(); i += 2) image.pixels[i] = {200, 100, 50, 255};
  for (const Rgba8& one : reduced(image, kThumbnail).pixels) EXPECT_EQ(one, (Rgba8{200, 100, 50, 128}));
}

class OpenedBefore : public testing::Test {
 protected:
  std::unique_ptr<AppModel> begin() {
    DocumentOptions options = TestSurvey::options(folder_);
    options.cache.folder = folder_ / "cache";
    return std::make_unique<AppModel>(queue_, options);
  }
  fs::path folder_ = TestSurvey::easy().fresh();
  ChangeQueue queue_;
};

TEST_F(OpenedBefore, IsListedWithItsPictureAndToldWhereItIsGone) {
  Preferences kept;
  {
    const auto app = begin();
    LivePicture* slice = app->picture("top_slice");
    slice->resize({640, 400}, 1.0);
    slice->set_seen(true);
    app->workspace.document.open({TestSurvey::easy().folder() / ""});  // as a shell completes a folder's name
    app->workspace.document.settle();
    slice->wait();
    queue_.drain();
    ASSERT_FALSE(slice->image().pixels.empty());
    EXPECT_TRUE(recent_surveys(*app).front().thumbnail.empty()) << "it is open: nothing was kept yet";
    kept = app->preferences;
  }
  const auto app = begin();
  app->preferences = kept;
  app->preferences.remember({folder_ / "gone" / "a.raw", folder_ / "gone" / "b.raw"});
  const auto surveys = recent_surveys(*app);
  ASSERT_EQ(surveys.size(), 2U);
  EXPECT_EQ(surveys[0].name, "a.raw");
  EXPECT_FALSE(surveys[0].there);
  EXPECT_EQ(surveys[0].place, (folder_ / "gone").string() + ", with 1 more");
  EXPECT_EQ(surveys[1].name, TestSurvey::easy().folder().filename().string());
  EXPECT_TRUE(surveys[1].there);
  // A PNG's width and height stand behind its first 16 bytes, the highest byte first.
  std::ifstream file(surveys[1].thumbnail, std::ios::binary);
  std::string head(24, '\0');
  ASSERT_TRUE(file.read(head.data(), static_cast<std::streamsize>(head.size()))) << surveys[1].thumbnail;
  EXPECT_EQ(head.substr(1, 3), "PNG");
  EXPECT_EQ(static_cast<unsigned char>(head[19]), kThumbnail.width);
  EXPECT_EQ(static_cast<unsigned char>(head[23]), kThumbnail.height);
}

TEST_F(OpenedBefore, IsInTheMenuAndOpensWhereItWasLeft) {
  const auto app = begin();
  Document& document = app->workspace.document;
  document.open({TestSurvey::easy().folder()});
  document.settle();
  const Action* first = app->actions.find("file.recent.1");
  EXPECT_EQ(first->text_now(), TestSurvey::easy().folder().string());
  EXPECT_TRUE(first->enabled());
  EXPECT_FALSE(app->actions.find("file.recent.2")->enabled());
  const auto before = document.survey_files();
  ASSERT_TRUE(document.show(1));
  first->run();
  document.settle();
  EXPECT_NE(document.survey_files(), before);
  EXPECT_EQ(document.shown()->index(), 1U) << "where it was left";
}

}  // namespace
}  // namespace sonar
