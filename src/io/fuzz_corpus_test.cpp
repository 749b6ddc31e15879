// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/test_paths.h"
#include "io/fuzz_bodies.h"
#include "io/fuzz_product.h"
#include "io/fuzz_raster.h"

namespace sonar {
namespace {

namespace fs = std::filesystem;

/// Runs every file of a corpus; expects at least one.
template <class Body>
void replay(const char* target, const Body& body) {
  const fs::path folder = test::source_tree() / "tests/data/fuzz" / target;
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    body(std::string(std::istreambuf_iterator<char>(in), {}));
    ++count;
  }
  EXPECT_GT(count, 0);
}

TEST(FuzzCorpus, SimradRaw) {
  replay("simrad_raw", [](const std::string& bytes) { fuzz::simrad_raw(std::as_bytes(std::span(bytes))); });
}

TEST(FuzzCorpus, Nmea) {
  replay("nmea", [](const std::string& text) { fuzz::nmea(text); });
}

TEST(FuzzCorpus, Con1) {
  replay("con1", [](const std::string& xml) { fuzz::con1(xml); });
}

TEST(FuzzCorpus, Csv) {
  replay("csv", [](const std::string& text) { fuzz::csv(text); });
}

TEST(FuzzCorpus, IndexCache) {
  replay("index_cache", [](const std::string& bytes) { fuzz::index_cache(std::as_bytes(std::span(bytes))); });
}

TEST(FuzzCorpus, SchoolTables) {
  replay("school_tables", [](const std::string& text) { fuzz::school_tables(text); });
}

TEST(FuzzCorpus, Product) {
  const fs::path folder = fs::temp_directory_path() / ("sonar_fuzz_corpus_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const fuzz::ProductFuzz product(folder);
  replay("product", [&](const std::string& bytes) { product(std::as_bytes(std::span(bytes))); });
  fs::remove_all(folder);
}

TEST(FuzzCorpus, ProductBytes) {
  const fs::path folder = fs::temp_directory_path() / ("sonar_fuzz_product_bytes_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  replay("product_bytes", [&](const std::string& bytes) { fuzz::product_bytes(bytes, folder); });
  fs::remove_all(folder);
}

TEST(FuzzCorpus, Wire) {
  replay("wire", [](const std::string& bytes) { fuzz::wire(std::as_bytes(std::span(bytes))); });
}

TEST(FuzzCorpus, DepthRaster) {
  const fs::path folder = fs::temp_directory_path() / ("sonar_fuzz_rasters_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const fuzz::RasterFuzz raster(folder);
  replay("depth_raster", [&](const std::string& bytes) { raster(std::as_bytes(std::span(bytes))); });
  fs::remove_all(folder);
}

}  // namespace
}  // namespace sonar
