// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "publish/picture_options.h"

namespace sonar {

/// What a user wrote after `render`; texts that need a look of their own stay texts until picture_options().
struct RenderArguments {
  std::string kind;
  std::vector<std::string> paths;
  std::string observation;
  std::string recipe;
  bool quick = false;
  std::string out;
  int jobs = 0;

  std::string reference;
  double largest_difference = 8.0;
  double mean_difference = 0.5;
  std::string difference;  ///< file for the picture of what differs

  std::string size = "1200x900";
  double scale = 1.0;
  std::string map = "ek500";
  bool filtered = false;
  bool unfiltered = false;
  std::string removed = "shown";
  std::string weak = "shown";
  double weak_db = 3.0;
  std::optional<double> low_db;
  std::optional<double> span_db;
  std::string transfer;
  std::string plane_through;
  std::string plane_point;
  std::string plane_normal;
  std::string eye;
  std::string target;
  std::string mode = "accumulate";
  std::string renderer = "auto";
  std::string schools;
  PictureOptions picture;
};

/// Adds every option of the verb, in groups.
void add_render_options(CLI::App& verb, RenderArguments& arguments);

struct UnsuitedOption {
  std::string option;
  std::string why;  ///< with the kinds of picture that it suits
};
/// The first option given that has no effect on this kind of picture; none where all suit.
[[nodiscard]] std::optional<UnsuitedOption> unsuited_option(const CLI::App& verb, const std::string& kind);

/// The texts turned into values.
/// errors  usage, naming the option and what was expected; as read_transfer_function()
[[nodiscard]] Result<PictureOptions> picture_options(const RenderArguments& arguments);

}  // namespace sonar
