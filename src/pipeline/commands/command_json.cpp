// SPDX-License-Identifier: Apache-2.0
// Commands as lines of a journal: visitors of describe_commands.h that write and read them.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "pipeline/commands/command.h"
#include "pipeline/commands/describe_commands.h"
#include "pipeline/commands/json_members.h"
#include "pipeline/recipe/json_file.h"
#include "pipeline/survey/calibration_json.h"

namespace sonar {
namespace {

using nlohmann::json;
using Names = std::span<const std::string_view>;

class NameOf : public PassesOver {
 public:
  template <class E>
  void command(Names names, const E& which, About) {
    name_ = names[static_cast<std::size_t>(which)];
  }
  [[nodiscard]] bool called(std::string_view name) const { return name_ == name; }
  [[nodiscard]] std::string_view name() const { return name_; }

 private:
  std::string_view name_;
};

class HasName : public PassesOver {
 public:
  explicit HasName(std::string_view name) : name_(name) {}
  template <class E>
  void command(Names names, const E&, About) {
    found_ = std::ranges::find(names, name_) != names.end();
  }
  [[nodiscard]] bool found() const { return found_; }

 private:
  std::string_view name_;
  bool found_ = false;
};

class ArgsWriter : public NameOf {
 public:
  template <class T>
  void field(const char* name, const T& value) {
    args_[name] = members::json_of(value);
  }
  template <class T>
  void field(const char* name, const std::optional<T>& value) {
    if (value) field(name, *value);
  }
  template <class E>
  void choice(const char* name, const E& value, Names names, bool = false) {
    if constexpr (std::is_enum_v<E>) {
      args_[name] = names[static_cast<std::size_t>(value)];
    } else {
      field(name, value);
    }
  }
  void time(const char* name, const TimeNs& value) { field(name, value); }
  void interval(const TimeNs& first, const TimeNs& last, std::string_view = {}) {
    field("first", first);
    field("last", last);
  }
  void count(const char* name, const std::int64_t& value) {
    if (value > 0) field(name, value);
  }
  template <class T>
  void pings(const char* name, const T& value) {
    field(name, value);
  }
  void object(const char* name, const std::string& text) {
    if (!text.empty()) args_[name] = json::parse(text);
  }
  void inside(const CalibrationParams& calibration) { args_.update(to_json(calibration)); }
  template <class D>
  void list(const char* name, const std::vector<D>& all) {
    json& array = args_[name] = json::array();
    for (const D& one : all) {
      ArgsWriter writer;
      describe(writer, one);
      array.push_back(std::move(writer.args_));
    }
  }
  template <class D>
  void alone(const std::vector<D>& all) {
    describe(*this, all.front());
  }
  [[nodiscard]] json& args() { return args_; }

 private:
  json args_ = json::object();
};

/// Reads nothing of a line that has another name, and nothing after the first problem.
class ArgsReader : public PassesOver {
 public:
  ArgsReader(std::string_view name, const json& args, TimeNs ping_time)
      : name_(name), args_(args), ping_time_(ping_time) {}

  template <class E>
  void command(Names names, [[maybe_unused]] E&& which, About) {
    const auto at = std::ranges::find(names, name_);
    named_ = at != names.end();
    if constexpr (std::is_enum_v<std::remove_reference_t<E>>) {
      if (named_) which = static_cast<std::remove_reference_t<E>>(at - names.begin());
    }
  }
  [[nodiscard]] bool called(std::string_view name) const { return name_ == name; }

