// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/array.h"
#include "base/result.h"

namespace sonar {

/// How a volume that is longer than a 3-D texture may be is cut into pieces ("folds") that fit, and where each of them
/// lies: the colour channels first, then side by side along the texture's beam axis and its fan axis. Axes in the order
/// of a texture: 0 = range, 1 = beam, 2 = fan.
///
/// Piece i of an axis holds the samples i * stride .. i * stride + length - 1 with stride = length - 1: the last sample
/// of a piece is repeated as the first of the next, so that whatever lies between two neighbours is interpolated inside
/// one piece. Pieces stacked along an axis of the texture each carry a border row before and after, equal to their
/// outermost rows, so that the filter never reaches the neighbour in the stack, whatever its coordinate's rounding.
struct FoldPlan {
  std::array<int, 3> size{};           ///< of the volume
  std::array<int, 3> length{};         ///< samples a piece holds, along each axis
  std::array<int, 3> pieces{1, 1, 1};  ///< along each axis
  int channels = 1;                    ///< 1..4 of the texture's
  std::array<int, 2> slots{1, 1};      ///< pieces stacked along the texture's axes 1 and 2
  std::array<int, 3> texture{};        ///< size of the texture

  [[nodiscard]] bool folded() const { return pieces[0] * pieces[1] * pieces[2] > 1; }
  /// Rows from one piece in a stack to the next, and the border before it.
  [[nodiscard]] int pitch(int axis) const;
  [[nodiscard]] int border(int axis) const;
  friend bool operator==(const FoldPlan&, const FoldPlan&) = default;
};

/// Where a sample lies in the texture.
struct FoldedPlace {
  std::array<int, 3> texel{};
  int channel = 0;
  friend bool operator==(const FoldedPlace&, const FoldedPlace&) = default;
};

/// limit  largest size of a 3-D texture along any axis (2048 and more in OpenGL 4.1)
/// The fewest pieces; range is cut first.
/// errors  bad_parameter: an empty shape; unsupported: it does not fit, whatever the folding
[[nodiscard]] Result<FoldPlan> plan_folds(const Shape3& shape, int limit);

/// Of sample `index` (range, beam, fan) as seen by piece `piece` of each axis; both copies of a repeated sample exist.
[[nodiscard]] FoldedPlace place_of(const FoldPlan& plan, std::array<int, 3> piece, std::array<int, 3> inside);

/// The volume in the texture's layout: texture[2] x texture[1] x texture[0] x channels values; what no sample fills
/// (the short last pieces, unused slots) repeats the nearest sample or is `fill`.
/// T  std::uint8_t, std::int16_t, std::uint16_t
template <class T>
[[nodiscard]] std::vector<T> folded(const FoldPlan& plan, View3<const T> volume, T fill);

}  // namespace sonar
