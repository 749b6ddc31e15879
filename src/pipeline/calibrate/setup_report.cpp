// SPDX-License-Identifier: Apache-2.0
#include "pipeline/calibrate/setup_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/middle.h"
#include "io/product_file.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/tasks/merge.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// Rows stand by school and ping.
void take_schools(const ObservationProduct& product, const SummariseParams& params, std::vector<SeenSpeed>& speeds) {
  auto first = product.school_pings.begin();
  for (const SchoolRow& school : product.schools) {
    while (first != product.school_pings.end() && first->school_id < school.school_id) ++first;
    auto last = first;
    while (last != product.school_pings.end() && last->school_id == school.school_id) ++last;
    if (school.status != "rejected" && first != last) {
      if (auto seen = seen_speed({first, last}, product.pings, params)) speeds.push_back(*seen);
    }
    first = last;
  }
}

}  // namespace

Result<void> SetupSeen::take(const ObservationProduct& product, const std::string& where) {
  if (!product.grid) return {};
  if (!navigation_) {
    const auto recipe = recipe_from_text(product.recipe_json);
    if (!recipe) return fail(recipe.error().code, recipe.error().text, {.file = where});
    navigation_ = recipe->navigation;
    summarise_ = recipe->summarise;
    recipe_hash_ = product.recipe_hash;
  } else if (product.recipe_hash != recipe_hash_) {
    return fail(ErrorCode::mismatch, "is of another recipe than the observations before", {.file = where});
  }
  sound_speeds_mps_.push_back(product.grid->sound_speed_mps);
  take_schools(product, summarise_, speeds_);
  return {};
}

Result<SetupReport> SetupSeen::report(const std::string& where) const {
  if (!navigation_) {
    return fail(ErrorCode::not_found, "no observation here has a grid of fans and beams", {.file = where});
  }
  auto check = check_setup(speeds_);
  if (!check) return fail(check.error().code, check.error().text, {.file = where});
  SetupReport report;
  report.check = std::move(*check);
  report.mounting_azimuth_deg = navigation_->mounting_azimuth_deg;
  report.sound_speed_mps = middle_of(sound_speeds_mps_);
  if (!report.check.drift_known) return report;
  const double scale = report.check.range_scale;
  report.proposed_mounting_azimuth_deg = wrap_360(report.mounting_azimuth_deg - report.check.bearing_error_deg);
  report.proposed_sound_speed_mps = report.sound_speed_mps / scale;
  report.proposed_sound_speed_se_mps = report.proposed_sound_speed_mps * report.check.range_scale_se / scale;
  return report;
}

Result<SetupReport> setup_report(const fs::path& out, Work& work) {
  const auto files = product_files(out);
  if (!files) return pass_on(files);
  if (files->empty()) return fail(ErrorCode::not_found, "there are no products in this folder", {.file = out.string()});
  SetupSeen seen;
  for (const fs::path& file : *files) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    const auto product = read_product(file);
    if (!product) return pass_on(product);
    if (auto taken = seen.take(*product, file.string()); !taken) return pass_on(taken);
  }
  return seen.report(out.string());
}

std::string setup_text(const SetupReport& report) {
  const SetupCheck& c = report.check;
  std::string text =
      fmt::format("{} schools on {} course legs; their mean speed over ground:\n", c.schools, c.legs.size());
  for (const CourseLeg& leg : c.legs) {
    text += fmt::format(
        "  {}  course {:03.0f}, ship {:.1f} m/s, {} schools: along track {:+.3f} +- {:.3f} m/s, to starboard {:+.3f} "
        "+- "
        "{:.3f} m/s\n",
        iso_time(leg.first_time), leg.course_deg, leg.ship_mps, leg.schools, leg.along_mps, leg.along_se_mps,
        leg.cross_mps, leg.cross_se_mps);
  }
  const std::string bearings =
      fmt::format("bearings too large by {:+.2f} +- {:.2f} degrees", c.bearing_error_deg, c.bearing_error_se_deg);
  const std::string ranges =
      fmt::format("ranges too long by {:+.2f} +- {:.2f} %", 100.0 * (c.range_scale - 1.0), 100.0 * c.range_scale_se);
  if (!c.drift_known) {
    return text + fmt::format(
                      "the ship sailed one course, on which a current, or fish that all swim one way, looks as a wrong "
                      "setup does: nothing "
                      "is proposed\nif nothing drifted: {}, {}\n",
                      bearings, ranges);
  }
  text += fmt::format(
      "drift of all schools: east {:+.3f} +- {:.3f} m/s, north {:+.3f} +- {:.3f} m/s; each its own way: {:.2f} m/s\n",
      c.drift_east_mps, c.drift_east_se_mps, c.drift_north_mps, c.drift_north_se_mps, c.own_speed_mps);
  text += fmt::format("{}: navigation.mounting_azimuth_deg {} -> {:.2f}\n", bearings, report.mounting_azimuth_deg,
                      report.proposed_mounting_azimuth_deg);
  text += fmt::format("{}: sound speed {:.1f} -> {:.1f} +- {:.1f} m/s\n", ranges, report.sound_speed_mps,
                      report.proposed_sound_speed_mps, report.proposed_sound_speed_se_mps);
  return text;
}

std::string setup_json_text(const SetupReport& report) {
  const SetupCheck& c = report.check;
  nlohmann::json legs = nlohmann::json::array();
  for (const CourseLeg& leg : c.legs) {
    legs.push_back({{"first_time_utc", iso_time(leg.first_time)},
                    {"last_time_utc", iso_time(leg.last_time)},
                    {"schools", leg.schools},
                    {"course_deg", leg.course_deg},
                    {"ship_mps", leg.ship_mps},
                    {"along_mps", leg.along_mps},
                    {"along_se_mps", leg.along_se_mps},
                    {"cross_mps", leg.cross_mps},
                    {"cross_se_mps", leg.cross_se_mps}});
  }
  nlohmann::json drift = nullptr;
  if (c.drift_known) {
    drift = {{"east_mps", c.drift_east_mps},
             {"east_se_mps", c.drift_east_se_mps},
             {"north_mps", c.drift_north_mps},
             {"north_se_mps", c.drift_north_se_mps}};
  }
  const nlohmann::json out = {{"schools", c.schools},
                              {"legs", std::move(legs)},
                              {"drift", std::move(drift)},
                              {"own_speed_mps", c.own_speed_mps},
                              {"bearing_error_deg", c.bearing_error_deg},
                              {"bearing_error_se_deg", c.bearing_error_se_deg},
                              {"range_scale", c.range_scale},
                              {"range_scale_se", c.range_scale_se},
                              {"mounting_azimuth_deg", report.mounting_azimuth_deg},
                              {"proposed_mounting_azimuth_deg", report.proposed_mounting_azimuth_deg},
                              {"sound_speed_mps", report.sound_speed_mps},
                              {"proposed_sound_speed_mps", report.proposed_sound_speed_mps},
                              {"proposed_sound_speed_se_mps", report.proposed_sound_speed_se_mps}};
  return out.dump(2) + "\n";
}

}  // namespace sonar
