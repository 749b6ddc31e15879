// SPDX-License-Identifier: Apache-2.0
#include "io/cf_attributes.h"

#include <algorithm>
#include <limits>

namespace sonar::cf {
namespace {

using netcdf::Writer;

constexpr std::int64_t kNoTime = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kNsOfMicrosecond = 1000;

/// Downwards, also before 1970.
std::int64_t microseconds(TimeNs time) { return time / kNsOfMicrosecond - (time % kNsOfMicrosecond < 0 ? 1 : 0); }

}  // namespace

void describe_file(Writer& out, std::string_view title, const ObservationProduct& product) {
  const auto text = [&](const char* name, std::string_view value) {
    out.attribute(out.root(), Writer::kGlobal, name, value);
  };
  text("Conventions", kConventions);
  text("title", title);
  text("source", product.source);
  text("history", product.history);
  text("sonar_explorer_version", product.program_version);
  text("recipe", product.recipe_json);
  text("recipe_hash", product.recipe_hash);
  text("observation", product.observation);
}

void name(Writer& out, int group, int variable, std::string_view long_name, std::string_view standard_name) {
  out.attribute(group, variable, "long_name", long_name);
  if (!standard_name.empty()) out.attribute(group, variable, "standard_name", standard_name);
  // A vertical coordinate says which way it counts.
  if (standard_name == "depth") out.attribute(group, variable, "positive", "down");
}

void place(Writer& out, int group, int variable, std::string_view coordinates) {
  out.attribute(group, variable, "coordinates", coordinates);
}

void flags(Writer& out, int group, int variable, std::string_view meanings) {
  out.numbers(group, variable, "flag_values", std::vector<std::uint8_t>{0, 1});
  out.attribute(group, variable, "flag_meanings", meanings);
}

int times(Writer& out, int group, const std::string& name, std::string_view long_name,
          const netcdf::Dimension& dimension, std::span<const TimeNs> times, bool may_lack) {
  std::vector<std::int64_t> values;
  for (const TimeNs time : times) values.push_back(may_lack && time == 0 ? kNoTime : microseconds(time));
  const int id = out.variable(group, name, kMicroseconds, {dimension}, values, netcdf::Storage::plain,
                              may_lack ? &kNoTime : nullptr);
  cf::name(out, group, id, long_name, "time");
  out.attribute(group, id, "calendar", std::string_view("proleptic_gregorian"));
  return id;
}

void ping_times(Writer& out, int group, const netcdf::Dimension& ping, std::span<const TimeNs> times) {
  cf::times(out, group, "time", "time of the ping, UTC", ping, times);
  const int id = out.variable(group, "time_ns", "ns", {ping}, std::vector<std::int64_t>(times.begin(), times.end()));
  name(out, group, id, "time of the ping since 1970-01-01 00:00:00 UTC, to the nanosecond: its lasting key");
}

}  // namespace sonar::cf
