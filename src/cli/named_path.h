// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace sonar {

// What a validator says of itself is what help shows for the value: --recipe FILE.

/// Refuses an empty path, as of an unset variable of a script: it would stand for the folder the program was started in.
inline CLI::Validator named_path(const std::string& kind = "PATH") {
  return {[](std::string& path) { return path.empty() ? std::string("an empty path names nothing") : std::string(); },
          kind};
}
inline CLI::Validator named_file() { return named_path("FILE"); }

/// The same of a folder that results go to: a dash stands for standard output, which is none.
inline CLI::Validator named_folder() {
  return {[](std::string& path) {
            if (path == "-") return std::string("a folder is meant; nothing of it goes to standard output");
            return path.empty() ? std::string("an empty path names nothing") : std::string();
          },
          "FOLDER"};
}

/// The same of a name: all would be taken for none.
inline CLI::Validator some_name(const std::string& kind = "NAME") {
  return {[](std::string& name) { return name.empty() ? std::string("an empty name names nothing") : std::string(); },
          kind};
}

}  // namespace sonar
