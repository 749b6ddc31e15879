// SPDX-License-Identifier: Apache-2.0
#include "targets.h"

#include <fmt/format.h>

#include <utility>

namespace sonar::bench {

void Targets::at_least(const std::string& what, double least, double measured) {
  require(measured >= least, fmt::format("{}: target {:.4g}, measured {:.4g}", what, least, measured));
}

void Targets::beside(const std::string& what, double target, double measured) {
  news_.push_back(fmt::format("{}: target {:.4g}, measured {:.4g} (not guarded)", what, target, measured));
}

void Targets::require(bool holds, const std::string& what) {
  ++guarded_;
  if (holds) return;
  ++failed_;
  news_.push_back("FAILED: " + what);
}

void Targets::skip(const std::string& what, const std::string& why) {
  skipped_.push_back(fmt::format("{}: {}", what, why));
  news_.push_back("not compared: " + skipped_.back());
}

void Targets::cpu_beside_naive(bool dense, double times_as_fast, double psnr_db) {
  at_least("times as fast as the naive shader", dense ? 8.0 : 12.0, times_as_fast);
  if (dense) at_least("dB on a dense scene", 54.0, psnr_db);
}

void Targets::cpu_beside_vtk(bool dense, double times_as_fast, double psnr_db, double vtk_psnr_db) {
  require(psnr_db > vtk_psnr_db,
          fmt::format("{:.1f} dB, and VTK {:.1f}: not the better picture", psnr_db, vtk_psnr_db));
  if (!dense) at_least("times as fast as VTK", 25.0, times_as_fast);
}

void Targets::gl_beside_naive(bool dense, double times_as_fast) {
  at_least("OpenGL back-end, times as fast as the naive shader", 1.0, times_as_fast);
  if (!dense) beside("OpenGL back-end, times as fast as the naive shader", 4.0, times_as_fast);
}

std::vector<std::string> Targets::news() { return std::exchange(news_, {}); }

std::vector<std::string> Targets::verdict() const {
  std::vector<std::string> lines;
  lines.push_back(failed_ > 0 ? fmt::format("FAILED: {} of {} checks, see above", failed_, guarded_)
                              : fmt::format("all {} checks passed", guarded_));
  if (skipped_.empty()) return lines;
  lines.push_back(fmt::format("{} comparisons were not made:", skipped_.size()));
  for (const std::string& line : skipped_) lines.push_back("  " + line);
  return lines;
}

}  // namespace sonar::bench
