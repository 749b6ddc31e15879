// SPDX-License-Identifier: Apache-2.0
#include "pipeline/exports/export_sv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "io/sv_file.h"
#include "pipeline/journal/earlier.h"
#include "pipeline/stages/engine.h"
#include "pipeline/stages/observe.h"
#include "pipeline/stages/taken_background.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = 256U << 20U;  ///< of a file's arrays, unpacked: it is made in memory
constexpr std::size_t kBytesOfVoxel = 2 + 2 + 1 + 4 + 1;

using Staged = std::optional<Result<StagedPing>>;

/// Stages pings side by side and writes them one after the other.
class SvExport {
 public:
  SvExport(Engine& engine, const ObservationProduct& product, Work& work)
      : engine_(engine), product_(product), work_(work) {}

  Result<void> write(SvFile& file, std::size_t first, std::size_t end) {
    const std::size_t at_once = 2 * static_cast<std::size_t>(std::max(1, work_.threads()));
    for (std::size_t block = first; block < end; block += at_once) {
      std::vector<Staged> staged(std::min(at_once, end - block));
      work_.for_each(static_cast<std::int64_t>(staged.size()), [&](std::int64_t i) {
        const auto ping = static_cast<std::int64_t>(block) + i;
        if (!engine_.is_bad(ping)) staged[static_cast<std::size_t>(i)] = engine_.staged(ping);
      });
      if (work_.cancelled()) return fail(ErrorCode::cancelled, "stopped on request");
      if (auto refused = engine_.refusal(); !refused) return refused;
      for (std::size_t i = 0; i < staged.size(); ++i) write_one(file, block + i, staged[i]);
      work_.progress("sv", static_cast<std::int64_t>(block + staged.size()), std::ssize(product_.pings));
    }
    return {};
  }

 private:
  /// A ping that is bad, or damaged, holds no data: as of a beam that was not recorded.
  void write_one(SvFile& file, std::size_t ping, const Staged& staged) {
    if (staged && *staged) {
      const StagedPing& s = **staged;
      file.write(ping,
                 {s.sv.counts.view(), s.filtered->counts.view(), s.sv.flags.view(), s.calibration, s.background_db});
      table_ = s.calibration;
      return;
    }
    const Shape3 shape{engine_.sector().fans(), engine_.sector().beams(), engine_.sector().range().count};
    const Array3<std::int16_t> nothing(shape, kNoData);
    const Array3<SampleFlags> dropout(shape, SampleFlags::dropout);
    if (table_ == nullptr) table_ = std::make_shared<const Array3<std::int16_t>>(shape, kNoData);
    file.write(ping, {nothing.view(), nothing.view(), dropout.view(), table_, {}});
  }

  Engine& engine_;
  const ObservationProduct& product_;
  Work& work_;
  CalibrationTables::Table table_;  ///< of the ping before
};

}  // namespace

Result<const ObservationFiles*> raw_files_of(const SurveyFiles& survey, const ObservationProduct& product) {
  const ObservationFiles* observation = survey.find(product.observation);
  if (observation != nullptr && has_pings(product, source_of(*observation), datagram_times(survey, *observation))) {
    return observation;
  }
  return fail(ErrorCode::mismatch,
              fmt::format("{}: the raw files have no observation of these pings", product.observation));
}

Result<std::vector<fs::path>> export_sv(const SurveyFiles& survey, const ObservationProduct& product,
                                        const Recipe& recipe, const fs::path& dest, Work& work) {
  std::vector<fs::path> files;
  if (!product.grid || product.pings.empty()) return files;
  const auto observation = raw_files_of(survey, product);
  if (!observation) return pass_on(observation);
  Engine engine(survey, **observation, recipe);
  if (auto given = take_background(engine, product, work); !given) return pass_on(given);
  const GridRecord& grid = *product.grid;
  const std::size_t voxels = grid.grid.channel.size() * static_cast<std::size_t>(grid.range.count);
  const std::size_t pings = product.pings.size();
  const std::size_t of_file =
      std::clamp<std::size_t>(kMostBytes / std::max<std::size_t>(1, voxels * kBytesOfVoxel), 1, pings);
  SvExport writer(engine, product, work);
  for (std::size_t first = 0; first < pings; first += of_file) {
    const std::string part = of_file < pings ? fmt::format("-{:03}", first / of_file + 1) : "";
    const std::size_t end = std::min(pings, first + of_file);
    files.push_back(dest / fmt::format("{}-sv{}.nc", product.observation, part));
    SvFile file(files.back(), product, first, end - first);
    if (auto written = writer.write(file, first, end); !written) return pass_on(written);
    if (auto finished = file.finish(); !finished) return pass_on(finished);
  }
  return files;
}

}  // namespace sonar
