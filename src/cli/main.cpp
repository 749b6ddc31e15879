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

#include "cli/exit_codes.h"
#include "cli/help.h"
#include "cli/log.h"
#include "cli/usage.h"
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

int run_program(int argc, char** argv) {
  CLI::App app("Detects fish schools in fishery-sonar surveys; writes masks, tables and maps from raw files", "sonarx");
  app.set_version_flag("-V,--version", "sonarx " SONAR_VERSION);
  app.require_subcommand(1);
  VerbRunner run;
  add_info(app, run);
  add_simulate(app, run);
  add_calibrate(app, run);
  add_run(app, run);
  add_plan(app, run);
  add_follow(app, run);
  add_merge(app, run);
  add_submit(app, run);
  add_status(app, run);
  add_check(app, run);
  add_integrate(app, run);
  add_biomass(app, run);
  add_propagate(app, run);
  add_import(app, run);
  add_export(app, run);
  add_score(app, run);
  add_agree(app, run);
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
