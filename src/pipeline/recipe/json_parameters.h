// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/describe.h"
#include "base/result.h"
#include "pipeline/recipe/earlier_parameters.h"
#include "pipeline/recipe/json_file.h"

namespace sonar {

/// Visitor that turns a described parameter struct into JSON (keys sorted, defaults filled in).
class JsonWriter {
 public:
  void field(std::string_view name, bool& value, const FieldInfo&) { json_[std::string(name)] = value; }
  void field(std::string_view name, int& value, const FieldInfo&) { json_[std::string(name)] = value; }
  void field(std::string_view name, double& value, const FieldInfo&) { json_[std::string(name)] = value; }
  void field(std::string_view name, std::string& value, const FieldInfo&) { json_[std::string(name)] = value; }
  template <class E>
  void choice(std::string_view name, E& value, ChoiceNames names, const ChoiceInfo&) {
    json_[std::string(name)] = std::string(names[static_cast<std::size_t>(value)]);
  }
  template <class P>
  void group(std::string_view name, P& parameters, std::string_view) {
    JsonWriter inner;
    describe(inner, parameters);
    json_[std::string(name)] = std::move(inner.json_);
  }
  [[nodiscard]] const nlohmann::json& json() const { return json_; }

 private:
  nlohmann::json json_ = nlohmann::json::object();
};

/// Visitor that fills a described parameter struct from JSON. A member that is absent keeps its default; one that is
/// unknown, or of another type, is refused by name; what earlier versions called otherwise, or knew alone, is noted.
class JsonReader {
 public:
  explicit JsonReader(const nlohmann::json& json, std::string prefix = {}) : json_(json), prefix_(std::move(prefix)) {
    if (!json_.is_object()) note(prefix_, "an object");
  }

  void field(std::string_view name, bool& value, const FieldInfo&) {
    if (const auto* found = take(name, &nlohmann::json::is_boolean, "true or false")) value = found->get<bool>();
  }
  void field(std::string_view name, int& value, const FieldInfo&) {
    const auto* found = take(name, &nlohmann::json::is_number_integer, "a whole number");
    if (found == nullptr) return;
    if (const auto whole = whole_number(*found, std::numeric_limits<int>::min(), std::numeric_limits<int>::max())) {
      value = static_cast<int>(*whole);
    } else {
      note(prefix_ + std::string(name), "a whole number of 32 bits");
    }
  }
  void field(std::string_view name, double& value, const FieldInfo&) {
    if (const auto* found = take(name, &nlohmann::json::is_number, "a number")) value = found->get<double>();
  }
  void field(std::string_view name, std::string& value, const FieldInfo&) {
    if (const auto* found = take(name, &nlohmann::json::is_string, "a text")) value = found->get<std::string>();
  }
  template <class E>
  void choice(std::string_view name, E& value, ChoiceNames names, const ChoiceInfo&) {
    const auto* found = take(name, &nlohmann::json::is_string, "a text");
    if (found == nullptr) return;
    const auto text = found->get<std::string>();
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] != text) continue;
      value = static_cast<E>(i);
      return;
    }
    note(prefix_ + std::string(name), fmt::format("one of {}", fmt::join(names, ", ")));
  }
  template <class P>
  void group(std::string_view name, P& parameters, std::string_view) {
    const auto* found = take(name, &nlohmann::json::is_object, "an object");
    if (found == nullptr) return;
    JsonReader inner(*found, prefix_ + std::string(name) + ".");
    describe(inner, parameters);
    inner.finish();
    if (problem_.empty()) problem_ = inner.problem_;
    notes_.insert(notes_.end(), inner.notes_.begin(), inner.notes_.end());
  }

  /// Marks a member as known that is read elsewhere.
  void skip(std::string_view name) { known_.insert(std::string(name)); }
  /// Notes members that nobody asked for; call it last.
  void finish() {
    if (!problem_.empty() || !json_.is_object()) return;
    for (const auto& [key, value] : json_.items()) {
      if (known_.count(key) == 0) {
        if (is_gone_parameter(prefix_ + key)) {
          notes_.push_back(fmt::format("{}{} has no effect any more", prefix_, key));
          continue;
        }
        problem_ = fmt::format("{}{}: no such parameter", prefix_, key);
        return;
      }
    }
  }
  /// A line each on members that are earlier versions'.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
  /// Empty when all went well.
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  using TypeTest = bool (nlohmann::json::*)() const noexcept;
  const nlohmann::json* take(std::string_view name, TypeTest test, std::string_view expected) {
    const std::string key(name);
    known_.insert(key);
    if (!json_.is_object()) return nullptr;
    auto found = json_.find(key);
    if (const std::string earlier(earlier_name(prefix_ + key)); !earlier.empty() && json_.contains(earlier)) {
      known_.insert(earlier);
      notes_.push_back(fmt::format("{}{} is called {}{} now", prefix_, earlier, prefix_, key));
      if (found == json_.end()) found = json_.find(earlier);
    }
    if (found == json_.end()) return nullptr;
    if (((*found).*test)()) return &*found;
    note(prefix_ + key, expected);
    return nullptr;
  }
  void note(const std::string& what, std::string_view expected) {
    if (problem_.empty()) problem_ = fmt::format("{}: expected {}", what.empty() ? "the file" : what, expected);
  }

  const nlohmann::json& json_;
  std::string prefix_;
  std::set<std::string> known_;
  std::string problem_;
  std::vector<std::string> notes_;
};

}  // namespace sonar
