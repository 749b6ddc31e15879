// SPDX-License-Identifier: Apache-2.0
#include "latency_targets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>

namespace sonar::bench {

std::string LatencyTargets::line(const std::string& what, std::vector<double> ms, std::optional<double> target_ms) {
  std::sort(ms.begin(), ms.end());
  const double median = ms[ms.size() / 2];
  std::string out = fmt::format("  {:<62} median {:8.2f} ms   least {:8.2f} ms   9 of 10 within {:8.2f} ms   (n = {})",
                                what, median, ms.front(), ms[ms.size() * 9 / 10], ms.size());
  if (!target_ms) return out;
  ++compared_;
  const bool met = median < *target_ms;
  if (!met) missed_.push_back(what);
  return out + fmt::format("   target {:g} ms: {}", *target_ms, met ? "met" : "MISSED");
}

std::string LatencyTargets::verdict() const {
  if (missed_.empty()) return fmt::format("all {} targets met", compared_);
  return fmt::format("MISSED {} of {} targets: {}", missed_.size(), compared_, fmt::join(missed_, "; "));
}

LatencyArguments latency_arguments(int argc, char** argv) {
  LatencyArguments out;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--check") {
      out.check = true;
    } else {
      out.others.emplace_back(word);
    }
  }
  return out;
}

}  // namespace sonar::bench
