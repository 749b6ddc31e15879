// SPDX-License-Identifier: Apache-2.0
// From raw bytes to products and the survey: fish are counted once, whatever of click, detection and merge came first.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/school_totals.h"
#include "observed_survey.h"
#include "pipeline/commands/command.h"
#include "pipeline/tasks/merge.h"

namespace sonar {
namespace {

SchoolKey key_in(const SchoolMask& mask, const SurveyFiles& survey, const ObservationFiles& observation) {
  const auto run = std::max_element(mask.mask.runs.begin(), mask.mask.runs.end(),
                                    [](const auto& a, const auto& b) { return a.count < b.count; });
  return {survey.ping_time(observation, static_cast<std::size_t>(mask.ping_index)),
          observation.grid->channel[static_cast<std::size_t>(run->row)], run->first_sample + run->count / 2};
}

double total_m2(const std::vector<ObservationProduct>& products) {
  return total_backscatter_m2(counted_schools(products));
}

/// Two standard errors by fading: two schools' means hang on masks by no more, and one that is counted twice would add itself.
double as_much_as(const ObservationProduct& product) {
  double variance = 0.0;
  for (const SchoolRow& row : product.schools) variance += row.backscatter_total_se_m2 * row.backscatter_total_se_m2;
  return total_m2({product}) + 2.0 * std::sqrt(variance);
}

class OneSchoolObserved : public test::ObservedSurvey {
 protected:
  static std::vector<const SchoolMask*> masks_of(std::int64_t school_id) {
    std::vector<const SchoolMask*> masks;
    for (const SchoolMask& mask : product_->masks) {
      if (mask.school_id == school_id) masks.push_back(&mask);
    }
    return masks;
  }
  /// Of the school that was found in most pings, the middle one.
  static const SchoolMask& middle() {
    const auto longest = std::max_element(product_->schools.begin(), product_->schools.end(),
                                          [](const auto& a, const auto& b) { return a.n_pings < b.n_pings; });
    const auto masks = masks_of(longest->school_id);
    return *masks[masks.size() / 2];
  }
  /// A click on a school's mask, followed so many pings to each side.
  static JournalLine clicked(const SchoolMask& mask, std::int64_t reach) {
    const SchoolKey key = key_in(mask, *survey_, observation());
    PropagateCommand command;
    command.seeds = {{key.channel, key.sample}};
    command.reach = reach;
    JournalLine line = line_of(command);
    line.n = 1;
    line.ping_time = key.ping_time;
    return line;
  }
  static JournalLine reaching(std::int64_t pings) { return clicked(middle(), pings); }
  static JournalLine line_of(const Command& command) {
    JournalLine line;
    line.command = command_name(command);
    line.ping_time = survey_->ping_time(observation(), 0);
    *line.args = to_json(command);
    return line;
  }
  /// The school that is clicked, by a ping that no click of few pings reaches, and another one.
  static JournalLine merging() {
    const auto other = std::find_if(product_->masks.begin(), product_->masks.end(),
                                    [](const SchoolMask& mask) { return mask.school_id != middle().school_id; });
    return line_of(MergeCommand{{key_in(*masks_of(middle().school_id).front(), *survey_, observation()),
                                 key_in(*other, *survey_, observation())}});
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
  EXPECT_EQ(school_count(product), school_count(*product_));
  // Detection sees the school farther on both sides: no end is open.
  EXPECT_EQ(count(product, DiagnosticCode::ended_at_reach), 0);
  expect_apart(product);
  // Where nobody looks for schools, it is said.
  const ObservationProduct alone = observed(by_hand(), {reaching(2)});
  EXPECT_EQ(count(alone, DiagnosticCode::ended_at_reach), 2);
  ASSERT_NE(manual(alone), nullptr);
  EXPECT_EQ(manual(alone)->ended_at_reach, "both");
}

TEST_F(OneSchoolObserved, TotalsDoNotRiseWithTheOrderOfClickDetectionAndMerge) {
  const double most_m2 = as_much_as(*product_);
  for (const std::int64_t reach : {1, -1}) {
    const JournalLine detect = line_of(DetectCommand{2});
    const ObservationProduct under = observed({}, {reaching(reach)});
    const double total = total_m2({under});
    EXPECT_EQ(school_count(under), school_count(*product_)) << reach;
    EXPECT_LE(total, most_m2) << reach;
    expect_apart(under);
    for (const auto& journal : {in_order({detect, reaching(reach)}), in_order({reaching(reach), detect})}) {
      const ObservationProduct other = observed(by_hand(), journal);
      EXPECT_EQ(school_count(other), school_count(under));
      EXPECT_EQ(total_m2({other}), total);
    }
    if (reach < 0) continue;  // nothing is left to be merged in part
    // A human's merge makes both one school, in whatever order; after it the click finds no fish that are free.
    const double merged = total_m2({observed({}, in_order({reaching(reach), merging()}))});
    EXPECT_LE(merged, most_m2) << reach;
    EXPECT_LE(total_m2({observed({}, in_order({merging(), reaching(reach)}))}), most_m2) << reach;
    EXPECT_EQ(total_m2({observed(by_hand(), in_order({reaching(reach), detect, merging()}))}), merged);
    EXPECT_EQ(total_m2({observed(by_hand(), in_order({detect, reaching(reach), merging()}))}), merged);
    EXPECT_EQ(total_m2({observed(by_hand(), in_order({reaching(reach), merging(), detect}))}), merged);
  }
}

// A second run upon the products of the first, whichever of click and detection those knew.
TEST_F(OneSchoolObserved, TotalsDoNotRiseWhenItIsRunAgain) {
  const ObservationProduct fresh = observed({}, {reaching(2)});
  for (const ObservationProduct& before : {*product_, observed(by_hand(), {reaching(2)}), fresh}) {
    EarlierSchools earlier;
    earlier.add(before, 0.0);
    const std::vector<JournalLine> journal{reaching(2)};
    Work work(2);
    const auto again = observe(*survey_, observation(), {}, {{}, journal, "test", &earlier}, work);
    ASSERT_TRUE(again);
    EXPECT_EQ(school_count(*again), school_count(fresh));
    EXPECT_NEAR(total_m2({*again}), total_m2({fresh}), 1e-9 * total_m2({fresh})) << "numbers may be others";
    // Measured again it is the same school still, under whatever name the observation has now.
    ObservationProduct renamed = *again;
    renamed.observation = "obs-0007";
    for (SchoolRow& row : renamed.schools) {
      row.observation = renamed.observation;
      if (!row.continues.empty()) row.continues.replace(0, again->observation.size(), renamed.observation);
    }
    const auto measured = remeasure(*survey_, observation(), renamed, {}, {{}, journal, "test"}, work);
    ASSERT_TRUE(measured);
    EXPECT_EQ(school_count(*measured), school_count(fresh));
    ASSERT_NE(manual(*measured), nullptr);
    EXPECT_EQ(manual(*measured)->ended_at_reach, "both");
  }
}

TEST_F(OneSchoolObserved, TwoClicksOnOneSchoolAreOneSchool) {
  // The second click is three pings after the first, and meets what that one has.
  const auto masks = masks_of(middle().school_id);
  const auto later = std::find_if(masks.begin(), masks.end(),
                                  [](const SchoolMask* mask) { return mask->ping_index == middle().ping_index + 3; });
  ASSERT_NE(later, masks.end());
  const JournalLine second = clicked(**later, 1);
  std::vector<double> totals;
  for (const auto& lines : {in_order({reaching(1), second}), in_order({second, reaching(1)})}) {
    const ObservationProduct product = observed({}, lines);
    EXPECT_EQ(product.schools.size(), product_->schools.size() + 2);
    EXPECT_EQ(school_count(product), school_count(*product_));
    EXPECT_LE(total_m2({product}), as_much_as(*product_));
    totals.push_back(total_m2({product}));
    expect_apart(product);
    // Without detection they are joined where the reach ended both.
    const ObservationProduct alone = observed(by_hand(), lines);
    EXPECT_EQ(alone.schools.size(), 2U);
    EXPECT_EQ(school_count(alone), 1);
  }
  EXPECT_EQ(totals[0], totals[1]);
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
  const auto merged = [&](const std::vector<JournalLine>& journal, bool turned) {
    std::vector<ObservationProduct> made;
    for (const ObservationFiles& part : cut->observations) {
      auto product = observe(*cut, part, recipe, {{}, journal, "test"}, work);
      EXPECT_TRUE(product);
      if (product) made.push_back(std::move(*product));
    }
    if (turned) std::reverse(made.begin(), made.end());
    auto survey = merge(std::move(made));
    EXPECT_TRUE(survey);
    return survey ? survey->observations : std::vector<ObservationProduct>{};
  };
  const auto found = merged({}, false);
  EXPECT_EQ(counted_schools(found).size(), counted_schools({product_.get(), 1}).size());
  EXPECT_LE(total_m2(found), as_much_as(*product_)) << "a cut adds no fish";
  for (const std::int64_t reach : {1, -1}) {
    const auto one = merged({reaching(reach)}, false);
    const auto other = merged({reaching(reach)}, true);
    EXPECT_EQ(counted_schools(one).size(), counted_schools(found).size()) << reach;
    EXPECT_EQ(total_m2(one), total_m2(other));
    EXPECT_LE(total_m2(one), as_much_as(*product_)) << reach;
  }
}

}  // namespace
}  // namespace sonar
