// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "io/csv.h"
#include "model/product.h"
#include "synth/truth.h"

namespace sonar::synth {

/// The truth's tables say themselves that no sea was looked into: in each row, and without any.
template <class Row>
struct SyntheticRow {
  Row row;
};

template <class Visitor, class Row>
void columns(Visitor& v, SyntheticRow<Row>& marked) {
  columns(v, marked.row);
  std::string yes = "yes";
  v("SYNTHETIC", "", yes);
}

/// errors  io, no_space
template <class Row>
Result<void> write_truth(const std::filesystem::path& path, const std::vector<Row>& rows) {
  std::vector<SyntheticRow<Row>> marked;
  marked.reserve(rows.size());
  for (const Row& row : rows) marked.push_back({row});
  return write_csv_rows(path, marked);
}

/// What is known of one observation, gathered ping by ping in order.
class ObservationTruth {
 public:
  explicit ObservationTruth(std::string name) { product_.observation = std::move(name); }
  void add(const PingNavigation& navigation, std::vector<SchoolTruth> schools, std::vector<BodyTruth> bodies);

 private:
  friend class SurveyTruth;
  ObservationProduct product_;
  std::vector<BodyTruth> bodies_;
};

/// Writes truth/obs-NNNN.nc as observations come, and the tables at the end.
class SurveyTruth {
 public:
  SurveyTruth(std::filesystem::path folder, std::string title, std::string program_version);
  /// errors  io, no_space
  Result<void> add(ObservationTruth observation, const std::optional<GridRecord>& grid);
  /// errors  io, no_space
  Result<void> finish();
  [[nodiscard]] std::int64_t schools() const { return static_cast<std::int64_t>(schools_.size()); }

 private:
  std::filesystem::path folder_;
  std::string title_;
  std::string program_version_;
  std::vector<SchoolRow> schools_;
  std::vector<SchoolPingRow> school_pings_;
  std::vector<BodyTruth> bodies_;
};

}  // namespace sonar::synth
