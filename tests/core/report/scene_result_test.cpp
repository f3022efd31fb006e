// SPDX-License-Identifier: BSD-3-Clause
#include "report/scene_result.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "error_sentence.hpp"
#include "report/report_page.hpp"
#include "report/results_files.hpp"
#include "rooms.hpp"
#include "temporary_folder.hpp"

namespace occusg {
namespace {

using testing::tells;
using testing::TemporaryFolder;

constexpr const char* kTwoRooms =
    R"({"rooms": [{"id": 1, "label": "kitchen", "polygon": [[0,0],[4,0],[4,4],[0,4]]},
                  {"id": 2, "label": "<hall>", "polygon": [[4,0],[8,0],[8,4],[4,4]]}],
        "doors": [{"rooms": [1, 2], "segment": [[4, 1], [4, 2]]}],
        "objects": [{"id": 1, "label": "sofa", "bbox": [[1,1,0],[2,2,1]], "room": 1}]})";
constexpr const char* kGraph =
    R"({"nodes": [{"id": 40, "type": "ROOM", "name": "room_1"},
                  {"id": 7, "type": "OBJECT", "class": "couch", "position": [1.5, 1.5, 0.4]}],
        "edges": [{"type": "ROOM_CONTAINS", "source": 40, "target": 7}]})";
constexpr const char* kDone =
    R"({"format": "occusg-batch-run", "version": 1, "recording": "/r", "status": "done",
        "problem": "", "seconds": 2})";

SceneResult resultIn(const TemporaryFolder& folder) {
  return evaluateScene(readSceneFolder(folder.path(), "ours", "flat"), {}, std::nullopt);
}

TEST(SceneResult, PerfectSceneScoresOneInEverything) {
  const TemporaryFolder folder;
  folder.write("run.json", kDone);
  folder.write("rooms.json", kTwoRooms);
  folder.write("truth.json", kTwoRooms);
  folder.write("scene_graph.json", kGraph);
  const SceneResult result = resultIn(folder);
  ASSERT_TRUE(result.metrics.has_value());
  EXPECT_EQ(result.metrics->at[2].f1, 1.0);
  EXPECT_EQ(result.adjacency.f1(), 1.0);
  EXPECT_EQ(result.doors.f1(), 1.0);
  ASSERT_TRUE(result.objects.has_value());
  EXPECT_EQ(result.objects->containment(), 1.0);
  EXPECT_TRUE(result.notes.empty());
}

TEST(SceneResult, OnlySeenRoomsCountAsObserved) {
  const TemporaryFolder folder;
  folder.write("run.json", kDone);
  folder.write("rooms.json", kTwoRooms);
  folder.write("truth.json", kTwoRooms);
  // 4 x 4 cells of 1 m over the left room; white is free.
  folder.write("free_space.pgm", "P5 4 4 255\n" + std::string(16, '\xfe'));
  folder.write("free_space.yaml",
               "image: free_space.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\n"
               "occupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const SceneResult result = resultIn(folder);
  ASSERT_TRUE(result.observed.has_value());
  EXPECT_EQ(result.observed->n_unseen, 1U);
  EXPECT_EQ(result.observed->metrics.at[0].recall, 1.0);
  EXPECT_EQ(result.observed->metrics.at[0].precision, 0.5);
  EXPECT_EQ(result.metrics->n_truth, 2U) << "the paper's protocol stays as it is";
}

TEST(SceneResult, FailedRunFoundNothing) {
  const TemporaryFolder folder;
  folder.write("run.json",
               R"({"format": "occusg-batch-run", "version": 1, "recording": "/r",
                   "status": "failed", "problem": "ended by signal 11", "seconds": 2})");
  folder.write("truth.json", kTwoRooms);
  const SceneResult result = resultIn(folder);
  EXPECT_EQ(result.run.status, RunStatus::kFailed);
  ASSERT_TRUE(result.metrics.has_value());
  EXPECT_EQ(result.metrics->at[0].f1, 0.0);
  EXPECT_TRUE(result.metrics->no_predictions);
}

