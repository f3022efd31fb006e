// SPDX-License-Identifier: BSD-3-Clause
#include "occusg/pipeline/config_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "error_sentence.hpp"
#include "occusg/error.hpp"
#include "temporary_folder.hpp"

namespace occusg {
namespace {

std::string refusalOf(const std::string& yaml) {
  try {
    (void)configFromYaml(yaml, "mine.yaml", PipelineConfig{});
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

std::string textOf(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(ConfigFile, NamedKeysChangeAndTheOthersStay) {
  const PipelineConfig config = configFromYaml(
      "perception:\n  depth:\n    stride: 4\nregions.tracker.min_overlap: 0.3\n", "mine.yaml", {});
  EXPECT_EQ(config.depth.stride, 4);
  EXPECT_EQ(config.tracker.min_overlap, 0.3);
  EXPECT_EQ(config.depth.max_depth_m, PipelineConfig{}.depth.max_depth_m);
}

TEST(ConfigFile, EmptyDocumentIsTheBase) {
  EXPECT_EQ(
      toYaml(configFromYaml("# nothing\n", "mine.yaml", paperConfig()), ConfigComments::kNone),
      toYaml(paperConfig(), ConfigComments::kNone));
}

TEST(ConfigFile, UnknownKeyNamesLineAndNearestKnownOne) {
  EXPECT_EQ(refusalOf("perception:\n  depth:\n    strid: 4\n"),
            "mine.yaml:3: unknown key 'perception.depth.strid'; did you mean "
            "'perception.depth.stride'?");
}

TEST(ConfigFile, NamedPipeIsRefusedAtOnce) {
  const testing::TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.at("pipe.yaml").c_str(), 0600), 0);
  EXPECT_TRUE(testing::tells(testing::sentenceOf([&] { (void)loadConfig(folder.at("pipe.yaml")); }),
                             {"pipe.yaml", "is neither a file nor"}));
}

TEST(ConfigFile, OutputOfACommandIsRead) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const std::string yaml = "perception.depth.stride: 3\n";
  ASSERT_EQ(::write(ends[1], yaml.data(), yaml.size()), static_cast<ssize_t>(yaml.size()));
  ASSERT_EQ(::close(ends[1]), 0);
  EXPECT_EQ(loadConfig("/dev/fd/" + std::to_string(ends[0])).depth.stride, 3);
  EXPECT_EQ(::close(ends[0]), 0);
}

TEST(ConfigFile, ValueOutOfRangeNamesKeyValueAndRange) {
  EXPECT_EQ(refusalOf("mapping:\n  occupancy:\n    max_range_m: -1\n"),
            "mine.yaml:3: mapping.occupancy.max_range_m is '-1'; allowed is [0.001, 100000] m");
}

TEST(ConfigFile, EveryDescriptionOfAParameterStandsOnItsOwn) {
  PipelineConfig config;
  for (const Parameter& parameter : parametersOf(config)) {
    const std::string& text = parameter.description;
    ASSERT_FALSE(text.empty()) << parameter.key;
    EXPECT_EQ(text.back(), '.') << parameter.key;
    for (const char* beginning : {"So ", "Nor ", "Such ", "The same", "Within ", "It ", "Its "})
      EXPECT_NE(text.rfind(beginning, 0), 0U) << parameter.key << ": " << text;
  }
}

TEST(ConfigFile, RuleBetweenTwoKeysNamesBoth) {
  const std::string refusal =
      refusalOf("perception:\n  depth:\n    min_depth_m: 5\n    max_depth_m: 4\n");
  EXPECT_NE(refusal.find("perception.depth.min_depth_m"), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("perception.depth.max_depth_m = 4"), std::string::npos) << refusal;
}

TEST(ConfigFile, KeySetTwiceIsRefused) {
  EXPECT_NE(refusalOf("regions.period_s: 1\nregions.period_s: 2\n").find("mine.yaml:2"),
            std::string::npos);
}

TEST(ConfigFile, WhatIsNotAPlainSettingIsRefusedInOneSentence) {
  const std::string deep(10000, '[');
  for (const std::string& yaml :
       {std::string("just text\n"), std::string("a: [1, 2]\n"), std::string("- a\n- b\n"), deep,
        std::string("a: &x 1\nb: *x\n"), std::string("a: !!int 3\n"), std::string("a: \"b\n"),
        std::string(100000, ' '),
        std::string("a:\n b:\n  c:\n   d:\n    e:\n     f:\n      g:\n"
                    "       h:\n        i:\n         j: 1\n")}) {
    const std::string refusal = refusalOf(yaml);
    EXPECT_EQ(refusal.rfind("mine.yaml", 0), 0U) << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
  }
}

TEST(ConfigFile, MissingFileNamesItselfAndTheShippedNames) {
  try {
    (void)loadConfig("no/such.yaml");
    FAIL() << "a missing file was accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no/such.yaml"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("'paper'"), std::string::npos);
  }
}

TEST(ConfigFile, WrittenConfigurationReadsBackUnchanged) {
  for (const PipelineConfig& config : {PipelineConfig{}, paperConfig()}) {
    const std::string yaml = toYaml(config, ConfigComments::kFull);
    EXPECT_EQ(toYaml(configFromYaml(yaml, "again", {}), ConfigComments::kFull), yaml);
  }
}

TEST(ConfigFile, ShippedFilesAreTheConfigurationsOfTheirNames) {
  const std::string folder = std::string(OCCUSG_TEST_DATA) + "/../../config/";
  EXPECT_EQ(textOf(folder + "default.yaml"), toYaml(loadConfig("default"), ConfigComments::kFull));
  EXPECT_EQ(textOf(folder + "paper.yaml"), toYaml(loadConfig("paper"), ConfigComments::kFull));
}

TEST(ConfigFile, PaperConfigurationHasThePublishedValues) {
  const PipelineConfig paper = loadConfig("paper");
  EXPECT_EQ(paper.occupancy.resolution_m, 0.05);
  EXPECT_EQ(paper.occupancy.max_range_m, 8.0);
  EXPECT_EQ(paper.free_space.min_free_gap_m, 0.3);
  EXPECT_EQ(paper.tracker.min_overlap, 0.2);
  EXPECT_EQ(paper.tracker.guard.max_area_drop, 0.15);
  EXPECT_TRUE(paper.tracker.guard.reject_on_count_alone);
  EXPECT_EQ(paper.graph.maintenance_period_s, 2.0);
  EXPECT_EQ(paper.graph.rooms.promotion, PromotionEvidence::kAnyEntity);
  EXPECT_EQ(paper.detection.cluster_eps_m, 0.05);
  EXPECT_EQ(paper.detection.min_cluster_points, 50);
  EXPECT_EQ(paper.segmenter.min_confidence, 0.7);
  EXPECT_EQ(paper.segmenter.max_iou, 0.45);
  EXPECT_EQ(paper.graph.objects.memory, ObjectMemory::kFirstSight);
}

TEST(Parameters, EveryKeyIsUniqueAndEveryDefaultIsAllowed) {
  PipelineConfig config;
  std::set<std::string> keys;
  for (const Parameter& parameter : parametersOf(config)) {
    EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key;
    EXPECT_TRUE(parameter.assign(parameter.print())) << parameter.key;
    EXPECT_FALSE(parameter.description.empty()) << parameter.key;
  }
}

}  // namespace
}  // namespace occusg
