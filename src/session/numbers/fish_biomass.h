// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "base/task_thread.h"
#include "model/fish_lengths.h"
#include "model/ts_relation.h"
#include "pipeline/biomass/biomass.h"
#include "session/listening.h"
#include "session/live/live_picture.h"
#include "session/numbers/fish_params.h"
#include "session/numbers/integration.h"
#include "session/numbers/table_rows.h"
#include "session/open/workspace.h"

namespace sonar {

/// Numbers and biomass of the schools of the open survey, and of the strata that were integrated: they follow every choice, and
/// the schools as they change. Nothing is computed before begin().
/// threads  the window's
class FishBiomass {
 public:
  /// Both outlive it.
  FishBiomass(Workspace& workspace, Integration& integration);
  FishBiomass(const FishBiomass&) = delete;
  FishBiomass& operator=(const FishBiomass&) = delete;

  Parameters<FishParams>& params;  ///< the workspace's

  /// Somebody looks: schools of all observations are measured, and figures follow from now on.
  void begin();
  /// Nobody looks any more: figures stay as they are until begin().
  void end() { begun_ = false; }

  /// Relations to choose from.
  [[nodiscard]] const std::vector<TsRelation>& relations() const { return relations_; }
  /// As `sonarx biomass --ts-table` has it; empty = those that come with the program. Where the chosen relation is not among
  /// them, the first is chosen.
  /// errors  as read_ts_table(): what was there stays
  Result<void> read_relations(const std::filesystem::path& file);
  [[nodiscard]] const std::filesystem::path& relations_file() const { return relations_file_; }
  /// Whether the band spans a relation. At first those that could be meant, see ts_choices().
  [[nodiscard]] bool spans(const std::string& relation) const;
  void set_spans(const std::string& relation, bool on);
  /// errors  as read_fish_lengths(): what was there stays
  Result<void> read_lengths(const std::filesystem::path& file);
  [[nodiscard]] const std::filesystem::path& lengths_file() const { return lengths_file_; }
  /// errors  as read_stratum_areas(): what was there stays
  Result<void> read_areas(const std::filesystem::path& file);
  [[nodiscard]] const std::filesystem::path& areas_file() const { return areas_file_; }

  /// Null before the first, and where there is none.
  [[nodiscard]] const std::shared_ptr<const Biomass>& result() const { return result_; }
  /// What a user must know of the figures, or why there are none.
  [[nodiscard]] const std::string& told() const { return told_; }
  /// The chosen relation with its source, and what is missing or recalled.
  [[nodiscard]] std::string relation_text() const;
  /// Of the school that was clicked last in its table, else of all.
  [[nodiscard]] std::pair<std::string, BandCauses> causes() const;

  /// biomass.csv, biomass_pings.csv and biomass_strata.csv.
  /// errors  usage: there is no result, or raw files lie there; io, no_space
  Result<void> write(const std::filesystem::path& folder) const;

  TableRows<BiomassRow> school_rows;
  TableRows<BiomassStratumRow> strata_rows;

  [[nodiscard]] Listeners<>& changed() { return changed_; }
  /// Returns when nothing runs, its changes drained; for tests.
  void settle();

 private:
  void again();
  void compute();
  void select(std::size_t row);
  void choose_known_relation();
  [[nodiscard]] Result<FishChoice> chosen_fish() const;
  void put(std::shared_ptr<const Biomass> result, std::string told);
  [[nodiscard]] std::string notes_of(const Biomass& done, std::size_t unmeasured) const;

  Workspace& workspace_;
  Integration& integration_;
  bool begun_ = false;
  std::vector<TsRelation> relations_;
  std::filesystem::path relations_file_;
  std::map<std::string, bool> spans_;  ///< by a human's hand; others are as ts_choices() has them
  std::optional<FishLengths> lengths_;
  std::filesystem::path lengths_file_;
  std::map<std::string, double> areas_;
  std::filesystem::path areas_file_;
  FrequencyBand sonar_;
  std::shared_ptr<const Integrated> integrated_;
  std::shared_ptr<const Biomass> result_;
  std::string told_;
  /// A school, whatever row it stands in.
  struct School {
    std::string observation;
    std::int64_t school_id = 0;
    friend bool operator==(const School&, const School&) = default;
  };
  [[nodiscard]] static School school_of(const BiomassRow& row) { return {row.observation, row.school_id}; }
  [[nodiscard]] std::optional<std::size_t> selected_row() const;
  std::optional<School> selected_;
  std::int64_t wishes_ = 0;  ///< the last wish wins
  Listeners<> changed_;
  std::shared_ptr<bool> alive_ = std::make_shared<bool>(true);  ///< changes that come after the end are dropped
  TaskThread background_;
  Listening listening_;  // the last member: it ends first
};

/// A bar for each cause of the band, of the school clicked last or of all.
class CausePicture : public LivePicture {
 public:
  /// Both outlive the picture.
  CausePicture(Workspace& workspace, FishBiomass& fish);

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;

 private:
  FishBiomass& fish_;
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
