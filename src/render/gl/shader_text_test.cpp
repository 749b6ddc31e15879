// SPDX-License-Identifier: Apache-2.0
// The shaders' texts by the standard: one driver takes what another refuses.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/test_paths.h"
#include "render/gl/gl_test_variants.h"

namespace sonar {
namespace {

bool succeeds(const std::string& command) {
  return std::system(command.c_str()) == 0;  // NOLINT(concurrency-mt-unsafe): these tests have one thread
}

class ShaderText : public testing::Test {
 protected:
  void SetUp() override {
    if (!succeeds("command -v glslangValidator spirv-val >/dev/null")) {
      GTEST_SKIP() << "no glslangValidator and spirv-val here (tools/setup.sh full)";
    }
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  /// Empty where the Khronos compiler takes every text as it is, and what it makes of each for OpenGL is valid SPIR-V.
  [[nodiscard]] std::string complaints() const {
    const std::string here = folder_.string();
    (void)succeeds("cd " + here +
                   " && for text in *.vert *.frag; do"
                   " { glslangValidator $text && glslangValidator -G --amb --aml -o spv $text &&"
                   " spirv-val --target-env opengl4.5 spv; } >said 2>&1 && ! grep -i warning said ||"
                   " { echo $text; cat said; }; done >complaints 2>&1");
    std::ifstream file(folder_ / "complaints");
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path folder_ = test::scratch_path("-shaders");
};

TEST_F(ShaderText, EveryVariantIsStandardAndMakesValidSpirV) {
  write("hull.vert", hull_shaders().vertex);
  write("hull.frag", hull_shaders().fragment);
  int number = 0;
  for (const RayVariant& variant : gl_test::every_variant()) {
    write("ray-" + std::to_string(number++) + ".frag", ray_shaders(variant).fragment);
  }
  write("whole.vert", ray_shaders({}).vertex);
  EXPECT_EQ(complaints(), "");
}

TEST_F(ShaderText, WhatIsNotStandardIsFound) {
  write("fine.vert", "#version 410 core\nvoid main() { gl_Position = vec4(1.0); }\n");
  // Some drivers take a narrowing without a word.
  write("narrow.frag", "#version 410 core\nout vec4 colour;\nvoid main() { int i = 1.5; colour = vec4(i); }\n");
  const std::string said = complaints();
  EXPECT_TRUE(said.starts_with("narrow.frag")) << said;
}

}  // namespace
}  // namespace sonar
