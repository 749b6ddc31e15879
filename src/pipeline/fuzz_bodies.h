// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the fuzz targets of this room's parsers do; the plain tests replay the corpora through the same functions.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/check.h"
#include "io/csv_table.h"
#include "pipeline/biomass/length_table.h"
#include "pipeline/biomass/ts_table.h"
#include "pipeline/commands/command.h"
#include "pipeline/integrate/transects.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/journal/journal.h"
#include "pipeline/journal/named_lock.h"
#include "pipeline/recipe/json_file.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/recipe/transfer_function_json.h"
#include "pipeline/stages/measured_pings.h"
#include "pipeline/survey/cast_files.h"
#include "pipeline/survey/sound_profile.h"
#include "pipeline/tasks/plan.h"
#include "pipeline/tasks/survey_numbers.h"
#include "pipeline/tasks/task_record.h"

namespace sonar::fuzz {

/// A recipe that is taken says the same when it is written and read again.
inline void recipe(std::string_view text) {
  const auto read = recipe_from_text(text);
  if (!read) return;
  const std::string written = recipe_text(*read);
  const auto again = recipe_from_text(written);
  SONAR_CHECK(again.has_value() && recipe_text(*again) == written);
}

/// A journal's sound lines survive being written again; what they ask for is refused or understood, never worse.
inline void journal(std::string_view text) {
  const auto read = parse_journal(text, "fuzz");
  if (!read) return;
  std::string written = journal_head_text(*read) + "\n";
  for (const JournalLine& line : read->lines) written += journal_text(line) + "\n";
  const auto again = parse_journal(written, "fuzz");
  SONAR_CHECK(again.has_value() && again->lines.size() == read->lines.size() && again->diagnostics.empty());
  for (const JournalLine& line : effective_lines(read->lines)) {
    const auto act = act_of(line);
    if (!act) continue;
    const JournalLine said = line_of(*act);
    const auto same = act_of(said);
    SONAR_CHECK(same.has_value() && line_of(*same).command == said.command &&
                line_of(*same).args->dump() == said.args->dump());
    SONAR_CHECK(!sentence_of(act->command).words.empty());
    if (const auto* propagate = std::get_if<PropagateCommand>(&act->command)) {
      SONAR_CHECK(!propagate->seeds.empty() || propagate->school.has_value());
    }
  }
}

/// A plan that is taken says the same when it is written and read again.
inline void plan(std::string_view text) {
  const auto read = plan_from_text(text);
  if (!read) return;
  const std::string written = plan_text(*read);
  const auto again = plan_from_text(written);
  SONAR_CHECK(again.has_value() && plan_text(*again) == written);
  if (read->pings) SONAR_CHECK(read->pings->first >= 0 && read->pings->first <= read->pings->last);
  for (const PlanTask& task : read->tasks) SONAR_CHECK(task.pings >= 0);
}

/// A curve that is taken gives opacities at every Sv and says the same when it is written and read again.
inline void transfer_function(std::string_view text) {
  const auto json = parse_json(text);
  const auto curve = json ? transfer_function_from_json(*json) : Result<TransferFunction>(pass_on(json));
  if (!curve) return;
  const auto holds = [](double opacity) { return opacity >= 0.0 && opacity <= 1.0 + 1e-12; };
  for (double sv_db = -200.0; sv_db < 100.0; sv_db += 7.3) SONAR_CHECK(holds(curve->opacity(sv_db)));
  for (const TransferPoint& point : curve->points()) {
    SONAR_CHECK(holds(curve->opacity(point.sv_db)) && holds(curve->opacity(point.sv_db + 0.1)));
    for (const double part : curve->colour(point.sv_db)) SONAR_CHECK(part >= 0.0 && part <= 1.0);
  }
  const std::string written = to_json(*curve).dump();
  const auto again = transfer_function_from_json(*parse_json(written));
  SONAR_CHECK(again.has_value() && to_json(*again).dump() == written);
}

/// A calibration that is taken is one that a recipe may hold.
inline void calibration_csv(std::string_view text) {
  const auto table = parse_csv(text, "fuzz");
  Recipe with;
  if (!table || !take_calibration_table(with, *table)) return;
  SONAR_CHECK(with.calibration.beams.size() == table->records.size());
  const std::string written = recipe_text(with);
  const auto again = recipe_from_text(written);
  SONAR_CHECK(again.has_value() && recipe_text(*again) == written);
}

/// Tables that a user writes for biomass and integration: what is taken is what the table may say.
inline void survey_tables(std::string_view text) {
  const auto table = parse_csv(text, "fuzz");
  if (!table) return;
  if (const auto transects = transects_of(*table)) {
    TimeNs end = 0;
    for (const Transect& one : *transects) {
      SONAR_CHECK(one.start_utc <= one.stop_utc);
      if (one.type != EffortType::transect) continue;
      SONAR_CHECK(one.start_utc >= end && !one.name.empty());
      end = one.stop_utc;
    }
  }
  if (const auto relations = ts_relations_of(*table)) {
    for (const TsRelation& one : *relations) {
      SONAR_CHECK(ts_relation_named(*relations, one.name).has_value() && !ts_text(one).empty());
      const auto choices = ts_choices(*relations, one, 70.0, 120.0);
      SONAR_CHECK(std::ranges::count(choices, one.name, &TsRelation::name) == 1);
    }
  }
  if (const auto lengths = fish_lengths_of(*table)) {
    double shares = 0.0;
    for (const LengthClass& one : lengths->classes) {
      SONAR_CHECK(one.length_cm > 0.0 && one.length_cm <= 1000.0 && one.share >= 0.0 && one.share <= 1.0);
      shares += one.share;
    }
    SONAR_CHECK(std::abs(shares - 1.0) < 1e-9);
  }
  if (const auto areas = stratum_areas_of(*table)) {
    SONAR_CHECK(areas->size() == table->records.size());
    for (const auto& [name, nmi2] : *areas) SONAR_CHECK(nmi2 > 0.0 && std::isfinite(nmi2));
  }
}

/// What a work folder says of itself is believed where it can be, else passed over: numbers of schools in survey.json,
/// who works at an observation, who holds a lock, and what a product's recipe added to its times.
/// folder  to write into
inline void work_folder(std::string_view text, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "tasks");
  const std::filesystem::path lock = folder / "lock";
  for (const auto& file : {folder / "survey.json", folder / "tasks" / "obs-0001.json", lock}) {
    std::ofstream(file, std::ios::binary | std::ios::trunc)
        .write(text.data(), static_cast<std::streamsize>(text.size()));
  }
  ObservationProduct product;
  product.source = "MS70";
  product.schools.resize(2);
  product.schools[1].school_id = 1;
  std::vector<ObservationProduct> products{product};
  const auto kept = number_products(products, kept_numbers(folder));
  const auto& schools = products[0].schools;
  SONAR_CHECK(schools[0].survey_school > 0 && schools[1].survey_school > 0);
  SONAR_CHECK(schools[0].survey_school != schools[1].survey_school);
  for (const SurveyNumber& one : kept) SONAR_CHECK(one.number > 0);
  if (const auto record = read_record(folder, "obs-0001")) (void)is_alive(*record);
  SONAR_CHECK(NamedLock::holder(lock).find('\n') == std::string::npos);
  SONAR_CHECK(std::isfinite(time_offset_s(std::string(text))));
}

/// Measures that were kept are taken whole or not at all; those that are taken are the same when they are kept again.
inline void measured_pings(std::string_view bytes) {
  const MeasuredPings read = measured_from(std::as_bytes(std::span(bytes)));
  const std::vector<std::byte> written = measured_bytes(read);
  SONAR_CHECK(measured_bytes(measured_from(written)) == written);
}

/// A profile that is taken has a speed of this planet's water between any depths, and is one that a recipe may hold.
inline void sound_profile(std::string_view text) {
  const auto profile = profile_from_bytes(text, "fuzz");
  if (!profile) return;
  for (const double depth_m : {0.0, 3.5, 200.0}) {
    const double speed_mps = harmonic_mean_mps(*profile, depth_m, 400.0);
    SONAR_CHECK(speed_mps >= 999.0 && speed_mps <= 2001.0);
  }
  const auto again = profile_from_json(to_json(*profile));
  SONAR_CHECK(again.has_value() && *again == *profile);
}

}  // namespace sonar::fuzz
