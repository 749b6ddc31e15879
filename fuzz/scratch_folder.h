// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace sonar::fuzz {

/// A folder of this process for inputs that are read as files; it goes when the process ends. In memory where the system
/// has such a place.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::string& name) {
    namespace fs = std::filesystem;
    const fs::path shared = "/dev/shm";
    std::error_code absent;
    path_ = (fs::is_directory(shared, absent) ? shared : fs::temp_directory_path()) /
            ("sonar_fuzz_" + name + "_" + std::to_string(::getpid()));
    fs::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace sonar::fuzz
