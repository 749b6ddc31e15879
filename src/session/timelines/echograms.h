// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/task_thread.h"
#include "publish/echograms/echogram_columns.h"
#include "session/listeners.h"
#include "session/listening.h"
#include "session/open/document.h"
#include "view/timelines/echogram_pyramid.h"

namespace sonar {

using EchogramPtr = std::shared_ptr<const EchogramPyramid>;

/// An echogram of a survey: which observation's, and what of its pings.
struct EchogramName {
  std::size_t observation = 0;  ///< index in the survey
  EchogramOf of;                ///< no fan = all beams, out to the last sample, as timelines show them
  EchogramSamples shown;        ///< of all beams `filtered` alone tells
  int channel = -1;             ///< of an observation whose beams make no grid, 0-based; -1 = of beams
  [[nodiscard]] bool all_beams() const { return channel < 0 && !of.fan; }
  /// Of all beams: what noise removal took out is left out in either case.
  [[nodiscard]] static EchogramName of_all_beams(std::size_t observation, bool filtered = false) {
    return {observation, {}, {.filtered = filtered}};
  }
  friend auto operator<=>(const EchogramName&, const EchogramName&) = default;
};

/// Echograms of a survey's observations: from the user's cache, else filled ping by ping in the background, a few pings at
/// a time, and not while a choice is carried out. Filling goes on only while somebody looks. Of single beams and fans that
/// nobody looks at any more the latest few are kept.
/// threads  the window's
class Echograms {
 public:
  Echograms(ChangeQueue& queue, Document& document);
  ~Echograms();
  Echograms(const Echograms&) = delete;
  Echograms& operator=(const Echograms&) = delete;

  /// As far as it is filled; null = nothing yet.
  [[nodiscard]] EchogramPtr of(const EchogramName& name) const;
  [[nodiscard]] bool complete(const EchogramName& name) const;
  /// The same of all beams.
  [[nodiscard]] EchogramPtr of(std::size_t observation) const { return of(EchogramName::of_all_beams(observation)); }
  [[nodiscard]] bool complete(std::size_t observation) const {
    return complete(EchogramName::of_all_beams(observation));
  }
  /// What is to be filled, the most urgent first, in place of what the same asker asked for before. None = it no longer
  /// looks.
  void want(const void* asker, std::vector<EchogramName> names);
  /// Called when of() has changed.
  [[nodiscard]] Listeners<>& changed() { return changed_; }
  /// Returns when no pings are being read; the rest goes on when the queue is drained. For tests.
  void wait() { background_.wait(); }

 private:
  struct Filling;
  struct Kept {
    EchogramPtr echogram;
    bool complete = false;
  };
  void forget();
  void follow_calibration();
  void follow_growth();
  void forget_unwanted();
  [[nodiscard]] std::shared_ptr<Filling> begun(const EchogramName& name) const;
  [[nodiscard]] std::int64_t pings_of(const EchogramName& name) const;
  void go_on();
  void read(const std::shared_ptr<Filling>& filling);
  void take(const EchogramName& name, EchogramPtr echogram, bool complete);

  ChangeQueue& queue_;
  Document& document_;
  Listeners<> changed_;
  std::map<EchogramName, Kept> kept_;
  std::map<const void*, std::vector<EchogramName>> wanted_;
  std::map<EchogramName, std::shared_ptr<Filling>> fillings_;
  std::map<EchogramName, std::int64_t> asked_;  ///< pings of each that is filled
  std::set<EchogramName> grows_;                ///< of observations that are being recorded
  std::vector<EchogramName> parts_;             ///< of one beam, fan or channel, the last wanted last
  bool reading_ = false;
  std::string recipe_;                                          ///< hash of what echograms are made under
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< changes that come after the end are dropped
  Listening listening_;
  TaskThread background_;  // the last member: it ends first
};

}  // namespace sonar
