// SPDX-License-Identifier: Apache-2.0
#include "pipeline/live/follow.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/machine_memory.h"
#include "cli/exit_codes.h"
#include "cli/follow_lines.h"
#include "cli/named_path.h"
#include "cli/numbers.h"
#include "cli/progress.h"
#include "cli/run_survey.h"
#include "cli/verb.h"
#include "io/atomic_file.h"
#include "io/udp_sender.h"
#include "pipeline/journal/journals.h"
#include "pipeline/live/alarm.h"
#include "pipeline/live/live_targets.h"

namespace sonar {
namespace {

using std::chrono::duration;
using std::chrono::milliseconds;
using std::chrono::seconds;

/// Between two looks: what was written last is on its way within a quarter of a second.
constexpr milliseconds kPoll{200};
/// Provisional products, tables and the map are written so often at most, and in a twentieth of the time.
constexpr seconds kBetweenWrites{60};
constexpr int kShareOfWriting = 20;
/// Work that takes longer than this on several pings at once is slower than it ought to be.
constexpr seconds kSlow{5};

struct FollowArguments {
  RunArguments run;
  double idle_exit_s = 0.0;
  std::string nmea;
  std::vector<std::string> alarms;
  bool json = false;
};

double seconds_of(LiveClock::duration span) { return duration<double>(span).count(); }

/// What is told of a survey that is followed, to people or, a JSON object a line, to programs.
class Teller {
 public:
  explicit Teller(bool json) : json_(json), terminal_(!json && isatty(STDERR_FILENO) != 0) {}

  void school(const LiveSchool& school) { line("school", school_line(school), school_json(school)); }
  void alarm(const std::string& rule, const LiveSchool& school) {
    nlohmann::json members = school_json(school);
    members["rule"] = rule;
    line("alarm", fmt::format("ALARM {}: {}{}", rule, school_line(school), terminal_ ? "\a" : ""), members);
  }
  void finished(const std::string& observation, const std::filesystem::path& product) {
    line("finished", fmt::format("{} is over: {}", observation, product.string()),
         {{"observation", observation}, {"product", product.string()}});
  }
  /// The newest; on a terminal it stands below all lines, elsewhere it is one of them, to people once a minute.
  void status(const LiveStatus& status, bool minute) {
    status_ = status_line(status);
    if (terminal_) {
      show_status();
    } else if (minute || json_) {
      line("status", status_, status_json(status));
    }
  }
  /// Something is not as it should be; the same thing is said once.
  void trouble(const std::string& text) {
    if (text == trouble_) return;
    trouble_ = text;
    hide_status();
    fmt::print(stderr, "sonarx: {}\n", text);
    show_status();
  }
  void no_trouble() { trouble_.clear(); }
  void end() { hide_status(); }

 private:
  void line(const char* event, const std::string& text, nlohmann::json members) {
    hide_status();
    if (json_) {
      members["event"] = event;
      fmt::print("{}\n", members.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    } else {
      fmt::print("{}\n", text);
    }
    std::fflush(stdout);
    show_status();
  }
  void show_status() {
    if (terminal_ && !status_.empty()) fmt::print(stderr, "\r{}\x1b[K", status_);
  }
  void hide_status() const {
    if (terminal_) fmt::print(stderr, "\r\x1b[K");
  }

  bool json_;
  bool terminal_;
  std::string status_;
  std::string trouble_;
};

class Following {
 public:
  Following(const FollowArguments& arguments, Recipe recipe, std::vector<Alarm> alarms, std::optional<UdpSender> bridge)
      : arguments_(arguments),
        out_(arguments.run.out),
        follow_({{arguments.run.survey.begin(), arguments.run.survey.end()},
                 out_,
                 arguments.run.session,
                 SONAR_VERSION,
                 IndexCache::of_user()},
                std::move(recipe)),
        alarms_(std::move(alarms)),
        bridge_(std::move(bridge)),
        teller_(arguments.json) {}