  template <class T>
  void field(const char* name, T& value) {
    if (reads()) take(members::read(member(name), value));
  }
  template <class T>
  void field(const char* name, std::optional<T>& value) {
    if (reads() && args_.contains(name)) field(name, value.emplace());
  }
  template <class E>
  void choice(const char* name, E& value, Names names, bool or_default = false) {
    if (!reads() || (or_default && !args_.contains(name))) return;
    const auto index = members::read_choice(member(name), names);
    if (!take(index)) return;
    if constexpr (std::is_enum_v<E>) {
      value = static_cast<E>(*index);
    } else {
      value = std::string(names[*index]);
    }
  }
  template <class E>
  void choice(const char* name, std::optional<E>& value, Names names) {
    if (reads() && args_.contains(name)) choice(name, value.emplace(), names);
  }
  void time(const char* name, TimeNs& value) {
    number(name, value, "a whole number of nanoseconds", std::numeric_limits<TimeNs>::min(),
           std::numeric_limits<TimeNs>::max());
  }
  void interval(TimeNs& first, TimeNs& last, std::string_view or_ping = {}) {
    if (!or_ping.empty() && called(or_ping) && !args_.contains("first")) {
      first = last = ping_time_;
      return;
    }
    time("first", first);
    time("last", last);
    require(first <= last, "last: lies before first");
  }
  void count(const char* name, std::int64_t& value) {
    constexpr std::int64_t kMost = 1'000'000'000;
    if (args_.contains(name)) number(name, value, fmt::format("a whole number from 0 to {}", kMost), 0, kMost);
  }
  void pings(const char* name, std::int64_t& value) {
    constexpr std::int64_t kMost = 1'000'000;
    if (!args_.contains(name)) return;
    number(name, value, "a whole number", std::numeric_limits<std::int64_t>::min(),
           std::numeric_limits<std::int64_t>::max());
    value = std::clamp<std::int64_t>(value, -1, kMost);
  }
  void pings(const char* name, std::optional<std::int64_t>& value) {
    if (reads() && args_.contains(name)) pings(name, value.emplace());
  }
  void object(const char* name, std::string& text) {
    if (!reads() || !args_.contains(name)) return;
    require(args_[name].is_object(), fmt::format("{}: expected an object", name));
    if (reads()) text = args_[name].dump();
  }
  void inside(CalibrationParams& calibration) {
    if (!reads()) return;
    auto read = calibration_from_json(args_);
    if (take(read)) calibration = std::move(*read);
  }
  template <class D>
  void list(const char* name, std::vector<D>& all) {
    const auto found = args_.find(name);
    require(found != args_.end() && found->is_array(), fmt::format("{}: expected an array", name));
    if (!reads()) return;
    for (const json& one : *found) {
      const std::string place = fmt::format("{}[{}]: ", name, all.size());
      ArgsReader reader({}, one, ping_time_);
      reader.named_ = true;
      reader.require(one.is_object(), "expected an object");
      describe(reader, all.emplace_back());
      if (reader.problem_) problem_ = Error{reader.problem_->code, place + reader.problem_->text, {}};
      if (problem_) return;
    }
  }
  template <class D>
  void alone(std::vector<D>& all) {
    if (reads()) describe(*this, all.emplace_back());
  }
  void require(bool sound, const std::string& text) {
    if (reads() && !sound) problem_ = Error{ErrorCode::format, text, {}};
  }

  [[nodiscard]] bool named() const { return named_; }
  [[nodiscard]] const std::optional<Error>& problem() const { return problem_; }

 private:
  [[nodiscard]] bool reads() const { return named_ && !problem_; }
  [[nodiscard]] members::Member member(const char* name) const {
    const auto found = args_.find(name);
    return {found == args_.end() ? nullptr : &*found, name, ping_time_};
  }
  template <class T>
  bool take(const Result<T>& result) {
    if (!result) problem_ = result.error();
    return result.has_value();
  }
  void number(const char* name, std::int64_t& value, const std::string& expected, std::int64_t least,
              std::int64_t most) {
    if (!reads()) return;
    const auto read = members::read_number(member(name), expected, least, most);
    if (take(read)) value = *read;
  }

  std::string_view name_;
  const json& args_;
  TimeNs ping_time_;
  bool named_ = false;
  std::optional<Error> problem_;
};

/// As the first of the commands, from this one on, that has the name.
template <std::size_t I = 0>
Result<Command> read_as(std::string_view name, const json& args, TimeNs ping_time) {
  if constexpr (I == std::variant_size_v<Command>) {
    return fail(ErrorCode::unsupported, "this version does not know the command");
  } else {
    std::variant_alternative_t<I, Command> command;
    ArgsReader reader(name, args, ping_time);
    describe(reader, command);
    if (!reader.named()) return read_as<I + 1>(name, args, ping_time);
    if (reader.problem()) return tl::unexpected<Error>(*reader.problem());
    return Command(std::move(command));
  }
}

}  // namespace

std::string command_name(const Command& command) {
  NameOf name;
  describe_any(name, command);
  return std::string(name.name());
}

bool is_decision(std::string_view name) {
  HasName has(name);
  const DecideCommand any;
  describe(has, any);
  return has.found();
}

nlohmann::json to_json(const Command& command) {
  ArgsWriter writer;
  describe_any(writer, command);
  return std::move(writer.args());
}

Result<Command> command_from_json(std::string_view name, const nlohmann::json& args, TimeNs ping_time) {
  if (!args.is_object()) return fail(ErrorCode::format, "args: expected an object");
  return read_as(name, args, ping_time);
}

JournalLine line_of(const JournalAct& act) {
  return {
      act.n, act.decided, act.operator_name, command_name(act.command), act.ping_time, JsonValue(to_json(act.command))};
}

Result<JournalAct> act_of(const JournalLine& line) {
  auto command = command_from_json(line.command, *line.args, line.ping_time);
  if (!command) return pass_on(command);
  return JournalAct{line.n, line.decided, line.operator_name, line.ping_time, std::move(*command)};
}

ReadLine read_line(const JournalLine& line) { return {line, act_of(line)}; }

ReadJournal::ReadJournal(std::span<const JournalLine> lines) {
  std::vector<ReadLine> read;
  read.reserve(lines.size());
  for (const JournalLine& line : lines) read.push_back(read_line(line));
  lines_ = std::make_shared<const std::vector<ReadLine>>(std::move(read));
}

}  // namespace sonar
