// SPDX-License-Identifier: Apache-2.0
#include "publish/movies/movie_plan.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <variant>

#include "io/product_example.h"
#include "publish/movies/movie.h"

namespace sonar {
namespace {

using testing::HasSubstr;

TEST(MoviePlan, GoesThroughEveryPingOnce) {
  const auto steps = movie_steps({}, {3, 9});
  ASSERT_EQ(steps.size(), 7U);
  for (std::size_t i = 0; i < steps.size(); ++i) EXPECT_EQ(steps[i], (MovieStep{3 + static_cast<int>(i), 0, 0.0, 0.0}));
}

TEST(MoviePlan, InterpolatedPicturesLieEvenlyBetweenTheirPings) {
  MovieParams params;
  params.between = 3;
  const auto steps = movie_steps(params, {0, 2});
  ASSERT_EQ(steps.size(), 9U) << "3 pings, 3 pictures in each of 2 gaps, none behind the last";
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_DOUBLE_EQ(static_cast<double>(steps[i].ping) + steps[i].fraction, 0.25 * static_cast<double>(i));
    EXPECT_EQ(steps[i].between == 0, i % 4 == 0);
    EXPECT_LT(steps[i].fraction, 1.0);
  }
}

TEST(MoviePlan, ATurntableClosesAndShowsEachSideOnce) {
  MovieParams params;
  params.motion = MovieMotion::turntable;
  params.turntable_pictures = 48;
  const auto steps = movie_steps(params, {7, 7});
  ASSERT_EQ(steps.size(), 48U);
  std::set<double> sides;
  for (const MovieStep& step : steps) {
    EXPECT_EQ(step.ping, 7);
    sides.insert(step.turn_deg);
  }
  EXPECT_EQ(sides.size(), 48U);
  const double step = steps[1].turn_deg - steps[0].turn_deg;
  EXPECT_DOUBLE_EQ(steps.back().turn_deg + step, 360.0) << "one step more is the first picture again";
}

class PingsOfMovie : public testing::Test {
 protected:
  PingsOfMovie() {
    ObservationProduct product = example::empty("obs-0001", 12);
    example::add_school(product, 1, 2, 5, example::block(1, 1, 2, 20, 8, 200));
    example::add_school(product, 2, 4, 9, example::block(0, 0, 3, 40, 5));
    source_ = PictureSource::of(nullptr, {product}, Recipe{});
  }
  [[nodiscard]] std::string text() const {
    const auto pings = movie_pings(source_->observations().front(), options_);
    return pings ? std::to_string(pings->first) + "-" + std::to_string(pings->last) : pings.error().text;
  }
  std::unique_ptr<PictureSource> source_;
  PictureOptions options_;
};

TEST_F(PingsOfMovie, AreThoseOfOneSchoolElseAllUnlessTheyAreNamed) {
  EXPECT_EQ(text(), "0-11");
  options_.schools = {2};
  EXPECT_EQ(text(), "4-9");
  options_.schools = {1, 2};
  EXPECT_EQ(text(), "0-11");
  options_.schools = {2};
  options_.kind.movie.first_ping = 1;
  EXPECT_EQ(text(), "1-9");
  options_.kind.movie.last_ping = 3;
  EXPECT_EQ(text(), "1-3");
  options_.kind.movie.motion = MovieMotion::turntable;
  options_.ping = 6;
  EXPECT_EQ(text(), "6-6");
}

TEST_F(PingsOfMovie, ThatAreNotThereAreRefused) {
  options_.kind.movie.last_ping = 12;
  EXPECT_THAT(text(), HasSubstr("no ping 12 in obs-0001: it has pings 0 to 11"));
  options_.kind.movie = {};
  options_.kind.movie.first_ping = 5;
  options_.kind.movie.last_ping = 4;
  EXPECT_THAT(text(), HasSubstr("last ping, 4, lies before its first, 5"));
}

// Whoever watches knows what was measured and what was not.
TEST_F(PingsOfMovie, AnInterpolatedPictureSaysSo) {
  Work work(1);
  options_.kind.movie.of = MovieOf::slice_top;
  options_.kind.movie.between = 2;
  for (const int width : {900, 360}) {
    options_.size = {width, 480};
    const auto movie = Movie::of(*source_, "", options_, work);
    ASSERT_TRUE(movie) << to_line(movie.error());
    for (std::size_t picture = 0; picture < 7; ++picture) {
      const auto frame = movie->picture(picture, work);
      ASSERT_TRUE(frame) << to_line(frame.error());
      std::string marks;
      for (const auto& item : frame->items) {
        const auto* text = std::get_if<TextItem>(&item);
        if (text != nullptr && text->text.find("interpolated") != std::string::npos) marks += text->text;
      }
      const std::string mark = fmt::format("interpolated between pings {} and {}", picture / 3, picture / 3 + 1);
      if (picture % 3 == 0) {
        EXPECT_EQ(marks, "") << picture;
      } else {
        EXPECT_THAT(marks, testing::StartsWith(mark)) << picture;
      }
    }
  }
}

TEST(MoviePlan, WhatDoesNotGoTogetherIsOneLine) {
  PictureOptions options;
  EXPECT_TRUE(validate_movie(options));
  options.kind.movie.motion = MovieMotion::along_track;
  EXPECT_TRUE(validate_movie(options));
  options.kind.movie.of = MovieOf::slice_top;
  EXPECT_THAT(validate_movie(options).error().text, HasSubstr("a camera, which a volume alone has"));
  options.kind.movie.motion = MovieMotion::pings;
  options.kind.movie.between = 2;
  EXPECT_TRUE(validate_movie(options));
  options.kind.movie.of = MovieOf::observation_map;
  EXPECT_THAT(validate_movie(options).error().text, HasSubstr("interpolates samples"));
  options.kind.movie = {};
  options.size.height = 250;
  EXPECT_THAT(validate_movie(options).error().text, HasSubstr("no room for its caption"));
}

}  // namespace
}  // namespace sonar
