// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/export_seabed.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "geo/geodesic.h"
#include "io/csv.h"
#include "pipeline/exports/export_sv.h"
#include "pipeline/stages/taken_background.h"
#include "school/seabed/seabed_hits.h"

namespace sonar {

namespace fs = std::filesystem;

Result<SeabedExport> SeabedExport::create(const fs::path& dest, const SeabedRasterParams& params) {
  if (auto sound = validate(params); !sound) return pass_on(sound);
  auto table = AtomicFile::create(dest / "seabed.csv");
  if (!table) return pass_on(table);
  CsvHeader header;
  SeabedRow blank;
  columns(header, blank);
  if (auto written = table->write(header.text() + "\n"); !written) return pass_on(written);
  return SeabedExport(std::move(*table), dest, params);
}

Result<void> SeabedExport::add(const SurveyFiles& survey, const ObservationProduct& product, const Recipe& recipe,
                               Work& work) {
  if (!product.grid || product.pings.empty()) return {};
  const auto observation = raw_files_of(survey, product);
  if (!observation) return pass_on(observation);
  if (title_.empty()) title_ = product.title;
  Engine engine(survey, **observation, recipe);
  if (auto given = take_background(engine, product, work); !given) return given;
  const std::int64_t at_once = 2 * std::max(1, work.threads());
  for (std::int64_t block = 0; block < engine.pings(); block += at_once) {
    std::vector<std::optional<Result<StagedPing>>> staged(
        static_cast<std::size_t>(std::min(at_once, engine.pings() - block)));
    work.for_each(std::ssize(staged), [&](std::int64_t i) {
      if (!engine.is_bad(block + i)) staged[static_cast<std::size_t>(i)] = engine.staged(block + i);
    });
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    if (auto refused = engine.refusal(); !refused) return refused;
    for (const auto& ping : staged) {
      if (!ping || !*ping) continue;
      if (auto written = write(engine, product, **ping); !written) return written;
    }
    work.progress("seabed", block + std::ssize(staged), engine.pings());
  }
  return {};
}

Result<void> SeabedExport::write(const Engine& engine, const ObservationProduct& product, const StagedPing& ping) {
  const Background background = ping.background();
  const SeabedWater water{std::as_const(*ping.filtered).counts.view(), std::as_const(*ping.filtered).flags.view(),
                          background, engine.sector(), engine.recipe().seabed};
  const std::vector<SeabedHit> hits = seabed_hits(ping.seabed, water);
  const double se_m = depth_se_m(hits, engine.recipe().seabed);
  const PingNavigation& at = engine.observation().navigation[static_cast<std::size_t>(ping.ping_index)];
  const Placement placement = engine.placement(ping.ping_index);
  std::string lines;
  for (const SeabedHit& hit : hits) {
    SeabedRow row;
    row.observation = product.observation;
    row.ping_index = ping.ping_index;
    row.time_utc = at.time;
    row.channel = engine.grid().channel[static_cast<std::size_t>(hit.row)];
    row.fan = hit.row / engine.sector().beams();
    row.beam = hit.row % engine.sector().beams();
    row.range_m = hit.range_m;
    row.depth_se_m = se_m;
    row.below_plane_m = hit.below_m;
    const Point<Sonar> level = levelled(hit.place, placement);
    row.depth_m = placement.transducer_depth_m + level.z;
    // Whoever does not know which way the ship lay knows no place.
    if (!std::isnan(at.heading_deg)) {
      const Geographic place = to_geographic(to_enu(level, placement.heading_rad), placement.transducer);
      row.latitude = place.latitude_deg;
      row.longitude = place.longitude_deg;
      if (!raster_ && std::isfinite(place.latitude_deg)) raster_ = std::make_unique<SeabedRaster>(params_, place);
      if (raster_) raster_->add({place, row.depth_m, se_m, static_cast<int>(row.fan)});
    }
    CsvLine line;
    columns(line, row);
    lines += line.text() + "\n";
    ++rows_;
  }
  return table_.write(lines);
}

Result<std::vector<fs::path>> SeabedExport::finish() {
  if (rows_ == 0) {
    return fail(ErrorCode::unsupported,
                "no beam sees the seabed: it is out of reach, or the recipe does not look for it (seabed.enabled)",
                {.file = table_.target().string()});
  }
  std::vector<fs::path> files{table_.target()};
  if (auto whole = table_.commit(); !whole) return pass_on(whole);
  if (raster_ && !raster_->empty()) {
    files.push_back(dest_ / "seabed.tif");
    const std::string about = title_ + ": depth of the seabed, metres below the mean water line, positive down";
    if (auto written = raster_->write(files.back(), about); !written) return pass_on(written);
  }
  return files;
}

}  // namespace sonar
