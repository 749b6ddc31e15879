// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/number_text.h"
#include "pipeline/commands/command.h"

namespace sonar {

// Every command struct C has one function, which is all that is said of it:
//   template <class V, Of<C> T>
//   void describe(V& v, T& c) {
//     named(v, "grow", About::ping);             // its name in the journal, and what it is about
//     v.choice("to", c.to, kGrowToNames);         // members of the line's args: of a choice the name,
//     v.field("seeds", c.seeds);                  // of what is in json_members.h that; an empty optional is absent
//     v.require(c.whole(), "why it is not");      // what one member alone does not show
//     v.says_or_made("grow", c.school);           // what it did, for people; also what undo offers to take back
//   }
// Lines, times and sentences are visitors of it; they come in the order of these calls. T is const for all but the reader.

template <class T, class C>
concept Of = std::same_as<std::remove_const_t<T>, C>;

/// Visitor that passes over everything; the others say what they look at.
class PassesOver {
 public:
  /// All names, and which it has: by a member with values 0, 1, ..., or an index that follows from the other members.
  template <class E>
  void command(std::span<const std::string_view> /*names*/, const E& /*which*/, About) {}
  /// Of a line that is read or written: whether it has this name.
  [[nodiscard]] bool called(std::string_view /*name*/) const { return false; }

  template <class T>
  void field(const char* /*name*/, const T&) {}
  /// An enum class with values 0, 1, ..., or one of the names. With a default it may be absent.
  template <class E>
  void choice(const char* /*name*/, const E&, std::span<const std::string_view> /*names*/,
              bool /*or_default*/ = false) {}
  void time(const char* /*name*/, const TimeNs&) {}
  /// Members first and last, both included. A line of the name or_ping may leave them out: its own ping.
  void interval(const TimeNs& /*first*/, const TimeNs& /*last*/, std::string_view /*or_ping*/ = {}) {}
  /// How many; 0 = not known, absent.
  void count(const char* /*name*/, const std::int64_t&) {}
  /// How many pings; -1 = as far as there are. It may be absent.
  template <class T>
  void pings(const char* /*name*/, const T&) {}
  /// The text of a JSON object; empty = absent.
  void object(const char* /*name*/, const std::string&) {}
  /// All members of a calibration, among the others.
  void inside(const CalibrationParams&) {}
  /// Described structs: an array of them, or the only one, whose members stand among the others.
  template <class D>
  void list(const char* /*name*/, const std::vector<D>&) {}
  template <class D>
  void alone(const std::vector<D>&) {}
  void require(bool /*sound*/, const char* /*text*/) {}

