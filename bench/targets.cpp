// SPDX-License-Identifier: Apache-2.0
#include "targets.h"

#include <fmt/format.h>

#include <utility>

namespace sonar::bench {
namespace {

constexpr double kDensePsnr_db = 54.0;

}  // namespace

void Targets::at_least(const std::string& what, double least, double measured) {
  compare(measured >= least, fmt::format("{}: target {:.4g}, measured {:.4g}", what, least, measured));
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

void Targets::at_most(const std::string& what, double most, double measured) {
  compare(measured <= most, fmt::format("{}: target {:.4g} at most, measured {:.4g}", what, most, measured));
}

void Targets::compare(bool met, const std::string& line) {
  ++guarded_;
  if (!met) ++failed_;
  news_.push_back(line + (met ? ": met" : ": MISSED"));
}

void Targets::better(const std::string& whose, double psnr_db, const std::string& rival, double rival_psnr_db) {
  require(psnr_db > rival_psnr_db,
          fmt::format("{}{:.1f} dB, and {} {:.1f}: not the better picture", whose, psnr_db, rival, rival_psnr_db));
}

void Targets::cpu_beside_naive(bool dense, double times_as_fast, double psnr_db, double naive_psnr_db) {
  at_least("times as fast as the naive shader", dense ? 8.0 : 12.0, times_as_fast);
  if (dense) {
    at_least("dB on a dense scene", kDensePsnr_db, psnr_db);
  } else {
    better("", psnr_db, "the naive shader", naive_psnr_db);
  }
}

void Targets::cpu_beside_vtk(bool dense, double times_as_fast, double psnr_db, double vtk_psnr_db) {
  better("", psnr_db, "VTK", vtk_psnr_db);
  if (!dense) at_least("times as fast as VTK", 25.0, times_as_fast);
}

void Targets::gl_beside_naive(bool dense, double times_as_fast, double psnr_db, double naive_psnr_db) {
  at_least("OpenGL back-end, times as fast as the naive shader", dense ? 1.0 : 4.0, times_as_fast);
  if (dense) {
    at_least("OpenGL back-end, dB on a dense scene", kDensePsnr_db, psnr_db);
  } else {
    better("OpenGL back-end, ", psnr_db, "the naive shader", naive_psnr_db);
  }
}

void Targets::dragging(double wall_s) { at_most("a frame while dragging, ms", 65.0, 1e3 * wall_s); }

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
