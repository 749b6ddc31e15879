// SPDX-License-Identifier: Apache-2.0
#include "session/review/refused_layer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "session/looks/curves.h"
#include "session/maps/observation_map_model.h"
#include "session/slices/test_slices.h"
#include "session/timelines/timeline_model.h"
#include "session/volume/volume_model.h"

namespace sonar {
namespace {

using testing::HasSubstr;
using testing::Not;

/// No school is 15 fans high: the survey's schools, clean and bright, are all refused, by judge size.
Recipe tall() { return *recipe_from_text(R"({"recipe_version":1,"detect":{"min_fans":15}})"); }

class Refused : public testing::Test {
 protected:
  void detect() {
    app_.ask("schools.detect");
    app_.settle();
  }
  Workspace& workspace() { return app_.workspace(); }
  Document& document() { return app_.document(); }
  const std::vector<JournalLine>& lines() { return *document().choices().lines; }
  Rows& list() { return *app_.app.rows("refused"); }
  /// Looks at an echo's loudest sighting, as a click on its row does.
  RefusedEcho choose(std::size_t row = 0) {
    list().select(row);
    app_.settle();
    const RefusedPtr rows = document().refused(0);
    const std::vector<RefusedSightings> sightings = refused_sightings(*rows);
    return *sightings.at(row).loudest;
  }
  PixelPoint mark_in(SliceModel& slice, std::int64_t id) {
    const auto& marks = slice.picture()->refused;
    const auto found = std::ranges::find(marks, id, &PlacedMark::echo_id);
    EXPECT_NE(found, marks.end());
    return found == marks.end() ? PixelPoint{} : found->at;
  }