  /// The words, the name of the school where there is one, the end. With or_made else that of the one it made.
  void says(const std::string& /*words*/, const std::optional<SchoolKey>& /*school*/ = {}) {}
  void says_or_made(const std::string& /*words*/, const std::optional<SchoolKey>& /*school*/,
                    const char* /*end*/ = "") {}
};

/// Of a command that has one name.
template <class V>
void named(V& v, std::string_view name, About about) {
  v.command(std::span(&name, 1), std::size_t{0}, about);
}

template <class V, Of<PropagateCommand> T>
void describe(V& v, T& c) {
  named(v, "propagate", About::ping);
  v.field("school", c.school);
  if (!c.school) v.field("seeds", c.seeds);
  v.field("grow", c.grow);
  v.choice("mode", c.mode, kGrowModeNames, true);
  v.field("propagate_paper", c.paper);
  v.field("propagate_tracked", c.tracked);
  v.field("growth_curve", c.growth_curve);
  v.pings("reach", c.reach);
  v.pings("reach_backward", c.reach_backward);
  v.pings("reach_forward", c.reach_forward);
  v.says_or_made("propagate", c.school);
}

template <class V, Of<GrowCommand> T>
void describe(V& v, T& c) {
  named(v, "grow", About::ping);
  v.choice("to", c.to, kGrowToNames);
  v.field("grow", c.grow);
  v.field("growth_curve", c.growth_curve);
  v.field("seeds", c.seeds);
  v.field("school", c.school);
  v.require((c.to == GrowTo::school) != c.school.has_value(),
            "school: expected with add, take_away and replace, and only there");
  constexpr std::array<const char*, kGrowToNames.size()> kWords{"grow", "add to", "take away from", "grow"};
  v.says_or_made(kWords[static_cast<std::size_t>(c.to)], c.school, c.to == GrowTo::replace ? " anew" : "");
}

template <class V, Of<BrushCommand> T>
void describe(V& v, T& c) {
  named(v, "brush", About::ping);
  v.field("runs", c.runs);
  v.field("school", c.school);
  v.says_or_made("brush", c.school);
}

template <class V, Of<EraseCommand> T>
void describe(V& v, T& c) {
  named(v, "erase", About::ping);
  v.field("runs", c.runs);
  v.field("school", c.school);
  v.says("erase", c.school);
}

template <class V, Of<ReshapeCommand> T>
void describe(V& v, T& c) {
  v.command(kReshapingNames, c.what, About::ping);
  v.field("school", c.school);
  v.field("all_pings", c.all_pings);
  constexpr std::array<const char*, kReshapingNames.size()> kWords{"fill holes of", "smooth",
                                                                   "keep the largest part of"};
  v.says(kWords[static_cast<std::size_t>(c.what)], c.school);
}

template <class V, Of<MergeCommand> T>
void describe(V& v, T& c) {
  named(v, "merge", About::ping);
  v.field("schools", c.schools);
  v.says("merge into", c.schools.empty() ? std::nullopt : std::optional(c.schools.front()));
}

template <class V, Of<SplitCommand> T>
void describe(V& v, T& c) {
  named(v, "split", About::ping);
  v.field("school", c.school);
  v.field("seed", c.seed);
  v.says("split", c.school);
}

template <class V, Of<HandOverCommand> T>
void describe(V& v, T& c) {
  named(v, "hand_over", About::ping);
  v.field("school", c.school);
  v.field("to", c.to);
  v.interval(c.first, c.last);
  v.says("hand over pings of", c.school);
}

template <class V, Of<DeleteCommand> T>
void describe(V& v, T& c) {
  named(v, "delete", About::ping);
  v.field("school", c.school);
  v.says("delete", c.school);
}

template <class V, Of<Decision> T>
void describe(V& v, T& d) {
  v.field("school", d.school);
  v.choice("status", d.status, kStatusNames);
  v.field("species", d.species);
  v.field("comment", d.comment);
  v.field("name", d.name);
  v.require(d.status || d.species || d.comment || d.name, "expected status, species, comment or name");
}

inline constexpr std::array<std::string_view, 5> kDecideNames{"decide", "species", "comment", "rename", "bulk_decide"};
inline constexpr std::size_t kBulk = 4;

/// Index of its name.
[[nodiscard]] inline std::size_t decide_name(const DecideCommand& c) {
  if (c.decisions.size() != 1 || !c.rule.empty()) return kBulk;
  const Decision& one = c.decisions.front();
  const std::array<bool, 3> says{one.species.has_value(), one.comment.has_value(), one.name.has_value()};
  if (one.status || std::ranges::count(says, true) != 1) return 0;
  return 1 + static_cast<std::size_t>(std::ranges::find(says, true) - says.begin());
}

[[nodiscard]] inline std::string decide_words(const Decision& one) {
  if (one.status == "accepted") return "accept";
  if (one.status == "rejected") return "reject";
  if (one.status) return "mark as " + *one.status;
  if (one.name) return "rename";
  return one.species ? "set species of" : "comment on";
}

/// What is said of all schools; "review" where it is not the same.
[[nodiscard]] inline std::string decide_words(const DecideCommand& c) {
  if (c.decisions.empty()) return "review";
  std::string words = decide_words(c.decisions.front());
  const auto same = [&](const Decision& one) { return decide_words(one) == words; };
  return std::ranges::all_of(c.decisions, same) ? words : "review";
}

template <class V, Of<DecideCommand> T>
void describe(V& v, T& c) {
  v.command(kDecideNames, decide_name(c), About::schools);
  if (v.called(kDecideNames[kBulk])) {
    v.field("rule", c.rule);
    v.list("decisions", c.decisions);
  } else {
    v.alone(c.decisions);
  }
  if (c.decisions.size() == 1) {
    v.says(decide_words(c), c.decisions.front().school);
  } else {
    v.says(decide_words(c) + " " + count_of(c.decisions.size(), "school"));
  }
}

template <class V, Of<EventCommand> T>
void describe_members(V& v, T& c) {
  v.choice("kind", c.kind, kEventKindNames);
  v.time("time", c.time);
  v.field("text", c.text);
  v.object("view", c.view);
}

template <class V, Of<EventCommand> T>
void describe(V& v, T& c) {
  named(v, "event", About::times);
  describe_members(v, c);
  v.says("mark " + c.kind);
}

template <class V, Of<RemoveEventCommand> T>
void describe(V& v, T& c) {
  named(v, "remove_event", About::times);
  describe_members(v, c.event);
  v.says("remove mark " + c.event.kind);
}

inline constexpr std::array<std::string_view, 2> kBadPingsNames{"bad_ping", "bad_interval"};

template <class V, Of<BadPingsCommand> T>
void describe(V& v, T& c) {
  const bool one = c.first == c.last;
  v.command(kBadPingsNames, std::size_t{one ? 0U : 1U}, About::times);
  v.interval(c.first, c.last, kBadPingsNames[0]);
  v.says(one ? "mark bad ping" : "mark bad interval");
}

template <class V, Of<GoodPingsCommand> T>
void describe(V& v, T& c) {
  named(v, "good_interval", About::times);
  v.interval(c.first, c.last);
  v.says(c.first == c.last ? "mark good ping" : "mark good interval");
}

template <class V, Of<CalibrateCommand> T>
void describe(V& v, T& c) {
  named(v, "calibrate", About::survey);
  v.inside(c.calibration);
  v.field("file", c.file);
  v.says("calibration " + c.file);
}

template <class V, Of<DetectCommand> T>
void describe(V& v, T& c) {
  named(v, "detect", About::ping);
  v.count("schools", c.schools);
  v.says("detect schools");
}

/// Whichever command it is.
template <class V>
void describe_any(V& v, const Command& command) {
  std::visit([&](const auto& c) { describe(v, c); }, command);
}

}  // namespace sonar
