// SPDX-License-Identifier: Apache-2.0
#include "render/gl/fold_plan.h"

#include <fmt/format.h>

#include <algorithm>

namespace sonar {
namespace {

constexpr int kChannels = 4;

int divided_up(int value, int by) { return (value + by - 1) / by; }

/// Pieces of at most `limit` samples that share their end samples.
int pieces_of(int size, int limit) { return size <= limit ? 1 : divided_up(size - 1, limit - 1); }

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Cuts one axis; the pieces come out as even as they can, so that little room is wasted.
void cut(FoldPlan& plan, int axis, int limit) {
  plan.pieces[at(axis)] = pieces_of(plan.size[at(axis)], limit);
  plan.length[at(axis)] =
      plan.pieces[at(axis)] == 1 ? plan.size[at(axis)] : divided_up(plan.size[at(axis)] - 1, plan.pieces[at(axis)]) + 1;
}

/// How many pieces of `length` rows fit on top of each other.
int stack_of(int length, int limit) { return std::max(1, limit / (length + 2)); }

/// Lays the pieces out in channels and stacks; false where they do not fit.
bool lay_out(FoldPlan& plan, int limit) {
  const int pieces = plan.pieces[0] * plan.pieces[1] * plan.pieces[2];
  plan.channels = std::min(pieces, kChannels);
  const int stacked = divided_up(pieces, kChannels);
  plan.slots[0] = std::min(stacked, stack_of(plan.length[1], limit));
  plan.slots[1] = divided_up(stacked, plan.slots[0]);
  if (plan.slots[1] > stack_of(plan.length[2], limit)) {
    return false;
  }
  plan.texture = {plan.length[0], plan.slots[0] * plan.pitch(1), plan.slots[1] * plan.pitch(2)};
  return true;
}

struct Piece {
  std::array<int, 3> piece;
};

/// All pieces in the order of their numbers: range fastest, then beam, then fan.
std::vector<Piece> all_pieces(const FoldPlan& plan) {
  std::vector<Piece> out;
  for (int fan = 0; fan < plan.pieces[2]; ++fan) {
    for (int beam = 0; beam < plan.pieces[1]; ++beam) {
      for (int range = 0; range < plan.pieces[0]; ++range) {
        out.push_back({{range, beam, fan}});
      }
    }
  }
  return out;
}

std::size_t offset_of(const FoldPlan& plan, const FoldedPlace& place) {
  const std::size_t row = at(place.texel[2]) * at(plan.texture[1]) + at(place.texel[1]);
  return (row * at(plan.texture[0]) + at(place.texel[0])) * at(plan.channels) + at(place.channel);
}

/// One row of a piece along range, ends repeated.
template <class T>
void copy_row(const FoldPlan& plan, const Piece& piece, int beam, int fan, View3<const T> volume, std::vector<T>& out) {
  const auto index = [&](int axis, int inside) {
    const int stride = plan.length[at(axis)] - 1;
    return std::clamp(piece.piece[at(axis)] * stride + inside, 0, plan.size[at(axis)] - 1);
  };
  const auto row =
      volume.row(index(2, std::clamp(fan, 0, plan.length[2] - 1)), index(1, std::clamp(beam, 0, plan.length[1] - 1)));
  std::size_t target = offset_of(plan, place_of(plan, piece.piece, {0, beam, fan}));
  for (int i = 0; i < plan.length[0]; ++i, target += at(plan.channels)) {
    out[target] = row[at(index(0, i))];
  }
}

}  // namespace

int FoldPlan::border(int axis) const { return slots[static_cast<std::size_t>(axis - 1)] > 1 ? 1 : 0; }

int FoldPlan::pitch(int axis) const { return length[static_cast<std::size_t>(axis)] + 2 * border(axis); }

Result<FoldPlan> plan_folds(const Shape3& shape, int limit) {
  if (shape.fans < 1 || shape.beams < 1 || shape.samples < 1 || limit < 4) {
    return fail(
        ErrorCode::bad_parameter,
        fmt::format("a volume of {} x {} x {} cannot be laid out in textures of {}; expected at least 1 x 1 x 1 "
                    "and 4",
                    shape.fans, shape.beams, shape.samples, limit));
  }
  FoldPlan plan;
  plan.size = {shape.samples, shape.beams, shape.fans};
  for (int axis = 0; axis < 3; ++axis) {
    cut(plan, axis, limit);
  }
  // A piece as long as the limit leaves no room for borders; where a stack is needed, halving it makes the room.
  while (!lay_out(plan, limit)) {
    const int axis = plan.length[2] > limit / 2 - 2 ? 2 : 1;
    const int shorter = (plan.length[at(axis)] + 2) / 2;
    if (shorter < 3 || plan.length[at(axis)] <= limit / 2 - 2) {
      return fail(ErrorCode::unsupported,
                  fmt::format("a volume of {} fans, {} beams and {} samples does not fit into one 3-D texture of {} to "
                              "a side, folded into its channels",
                              shape.fans, shape.beams, shape.samples, limit));
    }
    cut(plan, axis, shorter);
  }
  return plan;
}

FoldedPlace place_of(const FoldPlan& plan, std::array<int, 3> piece, std::array<int, 3> inside) {
  const int number = (piece[2] * plan.pieces[1] + piece[1]) * plan.pieces[0] + piece[0];
  const int slot = number / plan.channels;
  const int slot_1 = slot % plan.slots[0];
  const int slot_2 = slot / plan.slots[0];
  return {{inside[0], slot_1 * plan.pitch(1) + plan.border(1) + inside[1],
           slot_2 * plan.pitch(2) + plan.border(2) + inside[2]},
          number % plan.channels};
}

template <class T>
std::vector<T> folded(const FoldPlan& plan, View3<const T> volume, T fill) {
  std::vector<T> out(at(plan.texture[0]) * at(plan.texture[1]) * at(plan.texture[2]) * at(plan.channels), fill);
  for (const Piece& piece : all_pieces(plan)) {
    for (int fan = -plan.border(2); fan < plan.length[2] + plan.border(2); ++fan) {
      for (int beam = -plan.border(1); beam < plan.length[1] + plan.border(1); ++beam) {
        copy_row(plan, piece, beam, fan, volume, out);
      }
    }
  }
  return out;
}

template std::vector<std::uint8_t> folded(const FoldPlan&, View3<const std::uint8_t>, std::uint8_t);
template std::vector<std::int16_t> folded(const FoldPlan&, View3<const std::int16_t>, std::int16_t);
template std::vector<std::uint16_t> folded(const FoldPlan&, View3<const std::uint16_t>, std::uint16_t);

}  // namespace sonar