  /// Until Ctrl-C, or until nothing was written for so long.
  Result<void> run() {
    Work work(arguments_.run.jobs);
    const CancelOnInterrupt watch(work);
    while (!work.cancelled()) {
      auto looked = look(work);
      if (!looked && !work.cancelled()) return looked;
      if (work.cancelled()) break;
      if (write_is_due()) {
        // A disk that is full or gone for a while must not end the watch; what is known stays.
        if (auto written = write(work); !written) teller_.trouble(to_line(written.error()) + "; tried again");
      }
      if (arguments_.idle_exit_s > 0.0 && seconds_of(follow_.quiet(LiveClock::now())) >= arguments_.idle_exit_s) break;
      std::this_thread::sleep_for(kPoll);
    }
    teller_.end();
    return {};
  }

  /// After Ctrl-C: what came is worked out and written; a second Ctrl-C ends the program.
  Result<void> end() {
    Work work(arguments_.run.jobs);
    if (auto looked = look(work); !looked) return looked;
    if (bridge_) {
      for (const std::string& sentence : targets_.end()) bridge_->send(sentence);
    }
    auto written = write(work);
    teller_.end();
    return written;
  }

 private:
  Result<void> look(Work& work) {
    const auto begun = LiveClock::now();
    // What came was written after the look before had begun to read, at the earliest.
    const auto written_since = std::exchange(looked_at_, begun);
    auto look = follow_.look(begun, work);
    if (!look) return pass_on(look);
    const double took_s = seconds_of(LiveClock::now() - begun);
    const double behind_s = seconds_of(LiveClock::now() - written_since);
    tell_trouble(*look, took_s);
    for (const std::string& observation : look->finished) {
      teller_.finished(observation, product_path(out_, observation));
      write_soon_ = true;
    }
    for (const LiveSchool& school : look->schools) {
      if (school.is_new) teller_.school(school);
    }
    for (const Alarms::Ringing& ringing : alarms_.ring(look->schools)) teller_.alarm(ringing.rule, ringing.school);
    if (bridge_ && look->news.pings > 0) {
      for (const std::string& sentence : targets_.sentences(look->schools)) bridge_->send(sentence);
    }
    if (look->news.pings > 0 && !follow_.survey()->observations.empty()) {
      const bool minute = begun - status_at_ >= kBetweenWrites;
      if (minute) status_at_ = begun;
      teller_.status(live_status(*follow_.survey(), behind_s, out_), minute);
    }
    if (look->news.pings > 0) give_memory_back();
    return {};
  }

  void tell_trouble(const Follow::Look& look, double took_s) {
    if (look.news.cannot) {
      const bool comes_back = look.news.cannot->code != ErrorCode::mismatch;
      teller_.trouble(to_line(*look.news.cannot) + (comes_back ? "; waiting for it" : ""));
    } else if (!look.failures.empty()) {
      const RunFailure& failure = look.failures.front();
      teller_.trouble(fmt::format("{}: {}", *failure.observation, to_line(failure.error)));
    } else if (took_s > seconds_of(kSlow) && look.news.pings > 1) {
      teller_.trouble("work is slower than the recording: schools are told late, nothing is left out");
    } else if (follow_.survey()->observations.empty()) {
      teller_.trouble("no ping yet; waiting for the first");
    } else if (look.news.pings > 0) {
      teller_.no_trouble();
    }
  }

  [[nodiscard]] bool write_is_due() const {
    const auto since = LiveClock::now() - written_at_;
    return follow_.unwritten() && since > kShareOfWriting * writing_took_ && (write_soon_ || since > kBetweenWrites);
  }

  Result<void> write(Work& work) {
    const auto begun = LiveClock::now();
    const auto merged = follow_.write(work);
    written_at_ = LiveClock::now();
    writing_took_ = written_at_ - begun;
    write_soon_ = false;
    if (!merged && !work.cancelled()) return pass_on(merged);
    return {};
  }

