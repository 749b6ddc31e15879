// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "pipeline/journal/merge_proposals.h"
#include "session/listening.h"
#include "session/open/workspace.h"

namespace sonar {

class AppModel;

inline constexpr std::string_view kMergeProposedAction = "school.merge_proposed";

/// After a propagation and a detection: schools that touch, or go on where the changed ones end, are offered to be merged. Each
/// offer stands until it is taken, declined, or the masks change where the two meet; undo brings it back with the masks.
/// threads  the window's
class MergeOffer {
 public:
  /// The workspace outlives this.
  explicit MergeOffer(Workspace& workspace);
  MergeOffer(const MergeOffer&) = delete;
  MergeOffer& operator=(const MergeOffer&) = delete;

  /// Of the observation on show; empty where none stands.
  [[nodiscard]] std::optional<MergeProposal> standing() const;
  /// "Merge school 3 and school 5"; empty where none stands.
  [[nodiscard]] std::string text() const;
  /// In one act; the one that stays is selected.
  void take();
  /// These two are not proposed again while the window is open.
  void decline();
  [[nodiscard]] Listeners<>& changed() { return changed_; }

 private:
  struct Offer {
    std::size_t observation = 0;
    MergeProposal proposal;
    JournalStatePtr told;  ///< the state that it was made for
  };
  using Pair = std::tuple<std::size_t, std::int64_t, std::int64_t>;  ///< observation, lower and higher number

  void hear(DocumentChange change);
  void look(std::size_t observation, JournalStatePtr state, std::set<std::int64_t> changed);
  void take_found(std::size_t observation, const JournalStatePtr& state, const std::vector<MergeProposal>& found);
  [[nodiscard]] const Offer* first() const;

  Workspace& workspace_;
  std::vector<Offer> offers_;
  std::set<Pair> declined_;
  std::map<std::size_t, JournalStatePtr> states_;  ///< as they were last told
  Listeners<> changed_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);
  Listening listening_;  // the last member: it ends first
};

/// Adds school.merge_proposed and school.keep_apart.
void add_merge_offer(AppModel& app);

}  // namespace sonar
