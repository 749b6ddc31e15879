// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/time.h"
#include "io/product_file.h"
#include "model/product.h"
#include "pipeline/journal/school_numbers.h"
#include "pipeline/tasks/plan.h"

namespace sonar {

/// Holds on to every product of OUT/products that the plan calls for anew, in OUT/earlier (a link, or a copy where the
/// disk has no links): display names shift when a file is added, so that one task may overwrite what another keeps its
/// school numbers from. Called before plan.json is written.
/// errors  io, no_space
[[nodiscard]] Result<void> set_aside(const std::filesystem::path& out, const Plan& plan);

/// Holds on to one product, under OUT/earlier.
/// errors  io, no_space
[[nodiscard]] Result<void> hold(const std::filesystem::path& out, const std::filesystem::path& product,
                                const ProductKey& key);

/// The products in OUT/earlier. Which one a task finds does not depend on what other tasks have done.
/// threads  const members from any
class EarlierProducts {
 public:
  /// Looks at what is there; files that are no sound products are passed over.
  explicit EarlierProducts(const std::filesystem::path& out);

  /// Schools of the products that have any of these pings, that with the most of them first (of several such the one
  /// with the highest next_school_id); empty where there is none.
  /// source  ObservationProduct::source; times: datagram times, rising
  [[nodiscard]] std::optional<EarlierSchools> schools_of(const std::string& source,
                                                         std::span<const TimeNs> times) const;
  /// The product with exactly these pings.
  [[nodiscard]] std::optional<ObservationProduct> of_pings(const std::string& source,
                                                           std::span<const TimeNs> times) const;

 private:
  struct Entry {
    std::filesystem::path path;
    std::string source;
    TimeNs first = 0;  ///< datagram times
    TimeNs last = 0;
  };
  [[nodiscard]] std::vector<ObservationProduct> with_pings(const std::string& source,
                                                           std::span<const TimeNs> times) const;
  std::vector<Entry> entries_;
};

/// Whether a product holds exactly these pings.
[[nodiscard]] bool has_pings(const ObservationProduct& product, const std::string& source,
                             std::span<const TimeNs> times);

/// What the product's recipe added to the datagrams' times; 0 where it does not say.
[[nodiscard]] double time_offset_s(const std::string& recipe_json);

/// Lets go of products in OUT/earlier that begin and end inside these finished ones. What no product has any more stays,
/// for its files may come back; so does what places choices that no voxel of a finished one does.
void forget_superseded(const std::filesystem::path& out, const std::vector<ObservationProduct>& finished);

}  // namespace sonar
