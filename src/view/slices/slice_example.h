// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/units.h"
#include "view/slices/slice_picture.h"

namespace sonar::slice_example {

inline std::vector<double> radians(std::vector<double> degrees) {
  for (double& d : degrees) d = rad_from_deg(d);
  return degrees;
}

inline std::vector<double> even_deg(double first, double step, int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(first + step * i);
  return out;
}

struct Named {
  std::string name;
  Sector sector;
};

/// Grids as they come: port and starboard, even and uneven, across the bow, all round, one fan, one beam.
inline std::vector<Named> sectors() {
  const RangeAxis range{-1.0, 2.0, 101};
  return {
      {"port", Sector(radians(even_deg(-40, 5, 8)), radians(even_deg(242.5, 5, 11)), range)},
      {"uneven",
       Sector(radians({-44, -36, -30, -21, -15, -11, -4}), radians({240, 243, 251, 256, 270, 271, 279}), range)},
      {"starboard", Sector(radians(even_deg(-40, 5, 8)), radians(even_deg(62.5, 5, 11)), range)},
      {"across the bow", Sector(radians(even_deg(-30, 10, 3)), radians(even_deg(340, 8, 6)), range)},
      {"all round", Sector(radians({-10.0}), radians(even_deg(0, 6, 60)), {0.0, 2.0, 100})},
      {"one beam", Sector(radians(even_deg(-40, 5, 8)), radians({270.0}), range)},
  };
}

/// 8 fans of 10 degrees, 7 beams of 10 degrees about abeam to port, shells of 5 m: easy to work by hand.
inline Sector hand_sector() {
  return Sector(radians(even_deg(-70, 10, 8)), radians(even_deg(240, 10, 7)), {0.0, 5.0, 41});
}

/// One of its voxels, and the slice from above through it.
inline const Voxel kLit{4, 3, 20};
inline const SliceView kTop{TopSlice{4}};

/// Volume with one value everywhere but in one voxel.
struct LitVolume {
  Array3<std::int16_t> sv;
  Array3<SampleFlags> flags;
  LitVolume(const Sector& sector, const Voxel& lit, double lit_db, double rest_db)
      : sv({sector.fans(), sector.beams(), sector.range().count}, counts(rest_db)),
        flags({sector.fans(), sector.beams(), sector.range().count}) {
    sv(lit.fan, lit.beam, lit.sample) = counts(lit_db);
  }
  static std::int16_t counts(double db) { return static_cast<std::int16_t>(std::lround(counts_from_db(db))); }
  [[nodiscard]] SliceData data() const { return {sv.view(), flags.view(), {}}; }
};

/// All texts of a picture.
inline std::vector<std::string> texts_of(const SlicePicture& picture) {
  std::vector<std::string> texts;
  for (const auto& item : picture.frame.items) {
    if (const auto* text = std::get_if<TextItem>(&item)) texts.push_back(text->text);
  }
  return texts;
}

}  // namespace sonar::slice_example
