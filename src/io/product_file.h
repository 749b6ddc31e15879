// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"
#include "io/atomic_file.h"
#include "model/product.h"

namespace sonar {

/// Writes one observation's product as netCDF-4 (INTERFACES section 4), atomically. Equal products give equal bytes.
/// product  masks sorted by school_id, ping_index with runs inside the grid; a mask without a grid is refused.
///          Without a grid the group /grid stands empty; /mask then has zero runs.
/// errors   io, no_space, usage (as AtomicFile), bad_parameter (a mask that does not fit the grid)
/// threads  any; calls into netCDF take turns
Result<void> write_product(const ObservationProduct& product, const std::filesystem::path& path,
                           Beside beside = Beside::named_folder);

/// Whether a text is an observation's name: obs-0001, with four digits or more. It becomes part of files' names.
[[nodiscard]] bool is_observation_name(std::string_view name);

/// Reads what write_product() writes. Anything else in the file is ignored.
/// The file may be anything: it is parsed in a process that can reach nothing else.
/// errors   not_found, io, format (damaged, or not a product), newer_version, older_version ("run again")
/// threads  any that is not inside_library()
Result<ObservationProduct> read_product(const std::filesystem::path& path);

/// What tells whether a product is still right, read without its arrays.
struct ProductKey {
  std::string observation;
  std::string input_hash;
  std::string recipe_hash;
  std::string stage_versions;
  std::string source;
  std::string recipe_json;
  std::size_t pings = 0;
  TimeNs first_time = 0;  ///< of the first and last ping; 0 = there is none
  TimeNs last_time = 0;
};
/// errors   as read_product()
Result<ProductKey> read_product_key(const std::filesystem::path& path);

}  // namespace sonar
