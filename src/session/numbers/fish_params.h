// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/describe.h"

namespace sonar {

enum class LengthsFrom : std::uint8_t { mean_and_sd, table };
inline constexpr std::array<std::string_view, 2> kLengthsFromNames{"mean_and_sd", "table"};

/// How the echo of a fish depends on the angle that it is seen at.
enum class AspectModel : std::uint8_t { of_relation, none, own };
inline constexpr std::array<std::string_view, 3> kAspectModelNames{"of_relation", "none", "own"};

/// No fish weighs so little: weights are not told.
inline constexpr double kNoWeight_g = 1e-5;

/// What the fish of a survey are taken to be.
struct FishParams {
  std::string relation = "herring-side";
  LengthsFrom lengths = LengthsFrom::mean_and_sd;
  double mean_length_cm = 28.0;
  double sd_length_cm = 3.0;
  double weight_a_g = kNoWeight_g;
  double weight_b = 3.0;
  std::string species;
  AspectModel aspect = AspectModel::of_relation;
  double line_share = 0.25;
  double any_aspect_share = 0.1;
  double heading_sd_deg = 14.0;
  double tilt_sd_deg = 10.0;
};

template <class Visitor>
void describe(Visitor& v, FishParams& p) {
  v.field("relation", p.relation, {.text = "Target strength by length and depth; its source stands below."});
  v.choice("lengths", p.lengths, kLengthsFromNames,
           "Whether lengths of fish are a normal distribution or those of a table that was opened.");
  v.field("mean_length_cm", p.mean_length_cm,
          {.unit = "cm", .min = 0.5, .max = 500, .text = "Mean length of the fish, cm."});
  v.field("sd_length_cm", p.sd_length_cm,
          {.unit = "cm", .min = 0, .max = 100, .text = "Standard deviation of the lengths, cm."});
  v.field(
      "weight_a_g", p.weight_a_g,
      {.unit = "g", .min = kNoWeight_g, .max = 1, .text = "a of W = a L^b, in grams of cm; at its least, no biomass."});
  v.field("weight_b", p.weight_b, {.unit = "1", .min = 0.1, .max = 10, .text = "b of W = a L^b."});
  v.field("species", p.species, {.text = "Only schools with this word as their species; empty counts all."});
  v.choice("aspect", p.aspect, kAspectModelNames,
           "How the echo depends on the angle between beam and fish: as the relation has it, not at all, or as the "
           "figures below tell.");
  v.field("line_share", p.line_share,
          {.unit = "1", .min = 0.01, .max = 1, .text = "Length of the line that echoes, as a share of the fish."});
  v.field("any_aspect_share", p.any_aspect_share,
          {.unit = "1", .min = 0, .max = 1, .text = "Share of the echo that comes back at any aspect."});
  v.field("heading_sd_deg", p.heading_sd_deg,
          {.unit = "degrees",
           .min = 0,
           .max = 90,
           .text = "Standard deviation of the fish's headings round the course of their school."});
  v.field("tilt_sd_deg", p.tilt_sd_deg,
          {.unit = "degrees", .min = 0, .max = 90, .text = "Standard deviation of the fish's tilt."});
}

}  // namespace sonar
