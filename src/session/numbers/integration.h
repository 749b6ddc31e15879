// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/task_thread.h"
#include "base/work.h"
#include "pipeline/integrate/integrate.h"
#include "session/listening.h"
#include "session/numbers/table_rows.h"
#include "session/open/workspace.h"

namespace sonar {

/// Echo integration of the open survey as the window has it: its schools and bad pings as they are decided, the calibration in
/// force, the transects that are shown. It runs behind the window; the last result stays until another is there.
/// threads  the window's
class Integration {
 public:
  /// The workspace outlives it.
  explicit Integration(Workspace& workspace);
  ~Integration();
  Integration(const Integration&) = delete;
  Integration& operator=(const Integration&) = delete;

  Parameters<IntegrateParams>& params;  ///< the workspace's

  /// Opens and measures what is not yet, then integrates.
  /// errors  usage: no survey is open, its raw files are not here, or it runs already; bad_parameter
  Result<void> start();
  /// What was there before stays.
  void stop();
  [[nodiscard]] bool running() const { return waiting_ || work_ != nullptr; }
  [[nodiscard]] const Progress& progress() const { return progress_; }
  /// Of the survey that is open; null before the first.
  [[nodiscard]] const std::shared_ptr<const Integrated>& result() const { return result_; }
  /// What a user must know of it, or why there is none.
  [[nodiscard]] const std::string& told() const { return told_; }
  /// Of what a result is: "transects of lines.csv", "each observation is a transect".
  [[nodiscard]] std::string transects_text() const;

  /// effort.csv, nasc.csv and strata.csv.
  /// errors  usage: there is no result, or raw files lie there; io, no_space
  Result<void> write(const std::filesystem::path& folder) const;
  /// Looks at the ping at a share of a unit's time.
  /// effort  row of effort.csv
  void go_to(std::size_t effort, double share);

  TableRows<EffortRow> effort_rows;
  TableRows<NascRow> nasc_rows;
  TableRows<StratumRow> strata_rows;

  /// Called when anything of it has changed.
  [[nodiscard]] Listeners<>& changed() { return changed_; }
  /// Returns when nothing runs, its changes drained; for tests.
  void settle();

 private:
  /// Whether all schools are measured as they are decided now.
  [[nodiscard]] bool measured() const;
  void begin();
  void end(Result<Integrated> done);
  void hear(DocumentChange change);
  void put(std::shared_ptr<const Integrated> result);
  void tell(std::string line);

  Workspace& workspace_;
  bool waiting_ = false;  ///< for schools to be measured
  Progress progress_;
  std::shared_ptr<const Integrated> result_;
  std::string told_;
  Listeners<> changed_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< changes that come after the end are dropped
  std::shared_ptr<Work> work_;                                  ///< null = nothing runs
  TaskThread runs_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
