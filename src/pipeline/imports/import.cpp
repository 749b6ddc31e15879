// SPDX-License-Identifier: Apache-2.0
#include "pipeline/imports/import.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/number_text.h"
#include "io/atomic_file.h"
#include "io/recordings.h"
#include "pipeline/commands/state.h"
#include "pipeline/imports/import_echoview.h"
#include "pipeline/imports/import_lsss.h"
#include "pipeline/stages/engine.h"

namespace sonar {
namespace {

constexpr std::uint64_t kMostBytes = 256U << 20U;

constexpr std::array kFormats{
    ImportFormat{".evr", "regions of Echoview", import_evr},
    ImportFormat{".work", "school masks of LSSS", import_lsss},
};

/// A journal that grows.
class Lines {
 public:
  Lines(Journal& journal, const ImportedBy& by) : journal_(journal), by_(by) {}
  [[nodiscard]] std::int64_t next() const { return std::ssize(journal_.lines) + 1; }
  void add(TimeNs time, Command command) {
    journal_.lines.push_back(line_of({next(), by_.decided, by_.operator_name, time, std::move(command)}));
  }
  void add(std::vector<JournalLine> lines) {
    for (JournalLine& line : lines) journal_.lines.push_back(std::move(line));
  }

 private:
  Journal& journal_;
  const ImportedBy& by_;
};

std::optional<Decision> decision_of(const ImportedSchool& school, const SchoolKey& key) {
  Decision decision;
  decision.school = key;
  if (!school.species.empty()) decision.species = school.species;
  if (!school.comment.empty()) decision.comment = school.comment;
  if (!school.name.empty()) decision.name = school.name;
  if (!decision.species && !decision.comment && !decision.name) return std::nullopt;
  return decision;
}

Journal head_of(const SurveyFiles& survey, Recipe recipe, const Imported& imported) {
  // Schools that files hold are all that there are, as in a window's journal. Where files hold none, they are looked for.
  if (!imported.schools.empty()) recipe.automatic = false;
  Journal head;
  head.recipe_hash = recipe_hash(recipe);
  head.recipe = recipe_text(recipe);
  for (const ObservationFiles& observation : survey.observations) {
    for (InputFile& file : input_files(survey, observation)) head.files.push_back(std::move(file));
  }
  return head;
}

/// The schools of one observation, whose pings are read once each.
Result<void> add_schools(Engine& engine, std::span<const ImportedSchool* const> schools, const ImportedBy& by,
                         ImportedJournal& made, Work& work) {
  std::int64_t first = engine.pings();
  std::int64_t last = -1;
  for (const ImportedSchool* school : schools) {
    if (school->pings.empty()) continue;
    first = std::min(first, school->pings.begin()->first);
    last = std::max(last, school->pings.rbegin()->first);
  }
  if (first > last) return {};
  if (auto done = engine.estimate_background(first, last, work); !done) return done;
  const CommandContext context = context_of(engine, {0, engine.pings() - 1});
  Lines lines(made.journal, by);
  for (std::size_t i = 0; i < schools.size(); ++i) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    auto of_school = school_lines(*schools[i], context, by, lines.next());
    if (!of_school) return pass_on(of_school);
    if (of_school->pings_left_out > 0) {
      made.left_out.push_back(fmt::format(
          "{}: {}: {} without a voxel that can belong to a school", engine.observation().name,
          schools[i]->name.empty() ? "a school" : schools[i]->name, count_of(of_school->pings_left_out, "ping")));
    }
    if (!of_school->lines.empty()) ++made.schools;
    made.voxels += of_school->voxels;
    lines.add(std::move(of_school->lines));
    work.progress("schools", static_cast<std::int64_t>(i) + 1, std::ssize(schools));
  }
  return engine.refusal();
}

}  // namespace