  FollowArguments arguments_;
  std::filesystem::path out_;
  Follow follow_;
  Alarms alarms_;
  std::optional<UdpSender> bridge_;
  Teller teller_;
  LiveTargets targets_;
  LiveClock::time_point looked_at_ = LiveClock::now();
  LiveClock::time_point written_at_ = LiveClock::now();
  LiveClock::time_point status_at_{};
  LiveClock::duration writing_took_{};
  bool write_soon_ = false;  ///< an observation was over
};

Result<void> require_fit(const FollowArguments& arguments) {
  const std::vector<std::filesystem::path> survey(arguments.run.survey.begin(), arguments.run.survey.end());
  if (auto outside = require_outside_raw(survey, arguments.run.out); !outside) return outside;
  const auto listed = list_survey(survey);
  if (!listed) return pass_on(listed);
  return require_free_space(arguments.run.out, 0);
}

int follow_survey(const FollowArguments& arguments) {
  std::vector<Alarm> alarms;
  for (const std::string& rule : arguments.alarms) {
    auto alarm = Alarm::parse(rule);
    if (!alarm) return report({alarm.error().code, "--alarm " + alarm.error().text, {}});
    alarms.push_back(std::move(*alarm));
  }
  std::optional<UdpSender> bridge;
  if (!arguments.nmea.empty()) {
    auto sender = UdpSender::open(arguments.nmea);
    if (!sender) return report({sender.error().code, "--nmea " + sender.error().text, sender.error().where});
    bridge = std::move(*sender);
  }
  if (auto fit = require_fit(arguments); !fit) return report(fit.error());
  if (auto ours = require_no_newer_plan(arguments.run.out); !ours) return report(ours.error());
  const auto journal = arguments.run.session.empty() ? Result<Journal>(Journal{}) : read_session(arguments.run.session);
  if (!journal) return report(journal.error());
  auto recipe = recipe_for(arguments.run, *journal);
  if (!recipe) return report(recipe.error());
  Following following(arguments, std::move(*recipe), std::move(alarms), std::move(bridge));
  if (auto done = following.run(); !done) return report(done.error());
  if (!interrupted()) return run_verb(arguments.run);  // all is there: what is right already stays
  if (auto done = following.end(); !done) return report(done.error());
  return kExitDone;
}

}  // namespace

void add_follow(CLI::App& app, VerbRunner& run) {
  const auto arguments = std::make_shared<FollowArguments>();
  CLI::App* verb =
      app.add_subcommand("follow", "Process a survey while its files are still being written; Ctrl-C ends it");
  verb->add_option("SURVEY", arguments->run.survey, "Folder in which raw files appear, or raw files")->required();
  verb->add_option("-o,--out", arguments->run.out, "Work folder for products and tables")
      ->required()
      ->check(named_folder());
  verb->add_option("--idle-exit", arguments->idle_exit_s,
                   "End when nothing was written for so many seconds: then all is over; 0 = never")
      ->check(within(0.0, 1e9));
  verb->add_option("--recipe", arguments->run.recipe, "Parameters of every stage (see sonarx recipe)")
      ->check(named_file());
  add_measured_options(*verb, arguments->run.measured);
  verb->add_option("--session", arguments->run.session,
                   "Journal of decisions to replay, or the folder of several people's; read again when it grows")
      ->check(named_path());
  verb->add_option("-j,--jobs", arguments->run.jobs, "Threads; 0 = all of the machine's")->check(whole_within(0, 1024));
  verb->add_option(
          "--alarm", arguments->alarms,
          "Tell when a school's row of school_pings.csv begins to be so: \"volume_m3 > 20000, range_m < 150\"; "
          "may be given again")
      ->type_name("RULE")
      ->allow_extra_args(false);
  verb->add_option("--nmea", arguments->nmea, "Schools as NMEA 0183 TLL and TTM by UDP, for the chart")
      ->check(some_name("HOST:PORT"));
  verb->add_flag("--json", arguments->json, "Print reports as JSON, one object per line");
  verb->callback([arguments, &run] { run = [arguments] { return follow_survey(*arguments); }; });
}

}  // namespace sonar
