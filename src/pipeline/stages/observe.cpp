// SPDX-License-Identifier: Apache-2.0
#include "pipeline/stages/observe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <variant>

#include "base/hash.h"
#include "pipeline/commands/command.h"
#include "pipeline/commands/state.h"
#include "pipeline/journal/continued.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/journal/manual.h"
#include "pipeline/stages/detect_pings.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/measure_schools.h"
#include "pipeline/stages/observe_memory.h"
#include "pipeline/stages/placed_events.h"
#include "pipeline/stages/refused_echoes.h"
#include "pipeline/survey/beam_figures.h"
#include "pipeline/tasks/join_tracks.h"
#include "school/detect/detect_params.h"
#include "school/track/steady_masks.h"
#include "school/track/track.h"

namespace sonar {
namespace {

PingReach selected(const ObservationFiles& observation, const ObserveOptions& options) {
  const auto last = static_cast<std::int64_t>(observation.pings.size()) - 1;
  if (!options.pings) return {0, last};
  return {std::max<std::int64_t>(0, options.pings->first), std::min(last, options.pings->last)};
}

void add_number(Hasher& hasher, double value) { hasher.add(std::as_bytes(std::span(&value, 1))); }

void add_navigation(Hasher& hasher, const PingNavigation& at) {
  add_number(hasher, static_cast<double>(at.time));
  for (const double value :
       {at.transducer.latitude_deg, at.transducer.longitude_deg, at.heading_deg, at.speed_mps, at.course_deg,
        at.distance_nmi, at.pitch_deg, at.roll_deg, at.heave_m, at.transducer_depth_m}) {
    add_number(hasher, value);
  }
}

Tracks tracked(const Engine& engine, std::span<const DetectedPing> pings) {
  const DetectParams& detect = engine.recipe().detect;
  TrackParams params = engine.recipe().track;
  params.confirmation.evidence = evidence_wanted(detect);
  params.left_out = detect.left_out;
  Tracks tracks = track(pings, engine.sector(), engine.grid().channel, params);
  steady_masks(tracks.schools, pings, engine.sector(), detect.tolerance_db);
  return tracks;
}

std::vector<SchoolMasks> masks_of(const Tracks& tracks, std::span<const DetectedPing> pings) {
  std::vector<SchoolMasks> schools;
  for (const SchoolTrack& of_school : tracks.schools) {
    SchoolMasks school;
    school.track_id = of_school.school_id;
    for (const TrackedDetection& in_ping : of_school.pings) {
      const auto ping =
          std::lower_bound(pings.begin(), pings.end(), in_ping.ping_index,
                           [](const DetectedPing& a, std::int64_t wanted) { return a.ping_index < wanted; });
      const Detection& main = ping->detections[static_cast<std::size_t>(in_ping.detections.front())];
      school.pings.push_back(
          {in_ping.ping_index, mask_of(in_ping, *ping), in_ping.threshold_db.value_or(main.threshold_db)});
    }
    schools.push_back(std::move(school));
  }
  return schools;
}

/// A grid that is narrower than any school that is looked for shows none.
void note_narrow_grid(const DetectParams& params, ObservationProduct& product) {
  if (!product.grid || names_judge(params.left_out, "size")) return;
  const int fans = product.grid->grid.fans();
  const int beams = product.grid->grid.beams();
  if (fans >= params.size.min_fans && beams >= params.size.min_beams) return;
  product.diagnostics.push_back(
      {DiagnosticCode::grid_too_small, "", -1, -1,
       fmt::format("fans x beams: {} x {}; schools are detected where there are at least {} x {}", fans, beams,
                   params.size.min_fans, params.size.min_beams)});
}

/// Said once, also where the masks that were kept come from the same pings.
void note_pings_left_out(PingReach reach, ObservationProduct& product) {
  const std::int64_t all = std::ssize(product.pings);
  if (reach.last < reach.first || reach.last - reach.first + 1 == all) return;
  Diagnostic note{DiagnosticCode::pings_left_out, "", -1, -1,
                  fmt::format("pings {} to {} of {} only", reach.first, reach.last, all)};
  const auto same = [&](const Diagnostic& n) { return n.code == note.code && n.text == note.text; };
  if (std::any_of(product.diagnostics.begin(), product.diagnostics.end(), same)) return;
  product.diagnostics.push_back(std::move(note));
}

/// Tables leave empty what was not recorded; tracks could not.
void note_dead_reckoning(const DeadReckoning& reckoned, ObservationProduct& product) {
  if (reckoned.without_position == 0 && reckoned.without_heading == 0) return;
  product.diagnostics.push_back(
      {DiagnosticCode::dead_reckoned, "", -1, -1,
       fmt::format("{} pings without a position and {} without a heading: schools were followed over them by dead "
                   "reckoning",
                   reckoned.without_position, reckoned.without_heading)});
}

void note_schools_without_place(ObservationProduct& product) {
  const auto lost = std::count_if(product.pings.begin(), product.pings.end(),
                                  [](const PingNavigation& ping) { return !ping.has_position(); });
  if (lost == 0 || product.schools.empty()) return;
  product.diagnostics.push_back({DiagnosticCode::no_position, "", -1, -1,
                                 fmt::format("{} pings have no position; their schools have no place", lost)});
}

/// Display names may have shifted since.
void keep_name_of_whole(const std::string& before, const std::string& now, SchoolRow& row) {
  if (row.continues.starts_with(before + "/")) row.continues = now + row.continues.substr(before.size());
}

/// What is known of how the kept masks were made.
void keep_notes_of_masks(const ObservationProduct& before, ObservationProduct& product) {
  for (const Diagnostic& note : before.diagnostics) {
    if (note.code == DiagnosticCode::track_event || note.code == DiagnosticCode::decision_lost ||
        note.code == DiagnosticCode::decision_carried || note.code == DiagnosticCode::propagation_ended ||
        note.code == DiagnosticCode::ended_at_reach || note.code == DiagnosticCode::pings_left_out) {
      product.diagnostics.push_back(note);
    }
  }
  product.history = fmt::format("{}; measured again, masks kept from recipe {}", before.history, before.recipe_hash);
}

Result<void> prepare(Engine& engine, PingReach reach, ObservationProduct& product, Work& work) {
  for (Diagnostic& note : engine.calibration_notes()) product.diagnostics.push_back(std::move(note));
  if (auto done = engine.estimate_background(reach.first, reach.last, work); !done) return done;
  product.background_db.resize(product.pings.size());
  for (std::int64_t i = reach.first; i <= reach.last; ++i) {
    product.background_db[static_cast<std::size_t>(i)] = engine.background_db(i);
  }
  return {};
}

/// Measured, and every ping could be read.
Result<void> measure_all(Engine& engine, std::vector<SchoolMasks> schools, ObservationProduct& product, Work& work,
                         MeasuredPings* before = nullptr) {
  if (auto done = measure_schools(engine, std::move(schools), product, work, before); !done) return done;
  return engine.refusal();
}

/// Under a calibration that a human chose: the product says what it was measured with.
Result<void> prepare_again(Engine& engine, PingReach reach, ObservationProduct& product, Work& work) {
  std::erase_if(product.diagnostics, [](const Diagnostic& note) {
    return note.code == DiagnosticCode::not_calibrated || note.code == DiagnosticCode::calibration_unused ||
           note.code == DiagnosticCode::gain_not_matched || note.code == DiagnosticCode::absorption_computed ||
           note.code == DiagnosticCode::psi_against_widths || note.code == DiagnosticCode::extinction_corrected;
  });
  product.recipe_json = recipe_text(engine.recipe());
  product.recipe_hash = recipe_hash(engine.recipe());
  return prepare(engine, reach, product, work);
}

/// New numbers from 1, or those that the schools had.
void number(std::vector<SchoolMasks>& schools, const Engine& engine, const ObserveOptions& options,
            ObservationProduct& product) {
  schools = numbered(std::move(schools), engine.grid());
  product.next_school_id = static_cast<std::int64_t>(schools.size()) + 1;
  if (options.earlier == nullptr) return;
  const std::vector<TimeNs> times = datagram_times(engine.survey(), engine.observation());
  product.next_school_id = keep_numbers(schools, engine.grid(), times, *options.earlier);
}

/// Whether a line says something about pings of the observation.
bool concerns(const ReadLine& read, const SurveyFiles& survey, const ObservationFiles& observation) {
  if (observation.pings.empty()) return false;
  const TimeNs begin = survey.entry(observation.pings.front()).time;
  const TimeNs end = survey.entry(observation.pings.back()).time;
  const std::vector<TimeSpan> spans = times_of(read);
  return std::any_of(spans.begin(), spans.end(), [&](const TimeSpan& span) {
    if (span.first == span.last) return ping_at(survey, observation, span.first).has_value();
    return span.first <= end && span.last >= begin;
  });
}

/// Pings that a human called bad have no place in any table.
void mark_bad_pings(const ReadJournal& journal, std::span<const TimeNs> times, ObservationProduct& product) {
  const JournalState said = fold_without_masks(journal.lines(), times);
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (is_bad(said, times[i])) product.pings[i].bad = true;
  }
}

}  // namespace

