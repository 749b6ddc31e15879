// SPDX-License-Identifier: Apache-2.0
#include "pipeline/recipe/json_path.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace sonar {
namespace {

/// Through a text of JSON, as a file has it.
std::filesystem::path there_and_back(const std::filesystem::path& path) {
  const std::string text = nlohmann::json(json_text_of(path)).dump();  // strict: it throws where the text is no UTF-8
  return path_of_json(nlohmann::json::parse(text).get<std::string>());
}

TEST(JsonPath, AnyBytesComeBack) {
  std::string all = "/";
  for (int byte = 1; byte < 256; ++byte) all += static_cast<char>(byte);
  for (const std::string& path : {all, std::string("/cruise/st\xF8r"), std::string("/a%20b/\xFF"), std::string("/%"),
                                  std::string("/cruise/st\u00F8r 1%41"), std::string()}) {
    EXPECT_EQ(there_and_back(path).string(), path);
  }
}

TEST(JsonPath, IsAsAHumanWritesItWhereItCanBe) {
  EXPECT_EQ(json_text_of("/cruise/st\u00F8r 1%41"), "/cruise/st\u00F8r 1%41");
  EXPECT_EQ(json_text_of("/cruise/st\xF8r"), "file:///cruise/st%F8r");
}

TEST(JsonPath, ATextThatIsNoUriIsTakenAsItStands) {
  EXPECT_EQ(path_of_json("file:///a%"), "/a%");
  EXPECT_EQ(path_of_json("file:///a%4"), "/a%4");
  EXPECT_EQ(path_of_json("file:///a%-1b"), "/a%-1b");
}

}  // namespace
}  // namespace sonar
