// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/export_vtk.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "io/atomic_file.h"
#include "io/vtk_files.h"
#include "pipeline/exports/export_sv.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/placements.h"
#include "pipeline/stages/taken_background.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;
using Masks = std::vector<const SchoolMask*>;

/// Masks that are not rejected by their pings, those that lie within the observation.
std::map<std::int64_t, Masks> masks_by_ping(const ObservationProduct& product) {
  std::map<std::int64_t, Masks> out;
  for (const SchoolMask& mask : product.masks) {
    const auto school = std::ranges::find(product.schools, mask.school_id, &SchoolRow::school_id);
    const bool rejected = school != product.schools.end() && school->status == "rejected";
    const bool inside = mask.ping_index >= 0 && mask.ping_index < std::ssize(product.pings);
    if (!rejected && inside && !mask.mask.empty()) out[mask.ping_index].push_back(&mask);
  }
  return out;
}

struct VtkPing {
  std::int64_t index = 0;
  const Masks& masks;
  const LocalFrame::Ping& into;
  double seconds = 0.0;  ///< after the first ping
};
/// Bytes of a ping's file; empty where it has none.
using PingBytes = std::function<Result<std::string>(const VtkPing& ping)>;

Result<std::vector<fs::path>> write_series(const ObservationProduct& product, const fs::path& dest,
                                           std::string_view ending, const Work& work, const PingBytes& bytes_of) {
  std::vector<fs::path> files;
  const auto frame = LocalFrame::of(product);
  if (!frame || !product.grid) return files;
  const ProductPlacements placements(product);
  std::vector<VtkStep> steps;
  for (const auto& [index, masks] : masks_by_ping(product)) {
    if (work.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
    const PingNavigation& ping = product.pings[static_cast<std::size_t>(index)];
    const auto into = frame->ping(ping, placements.of(ping));
    if (!into) continue;
    const double seconds = static_cast<double>(ping.time - product.pings.front().time) / kSecondNs;
    const auto bytes = bytes_of({index, masks, *into, seconds});
    if (!bytes) return pass_on(bytes);
    if (bytes->empty()) continue;
    steps.push_back({seconds, fmt::format("{}-ping-{:05}.{}", product.observation, index, ending)});
    files.push_back(dest / steps.back().file);
    if (auto written = write_file(files.back(), *bytes); !written) return pass_on(written);
  }
  if (steps.empty()) return files;
  files.push_back(dest / fmt::format("{}.{}.pvd", product.observation, ending));
  if (auto written = write_file(files.back(), pvd_bytes(steps, frame->origin())); !written) return pass_on(written);
  return files;
}

}  // namespace

Result<std::vector<fs::path>> export_vtu(const ObservationProduct& product, const fs::path& dest, const Work& work) {
  if (!product.grid) return std::vector<fs::path>{};
  const Sector sector = product.grid->grid.sector(product.grid->range);
  return write_series(product, dest, "vtu", work, [&](const VtkPing& ping) -> Result<std::string> {
    return vtu_bytes(ping.masks, sector, ping.into, ping.seconds);
  });
}

Result<std::vector<fs::path>> export_vts(const SurveyFiles& survey, const ObservationProduct& product,
                                         const Recipe& recipe, const fs::path& dest, Work& work) {
  if (!product.grid || product.pings.empty()) return std::vector<fs::path>{};
  const auto observation = raw_files_of(survey, product);
  if (!observation) return pass_on(observation);
  Engine engine(survey, **observation, recipe);
  if (auto given = take_background(engine, product, work); !given) return pass_on(given);
  return write_series(product, dest, "vts", work, [&](const VtkPing& ping) -> Result<std::string> {
    work.progress("vts", ping.index + 1, std::ssize(product.pings));
    if (engine.is_bad(ping.index)) return std::string{};
    const auto staged = engine.staged(ping.index);
    if (auto refused = engine.refusal(); !refused) return pass_on(refused);
    if (!staged) return std::string{};
    return vts_bytes({staged->sv.counts.view(), staged->filtered->counts.view()}, ping.masks, engine.sector(),
                     ping.into, ping.seconds);
  });
}

}  // namespace sonar
