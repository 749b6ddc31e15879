// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/result.h"
#include "view/image.h"

namespace sonar {

/// How far two pictures may differ and still be called equal, in steps of 255 a channel (alpha counted).
struct PictureThresholds {
  double largest = 0.0;  ///< difference of any channel of any pixel
  double mean = 0.0;     ///< over all channels of all pixels
};

/// Figures of a comparison.
struct PictureVerdict {
  bool equal = false;
  int largest = 0;            ///< 0..255
  double mean = 0.0;          ///< 0..255
  std::size_t differing = 0;  ///< pixels with any difference
  int worst_x = 0;            ///< the first pixel, by rows, with the largest difference
  int worst_y = 0;
  std::string text;  ///< one line for people: figures, thresholds, the worst place
};

/// Transparent pixels of the same alpha 0 are equal whatever their colour. Different sizes: not equal.
[[nodiscard]] PictureVerdict compare_pictures(const Image& picture, const Image& reference,
                                              const PictureThresholds& thresholds);

/// Against a PNG file. No reference is a failure: it has to be looked at and put there by a human first.
/// errors  not_found (no such file), io, format
[[nodiscard]] Result<PictureVerdict> compare_with_reference(const Image& picture,
                                                            const std::filesystem::path& reference,
                                                            const PictureThresholds& thresholds);

/// What differs, for a look: the reference pale, differing pixels in red by their amount.
[[nodiscard]] Image difference_picture(const Image& picture, const Image& reference);

}  // namespace sonar
