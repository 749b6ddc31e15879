// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "session/maps/masked_pings.h"
#include "session/maps/strip_panels.h"
#include "session/maps/test_maps.h"

namespace sonar {
namespace {

/// Places of the map that a school lights, in the picture's pixels.
std::vector<PixelPoint> lit(const ObservationMapPlaces& places) {
  std::vector<PixelPoint> out;
  for (std::size_t i = 0; i < places.cells.size(); ++i) {
    if (places.cells[i] == 0) continue;
    const auto x = static_cast<double>(i % static_cast<std::size_t>(places.width)) + 0.5;
    const std::size_t row = i / static_cast<std::size_t>(places.width);
    const auto y = static_cast<double>(row) + 0.5;
    out.push_back({places.map->place.x + x * places.cell_px, places.map->place.y + y * places.cell_px});
  }
  return out;
}

/// Of those the one that lies farthest from the ship's path.
PixelPoint off_track(const ObservationMapPlaces& places) {
  PixelPoint best;
  double farthest = -1.0;
  for (const PixelPoint& p : lit(places)) {
    double nearest = 1e300;
    for (const PixelPoint& t : *places.track) nearest = std::min(nearest, std::hypot(t.x - p.x, t.y - p.y));
    if (nearest <= farthest) continue;
    farthest = nearest;
    best = p;
  }
  return best;
}

TEST(ObservationMapModel, OnlyPingsThatAnActChangedAreSetAndTheMapIsThatOfAFreshOne) {
  TestMaps maps;
  maps.see(maps.map);
  ASSERT_TRUE(maps.map.places());
  EXPECT_EQ(maps.map.places()->cells_touched, 0U);
  const auto at = maps.bright();
  maps.propagate(at, 3);
  const auto pings = maps.workspace.document.state().schools.at(0)->masks.pings.size();
  ASSERT_GT(pings, 1U);
  EXPECT_GT(lit(*maps.map.places()).size(), 3U);

  const auto touched = maps.map.places()->cells_touched;
  EraseCommand erase;
  const auto& mask = maps.workspace.document.state().schools[0]->masks.pings[0];
  const auto& run = mask.mask.runs.front();
  erase.runs = {{maps.workspace.document.shown()->grid().channel[static_cast<std::size_t>(run.row)], run.first_sample,
                 run.count}};
  maps.workspace.document.act(mask.ping_index, erase);
  // The state's picture is the first of what an act brings about: measures change no mask.
  maps.workspace.document.settle();
  maps.map.wait();
  maps.queue.drain();
  const auto once = maps.map.places()->cells_touched - touched;
  EXPECT_GT(once, 0U);
  maps.settle();
  EXPECT_EQ(maps.map.places()->cells_touched - touched, once);

  ObservationMapModel fresh(maps.workspace);
  maps.see(fresh);
  fresh.wait();
  maps.queue.drain();
  EXPECT_EQ(fresh.places()->cells, maps.map.places()->cells);
  EXPECT_EQ(fresh.image(), maps.map.image());
  EXPECT_EQ(fresh.places()->pings_set, maps.workspace.document.state().schools[0]->masks.pings.size());
  EXPECT_LT(once, fresh.places()->cells_touched);
}

// The cursor's cross lies where the read-out has the voxel: on every voxel of a school it lies in the school, also where
// the recipe bends sound (by 2 m/s each metre, as no water does).
TEST(ObservationMapModel, TheCursorOnASchoolLiesInTheSchoolWhereSoundBends) {
  TestMaps maps;
  Recipe recipe = maps.workspace.document.recipe();
  recipe.survey.sound_speed_profile = {{0.0, 1504.0}, {100.0, 1304.0}};
  recipe.survey.bend_rays = true;
  maps.workspace.document.use_recipe(recipe);
  maps.settle();
  const auto at = maps.bright();
  maps.grow(at);
  maps.workspace.document.look_at(at.ping);
  maps.see(maps.map);
  const auto& schools = maps.workspace.document.state().schools;
  ASSERT_EQ(schools.size(), 1U);
  const auto places = maps.map.places();
  ASSERT_TRUE(places);
  const auto cells = lit(*places);
  int voxels = 0;
  const int beams = maps.workspace.document.shown()->sector().beams();
  for (const sonar::Run& run : schools[0]->masks.pings.at(0).mask.runs) {
    for (const int sample : {run.first_sample, run.end() - 1}) {
      maps.workspace.cursor.set(Voxel{run.row / beams, run.row % beams, sample});
      const auto overlays = maps.map.overlays();
      ASSERT_EQ(overlays.size(), 1U);
      const auto cross = overlays[0].cross;
      ASSERT_TRUE(cross);
      // The map's plane is even to a part of a cell.
      EXPECT_TRUE(std::any_of(cells.begin(), cells.end(),
                              [&](const PixelPoint& cell) {
                                return std::max(std::abs(cell.x - cross->x), std::abs(cell.y - cross->y)) <=
                                       0.75 * places->cell_px;
                              }))
          << run.row << " " << sample;
      ++voxels;
    }
  }
  EXPECT_GT(voxels, 3);
}

TEST(MosaicFollower, SetsNoPingWhoseMasksAreTheSame) {
  TestMaps maps;
  maps.propagate(maps.bright(), 2);
  maps.see(maps.map);
  const auto& shown = *maps.workspace.document.shown();
  const auto state = maps.workspace.document.choices().states.at(0);
  const auto pings = state->schools.at(0)->masks.pings.size();
  MosaicFollower follower;
  follower.start(MaskMosaic(*maps.map.places()->map, shown.files().pings.size()));
  // First as a propagation that runs, then as the state that it ends in: the same masks, so nothing is set again.
  auto before = std::make_shared<JournalState>();
  RunningMasks running;
  for (const auto& there : state->schools[0]->masks.pings) {
    running[there.ping_index] = std::make_shared<const PingMask>(there.mask);
  }
  EXPECT_EQ(follower.follow(shown.sector(), shown.files().navigation, masked_pings(before, running, true)), pings);
  EXPECT_EQ(follower.follow(shown.sector(), shown.files().navigation, masked_pings(state, {}, true)), 0U);
  EXPECT_EQ(follower.follow(shown.sector(), shown.files().navigation, masked_pings(before, {}, true)), pings);
  for (const auto cell : follower.mosaic().cells()) ASSERT_EQ(cell, 0);
}

TEST(ObservationMapModel, FillsWhileAPropagationRuns) {
  TestMaps maps;
  maps.see(maps.map);
  const Listening heard_of(maps.workspace.document.changes(), [&](DocumentChange change) {
    if (change == DocumentChange::propagating) maps.map.wait();  // each step's picture is built
  });
  std::size_t all = 0;
  std::size_t fillings = 0;
  const Listening drawn(maps.map.changed(), [&, pictures = maps.map.pictures()]() mutable {
    if (!maps.map.places() || maps.map.pictures() == pictures) return;
    pictures = maps.map.pictures();
    all += maps.map.places()->pings_set;
    fillings += maps.map.places()->pings_set > 0 ? 1U : 0U;
  });
  maps.propagate(maps.bright(), 3);
  const auto pings = maps.workspace.document.state().schools.at(0)->masks.pings.size();
  ASSERT_GT(pings, 2U);
  EXPECT_GE(all, pings);
  EXPECT_GE(fillings, pings - 1) << "ping by ping, not all at the end";
}

TEST(ObservationMapModel, AClickOnASchoolSelectsItOneOnThePathGoesToItsPing) {
  TestMaps maps;
  maps.propagate(maps.bright(), 3);
  maps.see(maps.map);
  TestMaps::click(maps.map, off_track(*maps.map.places()));
  ASSERT_TRUE(maps.workspace.school());
  EXPECT_EQ(*maps.workspace.school(), (SchoolName{0, 1}));
  TestMaps::click(maps.map, maps.map.places()->track->at(7));
  EXPECT_EQ(maps.workspace.document.ping(), 7);
}

TEST(ObservationMapModel, TheWheelZoomsAboutThePointerDraggingPansAndADoublePressShowsAll) {
  TestMaps maps;
  maps.see(maps.map);
  const MapFrame whole = *maps.map.places()->map;
  const PixelPoint at{300.0, 150.0};
  maps.map.pointer({.action = PointerAction::wheel, .at = at, .wheel_steps = 2.0});
  maps.settle();
  const MapFrame near = *maps.map.places()->map;
  EXPECT_NEAR(near.metres_per_px, whole.metres_per_px / (1.25 * 1.25), 1e-9);
  EXPECT_NEAR(near.plane(at).x, whole.plane(at).x, 1e-6);
  EXPECT_NEAR(near.plane(at).y, whole.plane(at).y, 1e-6);
  TestMaps::drag(maps.map, at, {260.0, 190.0});
  maps.settle();
  const MapFrame panned = *maps.map.places()->map;
  EXPECT_NEAR(panned.plane({260.0, 190.0}).x, near.plane(at).x, 1e-6);
  EXPECT_NEAR(panned.plane({260.0, 190.0}).y, near.plane(at).y, 1e-6);
  EXPECT_EQ(maps.workspace.document.ping(), 0) << "dragging is no click";
  maps.map.pointer({.action = PointerAction::double_press, .button = PointerButton::left, .at = at});
  maps.settle();
  EXPECT_EQ(maps.map.places()->map->metres_per_px, whole.metres_per_px);
  EXPECT_EQ(maps.map.places()->map->centre, whole.centre);
}

TEST(ObservationMapModel, TheLinkedCursorLiesWhereItsVoxelIsOnTheGlobe) {
  TestMaps maps;
  maps.see(maps.map);
  EXPECT_TRUE(maps.map.overlays().empty());
  const auto pictures = maps.map.pictures();
  const auto& sector = maps.workspace.document.shown()->sector();
  maps.workspace.cursor.set(Voxel{sector.fans() / 2, sector.beams() / 2, sector.range().count - 1});
  const auto overlays = maps.map.overlays();
  ASSERT_EQ(overlays.size(), 1U);
  ASSERT_TRUE(overlays[0].cross);
  // The farthest sample of the middle beam lies as far from the ship as the sector reaches, less its dip.
  const PixelPoint ship = maps.map.places()->track->front();
  const double px = std::hypot(overlays[0].cross->x - ship.x, overlays[0].cross->y - ship.y);
  const Point<Sonar> far = sector.centre(sector.fans() / 2, sector.beams() / 2, sector.range().count - 1);
  const double level_m = std::hypot(far.x, far.y);
  EXPECT_NEAR(px * maps.map.places()->map->metres_per_px, level_m, 0.01 * level_m);
  maps.settle();
  EXPECT_EQ(maps.map.pictures(), pictures) << "a cursor draws no map anew";
}

TEST(StripModel, ShowsThePingsRoundTheOneOnShowAndAClickGoesToOne) {
  TestMaps maps;
  maps.propagate(maps.bright(), 3);
  maps.workspace.document.look_at(5);
  maps.see(maps.strip, {900, 260});
  const auto places = maps.strip.places();
  ASSERT_TRUE(places);
  ASSERT_GE(places->panes.size(), 3U);
  EXPECT_EQ(places->panes.size(), static_cast<std::size_t>(maps.strip.panes()));
  for (std::size_t i = 0; i < places->panes.size(); ++i) {
    EXPECT_EQ(places->panes[i].ping, maps.strip.first() + static_cast<std::int64_t>(i));
    const bool there = in_ping(maps.workspace.document.state().schools.at(0)->masks, places->panes[i].ping) != nullptr;
    EXPECT_EQ(places->panes[i].school, there);
  }
  const auto& last = places->panes.back();
  const auto first = maps.strip.first();
  TestMaps::click(maps.strip, {last.place.x + 5.0, last.place.y + 5.0});
  EXPECT_EQ(maps.workspace.document.ping(), last.ping);
  maps.settle();
  EXPECT_EQ(maps.strip.first(), first) << "what was clicked stays under the pointer";
  maps.workspace.document.look_at(0);
  maps.settle();
  EXPECT_EQ(maps.strip.first(), 0);
}

TEST(StripModel, SaysNoSchoolOnlyWhereSchoolsWereLookedFor) {
  TestMaps maps;
  StripWish wish;
  wish.observation = maps.workspace.document.shown();
  wish.panes = 3;
  for (const bool searched : {false, true}) {
    wish.searched = searched;
    for (const PropagationPanel& panel : strip_panels(wish, {})) EXPECT_EQ(panel.searched, searched);
  }
}

// Nothing but their words can change: no school is there before and after.
TEST(StripModel, AndTheMapSayOtherwiseOnceSchoolsWereLookedForInVain) {
  TestMaps maps;
  const auto recipe = TestSurvey::easy().fresh() / "nothing.json";
  std::filesystem::create_directories(recipe.parent_path());
  std::ofstream(recipe) << R"({"recipe_version": 1, "track": {"min_level_db": 0}})";
  ASSERT_TRUE(maps.workspace.document.use_named_recipe(recipe.string()));
  maps.settle();
  maps.see(maps.strip);
  maps.see(maps.map);
  const Image strip = maps.strip.image();
  const Image map = maps.map.image();
  maps.workspace.document.detect({0});
  maps.settle();
  ASSERT_TRUE(maps.workspace.document.detected(0));
  ASSERT_TRUE(maps.workspace.document.state().schools.empty());
  EXPECT_NE(maps.strip.image(), strip);
  EXPECT_NE(maps.map.image(), map);
}

// As it is in a window that was drawn together to the height of a small laptop.
TEST(StripModel, InALowViewTheWordsAreFewerAndThePingsAreThere) {
  TestMaps maps;
  for (const int height : {360, 160, 120, 108, 60}) {
    maps.see(maps.strip, {380, height});
    EXPECT_EQ(maps.strip.problem(), "") << height;
    ASSERT_TRUE(maps.strip.places()) << height;
    EXPECT_GE(maps.strip.places()->panes.size(), 3U) << height;
  }
}

TEST(StripModel, ScrollsByWheelAndDraggingAsFarAsThereArePings) {
  TestMaps maps;
  maps.see(maps.strip, {900, 260});
  maps.strip.pointer({.action = PointerAction::wheel, .at = {100, 100}, .wheel_steps = -2.0});
  EXPECT_EQ(maps.strip.first(), 2);
  maps.strip.pointer({.action = PointerAction::wheel, .at = {100, 100}, .wheel_steps = -200.0});
  EXPECT_EQ(maps.strip.first(), TestSurvey::kPings - maps.strip.panes());
  maps.settle();
  EXPECT_EQ(maps.strip.places()->panes.back().ping, TestSurvey::kPings - 1);
  const double pane = maps.strip.places()->panes.front().place.width;
  TestMaps::drag(maps.strip, {100, 100}, {100 + 1.1 * pane, 100});
  EXPECT_EQ(maps.strip.first(), TestSurvey::kPings - maps.strip.panes() - 1);
  const int panes = maps.strip.panes();
  maps.strip.pointer({.action = PointerAction::wheel, .at = {100, 100}, .control = true, .wheel_steps = -1.0});
  EXPECT_EQ(maps.strip.panes(), panes + 1);
}

TEST(StripModel, SaysWhereAndWhyAPropagationEnded) {
  TestMaps maps;
  maps.propagate(maps.bright(), -1);
  const auto& state = maps.workspace.document.state();
  ASSERT_EQ(state.schools.size(), 1U);
  const auto ended = std::count_if(state.notes.begin(), state.notes.end(), [](const Diagnostic& note) {
    return note.code == DiagnosticCode::propagation_ended;
  });
  const auto& pings = state.schools[0]->masks.pings;
  maps.see(maps.strip, {1600, 300});
  std::size_t noted = 0;
  for (std::int64_t first = 0; first < TestSurvey::kPings; first += maps.strip.panes()) {
    maps.strip.pointer(
        {.action = PointerAction::wheel, .at = {9, 9}, .wheel_steps = first == 0 ? 100.0 : -1.0 * maps.strip.panes()});
    maps.settle();
    for (const auto& pane : maps.strip.places()->panes) {
      if (pane.note.empty()) continue;
      ++noted;
      EXPECT_TRUE(pane.ping == pings.front().ping_index - 1 || pane.ping == pings.back().ping_index + 1);
    }
  }
  EXPECT_EQ(noted > 0, ended > 0);
}

TEST(SurveyMapModel, AClickOnASchoolSelectsItAndLooksAtItsFirstPing) {
  TestMaps maps;
  maps.workspace.document.detect({1});
  maps.settle();
  ASSERT_EQ(maps.workspace.document.shown()->index(), 0U);
  maps.see(maps.survey, {900, 600});
  const auto places = maps.survey.places();
  ASSERT_TRUE(places);
  ASSERT_EQ(places->tracks.size(), 2U);
  EXPECT_EQ(places->tracks[0].size(), static_cast<std::size_t>(TestSurvey::kPings));
  ASSERT_EQ(places->schools.size(), 2U);
  const auto school = places->schools[1];
  EXPECT_EQ(school.name.observation, 1U);
  TestMaps::click(maps.survey, school.at);
  maps.settle();
  EXPECT_EQ(maps.workspace.school(), school.name);
  EXPECT_EQ(maps.workspace.document.shown()->index(), 1U);
  const auto& schools = maps.workspace.document.state(1).schools;
  const auto found =
      std::find_if(schools.begin(), schools.end(), [&](const auto& one) { return one->number == school.name.number; });
  ASSERT_NE(found, schools.end());
  EXPECT_EQ(maps.workspace.document.ping(), (*found)->masks.pings.front().ping_index);
}

TEST(SurveyMapModel, ADepthRasterThatCannotBeReadIsSaidAndTheMapStays) {
  TestMaps maps;
  maps.see(maps.survey, {900, 600});
  const auto without = maps.survey.image();
  maps.workspace.depth_raster.set("no-such-raster.nc");
  maps.settle();
  EXPECT_TRUE(maps.survey.problem().empty());
  EXPECT_NE(maps.survey.image(), without) << "the legend says what is wrong";
}

TEST(Maps, CostNothingWhileNotSeen) {
  TestMaps maps;
  maps.propagate(maps.bright(), 2);
  for (LivePicture* picture : std::vector<LivePicture*>{&maps.map, &maps.strip, &maps.survey, &maps.timeline}) {
    EXPECT_EQ(picture->pictures(), 0);
  }
  EXPECT_FALSE(maps.echograms->of(0));
}

}  // namespace
}  // namespace sonar
