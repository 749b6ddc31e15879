// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <span>
#include <string>

#include "base/test_corpus.h"
#include "io/fuzz_bodies.h"
#include "io/fuzz_currents.h"
#include "io/fuzz_product.h"
#include "io/fuzz_raster.h"

namespace sonar {
namespace {

TEST(FuzzCorpus, SimradRaw) {
  test::replay("simrad_raw", [](const std::string& bytes) { fuzz::simrad_raw(std::as_bytes(std::span(bytes))); });
}

TEST(FuzzCorpus, Nmea) {
  test::replay("nmea", [](const std::string& text) { fuzz::nmea(text); });
}

TEST(FuzzCorpus, Con1) {
  test::replay("con1", [](const std::string& xml) { fuzz::con1(xml); });
}

TEST(FuzzCorpus, Csv) {
  test::replay("csv", [](const std::string& text) { fuzz::csv(text); });
}

TEST(FuzzCorpus, Evr) {
  test::replay("evr", [](const std::string& text) { fuzz::evr(text); });
}

TEST(FuzzCorpus, Evl) {
  test::replay("evl", [](const std::string& text) { fuzz::evl(text); });
}

TEST(FuzzCorpus, IndexCache) {
  test::replay("index_cache", [](const std::string& bytes) { fuzz::index_cache(std::as_bytes(std::span(bytes))); });
}

TEST(FuzzCorpus, SchoolTables) {
  test::replay("school_tables", [](const std::string& text) { fuzz::school_tables(text); });
}

TEST(FuzzCorpus, LsssWork) {
  test::replay("lsss_work", [](const std::string& text) { fuzz::lsss_work(text); });
}

TEST(FuzzCorpus, Product) {
  const test::CorpusFolder folder("product");
  const fuzz::ProductFuzz product(folder.path());
  test::replay("product", [&](const std::string& bytes) { product(std::as_bytes(std::span(bytes))); });
}

TEST(FuzzCorpus, ProductBytes) {
  const test::CorpusFolder folder("product_bytes");
  test::replay("product_bytes", [&](const std::string& bytes) { fuzz::product_bytes(bytes, folder.path()); });
}

TEST(FuzzCorpus, Currents) {
  const test::CorpusFolder folder("currents");
  test::replay("currents",
               [&](const std::string& bytes) { fuzz::currents(std::as_bytes(std::span(bytes)), folder.path()); });
}

TEST(FuzzCorpus, SealedFile) {
  const test::CorpusFolder folder("sealed");
  test::replay("sealed_file",
               [&](const std::string& bytes) { fuzz::sealed_file(std::as_bytes(std::span(bytes)), folder.path()); });
}

TEST(FuzzCorpus, Wire) {
  test::replay("wire", [](const std::string& bytes) { fuzz::wire(std::as_bytes(std::span(bytes))); });
}

TEST(FuzzCorpus, DepthRaster) {
  const test::CorpusFolder folder("rasters");
  const fuzz::RasterFuzz raster(folder.path());
  test::replay("depth_raster", [&](const std::string& bytes) { raster(std::as_bytes(std::span(bytes))); });
}

}  // namespace
}  // namespace sonar