  SlicesApp app_{tall()};
};

TEST_F(Refused, NothingIsRefusedBeforeAnybodyLooked) {
  EXPECT_TRUE(document().refused(0)->empty());
  EXPECT_TRUE(document().refused(17)->empty());
  EXPECT_EQ(list().rows(), 0U);
  EXPECT_TRUE(app_.top().picture()->refused.empty());
  EXPECT_FALSE(app_.app.actions.find("school.take_in")->enabled());
  app_.ask("school.take_in");
  app_.settle();
  EXPECT_TRUE(lines().empty());
}

TEST_F(Refused, TheListHasEveryEchoAndAClickGoesToIt) {
  detect();
  ASSERT_GE(list().rows(), 1U);
  EXPECT_EQ(document().state().schools.size(), 0U);
  const RefusedEcho loudest = choose();
  EXPECT_EQ(document().ping(), loudest.ping_index);
  EXPECT_EQ(workspace().echo(), (EchoName{0, loudest.echo_id}));
  EXPECT_EQ(list().selected(), 0U);
  const BeamGrid& grid = document().shown()->grid();
  const int row = grid.row_of_channel()[static_cast<std::size_t>(loudest.channel)];
  EXPECT_EQ(workspace().slices(),
            (SlicePlaces{row / grid.beams(), row % grid.beams(), static_cast<int>(loudest.sample)}));
  std::string all;
  for (std::size_t c = 0; c < list().columns().size(); ++c) all += list().cell(0, c).text + "|";
  EXPECT_THAT(all, HasSubstr(why_no_school(loudest)));
  EXPECT_THAT(all, HasSubstr("|size|"));
}

TEST_F(Refused, SlicesMarkIt_HoverSaysWhy_AndTheLayerCanBeSwitchedOff) {
  detect();
  const RefusedEcho loudest = choose();
  workspace().echo.set(std::nullopt);
  app_.settle();
  for (SliceModel* slice : {&app_.top(), &app_.side()}) {
    const PixelPoint at = mark_in(*slice, loudest.echo_id);
    EXPECT_EQ(at, slice->picture()->place_of(*loudest_on_show(workspace(), {0, loudest.echo_id})));
    EXPECT_THAT(slice->hint(at), HasSubstr(why_no_school(loudest)));
    EXPECT_THAT(slice->hint(at), HasSubstr("I takes it in"));
    EXPECT_THAT(slice->hint({at.x + 40.0, at.y}), Not(HasSubstr("no school")));
    slice->pointer({PointerAction::move, PointerButton::none, at});
    EXPECT_EQ(workspace().echo(), (EchoName{0, loudest.echo_id})) << "what is pointed at is what the key is about";
    workspace().echo.set(std::nullopt);
    app_.settle();
  }
  app_.ask("display.refused");
  app_.settle();
  EXPECT_TRUE(app_.top().picture()->refused.empty());
  EXPECT_GE(list().rows(), 1U) << "the list stays";
  workspace().echo.set(EchoName{0, loudest.echo_id});
  EXPECT_FALSE(app_.app.actions.find("school.take_in")->enabled()) << "what nobody sees is not taken in";
  app_.ask("display.refused");
  EXPECT_TRUE(app_.app.actions.find("school.take_in")->enabled());
}

TEST_F(Refused, OneKeyMakesItASchoolInOneStep) {
  detect();
  const std::size_t echoes = list().rows();
  const RefusedEcho loudest = choose();
  const std::size_t before = lines().size();
  app_.ask("school.take_in");
  app_.settle();
  ASSERT_EQ(document().state().schools.size(), 1U);
  const StateSchool& school = *document().state().schools[0];
  EXPECT_TRUE(school.by_hand);
  const auto* there = in_ping(school.masks, loudest.ping_index);
  ASSERT_NE(there, nullptr);
  const int row = document().shown()->grid().row_of_channel()[static_cast<std::size_t>(loudest.channel)];
  EXPECT_GT(confidence_at(there->mask, row, static_cast<int>(loudest.sample)), 0) << "it grew from its loudest voxel";
  EXPECT_GT(school.masks.pings.size(), 1U) << "and was followed, as by a double click";
  // The journal: what a double click writes, as one step.
  ASSERT_EQ(lines().size(), before + 2);
  EXPECT_EQ(lines()[before].command, "grow");
  EXPECT_EQ(lines()[before + 1].command, "propagate");
  EXPECT_EQ(lines()[before].step, lines()[before + 1].step);
  EXPECT_NE(lines()[before].step, 0);
  // It is a school now, and no refused echo.
  EXPECT_LT(list().rows(), echoes) << "nor are its sightings in other pings";
  for (const RefusedEcho& left : *document().refused(0)) EXPECT_NE(left.echo_id, loudest.echo_id);
  EXPECT_EQ(workspace().echo(), std::nullopt);
  ASSERT_TRUE(workspace().school());
  EXPECT_EQ(workspace().school()->number, school.number);
  for (const PlacedMark& mark : app_.top().picture()->refused) EXPECT_NE(mark.echo_id, loudest.echo_id);

  app_.ask("edit.undo");
  app_.settle();
  EXPECT_EQ(document().state().schools.size(), 0U);
  EXPECT_EQ(list().rows(), echoes) << "one undo, and it is refused again";
  app_.ask("edit.redo");
  app_.settle();
  EXPECT_EQ(document().state().schools.size(), 1U);
  EXPECT_LT(list().rows(), echoes);
}

// It is the last growth: the slider goes on with it, as after a click.
TEST_F(Refused, WhatWasTakenInGrowsAnewWithAnotherTolerance) {
  detect();
  const RefusedEcho loudest = choose();
  app_.ask("school.take_in");
  app_.settle();
  const auto voxels = [&] {
    const auto& schools = document().state().schools;
    const auto* there = schools.size() == 1 ? in_ping(schools[0]->masks, loudest.ping_index) : nullptr;
    return there == nullptr ? std::size_t{0} : there->mask.voxels();
  };
  const std::size_t before = voxels();
  SelectParams select = workspace().select.values();
  select.tolerance_db = 5.0;
  workspace().select.assign(select);
  app_.settle();
  document().look_at(document().ping());  // anything else that is done ends the wait
  app_.settle();
  EXPECT_GT(voxels(), 0U);
  EXPECT_LT(voxels(), before);
  EXPECT_GT(document().state().schools[0]->masks.pings.size(), 1U) << "and is followed again";
  app_.ask("edit.undo");
  app_.settle();
  EXPECT_EQ(voxels(), before) << "as it was taken in";
  EXPECT_EQ(workspace().select.values().tolerance_db, 10.0);
  app_.ask("edit.undo");
  app_.settle();
  EXPECT_EQ(document().state().schools.size(), 0U) << "undo knows one growth";
}

TEST_F(Refused, WhereNothingGrowsOneLineSaysWhy) {
  detect();
  choose();
  // No fish is as loud as -5 dB, below which this curve is 0.
  workspace().growth_curve.set(*growth_curve_of({{-5.0, 0.0}, {0.0, 0.8}}));
  app_.settle();
  const std::size_t before = lines().size();
  const std::size_t told = document().notices().size();
  app_.ask("school.take_in");
  app_.settle();
  EXPECT_EQ(lines().size(), before);
  ASSERT_EQ(document().notices().size(), told + 1);
  EXPECT_THAT(document().notices().back(), HasSubstr("too weak to grow from"));
  EXPECT_TRUE(workspace().echo()) << "and the echo stays refused";
}

TEST_F(Refused, FromAnotherPingTheKeyGoesThereFirst) {
  detect();
  const RefusedEcho loudest = choose();
  const RefusedPtr rows = document().refused(0);
  const auto seen = [&](std::int64_t ping) {
    return std::ranges::any_of(
        *rows, [&](const RefusedEcho& row) { return row.ping_index == ping && row.echo_id == loudest.echo_id; });
  };
  std::int64_t elsewhere = 0;
  while (seen(elsewhere)) ++elsewhere;
  ASSERT_LT(elsewhere, TestSurvey::kPings);
  document().look_at(elsewhere);
  app_.settle();
  EXPECT_EQ(list().selected(), std::nullopt);
  const std::size_t before = lines().size();
  app_.ask("school.take_in");
  app_.settle();
  EXPECT_EQ(document().ping(), loudest.ping_index);
  EXPECT_EQ(lines().size(), before);
  EXPECT_THAT(document().notices().back(), HasSubstr("press again to accept it"));
  app_.ask("school.take_in");
  app_.settle();
  EXPECT_EQ(lines().size(), before + 2);
}

TEST_F(Refused, UndoingTheSearchTakesTheLayerAwayAndAnotherRunBringsItBack) {
  detect();
  const std::size_t echoes = list().rows();
  app_.ask("edit.undo");
  app_.settle();
  EXPECT_EQ(list().rows(), 0U);
  app_.ask("edit.redo");
  app_.settle();
  EXPECT_EQ(list().rows(), echoes);
  document().open({TestSurvey::easy().folder()});
  app_.settle();
  EXPECT_EQ(list().rows(), echoes) << "the journal asks for the search";
}

TEST_F(Refused, MapsAndTimelinesMarkItToo) {
  auto& map = dynamic_cast<ObservationMapModel&>(*app_.app.picture("observation_map"));
  auto& timeline = dynamic_cast<TimelineModel&>(*app_.app.picture("observation_timeline"));
  map.resize({480, 360}, 1.0);
  timeline.resize({640, 360}, 1.0);
  map.set_seen(true);
  timeline.set_seen(true);
  const auto settle = [&] {
    app_.settle();
    map.wait();
    timeline.wait();
    app_.settle();
  };
  detect();
  settle();
  const RefusedPtr rows = document().refused(0);
  const std::vector<RefusedSightings> sightings = refused_sightings(*rows);
  ASSERT_FALSE(sightings.empty());
  ASSERT_EQ(map.places()->refused.size(), sightings.size());
  const PixelPoint at = map.places()->refused.front().at;
  EXPECT_THAT(map.hint(at), HasSubstr(why_no_school(*sightings.front().loudest)));
  for (const PointerAction action : {PointerAction::press, PointerAction::release}) {
    map.pointer({action, PointerButton::left, at});
  }
  settle();
  EXPECT_EQ(workspace().echo(), (EchoName{0, sightings.front().loudest->echo_id}));
  EXPECT_EQ(document().ping(), sightings.front().loudest->ping_index);

  const RefusedEcho& loudest = *sightings.front().loudest;
  const TimeNs time = document().shown()->files().navigation[static_cast<std::size_t>(loudest.ping_index)].time;
  const PixelPoint there{timeline.places()->x_of(time), timeline.places()->plot.at(0.0, loudest.range_m).y};
  EXPECT_THAT(timeline.hint(there), HasSubstr(why_no_school(loudest)));
  workspace().echo.set(std::nullopt);
  timeline.pointer({PointerAction::press, PointerButton::left, there});
  settle();
  EXPECT_EQ(workspace().echo(), (EchoName{0, loudest.echo_id}));
  app_.ask("display.refused");
  settle();
  EXPECT_TRUE(map.places()->refused.empty());
  EXPECT_THAT(timeline.hint(there), Not(HasSubstr("no school")));
}

TEST_F(Refused, TheVolumeMarksItWhateverStandsBeforeIt) {
  VolumeParams quick;
  quick.renderer = RendererChoice::cpu;
  quick.frames = 0;
  workspace().volume.assign(quick);
  auto& volume = dynamic_cast<VolumeModel&>(*app_.app.picture("volume"));
  volume.resize({340, 260}, 1.0);
  volume.set_seen(true);
  detect();
  const RefusedEcho loudest = choose();
  volume.wait();
  app_.settle();
  const EchoName echo{0, loudest.echo_id};
  const Voxel at = *loudest_on_show(workspace(), echo);
  const auto place = volume.shown()->place_of(document().shown()->sector().centre(at.fan, at.beam, at.sample));
  ASSERT_TRUE(place);
  EXPECT_THAT(volume.hint(*place), HasSubstr(why_no_school(loudest)));
  workspace().echo.set(std::nullopt);
  volume.pointer({PointerAction::move, PointerButton::none, *place});
  EXPECT_EQ(workspace().echo(), echo);
  volume.wait();
  app_.settle();
}

// What a window measures and exports tells refusals as `run` does.
TEST_F(Refused, TheWindowsProductsTellThem) {
  detect();
  const ProductPtr before = document().product(0);
  ASSERT_TRUE(before);
  Work work;
  Recipe recipe = tall();
  const auto of_run = observe(*document().survey(), document().shown()->files(), recipe, {{}, {}, "test"}, work);
  ASSERT_TRUE(of_run.has_value());
  const auto rows = [](const std::vector<RefusedEcho>& rejected) {
    std::vector<std::string> told;
    for (const RefusedEcho& row : rejected) {
      told.push_back(
          fmt::format("{} {} {} {} {}", row.ping_index, row.channel, row.sample, row.level_db, why_no_school(row)));
    }
    return told;
  };
  EXPECT_FALSE(of_run->rejected.empty());
  EXPECT_EQ(rows(before->rejected), rows(of_run->rejected));
  choose();
  app_.ask("school.take_in");
  app_.settle();
  const auto with_journal =
      observe(*document().survey(), document().shown()->files(), recipe, {{}, effective_lines(lines()), "test"}, work);
  ASSERT_TRUE(with_journal.has_value());
  EXPECT_EQ(with_journal->schools.size(), 1U);
  EXPECT_LT(with_journal->rejected.size(), of_run->rejected.size()) << "what is a school is refused no more";
  EXPECT_EQ(rows(document().product(0)->rejected), rows(with_journal->rejected));
}

}  // namespace
}  // namespace sonar
