// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "io/product_example.h"
#include "publish/movies/movie.h"
#include "publish/picture.h"
#include "publish/picture_output.h"
#include "publish/volumes/drawn_schools.h"

namespace sonar {
namespace {

/// A ship that sails north, and two schools that it takes along; no raw files.
class VolumeTrails : public testing::Test {
 protected:
  VolumeTrails() {
    ObservationProduct product = example::empty("obs-0001", 8);
    example::add_school(product, 1, 0, 7, example::block(1, 1, 2, 20, 8, 200));
    example::add_school(product, 2, 2, 4, example::block(0, 0, 3, 40, 5));
    product.schools[1].status = "rejected";
    source_ = PictureSource::of(nullptr, {product}, Recipe{});
    options_.size = {500, 400};
    options_.volume.frames = 0;
    options_.volume.renderer = RendererChoice::cpu;
    options_.ping = 5;
  }
  Image image() {
    const auto frame = picture_frame(PictureKind::volume, *source_, "", options_, work_);
    EXPECT_TRUE(frame) << to_line(frame.error());
    return *painted(*frame, 1.0);
  }
  std::string words() {
    std::string out;
    const auto frame = picture_frame(PictureKind::volume, *source_, "", options_, work_);
    for (const auto& item : frame->items) {
      if (const auto* text = std::get_if<TextItem>(&item)) out += text->text + '\n';
    }
    return out;
  }
  std::unique_ptr<PictureSource> source_;
  PictureOptions options_;
  Work work_{1};
};

TEST_F(VolumeTrails, AreDrawnWhereTheyAreAskedForAndNowhereElse) {
  const Image plain = image();
  VolumeParams& volume = options_.volume;
  const auto changes = [&](auto&& set) {
    const PictureOptions before = options_;
    set();
    const bool changed = image() != plain;
    options_ = before;
    return changed;
  };
  EXPECT_FALSE(changes([&] { volume.trail_pings = 0; }));
  EXPECT_TRUE(changes([&] { volume.trail_pings = 3; }));
  EXPECT_TRUE(changes([&] { volume.ship_track = true; }));
  EXPECT_TRUE(changes([&] { volume.school_tracks = true; }));
  volume.context = false;
  const Image bare = image();
  volume.ship_track = volume.school_tracks = true;
  volume.trail_pings = 3;
  EXPECT_EQ(image(), bare) << "they are a part of what stands round the volume";
}

TEST_F(VolumeTrails, AreThoseOfTheSchoolsThatAreShown) {
  const DrawnObservation& observation = source_->observations().front();
  options_.display.rejected = false;
  TrailSubject subject = trail_subject(observation, options_);
  ASSERT_EQ(subject.schools.size(), 1U) << "rejected ones are not shown";
  EXPECT_EQ(subject.schools[0].pings.size(), 8U);
  options_.display.rejected = true;
  subject = trail_subject(observation, options_);
  ASSERT_EQ(subject.schools.size(), 2U);
  ASSERT_EQ(subject.schools[1].pings.size(), 3U);
  EXPECT_EQ(subject.schools[1].pings[0].ping_index, 2);
  EXPECT_EQ(subject.schools[1].pings[0].mask, &observation.product().masks[8].mask);
  options_.schools = {2};
  EXPECT_EQ(trail_subject(observation, options_).schools.size(), 1U);
  options_.display.masks = false;
  EXPECT_TRUE(trail_subject(observation, options_).schools.empty());
}

TEST_F(VolumeTrails, TheLegendAndTheTitleSayWhatTheyAre) {
  EXPECT_THAT(words(), testing::Not(testing::HasSubstr("track")));
  options_.volume.ship_track = options_.volume.school_tracks = options_.volume.earth_fixed = true;
  options_.volume.trail_pings = 4;
  for (const char* said : {"track of the ship", "tracks of schools", "schools of the 4 pings before", "earth-fixed"}) {
    EXPECT_THAT(words(), testing::HasSubstr(said));
  }
  options_.volume.trail_pings = 1;
  EXPECT_THAT(words(), testing::HasSubstr("schools of the ping before"));
  options_.display.masks = false;
  EXPECT_THAT(words(), testing::HasSubstr("track of the ship"));
  EXPECT_THAT(words(), testing::Not(testing::AnyOf(testing::HasSubstr("tracks of"), testing::HasSubstr("ping before"))))
      << "of what is not there nothing is said";
}

TEST_F(VolumeTrails, AnEyeOfAnotherPingIsTheSameForThatPingAndAnotherForOthers) {
  const Image own = image();
  options_.volume.earth_fixed = true;
  const Image fixed = image();
  options_.kind.volume.eye_ping = 5;
  EXPECT_EQ(image(), fixed);
  options_.kind.volume.eye_ping = 0;
  EXPECT_NE(image(), fixed);
  options_.volume.earth_fixed = false;
  EXPECT_EQ(image(), own) << "only an earth-fixed eye has a ping of its own";
  options_.volume.earth_fixed = true;
  options_.kind.volume.eye_ping = 8;
  const auto refused = picture_frame(PictureKind::volume, *source_, "", options_, work_);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().text, testing::HasSubstr("no ping 8 for the eye in obs-0001: it has pings 0 to 7"));
}

// The sea's rings sail through an earth-fixed movie, and stand in the ship's.
TEST_F(VolumeTrails, AMoviesEyeStandsStillWhereItIsAskedTo) {
  options_.ping.reset();
  options_.size = {500, 420};
  options_.display.masks = false;
  const auto first_and_last = [&] {
    const auto movie = Movie::of(*source_, "", options_, work_);
    EXPECT_TRUE(movie) << to_line(movie.error());
    std::vector<std::string> places;
    for (const std::size_t step : {std::size_t{0}, movie->steps().size() - 1}) {
      const auto frame = movie->picture(step, work_);
      EXPECT_TRUE(frame) << to_line(frame.error());
      for (const auto& item : frame->items) {
        const auto* text = std::get_if<TextItem>(&item);
        if (text != nullptr && text->text.starts_with("range ")) {
          places.push_back(std::to_string(std::lround(text->at.x)) + ' ' + std::to_string(std::lround(text->at.y)));
          break;
        }
      }
    }
    return places;
  };
  auto places = first_and_last();
  ASSERT_EQ(places.size(), 2U);
  EXPECT_EQ(places[0], places[1]);
  options_.volume.earth_fixed = true;
  places = first_and_last();
  ASSERT_EQ(places.size(), 2U);
  EXPECT_NE(places[0], places[1]);
  options_.kind.volume.eye_ping = 99;
  EXPECT_FALSE(Movie::of(*source_, "", options_, work_));
}

}  // namespace
}  // namespace sonar
