// SPDX-License-Identifier: Apache-2.0
#include "pipeline/journal/json_value.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace sonar {

JsonValue::JsonValue() : JsonValue(nlohmann::json::object()) {}
JsonValue::JsonValue(nlohmann::json value) : value_(std::make_unique<nlohmann::json>(std::move(value))) {}
JsonValue::JsonValue(const JsonValue& other) : JsonValue(*other) {}
JsonValue& JsonValue::operator=(const JsonValue& other) {
  if (this != &other) value_ = std::make_unique<nlohmann::json>(*other);
  return *this;
}
JsonValue::JsonValue(JsonValue&& other) noexcept = default;
JsonValue& JsonValue::operator=(JsonValue&& other) noexcept = default;
JsonValue::~JsonValue() = default;

bool operator==(const JsonValue& a, const JsonValue& b) { return *a == *b; }

}  // namespace sonar
