// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/shared_value.h"

// Values as bytes for the user's cache: read on the machine and by the program that wrote them, under a version and a
// checksum of whoever keeps them. A class names its members once, for both ways: fields(io, value) calls io(member) for each.
namespace sonar {

/// For the fields() of one class, constant or not: void fields(auto& io, Archived<PingEntry> auto& ping).
template <class T, class U>
concept Archived = std::is_same_v<std::remove_const_t<T>, U>;

template <class T>
concept ArchivedAsItLies = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Appends values to bytes.
class ArchiveWriter {
 public:
  template <ArchivedAsItLies T>
  void operator()(const T& value) {
    put(&value, sizeof(T));
  }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    put(text.data(), text.size());
  }
  template <class T, std::size_t N>
  void operator()(const std::array<T, N>& values) {
    for (const T& value : values) (*this)(value);
  }
  template <class T>
  void operator()(const std::vector<T>& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const T& value : values) (*this)(value);
  }
  void operator()(const std::vector<bool>& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const bool value : values) (*this)(value);
  }
  template <class T>
  void operator()(const SharedValue<T>& value) {
    (*this)(*value);
  }
  void operator()(const std::map<std::string, std::int64_t>& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const auto& [key, value] : values) {
      (*this)(key);
      (*this)(value);
    }
  }
  template <class T>
    requires std::is_class_v<T>
  void operator()(const T& value) {
    fields(*this, value);
  }
  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void put(const void* data, std::size_t size) {
    const std::size_t at = bytes_.size();
    if (bytes_.capacity() < at + size) bytes_.reserve(2 * (at + size));
    bytes_.resize(at + size);
    std::memcpy(bytes_.data() + at, data, size);
  }
  std::vector<std::byte> bytes_;
};

/// Every read is checked against what is left; after a short one nothing is read any more. Vectors grow as their
/// elements come, so that a wild count allocates nothing.
class ArchiveReader {
 public:
  explicit ArchiveReader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <ArchivedAsItLies T>
  void operator()(T& value) {
    get(&value, sizeof(T));
  }
  /// Any byte but 0 is true: as it lies it would be neither.
  void operator()(bool& value) {
    std::uint8_t byte = 0;
    get(&byte, sizeof(byte));
    value = byte != 0;
  }
  void operator()(std::string& text) {
    text.resize(count());
    get(text.data(), text.size());
  }
  template <class T, std::size_t N>
  void operator()(std::array<T, N>& values) {
    for (T& value : values) (*this)(value);
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    const std::size_t n = count();
    for (std::size_t i = 0; i < n && sound_; ++i) {
      values.emplace_back();
      (*this)(values.back());
    }
  }
  void operator()(std::vector<bool>& values) {
    const std::size_t n = count();
    for (std::size_t i = 0; i < n && sound_; ++i) {
      std::uint8_t value = 0;
      (*this)(value);
      values.push_back(value != 0);
    }
  }
  template <class T>
  void operator()(SharedValue<T>& value) {
    (*this)(value.edit());
  }
  void operator()(std::map<std::string, std::int64_t>& values) {
    const std::size_t n = count();
    for (std::size_t i = 0; i < n && sound_; ++i) {
      std::string key;
      (*this)(key);
      (*this)(values[key]);
    }
  }
  template <class T>
    requires std::is_class_v<T>
  void operator()(T& value) {
    fields(*this, value);
  }
  [[nodiscard]] bool sound() const { return sound_; }
  [[nodiscard]] bool sound_to_the_end() const { return sound_ && bytes_.empty(); }

 private:
  std::size_t count() {
    std::uint64_t n = 0;
    get(&n, sizeof(n));
    if (n > bytes_.size()) sound_ = false;
    return sound_ ? static_cast<std::size_t>(n) : 0;
  }
  void get(void* data, std::size_t size) {
    if (!sound_ || size > bytes_.size()) {
      sound_ = false;
      return;
    }
    if (size > 0) std::memcpy(data, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }
  std::span<const std::byte> bytes_;
  bool sound_ = true;
};

}  // namespace sonar