TEST(SceneResult, BrokenPredictionIsAFailureWithItsSentence) {
  const TemporaryFolder folder;
  folder.write("run.json", kDone);
  folder.write("rooms.json", R"({"rooms": [{"id": 1, "polygon": [[0,0],[1,null],[1,1]]}]})");
  folder.write("truth.json", kTwoRooms);
  const SceneResult result = resultIn(folder);
  EXPECT_EQ(result.run.status, RunStatus::kFailed);
  EXPECT_TRUE(tells(result.run.problem, {"rooms.json", "room 1", "null"}));
}

TEST(SceneResult, BrokenTruthIsANoteAndLeavesTheSceneOut) {
  const TemporaryFolder folder;
  folder.write("run.json", kDone);
  folder.write("rooms.json", kTwoRooms);
  folder.write("truth.json", R"({"rooms": [{"id": 8, "polygon": [[0,0],[4,4],[4,0],[0,4]]}]})");
  const SceneResult result = resultIn(folder);
  EXPECT_FALSE(result.metrics.has_value());
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_TRUE(tells(result.notes[0], {"flat", "room 8"}));
}

TEST(SceneResult, WhatWasNotRunIsMissingAndNotScored) {
  const TemporaryFolder folder;
  folder.write("truth.json", kTwoRooms);
  const SceneResult result = resultIn(folder);
  EXPECT_EQ(result.run.status, RunStatus::kMissing);
  EXPECT_FALSE(result.metrics.has_value());
}

/// One perfect scene, one without truth, one that failed.
BatchResults mixedScenes() {
  BatchResults batch{{"ours"}, {"flat", "hall", "wreck"}, "none", {}};
  const TemporaryFolder good, blind, wreck;
  for (const TemporaryFolder* folder : {&good, &blind}) {
    folder->write("run.json", kDone);
    folder->write("rooms.json", kTwoRooms);
  }
  good.write("truth.json", kTwoRooms);
  wreck.write("truth.json", kTwoRooms);
  wreck.write("run.json", R"({"format": "occusg-batch-run", "version": 1, "recording": "/r",
                              "status": "timed out", "problem": "a, \"b\" & <c>", "seconds": 2})");
  for (const auto& [folder, scene] :
       {std::pair(&good, "flat"), std::pair(&blind, "hall"), std::pair(&wreck, "wreck")}) {
    batch.results.push_back(
        evaluateScene(readSceneFolder(folder->path(), "ours", scene), {}, std::nullopt));
  }
  return batch;
}

TEST(ResultsFiles, CsvHasALineASceneAndQuotesWhatNeedsIt) {
  const std::string csv = toCsv(mixedScenes());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_NE(csv.find("ours,flat,done,,2.0,2.0,2.0,2.0,1.0,1.0,1.0,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\"a, \"\"b\"\" & <c>\""), std::string::npos);
  EXPECT_EQ(csv.find("nan"), std::string::npos);
}

TEST(ResultsFiles, JsonHasTheAveragesWithIntervals) {
  const std::string json = toJson(mixedScenes());
  EXPECT_NE(json.find("\"occusg-batch-results\""), std::string::npos);
  EXPECT_NE(json.find("\"failed\":1"), std::string::npos);
  EXPECT_NE(json.find("\"value\":0.5"), std::string::npos) << "one of two scenes with a truth";
}

TEST(ReportPage, ShowsTablesPicturesAndProblemsAndLoadsNothing) {
  const std::string page = reportPage(mixedScenes(), "A <title>");
  for (const char* part :
       {"<h1>A &lt;title&gt;</h1>", "id=\"macro\"", "id=\"micro\"", "id=\"scenes-15\"",
        "id=\"scenes-50\"", "id=\"scenes-75\"", "id=\"problems\"", "<svg role=\"img\"",
        "&lt;hall&gt;", "a, &quot;b&quot; &amp; &lt;c&gt;", "class=\"m\""})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  for (const char* part : {"<script", "http", " src=", "url(http", "@import", "nan"})
    EXPECT_EQ(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page, reportPage(mixedScenes(), "A <title>"));
}

TEST(ReportPage, OfNothingIsStillAPage) {
  EXPECT_NE(reportPage({}, "Nothing").find("</html>"), std::string::npos);
  EXPECT_NE(toCsv({}).find("configuration,scene"), std::string::npos);
}

}  // namespace
}  // namespace occusg
