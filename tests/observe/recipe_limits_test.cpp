// SPDX-License-Identifier: Apache-2.0
// A recipe is believed within the ranges that describe() tells: so each number at either end of its range, and all of a
// stage together, must leave every stage standing, and what comes out sound.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "fixed_survey.h"
#include "io/simrad/test_bytes.h"
#include "pipeline/journal/manual.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/observe.h"

namespace sonar {
namespace {

enum class End { least, most };

/// Puts the numbers of a recipe whose full names it is told to an end of their range.
class ToEnd {
 public:
  ToEnd(std::function<bool(const std::string&)> chosen, End end) : chosen_(std::move(chosen)), end_(end) {}
  void field(std::string_view, bool&, const FieldInfo&) {}
  void field(std::string_view, std::string&, const FieldInfo&) {}
  void field(std::string_view name, int& value, const FieldInfo& info) {
    double as_number = value;
    number(name, as_number, info);
    value = static_cast<int>(as_number);
  }
  void field(std::string_view name, double& value, const FieldInfo& info) { number(name, value, info); }
  template <class E>
  void choice(std::string_view, E&, ChoiceNames, const ChoiceInfo&) {}
  template <class P>
  void group(std::string_view name, P& p, std::string_view) {
    const std::string outer = prefix_;
    prefix_ += std::string(name) + ".";
    describe(*this, p);
    prefix_ = outer;
  }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  void number(std::string_view name, double& value, const FieldInfo& info) {
    const double wanted = end_ == End::least ? info.min : info.max;
    const std::string whole = prefix_ + std::string(name);
    if (!chosen_(whole) || !std::isfinite(wanted)) return;
    names_.push_back(whole);
    value = wanted;
  }

  std::function<bool(const std::string&)> chosen_;
  End end_;
  std::string prefix_;
  std::vector<std::string> names_;
};

void sound(const PingMask& mask) {
  std::size_t voxels = 0;
  for (std::size_t i = 0; i < mask.runs.size(); ++i) {
    const Run& run = mask.runs[i];
    EXPECT_TRUE(run.row >= 0 && run.row < fixed::kFans * fixed::kBeams);
    EXPECT_TRUE(run.first_sample >= 0 && run.count > 0 && run.end() <= fixed::kSamples);
    EXPECT_TRUE(i == 0 || mask.runs[i - 1].row < run.row || mask.runs[i - 1].end() <= run.first_sample);
    voxels += static_cast<std::size_t>(run.count);
  }
  EXPECT_EQ(voxels, mask.confidence.size());
}

class RecipeLimits : public testing::Test {
 protected:
  RecipeLimits() : paths_{folder_.write("fixed.raw", fixed::file())} {}

  /// Every stage under a recipe; a refusal says why in a line.
  void go_through(const Recipe& recipe) {
    const auto survey = open_survey(paths_, recipe.survey, recipe.navigation, {}, work_);
    ASSERT_TRUE(survey);
    for (const ObservationFiles& observation : survey->observations) {
      const auto product = observe(*survey, observation, recipe, {{}, {}, "test"}, work_);
      if (!product) {
        EXPECT_FALSE(product.error().text.empty());
        continue;
      }
      for (const SchoolMask& mask : product->masks) sound(mask.mask);
      for (const SchoolPingRow& row : product->school_pings) EXPECT_FALSE(row.volume_m3 < 0.0);
      click(*survey, observation, recipe);
    }
  }

 private:
  void click(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe) {
    if (!observation.grid) return;
    Engine engine(survey, observation, recipe);
    const auto last = engine.pings() - 1;
    if (last < 2 || !engine.estimate_background(0, last, work_)) return;
    for (const GrowMode mode : {GrowMode::tracked, GrowMode::paper}) {
      PropagateCommand command;
      command.mode = mode;
      command.grow = recipe.grow;
      command.grow.mode = mode;
      command.paper = recipe.propagate_paper;
      command.tracked = recipe.propagate_tracked;
      command.seeds = {{engine.grid().channel[4 * fixed::kBeams + 5], fixed::kSchoolSample - 4}};
      JournalLine line;
      line.n = 1;
      line.command = "propagate";
      line.ping_time = observation.navigation[2].time;
      *line.args = to_json(command);
      Diagnostics notes;
      const std::vector<JournalLine> lines{line};
      for (const SchoolMasks& school : replay(engine, lines, {0, last}, notes)) {
        for (const SchoolMasks::InPing& in_ping : school.pings) sound(in_ping.mask);
      }
    }
  }

  test::TemporaryFolder folder_;
  std::vector<std::filesystem::path> paths_;
  Work work_{1};
};

std::vector<std::string> numbers_of_a_recipe() {
  Recipe recipe;
  ToEnd all([](const std::string&) { return true; }, End::most);
  describe(all, recipe);
  return all.names();
}

TEST_F(RecipeLimits, EachNumberMayStandAtEitherEnd) {
  const std::vector<std::string> names = numbers_of_a_recipe();
  ASSERT_GT(names.size(), 100U);
  for (const std::string& name : names) {
    for (const End end : {End::least, End::most}) {
      SCOPED_TRACE(name + (end == End::least ? " at its least" : " at its most"));
      Recipe recipe;
      ToEnd one([&](const std::string& whole) { return whole == name; }, end);
      describe(one, recipe);
      ASSERT_EQ(validate(recipe).has_value(), true);
      go_through(recipe);
    }
  }
}

TEST_F(RecipeLimits, AllNumbersOfAStageMayStandAtOneEnd) {
  std::set<std::string> stages;
  for (const std::string& name : numbers_of_a_recipe()) stages.insert(name.substr(0, name.find('.') + 1));
  for (const std::string& stage : stages) {
    for (const End end : {End::least, End::most}) {
      SCOPED_TRACE(stage + (end == End::least ? " at its least" : " at its most"));
      Recipe recipe;
      ToEnd all([&](const std::string& whole) { return whole.starts_with(stage); }, end);
      describe(all, recipe);
      go_through(recipe);
    }
  }
}

}  // namespace
}  // namespace sonar
