// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/info.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/exit_codes.h"
#include "cli/numbers.h"
#include "cli/verb.h"

namespace sonar {
namespace {

struct InfoOptions {
  std::vector<std::string> paths;
  bool json = false;
  bool checksum = false;
  bool quick = false;
  int jobs = 0;
};

int run_info(const InfoOptions& options) {
  Work work(options.jobs);
  const CancelOnInterrupt cancel(work);
  const std::vector<std::filesystem::path> paths(options.paths.begin(), options.paths.end());
  const NavigationParams navigation;
  const auto survey = options.quick ? glance_at_survey(paths, SurveyParams{}, navigation, work)
                                    : open_survey(paths, SurveyParams{}, navigation, IndexCache::of_user(), work);
  if (!survey) return report(survey.error());
  if (auto some = require_files(*survey, paths); !some) return report(some.error());
  const auto info = survey_info(*survey, navigation, options.checksum, work);
  if (!info) return report(info.error());
  const std::string text = options.json ? info_json(*info) : info_text(*info);
  std::fwrite(text.data(), 1, text.size(), stdout);
  for (const FileInfo& file : info->files) {
    if (file.readable) continue;
    const std::string why = file.notes.empty() ? "could not be read" : file.notes.back().text;
    std::fprintf(stderr, "sonarx: %s\n", to_line({ErrorCode::format, why, {file.path}}).c_str());
  }
  return info->all_readable() ? kExitDone : kExitPartly;
}

}  // namespace

void add_info(CLI::App& app, VerbRunner& run) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* verb = app.add_subcommand("info", "Show what files hold: format, pings, beams, times, places, damage");
  verb->add_option("PATH", options->paths, "Raw files, or folders of them")->required();
  verb->add_flag("--json", options->json, "Print one JSON object");
  CLI::Option* checksum =
      verb->add_flag("--checksum", options->checksum, "Read every sample and give the sum of all power counts");
  verb->add_flag("--quick", options->quick, "Read only the first and last bytes of each file; nothing is counted")
      ->excludes(checksum);
  verb->add_option("-j,--jobs", options->jobs, "Threads; 0 = all of the machine's")->check(whole_within(0, 1024));
  verb->callback([options, &run] { run = [options] { return run_info(*options); }; });
}

}  // namespace sonar
