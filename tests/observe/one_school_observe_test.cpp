// SPDX-License-Identifier: Apache-2.0
// From raw bytes to products and the survey: fish are counted once, whatever of click, detection and merge came first.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "model/school_totals.h"
#include "observed_survey.h"
#include "pipeline/commands/command.h"
#include "pipeline/merge.h"

namespace sonar {
namespace {

class OneSchoolObserved : public test::ObservedSurvey {
 protected:
  /// A click on a school in the middle of its pings, followed so many pings to each side.
  static JournalLine reaching(std::int64_t pings) {
    JournalLine line = click(GrowMode::tracked);
    line.args["reach"] = pings;
    return line;
  }
  static JournalLine detecting() {
    JournalLine line;
    line.command = "detect";
    line.ping_time = survey_->ping_time(observation(), 0);
    line.args = to_json(Command(DetectCommand{2}));
    return line;
  }
  static std::vector<JournalLine> in_order(std::vector<JournalLine> lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) lines[i].n = static_cast<std::int64_t>(i) + 1;
    return lines;
  }
  static Recipe by_hand() {
    Recipe recipe;
    recipe.automatic = false;
    return recipe;
  }
};

/// In each ping no voxel is two schools'.
void expect_apart(const ObservationProduct& product) {
  for (std::size_t a = 0; a < product.masks.size(); ++a) {
    for (std::size_t b = a + 1; b < product.masks.size(); ++b) {
      if (product.masks[a].ping_index != product.masks[b].ping_index) continue;
      EXPECT_EQ(overlap(product.masks[a].mask, product.masks[b].mask), 0U);
    }
  }
}

const SchoolRow* manual(const ObservationProduct& product) {
  const auto found = std::find_if(product.schools.begin(), product.schools.end(),
                                  [](const SchoolRow& row) { return row.origin == "manual"; });
  return found == product.schools.end() ? nullptr : &*found;
}

TEST_F(OneSchoolObserved, DetectionGoesOnWithTheSchoolWhereTheReachEndedIt) {
  const ObservationProduct product = observed({}, {reaching(2)});
  const SchoolRow* school = manual(product);
  ASSERT_NE(school, nullptr);
  EXPECT_EQ(school->ended_at_reach, "both");
  EXPECT_EQ(school->n_pings, 5);
  EXPECT_EQ(product.schools.size(), product_->schools.size() + 1) << "the rest of it is a row of its own";
  const auto rest = std::find_if(product.schools.begin(), product.schools.end(), [&](const SchoolRow& row) {
    return row.continues == school_name(product.observation, school->school_id);
  });
  ASSERT_NE(rest, product.schools.end());
  EXPECT_EQ(rest->origin, "automatic");
  EXPECT_EQ(totals_of(product.schools).schools, totals_of(product_->schools).schools);
  // An end is open where detection alone saw the school no farther either.
  const std::int64_t clicked = product_->masks[product_->masks.size() / 2].school_id;
  const auto saw = [&](std::int64_t ping) {
    return std::any_of(product_->masks.begin(), product_->masks.end(), [&](const SchoolMask& mask) {
      return mask.school_id == clicked && mask.ping_index == ping;
    });
  };
  const std::int64_t middle = product_->masks[product_->masks.size() / 2].ping_index;
  EXPECT_EQ(count(product, DiagnosticCode::ended_at_reach), (saw(middle - 3) ? 0 : 1) + (saw(middle + 3) ? 0 : 1));
  expect_apart(product);
  // Where nobody looks for schools, it is said.
  const ObservationProduct alone = observed(by_hand(), {reaching(2)});
  EXPECT_EQ(count(alone, DiagnosticCode::ended_at_reach), 2);
  ASSERT_NE(manual(alone), nullptr);
  EXPECT_EQ(manual(alone)->ended_at_reach, "both");
}

TEST_F(OneSchoolObserved, TotalsAreTheSameInWhateverOrderClickAndDetectionCame) {
  const double found_m2 = totals_of(product_->schools).backscatter_m2;
  for (const std::int64_t reach : {0, 1, 3, -1}) {
    const ObservationProduct under = observed({}, {reaching(reach)});
    const ObservationProduct before = observed(by_hand(), in_order({detecting(), reaching(reach)}));
    const ObservationProduct after = observed(by_hand(), in_order({reaching(reach), detecting()}));
    const SchoolTotals totals = totals_of(under.schools);
    EXPECT_EQ(totals.schools, totals_of(product_->schools).schools) << reach;
    // The human's masks are other masks of the same fish: a second count of a school would be half as much again.
    EXPECT_NEAR(totals.backscatter_m2 / found_m2, 1.0, 0.2) << reach;
    for (const ObservationProduct* other : {&before, &after}) {
      EXPECT_EQ(totals_of(other->schools).schools, totals.schools);
      EXPECT_EQ(totals_of(other->schools).backscatter_m2, totals.backscatter_m2);
      ASSERT_EQ(other->masks.size(), under.masks.size());
    }
    expect_apart(under);
  }
}

TEST_F(OneSchoolObserved, TwoClicksOnOneSchoolAreOneSchool) {
  // The second click is four pings after the first, and meets what that one has.
  const ObservationProduct once = observed({}, {reaching(1)});
  const SchoolRow* first = manual(once);
  ASSERT_NE(first, nullptr);
  const auto later = std::find_if(product_->masks.begin(), product_->masks.end(), [&](const SchoolMask& mask) {
    const auto& clicked = product_->masks[product_->masks.size() / 2];
    return mask.school_id == clicked.school_id && mask.ping_index == clicked.ping_index + 4;
  });
  ASSERT_NE(later, product_->masks.end());
  PropagateCommand command;
  const auto run = std::max_element(later->mask.runs.begin(), later->mask.runs.end(),
                                    [](const auto& a, const auto& b) { return a.count < b.count; });
  command.seeds = {
      {observation().grid->channel[static_cast<std::size_t>(run->row)], run->first_sample + run->count / 2}};
  command.reach = 1;
  JournalLine second = reaching(1);
  second.ping_time = survey_->ping_time(observation(), static_cast<std::size_t>(later->ping_index));
  second.args = to_json(command);
  const ObservationProduct one = observed({}, in_order({reaching(1), second}));
  const ObservationProduct other = observed({}, in_order({second, reaching(1)}));
  for (const ObservationProduct* product : {&one, &other}) {
    EXPECT_EQ(product->schools.size(), product_->schools.size() + 2);
    EXPECT_EQ(totals_of(product->schools).schools, totals_of(product_->schools).schools);
    expect_apart(*product);
  }
  EXPECT_EQ(totals_of(one.schools).backscatter_m2, totals_of(other.schools).backscatter_m2);
}

TEST_F(OneSchoolObserved, ACutObservationAndAMergedSurveyCountItOnce) {
  Recipe recipe;
  const double all_s =
      static_cast<double>(observation().navigation.back().time - observation().navigation.front().time) /
      static_cast<double>(kSecondNs);
  recipe.survey.observation_max_s = 0.55 * all_s;  // the click is in the first part
  Work work(2);
  const std::vector<std::filesystem::path> paths{folder_};
  const auto cut = open_survey(paths, recipe.survey, {}, {}, work);
  ASSERT_TRUE(cut);
  ASSERT_EQ(cut->observations.size(), 2U);
  const auto products = [&](const std::vector<JournalLine>& journal) {
    std::vector<ObservationProduct> made;
    for (const ObservationFiles& part : cut->observations) {
      auto product = observe(*cut, part, recipe, {{}, journal, "test"}, work);
      EXPECT_TRUE(product);
      if (product) made.push_back(std::move(*product));
    }
    return made;
  };
  const auto totals = [](std::vector<ObservationProduct> made) {
    const auto survey = merge(std::move(made));
    EXPECT_TRUE(survey);
    return survey ? totals_of(survey->schools) : SchoolTotals{};
  };
  const SchoolTotals found = totals(products({}));
  EXPECT_EQ(found.schools, totals_of(product_->schools).schools);
  for (const std::int64_t reach : {1, 3, -1}) {
    const std::vector<ObservationProduct> made = products({reaching(reach)});
    const SchoolTotals one = totals({made[0], made[1]});
    const SchoolTotals other = totals({made[1], made[0]});
    EXPECT_EQ(one.schools, found.schools) << reach;
    EXPECT_EQ(one.backscatter_m2, other.backscatter_m2);
    EXPECT_NEAR(one.backscatter_m2 / found.backscatter_m2, 1.0, 0.2) << reach;
  }
}

}  // namespace
}  // namespace sonar
