// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/exit_codes.h"
#include "cli/file_to_write.h"
#include "cli/named_path.h"
#include "cli/verb.h"
#include "pipeline/calibrate/setup_report.h"
#include "publish/setup_pictures.h"

namespace sonar {
namespace {

int run_check(const std::string& out, bool json, const std::string& picture) {
  if (auto place = require_picture_place(picture); !place) return report(place.error());
  Work work(1);
  const CancelOnInterrupt watch(work);
  const auto made = setup_report(out, work);
  if (!made) return report(made.error());
  if (!picture.empty()) {
    if (auto drawn = write_leg_picture(leg_chart_data(*made), picture); !drawn) return report(drawn.error());
  }
  fmt::print("{}", json ? setup_json_text(*made) : setup_text(*made));
  return kExitDone;
}

}  // namespace

void add_check(CLI::App& app, VerbRunner& run) {
  const auto out = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  const auto picture = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand(
      "check", "Mounting angle and sound speed that the schools' mean speeds on each course leg ask for");
  verb->add_option("OUT", *out, "Work folder of a run")->required()->check(named_path());
  verb->add_flag("--json", *json, "Print one JSON object");
  verb->add_option("--picture", *picture, "Chart of the mean speeds to write too (PNG, SVG, PDF)")->check(named_file());
  verb->callback(
      [out, json, picture, &run] { run = [out, json, picture] { return run_check(*out, *json, *picture); }; });
}

}  // namespace sonar
