// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "base/describe.h"
#include "base/result.h"
#include "base/work.h"
#include "model/product.h"
#include "pipeline/recipe/recipe.h"
#include "pipeline/survey/survey.h"

namespace sonar {

/// What of a survey stays in reduced raw files, beside what decides about the selected schools.
struct ReduceParams {
  int margin_samples = 0;
  int margin_beams = 0;
  int margin_fans = 0;
  int margin_pings = 4;
  int coarsen_beams = 0;
};

template <class Visitor>
void describe(Visitor& v, ReduceParams& p) {
  v.field("margin_samples", p.margin_samples,
          {.unit = "samples",
           .min = 0,
           .max = 100000,
           .text = "How many samples before and after each school are kept beyond what its figures need; raise it to "
                   "look at more of the water around."});
  v.field("margin_beams", p.margin_beams,
          {.unit = "beams",
           .min = 0,
           .max = 100000,
           .text = "How many beams on either side of each school are kept beyond what its figures need; raise it to "
                   "look at more of the water around."});
  v.field("margin_fans", p.margin_fans,
          {.unit = "fans",
           .min = 0,
           .max = 100000,
           .text = "How many fans above and below each school are kept beyond what its figures need; raise it to look "
                   "at more of the water around."});
  v.field("margin_pings", p.margin_pings,
          {.unit = "pings",
           .min = 0,
           .max = 100000,
           .text = "How many pings without the school are kept before and after it; with fewer than 2 its track may "
                   "begin and end differently."});
  v.field("coarsen_beams", p.coarsen_beams,
          {.unit = "beams",
           .min = 0,
           .max = 10000,
           .text = "How many neighbouring beams of a fan are averaged into one in the water away from schools; 0 keeps "
                   "nothing of it and gives the smallest files."});
}

struct ReduceReport {
  std::vector<std::filesystem::path> files;
  std::int64_t pings_before = 0;
  std::int64_t pings_kept = 0;
  std::uint64_t bytes_before = 0;
  std::uint64_t bytes_kept = 0;
};

/// Writes each raw file anew with the selected schools' samples only, under its own name. A school's samples are those
/// that decided about it: the box in which detection looked at it and at its neighbours, widened by half the median's
/// box, and what the corrected sizes look at. What was detected beside schools but became none stays as well, as long as
/// a school's track may meet it. Each beam is cut to its first and last such sample by offset and count;
/// what lies between is the missing value -20000, a faulty sample -32767. Behind the samples stands what was worked out
/// from the whole ping (ReducedRow), so that a run under the same recipe gives the same masks.
/// Pings without schools lose their samples, and all but margin_pings beside a school go. Everything that is no sample
/// (CON0, CON1, NME0, ...) stays, and with it the vessel's track.
/// products  with masks, and with the pings of `survey` as opened by their recipe
/// dest      not the folder of a raw file, nor inside it
/// errors    usage: dest lies with the raw files; mismatch: other pings than the product's; io; no_space; cancelled
[[nodiscard]] Result<ReduceReport> reduce_survey(const SurveyFiles& survey,
                                                 std::span<const ObservationProduct> products, const Recipe& recipe,
                                                 const std::filesystem::path& dest, const ReduceParams& params,
                                                 Work& work);

}  // namespace sonar
