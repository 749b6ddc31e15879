// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace sonar {

/// Where the user guide lies: installed with this program, or in the tree that it was built in; where it is neither, its place
/// in any source tree.
[[nodiscard]] std::string manual_place();
/// The same of the program with this path.
[[nodiscard]] std::string manual_place(const std::filesystem::path& program);

/// The guide to the desktop: as HTML where it was installed with this program, else the page that it is made from; empty where
/// there is neither.
[[nodiscard]] std::filesystem::path guide_place();
[[nodiscard]] std::filesystem::path guide_place(const std::filesystem::path& program);
/// The same of the tutorial.
[[nodiscard]] std::filesystem::path tutorial_place();
[[nodiscard]] std::filesystem::path tutorial_place(const std::filesystem::path& program);
/// The same of what is new in each version.
[[nodiscard]] std::filesystem::path changes_place();
[[nodiscard]] std::filesystem::path changes_place(const std::filesystem::path& program);

}  // namespace sonar