std::string source_of(const ObservationFiles& observation) {
  return fmt::format("{} {}", observation.config.sounder_name, observation.config.version);
}

std::vector<TimeNs> datagram_times(const SurveyFiles& survey, const ObservationFiles& observation) {
  std::vector<TimeNs> times;
  for (const SurveyPing& ping : observation.pings) times.push_back(survey.entry(ping).time);
  return times;
}

std::string observation_key(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe,
                            const ObserveOptions& options) {
  Hasher hasher;
  hasher.add(observation.name);
  hasher.add(options.program_version);
  hasher.add(kStageVersions);
  hasher.add(recipe_hash(recipe));
  for (const InputFile& file : input_files(survey, observation)) {
    hasher.add(file.name);
    hasher.add(file.hash);
    add_number(hasher, static_cast<double>(file.size));
  }
  for (const PingNavigation& at : observation.navigation) add_navigation(hasher, at);
  const PingReach reach = selected(observation, options);
  add_number(hasher, static_cast<double>(reach.first));
  add_number(hasher, static_cast<double>(reach.last));
  for (const ReadLine& read : options.journal.lines()) {
    if (!concerns(read, survey, observation)) continue;
    JournalLine undated = read.line;
    if (undated.command == "propagate") undated.decided = 0;  // no column tells when
    hasher.add(journal_text(undated));
  }
  return to_hex(hasher.value());
}

