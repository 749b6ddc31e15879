// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "base/array.h"
#include "base/sample_flags.h"
#include "base/work.h"

namespace sonar {

/// Box of the noise-removing median.
struct MedianParams {
  bool enabled = true;
  int kernel_fans = 3;
  int kernel_beams = 3;
  int kernel_samples = 23;
  double separate_beams_db = 10.0;
};

template <class Visitor>
void describe(Visitor& v, MedianParams& p) {
  v.field("enabled", p.enabled,
          {.text = "Filter Sv with a median over neighbouring samples, beams and fans before schools are selected; "
                   "switch it off to work on unfiltered Sv."});
  v.field("kernel_fans", p.kernel_fans,
          {.unit = "fans",
           .min = 1,
           .max = 63,
           .text = "Number of fans in the median's box, odd; raise it for stronger smoothing."});
  v.field("kernel_beams", p.kernel_beams,
          {.unit = "beams",
           .min = 1,
           .max = 63,
           .text = "Number of beams in the median's box, odd; raise it for stronger smoothing."});
  v.field("kernel_samples", p.kernel_samples,
          {.unit = "samples",
           .min = 1,
           .max = 63,
           .text = "Number of samples along range in the median's box, odd; raise it for stronger smoothing, lower it "
                   "for schools that are thin along range."});
  v.field("separate_beams_db", p.separate_beams_db,
          {.unit = "dB",
           .min = 0,
           .max = 60,
           .text = "The median runs along range alone where neighbouring beams and fans hear a target on a beam's axis "
                   "weaker by more than this; lower it if schools of two or three beams are filtered away, raise it "
                   "for stronger smoothing."});
}

/// Median of one ping over a box-shaped neighbourhood; flagged samples are left out.
/// The bounding box of samples that are not near field, surface or "no data" is cut out first and its border
/// replicated. In it, samples with a flag of kNotFiltered and "no data" are replaced by -32767 where fan + beam +
/// sample is even and by +32767 where it is odd, which leaves the median of the others to within a rank.
/// in      sv [fan][beam][sample], Sv counts (10 log10(2)/256 dB re 1 m^-1), kNoData or kMinCount..kMaxCount;
///         flags, same shape
/// params  kernel: odd counts, 1..63 per axis; an even one counts as the next larger odd one
/// out     same shape and unit; kNoData outside the bounding box, where more than half of the box is left out, and
///         where the sample itself is near field, surface or seabed. Not enabled: counts with those samples set to
///         kNoData
/// errors  none; parameters were refused earlier by validate()
/// threads pure; same bits for any thread count
/// cost    about 3 ms for 20 x 25 x 1320 samples on one core with 3 x 3 x 23 (also x 7, x 15); 30 ms for others
/// source  Balabanian et al. 2007, section 4.3; masked by a checkerboard of infinities
[[nodiscard]] Array3<std::int16_t> median(View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                          const MedianParams& params, Work& work);

/// The same on the calling thread alone, into an array of the caller's; for callers that share out whole pings.
/// Scratch memory is kept by the thread and used again.
void median_into(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const MedianParams& params,
                 View3<std::int16_t> out);

/// The definition above written down plainly, sample by sample: slow, the proof of the others.
[[nodiscard]] Array3<std::int16_t> median_reference(View3<const std::int16_t> sv, View3<const SampleFlags> flags,
                                                    const MedianParams& params);

/// Forces one of the two fast ways, for tests and benchmarks; the network takes 3 x 3 x {7, 15, 23} only.
enum class MedianMethod { automatic, histogram, network };
[[nodiscard]] bool has_network(const MedianParams& params);
void median_into(View3<const std::int16_t> sv, View3<const SampleFlags> flags, const MedianParams& params,
                 MedianMethod method, Work* work, View3<std::int16_t> out);

}  // namespace sonar
