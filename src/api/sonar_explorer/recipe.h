// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace sonar {
struct Recipe;
}

namespace sonar_explorer {

/// Every parameter of every stage; a value that does not change.
/// threads  any
class Recipe {
 public:
  /// The preset "default".
  Recipe();
  explicit Recipe(std::shared_ptr<const sonar::Recipe> own) : own_(std::move(own)) {}

  /// name    "default", or "paper": the article of 2007 to the letter
  /// throws  Error: usage
  [[nodiscard]] static Recipe preset(const std::string& name);
  /// throws  Error: format, bad_parameter
  [[nodiscard]] static Recipe from_json(const std::string& text);
  /// throws  Error: also not_found, io
  [[nodiscard]] static Recipe from_file(const std::filesystem::path& file);

  /// All parameters, defaults filled in, keys sorted.
  [[nodiscard]] std::string to_json() const;
  /// Equal recipes have equal hashes.
  [[nodiscard]] std::string hash() const;
  /// A recipe that differs from this one in one value.
  /// name    path of the parameter, "detect.tolerance_db"
  /// value   as it stands in JSON: "8.5", "true", "\"paper\""
  /// throws  Error: bad_parameter: no such parameter, or out of its range; format: no JSON
  [[nodiscard]] Recipe with(const std::string& name, const std::string& value) const;

  /// On parameters that its text named as earlier versions did, or that have no effect any more, a line each.
  [[nodiscard]] const std::vector<std::string>& notes() const;

  [[nodiscard]] const sonar::Recipe& own() const { return *own_; }

 private:
  std::shared_ptr<const sonar::Recipe> own_;
};

}  // namespace sonar_explorer
