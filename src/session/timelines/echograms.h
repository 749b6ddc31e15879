// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/task_thread.h"
#include "session/document.h"
#include "session/listeners.h"
#include "session/listening.h"
#include "view/timelines/echogram_pyramid.h"

namespace sonar {

using EchogramPtr = std::shared_ptr<const EchogramPyramid>;

/// Echograms of a survey's observations: from the user's cache, else filled ping by ping in the background, a few pings at
/// a time, and not while a choice is carried out. Filling goes on only while somebody looks.
/// threads  the window's
class Echograms {
 public:
  Echograms(ChangeQueue& queue, Document& document);
  ~Echograms();
  Echograms(const Echograms&) = delete;
  Echograms& operator=(const Echograms&) = delete;

  /// As far as it is filled; null = nothing yet.
  [[nodiscard]] EchogramPtr of(std::size_t observation) const;
  [[nodiscard]] bool complete(std::size_t observation) const;
  /// What is to be filled, the most urgent first, in place of what the same asker asked for before. None = it no longer
  /// looks.
  void want(const void* asker, std::vector<std::size_t> observations);
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
  void go_on();
  void read(const std::shared_ptr<Filling>& filling);
  void take(std::size_t observation, EchogramPtr echogram, bool complete);

  ChangeQueue& queue_;
  Document& document_;
  Listeners<> changed_;
  std::map<std::size_t, Kept> kept_;
  std::map<const void*, std::vector<std::size_t>> wanted_;
  std::map<std::size_t, std::shared_ptr<Filling>> fillings_;
  std::map<std::size_t, std::int64_t> asked_;  ///< pings of each that is filled
  std::set<std::size_t> grows_;                ///< observations that are being recorded
  bool reading_ = false;
  std::string recipe_;                                          ///< hash of what echograms are made under
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< changes that come after the end are dropped
  Listening listening_;
  TaskThread background_;  // the last member: it ends first
};

}  // namespace sonar
