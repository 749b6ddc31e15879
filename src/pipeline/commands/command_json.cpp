// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "pipeline/commands/command.h"
#include "pipeline/commands/json_members.h"
#include "pipeline/recipe/json_file.h"
#include "pipeline/recipe/transfer_function_json.h"
#include "pipeline/survey/calibration_json.h"

namespace sonar {
namespace {

using nlohmann::json;
using namespace members;  // NOLINT(google-build-using-namespace): the readers of this room's commands

template <class... Visitors>
struct Overload : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overload(Visitors...) -> Overload<Visitors...>;

json with_school(json args, const std::optional<SchoolKey>& school) {
  if (school) args["school"] = from_school(*school);
  return args;
}

json from_decision(const Decision& decision) {
  json args = {{"school", from_school(decision.school)}};
  if (decision.status) args["status"] = *decision.status;
  if (decision.species) args["species"] = *decision.species;
  if (decision.comment) args["comment"] = *decision.comment;
  if (decision.name) args["name"] = *decision.name;
  return args;
}

Result<Decision> read_decision(const json& args, const std::string& place, TimeNs ping_time) {
  const auto named = [&](const Error& error) { return fail(error.code, place + error.text); };
  if (!args.is_object()) return fail(ErrorCode::format, place + "expected an object");
  const auto school = read_school(args, ping_time);
  if (!school) return named(school.error());
  Decision decision{*school, {}, {}, {}};
  if (args.contains("status")) {
    const auto status = read_choice(args, "status", kStatusNames);
    if (!status) return named(status.error());
    decision.status = std::string(kStatusNames[*status]);
  }
  for (const auto& [member, text] :
       {std::pair("species", &decision.species), {"comment", &decision.comment}, {"name", &decision.name}}) {
    if (!args.contains(member)) continue;
    auto read = read_text(args, member);
    if (!read) return named(read.error());
    *text = std::move(*read);
  }
  if (!decision.status && !decision.species && !decision.comment && !decision.name) {
    return fail(ErrorCode::format, place + "expected status, species, comment or name");
  }
  return decision;
}

Result<Command> read_grow(const json& args, TimeNs ping_time) {
  GrowCommand command;
  const auto to = read_choice(args, "to", kGrowToNames);
  if (!to) return pass_on(to);
  command.to = static_cast<GrowTo>(*to);
  auto grow = read_described<GrowParams>(args, "grow");
  auto curve = read_growth_curve(args);
  auto seeds = read_seeds(args);
  const auto school = read_optional_school(args, ping_time);
  if (!grow) return pass_on(grow);
  if (!curve) return pass_on(curve);
  if (!seeds) return pass_on(seeds);
  if (!school) return pass_on(school);
  if ((command.to == GrowTo::school) == school->has_value()) {
    return fail(ErrorCode::format, "school: expected with add, take_away and replace, and only there");
  }
  command.grow = *grow;
  command.growth_curve = std::move(*curve);
  command.seeds = std::move(*seeds);
  command.school = *school;
  return command;
}

template <class C>
Result<Command> read_strokes(const json& args, TimeNs ping_time) {
  auto runs = read_runs(args);
  if (!runs) return pass_on(runs);
  const auto school = read_optional_school(args, ping_time);
  if (!school) return pass_on(school);
  return C{std::move(*runs), *school};
}

Result<Command> read_reshape(Reshaping what, const json& args, TimeNs ping_time) {
  const auto school = read_school(args, ping_time);
  if (!school) return pass_on(school);
  ReshapeCommand command{what, *school, false};
  if (const auto all = args.find("all_pings"); all != args.end()) {
    if (!all->is_boolean()) return fail(ErrorCode::format, "all_pings: expected true or false");
    command.all_pings = all->get<bool>();
  }
  return command;
}

Result<Command> read_merge(const json& args, TimeNs ping_time) {
  const auto list = args.find("schools");
  if (list == args.end() || !list->is_array() || list->size() < 2) {
    return fail(ErrorCode::format, "schools: expected an array of two or more voxels");
  }
  MergeCommand command;
  for (const json& school : *list) {
    const auto key = read_school(school, fmt::format("schools[{}]", command.schools.size()), ping_time);
    if (!key) return pass_on(key);
    command.schools.push_back(*key);
  }
  return command;
}

Result<Command> read_split(const json& args, TimeNs ping_time) {
  const auto school = read_school(args, ping_time);
  if (!school) return pass_on(school);
  SplitCommand command{*school, {}};
  if (const auto seed = args.find("seed"); seed != args.end()) {
    const auto read = read_seed(*seed, "seed");
    if (!read) return pass_on(read);
    command.seed = *read;
  }
  return command;
}

Result<Command> read_decide(std::string_view name, const json& args, TimeNs ping_time) {
  DecideCommand command;
  if (name != "bulk_decide") {
    auto decision = read_decision(args, "", ping_time);
    if (!decision) return pass_on(decision);
    command.decisions.push_back(std::move(*decision));
    return command;
  }
  auto rule = read_text(args, "rule");
  if (!rule) return pass_on(rule);
  command.rule = std::move(*rule);
  const auto list = args.find("decisions");
  if (list == args.end() || !list->is_array()) return fail(ErrorCode::format, "decisions: expected an array");
  for (const json& one : *list) {
    auto decision = read_decision(one, fmt::format("decisions[{}]: ", command.decisions.size()), ping_time);
    if (!decision) return pass_on(decision);
    command.decisions.push_back(std::move(*decision));
  }
  return command;
}

Result<EventCommand> read_event(const json& args) {
  const auto kind = read_choice(args, "kind", kEventKindNames);
  if (!kind) return pass_on(kind);
  const auto time = read_time(args, "time");
  if (!time) return pass_on(time);
  auto text = read_text(args, "text");
  if (!text) return pass_on(text);
  EventCommand event{std::string(kEventKindNames[*kind]), *time, std::move(*text)};
  if (const auto view = args.find("view"); view != args.end()) {
    if (!view->is_object()) return fail(ErrorCode::format, "view: expected an object");
    event.view = view->dump();
  }
  return event;
}

Result<Command> read_detect(const json& args) {
  constexpr std::int64_t kMostSchools = 1'000'000'000;
  const auto found = args.find("schools");
  if (found == args.end()) return DetectCommand{};
  const auto schools = whole_number(*found);
  if (!schools || *schools < 0 || *schools > kMostSchools) {
    return fail(ErrorCode::format, fmt::format("schools: expected a whole number from 0 to {}", kMostSchools));
  }
  return DetectCommand{*schools};
}

template <class C>
Result<Command> read_interval(std::string_view name, const json& args, TimeNs ping_time) {
  if (name == "bad_ping" && !args.contains("first")) return C{ping_time, ping_time};
  const auto first = read_time(args, "first");
  if (!first) return pass_on(first);
  const auto last = read_time(args, "last");
  if (!last) return pass_on(last);
  if (*last < *first) return fail(ErrorCode::format, "last: lies before first");
  return C{*first, *last};
}

json from_event(const EventCommand& event) {
  json args{{"kind", event.kind}, {"time", event.time}, {"text", event.text}};
  if (!event.view.empty()) args["view"] = json::parse(event.view);
  return args;
}

std::string decide_name(const DecideCommand& command) {
  if (command.decisions.size() != 1 || !command.rule.empty()) return "bulk_decide";
  const Decision& one = command.decisions.front();
  if (one.status) return "decide";
  if (one.species && !one.comment && !one.name) return "species";
  if (one.comment && !one.species && !one.name) return "comment";
  if (one.name && !one.species && !one.comment) return "rename";
  return "decide";
}

}  // namespace

std::string command_name(const Command& command) {
  const Overload names{
      [](const PropagateCommand&) { return std::string("propagate"); },
      [](const GrowCommand&) { return std::string("grow"); },
      [](const BrushCommand&) { return std::string("brush"); },
      [](const EraseCommand&) { return std::string("erase"); },
      [](const ReshapeCommand& c) { return std::string(kReshapingNames[static_cast<std::size_t>(c.what)]); },
      [](const MergeCommand&) { return std::string("merge"); },
      [](const SplitCommand&) { return std::string("split"); },
      [](const DeleteCommand&) { return std::string("delete"); },
      [](const DecideCommand& c) { return decide_name(c); },
      [](const EventCommand&) { return std::string("event"); },
      [](const BadPingsCommand& c) { return std::string(c.first == c.last ? "bad_ping" : "bad_interval"); },
      [](const RemoveEventCommand&) { return std::string("remove_event"); },
      [](const GoodPingsCommand&) { return std::string("good_interval"); },
      [](const CalibrateCommand&) { return std::string("calibrate"); },
      [](const DetectCommand&) { return std::string("detect"); }};
  return std::visit(names, command);
}

bool is_decision(std::string_view name) {
  return name == "decide" || name == "species" || name == "comment" || name == "rename" || name == "bulk_decide";
}

nlohmann::json to_json(const Command& command) {
  const Overload args{[](const PropagateCommand& c) { return to_json(c); },
                      [](const GrowCommand& c) {
                        return with_school({{"to", kGrowToNames[static_cast<std::size_t>(c.to)]},
                                            {"grow", described(c.grow)},
                                            {"growth_curve", to_json(c.growth_curve)},
                                            {"seeds", from_seeds(c.seeds)}},
                                           c.school);
                      },
                      [](const BrushCommand& c) {
                        return with_school({{"runs", from_runs(c.runs)}}, c.school);
                      },
                      [](const EraseCommand& c) {
                        return with_school({{"runs", from_runs(c.runs)}}, c.school);
                      },
                      [](const ReshapeCommand& c) {
                        return json{{"school", from_school(c.school)}, {"all_pings", c.all_pings}};
                      },
                      [](const MergeCommand& c) {
                        json list = json::array();
                        for (const SchoolKey& school : c.schools) list.push_back(from_school(school));
                        return json{{"schools", std::move(list)}};
                      },
                      [](const SplitCommand& c) {
                        json made = {{"school", from_school(c.school)}};
                        if (c.seed) made["seed"] = from_seed(*c.seed);
                        return made;
                      },
                      [](const DeleteCommand& c) {
                        return json{{"school", from_school(c.school)}};
                      },
                      [](const DecideCommand& c) {
                        if (decide_name(c) != "bulk_decide") return from_decision(c.decisions.front());
                        json list = json::array();
                        for (const Decision& decision : c.decisions) list.push_back(from_decision(decision));
                        return json{{"rule", c.rule}, {"decisions", std::move(list)}};
                      },
                      [](const EventCommand& c) { return from_event(c); },
                      [](const BadPingsCommand& c) {
                        return json{{"first", c.first}, {"last", c.last}};
                      },
                      [](const RemoveEventCommand& c) { return from_event(c.event); },
                      [](const GoodPingsCommand& c) {
                        return json{{"first", c.first}, {"last", c.last}};
                      },
                      [](const CalibrateCommand& c) {
                        json made = to_json(c.calibration);
                        made["file"] = c.file;
                        return made;
                      },
                      [](const DetectCommand& c) {
                        return c.schools > 0 ? json{{"schools", c.schools}} : json::object();
                      }};
  return std::visit(args, command);
}

Result<Command> command_from_json(std::string_view name, const nlohmann::json& args, TimeNs ping_time) {
  if (!args.is_object()) return fail(ErrorCode::format, "args: expected an object");
  if (name == "propagate") {
    auto command = propagate_from_json(args, ping_time);
    if (!command) return pass_on(command);
    return std::move(*command);
  }
  if (name == "grow") return read_grow(args, ping_time);
  if (name == "brush") return read_strokes<BrushCommand>(args, ping_time);
  if (name == "erase") return read_strokes<EraseCommand>(args, ping_time);
  for (std::size_t i = 0; i < kReshapingNames.size(); ++i) {
    if (name == kReshapingNames[i]) return read_reshape(static_cast<Reshaping>(i), args, ping_time);
  }
  if (name == "merge") return read_merge(args, ping_time);
  if (name == "split") return read_split(args, ping_time);
  if (name == "delete") {
    const auto school = read_school(args, ping_time);
    if (!school) return pass_on(school);
    return DeleteCommand{*school};
  }
  if (is_decision(name)) return read_decide(name, args, ping_time);
  if (name == "event" || name == "remove_event") {
    auto event = read_event(args);
    if (!event) return pass_on(event);
    if (name == "remove_event") return RemoveEventCommand{std::move(*event)};
    return std::move(*event);
  }
  if (name == "bad_ping" || name == "bad_interval") return read_interval<BadPingsCommand>(name, args, ping_time);
  if (name == "good_interval") return read_interval<GoodPingsCommand>(name, args, ping_time);
  if (name == "calibrate") {
    auto calibration = calibration_from_json(args);
    if (!calibration) return pass_on(calibration);
    auto file = read_text(args, "file");
    if (!file) return pass_on(file);
    return CalibrateCommand{std::move(*calibration), std::move(*file)};
  }
  if (name == "detect") return read_detect(args);
  return fail(ErrorCode::unsupported, "this version does not know the command");
}

JournalLine line_of(const JournalAct& act) {
  return {act.n, act.decided, act.operator_name, command_name(act.command), act.ping_time, to_json(act.command)};
}

Result<JournalAct> act_of(const JournalLine& line) {
  auto command = command_from_json(line.command, line.args, line.ping_time);
  if (!command) return pass_on(command);
  return JournalAct{line.n, line.decided, line.operator_name, line.ping_time, std::move(*command)};
}

std::vector<TimeSpan> times_of(const JournalLine& line) {
  std::vector<TimeSpan> times{{line.ping_time, line.ping_time}};
  if (line.command == "propagate") return times;
  const auto act = act_of(line);
  if (!act) return times;
  if (const auto* bad = std::get_if<BadPingsCommand>(&act->command)) times.push_back({bad->first, bad->last});
  if (const auto* good = std::get_if<GoodPingsCommand>(&act->command)) times.push_back({good->first, good->last});
  if (std::holds_alternative<CalibrateCommand>(act->command)) {
    times.push_back({std::numeric_limits<TimeNs>::min(), std::numeric_limits<TimeNs>::max()});  // of the whole survey
  }
  if (const auto* decide = std::get_if<DecideCommand>(&act->command)) {
    for (const Decision& decision : decide->decisions) {
      times.push_back({decision.school.ping_time, decision.school.ping_time});
    }
  }
  return times;
}

bool asks_for_detection(std::span<const JournalLine> lines, std::span<const TimeNs> times) {
  return std::any_of(lines.begin(), lines.end(), [&](const JournalLine& line) {
    return line.command == "detect" && std::binary_search(times.begin(), times.end(), line.ping_time);
  });
}

}  // namespace sonar
