// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "session/listening.h"
#include "session/lists/school_table.h"
#include "session/words/preferences.h"
#include "view/units.h"

namespace sonar {

/// A rule over schools: "pings >= 5, snr > 10, no edge -> accept".
struct BulkRule {
  enum class Quantity : std::uint8_t { pings, snr_db, edge_share, volume_m3, depth_m, length_m, sv_db, backscatter_m2 };
  enum class Sign : std::uint8_t { less, at_most, more, at_least, equal };
  struct Condition {
    Quantity quantity = Quantity::pings;
    Sign sign = Sign::at_least;
    double limit = 0.0;  ///< SI
  };
  std::vector<Condition> conditions;  ///< all of them hold
  std::string status;                 ///< one of kStatusNames
  std::string text;                   ///< as it was written, and what its lengths are in where they are not metres
};

inline constexpr std::string_view kDefaultBulkRule = "pings >= 5, snr > 10, no edge -> accept";

/// length  that depths and lengths of the text are in, as the list's own filter has them
/// errors  usage: what was not understood, and what was expected
[[nodiscard]] Result<BulkRule> bulk_rule(std::string_view text, const Unit& length = {1.0, "m"});
/// What is not measured holds against no condition.
[[nodiscard]] bool meets(const BulkRule& rule, const SurveySchool& school);

/// The schools of the whole survey in the order in which they want to be looked at: unreviewed first, and of these those
/// that scatter most. Tells after each decision how many are left; one that is undone has its school brought back into sight.
class Review : public SchoolTable {
 public:
  /// preferences  outlive it
  Review(Workspace& workspace, const Preferences& preferences);
  Review(const Review&) = delete;
  Review& operator=(const Review&) = delete;

  void narrow(const std::string& filter) override { filter_ = filter; }
  /// The next unreviewed school that the filter leaves, behind the selected one, from the beginning where there is none
  /// behind. Opens what is not open yet. Who scatters most is known when all are measured: until then it waits, says so,
  /// and goes there by itself, unless another school is selected meanwhile.
  void next();
  /// About the selected schools; goes on to the next where preferences say so.
  void decide(std::string status);
  /// Name of the digit's species, 1 to 9; 0 = none. Empty where there is no such species.
  [[nodiscard]] std::string species(int digit) const;
  void set_species(int digit);
  /// One step that can be undone, over all unreviewed schools of the survey. Lengths are in the user's unit.
  /// errors  usage: a rule that is not understood, or that no school meets
  Result<void> decide_all(std::string_view rule);
  [[nodiscard]] std::size_t unreviewed() const;
  /// "7 of 20 left", of the survey's schools.
  [[nodiscard]] std::string note() const override;

 protected:
  void make() override;
  void school_selected() override;

 private:
  [[nodiscard]] bool waits(const SurveySchool& school) const;
  [[nodiscard]] bool waits_for_figures() const;
  /// The status line must not say that somebody waits who does not.
  void wait_no_longer();
  void go_to(const SchoolName& school);
  void go_back();
  void follow_act();
  void tell_decided(const DecideCommand& command) const;
  void show_again(const DecideCommand& undone);

  const Preferences& preferences_;
  std::string filter_;
  bool goes_on_ = false;  ///< when everything is measured
  /// Decided, though the journal has not said so yet.
  std::set<std::pair<std::size_t, std::int64_t>> decided_;
  std::optional<SchoolName> left_;  ///< the last that was decided about, behind which the next one is shown
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
  Listening measured_listening_;  // the last member: it ends first
};

}  // namespace sonar
