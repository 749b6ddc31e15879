// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "cli/described_flags.h"
#include "publish/picture_options.h"

namespace sonar {

/// What a user wrote after `render`; texts that need a look of their own stay texts until picture_options().
struct RenderArguments {
  std::string kind;
  std::vector<std::string> paths;
  std::string observation;
  std::string recipe;
  std::string against;  ///< work folder of another reader
  bool quick = false;
  bool whole = false;  ///< of a report: as a PDF too
  std::string out;
  int jobs = 0;

  std::string reference;
  double largest_difference = 8.0;
  double mean_difference = 0.5;
  std::string difference;  ///< file for the picture of what differs

  std::string size = "1200x900";
  bool filtered = false;
  bool unfiltered = false;
  std::string transfer;
  std::string schools;
  PictureOptions picture;
  std::vector<DescribedFlags::Made> suits;  ///< of every option that not all kinds have a use for
};

/// Adds every option of the verb, in groups.
void add_render_options(CLI::App& verb, RenderArguments& arguments);

/// The kind of a single picture: of a movie's, or the kind itself.
[[nodiscard]] std::string drawn_kind_name(const RenderArguments& arguments);

struct UnsuitedOption {
  std::string option;
  std::string why;  ///< with the kinds of picture that it suits
};
/// The first option given that has no effect on this picture; none where all suit.
[[nodiscard]] std::optional<UnsuitedOption> unsuited_option(const CLI::App& verb, const RenderArguments& arguments);

/// What follows from which options were given, once all are known: the plane and the looks that are meant.
/// errors  throws CLI::ValidationError, as the parser does
void settle_options(const CLI::App& verb, RenderArguments& arguments);

/// The texts turned into values.
/// errors  usage, naming the option and what was expected; as read_transfer_function()
[[nodiscard]] Result<PictureOptions> picture_options(const RenderArguments& arguments);

}  // namespace sonar
