#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "weft/core/json.h"

namespace weft {
namespace {

/// What is wrong, behind its place in the file f; empty when nothing is.
std::string fault_of(std::string_view text, int deepest = 3) {
  try {
    parse_json(text, deepest);
  } catch (const JsonFault& fault) {
    return fault.place("f") + " " + fault.what();
  }
  return {};
}

TEST(ParseJson, NestingIsBoundedWhereverItBegins) {
  EXPECT_EQ(fault_of("[[{}]]"), "");
  EXPECT_EQ(fault_of("[[\n[\n[]]]]"), "f:3 JSON nested more than 3 deep");
  EXPECT_EQ(fault_of("{\"a\":" + std::string(10'000'000, '[')), "f:1 JSON nested more than 3 deep");
  EXPECT_EQ(fault_of("[[[]],[[]],[[]]]"), "");
}

TEST(ParseJson, BracketsInTextsDoNotCount) {
  EXPECT_EQ(fault_of(R"(["[[[[[[", "\"[[[[", "\\", [[]]])"), "");
}

TEST(ParseJson, FaultsHaveTheirLine) {
  EXPECT_EQ(fault_of(""), "f:1 is not JSON here");
  EXPECT_EQ(fault_of("{\n\"a\": 1,\n}"), "f:3 is not JSON here");
  EXPECT_EQ(fault_of("]]]]"), "f:1 is not JSON here");
  EXPECT_EQ(fault_of("[1e999]"), "f a number that doubles cannot hold");
  EXPECT_EQ(fault_of("[\"\xff\"]"), "f:1 is not JSON here");
}

TEST(ParseJson, KeysAreThereOnce) {
  EXPECT_EQ(fault_of("{\"a\": 1, \"b\": {\"a\": 2}}"), "");
  EXPECT_EQ(fault_of("[{\"a\": 1}, {\"a\": 1}]"), "");
  EXPECT_EQ(fault_of("{\"a\": {\"b\": 1},\n\"c\": 2,\n\"a\": 3\n\n}"),
            "f:3 the key 'a' is there twice");
  EXPECT_EQ(fault_of("{\"a\": [{\"b\": 1, \"\\u0062\": 2}]}"), "f:1 the key 'b' is there twice");
  // What is no JSON further on comes second.
  EXPECT_EQ(fault_of("{\"a\": 1, \"a\": 2, }"), "f:1 the key 'a' is there twice");
}

TEST(ParseJson, ValuesArriveWhole) {
  EXPECT_EQ(parse_json("{\"a\": [0.1, true, null]}", 3)["a"][0].get<double>(), 0.1);
}

}  // namespace
}  // namespace weft
