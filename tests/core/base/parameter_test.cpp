// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/parameter.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "occusg/error.hpp"

namespace occusg {
namespace {

TEST(Parameter, NumberOutsideItsRangeIsNotAssigned) {
  double value = 0.5;
  const Parameter parameter = numberParameter(value, {0.0, 1.0}, {"share", "", "A share."});
  for (const char* text : {"-0.001", "1.001", "nan", ".nan", "", "half", "0.5m", "0x1", ".inf"}) {
    EXPECT_FALSE(parameter.assign(text)) << text;
    EXPECT_EQ(value, 0.5) << text;
  }
  EXPECT_TRUE(parameter.assign("1"));
  EXPECT_EQ(value, 1.0);
  EXPECT_EQ(parameter.allowed, "[0, 1]");
}

TEST(Parameter, ValueThatIsNotAllowedIsRefusedWithItsKeyAndRange) {
  double share = 0.5;
  const std::vector<Parameter> table{numberParameter(share, {0.0, 1.0}, {"share", "", "A share."})};
  check(table);
  for (const double wrong : {-0.5, 1.5, std::numeric_limits<double>::quiet_NaN()}) {
    share = wrong;
    EXPECT_FALSE(table.front().holds());
    try {
      check(table);
      FAIL() << wrong;
    } catch (const Error& error) {
      const std::string sentence = error.what();
      EXPECT_NE(sentence.find("share"), std::string::npos) << sentence;
      EXPECT_NE(sentence.find("allowed is [0, 1]"), std::string::npos) << sentence;
    }
  }
}

TEST(Parameter, CountTakesWholeNumbersOnly) {
  int value = 2;
  const Parameter parameter = countParameter(value, {1, 64}, {"stride", "pixels", "Stride."});
  for (const char* text : {"0", "65", "2.5", "1e1", "99999999999999999999"}) {
    EXPECT_FALSE(parameter.assign(text)) << text;
  }
  EXPECT_TRUE(parameter.assign("64"));
  EXPECT_EQ(value, 64);
  EXPECT_EQ(parameter.print(), "64");
}

TEST(Parameter, ChoiceTakesItsNamesOnly) {
  enum class Colour { kRed, kBlue };
  Colour value = Colour::kRed;
  const Parameter parameter = choiceParameter<Colour>(
      value, {{"red", Colour::kRed}, {"blue", Colour::kBlue}}, {"colour", "", "A colour."});
  EXPECT_EQ(parameter.allowed, "red | blue");
  EXPECT_FALSE(parameter.assign("Blue"));
  EXPECT_TRUE(parameter.assign("blue"));
  EXPECT_EQ(value, Colour::kBlue);
  EXPECT_EQ(parameter.print(), "blue");
}

TEST(Parameter, InfinityIsWrittenAsInYaml) {
  const double infinity = std::numeric_limits<double>::infinity();
  double value = 0.0;
  const Parameter parameter = numberParameter(value, {-infinity, infinity}, {"z", "m", "Height."});
  EXPECT_TRUE(parameter.assign("-.inf"));
  EXPECT_EQ(value, -infinity);
  EXPECT_EQ(parameter.print(), "-.inf");
}

TEST(ShortestText, ReadsBackUnchangedAndHasNoNeedlessDigits) {
  EXPECT_EQ(shortestText(0.05), "0.05");
  EXPECT_EQ(shortestText(8.0), "8");
  EXPECT_EQ(shortestText(0.0), "0");
  EXPECT_EQ(shortestText(1000.0), "1000");
  EXPECT_EQ(shortestText(1.0 / 3.0), "0.3333333333333333");
}

TEST(NearestName, IsTheOneWithFewestEdits) {
  EXPECT_EQ(nearestName("strid", {"stripe", "stride", "string"}), "stride");
  EXPECT_EQ(nearestName("anything", {}), "");
  EXPECT_EQ(nearestName("depth.strid", {"perception.depth.stride", "regions.period_s"}),
            "perception.depth.stride");
  EXPECT_EQ(nearestName("foo", {"perception.depth.stride", "regions.period_s"}), "");
  EXPECT_EQ(suggestionFor("evl", {"eval", "run"}), "did you mean 'eval'?");
  EXPECT_EQ(suggestionFor("rnu", {"eval", "run"}), "did you mean 'run'?");
  EXPECT_EQ(suggestionFor("query", {"merge", "run"}), "");
}

}  // namespace
}  // namespace occusg