Result<ImportPlace> import_place(const SurveyFiles& survey, const std::string& observation) {
  ImportPlace place;
  place.survey = &survey;
  std::optional<Sounder> sounder;
  for (std::size_t i = 0; i < survey.observations.size(); ++i) {
    const ObservationFiles& one = survey.observations[i];
    if (!observation.empty() && one.name != observation) continue;
    if (!one.grid || one.pings.empty()) {
      if (observation.empty()) continue;
      return fail(ErrorCode::usage, observation + " has no grid of fans and beams to select in");
    }
    if (!sounder) sounder = sounder_of(one.config);
    if (sounder == sounder_of(one.config)) place.observations.push_back(i);
  }
  if (!place.observations.empty()) return place;
  if (!observation.empty()) return fail(ErrorCode::usage, "no observation " + observation + " in the survey");
  return fail(ErrorCode::usage, "the survey has no observation with a grid of fans and beams to select in");
}

ImportedSchool& Imported::school(const std::string& key, std::size_t observation) {
  const auto found = key.empty() ? keyed.end() : keyed.find({key, observation});
  if (found != keyed.end()) return schools[found->second];
  if (!key.empty()) keyed[{key, observation}] = schools.size();
  schools.emplace_back().observation = observation;
  return schools.back();
}

std::span<const ImportFormat> import_formats() { return kFormats; }

Result<void> import_file(const std::filesystem::path& file, const ImportPlace& place, Imported& imported,
                         const Work& work) {
  const auto format =
      std::ranges::find_if(kFormats, [&](const ImportFormat& one) { return has_ending(file, one.ending); });
  if (format == kFormats.end()) {
    std::string endings;
    for (const ImportFormat& one : kFormats) {
      endings += fmt::format("{}{} ({})", endings.empty() ? "" : ", ", one.ending, one.text);
    }
    return fail(ErrorCode::usage, "expected a name that ends in " + endings, {file.string()});
  }
  const auto text = read_file(file, kMostBytes);
  if (!text) return pass_on(text);
  return format->read(*text, file.string(), place, imported, work);
}

Result<SchoolLines> school_lines(const ImportedSchool& school, const CommandContext& context, const ImportedBy& by,
                                 std::int64_t n) {
  SchoolLines made;
  JournalState state;
  std::optional<SchoolKey> key;
  const auto take = [&](const JournalAct& act) {
    made.lines.push_back(line_of(act));
    made.lines.back().step = n;
  };
  for (const auto& [ping, runs] : school.pings) {
    const JournalAct act{n + std::ssize(made.lines), by.decided, by.operator_name,
                         context.times[static_cast<std::size_t>(ping)], BrushCommand{runs, key}};
    auto next = apply(act, state, context);
    if (!next && is_of_system(next.error().code)) return pass_on(next);
    if (!next) {
      ++made.pings_left_out;
      continue;
    }
    state = std::move(*next);
    if (!key) key = key_of(state.schools.front()->masks, context);
    take(act);
  }
  if (!key) return made;
  for (const SchoolMasks::InPing& there : state.schools.front()->masks.pings) {
    ++made.pings;
    made.voxels += there.mask.voxels();
  }
  if (auto decision = decision_of(school, *key)) {
    take({n + std::ssize(made.lines), by.decided, by.operator_name, key->ping_time, DecideCommand{{*decision}, ""}});
  }
  return made;
}

Result<ImportedJournal> import_journal(const SurveyFiles& survey, const Recipe& recipe, const Imported& imported,
                                       const ImportedBy& by, Work& work) {
  ImportedJournal made;
  made.journal = head_of(survey, recipe, imported);
  made.left_out = imported.left_out;
  std::map<std::size_t, std::vector<const ImportedSchool*>> of_observation;
  for (const ImportedSchool& school : imported.schools) of_observation[school.observation].push_back(&school);
  for (const auto& [index, schools] : of_observation) {
    Engine engine(survey, survey.observations[index], recipe);
    if (auto added = add_schools(engine, schools, by, made, work); !added) return pass_on(added);
  }
  Lines lines(made.journal, by);
  for (const EventCommand& event : imported.events) lines.add(event.time, event);
  for (const BadPingsCommand& bad : imported.bad) lines.add(bad.first, bad);
  made.marks = imported.events.size();
  made.bad = imported.bad.size();
  return made;
}

std::string journal_text(const Journal& journal) {
  std::string text = journal_head_text(journal) + "\n";
  for (const JournalLine& line : journal.lines) text += journal_text(line) + "\n";
  return text;
}

}  // namespace sonar
