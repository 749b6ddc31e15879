// SPDX-License-Identifier: Apache-2.0
#include "view/charts/frequency_chart.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "base/number_text.h"
#include "view/colour_bar.h"

namespace sonar {
namespace {

constexpr double kLeastSpan_db = 4.0;
constexpr double kLeastSpan_khz = 2.0;

ChartCurve curve_of(const FrequencySeries& series) {
  ChartCurve out{series.name, series.colour, series.muted, true, {}};
  for (const FrequencyPoint& point : series.points) {
    CurvePoint& one = out.points.emplace_back(CurvePoint{point.frequency_khz, point.sv_db});
    if (series.muted) continue;
    one.low = point.low_db;
    one.high = point.high_db;
  }
  return out;
}

}  // namespace

const char* frequency_caution() {
  return "Fans differ in tilt as well as in frequency: they see fish from other sides, and other parts of the school.";
}

Result<PanelChart> frequency_chart(const FrequencyChartData& data, PixelSize size, const Theme& theme) {
  ChartPanel panel{"frequency (kHz)", kSvLabel, kLeastSpan_khz, kLeastSpan_db, false, {}};
  for (const FrequencySeries& series : data.series) panel.curves.push_back(curve_of(series));
  auto made = panel_chart(
      {data.title, "mean Sv of each fan over its frequency, " + data.pings, frequency_caution(), 1, {std::move(panel)}},
      size, theme);
  if (!made && made.error().code == ErrorCode::not_found) {
    return fail(ErrorCode::not_found, "no fan hears a school above the background: there is no frequency to compare");
  }
  return made;
}

std::string frequency_point_text(const FrequencySeries& series, const FrequencyPoint& point) {
  std::string text = fmt::format("{}\nfan {}, {:.1f} kHz: {:.1f} dB re 1 m\u207B\u00B9", series.name, point.fan,
                                 point.frequency_khz, point.sv_db);
  if (std::isfinite(point.low_db) && std::isfinite(point.high_db)) {
    text += fmt::format("\nhalf of the pings: {:.1f} to {:.1f} dB", point.low_db, point.high_db);
  }
  return text + fmt::format("\n{}, {}, {:.3g} m\u00B3", count_of(static_cast<std::size_t>(point.pings), "ping"),
                            count_of(static_cast<std::size_t>(point.samples), "sample"), point.volume_m3);
}

}  // namespace sonar
