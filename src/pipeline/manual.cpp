// SPDX-License-Identifier: Apache-2.0
#include "pipeline/manual.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <utility>

#include "pipeline/json_parameters.h"
#include "pipeline/transfer_function_json.h"
#include "school/propagate_tracked.h"

namespace sonar {
namespace {

constexpr std::int64_t kMaxReach = 1'000'000;

template <class P>
nlohmann::json described(P parameters) {
  JsonWriter writer;
  describe(writer, parameters);
  return writer.json();
}

template <class P>
std::string read_described(const nlohmann::json& args, const char* member, P& parameters) {
  const auto found = args.find(member);
  if (found == args.end()) return {};
  JsonReader reader(*found, std::string(member) + ".");
  describe(reader, parameters);
  reader.finish();
  if (!reader.problem().empty()) return reader.problem();
  const auto valid = validate(parameters);
  return valid ? std::string{} : valid.error().text;
}

Result<std::vector<SeedKey>> seeds_from_json(const nlohmann::json& args) {
  const auto list = args.find("seeds");
  if (list == args.end() || !list->is_array() || list->empty()) {
    return fail(ErrorCode::format, "seeds: expected an array of voxels");
  }
  std::vector<SeedKey> seeds;
  for (const auto& seed : *list) {
    if (!seed.is_object() || !seed.contains("channel") || !seed["channel"].is_number_integer() ||
        !seed.contains("sample") || !seed["sample"].is_number_integer()) {
      return fail(ErrorCode::format, fmt::format("seeds[{}]: expected channel and sample", seeds.size()));
    }
    seeds.push_back({seed["channel"].get<int>(), seed["sample"].get<int>()});
  }
  return seeds;
}

Result<PingMask> grow_seeds(const Engine& engine, const FilteredPing& ping, const PropagateCommand& command) {
  const std::vector<int> rows = engine.grid().row_of_channel();
  PingMask selection;
  for (const SeedKey& seed : command.seeds) {
    if (seed.channel < 0 || static_cast<std::size_t>(seed.channel) >= rows.size() ||
        rows[static_cast<std::size_t>(seed.channel)] < 0) {
      return fail(ErrorCode::bad_parameter, fmt::format("there is no channel {}", seed.channel));
    }
    auto grown = grow_from_click(ping.volume->counts.view(), ping.volume->flags.view(),
                                 {rows[static_cast<std::size_t>(seed.channel)], seed.sample}, command.growth_curve,
                                 command.grow);
    if (!grown) return grown;
    selection = unite(selection, *grown);
  }
  return subtract(selection, ping.taken);
}

PingReach reach_round(std::int64_t ping_index, std::int64_t reach, PingReach limits) {
  if (reach < 0) return limits;
  return {std::max(limits.first, ping_index - reach), std::min(limits.last, ping_index + reach)};
}

SchoolMasks school_of(Propagation& propagation) {
  SchoolMasks school;
  school.decided.origin = "manual";
  for (PropagatedPing& ping : propagation.pings) {
    if (!ping.mask.empty()) school.pings.push_back({ping.ping_index, std::move(ping.mask), ping.threshold_db});
  }
  return school;
}

Result<ManualSchool> replay_line(Engine& engine, const JournalLine& line, std::int64_t ping_index,
                                 std::span<const SchoolMasks> taken, PingReach limits) {
  const auto command = propagate_from_json(line.args);
  if (!command) return pass_on(command);
  auto made = propagate(engine, ping_index, *command, taken, limits);
  if (!made) return made;
  made->school.decided.operator_name = line.operator_name;
  return made;
}

}  // namespace

nlohmann::json to_json(const PropagateCommand& command) {
  nlohmann::json seeds = nlohmann::json::array();
  for (const SeedKey& seed : command.seeds) seeds.push_back({{"channel", seed.channel}, {"sample", seed.sample}});
  return {{"mode", kGrowModeNames[static_cast<std::size_t>(command.mode)]},
          {"grow", described(command.grow)},
          {"seeds", std::move(seeds)},
          {"growth_curve", to_json(command.growth_curve)},
          {"propagate_paper", described(command.paper)},
          {"propagate_tracked", described(command.tracked)},
          {"reach", command.reach}};
}

Result<PropagateCommand> propagate_from_json(const nlohmann::json& args) {
  PropagateCommand command;
  auto seeds = seeds_from_json(args);
  if (!seeds) return pass_on(seeds);
  command.seeds = std::move(*seeds);
  std::string problem = read_described(args, "grow", command.grow);
  if (const auto mode = args.find("mode"); mode != args.end()) {
    if (*mode != "tracked" && *mode != "paper") return fail(ErrorCode::format, "mode: expected tracked or paper");
    command.mode = *mode == "paper" ? GrowMode::paper : GrowMode::tracked;
  }
  if (problem.empty()) problem = read_described(args, "propagate_paper", command.paper);
  if (problem.empty()) problem = read_described(args, "propagate_tracked", command.tracked);
  if (!problem.empty()) return fail(ErrorCode::bad_parameter, problem);
  if (const auto curve = args.find("growth_curve"); curve != args.end()) {
    auto made = transfer_function_from_json(*curve);
    if (!made) return pass_on(made);
    command.growth_curve = std::move(*made);
  }
  if (const auto reach = args.find("reach"); reach != args.end()) {
    if (!reach->is_number_integer()) return fail(ErrorCode::format, "reach: expected a whole number");
    command.reach = std::clamp<std::int64_t>(reach->get<std::int64_t>(), -1, kMaxReach);
  }
  return command;
}

Result<ManualSchool> propagate(Engine& engine, std::int64_t ping_index, const PropagateCommand& command,
                               std::span<const SchoolMasks> taken, PingReach limits) {
  const PingProvider provider = [&](std::int64_t i) {
    auto ping = engine.filtered(i);
    if (ping) ping->taken = voxels_in_ping(taken, i);
    return ping;
  };
  const auto clicked = provider(ping_index);
  if (!clicked) return pass_on(clicked);
  const auto selection = grow_seeds(engine, *clicked, command);
  if (!selection) return fail(selection.error().code, selection.error().text, {"", -1, ping_index});
  const PingReach reach = reach_round(ping_index, command.reach, limits);
  auto propagation = command.mode == GrowMode::paper
                         ? propagate_paper(provider, ping_index, *selection, reach, command.growth_curve, command.paper)
                         : propagate_tracked(provider, engine.sector(), ping_index, *selection, reach, command.tracked);
  if (!propagation) return pass_on(propagation);
  ManualSchool made;
  made.school = school_of(*propagation);
  made.note_backward = propagation->note_backward;
  made.note_forward = propagation->note_forward;
  return made;
}

std::vector<SchoolMasks> replay(Engine& engine, std::span<const JournalLine> lines, PingReach limits,
                                Diagnostics& diagnostics) {
  std::vector<SchoolMasks> schools;
  for (const JournalLine& line : lines) {
    const auto ping_index = ping_at(engine.survey(), engine.observation(), line.ping_time);
    if (!ping_index || *ping_index < limits.first || *ping_index > limits.last) continue;
    const auto lost = [&](const std::string& why) {
      diagnostics.push_back({DiagnosticCode::decision_lost, "", -1, *ping_index,
                             fmt::format("journal line {} ({}): {}", line.n, line.command, why)});
    };
    if (line.command != "propagate") {
      lost("this version does not know the command");
      continue;
    }
    auto made = replay_line(engine, line, *ping_index, schools, limits);
    if (!made) {
      lost(made.error().text);
      continue;
    }
    for (const auto& [side, note] : {std::pair("backwards", made->note_backward), {"forwards", made->note_forward}}) {
      if (note.empty()) continue;
      diagnostics.push_back(
          {DiagnosticCode::propagation_ended, "", -1, *ping_index, fmt::format("{}: {}", side, note)});
    }
    schools.push_back(std::move(made->school));
  }
  return schools;
}

PingMask voxels_in_ping(std::span<const SchoolMasks> schools, std::int64_t ping_index) {
  PingMask voxels;
  for (const SchoolMasks& school : schools) {
    const auto found =
        std::lower_bound(school.pings.begin(), school.pings.end(), ping_index,
                         [](const SchoolMasks::InPing& a, std::int64_t wanted) { return a.ping_index < wanted; });
    if (found != school.pings.end() && found->ping_index == ping_index) voxels = unite(voxels, found->mask);
  }
  return voxels;
}

std::optional<std::int64_t> ping_at(const SurveyFiles& survey, const ObservationFiles& observation, TimeNs time) {
  const auto found =
      std::lower_bound(observation.pings.begin(), observation.pings.end(), time,
                       [&](const SurveyPing& ping, TimeNs wanted) { return survey.entry(ping).time < wanted; });
  if (found == observation.pings.end() || survey.entry(*found).time != time) return std::nullopt;
  return found - observation.pings.begin();
}

}  // namespace sonar
