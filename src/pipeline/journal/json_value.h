// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>

namespace sonar {

/// A JSON value held elsewhere, so that those who only carry it along need not know what JSON is made of: half of the time
/// that the windows' models took to compile went there. A new one is an empty object; one that was moved from can
/// be assigned to and nothing else.
class JsonValue {
 public:
  JsonValue();
  explicit JsonValue(nlohmann::json value);
  JsonValue(const JsonValue& other);
  JsonValue& operator=(const JsonValue& other);
  JsonValue(JsonValue&& other) noexcept;
  JsonValue& operator=(JsonValue&& other) noexcept;
  ~JsonValue();

  [[nodiscard]] nlohmann::json& operator*() { return *value_; }
  [[nodiscard]] const nlohmann::json& operator*() const { return *value_; }
  [[nodiscard]] nlohmann::json* operator->() { return value_.get(); }
  [[nodiscard]] const nlohmann::json* operator->() const { return value_.get(); }
  friend bool operator==(const JsonValue& a, const JsonValue& b);

 private:
  std::unique_ptr<nlohmann::json> value_;
};

}  // namespace sonar
