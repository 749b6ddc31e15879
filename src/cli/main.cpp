// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <atomic>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "cli/exit_codes.h"
#include "cli/help.h"
#include "cli/log.h"
#include "cli/suggestion.h"
#include "cli/verb.h"

namespace sonar {
namespace {

// What a signal handler may touch must outlive every verb; nothing below this file sees it.
std::array<std::atomic<Work*>, 8> watched{};
std::atomic<bool> was_interrupted{false};

/// Ctrl-C, and what batch systems send before they kill.
constexpr std::array kStops = {SIGINT, SIGTERM};

extern "C" void on_interrupt(int) {
  // A second one ends the program at once.
  for (const int signal : kStops) std::signal(signal, SIG_DFL);
  was_interrupted.store(true);
  for (auto& slot : watched) {
    if (Work* work = slot.load()) work->cancel();
  }
}

/// "--seed = 99999999999999999999: out of range, or no whole number"; the parser's own words say nothing of what was wrong.
std::string conversion_text(const CLI::App& app, const std::string& told) {
  const std::string call = told.substr(told.find("--") == std::string::npos ? 0 : told.find("--"));
  const auto verbs = app.get_subcommands();
  const CLI::Option* option =
      verbs.empty() ? nullptr : verbs.front()->get_option_no_throw(call.substr(0, call.find(' ')));
  if (option == nullptr) return told;
  return call + (option->get_type_name().starts_with("FLOAT") ? ": out of range, or no number"
                                                              : ": out of range, or no whole number");
}

/// "; did you mean --out?", or nothing.
std::string meant_text(const std::string& word, const std::vector<std::string>& known) {
  const std::string meant = suggestion(word, known);
  return meant.empty() ? "" : "; did you mean " + meant + "?";
}

/// "there is no option --ouf; did you mean --out?"; empty where no option was too many.
std::string unknown_option_text(const CLI::App& app) {
  const auto verbs = app.get_subcommands();
  if (verbs.empty()) return {};
  const CLI::App& verb = *verbs.front();
  std::vector<std::string> known;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  for (const std::string& word : verb.remaining()) {
    if (!word.starts_with("-")) continue;
    const std::string name = word.substr(0, word.find('='));
    return "there is no option " + name + meant_text(name, known);
  }
  return {};
}

/// What was wrong with a call. The parser misses a verb before it looks at what stands in its place.
std::string usage_text(const CLI::App& app, const CLI::ParseError& error, std::span<char*> words) {
  const std::string first = words.size() > 1 ? words[1] : "";
  if (!first.empty() && first[0] != '-' &&
      app.get_subcommands([&](const CLI::App* verb) { return verb->get_name() == first; }).empty()) {
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; }))
      verbs.push_back(verb->get_name());
    return "there is no verb '" + first + "'" + meant_text(first, verbs);
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    if (const std::string text = unknown_option_text(app); !text.empty()) return text;
  }
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) return conversion_text(app, error.what());
  return dynamic_cast<const CLI::RequiredError*>(&error) != nullptr && app.get_subcommands().empty()
             ? "a verb is needed"
             : error.what();
}

int run_program(int argc, char** argv) {
  CLI::App app("Detects fish schools in fishery-sonar surveys; writes masks, tables and maps from raw files", "sonarx");
  app.set_version_flag("-V,--version", "sonarx " SONAR_VERSION);
  app.require_subcommand(1);
  VerbRunner run;
  add_info(app, run);
  add_simulate(app, run);
  add_run(app, run);
  add_plan(app, run);
  add_follow(app, run);
  add_merge(app, run);
  add_submit(app, run);
  add_status(app, run);
  add_propagate(app, run);
  add_export(app, run);
  add_score(app, run);
  add_compare(app, run);
  add_recipe(app, run);
  add_render(app, run);
  add_help(app, run);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // Help and version are "errors" to the parser.
    if (error.get_exit_code() == 0) {
      app.exit(error);
      return kExitDone;
    }
    const std::string verb = app.get_subcommands().empty() ? "" : " " + app.get_subcommands().front()->get_name();
    print_error(usage_text(app, error, {argv, static_cast<std::size_t>(argc)}) + "; see sonarx" + verb + " --help");
    return kExitUsage;
  }
  for (const int signal : kStops) std::signal(signal, on_interrupt);
  std::signal(SIGXFSZ, SIG_IGN);  // a file too large for the user's limit is an error of that write, and told
  int code = run();
  // A full disk or a closed pipe under the results is a failure.
  if (code == kExitDone && (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)) {
    std::fprintf(stderr, "sonarx: standard output could not be written\n");
    code = kExitFailed;
  }
  return interrupted() ? kExitInterrupted : code;
}

}  // namespace

CancelOnInterrupt::CancelOnInterrupt(Work& work) : slot_(-1) {
  for (std::size_t i = 0; i < watched.size() && slot_ < 0; ++i) {
    Work* none = nullptr;
    if (watched[i].compare_exchange_strong(none, &work)) slot_ = static_cast<int>(i);
  }
  if (interrupted()) work.cancel();
}

CancelOnInterrupt::~CancelOnInterrupt() {
  if (slot_ >= 0) watched[static_cast<std::size_t>(slot_)].store(nullptr);
}

bool interrupted() { return was_interrupted.load(); }

int report(const Error& error) {
  print_error(to_line(error));
  return exit_code_of(error.code);
}

}  // namespace sonar

int main(int argc, char** argv) {
  try {
    return sonar::run_program(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("sonarx: there is not enough memory for this\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sonarx: %s\n", error.what());
  } catch (...) {
    std::fprintf(stderr, "sonarx: stopped by an unknown fault\n");
  }
  return sonar::kExitFailed;
}
