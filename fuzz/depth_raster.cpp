// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "io/fuzz_raster.h"

namespace {

/// In memory where the system has such a folder: each input is written as a file.
std::filesystem::path make_folder() {
  namespace fs = std::filesystem;
  const fs::path shared = "/dev/shm";
  std::error_code absent;
  fs::path folder = (fs::is_directory(shared, absent) ? shared : fs::temp_directory_path()) /
                    ("sonar_fuzz_raster_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  return folder;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  struct Folder {
    std::filesystem::path path = make_folder();
    ~Folder() { std::filesystem::remove_all(path); }
  };
  static const Folder folder;
  static const sonar::fuzz::RasterFuzz raster(folder.path);
  raster(std::as_bytes(std::span(data, size)));
  return 0;
}
