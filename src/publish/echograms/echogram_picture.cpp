// SPDX-License-Identifier: Apache-2.0
#include "publish/echograms/echogram_picture.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/atomic_file.h"
#include "io/echoview_reader.h"
#include "publish/echograms/drawn_echogram.h"
#include "view/echograms/stacked_timelines.h"

namespace sonar {
namespace {

TimelineStyle style_of(const DrawnEchogram& drawn, const PictureOptions& options) {
  TimelineStyle style;
  style.axis = options.kind.echogram.along_log ? TimelineAxis::log : TimelineAxis::time;
  style.height = options.kind.echogram.depth ? EchogramHeight::depth : EchogramHeight::range;
  style.schools = options.display.masks;
  style.by_school = true;
  style.outlined = true;
  style.of = drawn.of;
  style.filtered = drawn.filtered;
  style.searched = drawn.searched;
  style.shown_heights = drawn.heights;
  if (options.transfer) {
    style.scale = sv_scale(*options.transfer, options.display.scale.map);
  } else {
    style.scale = options.limits_given ? options.display.scale : drawn.scale;
  }
  style.scale.map = options.display.scale.map;
  style.scale.threshold_db = options.display.scale.threshold_db;
  return style;
}

/// A line of depth over time, and what its file is called.
struct DrawnLine {
  std::vector<TimelinePoint> points;
  std::string name;
};

/// errors  as read_file(), parse_evl()
Result<DrawnLine> line_of(const PictureOptions& options) {
  DrawnLine line;
  if (options.line.empty() || !options.kind.echogram.depth) return line;
  const auto text = read_file(options.line, kMostEchoviewBytes);
  if (!text) return pass_on(text);
  const auto points = parse_evl(*text, options.line.string());
  if (!points) return pass_on(points);
  for (const EchoviewLinePoint& point : *points) {
    line.points.push_back({point.time, point.known() ? point.depth_m : std::nan("")});
  }
  line.name = printable(options.line.filename().string());
  return line;
}

TimelineObservation shown(const DrawnEchogram& drawn, const DrawnLine& line) {
  TimelineObservation out{&drawn.product, drawn.echogram.get()};
  out.line = line.points;
  out.line_name = line.name;
  out.refused = drawn.product.rejected;
  out.schools = drawn.schools;
  out.shadow = drawn.shadow;
  const auto& pings = drawn.product.pings;
  for (std::size_t i = 0; i < pings.size(); ++i) {
    if (!pings[i].bad) continue;
    const std::size_t first = i;
    while (i + 1 < pings.size() && pings[i + 1].bad) ++i;
    out.bad.push_back({pings[first].time, pings[i].time});
  }
  return out;
}

/// Whether two observations have a time in common.
bool at_one_time(const ObservationProduct& a, const ObservationProduct& b) {
  return !a.pings.empty() && !b.pings.empty() && a.pings.front().time <= b.pings.back().time &&
         b.pings.front().time <= a.pings.back().time;
}

Result<DrawnObservation*> observation_below(PictureSource& source, const DrawnObservation& above,
                                            const std::string& name) {
  if (name != "auto") {
    auto named = source.observation(name);
    if (named && *named == &above) return fail(ErrorCode::usage, fmt::format("below {}: that is the one above", name));
    return named;
  }
  for (DrawnObservation& one : source.observations()) {
    const bool of_single_beams = one.files() != nullptr && !one.files()->grid;
    if (&one != &above && of_single_beams && at_one_time(one.product(), above.product())) return &one;
  }
  return fail(ErrorCode::usage, "below auto: no sounder without fans ran at the time of " + above.name());
}

/// Another observation's options: what was named of the first one's beams and pings is not meant for it.
PictureOptions options_below(const PictureOptions& options, const DrawnObservation& below) {
  PictureOptions out = options;
  out.ping.reset();
  out.fan.reset();
  out.beam.reset();
  out.schools.clear();
  out.kind.echogram.of_fan = false;
  out.kind.echogram.from_ping = 0;
  out.kind.echogram.to_ping = -1;
  if (below.sector()) out.kind.echogram.channel.clear();
  return out;
}

}  // namespace

Result<FrameDescription> echogram_frame(PictureSource& source, DrawnObservation& observation,
                                        const PictureOptions& options, Work& work) {
  const EchogramParams& params = options.kind.echogram;
  const auto line = line_of(options);
  if (!line) return pass_on(line);
  DrawnObservation* below = nullptr;
  PictureOptions own = options;
  if (!params.below.empty()) {
    const auto found = observation_below(source, observation, params.below);
    if (!found) return pass_on(found);
    below = *found;
    // The channel that is named is the other one's where this one has fans.
    if (observation.sector()) own.kind.echogram.channel.clear();
  }
  const auto drawn = drawn_echogram(observation, own, work);
  if (!drawn) return pass_on(drawn);
  if (below == nullptr) {
    const TimelineObservation one = shown(*drawn, *line);
    return timeline(std::span(&one, 1), style_of(*drawn, options), options.size, theme_of(options));
  }
  const auto other = drawn_echogram(*below, options_below(options, *below), work);
  if (!other) return pass_on(other);
  TimelinePanel lower{shown(*other, *line), style_of(*other, options)};
  lower.observation.label = other->product.observation + ", " + other->of;
  return stacked_timelines({shown(*drawn, *line), style_of(*drawn, options)}, lower, options.size, theme_of(options));
}

}  // namespace sonar
