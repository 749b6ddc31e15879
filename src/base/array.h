// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "base/check.h"

namespace sonar {

/// Shape of everything sampled on a sonar's grid; axes always [fan][beam][sample], sample fastest.
struct Shape3 {
  int fans = 0;
  int beams = 0;
  int samples = 0;

  [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(fans) * static_cast<std::size_t>(beams); }
  [[nodiscard]] std::size_t size() const { return rows() * static_cast<std::size_t>(samples); }
  friend bool operator==(const Shape3&, const Shape3&) = default;
};

/// Borrowed, contiguous [fan][beam][sample] array.
template <class T>
class View3 {
 public:
  View3() = default;
  View3(T* data, Shape3 shape) : data_(data), shape_(shape) {}
  template <class U>
    requires(std::is_same_v<const U, T>)
  View3(View3<U> other) : data_(other.data()), shape_(other.shape()) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] const Shape3& shape() const { return shape_; }
  [[nodiscard]] T* data() const { return data_; }
  [[nodiscard]] std::span<T> all() const { return {data_, shape_.size()}; }

  /// The samples of one beam, [sample].
  [[nodiscard]] std::span<T> row(int fan, int beam) const { return row(fan * shape_.beams + beam); }
  /// The samples of row = fan * beams + beam.
  [[nodiscard]] std::span<T> row(int row_index) const {
    const auto samples = static_cast<std::size_t>(shape_.samples);
    return {data_ + static_cast<std::size_t>(row_index) * samples, samples};
  }
  [[nodiscard]] T& operator()(int fan, int beam, int sample) const {
    return row(fan, beam)[static_cast<std::size_t>(sample)];
  }

 private:
  T* data_ = nullptr;
  Shape3 shape_;
};

/// Owned, contiguous [fan][beam][sample] array.
template <class T>
class Array3 {
 public:
  Array3() = default;
  explicit Array3(Shape3 shape, T fill = T{}) : shape_(shape), data_(shape.size(), fill) {}

  [[nodiscard]] const Shape3& shape() const { return shape_; }
  [[nodiscard]] View3<T> view() { return {data_.data(), shape_}; }
  [[nodiscard]] View3<const T> view() const { return {data_.data(), shape_}; }
  [[nodiscard]] std::span<T> all() { return data_; }
  [[nodiscard]] std::span<const T> all() const { return data_; }
  [[nodiscard]] std::span<T> row(int fan, int beam) { return view().row(fan, beam); }
  [[nodiscard]] std::span<const T> row(int fan, int beam) const { return view().row(fan, beam); }
  [[nodiscard]] T& operator()(int fan, int beam, int sample) { return view()(fan, beam, sample); }
  [[nodiscard]] const T& operator()(int fan, int beam, int sample) const { return view()(fan, beam, sample); }

  friend bool operator==(const Array3&, const Array3&) = default;

 private:
  Shape3 shape_;
  std::vector<T> data_;
};

}  // namespace sonar