ObservationProduct observation_head(const ObservationFiles& observation, const CalibrationParams& calibration) {
  ObservationProduct head;
  head.observation = observation.name;
  head.title = fmt::format("Fish schools of {} {}", observation.config.survey_name, observation.name);
  head.pings = observation.navigation;
  if (observation.grid) head.grid = grid_record(observation, calibration);
  return head;
}

ObservationProduct empty_product(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe,
                                 const ObserveOptions& options) {
  ObservationProduct product = observation_head(observation, recipe.calibration);
  product.program_version = options.program_version;
  product.source = source_of(observation);
  product.history = fmt::format("sonar-explorer {}: raw files to schools", options.program_version);
  product.recipe_json = recipe_text(recipe);
  product.recipe_hash = recipe_hash(recipe);
  product.stage_versions = std::string(kStageVersions);
  product.input_hash = observation_key(survey, observation, recipe, options);
  product.input_files = input_files(survey, observation);
  mark_bad_pings(options.journal, datagram_times(survey, observation), product);
  if (observation.continues_cut) {
    // On the clock of the product's own pings.
    product.cut_after = observation.cut_after + (product.pings.front().time - survey.ping_time(observation, 0));
  }
  product.next_school_id = options.earlier != nullptr ? options.earlier->next_school_id : 1;
  product.diagnostics = observation.diagnostics;
  for (const std::uint32_t file : observation.files) {
    const Diagnostics& of_file = survey.files[file].index.diagnostics;
    product.diagnostics.insert(product.diagnostics.end(), of_file.begin(), of_file.end());
  }
  // A product must not change with the folder that the survey happens to lie in.
  for (Diagnostic& note : product.diagnostics) note.file = std::filesystem::path(note.file).filename().string();
  return product;
}

