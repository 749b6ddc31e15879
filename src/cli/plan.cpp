// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tasks/plan.h"

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "cli/chosen_recipe.h"
#include "cli/exit_codes.h"
#include "cli/log.h"
#include "cli/named_path.h"
#include "cli/numbers.h"
#include "cli/progress.h"
#include "cli/run_survey.h"
#include "cli/verb.h"
#include "io/atomic_file.h"
#include "pipeline/tasks/run_survey.h"

namespace sonar {

void add_plan(CLI::App& app, VerbRunner& run) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* verb = app.add_subcommand("plan", "Divide the processing of a survey into independent tasks");
  verb->add_option("SURVEY", arguments->survey, "Folder of raw files, or raw files")->required();
  verb->add_option("-o,--out", arguments->out, "Work folder for products and tables")
      ->required()
      ->check(named_folder());
  verb->add_option("--recipe", arguments->recipe, "Parameters of every stage (see sonarx recipe)")->check(named_file());
  add_measured_options(*verb, arguments->measured);
  verb->add_option("--session", arguments->session, "Journal of decisions to replay, or the folder of several people's")
      ->check(named_path());
  verb->add_flag("--json", arguments->json, "Print what stands in OUT/plan.json instead of a text");
  verb->add_option("-j,--jobs", arguments->jobs, "Threads; 0 = all of the machine's")->check(whole_within(0, 1024));
  verb->callback([arguments, &run] {
    run = [arguments] {
      Work work(arguments->jobs);
      const CancelOnInterrupt watch(work);
      show_progress(work);
      const RunSources sources = sources_of(*arguments);
      auto opened = open_for_run(sources, work);
      clear_progress();
      if (!opened) return report(opened.error());
      RunOptions options;
      options.out = arguments->out;
      options.program_version = SONAR_VERSION;
      if (auto outside = require_outside_raw(opened->survey, options.out); !outside) return report(outside.error());
      if (auto written = write_plan(*opened, sources, options); !written) return report(written.error());
      const std::vector<RunFailure> failed = failed_files(opened->survey);
      for (const RunLine& line : failure_lines(opened->survey, failed)) print_line(line);
      if (arguments->json) {
        fmt::print("{}", plan_text(opened->plan));
      } else if (opened->plan.tasks.empty()) {
        fmt::print("0 tasks: no file holds a ping\n");
      } else {
        fmt::print("{} tasks, 0 to {}: sonarx run --plan {} --task K, then sonarx merge {}\n",
                   opened->plan.tasks.size(), opened->plan.tasks.size() - 1, (options.out / "plan.json").string(),
                   options.out.string());
      }
      return failed.empty() ? kExitDone : kExitPartly;
    };
  });
}

}  // namespace sonar
