// SPDX-License-Identifier: Apache-2.0
#include "school/seabed_contact.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/units.h"

namespace sonar {
namespace {

/// Mean of a mask's last samples before the seabed's margin, and of the others.
class Contact {
 public:
  Contact(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const DetectParams& params,
          std::span<const Stretch> freed)
      : sv_(sv), flags_(flags), params_(params), freed_(freed) {}

  void add(const Run& run) {
    const auto counts = sv_.row(run.row);
    const auto flags = flags_.row(run.row);
    int cut = run.end();
    const bool at_seabed =
        run.end() < sv_.shape().samples && any(flags[static_cast<std::size_t>(run.end())] & SampleFlags::seabed);
    const bool is_free = !freed_.empty() && !freed_[static_cast<std::size_t>(run.row)].empty();
    if (at_seabed && !is_free) cut = std::max(run.first_sample, run.end() - params_.min_samples);
    for (int s = run.first_sample; s < run.end(); ++s) {
      const double sv = linear_from_count(counts[static_cast<std::size_t>(s)]);
      (s < cut ? inside_ : beside_) += sv;
      ++(s < cut ? n_inside_ : n_beside_);
    }
  }

  [[nodiscard]] bool rises() const {
    if (n_beside_ == 0) return false;
    if (n_inside_ == 0) return true;
    return beside_ / n_beside_ > linear_from_db(params_.seabed_rise_db) * inside_ / n_inside_;
  }

 private:
  View3<const std::int16_t> sv_;
  View3<const SampleFlags> flags_;
  const DetectParams& params_;
  std::span<const Stretch> freed_;
  double beside_ = 0.0;
  double inside_ = 0.0;
  int n_beside_ = 0;
  int n_inside_ = 0;
};

}  // namespace

bool rises_to_seabed(const PingMask& mask, View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                     const DetectParams& params, std::span<const Stretch> freed) {
  Contact contact(sv, flags, params, freed);
  for (const Run& run : mask.runs) contact.add(run);
  return contact.rises();
}

PingMask free_of_seabed(PingMask mask, View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                        const DetectParams& params, std::span<const Stretch> freed) {
  std::vector<bool> rising(sv.shape().rows(), false);
  bool none = true;
  for (const Run& run : mask.runs) {
    Contact contact(sv, flags, params, freed);
    contact.add(run);
    if (!contact.rises()) continue;
    rising[static_cast<std::size_t>(run.row)] = true;
    none = false;
  }
  if (none) return mask;
  PingMask free;
  auto confidence = mask.confidence.cbegin();
  for (const Run& run : mask.runs) {
    const auto end = confidence + run.count;
    if (!rising[static_cast<std::size_t>(run.row)]) {
      free.runs.push_back(run);
      free.confidence.insert(free.confidence.end(), confidence, end);
    }
    confidence = end;
  }
  const auto least = params.min_free_share * static_cast<double>(mask.voxels());
  return static_cast<double>(free.voxels()) < least ? std::move(mask) : free;
}

}  // namespace sonar
