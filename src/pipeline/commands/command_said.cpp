// SPDX-License-Identifier: Apache-2.0
// What commands say: visitors of describe_commands.h that need no JSON.
#include <algorithm>
#include <limits>

#include "pipeline/commands/command.h"
#include "pipeline/commands/describe_commands.h"

namespace sonar {
namespace {

class AboutOf : public PassesOver {
 public:
  template <class E>
  void command(std::span<const std::string_view>, const E&, About about) {
    about_ = about;
  }
  [[nodiscard]] About about() const { return about_; }

 private:
  About about_ = About::ping;
};

class TimesOf : public AboutOf {
 public:
  template <class T>
  void field(const char*, const T&) {}
  void field(const char*, const SchoolKey& school) {
    if (about() == About::schools) times_.push_back({school.ping_time, school.ping_time});
  }
  void time(const char*, const TimeNs& time) { interval(time, time); }
  /// Of an act on masks they only tell which pings of a school are meant.
  void interval(const TimeNs& first, const TimeNs& last, std::string_view = {}) {
    if (about() == About::times) times_.push_back({first, last});
  }
  template <class D>
  void list(const char*, const std::vector<D>& all) {
    alone(all);
  }
  template <class D>
  void alone(const std::vector<D>& all) {
    for (const D& one : all) describe(*this, one);
  }
  [[nodiscard]] std::vector<TimeSpan>& times() { return times_; }

 private:
  std::vector<TimeSpan> times_;
};

class SentenceOf : public PassesOver {
 public:
  void says(const std::string& words, const std::optional<SchoolKey>& school = {}) {
    said_ = {words, school, false, {}};
  }
  void says_or_made(const std::string& words, const std::optional<SchoolKey>& school, const char* end = "") {
    said_ = {words, school, !school, end};
  }
  [[nodiscard]] Sentence& said() { return said_; }

 private:
  Sentence said_;
};

}  // namespace

About about(const Command& command) {
  AboutOf about;
  describe_any(about, command);
  return about.about();
}

bool needs_masks(const Command& command) {
  const About what = about(command);
  return what == About::ping || what == About::schools;
}

Sentence sentence_of(const Command& command) {
  SentenceOf sentence;
  describe_any(sentence, command);
  return std::move(sentence.said());
}

std::vector<TimeSpan> spoken_times(const Command& command) {
  TimesOf times;
  describe_any(times, command);
  if (times.about() == About::survey) {
    times.times().push_back({std::numeric_limits<TimeNs>::min(), std::numeric_limits<TimeNs>::max()});
  }
  return std::move(times.times());
}

std::vector<TimeSpan> times_of(const ReadLine& read) {
  std::vector<TimeSpan> times{{read.line.ping_time, read.line.ping_time}};
  if (!read.act) return times;
  const std::vector<TimeSpan> spoken = spoken_times(read.act->command);
  times.insert(times.end(), spoken.begin(), spoken.end());
  return times;
}

bool asks_for_detection(std::span<const JournalLine> lines, std::span<const TimeNs> times) {
  return std::ranges::any_of(lines, [&](const JournalLine& line) {
    return line.command == "detect" && std::ranges::binary_search(times, line.ping_time);
  });
}

bool asks_for_detection(std::span<const ReadLine> lines, std::span<const TimeNs> times) {
  return std::ranges::any_of(lines, [&](const ReadLine& read) { return asks_for_detection({&read.line, 1}, times); });
}

}  // namespace sonar
