// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sonar {

// Batcher's odd-even merges (1968) as straight-line programs of minima and maxima, worked out while compiling. Ranks that
// nobody asks for are pruned: what they alone needed is not computed, and a comparator keeps only the half that is used.

struct MergeStep {
  enum class Kind : std::uint8_t { load, minimum, maximum, store };
  Kind kind = Kind::load;
  std::uint16_t a = 0;      ///< load: input; minimum, maximum, store: a value
  std::uint16_t b = 0;      ///< minimum, maximum: a value; store: output
  std::uint16_t value = 0;  ///< load, minimum, maximum: the value made
};

/// Where a program is thought up: values are inputs, then one for each minimum or maximum.
class MergeSketch {
 public:
  using List = std::vector<int>;

  constexpr explicit MergeSketch(int inputs)
      : operands_(static_cast<std::size_t>(inputs), Operands{}), inputs_(inputs) {}

  [[nodiscard]] constexpr List inputs(int first, int count) const {
    List list;
    for (int i = 0; i < count; ++i) list.push_back(first + i);
    return list;
  }

  /// Sorted list of all values of two sorted lists of any lengths.
  constexpr List merge(const List& a, const List& b) {
    if (a.empty()) return b;
    if (b.empty()) return a;
    if (a.size() == 1 && b.size() == 1) return {minimum(a[0], b[0]), maximum(a[0], b[0])};
    const List even = merge(every_second(a, 0), every_second(b, 0));
    const List odd = merge(every_second(a, 1), every_second(b, 1));
    List merged = {even[0]};
    for (std::size_t i = 0; i < odd.size() || i + 1 < even.size(); ++i) {
      if (i + 1 >= even.size()) {
        merged.push_back(odd[i]);
      } else if (i >= odd.size()) {
        merged.push_back(even[i + 1]);
      } else {
        merged.push_back(minimum(odd[i], even[i + 1]));
        merged.push_back(maximum(odd[i], even[i + 1]));
      }
    }
    return merged;
  }

  constexpr int minimum(int a, int b) { return add({MergeStep::Kind::minimum, a, b}); }
  constexpr int maximum(int a, int b) { return add({MergeStep::Kind::maximum, a, b}); }

  /// The program that stores `outputs`, without what they do not need; inputs are loaded where first used.
  [[nodiscard]] constexpr std::vector<MergeStep> program(const List& outputs) const {
    std::vector<char> needed(operands_.size(), 0);
    for (const int value : outputs) needed[static_cast<std::size_t>(value)] = 1;
    for (std::size_t v = operands_.size(); v-- > static_cast<std::size_t>(inputs_);) {
      if (needed[v] == 0) continue;
      needed[static_cast<std::size_t>(operands_[v].a)] = 1;
      needed[static_cast<std::size_t>(operands_[v].b)] = 1;
    }
    std::vector<MergeStep> steps;
    std::vector<int> name(operands_.size(), -1);
    int names = 0;
    const auto emit = [&](MergeStep::Kind kind, int a, int b, int value) {
      name[static_cast<std::size_t>(value)] = names;
      steps.push_back(
          {kind, static_cast<std::uint16_t>(a), static_cast<std::uint16_t>(b), static_cast<std::uint16_t>(names++)});
    };
    const auto use = [&](int value) {
      if (name[static_cast<std::size_t>(value)] < 0) emit(MergeStep::Kind::load, value, 0, value);
      return name[static_cast<std::size_t>(value)];
    };
    std::vector<int> output(operands_.size(), -1);
    for (std::size_t i = 0; i < outputs.size(); ++i) output[static_cast<std::size_t>(outputs[i])] = static_cast<int>(i);
    const auto store = [&](int value) {
      const int index = output[static_cast<std::size_t>(value)];
      if (index < 0) return;
      steps.push_back(
          {MergeStep::Kind::store, static_cast<std::uint16_t>(use(value)), static_cast<std::uint16_t>(index), 0});
    };
    for (int v = inputs_; v < static_cast<int>(operands_.size()); ++v) {
      if (needed[static_cast<std::size_t>(v)] == 0) continue;
      const Operands& o = operands_[static_cast<std::size_t>(v)];
      const int a = use(o.a);
      const int b = use(o.b);
      emit(o.kind, a, b, v);
      store(v);
    }
    for (int v = 0; v < inputs_; ++v) store(v);
    return steps;
  }

 private:
  struct Operands {
    MergeStep::Kind kind = MergeStep::Kind::load;
    int a = 0;
    int b = 0;
  };

  constexpr int add(Operands o) {
    operands_.push_back(o);
    return static_cast<int>(operands_.size()) - 1;
  }
  static constexpr List every_second(const List& list, std::size_t first) {
    List half;
    for (std::size_t i = first; i < list.size(); i += 2) half.push_back(list[i]);
    return half;
  }

  std::vector<Operands> operands_;
  int inputs_;
};

/// Two sorted lists of M and N values into ranks First .. First + Count - 1 of their merge.
template <int M, int N, int First = 0, int Count = M + N>
struct MergeOf {
  static constexpr int kInputs = M + N;
  static constexpr int kOutputs = Count;
  static constexpr std::vector<MergeStep> program() {
    MergeSketch sketch(M + N);
    const auto merged = sketch.merge(sketch.inputs(0, M), sketch.inputs(M, N));
    return sketch.program({merged.begin() + First, merged.begin() + First + Count});
  }
};

/// Nine values in any order, sorted: three columns of three, then two merges.
struct SortOfNine {
  static constexpr int kInputs = 9;
  static constexpr int kOutputs = 9;
  static constexpr std::vector<MergeStep> program() {
    MergeSketch sketch(9);
    const auto column = [&](int first) { return sketch.merge(sketch.merge({first}, {first + 1}), {first + 2}); };
    const auto left = column(0);
    const auto middle = column(3);
    const auto right = column(6);
    return sketch.program(sketch.merge(sketch.merge(left, middle), right));
  }
};

/// Of sorted lists of M and N values the one of rank M - 1 (the median where M = N + 1): the least of the maxima.
template <int M, int N>
struct MiddleOf {
  static constexpr int kInputs = M + N;
  static constexpr int kOutputs = 1;
  static constexpr std::vector<MergeStep> program() {
    // A set of i values from the first list and M - i from the second, both from the bottom: the largest of the M
    // smallest values is the smallest of these sets' maxima.
    MergeSketch sketch(M + N);
    int least = M - 1;
    for (int i = M - 1; i > 0 && M - i <= N; --i) {
      least = sketch.minimum(least, sketch.maximum(i - 1, M + (M - i) - 1));
    }
    return sketch.program({least});
  }
};

/// Number of a program's steps, and of the values that it makes, loads included.
struct MergeSize {
  std::size_t steps = 0;
  std::size_t values = 0;
};
template <class Program>
inline constexpr MergeSize kSize = [] {
  MergeSize size;
  for (const MergeStep& step : Program::program()) {
    ++size.steps;
    size.values += step.kind != MergeStep::Kind::store ? 1U : 0U;
  }
  return size;
}();

/// A program's steps as constants.
template <class Program>
inline constexpr auto kSteps = [] {
  std::array<MergeStep, kSize<Program>.steps> steps;
  const auto program = Program::program();
  for (std::size_t i = 0; i < steps.size(); ++i) steps[i] = program[i];
  return steps;
}();

}  // namespace sonar