Result<ObservationProduct> observe(const SurveyFiles& survey, const ObservationFiles& observation, const Recipe& recipe,
                                   const ObserveOptions& options, Work& work) {
  ObservationProduct product = empty_product(survey, observation, recipe, options);
  const PingReach reach = selected(observation, options);
  note_pings_left_out(reach, product);
  const bool automatic =
      recipe.automatic || asks_for_detection(options.journal.lines(), datagram_times(survey, observation));
  if (automatic) note_narrow_grid(recipe.detect, product);
  if (!observation.grid || reach.last < reach.first) return product;
  ObserveMemory* memory = options.memory;
  Engine engine(survey, observation, recipe, memory != nullptr ? &memory->pings : nullptr);
  note_dead_reckoning(engine.reckoned(), product);
  if (auto done = prepare(engine, reach, product, work); !done) return pass_on(done);
  JournalState state;
  std::vector<PlacedEvent> events;
  if (automatic) {
    const std::vector<DetectedPing> detected = detect_pings(engine, reach, product, work);
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    if (auto refused = engine.refusal(); !refused) return pass_on(refused);
    const Tracks tracks = tracked(engine, detected);
    product.rejected = refused_echoes(engine, detected, tracks);
    std::vector<SchoolMasks> found = numbered(masks_of(tracks, detected), engine.grid());
    events = placed_events(tracks.events, found);
    state = state_of_detected(std::move(found));
  }
  CommandContext context = context_of(engine, reach);
  context.earlier = options.earlier;
  state = fold(options.journal.lines(), std::move(state), context);
  product.diagnostics.insert(product.diagnostics.end(), state.notes.begin(), state.notes.end());
  product.rejected = still_refused(std::move(product.rejected), state, engine.grid());
  std::vector<SchoolMasks> schools = measured_masks_of(state, datagram_times(survey, observation));
  number(schools, engine, options, product);
  name_parts(schools, product.observation);
  const Diagnostics noted = event_notes(events_now(events, schools));
  product.diagnostics.insert(product.diagnostics.end(), noted.begin(), noted.end());
  if (state.calibration) {
    const Recipe measuring = measuring_recipe(recipe, state);
    Engine calibrated(survey, observation, measuring);
    if (auto done = prepare_again(calibrated, reach, product, work); !done) return pass_on(done);
    if (auto done = measure_all(calibrated, std::move(schools), product, work); !done) return pass_on(done);
  } else if (auto done = measure_all(engine, std::move(schools), product, work, memory ? &memory->rows : nullptr);
             !done) {
    return pass_on(done);
  }
  if (memory != nullptr) memory->pings.forget_others();
  join_at_reach(product, recipe.merge);
  note_schools_without_place(product);
  return product;
}

Result<ObservationProduct> remeasure(const SurveyFiles& survey, const ObservationFiles& observation,
                                     const ObservationProduct& before, const Recipe& given,
                                     const ObserveOptions& options, Work& work) {
  // The calibration that a session chose stands over the recipe's.
  const std::vector<TimeNs> times = datagram_times(survey, observation);
  const Recipe recipe = measuring_recipe(given, fold_without_masks(options.journal.lines(), times));
  ObservationProduct product = empty_product(survey, observation, recipe, options);
  const bool same_pings =
      has_pings(before, product.source, times) && before.grid.has_value() == product.grid.has_value();
  if (!same_pings) {
    return fail(ErrorCode::mismatch,
                fmt::format("{}: the pings are not those of the product: run again", product.observation));
  }
  keep_notes_of_masks(before, product);
  product.rejected = before.rejected;
  product.next_school_id = next_school_id(before);
  if (!observation.grid) return product;
  Engine engine(survey, observation, recipe);
  const PingReach reach = selected(observation, options);
  note_pings_left_out(reach, product);
  if (auto done = prepare(engine, reach, product, work); !done) return pass_on(done);
  std::vector<SchoolMasks> schools;
  for (const SchoolRow& row : before.schools) {
    SchoolMasks school;
    school.decided = row;
    keep_name_of_whole(before.observation, product.observation, school.decided);
    for (const SchoolMask& mask : before.masks) {
      if (mask.school_id != row.school_id) continue;
      const auto old = std::find_if(before.school_pings.begin(), before.school_pings.end(), [&](const auto& r) {
        return r.school_id == row.school_id && r.ping_index == mask.ping_index;
      });
      school.pings.push_back(
          {mask.ping_index, mask.mask, old == before.school_pings.end() ? kUnknown : old->threshold_db});
    }
    schools.push_back(std::move(school));
  }
  if (auto done = measure_all(engine, std::move(schools), product, work); !done) return pass_on(done);
  note_schools_without_place(product);
  return product;
}

}  // namespace sonar
